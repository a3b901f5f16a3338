//! The exact equilibrium path under proportional loading, from breakage to breakage.
//!
//! Between two breakages the body is linear and its state proportional to the load factor, and so are the measures of all
//! criteria (s/s_0 stands here for measure over limit): the next bond breaks where
//! the largest s/s_0 reaches one, lambda_next = lambda / max(s/s_0) over the intact bonds with s > 0. It breaks there, the
//! load held; the new equilibrium is in general no longer admissible at this load (or admissible beyond it), and the path
//! goes on along its line to the next critical load factor, which may be lower. So the path snaps back as it must, and
//! there is no step size. A stepped test in displacement follows its envelope, [`super::Outcome::envelope`].

use std::mem;
use std::time::Instant;

use super::course::{Place, Restored};
use super::outcome::{Outcome, Rows};
use super::path::{NO_LOAD, Path, StopRules};
use super::recorder::{Energies, StepCounters, largest_ratio};
use crate::balanced::{Attempt, Balanced};
use crate::breakage::Breakage;
use crate::breaking::{FirstToBreak, first_to_break};
use crate::checkpoint::CheckpointError;
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
    path.require_resistance(at_one.as_ref())?;
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

/// The run of a checkpoint, ready to go on.
///
/// # Errors
///
/// If the checkpoint is damaged, or of another problem or driver.
pub fn restore(
    problem: &Problem,
    settings: &EventSettings,
    checkpoint: &[u8],
) -> Result<Restored, SetupError> {
    let restored = Restored::read(problem, settings.energy_tolerance, checkpoint)?;
    match restored.place {
        Place::Event(_) => Ok(restored),
        Place::LoadStep(_) => Err(CheckpointError::OtherDriver.into()),
    }
}

/// Goes on with a run as if it had never stopped; the stop rules may be others than before.
///
/// # Errors
///
/// If the run is of another driver, or an observer fails.
pub fn resume(
    problem: &Problem,
    settings: &EventSettings,
    restored: Restored,
    observer: &mut dyn Observer,
) -> Result<Outcome, SetupError> {
    let Place::Event(step) = restored.place else {
        return Err(CheckpointError::OtherDriver.into());
    };
    let (path, line) = Path::go_on(problem, settings.stop, restored, observer);
    let mut following = Following {
        loaded: problem.loads.loaded_degrees_of_freedom(),
        path,
        settings,
    };
    let termination = following.go_on(step, line)?;
    Ok(following.path.into_outcome(termination, Rows::Events))
}

/// The run on its way.
struct Following<'a> {
    path: Path<'a>,
    settings: &'a EventSettings,
    /// Degrees of freedom that something moves or loads.
    loaded: Vec<u32>,
}

/// What the way along a line changes, as it was before.
struct Before {
    load_factor: f64,
    displacement: Vec<f64>,
    energies: Energies,
}

impl Before {
    fn new(path: &Path<'_>) -> Self {
        Self {
            load_factor: path.state.load_factor,
            displacement: path.state.displacement.clone(),
            energies: path.energies.clone(),
        }
    }

    /// Exchanges it for what it is now.
    fn swap(&mut self, path: &mut Path<'_>) {
        mem::swap(&mut self.load_factor, &mut path.state.load_factor);
        mem::swap(&mut self.displacement, &mut path.state.displacement);
        mem::swap(&mut self.energies, &mut path.energies);
    }
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
        let step = 1;
        self.path.enter(step, 0)?;
        match self.path.balance(step, &Breakage::default())? {
            Attempt::Balanced(line) => self.go_on(step, line),
            Attempt::Unbalanced(reason) => Ok(Termination::NoEquilibrium { step, reason }),
        }
    }

    /// Follows the path from an equilibrium on the line to an event.
    fn go_on(&mut self, mut step: usize, mut line: Balanced) -> Result<Termination, SetupError> {
        loop {
            let before = Before::new(&self.path);
            let Goal {
                load_factor,
                ratio,
                bonds,
                end,
            } = self.goal(&line);
            let critical = self.move_along_line(&line, load_factor);
            self.path.account(step, &Breakage::default(), &critical)?;
            let end = end
                .or_else(|| self.path.interruption())
                .or_else(|| self.path.end_at_rest(&critical))
                .or_else(|| self.path.end_by_load_fraction(&critical));
            let end = self.offer(before, step, &line, end)?;
            self.path.enter(step, 0)?;
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

    /// Offers the moment before the way along a line, when it is known whether the run ends there.
    fn offer(
        &mut self,
        mut before: Before,
        step: usize,
        line: &Balanced,
        end: Option<Termination>,
    ) -> Result<Option<Termination>, SetupError> {
        before.swap(&mut self.path);
        let end = self.path.offer(&|| Place::Event(step), line, end)?;
        before.swap(&mut self.path);
        Ok(end)
    }

    /// The end of the way along the line of an equilibrium: the critical load, or what ends the run before it.
    fn goal(&mut self, line: &Balanced) -> Goal {
        let start = Instant::now();
        let FirstToBreak { ratio, bonds } = first_to_break(
            self.settings.tie_tolerance,
            &line.deformations,
            &self.path.criteria(line),
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
        // A temperature strains all parts, and where faces close any part may press on another.
        let faces_close = self.path.problem.system.faces_close();
        let is_heated = !self
            .path
            .problem
            .loads
            .thermal_strain(load_factor)
            .is_none();
        let mut is_loaded = vec![is_heated || faces_close; fragments.points.len()];
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
