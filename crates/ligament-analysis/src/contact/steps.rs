//! Contact between surfaces along the steps of a run: its energies, and the steps of rigid bodies with a mass.

use ligament_model::surface::{Pose, Touch, Vector};
use ligament_model::tensor::{dot, minus};

use super::problem::ContactProblem;
use super::rigid_body::{Resultant, RigidBody, RigidMotion, RigidRates};
use super::surfaces::{LastTouching, Touching};

/// Energies of a step, J.
#[derive(Debug, Clone, Copy, Default)]
pub struct SurfaceWork {
    /// Energy stored at the end of the step.
    pub stored: f64,
    /// Energy dissipated by friction and by the begin and end of contacts.
    pub dissipated: f64,
    /// Work on rigid bodies: by prescribed motions, and by the accelerations of free bodies.
    pub driving: f64,
    /// Excess of the trapezoidal rule over the true work, because contacts begin and end without force within a step.
    pub excess: f64,
}

/// Contact in the last state of a run, from which the energies of the next step are counted.
#[derive(Debug, Clone, Default)]
pub struct SurfaceEnergy {
    /// Degrees of freedom that contacts may load, ascending.
    degrees_of_freedom: Vec<u32>,
    last: LastTouching,
}

impl SurfaceEnergy {
    /// Energies that are counted from a given contact on.
    pub fn new(problem: &ContactProblem, last: LastTouching) -> Self {
        Self {
            degrees_of_freedom: problem.degrees_of_freedom(),
            last,
        }
    }

    /// Moves to the next contact, of a body with `n` degrees of freedom, with works by the trapezoidal rule.
    pub fn follow(
        &mut self,
        problem: &ContactProblem,
        now: &LastTouching,
        n: usize,
    ) -> SurfaceWork {
        if problem.is_empty() {
            return SurfaceWork::default();
        }
        let both = [&self.last, now];
        let forces = both.map(|it| it.touching().forces(problem, n));
        let motions = both.map(|it| it.motions(n));
        let way = |dof: usize| motions[1][dof] - motions[0][dof];
        let dofs = self.degrees_of_freedom.iter().map(|&dof| dof as usize);
        let on_body = dofs.fold(0.0, |sum, dof| {
            sum + 0.5 * (forces[0][dof] + forces[1][dof]) * way(dof)
        });
        let loads = both.map(|it| it.touching().on_rigid_bodies(problem));
        let (mut on_driven, mut on_free, mut of_accelerations) = (0.0, 0.0, 0.0);
        for (body, it) in problem.rigid_bodies.iter().enumerate() {
            let [then, place] = both.map(|it| it.touching().pose(body));
            let way = minus(place.displacement, then.displacement);
            let turn = minus(place.rotation, then.rotation);
            let half = |[force, moment]: [Vector; 2]| dot(force, way) + dot(moment, turn);
            let work = 0.5 * (half(loads[0][body]) + half(loads[1][body]));
            match it.motion {
                RigidMotion::Prescribed { .. } => on_driven += work,
                RigidMotion::Free {
                    mass, acceleration, ..
                } => {
                    on_free += work;
                    of_accelerations += mass * dot(acceleration, way);
                }
            }
        }
        let [before, after] = both.map(LastTouching::touching);
        let (then, stored) = (before.energy(), after.energy());
        let work = SurfaceWork {
            stored,
            dissipated: -(on_body + on_driven + on_free) - (stored - then),
            driving: of_accelerations - on_driven,
            excess: excess(problem, [before, after], &way),
        };
        self.last = now.clone();
        work
    }
}

impl ContactProblem {
    /// Rates of the rigid bodies at time zero under the loads of the contacts then.
    pub fn rates_at_start(&self, touching: &Touching) -> Vec<RigidRates> {
        let loads = touching.on_rigid_bodies(self);
        let rates = |(body, load): (&RigidBody, Resultant)| {
            let before = match body.motion {
                RigidMotion::Prescribed { .. } => RigidRates::default(),
                RigidMotion::Free { velocity, .. } => RigidRates {
                    velocity,
                    ..RigidRates::default()
                },
            };
            body.motion.accelerated(0.0, &before, load)
        };
        self.rigid_bodies.iter().zip(loads).map(rates).collect()
    }

    /// Moves the free rigid bodies by a step (s) of velocity Verlet.
    pub fn advance(&self, step: f64, rates: &[RigidRates], poses: &mut Vec<Pose>) {
        poses.resize(self.rigid_bodies.len(), Pose::default());
        for ((body, rates), pose) in self.rigid_bodies.iter().zip(rates).zip(poses) {
            body.motion.advance(step, rates, pose);
        }
    }

    /// Moves the rates of the rigid bodies to the end of a step (s) of velocity Verlet, with the contacts there.
    pub fn accelerate(&self, step: f64, touching: &Touching, rates: &mut [RigidRates]) {
        let loads = touching.on_rigid_bodies(self);
        for ((body, load), rates) in self.rigid_bodies.iter().zip(loads).zip(rates) {
            *rates = body.motion.accelerated(step, rates, load);
        }
    }

    /// Kinetic energy of the free rigid bodies, J: with the velocities half a step (s) before and after, or at the time with a step of zero.
    pub fn kinetic_energy(&self, step: f64, rates: &[RigidRates]) -> f64 {
        let both = self.rigid_bodies.iter().zip(rates);
        both.map(|(body, rates)| body.motion.kinetic_energy(step, rates))
            .fold(0.0, |sum, it| sum + it)
    }
}

/// Sum of 1/2 N (a - d) over the contacts that began, with the pressing force N, the approach a of the surfaces along the normal and the
/// depth d that it explains, minus the sum over the contacts that ended; for the motions of the degrees of freedom in the step.
fn excess(
    problem: &ContactProblem,
    [before, now]: [&Touching; 2],
    way: &dyn Fn(usize) -> f64,
) -> f64 {
    let mut sum = 0.0;
    for (index, contact) in problem.contacts.iter().enumerate() {
        let carried = contact.rigid_body.map(|body| {
            let [then, place] = [before, now].map(|it| it.pose(body).displacement);
            minus(place, then)
        });
        let carried = carried.unwrap_or_default();
        let [ended, begun] = [before, now].map(|it| it.touches_of(index));
        for (one, other, sign) in [(begun, ended, 1.0), (ended, begun, -1.0)] {
            for it in only_in(one, other) {
                let row = contact.surfaces.row(it, it.normal);
                let moved: f64 = row.iter().map(|(dof, factor)| factor * way(*dof)).sum();
                let approach = sign * (dot(carried, it.normal) - moved);
                let force = it.stiffness * it.depth();
                sum += sign * 0.5 * force * (approach - it.depth());
            }
        }
    }
    sum
}

/// Pressed contacts of a list whose integration points are not pressed in another one; both are in the order of their numbers.
fn only_in<'a>(touches: &'a [Touch], others: &'a [Touch]) -> impl Iterator<Item = &'a Touch> {
    let pressed = touches.iter().filter(|it| it.depth() > 0.0);
    pressed.filter(|it| {
        let place = others.binary_search_by_key(&it.place, |other| other.place);
        !place.is_ok_and(|place| others[place].depth() > 0.0)
    })
}
