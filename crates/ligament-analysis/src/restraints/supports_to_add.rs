//! Rigid motions of a part that restraints leave free, and the supports added for them.

use ligament_model::Bonds;
use ligament_model::interface::FreeShapes;
use nalgebra::{DMatrix, SymmetricEigen};

use super::Restraints;

/// Stiffness of a rigid motion, relative to the largest that the restraints of a part could have, below which it is free: well
/// above the rounding of the sums, and below the square of 1e-3 of the size of the part.
const FREE: f64 = 1e-9;

/// Degrees of freedom to fix so that a connected part cannot move rigidly, where its restraints may resist some of its motions.
///
/// `is_fixed` returns whether a degree of freedom is prescribed by supports, loads or earlier added supports; `can_hold` whether it
/// has a stiffness. `points` are the owned points of the part; the result has degrees of freedom of the body. Collective.
pub fn missing_supports(
    system: &dyn Bonds,
    restraints: &Restraints,
    points: &[u32],
    is_fixed: &dyn Fn(usize) -> bool,
    can_hold: &dyn Fn(usize) -> bool,
) -> Vec<usize> {
    let layout = system.layout;
    if restraints.is_empty() {
        return system.holds(points, is_fixed, can_hold);
    }
    let is_still = |dof: usize| is_fixed(dof) || restraints.holds(layout, dof);
    let FreeShapes {
        degrees_of_freedom: dofs,
        can_hold,
        motions,
    } = system.free_shapes(points, &is_still, can_hold);
    let mut free = unrestrained(system, restraints, &dofs, motions);
    let mut holds = Vec::new();
    while !free.is_empty() {
        let reach = |place: usize| free.iter().map(|it| it[place].powi(2)).sum::<f64>();
        let candidates =
            (0..dofs.len()).filter(|&place| can_hold[place] && !holds.contains(&dofs[place]));
        let best = candidates.max_by(|&one, &other| reach(one).total_cmp(&reach(other)));
        let Some(place) = best.filter(|&place| reach(place) > 0.0) else {
            break;
        };
        holds.push(dofs[place]);
        free = motions_after_fixing(free, place);
    }
    holds
}

/// Combinations of motions (by degree of freedom of the part) that no restraint resists.
fn unrestrained(
    system: &dyn Bonds,
    restraints: &Restraints,
    dofs: &[usize],
    motions: Vec<Vec<f64>>,
) -> Vec<Vec<f64>> {
    let count = motions.len();
    let n_components = system.layout.components.len();
    let place = |dof: u32| {
        let in_body = system.subdomain.index_in_body(dof as usize, n_components);
        dofs.binary_search(&in_body).ok()
    };
    let restraints = restraints.acting_on(|dof| place(dof).is_some());
    if count == 0 || restraints.is_empty() {
        return motions;
    }
    let value = |motion: &[f64], dof: u32| place(dof).map_or(0.0, |place| motion[place]);
    let mut stiffness = DMatrix::<f64>::zeros(count, count);
    let mut largest: f64 = 0.0;
    for restraint in restraints {
        let own: Vec<Vec<f64>> = (motions.iter())
            .map(|motion| {
                let of_restraint = restraint.degrees_of_freedom.iter();
                of_restraint.map(|&dof| value(motion, dof)).collect()
            })
            .collect();
        let n = restraint.degrees_of_freedom.len();
        for (row, motion) in own.iter().enumerate() {
            let forces: Vec<f64> = restraint.forces(motion).map(|(_, force)| force).collect();
            for (column, other) in own.iter().enumerate() {
                stiffness[(row, column)] +=
                    forces.iter().zip(other).map(|(f, u)| f * u).sum::<f64>();
            }
            let sizes = motion.iter().enumerate();
            let alone = sizes.map(|(place, u)| restraint.stiffness[place * (n + 1)] * u * u);
            largest = largest.max(alone.sum());
        }
    }
    let modes = SymmetricEigen::new(stiffness);
    let is_free = |mode: &usize| modes.eigenvalues[*mode] <= FREE * largest;
    let combined = |mode: usize| {
        let shares = modes.eigenvectors.column(mode);
        let at = |place: usize| (0..count).map(|it| shares[it] * motions[it][place]).sum();
        (0..dofs.len()).map(at).collect()
    };
    (0..count).filter(is_free).map(combined).collect()
}

/// Motions that remain when one degree of freedom of the part is fixed.
fn motions_after_fixing(mut motions: Vec<Vec<f64>>, place: usize) -> Vec<Vec<f64>> {
    let most = (0..motions.len()).max_by(|&one, &other| {
        motions[one][place]
            .abs()
            .total_cmp(&motions[other][place].abs())
    });
    let Some(most) = most else {
        return motions;
    };
    let held = motions.swap_remove(most);
    for motion in &mut motions {
        let share = motion[place] / held[place];
        for (value, of_held) in motion.iter_mut().zip(&held) {
            *value -= share * of_held;
        }
    }
    motions
}
