//! Skipped events, for which the observer does not need the whole body: [updates of its parts are delayed](crate::lagging).
//!
//! The line through the unloaded state is stored at one load factor, and quantities at critical load factors are proportional. Each
//! event needs the motions of parts whose bonds may break next, and of supported and loaded points, whose forces give reactions,
//! work and the stored energy. After some events all parts are updated, and the residual of the whole body is checked.

use std::time::Instant;

use ligament_model::deformation::Deformations;
use ligament_model::element::{BondDeformation, StiffnessFactors};

use crate::balanced::{Attempt, Balanced};
use crate::breakage::Breakage;
use crate::breaking::{FirstToBreak, first_to_break};
use crate::driver::record::StepCounters;
use crate::driver::run::Run;
use crate::error::SetupError;
use crate::lagging::{Body, ForwardSubstituted, Lagging};
use crate::problem::Problem;

/// Interval of events after which the whole body is updated in any case, so that its residual is checked and rounding does not
/// accumulate.
const WHOLE_EVERY: usize = 64;

/// Result of skipping events.
pub(super) enum Passed {
    /// No event was skipped, because the run may end with the next one.
    Nothing,
    /// An equilibrium of the whole body, or the reason why there is none.
    Line(Attempt),
    /// A breakage that cannot be applied to delayed parts, and the equilibrium of the whole body before it.
    Broke(Balanced, Breakage),
}

/// State while events are skipped, on the line of one load factor.
pub(super) struct Passing<'a, 'p> {
    run: &'a mut Run<'p>,
    problem: &'a Problem,
    body: &'a Body,
    lagging: Lagging<'a>,
    /// Load factor of the delayed displacements.
    load_factor: f64,
    /// Equilibrium at that load factor, with forces at the observed points only and without deformations.
    line: Balanced,
}

/// Whether an event may be skipped.
pub(super) fn may_pass(run: &Run<'_>, step: usize) -> bool {
    !step.is_multiple_of(WHOLE_EVERY) && !run.observer.looks(step)
}

/// Whether updates of the body may be delayed with its added supports: these may fix only detached parts that are not observed.
pub(super) fn may_wait(run: &Run<'_>, body: &Body) -> bool {
    let fragments = run.equations.fragments();
    let layout = run.problem.system.layout;
    let fragment = |point: u32| fragments.of_point[point as usize] as usize;
    let mut is_asked_for = vec![false; fragments.len()];
    for &point in body.wanted() {
        is_asked_for[fragment(point)] = true;
    }
    let mut held = (0..).zip(&run.state.held).filter(|(_, held)| **held);
    held.all(|(dof, _)| !is_asked_for[fragment(layout.point(dof))])
}

/// Skips events from an equilibrium on the line to the first of them, as long as allowed; advances the step number.
pub(super) fn pass(
    run: &mut Run<'_>,
    body: &Body,
    tie_tolerance: f64,
    step: &mut usize,
    line: &Balanced,
) -> Result<Passed, SetupError> {
    let start = Instant::now();
    let problem = run.problem.clone();
    let (state, deformations) = (&run.state, &line.deformations);
    let criteria = problem.criteria_in(state, line);
    let mut first = first_to_break(tie_tolerance, deformations, &criteria, &state.intact);
    let lagging = Lagging::new(body, &problem, tie_tolerance, state, criteria, deformations);
    let mut passing = Passing {
        problem: &problem,
        body,
        lagging,
        load_factor: state.load_factor,
        line: Balanced {
            deformations: Deformations::default(),
            ..line.clone()
        },
        run,
    };
    passing.run.equations.count_bond_work(start);
    let first_step = *step;
    while may_pass(passing.run, *step) {
        let Some(critical) = passing.go_to(&first) else {
            if *step == first_step {
                passing.go_back();
                return Ok(Passed::Nothing);
            }
            break;
        };
        let breakage = passing.break_first(&first, critical, *step)?;
        if passing.run.collapsed || !passing.run.equations.can_update(&breakage) {
            let before = passing.before(&breakage);
            return Ok(Passed::Broke(before, breakage));
        }
        passing.run.enter(*step, 1)?;
        let Some(next) = passing.follow(&breakage) else {
            let before = passing.before(&breakage);
            return Ok(Passed::Broke(before, breakage));
        };
        let after = passing.known();
        passing.run.account(*step, &breakage, &after)?;
        *step += 1;
        first = next;
    }
    passing.catch_up();
    let attempt = passing.run.balance(*step, &Breakage::default())?;
    Ok(Passed::Line(attempt))
}

impl Passing<'_, '_> {
    /// Moves to the load factor at which the first bonds break; None where the run may end before.
    fn go_to(&mut self, first: &FirstToBreak) -> Option<Balanced> {
        let load_factor = self.load_factor / first.ratio;
        if !(load_factor > 0.0 && load_factor <= 1.0) {
            return None;
        }
        self.run.state.load_factor = load_factor;
        self.know(&first.bonds);
        let critical = self.known();
        let (displacement, _) = self.run.control(&critical);
        let wanted = self.run.stop.displacement;
        let ends = wanted.is_some_and(|wanted| displacement >= wanted)
            || self.run.interruption().is_some()
            || self.run.end_at_rest(&critical).is_some()
            || self.run.end_by_load_fraction(&critical).is_some();
        (!ends).then_some(critical)
    }

    /// Moves back to the state before the first skipped event.
    fn go_back(&mut self) {
        self.run.state.load_factor = self.load_factor;
        let motions = &mut self.run.state.displacement;
        motions.clone_from(&self.lagging.displacement);
    }

    /// Records a critical equilibrium and breaks its bonds.
    fn break_first(
        &mut self,
        first: &FirstToBreak,
        mut critical: Balanced,
        step: usize,
    ) -> Result<Breakage, SetupError> {
        let run = &mut *self.run;
        run.account(step, &Breakage::default(), &critical)?;
        critical.stored_energy = run.energies.stored_in_proportion();
        run.enter(step, 0)?;
        run.progress.solves[0] = run.equations.costs().solves;
        run.progress.negative_eigenvalues = run.equations.negative_eigenvalues();
        let counters = StepCounters {
            step,
            broken_in_step: first.bonds.len(),
            rounds: 1,
            at_rest: true,
            largest_ratio: 1.0,
            ..Default::default()
        };
        run.record_in_passing(&critical, counters)?;
        let factor = self.factor();
        let run = &mut *self.run;
        let (system, displacement) = (&self.problem.system, &self.lagging.displacement);
        let FirstToBreak { bonds, .. } = first.clone().sorted(|it| system.ends_in_file(it));
        let deformations = system.measured(&run.state.intact, displacement, &bonds);
        let deformations = deformations.iter().map(|it| it.scaled(factor));
        let deformations: Vec<BondDeformation> = deformations.collect();
        let deformation = |place: usize, _| deformations[place];
        let criteria = self.lagging.criteria().on_line(None, factor);
        let judged = (&criteria, &deformation as &dyn Fn(usize, usize) -> _);
        run.break_deformed(&bonds, judged, &critical.internal, [step, 1])
    }

    /// Applies a breakage; returns the bonds that break next. None where the update of the factor failed.
    fn follow(&mut self, breakage: &Breakage) -> Option<FirstToBreak> {
        let scale = self.factor().recip();
        let Run {
            equations, state, ..
        } = &mut *self.run;
        let points = self.problem.system.points_of_breakage(&breakage.bonds);
        let lagging = &mut self.lagging;
        let first = equations.update_and_forward_solve(state, breakage, |factor, half| {
            let correction = ForwardSubstituted {
                factor,
                by_row: half.by_row(),
                scale,
            };
            lagging.follow(correction, &points, state)
        })?;
        let start = Instant::now();
        self.know(&breakage.bonds);
        self.add_up_forces();
        self.run.equations.count_bond_work(start);
        Some(first)
    }

    /// Equilibrium at the load factor of the state, as far as known.
    fn known(&self) -> Balanced {
        self.line.scaled(self.factor())
    }

    /// Ratio of the displacements of the state to the delayed ones.
    fn factor(&self) -> f64 {
        self.run.state.load_factor / self.load_factor
    }

    /// Sets the motions of the observed points, and of those on which a breakage of some bonds depends, in the state.
    fn know(&mut self, bonds: &[u32]) {
        let factor = self.factor();
        let system = &self.problem.system;
        let points = system.points_of_breakage(bonds);
        for point in self.body.wanted().iter().copied().chain(points) {
            for dof in system.layout.range(point) {
                self.run.state.displacement[dof] = factor * self.lagging.displacement[dof];
            }
        }
    }

    /// Sums the forces of the bonds on the observed points.
    fn add_up_forces(&mut self) {
        let system = &self.problem.system;
        let (layout, intact) = (system.layout, &self.run.state.intact);
        let (motions, forces) = (&self.lagging.displacement, &mut self.line.internal.values);
        for &point in self.body.wanted() {
            let dofs = layout.range(point);
            forces[dofs.clone()].fill(0.0);
            let bonds = system.incidence.at(point).iter();
            for &bond in bonds.filter(|&&bond| intact[bond as usize]) {
                for (rigidity, entries) in
                    system.terms(intact, bond as usize, &StiffnessFactors::WHOLE)
                {
                    let strains = entries.iter().map(|(dof, value)| value * motions[*dof]);
                    let strain: f64 = strains.sum();
                    for (dof, value) in entries.iter().filter(|it| dofs.contains(&it.0)) {
                        forces[*dof] += rigidity * strain * value;
                    }
                }
            }
            let of_cells = system.force_of_cells(intact, motions, point);
            forces[dofs]
                .iter_mut()
                .zip(of_cells)
                .for_each(|(sum, it)| *sum += it);
        }
    }

    /// Updates the motions of all points to the load factor of the state.
    fn catch_up(&mut self) {
        let start = Instant::now();
        // Without a factor the last known motions are the start of the next iteration.
        if let Some(factor) = self.run.equations.factor() {
            self.lagging.catch_up(factor, &self.run.state);
        }
        let factor = self.factor();
        let motions = self.run.state.displacement.iter_mut();
        for (motion, line) in motions.zip(&self.lagging.displacement) {
            *motion = factor * line;
        }
        self.run.equations.count_bond_work(start);
    }

    /// Equilibrium of the whole body before a breakage that was not applied.
    fn before(&mut self, breakage: &Breakage) -> Balanced {
        self.catch_up();
        let Run {
            equations, state, ..
        } = &mut *self.run;
        for &bond in &breakage.bonds {
            state.intact[bond as usize] = true;
        }
        let before = equations.measured(state);
        for &bond in &breakage.bonds {
            state.intact[bond as usize] = false;
        }
        before
    }
}
