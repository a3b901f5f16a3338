//! What the ways from one breakage to the next have in common.

use crate::balanced::Balanced;
use crate::driver::path::Path;
use crate::history::Termination;
use crate::unbalanced::Unbalanced;

/// A way along the lines between two breakages.
pub(super) trait EquilibriumLine {
    /// The end of the way along the line of an equilibrium: the critical load, or what ends the run or its part of the programme
    /// before it.
    fn goal(&mut self, path: &mut Path<'_>, line: &Balanced) -> Result<Goal, Unbalanced>;

    /// Moves to another load factor with the same bonds, where no solution is needed.
    fn follow(&self, path: &mut Path<'_>, line: &Balanced, load_factor: f64) -> Balanced;

    /// What the displacements grow by with the load factor, shape (n_degrees_of_freedom); empty where they are in proportion to it.
    fn growth(&self) -> &[f64];
}

/// Where the line of the present bonds is followed to.
pub(super) struct Goal {
    pub(super) load_factor: f64,
    /// s/s_0 of the first bonds to break, there.
    pub(super) ratio: f64,
    /// The first bonds to break, if the load factor is their critical one.
    pub(super) bonds: Vec<u32>,
    /// Whether no load in the part of a programme is admissible, so that the bonds break beyond their limits at the load that is held.
    pub(super) is_held: bool,
    /// Whether a part of a programme ends there.
    pub(super) ends_part: bool,
    /// The reason why the run ends there, if it does.
    pub(super) end: Option<Termination>,
}
