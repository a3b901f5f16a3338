//! Stiffness of bonds over their direction in orthotropic materials (OMPPD Table 1, Figs 6, 8 and 10).

use std::f64::consts::{FRAC_PI_2, PI};

use anyhow::Context;
use ligament::direction::{InDirection, over_direction};

use super::experiment::{Compute, Experiment, Findings};
use super::published::{Published, published};
use super::table::{Extent, Labels, Table};
use super::trial::{Memory, Template, template};

/// The experiment.
pub(super) const EXPERIMENT: Experiment = Experiment {
    name: "directions",
    title: "Stiffness of bonds over their direction",
    source: "Diana and Casolo (OMPPD), Tables 1 and 2, Figs 6, 8 and 10",
    setup: "k_n and k_t of the three materials of Table 1 and of the lamina of Table 2, in plane stress, at every degree \
            from the axis 1. E_1, E_2, nu_12, G: 15 GPa, 10 GPa, 0.3, 8 GPa; 10 GPa, 10 GPa, 0.1, 3 GPa; 200 GPa, 50 \
            GPa, 0.25, 50 GPa; lamina 15 GPa, 5 GPa, 0.25, 4.8 GPa. The figures have curves without numbers, so that what they \
            show is worked out apart from the printed equations; Fig. 10 turns the axes.",
    cases: &[&CASE],
    compute: Compute::Code(compute),
};

static CASE: Template = template!("verification/lamina-tension.toml");

/// Angles of the axis 1 in Fig. 10, degrees.
const TURNS: [f64; 4] = [30.0, 45.0, 60.0, 90.0];

fn compute(extent: Extent) -> anyhow::Result<Findings> {
    let mut memory = Memory::default();
    let mut judge =
        |table: Published, value: fn(&[InDirection], Labels<'_>) -> anyhow::Result<f64>| {
            table.judge(extent, |labels| {
                let curves = curves(labels.text("material")?, 0.0, &mut memory)?;
                value(&curves, labels)
            })
        };
    let tables = vec![
        judge(published!("omppd-figure-6"), in_direction)?,
        judge(published!("omppd-shape"), spread)?,
        turned(extent)?,
    ];
    Ok(Findings {
        tables,
        plots: Vec::new(),
        ..Findings::default()
    })
}

/// Largest difference of the curves with turned axes from the shifted curves, over the largest value.
fn turned(extent: Extent) -> anyhow::Result<Table> {
    published!("omppd-figure-10").judge(extent, |labels| {
        let mut memory = Memory::default();
        let straight = curves("lamina", 0.0, &mut memory)?;
        let value = stiffness(labels)?;
        let largest = straight.iter().map(value).fold(0.0, f64::max);
        let turn = labels.number("angle")?;
        anyhow::ensure!(
            TURNS.contains(&turn),
            "Fig. 10 has no angle of {turn} degrees"
        );
        let turned = curves("lamina", turn, &mut memory)?;
        let difference = |(place, it): (usize, &InDirection)| {
            let from_axis = (place + 180 - turn as usize) % 180;
            (value(it) - value(&straight[from_axis])).abs() / largest
        };
        Ok(turned
            .iter()
            .enumerate()
            .map(difference)
            .fold(0.0, f64::max))
    })
}

/// The curves of a material with its axis 1 at an angle to x (degrees), at every degree from 0 to 180, times pi t H^3/12.
fn curves(
    material: &str,
    angle: f64,
    memory: &mut Memory<Vec<InDirection>>,
) -> anyhow::Result<Vec<InDirection>> {
    let [young_1, young_2, poisson, shear] = match material {
        "1" => [15e9, 10e9, 0.3, 8e9],
        "2" => [10e9, 10e9, 0.1, 3e9],
        "3" => [200e9, 50e9, 0.25, 50e9],
        _ => [15e9, 5e9, 0.25, 4.8e9],
    };
    let trial = CASE.trial();
    let trial = trial.set("material.young_1", young_1);
    let trial = trial.set("material.young_2", young_2);
    let trial = trial.set("material.poisson_12", poisson);
    let trial = trial.set("material.shear_modulus", shear);
    let trial = trial.set("material.angle", angle.to_radians());
    memory.result(trial.command(), || {
        let model = trial.model()?;
        let horizon = model.fixed.horizon[0];
        let angles: Vec<f64> = (0..=180).map(|it| f64::from(it).to_radians()).collect();
        let lengths = [0.5 * horizon, horizon];
        let unit = PI * model.setup.thickness() * horizon.powi(3) / 12.0;
        let curves = over_direction(&model.setup, 0, lengths, &angles);
        let curves = curves.context("the law has no such stiffness")?;
        Ok(curves
            .into_iter()
            .map(|it| InDirection {
                axial: unit * it.axial,
                shear: unit * it.shear,
                ..it
            })
            .collect())
    })
}

/// The stiffness of an entry.
fn stiffness(labels: Labels<'_>) -> anyhow::Result<fn(&InDirection) -> f64> {
    Ok(match labels.text("stiffness")? {
        "k_n" => |it| it.axial,
        _ => |it| it.shear,
    })
}

/// The stiffness in a direction, or its extreme, GPa.
fn in_direction(curves: &[InDirection], labels: Labels<'_>) -> anyhow::Result<f64> {
    let values = curves.iter().map(stiffness(labels)?);
    let found = match labels.text("direction")? {
        "smallest" => values.fold(f64::INFINITY, f64::min),
        "largest" => values.fold(f64::NEG_INFINITY, f64::max),
        _ => {
            let degrees = labels.number("direction")?;
            let place = (degrees.to_radians() / FRAC_PI_2 * 90.0).round() as usize;
            values.clone().nth(place).context("no such direction")?
        }
    };
    Ok(found / 1e9)
}

/// Spread over the directions of the ratio of a stiffness to the modulus of the continuum, %.
fn spread(curves: &[InDirection], labels: Labels<'_>) -> anyhow::Result<f64> {
    let value = stiffness(labels)?;
    let is_axial = labels.text("stiffness")? == "k_n";
    let ratio = |it: &InDirection| {
        let modulus = if is_axial {
            it.normal_modulus
        } else {
            it.shear_modulus
        };
        value(it) / modulus
    };
    let ratios = curves.iter().map(ratio);
    let most = ratios.clone().fold(f64::NEG_INFINITY, f64::max);
    let least = ratios.fold(f64::INFINITY, f64::min);
    Ok(100.0 * (most - least) / (most + least))
}
