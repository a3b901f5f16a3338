//! Bonds that begin to soften by the stress around them.

use std::sync::Arc;

use super::path::Path;
use crate::balanced::Balanced;

impl Path<'_> {
    /// Lets the bonds begin to soften whose stress in an equilibrium has come to the strength; whether some do. That changes no force: a
    /// bond begins at the deformation at which its stress was the strength, and softens when equilibrium is sought again.
    pub(super) fn begin_softening(&mut self, balanced: &Balanced) -> bool {
        let begun = self.problem.beginning(&self.state, balanced);
        let some = (self.problem.system.subdomain()).any(begun.is_some());
        if let Some(begun) = begun {
            let criteria = Arc::new(self.problem.criteria.begun_at(&begun));
            self.equilibrium.judge_by(criteria.clone());
            self.problem.criteria = criteria;
            self.state.softening.begun = begun;
        }
        some
    }
}
