//! Cracks controlled by the fracture energy: failure stress of a plate with a central crack, energy and straightness of a crack.
//!
//! Numbers of the experiment: `half_width` of the plate and `half_length` of the central crack, `thickness`, `edge_tip` of the edge crack (m),
//! `young` (Pa) and
//! `fracture_energy` (J/m^2).

use std::f64::consts::PI;

use anyhow::{Context, ensure};
use ligament::run::Solution;

use super::case_run::Number;
use super::crack_path::ends;

/// Shift of the counted part of the line, m. Bonds cross the line at points of the lattice, and the ends of that part should lie between them.
const ASIDE: f64 = 1.1e-4;

/// Distance from the crack within which the horizon is averaged: half the height of the fine strip of the meshes, m.
const STRIP: f64 = 0.005;

/// Largest relative error of delta/a in the label of an entry.
const LABEL_TOLERANCE: f64 = 5e-3;

/// Failure stress of a plate of width 2W with a central crack of length 2a:
///
/// sigma = sqrt(E G_c/(pi a))/F, F = (1 - 0.025 (a/W)^2 + 0.06 (a/W)^4) sqrt(sec(pi a/(2W)))
///
/// (Tada 2000, section 2.1: error of 0.1 % for a long plate).
fn failure_stress(number: Number<'_>) -> anyhow::Result<f64> {
    let half_length = number("half_length")?;
    let ratio = half_length / number("half_width")?;
    let width = 1.0 - 0.025 * ratio.powi(2) + 0.06 * ratio.powi(4);
    let secant = 1.0 / (0.5 * PI * ratio).cos();
    let toughness = number("young")? * number("fracture_energy")?;
    Ok((toughness / (PI * half_length)).sqrt() / (width * secant.sqrt()))
}

/// Failure stress over the failure stress by linear elastic fracture mechanics; the horizon over the half-length must equal the label `delta/a`.
pub(super) fn relative_strength(solution: &Solution, number: Number<'_>) -> anyhow::Result<f64> {
    let labelled = number("delta/a")?;
    let found = horizon(solution) / number("half_length")?;
    ensure!(
        (found - labelled).abs() < LABEL_TOLERANCE,
        "delta/a is {found:.3}, its label says {labelled}"
    );
    let peak = (solution.outcome.peak()).context("the run has no state at rest")?;
    let section = 2.0 * number("half_width")? * number("thickness")?;
    Ok(peak.reaction / section / failure_stress(number)?)
}

/// Mean horizon of the points along the crack, m.
fn horizon(solution: &Solution) -> f64 {
    let model = &solution.model;
    let cloud = &model.plane().cloud;
    let near = cloud.positions.iter().zip(&model.fixed.horizon);
    let near = near.filter(|([_, y], _)| (y + cloud.origin[1]).abs() <= STRIP);
    let (sum, count) = near.fold((0.0, 0.0), |(sum, count), (_, h)| (sum + h, count + 1.0));
    sum / count
}

/// Energy at the limits of the bonds across the middle part of the line y = 0 of a plate without crack, over G_c times the surface t dx of
/// that part.
pub(super) fn crossing_energy(solution: &Solution, number: Number<'_>) -> anyhow::Result<f64> {
    let half = 0.5 * number("half_width")?;
    let crosses = |bond: usize| {
        let [[x, y], [other_x, other_y]] = ends(&solution.model, bond);
        let at = x + (other_x - x) * y / (y - other_y);
        y * other_y < 0.0 && (at - ASIDE).abs() < half
    };
    let bonds = (0..solution.model.plane().bonds.len()).filter(|&bond| crosses(bond));
    let surface = 2.0 * half * number("thickness")?;
    Ok(energy_at_limits(solution, bonds) / (number("fracture_energy")? * surface))
}

/// Sum of 1/2 R s_0^2, R = Omega alpha V_A V_B k_n l, J.
fn energy_at_limits(solution: &Solution, bonds: impl Iterator<Item = usize>) -> f64 {
    let model = &solution.model;
    let limits = &model.criteria.list[0].limit;
    bonds
        .map(|bond| 0.5 * model.plane().rigidities.axial[bond] * limits[bond].powi(2))
        .sum()
}

/// The bonds that an edge crack through the whole plate broke.
fn separated_bonds(solution: &Solution, number: Number<'_>) -> anyhow::Result<Vec<usize>> {
    let intact = &solution.outcome.state.intact;
    let broken: Vec<usize> = (0..intact.len()).filter(|&bond| !intact[bond]).collect();
    let reached = broken.iter().map(|&bond| {
        let [[x, _], [other_x, _]] = ends(&solution.model, bond);
        0.5 * (x + other_x)
    });
    let far = reached.fold(number("edge_tip")?, f64::max);
    ensure!(
        number("half_width")? - far < horizon(solution),
        "the crack ends at x = {far:.4} m, inside the plate"
    );
    Ok(broken)
}

/// G_c times the surface that an edge crack through the whole plate makes, J.
fn separation(number: Number<'_>) -> anyhow::Result<f64> {
    let length = number("half_width")? - number("edge_tip")?;
    Ok(number("fracture_energy")? * length * number("thickness")?)
}

/// Energy released by the breakages of an edge crack per new surface, over G_c.
pub(super) fn released_energy_ratio(
    solution: &Solution,
    number: Number<'_>,
) -> anyhow::Result<f64> {
    separated_bonds(solution, number)?;
    let last = solution.outcome.history.last();
    Ok(last.context("the run has no state")?.released_energy / separation(number)?)
}

/// Energy of the bonds that an edge crack broke at their limits per new surface, over G_c.
pub(super) fn separation_energy(solution: &Solution, number: Number<'_>) -> anyhow::Result<f64> {
    let broken = separated_bonds(solution, number)?;
    Ok(energy_at_limits(solution, broken.into_iter()) / separation(number)?)
}

/// Largest distance of the middle of a bond that an edge crack broke from the line of the crack, over its horizon.
pub(super) fn deviation(solution: &Solution, number: Number<'_>) -> anyhow::Result<f64> {
    let horizons = &solution.model.plane().bonds.horizon;
    let deviations = separated_bonds(solution, number)?.into_iter().map(|bond| {
        let [[_, y], [_, other_y]] = ends(&solution.model, bond);
        0.5 * (y + other_y).abs() / horizons[bond]
    });
    Ok(deviations.fold(0.0, f64::max))
}
