//! Bonds that begin to soften by the stress around them.

use super::path::Path;
use crate::balanced::Balanced;

impl Path<'_> {
    /// Lets the bonds begin to soften whose stress in an equilibrium has come to the strength; whether some do. That changes no force: a
    /// bond begins at the deformation at which its stress was the strength, and softens when equilibrium is sought again.
    pub(super) fn begin_softening(&mut self, balanced: &Balanced) -> bool {
        let begun = self.problem.beginning(&self.state, balanced);
        let some = (self.problem.system.subdomain()).any(begun.is_some());
        if let Some(begun) = begun {
            let softening = &mut self.state.softening;
            softening.begin(&self.problem.criteria, begun);
        }
        some
    }
}
