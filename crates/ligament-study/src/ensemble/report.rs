//! Results of an ensemble: tables, fields on the body, plots, and the short text at its end.

use std::io::Write;
use std::path::Path;

use ligament::Setup;
use ligament_model::BodyGrid;
use ligament_output::csv::{self, Value};
use ligament_output::quantity::quantity;
use ligament_output::replace_file;
use ligament_output::results::write_points;
use ligament_output::vtu::Field;
use ligament_post::statistics::{WeibullFit, quantile};

use super::collected::Collected;
use super::identity::Identity;
use super::row::{COLUMNS, Row};
use super::{Request, plots};
use crate::sweep::report::{WIDTH, write_plot};

/// Probabilities of the quantiles of curves.
pub(super) const PROBABILITIES: [f64; 5] = [0.05, 0.25, 0.5, 0.75, 0.95];

/// Standard deviations of a normal number between which 90 % lie.
pub(super) const NINETY_PERCENT: f64 = 1.644_853_626_951_472_7;

/// Columns of `curves.csv`.
const CURVE_COLUMNS: &str =
    "displacement,samples,load_5,load_25,load_50,load_75,load_95,load_mean,load_sound";

/// Columns of `weibull.csv`.
const WEIBULL_COLUMNS: &str =
    "load,samples,mean,deviation,modulus,modulus_low,modulus_high,scale,scale_low,scale_high";

/// Columns of `points.csv`.
const POINT_COLUMNS: &str = "tag,x,y,z,first_break_share,damaged_share";

/// Names of the fields.
const FIRST_BREAK_SHARE: &str = "first_break_share";
const DAMAGED_SHARE: &str = "damaged_share";

/// Loads of the samples with their statistics.
pub(super) struct Strengths {
    /// Name in tables.
    pub(super) name: &'static str,
    /// Name in words.
    pub(super) words: &'static str,
    /// Loads in the order of the samples that have one.
    pub(super) loads: Vec<f64>,
    /// Fitted distribution; none where there is none.
    pub(super) fit: Option<WeibullFit>,
}

impl Strengths {
    fn new(
        name: &'static str,
        words: &'static str,
        load: fn(&Row) -> Option<f64>,
        collected: &Collected,
    ) -> Self {
        let loads = collected.strengths(load);
        Self {
            name,
            words,
            fit: WeibullFit::through(&loads).ok(),
            loads,
        }
    }

    /// Mean of the loads, and their standard deviation over the mean; sums are in the order of the samples.
    fn moments(&self) -> Option<[f64; 2]> {
        let n = self.loads.len();
        if n < 2 {
            return None;
        }
        let mean = self.loads.iter().sum::<f64>() / n as f64;
        let squares = self.loads.iter().map(|it| (it - mean).powi(2));
        let variance = squares.sum::<f64>() / (n - 1) as f64;
        Some([mean, variance.sqrt() / mean])
    }
}

/// Writes the results into a folder, and prints their main contents.
pub(super) fn write(
    request: &Request<'_>,
    identity: &Identity,
    collected: &Collected,
    folder: &Path,
    out: &mut dyn Write,
) -> anyhow::Result<()> {
    let setup = request.case.setup(&mut ())?;
    let strengths = [
        Strengths::new("first", "first breakage", Row::first_load, collected),
        Strengths::new("first_peak", "first peak", Row::first_peak_load, collected),
        Strengths::new("peak", "peak", Row::peak_load, collected),
    ];
    let write = |name: &str, text: String| replace_file(&folder.join(name), text.as_bytes());
    write("samples.csv", samples(collected))?;
    write("curves.csv", curves(identity, collected))?;
    write("weibull.csv", weibull(&strengths))?;
    let grid = setup.body.grid();
    if collected.counts.damaged.len() == grid.positions.len() {
        let [first, damaged] = shares(collected);
        let fields = [
            Field::scalar(FIRST_BREAK_SHARE, &first),
            Field::scalar(DAMAGED_SHARE, &damaged),
        ];
        write_points(&folder.join("ensemble.vtu"), &grid, &fields)?;
        write("points.csv", points(&grid, &first, &damaged))?;
    }
    let title = match request.case.case.title.as_str() {
        "" => request.case.name(),
        title => title.to_owned(),
    };
    for plot in plots::plots(&title, setup.units(), identity, collected, &strengths) {
        // A plot without points is left out.
        if let Ok(drawing) = plot.for_paper(WIDTH) {
            write_plot(folder, &plot.name, &drawing)?;
        }
    }
    for maps in plots::maps(&title, &grid, collected) {
        write_plot(folder, &maps.name, &maps.draw(WIDTH)?)?;
    }
    tell(
        request,
        &setup,
        (&title, identity),
        (collected, &strengths),
        out,
    )?;
    Ok(writeln!(out, "  results in {}", folder.display())?)
}

/// Text of `samples.csv`.
fn samples(collected: &Collected) -> String {
    let mut text = COLUMNS.join(",") + "\n";
    for row in &collected.rows {
        text += &csv::line(&row.values());
    }
    text
}

/// Text of `curves.csv`.
fn curves(identity: &Identity, collected: &Collected) -> String {
    let mut text = format!("{CURVE_COLUMNS}\n");
    let number = |value: Option<f64>| value.map_or(Value::Missing, Value::Float);
    let displacements = identity.grid.displacements();
    let at = displacements
        .iter()
        .zip(&collected.loads)
        .zip(&identity.sound);
    for ((&displacement, loads), sound) in at {
        let mut values = vec![Value::Float(displacement), Value::from(loads.len())];
        values.extend(PROBABILITIES.map(|it| number(quantile(loads, it))));
        let mean = loads.iter().sum::<f64>() / loads.len() as f64;
        values.push(number(Some(mean).filter(|it| it.is_finite())));
        values.push(number(sound.map(|it| it.0)));
        text += &csv::line(&values);
    }
    text
}

/// Text of `weibull.csv`.
fn weibull(strengths: &[Strengths]) -> String {
    let mut text = format!("{WEIBULL_COLUMNS}\n");
    for it in strengths {
        let mut values = vec![Value::Text(it.name), Value::from(it.loads.len())];
        values.extend(
            it.moments()
                .map_or([Value::Missing; 2], |it| it.map(Value::Float)),
        );
        match &it.fit {
            None => values.extend([Value::Missing; 6]),
            Some(fit) => {
                let [modulus, scale] = [
                    fit.modulus_within(NINETY_PERCENT),
                    fit.scale_within(NINETY_PERCENT),
                ];
                values.push(Value::Float(fit.modulus));
                values.extend(modulus.map(Value::Float));
                values.push(Value::Float(fit.scale));
                values.extend(scale.map(Value::Float));
            }
        }
        text += &csv::line(&values);
    }
    text
}

/// Text of `points.csv`: the points of a body in the order of its file, with the shares of the samples (n_points).
fn points(grid: &BodyGrid, first: &[f64], damaged: &[f64]) -> String {
    let mut text = format!("{POINT_COLUMNS}\n");
    for in_file in 0..grid.positions.len() as u32 {
        let point = grid.numbering.point(in_file) as usize;
        let mut values = vec![Value::Integer(grid.tags[point])];
        values.extend(grid.positions[point].map(Value::Float));
        values.extend([first[point], damaged[point]].map(Value::Float));
        text += &csv::line(&values);
    }
    text
}

/// Shares of the samples in which fracture begins at each point, and in which it is damaged, shape (n_points).
pub(super) fn shares(collected: &Collected) -> [Vec<f64>; 2] {
    let n = collected.rows.len().max(1) as f64;
    let counts = &collected.counts;
    [&counts.first_break, &counts.damaged].map(|it| it.iter().map(|it| *it as f64 / n).collect())
}

/// Prints the number of samples and the statistics of their loads.
fn tell(
    request: &Request<'_>,
    setup: &Setup,
    (title, identity): (&str, &Identity),
    (collected, strengths): (&Collected, &[Strengths]),
    out: &mut dyn Write,
) -> anyhow::Result<()> {
    let unit = setup.units().force;
    writeln!(out, "{title}")?;
    let (n, wanted) = (collected.rows.len() as u64, request.samples);
    match n > wanted {
        true => writeln!(
            out,
            "  {n} samples, more than the {wanted} asked for, seed {}",
            identity.seed
        )?,
        false => writeln!(out, "  {n} of {wanted} samples, seed {}", identity.seed)?,
    }
    if let Some(sound) = identity.sound_peak {
        let peak = quantity(sound.0, unit);
        writeln!(out, "  {:<15} {peak} without random factors", "peak")?;
    }
    for it in strengths {
        let Some([mean, deviation]) = it.moments() else {
            continue;
        };
        let mean = quantity(mean, unit);
        write!(
            out,
            "  {:<15} mean {mean}, deviation {:.1} %",
            it.words,
            100.0 * deviation
        )?;
        if let Some(fit) = &it.fit {
            let [low, high] = fit.modulus_within(NINETY_PERCENT);
            let scale = quantity(fit.scale, unit);
            write!(
                out,
                ", Weibull modulus {:.2} ({low:.2} to {high:.2} with 90 %), scale {scale}",
                fit.modulus
            )?;
        }
        writeln!(out)?;
    }
    Ok(())
}
