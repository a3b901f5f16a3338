//! Accelerations and velocities of the points: M a + C v = F - f with central differences.
//!
//! With the velocities v- and v+ in the middles of the steps before and after a time, a = (v+ - v-)/dt and v = (v+ + v-)/2, so that damping alpha M
//! and dashpots are implicit in the velocity: v+ = (M/dt + C/2)^-1 ((M/dt - C/2) v- + F - f).

use std::collections::BTreeMap;

use ligament_model::parallel;
use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

use crate::contact::RigidRates;
use crate::history::Rates;
use crate::motion::MotionProblem;
use crate::vectors::{CHUNK, sum_of_chunks};

/// Masses and damping of a body for a time step.
pub(super) struct Inertia {
    /// Time step, s.
    step: f64,
    /// Mass of each degree of freedom, shape (n_degrees_of_freedom), kg and kg m^2.
    mass: Vec<f64>,
    /// One over the mass of each degree of freedom, zero without a mass, shape (n_degrees_of_freedom).
    inverse: Vec<f64>,
    /// Damping over mass, alpha, 1/s.
    alpha: f64,
    /// Degrees of freedom whose motion is prescribed, ascending.
    prescribed: Vec<u32>,
    dashpots: Vec<Dashed>,
}

/// A point with dashpots.
struct Dashed {
    /// Degrees of freedom of its displacements that are not prescribed.
    degrees_of_freedom: Vec<usize>,
    /// C of these with alpha M on its diagonal, N s/m; zero beyond them.
    damping: Matrix3<f64>,
    /// (M/dt + C/2)^-1, m/(N s).
    inverse: Matrix3<f64>,
}

/// Motions of the points at a time, each of shape (n_degrees_of_freedom).
#[derive(Serialize, Deserialize)]
pub(super) struct Velocities {
    /// Velocities in the middle of the step, m/s and rad/s: before [`Inertia::advance`] of the last one, after it of the next one.
    pub(super) half: Vec<f64>,
    /// Accelerations at the time, m/s^2 and rad/s^2.
    pub(super) acceleration: Vec<f64>,
    /// Rates of the rigid bodies at the time.
    pub(super) rigid: Vec<RigidRates>,
}

impl Velocities {
    /// Velocities (n_degrees_of_freedom) and accelerations for results.
    pub(super) fn rates<'a>(&'a self, velocity: &'a [f64]) -> Rates<'a> {
        Rates {
            velocity,
            acceleration: &self.acceleration,
            rigid: &self.rigid,
        }
    }

    /// Velocities at the time, in the middle between those before and after it, shape (n_degrees_of_freedom).
    pub(super) fn at_time(&self, step: f64) -> Vec<f64> {
        let both = self.half.iter().zip(&self.acceleration);
        both.map(|(half, acceleration)| half - 0.5 * step * acceleration)
            .collect()
    }
}

impl Inertia {
    pub(super) fn new(problem: &MotionProblem, rotary_inertia: f64, alpha: f64, step: f64) -> Self {
        let mass = problem.masses(rotary_inertia);
        let layout = problem.problem.system.layout;
        let mut dampings = BTreeMap::<u32, Matrix3<f64>>::new();
        for it in problem.dashpots.iter() {
            *dampings.entry(it.point).or_default() += it.damping;
        }
        let is_free = |dof: &usize| !problem.problem.loads.is_prescribed(*dof);
        let dashed = |(point, whole): (u32, Matrix3<f64>)| {
            let displacements = layout.range(point).enumerate();
            let displacements =
                displacements.filter(|(_, dof)| !layout.component(*dof).is_rotation());
            let free: Vec<(usize, usize)> = displacements.filter(|(_, dof)| is_free(dof)).collect();
            let mut damping = Matrix3::zeros();
            let mut effective = Matrix3::identity();
            for (row, &(axis, dof)) in free.iter().enumerate() {
                for (column, &(other, _)) in free.iter().enumerate() {
                    damping[(row, column)] = whole[(axis, other)];
                }
                damping[(row, row)] += alpha * mass[dof];
                effective[(row, row)] = mass[dof] / step;
            }
            let inverse = (effective + 0.5 * damping).try_inverse();
            Dashed {
                degrees_of_freedom: free.into_iter().map(|(_, dof)| dof).collect(),
                damping,
                inverse: inverse.expect("a positive definite matrix has an inverse"),
            }
        };
        Self {
            step,
            alpha,
            prescribed: problem.prescribed(),
            dashpots: dampings.into_iter().map(dashed).collect(),
            inverse: (mass.iter())
                .map(|&mass| if mass > 0.0 { 1.0 / mass } else { 0.0 })
                .collect(),
            mass,
        }
    }

    /// Time step, s.
    pub(super) fn step(&self) -> f64 {
        self.step
    }

    /// Degrees of freedom whose motion is prescribed, ascending.
    pub(super) fn prescribed(&self) -> &[u32] {
        &self.prescribed
    }

    /// Whether damping takes energy.
    pub(super) fn is_damped(&self) -> bool {
        self.alpha > 0.0 || !self.dashpots.is_empty()
    }

    /// Velocities v- in the middle of the step before the start, for the velocities at the start (n_degrees_of_freedom) and the forces F - f there:
    /// those from which [`Inertia::advance`] finds the velocities of the start.
    pub(super) fn before_start(&self, velocity: &[f64], unbalanced: &[f64]) -> Vec<f64> {
        let of_dof = |dof: usize| {
            let (inverse, velocity) = (self.inverse[dof], velocity[dof]);
            velocity - 0.5 * self.step * (unbalanced[dof] * inverse - self.alpha * velocity)
        };
        let mut before: Vec<f64> = (0..velocity.len()).map(of_dof).collect();
        for it in &self.dashpots {
            let at_start = it.gathered(velocity);
            let force = it.gathered(unbalanced) - it.damping * at_start;
            for (place, &dof) in it.degrees_of_freedom.iter().enumerate() {
                before[dof] = velocity[dof] - 0.5 * self.step * force[place] / self.mass[dof];
            }
        }
        before
    }

    /// Forces C v of damping by mass and of dashpots (n_degrees_of_freedom), N and N m.
    pub(super) fn damping_forces(&self, velocities: &Velocities, forces: &mut [f64]) {
        let velocity = velocities.at_time(self.step);
        for ((force, mass), velocity) in forces.iter_mut().zip(&self.mass).zip(&velocity) {
            *force = self.alpha * mass * velocity;
        }
        for it in &self.dashpots {
            let damped = it.damping * it.gathered(&velocity);
            for (place, &dof) in it.degrees_of_freedom.iter().enumerate() {
                forces[dof] = damped[place];
            }
        }
    }

    /// Kinetic energy 1/2 v-^T M v+, J.
    pub(super) fn kinetic_energy(&self, velocities: &Velocities) -> f64 {
        let Velocities {
            half, acceleration, ..
        } = velocities;
        sum_of_chunks(half.len(), |range| {
            let of = |dof: usize| {
                let (after, change) = (half[dof], self.step * acceleration[dof]);
                0.5 * self.mass[dof] * (after - change) * after
            };
            range.map(of).sum()
        })
    }

    /// Advances the velocities by a step under external forces F and internal forces f (n_degrees_of_freedom), which become the forces f + M a
    /// + C v that supports and loads balance. Prescribed degrees of freedom move from `displacement` to `ahead` (n_degrees_of_freedom).
    pub(super) fn advance(
        &self,
        velocities: &mut Velocities,
        external: &[f64],
        internal: &mut [f64],
        displacement: &[f64],
        ahead: &[f64],
    ) {
        let Velocities {
            half, acceleration, ..
        } = velocities;
        let of =
            |list: &[u32]| -> Vec<f64> { list.iter().map(|&dof| half[dof as usize]).collect() };
        let prescribed_before = of(&self.prescribed);
        let dashed_before: Vec<[Vector3<f64>; 2]> = (self.dashpots.iter())
            .map(|it| {
                [
                    it.gathered(half),
                    it.gathered(external) - it.gathered(internal),
                ]
            })
            .collect();
        let (step, alpha) = (self.step, self.alpha);
        let (kept, gained) = (
            (1.0 - 0.5 * alpha * step) / (1.0 + 0.5 * alpha * step),
            step / (1.0 + 0.5 * alpha * step),
        );
        let motions = half.chunks_mut(CHUNK).zip(acceleration.chunks_mut(CHUNK));
        let forces = internal.chunks_mut(CHUNK).zip(external.chunks(CHUNK));
        let masses = self.mass.chunks(CHUNK).zip(self.inverse.chunks(CHUNK));
        let chunks = motions.zip(forces).zip(masses);
        parallel::for_each(chunks, |((motions, forces), (mass, inverse))| {
            let ((half, acceleration), (internal, external)) = (motions, forces);
            for place in 0..half.len() {
                let before = half[place];
                let force = external[place] - internal[place];
                let after = kept * before + gained * (inverse[place] * force);
                half[place] = after;
                acceleration[place] = (after - before) / step;
                internal[place] +=
                    mass[place] * (acceleration[place] + 0.5 * alpha * (after + before));
            }
        });
        for (it, [before, unbalanced]) in self.dashpots.iter().zip(dashed_before) {
            let after = it.after(self, before, unbalanced);
            for (place, &dof) in it.degrees_of_freedom.iter().enumerate() {
                half[dof] = after[place];
                acceleration[dof] = (after[place] - before[place]) / step;
                internal[dof] = external[dof];
            }
        }
        self.prescribe(
            (velocities, &prescribed_before),
            internal,
            displacement,
            ahead,
        );
    }

    /// Sets the velocities of prescribed degrees of freedom, given those of the step before (n_prescribed), and the forces of their inertia.
    fn prescribe(
        &self,
        (velocities, before): (&mut Velocities, &[f64]),
        internal: &mut [f64],
        displacement: &[f64],
        ahead: &[f64],
    ) {
        let Velocities {
            half, acceleration, ..
        } = velocities;
        let (step, alpha) = (self.step, self.alpha);
        for (&dof, before) in self.prescribed.iter().zip(before) {
            let dof = dof as usize;
            // The free motion that was computed gave the internal force its inertia, which that of the prescribed motion replaces.
            let (mass, free) = (self.mass[dof], half[dof]);
            let after = (ahead[dof] - displacement[dof]) / step;
            half[dof] = after;
            acceleration[dof] = (after - before) / step;
            internal[dof] += mass * (after - free) * (1.0 / step + 0.5 * alpha);
        }
    }
}

impl Dashed {
    fn gathered(&self, values: &[f64]) -> Vector3<f64> {
        let mut gathered = Vector3::zeros();
        for (place, &dof) in self.degrees_of_freedom.iter().enumerate() {
            gathered[place] = values[dof];
        }
        gathered
    }

    /// Velocities v+ for v- and the forces F - f.
    fn after(
        &self,
        inertia: &Inertia,
        before: Vector3<f64>,
        unbalanced: Vector3<f64>,
    ) -> Vector3<f64> {
        let mut momenta = Vector3::zeros();
        for (place, &dof) in self.degrees_of_freedom.iter().enumerate() {
            momenta[place] = inertia.mass[dof] / inertia.step * before[place];
        }
        self.inverse * (momenta - 0.5 * (self.damping * before) + unbalanced)
    }
}
