//! Chains of lines where surfaces or faces of cracks meet, from one contact that opens or closes to the next.
//!
//! For given bonds and a growing load the contacts without friction determine one equilibrium u(lambda) for each load factor, which is
//! piecewise linear: the minimum of an energy that is piecewise quadratic. Where all bonds are within their limits, the path goes up along
//! u(lambda) to the first load factor at which one reaches its limit. Where some are beyond, as after a breakage, it goes down to the first at
//! which none is. The smallest change of the load factor decides which event is next; contacts whose gaps are zero together, within the
//! tolerance of ties, open and close together.

use std::time::Instant;

use super::affine::{held, slopes, up_to_displacement};
use super::equilibrium_line::{EquilibriumLine, Event, Goal};
use crate::balanced::Balanced;
use crate::driver::run::Run;
use crate::equilibrium::Heading;
use crate::history::Termination;
use crate::unbalanced::Unbalanced;

/// Lines between two contacts that open or close.
pub(super) struct InContact {
    tie_tolerance: f64,
    growth: Vec<f64>,
    /// Whether the growth is that of the present bonds and contacts.
    is_present: bool,
}

impl InContact {
    /// Lines with the growth of a checkpoint, which is empty at the start.
    pub(super) fn new(tie_tolerance: f64, growth: Vec<f64>) -> Self {
        Self {
            tie_tolerance,
            is_present: !growth.is_empty(),
            growth,
        }
    }

    /// Finds the growth in a direction of the load, unless it is present.
    fn grow(&mut self, run: &mut Run<'_>, heading: Heading) -> Result<(), Unbalanced> {
        if !std::mem::replace(&mut self.is_present, false) {
            let equations = &mut run.equations;
            self.growth = equations.growth_in_contact(&mut run.state, heading)?;
            run.progress.solves[0] = run.equations.costs().solves;
        }
        Ok(())
    }
}

impl EquilibriumLine for InContact {
    fn goal(&mut self, run: &mut Run<'_>, line: &Balanced) -> Result<Goal, Unbalanced> {
        let ratio = run.problem.largest_ratio(&run.state, line);
        let rises = ratio <= 1.0 + self.tie_tolerance;
        let heading = Heading {
            sign: if rises { 1.0 } else { -1.0 },
            tie_tolerance: self.tie_tolerance,
        };
        self.grow(run, heading)?;
        let start = Instant::now();
        let now = run.state.load_factor;
        let to_contact = run.equations.reach(&run.state, &self.growth, heading);
        let left = if rises { 1.0 - now } else { now };
        let reach = to_contact.min(left);
        let loads = run.problem.loads.clone();
        let (slopes, rates) = slopes(run, &self.growth, &*loads);
        let criteria = run.criteria(line);
        let span = if rises { [0.0, reach] } else { [-reach, 0.0] };
        let deformations = [&line.deformations, &slopes];
        let admissible = criteria.admissible(&rates, &run.state.intact, deformations, span);
        let at = |run: &Run<'_>, upper: f64| {
            let criteria = criteria.ahead(&rates, upper);
            let deformations = line.deformations.ahead(&slopes, upper);
            run.first_to_break(self.tie_tolerance, &deformations, &criteria)
        };
        let goal = match admissible {
            Some([_, upper]) if rises && upper == reach => {
                let first = at(run, upper);
                let is_full = reach == left;
                let full = match first.ratio > run.negligible_utilisation() {
                    true => Termination::FullLoad,
                    false => Termination::NothingBreaks,
                };
                Goal {
                    event: Event::ContactChanges,
                    end: is_full.then_some(full),
                    ..Goal::breakage(if is_full { 1.0 } else { now + reach }, first)
                }
            }
            Some([_, upper]) => Goal::breakage(now + upper, at(run, upper)),
            None if !rises && reach < left => Goal {
                event: Event::ContactChangesBeyond,
                ..Goal::breakage(now - reach, at(run, -reach))
            },
            // Bonds that are at their limits already, or beyond them without any load.
            None => held(self.tie_tolerance, line, &criteria, run),
        };
        run.equations.count_bond_work(start);
        Ok(up_to_displacement(goal, run, &self.growth))
    }

    fn growth(&self) -> &[f64] {
        &self.growth
    }
}
