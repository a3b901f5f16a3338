//! Balance of the external forces: supports, loads and added supports have no resultant on any part of a body.

use super::equations::Equations;
use crate::balanced::Balanced;
use crate::connectivity::Fragments;
use crate::contact::faces;
use crate::state::State;
use crate::unbalanced::Unbalanced;

/// Resultant, relative to the sum of the sizes of the external forces on a part and the largest force at a point of the body, above
/// which the forces do not balance: self-balanced loads are accepted to the same tolerance, and solutions are far more accurate.
const BALANCED: f64 = 1e-6;

/// Number of sums along one axis.
const SUMS: usize = 3;

/// Resultant along one axis, sum of the sizes of the forces, and sum of their rounding errors, N.
type Sum = [f64; SUMS];

/// First part of the body on which the external forces of a state do not balance along some axis.
///
/// Moments are not checked, except by the residual: bonds that resist shear between points without rotations exert couples.
pub(super) fn imbalance(
    equations: &Equations,
    state: &State,
    balanced: &Balanced,
    fragments: &Fragments,
) -> Option<Unbalanced> {
    let layout = equations.layout();
    let n_components = layout.components.len();
    let external = external_forces(equations, state, balanced);
    let surfaces = &equations.contact.surfaces;
    let rounding = (equations.accuracy).rounding(layout, state, (surfaces, &balanced.touching));
    let mut sums = vec![Sum::default(); n_components * fragments.len()];
    let of_points = external
        .chunks(n_components)
        .zip(rounding.chunks(n_components));
    let subdomain = equations.subdomain();
    let of_each = (0..).zip(of_points.zip(&fragments.of_point));
    let owned = of_each.filter(|(point, _)| subdomain.owns(*point));
    for (_, ((forces, rounding), &fragment)) in owned {
        let of_part = &mut sums[n_components * fragment as usize..];
        for ((sum, force), rounding) in of_part.iter_mut().zip(forces).zip(rounding) {
            let of_point = [*force, force.abs(), *rounding];
            sum.iter_mut()
                .zip(of_point)
                .for_each(|(it, part)| *it += part);
        }
    }
    subdomain.all_reduce_sum(sums.as_flattened_mut());
    let of_body = equations.largest_force(balanced.internal.force_scale);
    let bound = equations.accuracy.bound(equations.loaded(state));
    let is_off = |(place, [resultant, size, rounding]): &(usize, &Sum)| {
        let is_force = !layout.components[place % n_components].is_rotation();
        // A resultant that is not a number is out of balance.
        let is_balanced = resultant.abs() <= BALANCED * (size + of_body).min(bound) + rounding;
        is_force && !is_balanced
    };
    let (place, &[resultant, size, _]) = sums.iter().enumerate().find(is_off)?;
    let extent = fragments.extents[place / n_components];
    Some(Unbalanced::NoForceBalance {
        component: layout.components[place % n_components],
        resultant,
        size,
        points: extent.n_points,
        first: extent.first,
    })
}

/// Forces on the points of each part by loads, supports and other parts, shape (n_degrees_of_freedom).
fn external_forces(equations: &Equations, state: &State, balanced: &Balanced) -> Vec<f64> {
    let (problem, layout) = (&equations.problem, equations.layout());
    // External forces at free points are the given loads, at other points the internal forces.
    let mut external = balanced.internal.values.clone();
    let dofs = equations.degrees_of_freedom();
    let given = problem.loads.forces(state.load_factor, dofs);
    for (&dof, given) in dofs.iter().zip(given) {
        if !state.held[dof as usize] && !problem.loads.reacts_at(dof as usize) {
            external[dof as usize] = given;
        }
    }
    let closed = balanced.closed.iter();
    let closed_forces = closed.flat_map(|it| faces::end_forces(it, layout));
    // Forces that other parts exert through closed faces are external to a part.
    for (dof, force) in closed_forces {
        external[dof] -= force;
    }
    let surfaces = equations.contact.surfaces.problem();
    let by_surfaces = balanced.touching.forces(surfaces, external.len());
    for (sum, force) in external.iter_mut().zip(by_surfaces) {
        *sum += force;
    }
    external
}
