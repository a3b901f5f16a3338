//! Results of an ensemble: tables, fields on the body, plots, and a short text for the terminal.

use std::io::{self, Write};
use std::path::Path;

use ligament_model::BodyGrid;
use ligament_output::csv::Value;
use ligament_output::quantity::quantity;
use ligament_output::replace_file;
use ligament_output::results::write_points;
use ligament_output::vtu::Field;
use ligament_post::statistics::quantile;

use super::collected::{CollectedSamples, NINETY_PERCENT, PROBABILITIES, Strengths, strengths};
use super::identity::Identity;
use super::plots;
use super::request::Request;
use super::row::{COLUMNS, Row};
use crate::run_table::{WIDTH, number, table, write_plot};

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

/// Writes the results into a folder, and prints their main contents.
pub(super) fn write(
    request: &Request<'_>,
    identity: &Identity,
    collected: &CollectedSamples,
    folder: &Path,
    out: &mut dyn Write,
) -> anyhow::Result<()> {
    let setup = request.case.setup(&mut ())?;
    let strengths = strengths(collected);
    let write = |name: &str, text: String| replace_file(&folder.join(name), text.as_bytes());
    write("samples.csv", samples(collected))?;
    write("curves.csv", curves(identity, collected))?;
    write("weibull.csv", weibull(&strengths))?;
    let grid = setup.body.grid();
    if collected.counts.damaged.len() == grid.positions.len() {
        let [first, damaged] = collected.shares();
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
    writeln!(out, "{title}")?;
    write_samples(request, identity, collected, out)?;
    let unit = setup.units().force;
    if let Some(sound) = identity.sound_peak {
        let peak = quantity(sound, unit);
        writeln!(out, "  {:<15} {peak} without random factors", "peak")?;
    }
    write_strengths(&strengths, unit, out)?;
    Ok(writeln!(out, "  results in {}", folder.display())?)
}

/// Text of `samples.csv`.
fn samples(collected: &CollectedSamples) -> String {
    let rows = collected.rows.iter().map(Row::line);
    format!("{}\n{}", COLUMNS.join(","), rows.collect::<String>())
}

/// Text of `curves.csv`.
fn curves(identity: &Identity, collected: &CollectedSamples) -> String {
    let displacements = identity.grid.displacements().into_iter();
    let at = displacements.zip(&collected.loads).zip(&identity.sound);
    let row = |((displacement, loads), sound): ((f64, &Vec<f64>), &Option<f64>)| {
        let mut values = vec![Value::Float(displacement), Value::from(loads.len())];
        values.extend(PROBABILITIES.map(|it| number(quantile(loads, it))));
        let mean = loads.iter().sum::<f64>() / loads.len() as f64;
        values.push(number(Some(mean).filter(|it| it.is_finite())));
        values.push(number(*sound));
        values
    };
    table(CURVE_COLUMNS, at.map(row))
}

/// Text of `weibull.csv`.
fn weibull(strengths: &[Strengths]) -> String {
    let row = |it: &Strengths| {
        let mut values = vec![Value::Text(it.name), Value::from(it.loads.len())];
        values.extend(
            it.moments()
                .map_or([Value::Missing; 2], |it| it.map(Value::Float)),
        );
        match &it.fit {
            None => values.extend([Value::Missing; 6]),
            Some(fit) => {
                values.push(Value::Float(fit.modulus));
                values.extend(fit.modulus_within(NINETY_PERCENT).map(Value::Float));
                values.push(Value::Float(fit.scale));
                values.extend(fit.scale_within(NINETY_PERCENT).map(Value::Float));
            }
        }
        values
    };
    table(WEIBULL_COLUMNS, strengths.iter().map(row))
}

/// Text of `points.csv`: the points of a body in the order of its file, with the shares of the samples (n_points).
fn points(grid: &BodyGrid, first: &[f64], damaged: &[f64]) -> String {
    let row = |in_file| {
        let point = grid.numbering.point(in_file) as usize;
        let mut values = vec![Value::Integer(grid.tags[point])];
        values.extend(grid.positions[point].map(Value::Float));
        values.extend([first[point], damaged[point]].map(Value::Float));
        values
    };
    table(POINT_COLUMNS, (0..grid.positions.len() as u32).map(row))
}

/// Prints the number of samples.
fn write_samples(
    request: &Request<'_>,
    identity: &Identity,
    collected: &CollectedSamples,
    out: &mut dyn Write,
) -> io::Result<()> {
    let (n, wanted, seed) = (collected.rows.len() as u64, request.samples, identity.seed);
    match n > wanted {
        true => writeln!(
            out,
            "  {n} samples, more than the {wanted} asked for, seed {seed}"
        ),
        false => writeln!(out, "  {n} of {wanted} samples, seed {seed}"),
    }
}

/// Prints the statistics of the loads.
fn write_strengths(strengths: &[Strengths], unit: &str, out: &mut dyn Write) -> io::Result<()> {
    for it in strengths {
        let Some([mean, deviation]) = it.moments() else {
            continue;
        };
        let (mean, percent) = (quantity(mean, unit), 100.0 * deviation);
        write!(
            out,
            "  {:<15} mean {mean}, deviation {percent:.1} %",
            it.words
        )?;
        if let Some(fit) = &it.fit {
            let [low, high] = fit.modulus_within(NINETY_PERCENT);
            let (modulus, scale) = (fit.modulus, quantity(fit.scale, unit));
            write!(
                out,
                ", Weibull modulus {modulus:.2} ({low:.2} to {high:.2} with 90 %), scale {scale}"
            )?;
        }
        writeln!(out)?;
    }
    Ok(())
}
