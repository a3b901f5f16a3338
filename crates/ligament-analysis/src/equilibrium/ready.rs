//! A solver that is made ready for an iterate, with supports where pivots vanish.

use ligament_linalg::FactorKind;

use super::equations::Equations;
use super::iterate::Iterate;
use super::meeting::Met;
use crate::state::State;
use crate::unbalanced::Unbalanced;

impl Equations {
    /// Makes the solver ready for an iterate of a state. Returns the points of mechanisms that are fixed from now on.
    pub(super) fn make_ready(
        &mut self,
        state: &mut State,
        iterate: &Iterate,
    ) -> Result<Vec<u32>, Unbalanced> {
        let Met {
            closed, touching, ..
        } = &iterate.met;
        let resisting = self.meeting.resisting(closed, touching);
        self.solver.close(resisting, &mut self.costs);
        self.prepare_solver(state)
    }

    /// Makes the solver ready, fixing mechanisms until no pivot vanishes. Returns the numbers in the body of the points that were fixed.
    pub(super) fn prepare_solver(&mut self, state: &mut State) -> Result<Vec<u32>, Unbalanced> {
        let mut held_now = Vec::new();
        loop {
            let vanishing = self.solver.prepare(state, &mut self.costs);
            let vanishing = vanishing.map_err(Unbalanced::NoFactor)?;
            let Some(&first) = vanishing.first() else {
                return Ok(held_now);
            };
            if self.problem.system.some_negative() {
                return Err(self.vanishing_pivot(first));
            }
            let (subdomain, layout) = (self.subdomain(), self.layout());
            for dof in vanishing {
                let here = subdomain.local_index(dof, layout.components.len());
                if here.is_some_and(|here| std::mem::replace(&mut state.held[here], true)) {
                    return Err(self.vanishing_pivot(dof));
                }
                held_now.push(layout.point(dof));
            }
        }
    }

    fn vanishing_pivot(&self, dof: usize) -> Unbalanced {
        let place = self.place(dof);
        let stiffness = self.stiffness.as_ref();
        let is_llt = stiffness.is_some_and(|it| it.choice().factorisation == FactorKind::Llt);
        if is_llt && self.problem.system.some_negative() {
            Unbalanced::NotPositiveDefinite { place }
        } else {
            Unbalanced::VanishingPivot { place }
        }
    }
}
