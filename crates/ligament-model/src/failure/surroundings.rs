//! What limits and measures of bonds follow beside the deformation of the bond.

use super::crack_at_points::CrackAtPoints;
use super::starting::Starting;

/// What limits and measures of bonds follow while the body deforms and bonds break.
#[derive(Debug, Clone, PartialEq)]
pub enum Surroundings {
    /// Limits follow the bonds that are left at the points.
    CrackAtPoints(CrackAtPoints),
    /// Measures follow the stress around the bonds ([`Moduli`](super::hooke::Moduli)).
    Stress,
    /// Bonds begin to soften by the stress around them.
    Starting(Starting),
}
