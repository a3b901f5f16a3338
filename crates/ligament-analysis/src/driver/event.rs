//! The exact equilibrium path under proportional loading, from breakage to breakage.
//!
//! Between two breakages the body is linear and its state proportional to the load factor, and so are the measures of all
//! criteria (s/s_0 stands here for measure over limit): the next bond breaks where
//! the largest s/s_0 reaches one, lambda_next = lambda / max(s/s_0) over the intact bonds with s > 0. It breaks there, the
//! load held; the new equilibrium is in general no longer admissible at this load (or admissible beyond it), and the path
//! goes on along its line to the next critical load factor, which may be lower. So the path snaps back as it must, and
//! there is no step size. A stepped test in displacement follows its envelope, [`super::Outcome::envelope`].

use std::time::Instant;

use super::outcome::{Outcome, Rows};
use super::path::{NO_LOAD, Path, StopRules};
use super::recorder::{StepCounters, largest_ratio};
use crate::balanced::{Attempt, Balanced};
use crate::breakage::Breakage;
use crate::breaking::{FirstToBreak, first_to_break};
use crate::error::SetupError;
use crate::history::{Observer, Termination};
use crate::problem::Problem;

/// Settings of the exact path: how it is followed, and when to stop. The path ends at load factor one in any case.
#[derive(Debug, Clone, PartialEq)]
pub struct EventSettings {
    /// Bonds whose s/s_0 is within this relative distance of the largest break together with it.
    pub tie_tolerance: f64,
    /// Relative change of the energy that ends Newton-Raphson (NHPD eq. 21).
    pub energy_tolerance: f64,
    /// When to stop before load factor one.
    pub stop: StopRules,
}

/// Follows the path; the criteria of the problem must be brittle.
///
/// The history has the unloaded body, then a record an event: the state in which its bonds break, just before they do. The
/// last record breaks none: it is where the run ended.
pub fn run(
    problem: &Problem,
    settings: &EventSettings,
    observer: &mut dyn Observer,
) -> Result<Outcome, SetupError> {
    if problem.criteria.soften() {
        return Err(SetupError::Softening);
    }
    let (mut path, at_one) =
        Path::begin(problem, settings.energy_tolerance, settings.stop, observer)?;
    let unloaded = match path.balance(0, &Breakage::default())? {
        Attempt::Balanced(balanced) => balanced,
        Attempt::Unbalanced(reason) => {
            let end = Termination::NoEquilibrium { step: 0, reason };
            return Ok(path.into_outcome(end, Rows::Events));
        }
    };
    let counters = StepCounters {
        at_rest: true,
        ..Default::default()
    };
    path.record(&unloaded, counters, false)?;
    // Where there is no equilibrium at load factor one, the first event finds it out again and says why.
    match at_one {
        Some(at_one) => path.state = at_one,
        None => path.state.load_factor = 1.0,
    }
    let mut following = Following {
        loaded: problem.loads.loaded_degrees_of_freedom(),
        path,
        settings,
    };
    let termination = following.follow()?;
    Ok(following.path.into_outcome(termination, Rows::Events))
}

/// The run on its way.
struct Following<'a> {
    path: Path<'a>,
    settings: &'a EventSettings,
    /// Degrees of freedom that something moves or loads.
    loaded: Vec<u32>,
}

/// Where the line of the present bonds is followed to.
struct Goal {
    load_factor: f64,
    /// s/s_0 of the first bonds to break, there.
    ratio: f64,
    /// The first bonds to break, if the load factor is their critical one.
    bonds: Vec<u32>,
    /// The reason why the run ends there, if it does.
    end: Option<Termination>,
}

impl Following<'_> {
    /// Follows the path from an equilibrium of the whole body to the end of the run.
    fn follow(&mut self) -> Result<Termination, SetupError> {
        let mut step = 1;
        self.path.enter(step, 0)?;
        let mut line = match self.path.balance(step, &Breakage::default())? {
            Attempt::Balanced(balanced) => balanced,
            Attempt::Unbalanced(reason) => return Ok(Termination::NoEquilibrium { step, reason }),
        };
        loop {
            let Goal {
                load_factor,
                ratio,
                bonds,
                end,
            } = self.goal(&line);
            let critical = self.move_along_line(&line, load_factor);
            self.path.enter(step, 0)?;
            self.path.account(step, &Breakage::default(), &critical)?;
            let end = end
                .or_else(|| self.path.interruption())
                .or_else(|| self.path.end_at_rest(&critical));
            let goes_on = usize::from(end.is_none());
            let counters = StepCounters {
                step,
                broken_in_step: goes_on * bonds.len(),
                rounds: goes_on,
                at_rest: true,
                largest_ratio: ratio,
                ..Default::default()
            };
            self.path.record(&critical, counters, end.is_some())?;
            if let Some(end) = end {
                return Ok(end);
            }
            let breakage = self.path.break_bonds(&bonds, &critical, step, 1)?;
            if self.path.collapsed {
                return self.end(step + 1, &critical, Termination::Collapsed);
            }
            self.path.enter(step, 1)?;
            line = match self.path.balance(step, &breakage)? {
                Attempt::Balanced(balanced) => balanced,
                Attempt::Unbalanced(reason) => {
                    let end = self.path.without_equilibrium(step, reason);
                    return self.end(step + 1, &critical, end);
                }
            };
            self.path.account(step, &breakage, &line)?;
            step += 1;
            if self.path.carries_nothing(&line) {
                return self.end(step, &line, Termination::FellApart);
            }
        }
    }

    /// The end of the way along the line of an equilibrium: the critical load, or what ends the run before it.
    fn goal(&mut self, line: &Balanced) -> Goal {
        let start = Instant::now();
        let FirstToBreak { ratio, bonds } = first_to_break(
            self.settings.tie_tolerance,
            &line.deformations,
            &self.path.problem.criteria,
            &self.path.state.intact,
        );
        self.path.equilibrium.count_bond_work(start);
        let now = self.path.state.load_factor;
        let mut goal = Goal {
            load_factor: now / ratio,
            ratio: 1.0,
            bonds,
            end: None,
        };
        if goal.load_factor > 1.0 {
            // Loose parts have stretches of rounding size, which are none.
            let is_stretched = ratio > NO_LOAD * now;
            let end = if is_stretched {
                Termination::FullLoad
            } else {
                Termination::NothingBreaks
            };
            (goal.load_factor, goal.end) = (1.0, Some(end));
        }
        let loads = &self.path.problem.loads;
        let displacement = loads.control_displacement(now, &self.path.state.displacement);
        if let Some(wanted) = self.settings.stop.displacement
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
        goal
    }

    /// Moves to another load factor with the same bonds, where no solution is needed.
    ///
    /// A part that something moves or loads has strains in proportion to the load factor, so its displacements are scaled.
    /// Where it may move freely, with just this motion held, the motion is scaled with the rest: it costs nothing, and its
    /// size is arbitrary. A part that nothing moves or loads has no strains and stays where it is, to the last bit.
    /// The residual after the next breakage covers the whole state, and so tells if this did not hold.
    fn move_along_line(&mut self, line: &Balanced, load_factor: f64) -> Balanced {
        let start = Instant::now();
        let state = &mut self.path.state;
        let factor = load_factor / state.load_factor;
        state.load_factor = load_factor;
        let fragments = self.path.equilibrium.fragments();
        // A temperature strains all parts.
        let is_heated = !self
            .path
            .problem
            .loads
            .thermal_strain(load_factor)
            .is_none();
        let mut is_loaded = vec![is_heated; fragments.points.len()];
        let layout = self.path.problem.system.layout();
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
        self.path.equilibrium.count_bond_work(start);
        critical
    }

    /// Ends the run with a last record after a breakage; at rest only where the body fell apart.
    fn end(
        &mut self,
        step: usize,
        last: &Balanced,
        end: Termination,
    ) -> Result<Termination, SetupError> {
        let counters = StepCounters {
            step,
            at_rest: end == Termination::FellApart,
            largest_ratio: largest_ratio(&self.path.state, last, &self.path.problem.criteria),
            ..Default::default()
        };
        self.path.record(last, counters, true)?;
        Ok(end)
    }
}
