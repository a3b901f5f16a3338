//! Equilibrium under forces that are not those of an energy: their stiffness has no symmetry, and is factorised as L U.

use std::time::Instant;

use ligament_linalg::{FactorError, GeneralMatrix, Lu};

use super::{Balanced, Equilibrium, ITERATION_LIMIT, RESIDUAL_TOLERANCE, Unbalanced};
use crate::history::{Observer, ObserverError};
use crate::state::State;

impl Equilibrium<'_> {
    /// Brings a state of unbroken bonds into equilibrium. The forces are linear: one solution gets there, and the residual tells.
    pub(super) fn balance_unsymmetric(
        &mut self,
        state: &mut State,
        observer: &mut dyn Observer,
    ) -> Result<Result<Balanced, Unbalanced>, ObserverError> {
        self.prescribe(state);
        let mut iterations = 0;
        loop {
            let balanced = self.measure(state);
            let residual = balanced.residual;
            if iterations > 0 {
                observer.iteration(iterations, residual, balanced.stored_energy)?;
            }
            if residual <= RESIDUAL_TOLERANCE {
                return Ok(Ok(Balanced {
                    iterations,
                    ..balanced
                }));
            }
            if iterations == ITERATION_LIMIT {
                return Ok(Err(Unbalanced::NotConverged {
                    residual,
                    iterations,
                }));
            }
            let mut correction = self.residual_forces(state, &balanced.internal);
            if let Err(error) = self.solve_unsymmetric(state, &mut correction) {
                return Ok(Err(Unbalanced::NoFactor(error)));
            }
            self.add_correction(state, &correction);
            iterations += 1;
        }
    }

    /// Solves for a correction of the unknowns (n_unknowns) in place.
    fn solve_unsymmetric(
        &mut self,
        state: &State,
        correction: &mut [f64],
    ) -> Result<(), FactorError> {
        let mut factor = match self.unsymmetric.take() {
            Some(factor) => factor,
            None => self.factorise_unsymmetric(state)?,
        };
        let start = Instant::now();
        factor.solve_in_place(correction);
        self.unsymmetric = Some(factor);
        self.stiffness.costs.solves += 1;
        self.stiffness.costs.solve += start.elapsed();
        Ok(())
    }

    fn factorise_unsymmetric(&mut self, state: &State) -> Result<Lu, FactorError> {
        let start = Instant::now();
        let matrix = self.general_stiffness(state);
        self.stiffness.costs.assembly += start.elapsed();
        let start = Instant::now();
        let factor = Lu::factorise(&matrix)?;
        self.stiffness.costs.factorisation += start.elapsed();
        self.stiffness.costs.factorisations += 1;
        Ok(factor)
    }

    /// Derivatives of the internal forces by the unknowns; a held one stands alone.
    fn general_stiffness(&self, state: &State) -> GeneralMatrix {
        let unknowns = self.unknowns();
        let free = |dof: usize| unknowns.number(dof).filter(|_| !state.held[dof]);
        let mut entries = Vec::new();
        self.system
            .add_derivatives(&state.intact, &mut |row, column, value| {
                if let (Some(row), Some(column)) = (free(row), free(column)) {
                    entries.push((row, column, value));
                }
            });
        let held = unknowns.degrees_of_freedom().iter().enumerate();
        entries.extend(
            held.filter(|&(_, &dof)| state.held[dof as usize])
                .map(|(unknown, _)| (unknown, unknown, 1.0)),
        );
        GeneralMatrix::of_entries(unknowns.len(), entries)
    }
}
