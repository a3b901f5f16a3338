//! Straightness and symmetry of cracks on a lattice.

use std::collections::BTreeMap;

use ligament::run::Solution;
use ligament_analysis::fields::point_damage;

/// Share of the broken bonds that cross none of the horizontal lines at some heights, m.
pub(super) fn beside(solution: &Solution, lines: [f64; 2]) -> f64 {
    let (system, intact) = (solution.model.plane(), &solution.outcome.state.intact);
    let height = |point: u32| system.cloud.positions[point as usize][1];
    let crosses = |ends: &[u32; 2]| {
        let [a, b] = ends.map(height);
        lines.iter().any(|line| (a - line) * (b - line) < 0.0)
    };
    let bonds = system.bonds.ends.iter().zip(intact);
    let broken: Vec<bool> = bonds
        .filter(|(_, is_intact)| !**is_intact)
        .map(|(ends, _)| crosses(ends))
        .collect();
    let off = broken.iter().filter(|crosses| !**crosses).count();
    off as f64 / broken.len() as f64
}

/// Largest difference of the damage between a point and its mirror images about both axes.
pub(super) fn asymmetry(solution: &Solution) -> f64 {
    let (system, intact) = (solution.model.plane(), &solution.outcome.state.intact);
    let half = 0.5 * system.cloud.cell_size(0)[0];
    let places = system.cloud.positions.iter();
    let damages: BTreeMap<[i64; 2], f64> = (0..)
        .zip(places)
        .map(|(point, at)| {
            let place = at.map(|coordinate| (coordinate / half).round() as i64);
            (place, point_damage(&**system, intact, point))
        })
        .collect();
    let differences = damages.iter().flat_map(|(&[x, y], damage)| {
        let images = [[-x, y], [x, -y]].map(|image| damages.get(&image));
        images.map(|image| image.map_or(f64::NAN, |image| (damage - image).abs()))
    });
    differences.fold(0.0, f64::max)
}
