//! Direct solution with an unsymmetric factor, L U, for forces without an energy.

use std::io::Read;
use std::sync::Arc;
use std::time::Instant;

use ligament_linalg::{FactorError, GeneralMatrix, Inertia, Lu};

use super::factor_record::FactorRecord;
use super::{AllowedResidual, TangentSolver, Unsolved};
use crate::breakage::Breakage;
use crate::checkpoint::CheckpointError;
use crate::contact::resisting::Resisting;
use crate::costs::Costs;
use crate::serial::{Serial, Sink};
use crate::state::State;
use crate::stiffness::Stiffness;
use ligament_model::thermal::ThermalStrain;

/// A direct solver for unsymmetric stiffnesses, of bonds that do not break.
pub(crate) struct UnsymmetricSolver {
    stiffness: Arc<Stiffness>,
    factor: Option<Lu>,
    /// Bonds and supports from which the factor was computed.
    making: FactorRecord,
}

impl UnsymmetricSolver {
    /// Builds a solver without a factor.
    pub(crate) fn new(stiffness: Arc<Stiffness>) -> Self {
        Self {
            stiffness,
            factor: None,
            making: FactorRecord::default(),
        }
    }

    /// Derivatives of the internal forces by the unknowns; fixed unknowns are decoupled, with a unit diagonal.
    fn matrix(&self, FactorRecord { intact, held, .. }: &FactorRecord) -> GeneralMatrix {
        let (system, unknowns) = (self.stiffness.system(), self.stiffness.unknowns());
        let free = |dof: usize| unknowns.number(dof).filter(|_| !held[dof]);
        let mut entries = Vec::new();
        system.add_derivatives(intact, &mut |row, column, value| {
            if let (Some(row), Some(column)) = (free(row), free(column)) {
                entries.push((row, column, value));
            }
        });
        let all = unknowns.degrees_of_freedom().iter().enumerate();
        entries.extend(
            all.filter(|&(_, &dof)| held[dof as usize])
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
            self.discard();
        }
        None
    }

    fn update_for_softening(&mut self, _: &State, _: &mut Costs) {
        self.discard();
    }

    /// Only bonds with an energy have faces that close.
    fn close(&mut self, _: Vec<Resisting>, _: &mut Costs) {}

    fn prepare(&mut self, state: &State, costs: &mut Costs) -> Result<Vec<usize>, FactorError> {
        if self.factor.is_none() {
            let start = Instant::now();
            let making = FactorRecord::begun(state, state.held.clone(), Vec::new());
            let matrix = self.matrix(&making);
            costs.assembly += start.elapsed();
            let start = Instant::now();
            self.factor = Some(Lu::factorise(&matrix)?);
            self.making = making;
            costs.factorisation += start.elapsed();
            costs.factorisations += 1;
        }
        Ok(Vec::new())
    }

    fn solve(
        &mut self,
        state: &State,
        mut force: Vec<f64>,
        _: AllowedResidual,
        costs: &mut Costs,
    ) -> Result<Vec<f64>, Unsolved> {
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
        Ok(force)
    }

    fn tolerance(&self) -> Option<f64> {
        None
    }

    fn is_changed(&self) -> bool {
        false
    }

    fn discard(&mut self) {
        self.factor = None;
    }

    fn inertia(&self) -> Option<Inertia> {
        None
    }

    fn write(&self, out: &mut dyn Sink) {
        (self.factor.is_some().then(|| self.making.clone())).write(out);
    }

    fn restore(&mut self, from: &mut dyn Read) -> Result<(), CheckpointError> {
        let Some(making) = Option::<FactorRecord>::read(from)? else {
            return Ok(());
        };
        if !making.fits(self.stiffness.system(), self.stiffness.unknowns()) {
            return Err(CheckpointError::OtherModel);
        }
        let factor = Lu::factorise(&self.matrix(&making));
        self.factor = Some(factor.map_err(|_| CheckpointError::OtherArithmetic)?);
        self.making = making;
        Ok(())
    }
}
