//! Forces on rigid bodies with a mass in a state: by the springs and loads of a step, and by contacts.

use ligament_model::surface::Vector;
use ligament_model::tensor::{minus, norm};

use super::residual::{OF_GAPS, RESIDUAL_TOLERANCE};
use crate::contact::{ContactProblem, Touching};
use crate::load_program::RigidLoad;
use crate::state::State;

/// Residual force on each rigid body of some loads in a state, N.
pub(super) fn out_of_balance(
    loads: &[RigidLoad],
    problem: &ContactProblem,
    state: &State,
    touching: &Touching,
) -> Vec<Vector> {
    if loads.is_empty() {
        return Vec::new();
    }
    let of_contacts = touching.forces_on_rigid_bodies(problem);
    let of_load = |load: &RigidLoad| -> Vector {
        let spring = displacement(state, load).map(|it| load.stiffness * it);
        let given = minus(load.force, spring);
        let contact = of_contacts[load.body];
        std::array::from_fn(|axis| given[axis] + contact[axis])
    };
    loads.iter().map(of_load).collect()
}

/// Largest residual force on the bodies of some loads, over the forces in its sum and the force that the rounding of gaps between
/// coordinates of a size (m) causes.
pub(super) fn relative(
    (loads, problem): (&[RigidLoad], &ContactProblem),
    state: &State,
    forces: &[Vector],
    coordinate: f64,
) -> f64 {
    let gap = OF_GAPS / RESIDUAL_TOLERANCE * coordinate;
    let of_load = |(load, force): (&RigidLoad, &Vector)| {
        let spring = load.stiffness * norm(displacement(state, load));
        let own = (problem.contacts.iter()).filter(|it| it.rigid_body == Some(load.body));
        let stiffness: f64 = own.map(|it| it.surfaces.on_rigid_body()[0]).sum();
        match norm(*force) {
            0.0 => 0.0,
            size => size / (spring + norm(load.force)).max(gap * stiffness),
        }
    };
    loads.iter().zip(forces).map(of_load).fold(0.0, f64::max)
}

/// Displacement of the body of a load, m.
fn displacement(state: &State, load: &RigidLoad) -> Vector {
    let pose = state.rigid.get(load.body).copied();
    pose.unwrap_or_default().displacement
}
