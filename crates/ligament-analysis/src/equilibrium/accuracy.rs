//! How near to equilibrium a state is, and how near it is to come.

use super::equations::Equations;
use super::iterate::Iterate;
use super::residual::{Extents, RESIDUAL_TOLERANCE, Residual, Scales};
use crate::breakage::Breakage;
use crate::internal::InternalForces;
use crate::state::State;
use crate::tangent::Left;

/// Share of a residual that is sought to which a solver that iterates goes: the next residual is measured against other forces.
const SURELY: f64 = 0.3;

impl Equations {
    /// F - K u relative to what may act at each degree of freedom, and what of it rests on holds.
    pub(super) fn residual(
        &self,
        state: &State,
        internal: &InternalForces,
        extents: Extents,
        displacement: f64,
    ) -> Residual {
        let given = self.given(state);
        let scales = self.scales(&given, extents, displacement);
        let out_of_balance = self.external_less(state, internal);
        let of_unknowns = (self.degrees_of_freedom().iter().copied()).zip(out_of_balance);
        // No bond resists these: what loads them is carried by nothing.
        let is_known = |dof: usize| self.unknowns.number(dof).is_none();
        let of_others = given.iter().filter(|(dof, _)| is_known(*dof as usize));
        let of_others = of_others.copied();
        scales.residual(of_unknowns.chain(of_others), |dof| {
            state.held[dof] || is_known(dof)
        })
    }

    /// The given forces of a state, by degree of freedom.
    fn given(&self, state: &State) -> Vec<(u32, f64)> {
        let forces = self.problem.loads.forces(state.load_factor, &self.loaded);
        self.loaded.iter().copied().zip(forces).collect()
    }

    /// What may act in a body with some extents and a largest displacement, m, under given forces.
    fn scales(&self, given: &[(u32, f64)], extents: Extents, displacement: f64) -> Scales<'_> {
        let given = given.iter().copied();
        (self.local_stiffness).scales(extents, self.largest_extents, given, displacement)
    }

    /// Relative residual that is sought after a breakage, or without one.
    pub(super) fn sought(&self, breakage: &Breakage) -> f64 {
        let tolerance = self.solver.tolerance();
        let tolerance = tolerance.filter(|_| !breakage.bonds.is_empty());
        tolerance.map_or(RESIDUAL_TOLERANCE, |it| it.max(RESIDUAL_TOLERANCE))
    }

    /// What a solver may leave of the force out of balance in an iterate of a state, so that the relative residual is one that is
    /// sought.
    pub(super) fn left(&self, state: &State, iterate: &Iterate, sought: f64) -> Left {
        if self.solver.tolerance().is_none() {
            return Left::Share(0.0);
        }
        let displacement = self.largest_displacement(state);
        let given = self.given(state);
        let scales = self.scales(&given, iterate.extents, displacement);
        let of_unknown = |dof: &u32| match SURELY * sought * scales.at(*dof as usize) {
            // Nothing is known yet of what acts there: the next residual tells.
            0.0 => f64::INFINITY,
            size => size,
        };
        Left::AtMost(self.degrees_of_freedom().iter().map(of_unknown).collect())
    }
}
