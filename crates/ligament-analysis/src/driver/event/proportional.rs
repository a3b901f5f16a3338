//! Lines through the unloaded state, in proportion to one load factor.
//!
//! The measures of all criteria are proportional too (s/s_0 stands here for measure over limit): the next bond breaks where the
//! largest s/s_0 reaches one, lambda_next = lambda / max(s/s_0) over the intact bonds with s > 0.

use std::time::Instant;

use super::equilibrium_line::{EquilibriumLine, Goal};
use crate::balanced::Balanced;
use crate::driver::run::Run;
use crate::history::Termination;
use crate::load_program::LoadProgram;
use crate::unbalanced::Unbalanced;

/// Lines through the unloaded state.
pub(super) struct Proportional {
    tie_tolerance: f64,
    /// Degrees of freedom that are prescribed or loaded.
    loaded: Vec<u32>,
}

impl Proportional {
    pub(super) fn new(tie_tolerance: f64, loads: &dyn LoadProgram) -> Self {
        Self {
            tie_tolerance,
            loaded: loads.loaded_degrees_of_freedom(),
        }
    }
}

impl EquilibriumLine for Proportional {
    /// End of the line of an equilibrium: the critical load, or the end of the run before it.
    fn goal(&mut self, run: &mut Run<'_>, line: &Balanced) -> Result<Goal, Unbalanced> {
        let start = Instant::now();
        let criteria = run.criteria(line);
        let first = run.first_to_break(self.tie_tolerance, &line.deformations, &criteria);
        let ratio = first.ratio;
        run.equations.count_bond_work(start);
        let now = run.state.load_factor;
        let mut goal = Goal {
            ratio: 1.0,
            ..Goal::breakage(now / ratio, first)
        };
        if goal.load_factor > 1.0 {
            // Detached parts have stretches of rounding size, which do not count.
            let is_stretched = ratio > run.negligible_utilisation() * now;
            let end = if is_stretched {
                Termination::FullLoad
            } else {
                Termination::NothingBreaks
            };
            (goal.load_factor, goal.end) = (1.0, Some(end));
        }
        let loads = &run.problem.loads;
        let displacement = loads.control_displacement(now, &run.state.displacement);
        if let Some(wanted) = run.stop.displacement
            && displacement > 0.0
        {
            let load_factor = now * wanted / displacement;
            if load_factor <= goal.load_factor {
                goal.load_factor = load_factor;
                goal.end = Some(Termination::DisplacementReached {
                    displacement: wanted,
                });
            }
        }
        if goal.end.is_some() {
            goal.ratio = ratio * (goal.load_factor / now);
        }
        Ok(goal)
    }

    /// Moves to another load factor with the same bonds, without a solution.
    ///
    /// A part that is prescribed or loaded has strains in proportion to the load factor, so that its displacements are scaled. A
    /// free motion of such a part, fixed by an added support, is scaled with the rest: it has no energy, and its size is arbitrary.
    /// A part without prescribed motions and loads has no strains and stays where it is, to the last bit. The residual after the
    /// next breakage covers the whole state, and so verifies this.
    fn follow(&self, run: &mut Run<'_>, line: &Balanced, load_factor: f64) -> Balanced {
        let start = Instant::now();
        let state = &mut run.state;
        let factor = load_factor / state.load_factor;
        state.load_factor = load_factor;
        let fragments = run.equations.fragments();
        // A temperature strains all parts, and where faces close any part may press on another.
        let faces_close = run.problem.system.faces_close;
        let is_heated = !run.problem.loads.thermal_strain(load_factor).is_none();
        let mut is_loaded = vec![is_heated || faces_close; fragments.len()];
        let layout = run.problem.system.layout;
        for &dof in &self.loaded {
            let point = layout.point(dof as usize);
            is_loaded[fragments.of_point[point as usize] as usize] = true;
        }
        let of_points = state.displacement.chunks_mut(layout.components.len());
        for (motion, &fragment) in of_points.zip(&fragments.of_point) {
            if is_loaded[fragment as usize] {
                motion.iter_mut().for_each(|value| *value *= factor);
            }
        }
        let critical = line.scaled(factor);
        run.equations.count_bond_work(start);
        critical
    }

    fn growth(&self) -> &[f64] {
        &[]
    }
}
