//! Judgement of the runs of a measured test by its bands.

use super::curve::{KnownCurve, Points, area, peak};
use super::reading::Reading;
use super::size_effect::Law;
use super::test::{Band, MeasuredTest, Quantity};
use crate::entry::{Entry, Reliability};
use crate::printed::{PrintedNumber, Tolerance};
use crate::table::{Heading, Row, Table};

/// Judged values of a test.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Judgement {
    /// One row for each run and band, the labels being the run and the quantity.
    pub(super) rows: Vec<Row>,
    /// Size effect laws of the series.
    pub(super) laws: Vec<Law>,
}

impl Judgement {
    /// Judges the runs of a test.
    ///
    /// # Errors
    ///
    /// If a number cannot be written.
    pub(super) fn new(
        test: &MeasuredTest,
        measured: Option<&KnownCurve>,
        readings: &[Reading],
    ) -> anyhow::Result<Self> {
        let theory = test.size_effect.as_ref();
        let laws = theory.map_or_else(Vec::new, |it| Law::from_series(it, readings));
        let mut rows = Vec::new();
        for (place, band) in test.band.iter().enumerate() {
            let independent = band.independent.as_ref();
            let independent = independent.map(|file| KnownCurve::independent(file, &test.y));
            let independent = independent.transpose()?;
            let known = independent.as_ref().or(measured);
            let ends = [independent.as_ref(), measured].into_iter().flatten();
            let end = ends.map(KnownCurve::end).fold(f64::INFINITY, f64::min);
            let of_laws = theory.into_iter().flat_map(|theory| {
                let value = |law: &Law| match band.of {
                    Quantity::SizeEffectEnergy => Some(law.energy_ratio(theory)),
                    Quantity::SizeEffectLength => Some(law.length_ratio(theory)),
                    _ => None,
                };
                laws.iter()
                    .filter_map(move |law| Some((&*law.series, value(law)?)))
            });
            let of_runs = readings.iter().filter_map(|reading| {
                let curve = reading.curve(place);
                let value = match band.of {
                    Quantity::CrackY => crack_height(band, reading),
                    _ => ratio(band, known, end, curve),
                };
                Some((&*reading.run, value?))
            });
            let judged = of_laws.chain(of_runs);
            for (name, computed) in judged.filter(|(name, _)| band.judges(name)) {
                rows.push(row(band, name, computed)?);
            }
        }
        Ok(Self { rows, laws })
    }

    /// The rows as a table of the report.
    pub(super) fn table(&self, test: &MeasuredTest) -> Table {
        let reasons = test.band.iter().map(|band| {
            let reason = band.because.trim_end_matches('.');
            format!("{}: {reason}", band.words())
        });
        Table {
            heading: Heading {
                name: format!("experiments-{}", test.name),
                title: test.title.clone(),
                source: test.source.clone(),
                quantity: "computed over measured or independent; of a crack its height, mm"
                    .to_owned(),
                known: "measured or independent".to_owned(),
                tolerance: format!("{}.", reasons.collect::<Vec<_>>().join("; ")),
                keys: ["run", "quantity"].map(str::to_owned).to_vec(),
            },
            rows: self.rows.clone(),
        }
    }
}

/// Ratio of a value of a computed curve to the known one. Areas end at the given x, or, where the band has the measured value, nowhere. None for
/// quantities that no curve has.
fn ratio(band: &Band, known: Option<&KnownCurve>, end: f64, curve: &Points) -> Option<f64> {
    let of_curve = |of: &dyn Fn(&KnownCurve) -> f64| {
        let value = || known.map(of);
        band.measured.or_else(value).unwrap_or(f64::NAN)
    };
    match band.of {
        Quantity::Peak => Some(peak(curve)[1] / of_curve(&|it| it.peak()[1])),
        Quantity::XAtPeak => Some(peak(curve)[0] / of_curve(&|it| it.peak()[0])),
        Quantity::Area => {
            let end = band.measured.map_or(end, |_| f64::INFINITY);
            Some(area(curve, end) / of_curve(&|it| it.area(end)))
        }
        Quantity::CrackY | Quantity::SizeEffectEnergy | Quantity::SizeEffectLength => None,
    }
}

/// Height of the crack of a run where its x is given, mm.
fn crack_height(band: &Band, reading: &Reading) -> Option<f64> {
    let (at, known) = band.at.zip(band.measured)?;
    Some(1e3 * reading.crack_height(at, 1e-3 * known))
}

/// Judged row of a computed value. A value out of its band keeps the reason of the band, or fails without one.
fn row(band: &Band, name: &str, computed: f64) -> anyhow::Result<Row> {
    let of_crack = band.of == Quantity::CrackY;
    let known = match band.measured.filter(|_| of_crack) {
        Some(known) => printed(format!("{known}"))?,
        None => printed("1.000".to_owned())?,
    };
    let [least, most] = band.between;
    let about = if of_crack { 0.0 } else { 1.0 };
    let [least, most] = [least, most].map(|it| (1e6 * (it - about)).round() / 1e6);
    let allowed = Tolerance::Between(least, most);
    let standing = match &band.missed {
        Some(reason) if computed.is_finite() => {
            let rounded = printed(format!("{computed:.4}"))?;
            Reliability::Missed {
                // A band that ends at the known value would exclude rounded values on one side.
                instead: match allowed.admits(&rounded, computed) {
                    true => rounded,
                    false => printed(format!("{computed}"))?,
                },
                reason: reason.clone(),
            }
        }
        _ => Reliability::Sound,
    };
    // Only a value outside its band is shown with the reason.
    let standing = match allowed.admits(&known, computed) {
        true => Reliability::Sound,
        false => standing,
    };
    let entry = Entry {
        labels: vec![name.to_owned(), band.words()],
        known,
        allowed,
        standing,
        is_fast: true,
    };
    Ok(Row {
        verdict: entry.verdict(computed),
        computed,
        entry,
    })
}

fn printed(text: String) -> anyhow::Result<PrintedNumber> {
    PrintedNumber::parse(&text).ok_or_else(|| anyhow::anyhow!("`{text}` is no number"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::entry::Verdict;

    fn band(of: Quantity, measured: Option<f64>, between: [f64; 2], missed: Option<&str>) -> Band {
        Band {
            of,
            at: None,
            measured,
            independent: None,
            x: None,
            runs: Vec::new(),
            between,
            because: String::new(),
            missed: missed.map(str::to_owned),
        }
    }

    /// A value in its band is within, at the bounds as well; one outside fails, or is missed where the reason is known.
    #[test]
    fn a_band_accepts_what_lies_in_it() {
        let verdict = |missed, value| {
            let band = band(Quantity::Peak, None, [0.9, 1.2], missed);
            row(&band, "4 mm", value).unwrap().verdict
        };
        for value in [0.9, 1.07, 1.2] {
            assert_eq!(verdict(None, value), Verdict::Within, "{value}");
        }
        for value in [0.899, 1.201, f64::NAN] {
            assert_eq!(verdict(None, value), Verdict::Failed, "{value}");
        }
        assert_eq!(verdict(Some("coarse"), 0.8), Verdict::Missed);
        assert_eq!(verdict(Some("coarse"), 1.1), Verdict::Within);
        assert_eq!(verdict(Some("coarse"), f64::NAN), Verdict::Failed);
    }

    /// A band with an end at the measured value: a value just beyond it is missed, whichever way its digits are rounded.
    #[test]
    fn a_band_may_end_at_the_measured_value() {
        for value in [1.00824, 1.00827] {
            let band = band(Quantity::Peak, None, [0.5, 1.0], Some("strong"));
            let found = row(&band, "4 mm", value).unwrap().verdict;
            assert_eq!(found, Verdict::Missed, "{value}");
        }
    }

    /// By hand: the known curve has its peak 10 at 1 mm and the area 5 up to there; the computed one has 12 at 2 mm, and up to 1 mm the area 3.
    #[test]
    fn an_independent_curve_gives_ratios() {
        let known = KnownCurve {
            specimens: vec![("load".to_owned(), vec![[0.0, 0.0], [1.0, 10.0]])],
        };
        let curve = [[0.0, 0.0], [2.0, 12.0]];
        let of = |quantity| {
            let band = band(quantity, None, [0.9, 1.1], None);
            ratio(&band, Some(&known), known.end(), &curve).unwrap()
        };
        assert_eq!(of(Quantity::Peak), 1.2);
        assert_eq!(of(Quantity::XAtPeak), 2.0);
        assert_eq!(of(Quantity::Area), 0.6);
    }

    /// Heights of cracks are judged by their distance, mm, and not as ratios.
    #[test]
    fn a_crack_is_judged_by_its_distance() {
        let band = band(Quantity::CrackY, Some(273.5), [-12.0, 12.0], None);
        let verdict = |value| row(&band, "4 mm", value).unwrap().verdict;
        assert_eq!(verdict(262.0), Verdict::Within);
        assert_eq!(verdict(261.0), Verdict::Failed);
    }
}
