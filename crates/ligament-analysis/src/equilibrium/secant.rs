//! Equilibrium of bonds that soften: Newton-Raphson with their secant stiffness.

use super::anderson::Mixing;
use super::{Balanced, Equilibrium, LARGEST_RESIDUAL, RESIDUAL_TOLERANCE, Unbalanced};
use crate::breakage::Breakage;
use crate::history::{Observer, ObserverError};
use crate::state::State;
use crate::unknowns::{COMPONENTS, Component};

/// Iterations after which a solve is given up.
const ITERATION_LIMIT: usize = 1000;

/// Iterations after which corrections are mixed. The first ones alone decide which bonds soften: mixed ones go too far, and take
/// bonds past their limits that equilibrium would spare.
const MIXING_FROM: usize = 15;

/// Iterations after which bonds keep the damage of the iterates: what has not settled by then is a sudden fall, in which bonds
/// take turns. Damage that only grows comes to an end.
const ONE_WAY_AFTER: usize = 150;

impl Equilibrium<'_> {
    /// Brings a state with softening bonds into equilibrium at its load factor.
    ///
    /// Every iterate decides what is left of the bonds, and K is that of what is left: the secants. These are positive, so that
    /// K is definite where the elastic one is, and each correction solves the equations of the present secants exactly; what
    /// remains as a residual is that the secants moved. It shrinks by a factor an iteration, slower the steeper bonds fall. The
    /// iteration ends by NHPD's energy rule (eq. 21) with a residual below 1e-6, or with one below 1e-10.
    ///
    /// Extremes of iterates do not count unless equilibrium holds ([`Softening::follow`](crate::softening::Softening::follow)).
    pub(super) fn balance_secants(
        &mut self,
        state: &mut State,
        breakage: &Breakage,
        observer: &mut dyn Observer,
    ) -> Result<Result<Balanced, Unbalanced>, ObserverError> {
        self.prescribe(state);
        let mut mechanisms = Vec::new();
        let mut previous_energy = f64::NAN;
        let mut previous_residual = f64::INFINITY;
        let mut iterations = 0;
        let mut mixing = Mixing::new(self.lengths());
        if let Some(correction) = self.stiffness.follow(breakage, state, self.boundary) {
            self.add_correction(state, &correction);
            iterations = 1;
        }
        loop {
            let deformations = self.deformations(state);
            let is_one_way = iterations > ONE_WAY_AFTER;
            let State {
                softening, intact, ..
            } = &mut *state;
            let is_settled = softening.follow(self.criteria, intact, &deformations, is_one_way);
            self.stiffness.weaken(state);
            let mut balanced = self.measure_deformed(state, deformations);
            if iterations > 0 {
                observer.iteration(iterations, balanced.residual, balanced.stored_energy)?;
            }
            let Balanced {
                residual,
                stored_energy: energy,
                ..
            } = balanced;
            let change = ((energy - previous_energy) / energy).abs();
            let energy_settled = change < self.energy_tolerance && residual <= LARGEST_RESIDUAL;
            if residual <= RESIDUAL_TOLERANCE || energy_settled {
                state.softening.settle();
                let forces = [
                    balanced.internal.force_scale,
                    balanced.internal.moment_scale,
                ];
                self.largest_forces = [0, 1].map(|k| self.largest_forces[k].max(forces[k]));
                (balanced.iterations, balanced.mechanisms) = (iterations, mechanisms);
                return Ok(Ok(balanced));
            }
            if iterations == ITERATION_LIMIT {
                return Ok(Err(Unbalanced::NotConverged {
                    residual,
                    iterations,
                }));
            }
            let correction = match self.correction(state, &balanced, &mut mechanisms) {
                Ok(correction) => correction,
                Err(unbalanced) => return Ok(Err(unbalanced)),
            };
            let may_mix = iterations >= MIXING_FROM && !is_one_way && is_settled;
            if !may_mix || residual > previous_residual {
                mixing.restart();
            }
            previous_residual = residual;
            let step = mixing.step(self.at_unknowns(state), correction);
            self.add_correction(state, &step);
            previous_energy = energy;
            iterations += 1;
        }
    }

    /// Displacements and rotations of a state at the unknowns, shape (n_unknowns).
    fn at_unknowns(&self, state: &State) -> Vec<f64> {
        let dofs = self.unknowns().degrees_of_freedom().iter();
        dofs.map(|&dof| state.displacement[dof as usize]).collect()
    }

    /// 1 at displacements and the spacing of the point at rotations, which makes lengths of both, shape (n_unknowns).
    fn lengths(&self) -> Vec<f64> {
        let of = |&dof: &u32| match Component::at(dof as usize) {
            Component::Rotation => self.system.spacing()[dof as usize / COMPONENTS],
            Component::X | Component::Y => 1.0,
        };
        self.unknowns()
            .degrees_of_freedom()
            .iter()
            .map(of)
            .collect()
    }
}
