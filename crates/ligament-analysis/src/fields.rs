//! Fields on the points, for output and probes.

use ligament_model::BondSystem;
use ligament_model::element::BondDeformation;

/// Damage of every point (NHPD eq. 17): 1 - (sum over its intact bonds of Omega alpha)/(sum over all its bonds).
///
/// The bonds are those that were there at the start: what a pre-crack cut is no damage, and a point that lost all its
/// bonds to one has damage 0.
pub fn damage(system: &BondSystem, intact: &[bool]) -> Vec<f64> {
    gather(system, |point| point_damage(system, intact, point))
}

/// Damage of one point, see [`damage`].
pub fn point_damage(system: &BondSystem, intact: &[bool], point: u32) -> f64 {
    let (mut broken, mut all) = (0.0, 0.0);
    for &bond in system.bonds.incidence.of(point) {
        let weight = system.weight[bond as usize];
        all += weight;
        if !intact[bond as usize] {
            broken += weight;
        }
    }
    // Summing what broke, not what is left, keeps an intact point at exactly 0.
    if all > 0.0 { broken / all } else { 0.0 }
}

/// Strain energy density of every point, J/m^3: half the energy of its intact bonds over its volume.
pub fn strain_energy_density(
    system: &BondSystem,
    intact: &[bool],
    deformations: &[BondDeformation],
) -> Vec<f64> {
    gather(system, |point| {
        point_energy_density(system, intact, deformations, point)
    })
}

/// Strain energy density of one point, see [`strain_energy_density`].
pub fn point_energy_density(
    system: &BondSystem,
    intact: &[bool],
    deformations: &[BondDeformation],
    point: u32,
) -> f64 {
    let bonds = system
        .bonds
        .incidence
        .of(point)
        .iter()
        .map(|&bond| bond as usize);
    let energy: f64 = bonds
        .filter(|&bond| intact[bond])
        .map(|bond| system.element(bond).energy(&deformations[bond]))
        .sum();
    0.5 * energy / system.cloud.volumes[point as usize]
}

fn gather(system: &BondSystem, value: impl Fn(u32) -> f64) -> Vec<f64> {
    (0..system.cloud.len() as u32).map(value).collect()
}
