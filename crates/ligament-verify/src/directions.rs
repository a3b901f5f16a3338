//! Stiffness of bonds over their direction in orthotropic materials.

use std::f64::consts::PI;

use anyhow::Context;
use ligament::Model;
use ligament::direction::{InDirection, over_direction};

use super::case_run::CaseRun;

/// The stiffness `k_n` or `k_t` of a case in a direction (degrees from x), the `smallest` or the `largest` one, the `spread` over the directions of
/// its ratio to the modulus of the continuum (%), or, `turned_by_N`, the largest difference of the curve for axes turned by N degrees from the
/// shifted curve, over the largest value.
pub(super) fn stiffness(case_run: &CaseRun, name: &str) -> anyhow::Result<f64> {
    let (stiffness, of) = name.split_once('.').context("no direction is named")?;
    let value: fn(&InDirection) -> f64 = match stiffness {
        "k_n" => |it| it.axial,
        _ => |it| it.shear,
    };
    let straight = curves(&case_run.model()?)?;
    let largest = |values: &mut dyn Iterator<Item = f64>| values.fold(f64::NEG_INFINITY, f64::max);
    if let Some(turn) = of.strip_prefix("turned_by_") {
        let turn: u8 = turn.parse()?;
        let size = largest(&mut straight.iter().map(value));
        let angle = f64::from(turn).to_radians();
        let turned = case_run.clone().set("material.angle", angle).model()?;
        let curves = curves(&turned)?.into_iter().enumerate();
        let difference = |(place, it): (usize, InDirection)| {
            let from_axis = (place + 180 - usize::from(turn)) % 180;
            (value(&it) - value(&straight[from_axis])).abs() / size
        };
        return Ok(largest(&mut curves.map(difference)));
    }
    let mut values = straight.iter().map(value);
    Ok(match of {
        "smallest" => values.fold(f64::INFINITY, f64::min),
        "largest" => largest(&mut values),
        "spread" => {
            let modulus = |it: &InDirection| match stiffness {
                "k_n" => it.normal_modulus,
                _ => it.shear_modulus,
            };
            let ratios = straight.iter().map(|it| value(it) / modulus(it));
            let (most, least) = (
                ratios.clone().fold(f64::NEG_INFINITY, f64::max),
                ratios.fold(f64::INFINITY, f64::min),
            );
            100.0 * (most - least) / (most + least)
        }
        degrees => values.nth(degrees.parse()?).context("no such direction")?,
    })
}

/// Stiffness curves of a model at every degree from 0 to 180, times pi t H^3/12.
fn curves(model: &Model) -> anyhow::Result<Vec<InDirection>> {
    let horizon = model.fixed.horizon[0];
    let angles: Vec<f64> = (0..=180).map(|it| f64::from(it).to_radians()).collect();
    let lengths = [0.5 * horizon, horizon];
    let unit = PI * model.setup.thickness() * horizon.powi(3) / 12.0;
    let curves = over_direction(&model.setup, 0, lengths, &angles);
    let curves = curves.context("the law has no such stiffness")?.into_iter();
    let scaled = curves.map(|it| InDirection {
        axial: unit * it.axial,
        shear: unit * it.shear,
        ..it
    });
    Ok(scaled.collect())
}
