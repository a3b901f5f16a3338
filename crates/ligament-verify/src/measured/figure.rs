//! The figure of a measured test: measured points, the band of the peak, and the curves of all runs; for a series its strengths and laws.

use ligament_plot::plots::{Colour, Plot, Series};

use super::curve::KnownCurve;
use super::judgement::Judgement;
use super::reading::Reading;
use super::size_effect::Law;
use super::test::{MeasuredTest, Quantity};

/// Colours of the runs, in their order.
const COLOURS: [Colour; 5] = [
    Colour::Blue,
    Colour::Vermilion,
    Colour::Green,
    Colour::Orange,
    Colour::Purple,
];

/// Draws the figure of a test.
pub(super) fn figure(
    test: &MeasuredTest,
    measured: Option<&KnownCurve>,
    readings: &[Reading],
    judgement: &Judgement,
) -> Plot {
    let name = format!("experiments-{}", test.name);
    if !judgement.laws.is_empty() {
        let axes = ["size D, mm", "nominal strength P/(b D), MPa"];
        return Plot::new(name, &test.title, axes, strengths(&judgement.laws));
    }
    let mut series = Vec::new();
    for ((run, curve), colour) in readings
        .iter()
        .map(|it| (&it.run, &it.curve))
        .zip(colours())
    {
        series.push(Series::curve(run, colour, curve.clone()));
    }
    let specimens = measured.map_or(&[][..], |it| &it.specimens[..]);
    for (place, (_, points)) in specimens.iter().enumerate() {
        let label = if place == 0 { "measured" } else { "" };
        series.push(Series::circles(label, Colour::Black, points.clone()));
    }
    series.extend(band_of_peak(test, measured, readings));
    Plot::new(name, &test.title, [&test.x.name, &test.y.name], series)
}

fn colours() -> impl Iterator<Item = Colour> {
    COLOURS.into_iter().cycle()
}

/// Two lines at the ends of the band of the peak.
fn band_of_peak(
    test: &MeasuredTest,
    measured: Option<&KnownCurve>,
    readings: &[Reading],
) -> Vec<Series> {
    let band = test.band.iter().find(|it| it.of == Quantity::Peak);
    let of_curve = || measured.map(|it| it.peak()[1]);
    let known = band.and_then(|it| it.measured.or_else(of_curve));
    let Some((band, known)) = band.zip(known) else {
        return Vec::new();
    };
    let ends = readings.iter().flat_map(|it| &it.curve);
    let end = ends.fold(0.0_f64, |end, point| end.max(point[0]));
    let line = |(place, share): (usize, f64)| {
        let label = if place == 0 { "band of the peak" } else { "" };
        let points = vec![[0.0, share * known], [end, share * known]];
        Series::dashes(label, Colour::Sky, points)
    };
    band.between.into_iter().enumerate().map(line).collect()
}

/// Strengths of the series as circles, and their laws as lines.
fn strengths(laws: &[Law]) -> Vec<Series> {
    let mut series = Vec::new();
    for (law, colour) in laws.iter().zip(colours()) {
        let shown = |[size, strength]: [f64; 2]| [1e3 * size, 1e-6 * strength];
        let points = law.strengths.iter().copied().map(shown).collect();
        series.push(Series::circles("", colour, points));
        let sizes = law.strengths.iter().map(|it| it[0]);
        let [least, most] = [
            sizes.clone().fold(f64::INFINITY, f64::min),
            sizes.fold(0.0, f64::max),
        ];
        let between = (0..=40).map(|part| least + (most - least) * f64::from(part) / 40.0);
        let line = between.map(|size| shown([size, law.strength(size)]));
        series.push(Series::curve(&law.series, colour, line.collect()));
    }
    series
}
