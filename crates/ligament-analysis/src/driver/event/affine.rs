//! Lines A + w B of a part of a programme, between its start and its end.
//!
//! The rate of the displacements with the load factor is one solution; with it the load factors at which a bond is within its
//! limits are an interval in closed form. The path continues to the upper end of the intersection of all intervals, which may lie
//! below the present load factor (snap-back), or to the end of the part. Where no load factor of the part is admissible, A alone
//! breaks bonds: at fixed load, the bonds farthest beyond their limits break with those tied with them, group after group, until
//! some load is admissible again, as in the redistribution of sequentially linear analyses (DeJong 2008; Elias 2010).
//!
//! A part that ends at a dissipated energy has no bounds: the load changes as far in both directions as the path does, and the part
//! ends before the first breakage at which that energy is reached.

use std::mem;
use std::time::Instant;

use super::equilibrium_line::{EquilibriumLine, Event, Goal};
use crate::balanced::Balanced;
use crate::driver::run::Run;
use crate::history::Termination;
use crate::load_program::{LoadProgram, PartControl};
use crate::problem::Problem;
use crate::unbalanced::Unbalanced;
use ligament_model::deformation::Deformations;
use ligament_model::failure::CriteriaInState;
use ligament_model::failure::along_line::{EVERYWHERE, Interval};
use ligament_model::stress::point_strain::Motion;
use ligament_model::subdomain::Subdomain;

/// Lines of the parts of a programme.
pub(super) struct Affine {
    tie_tolerance: f64,
    growth: Vec<f64>,
    /// Whether the growth is that of the present bonds.
    is_present: bool,
}

impl Affine {
    /// Lines with the growth of a checkpoint, which is empty at the start.
    pub(super) fn new(tie_tolerance: f64, growth: Vec<f64>) -> Self {
        Self {
            tie_tolerance,
            is_present: !growth.is_empty(),
            growth,
        }
    }

    /// Finds the growth at a rate of the loads, unless it is present.
    fn grow(&mut self, run: &mut Run<'_>, rate: &dyn LoadProgram) -> Result<(), Unbalanced> {
        if !mem::replace(&mut self.is_present, false) {
            self.growth = run.equations.growth(&mut run.state, rate)?;
            run.progress.solves[0] = run.equations.costs().solves;
        }
        Ok(())
    }
}

impl EquilibriumLine for Affine {
    fn goal(&mut self, run: &mut Run<'_>, line: &Balanced) -> Result<Goal, Unbalanced> {
        let loads = run.problem.loads.clone();
        let Some((course, rate)) =
            (loads.course()).and_then(|it| Some((it, loads.in_course(it.rate())?)))
        else {
            unreachable!("lines of a programme are followed under a programme");
        };
        self.grow(run, &*rate)?;
        let start = Instant::now();
        let (slopes, rates) = slopes(run, &self.growth, &*rate);
        let now = run.state.load_factor;
        let (programme, part) = (&course.programme, course.part);
        let (begins, ends) = programme.parts[part].span;
        let criteria = run.criteria(line);
        let intact = &run.state.intact;
        let dissipates = match course.control() {
            Some(&PartControl::DissipatedEnergy { end }) => Some(end),
            Some(PartControl::Motion(_)) | None => None,
        };
        let reach = match dissipates {
            Some(_) => EVERYWHERE,
            None => [begins - now, ends - now],
        };
        let deformations = [&line.deformations, &slopes];
        let admissible = criteria.admissible(&rates, intact, deformations, reach);
        let goal = match on_all_processes(&run.problem.system.subdomain, admissible) {
            None => held(self.tie_tolerance, line, &criteria, run),
            Some([_, upper]) if upper.is_infinite() => Goal {
                load_factor: now,
                ratio: run.problem.largest_ratio(&run.state, line),
                bonds: Vec::new(),
                is_held: false,
                event: Event::Breakage,
                end: Some(Termination::NothingBreaks),
            },
            Some([_, upper]) => {
                let at = line.deformations.ahead(&slopes, upper);
                let criteria = criteria.ahead(&rates, upper);
                let first = run.first_to_break(self.tie_tolerance, &at, &criteria);
                let is_at_end = upper == reach[1];
                let is_gone = dissipates.filter(|it| run.dissipated_energy() >= *it);
                let ends_part = is_at_end || is_gone.is_some();
                let is_last = part + 1 == programme.parts.len();
                let end = is_gone.map_or(Termination::FullLoad, |energy| {
                    Termination::EnergyDissipated { energy }
                });
                let event = match ends_part {
                    true => Event::PartEnds,
                    false => Event::Breakage,
                };
                Goal {
                    event,
                    end: (ends_part && is_last).then_some(end),
                    ..Goal::breakage(if is_at_end { ends } else { now + upper }, first)
                }
            }
        };
        run.equations.count_bond_work(start);
        Ok(up_to_displacement(goal, run, &self.growth))
    }

    fn growth(&self) -> &[f64] {
        &self.growth
    }
}

/// Rate of the deformations (n_bonds) with the load factor for a rate of the displacements (n_degrees_of_freedom), and the criteria with the
/// rates of the stresses around the bonds.
pub(super) fn slopes<'a>(
    run: &'a Run<'_>,
    growth: &[f64],
    rate: &dyn LoadProgram,
) -> (Deformations, CriteriaInState<'a>) {
    let motion = Motion {
        intact: &run.state.intact,
        displacement: growth,
        expansion: rate.thermal_strain(1.0),
    };
    let Problem {
        system, criteria, ..
    } = &run.problem;
    let slopes = system.deformations(motion.intact, motion.displacement, motion.expansion);
    let stresses = criteria.stresses(&**system, motion, &slopes);
    let rates = criteria.without_state();
    let rates = rates.in_state(&stresses, motion.intact, &slopes);
    (slopes, rates)
}

/// Intersection of the admissible intervals of all processes.
fn on_all_processes(subdomain: &Subdomain, here: Option<Interval>) -> Option<Interval> {
    let [lower, upper] = here.unwrap_or(EVERYWHERE);
    let mut most = [f64::from(u8::from(here.is_none())), lower, -upper];
    subdomain.all_reduce_max(&mut most);
    let [is_none, lower, upper] = [most[0], most[1], -most[2]];
    (is_none == 0.0 && lower <= upper).then_some([lower, upper])
}

/// Goal at fixed load, where no load is admissible.
pub(super) fn held(
    tie: f64,
    line: &Balanced,
    criteria: &CriteriaInState<'_>,
    run: &Run<'_>,
) -> Goal {
    let first = run.first_to_break(tie, &line.deformations, criteria);
    Goal {
        // A bond that just reached its limit breaks as on any other line.
        is_held: first.ratio > 1.0 + tie,
        ..Goal::breakage(run.state.load_factor, first)
    }
}

/// The goal, or the load before it at which the control load reaches the displacement that ends the run.
pub(super) fn up_to_displacement(goal: Goal, run: &Run<'_>, growth: &[f64]) -> Goal {
    let (state, loads) = (&run.state, &run.problem.loads);
    let at = |load_factor: f64| {
        let by = load_factor - state.load_factor;
        let moved = state.displacement.iter().zip(growth);
        let moved: Vec<f64> = moved.map(|(value, growth)| value + by * growth).collect();
        loads.control_displacement(load_factor, &moved)
    };
    let Some(wanted) = run.stop.displacement else {
        return goal;
    };
    let [here, there] = [at(state.load_factor), at(goal.load_factor)];
    if there < wanted || there <= here {
        return goal;
    }
    let share = (wanted - here) / (there - here);
    let displacement = wanted;
    Goal {
        load_factor: state.load_factor + share * (goal.load_factor - state.load_factor),
        event: Event::Breakage,
        end: Some(Termination::DisplacementReached { displacement }),
        ..goal
    }
}
