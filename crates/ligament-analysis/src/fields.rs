//! Fields at the points, for output and probes.

use ligament_model::contact::ClosedPair;
use ligament_model::deformation::Deformations;
use ligament_model::failure::{Criteria, Weakened};
use ligament_model::{Bonds, UnbrokenBonds};

use crate::state::State;

/// Damage of every point (NHPD eq. 17): 1 - (sum over its intact bonds of Omega alpha)/(sum over all its bonds).
///
/// The bonds are the bonds of the start: bonds cut by a pre-crack are no damage, and a point that lost all its bonds to one has damage
/// 0.
pub fn damage(system: &dyn Bonds, intact: &[bool]) -> Vec<f64> {
    gather(system, |point| point_damage(system, intact, point))
}

/// Damage of one point, see [`damage`].
pub fn point_damage(system: &dyn Bonds, intact: &[bool], point: u32) -> f64 {
    let (mut broken, mut all) = (0.0, 0.0);
    let weights = &system.weights;
    for &bond in system.incidence.at(point) {
        let weight = weights[bond as usize];
        all += weight;
        if !intact[bond as usize] {
            broken += weight;
        }
    }
    // A sum over broken bonds gives exactly 0 for an intact point.
    if all > 0.0 { broken / all } else { 0.0 }
}

/// Damage of every point by one failure mode (MPPD eqs 47, 48 and 51, as corrected): 1 - sum mu Omega alpha V_B / sum Omega alpha
/// V_B over its bonds, with the force factor mu of the criteria of this mode.
///
/// The modes are d_t of opening, d_c of crushing and d_gamma of sliding. A broken bond counts as lost (mu = 0) for the criterion by
/// which it broke; with brittle bonds these are the shares of [`damage`], by volume.
pub fn damage_by(
    system: &dyn Bonds,
    criteria: &Criteria,
    state: &State,
    way: Weakened,
) -> Vec<f64> {
    gather(system, |point| {
        point_damage_by(system, criteria, state, way, point)
    })
}

/// Damage of one point by one failure mode, see [`damage_by`].
pub fn point_damage_by(
    system: &dyn Bonds,
    criteria: &Criteria,
    state: &State,
    way: Weakened,
    point: u32,
) -> f64 {
    let fails_so = |criterion: usize| criteria.list[criterion].measure.weakens().shows_as(way);
    let force = |bond: usize| {
        let broke_so = state.broken_by[bond].is_some_and(|it| fails_so(usize::from(it)));
        if broke_so {
            return 0.0;
        }
        let such = (0..criteria.list.len()).filter(|&criterion| fails_so(criterion));
        such.map(|criterion| state.softening.bond(criteria, criterion, bond).force)
            .fold(1.0, f64::min)
    };
    let (mut lost, mut all) = (0.0, 0.0);
    let (families, volumes, weights) = (system.families(), &system.volumes, &system.weights);
    for &bond in families.incidence.at(point) {
        let volume = volumes[families.neighbour(bond, point) as usize];
        let weight = weights[bond as usize] * volume;
        all += weight;
        lost += (1.0 - force(bond as usize)) * weight;
    }
    if all > 0.0 { lost / all } else { 0.0 }
}

/// Energy dissipated at every point, J/m^3: its share of the dissipated energy of each bond, mostly a half, over its volume.
pub fn dissipated_energy_density(system: &dyn Bonds, dissipated: &[f64]) -> Vec<f64> {
    gather(system, |point| {
        let bonds = system.incidence.at(point).iter();
        let shares = bonds.map(|&bond| {
            let is_first = system.ends[bond as usize][0] == point;
            system.rigidities().share(bond, is_first) * dissipated[bond as usize]
        });
        shares.sum::<f64>() / system.volumes[point as usize]
    })
}

/// Strain energy density of every point, J/m^3: its share of the energy of its bonds, mostly a half, and half of the energy of its closed
/// pairs, over its volume.
pub fn strain_energy_density(
    system: &dyn Bonds,
    bonds: UnbrokenBonds<'_>,
    deformations: &Deformations,
    closed: &[ClosedPair],
) -> Vec<f64> {
    let mut densities = gather(system, |point| {
        system.energy_density(bonds, deformations, point)
    });
    for it in closed {
        for end in it.pair.ends.map(|end| end as usize) {
            densities[end] += 0.5 * it.energy() / system.volumes[end];
        }
    }
    densities
}

/// Strain energy density of one point, see [`strain_energy_density`].
pub fn point_energy_density(
    system: &dyn Bonds,
    bonds: UnbrokenBonds<'_>,
    deformations: &Deformations,
    closed: &[ClosedPair],
    point: u32,
) -> f64 {
    let volume = system.volumes[point as usize];
    let of_point = closed.iter().filter(|it| it.pair.ends.contains(&point));
    let of_contact = of_point.map(|it| 0.5 * it.energy() / volume);
    of_contact.fold(
        system.energy_density(bonds, deformations, point),
        |sum, it| sum + it,
    )
}

fn gather(system: &dyn Bonds, value: impl Fn(u32) -> f64) -> Vec<f64> {
    (0..system.n_points() as u32).map(value).collect()
}
