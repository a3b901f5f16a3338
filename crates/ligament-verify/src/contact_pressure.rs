//! Pressures under a rigid body that is pressed into another.

use std::collections::BTreeMap;

use anyhow::Context;
use ligament::run::Solution;

/// Pressures of a contact.
#[derive(Debug, Clone, Copy)]
pub(super) struct ContactPressure {
    /// Force, N; for the cylinder per length, N/m.
    pub(super) force: f64,
    /// Largest pressure on a side of a cell, and largest pressure of the fit, Pa.
    pub(super) largest: [f64; 2],
    /// Half-width or radius by the second moment of the pressures, m.
    pub(super) reach: f64,
}

/// Pressures under a rigid body from the sides of cells in contact; `along` is the number of directions along the surface, `points` the
/// number of integration points of a side.
///
/// Hertz's pressure is p = p_0 sqrt(1 - r^2/a^2) at the distance r from the middle (Johnson 1985, sections 4.2 and 4.3), so that p^2 is a straight
/// line over r^2, whose value at r = 0 is p_0^2. The mean of r^2, weighted by p, is a^2/4 over a strip and 2 a^2/5 over a disk.
pub(super) fn contact_pressure(
    solution: &Solution,
    along: usize,
    points: u32,
) -> anyhow::Result<ContactPressure> {
    let pairs = &solution.outcome.state.surfaces.touching().pairs;
    let all = pairs.first().context("no contact")?.touches.iter();
    let all: Vec<_> = all.filter(|it| it.depth() > 0.0).collect();
    let force: f64 = all.iter().map(|it| it.stiffness * it.depth()).sum();
    let squares = |arm: &[f64]| -> f64 { arm.iter().take(along).map(|it| it * it).sum() };
    let moments = all
        .iter()
        .map(|it| it.stiffness * it.depth() * squares(&it.arm));
    let second = moments.sum::<f64>() / force;
    let of_reach = if along == 1 { 0.25 } else { 0.4 };
    let mut sides: BTreeMap<u32, Vec<[f64; 2]>> = BTreeMap::new();
    for it in &all {
        let reading = [squares(&it.arm), it.stiffness * it.depth() / it.area];
        sides.entry(it.place / points).or_default().push(reading);
    }
    // Only sides of cells in full contact count.
    let whole = sides.values().filter(|it| it.len() == points as usize);
    let places = whole.map(|it| {
        let mean = |axis: usize| it.iter().map(|it| it[axis]).sum::<f64>() / f64::from(points);
        [mean(0), mean(1).powi(2)]
    });
    let places: Vec<[f64; 2]> = places.collect();
    let count = places.len() as f64;
    let mean = |axis: usize| places.iter().map(|it| it[axis]).sum::<f64>() / count;
    let (x, y) = (mean(0), mean(1));
    let products = places.iter().map(|it| (it[0] - x) * (it[1] - y));
    let spread: f64 = places.iter().map(|it| (it[0] - x).powi(2)).sum();
    let slope = products.sum::<f64>() / spread;
    let square = y - slope * x;
    let largest = places.iter().map(|it| it[1]).fold(0.0, f64::max);
    Ok(ContactPressure {
        force,
        largest: [largest.sqrt(), square.sqrt()],
        reach: (second / of_reach).sqrt(),
    })
}
