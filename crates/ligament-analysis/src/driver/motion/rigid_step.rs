//! Rigid bodies with a mass in implicit steps: Newmark's scheme for their displacements, with their loads and energies.
//!
//! M a' = (1 - d) (F' + M g) + d (F + M g) with the force F of the contacts, the acceleration g without contacts, and q' = q~ + beta dt^2 a'.
//! Divided by 1 - d this is a spring and a force on the body in an equilibrium of the step, as for the points ([`newmark`](super::newmark)).

use ligament_model::surface::Vector;
use ligament_model::tensor::{dot, minus};

use super::newmark::Newmark;
use crate::balanced::Balanced;
use crate::contact::{ContactProblem, RigidMotion, RigidRates, add};
use crate::load_program::RigidLoad;
use crate::state::State;

/// A rigid body with a mass.
struct Free {
    /// Number among all rigid bodies.
    body: usize,
    mass: f64,
    /// Acceleration without contacts, m/s^2.
    acceleration: Vector,
}

/// Rigid bodies with a mass of a problem.
fn free(problem: &ContactProblem) -> impl Iterator<Item = Free> {
    let bodies = problem.rigid_bodies.iter().enumerate();
    bodies.filter_map(|(body, it)| match it.motion {
        RigidMotion::Prescribed { .. } => None,
        RigidMotion::Free {
            mass, acceleration, ..
        } => Some(Free {
            body,
            mass,
            acceleration,
        }),
    })
}

impl Free {
    /// Force of contacts and of the own acceleration in a balanced state, N.
    fn force(&self, problem: &ContactProblem, balanced: &Balanced) -> Vector {
        let mut force = balanced.touching.forces_on_rigid_bodies(problem)[self.body];
        add(&mut force, self.mass, self.acceleration);
        force
    }
}

/// Springs and forces on the bodies in a step from a balanced state; the springs alone without one.
pub(super) fn loads(
    problem: &ContactProblem,
    scheme: &Newmark,
    from: Option<(&State, &Balanced, &[RigidRates])>,
) -> Vec<RigidLoad> {
    let of_body = |it: Free| {
        let stiffness = it.mass * scheme.acceleration() / (1.0 - scheme.dissipation);
        let mut force = Vector::default();
        if let Some((state, balanced, rates)) = from {
            add(
                &mut force,
                stiffness,
                predicted(scheme, state, rates, it.body),
            );
            add(&mut force, it.mass, it.acceleration);
            add(&mut force, scheme.of_start(), it.force(problem, balanced));
        }
        RigidLoad {
            body: it.body,
            stiffness,
            force,
        }
    };
    free(problem).map(of_body).collect()
}

/// Rates after a step from a state and its rates to another state.
pub(super) fn after(
    problem: &ContactProblem,
    scheme: &Newmark,
    (before, rates): (&State, &[RigidRates]),
    now: &State,
) -> Vec<RigidRates> {
    let mut after = rates.to_vec();
    let (dt, gamma) = (scheme.step, scheme.gamma());
    for it in free(problem) {
        let RigidRates {
            velocity,
            acceleration,
            ..
        } = &mut after[it.body];
        let from = predicted(scheme, before, rates, it.body);
        let changed = minus(displacement(now, it.body), from);
        add(velocity, dt * (1.0 - gamma), *acceleration);
        *acceleration = changed.map(|it| scheme.acceleration() * it);
        add(velocity, dt * gamma, *acceleration);
    }
    after
}

/// Work of contacts and accelerations on the bodies over a step, J.
pub(super) fn work(
    problem: &ContactProblem,
    before: (&State, &Balanced),
    now: (&State, &Balanced),
) -> f64 {
    let on_body = |it: Free| {
        let [from, to] = [before.0, now.0].map(|state| displacement(state, it.body));
        let mut mean = it.force(problem, before.1).map(|force| 0.5 * force);
        add(&mut mean, 0.5, it.force(problem, now.1));
        dot(mean, minus(to, from))
    };
    free(problem).map(on_body).fold(0.0, |sum, it| sum + it)
}

/// Displacement q~ of a body that the rates of a state predict for the end of a step.
fn predicted(scheme: &Newmark, state: &State, rates: &[RigidRates], body: usize) -> Vector {
    let RigidRates {
        velocity,
        acceleration,
        ..
    } = rates[body];
    let (dt, beta) = (scheme.step, scheme.beta());
    let mut place = displacement(state, body);
    add(&mut place, dt, velocity);
    add(&mut place, (0.5 - beta) * dt * dt, acceleration);
    place
}

fn displacement(state: &State, body: usize) -> Vector {
    state
        .rigid
        .get(body)
        .copied()
        .unwrap_or_default()
        .displacement
}
