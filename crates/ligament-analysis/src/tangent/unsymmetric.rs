//! Direct solution without symmetry, L U, for forces that are not those of an energy.

use std::sync::Arc;
use std::time::Instant;

use ligament_linalg::{FactorError, GeneralMatrix, Inertia, Lu};

use super::TangentSolver;
use crate::breakage::Breakage;
use crate::costs::Costs;
use crate::state::State;
use crate::stiffness::Stiffness;
use ligament_model::thermal::ThermalStrain;

/// A direct solver for stiffnesses without symmetry, of bonds that do not break.
pub(crate) struct UnsymmetricSolver {
    stiffness: Arc<Stiffness>,
    factor: Option<Lu>,
}

impl UnsymmetricSolver {
    /// A solver without a factor yet.
    pub(crate) fn new(stiffness: Arc<Stiffness>) -> Self {
        Self {
            stiffness,
            factor: None,
        }
    }

    /// Derivatives of the internal forces by the unknowns; a held one stands alone.
    fn matrix(&self, state: &State) -> GeneralMatrix {
        let (system, unknowns) = (self.stiffness.system(), self.stiffness.unknowns());
        let free = |dof: usize| unknowns.number(dof).filter(|_| !state.held[dof]);
        let mut entries = Vec::new();
        system.add_derivatives(&state.intact, &mut |row, column, value| {
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

impl TangentSolver for UnsymmetricSolver {
    fn follow(
        &mut self,
        breakage: &Breakage,
        _: &State,
        _: ThermalStrain<'_>,
        _: &mut Costs,
    ) -> Option<Vec<f64>> {
        if !breakage.bonds.is_empty() {
            self.forget();
        }
        None
    }

    fn weaken(&mut self, _: &State, _: &mut Costs) {
        self.forget();
    }

    fn prepare(&mut self, state: &State, costs: &mut Costs) -> Result<Vec<usize>, FactorError> {
        if self.factor.is_none() {
            let start = Instant::now();
            let matrix = self.matrix(state);
            costs.assembly += start.elapsed();
            let start = Instant::now();
            self.factor = Some(Lu::factorise(&matrix)?);
            costs.factorisation += start.elapsed();
            costs.factorisations += 1;
        }
        Ok(Vec::new())
    }

    fn solve(&mut self, state: &State, mut force: Vec<f64>, costs: &mut Costs) -> Vec<f64> {
        let start = Instant::now();
        let dofs = self.stiffness.unknowns().degrees_of_freedom().iter();
        for (value, &dof) in force.iter_mut().zip(dofs) {
            if state.held[dof as usize] {
                *value = 0.0;
            }
        }
        if let Some(factor) = &mut self.factor {
            factor.solve_in_place(&mut force);
        }
        costs.solves += 1;
        costs.solve += start.elapsed();
        force
    }

    fn is_changed(&self) -> bool {
        false
    }

    fn forget(&mut self) {
        self.factor = None;
    }

    fn inertia(&self) -> Option<Inertia> {
        None
    }
}
