//! Interface of the lines between two breakages.

use crate::balanced::Balanced;
use crate::breaking::FirstToBreak;
use crate::driver::run::Run;
use crate::history::Termination;
use crate::unbalanced::Unbalanced;

/// A line between two breakages.
pub(super) trait EquilibriumLine {
    /// End of the line of an equilibrium: the critical load, or the end of the run or of the part of the programme before it.
    fn goal(&mut self, run: &mut Run<'_>, line: &Balanced) -> Result<Goal, Unbalanced>;

    /// Moves to another load factor with the same bonds along the rate of the displacements, without a solution.
    fn follow(&self, run: &mut Run<'_>, _line: &Balanced, load_factor: f64) -> Balanced {
        let by = load_factor - run.state.load_factor;
        for (value, growth) in run.state.displacement.iter_mut().zip(self.growth()) {
            *value += by * growth;
        }
        run.state.load_factor = load_factor;
        run.equations.arrived(&mut run.state)
    }

    /// Rate of the displacements with the load factor, shape (n_degrees_of_freedom); empty where they are proportional to it.
    fn growth(&self) -> &[f64];
}

/// What happens at the end of a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Event {
    /// Bonds break, or the run ends.
    Breakage,
    /// A part of a programme ends.
    PartEnds,
    /// A contact opens or closes.
    ContactChanges,
    /// A contact opens or closes where some bonds are still beyond their limits, so that the path does not consist of such states.
    ContactChangesBeyond,
}

/// End of the line of the present bonds.
pub(super) struct Goal {
    pub(super) load_factor: f64,
    /// Largest s/s_0, that of the first bonds to break, at the end of the line.
    pub(super) ratio: f64,
    /// First bonds to break, if the load factor is their critical one.
    pub(super) bonds: Vec<u32>,
    /// Whether no load in the part of a programme is admissible, so that the bonds break beyond their limits at fixed load.
    pub(super) is_held: bool,
    /// What happens there.
    pub(super) event: Event,
    /// Reason why the run ends there, if it does.
    pub(super) end: Option<Termination>,
}

impl Goal {
    /// End of a line at a load factor where the first bonds break.
    pub(super) fn breakage(load_factor: f64, first: FirstToBreak) -> Self {
        Self {
            load_factor,
            ratio: first.ratio,
            bonds: first.bonds,
            is_held: false,
            event: Event::Breakage,
            end: None,
        }
    }
}
