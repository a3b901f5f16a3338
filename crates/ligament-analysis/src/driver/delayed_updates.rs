//! Delayed updates of parts of a body, during equilibria for which nobody needs the whole body ([`crate::lagging`]).
//!
//! Each equilibrium needs the motions of parts whose bonds may break next, and of supported and loaded points, whose forces give
//! reactions, work and the stored energy. After some equilibria all parts are updated, and the residual of the whole body is checked.

use std::cell::OnceCell;
use std::rc::Rc;
use std::time::Instant;

use ligament_model::deformation::Deformations;
use ligament_model::element::{BondDeformation, StiffnessFactors};

use super::run::Run;
use crate::balanced::Balanced;
use crate::breakage::Breakage;
use crate::breaking::{BreakingRule, Leaders, Leading, next_of_near};
use crate::error::SetupError;
use crate::lagging::{Body, ForwardSubstituted, Lagging};
use crate::problem::Problem;

/// Interval of equilibria after which the whole body is updated in any case, so that its residual is checked and rounding does not
/// accumulate.
pub(super) const WHOLE_EVERY: usize = 64;

/// Parts of the body of a run, which are found when updates of some may first be delayed.
#[derive(Default)]
pub(super) struct PartsOfBody(OnceCell<Option<Rc<Body>>>);

impl PartsOfBody {
    /// The parts, if their updates may be delayed in the present state: added supports may fix only detached parts that are not observed.
    pub(super) fn body(&self, run: &Run<'_>) -> Option<Rc<Body>> {
        let body = self.0.get_or_init(|| {
            let stiffness = run.equations.stiffness()?;
            Body::new(&run.problem, stiffness).map(Rc::new)
        });
        body.clone().filter(|body| may_wait(run, body))
    }
}

/// Whether no added support fixes a part with observed points.
fn may_wait(run: &Run<'_>, body: &Body) -> bool {
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

/// A run while updates of parts of its body are delayed, on the line through the unloaded state to an equilibrium.
pub(super) struct DelayedUpdates<'a, 'p> {
    pub(super) run: &'a mut Run<'p>,
    problem: &'a Problem,
    body: &'a Body,
    lagging: Lagging<'a>,
    /// Load factor of the delayed displacements.
    pub(super) load_factor: f64,
    /// Equilibrium at that load factor, with forces at the observed points only and without deformations.
    line: Balanced,
}

/// A problem with the parts of its body.
pub(super) type Divided<'a> = (&'a Problem, &'a Body);

impl<'a, 'p> DelayedUpdates<'a, 'p> {
    /// Begins with an equilibrium of the whole body; also returns its leading bonds.
    pub(super) fn begin(
        run: &'a mut Run<'p>,
        (problem, body): Divided<'a>,
        leading: Leading,
        line: &'a Balanced,
    ) -> (Self, Leaders) {
        let start = Instant::now();
        let (state, deformations) = (&run.state, &line.deformations);
        let criteria = problem.criteria_in(state, line);
        let (lagging, leaders) =
            Lagging::new(body, (problem, leading), state, criteria, deformations);
        run.equations.count_bond_work(start);
        let delayed = Self {
            problem,
            body,
            lagging,
            load_factor: run.state.load_factor,
            line: Balanced {
                deformations: Deformations::default(),
                mechanisms: Vec::new(),
                ..line.clone()
            },
            run,
        };
        (delayed, leaders)
    }

    /// Moves back to the load factor of the beginning, where no bond broke since.
    pub(super) fn go_back(&mut self) {
        self.run.state.load_factor = self.load_factor;
        let motions = &mut self.run.state.displacement;
        motions.clone_from(&self.lagging.displacement);
    }

    /// Bonds of a list with their deformations at the load factor of the state.
    pub(super) fn deformed(&self, bonds: &[u32]) -> Vec<(u32, BondDeformation)> {
        let (factor, displacement) = (self.factor(), &self.lagging.displacement);
        let system = &self.problem.system;
        let deformations = system.measured(&self.run.state.intact, displacement, bonds);
        let deformations = deformations.iter().map(|it| it.scaled(factor));
        bonds.iter().copied().zip(deformations).collect()
    }

    /// Bonds that break next by a rule, with their deformations, from the leading bonds at the load factor of the beginning.
    pub(super) fn next_to_break(
        &self,
        rule: &BreakingRule,
        leaders: &Leaders,
    ) -> Vec<(u32, BondDeformation)> {
        let near: Vec<u32> = leaders.bonds().map(|it| it.0).collect();
        let in_file = |bond| self.problem.system.ends_in_file(bond);
        let criteria = self.lagging.criteria();
        let next = next_of_near(rule, &self.deformed(&near), criteria, in_file);
        self.deformed(&next)
    }

    /// Breaks bonds with their deformations in a step and a round, in an equilibrium known at observed points.
    pub(super) fn break_bonds(
        &mut self,
        bonds: &[(u32, BondDeformation)],
        critical: &Balanced,
        at: [usize; 2],
    ) -> Result<Breakage, SetupError> {
        let (numbers, deformations): (Vec<u32>, Vec<_>) = bonds.iter().copied().unzip();
        self.know(&numbers);
        let deformation = |place: usize, _| deformations[place];
        let criteria = self.lagging.criteria().on_line(None, self.factor());
        let judged = (&criteria, &deformation as &dyn Fn(usize, usize) -> _);
        self.run
            .break_deformed(&numbers, judged, &critical.internal, at)
    }

    /// Applies the breakage of a step and a round; returns the leading bonds after it. None where it must be applied to the whole body.
    pub(super) fn follow(
        &mut self,
        breakage: &Breakage,
        at: [usize; 2],
    ) -> Result<Option<Leaders>, SetupError> {
        if self.run.collapsed || !self.run.equations.can_update(breakage) {
            return Ok(None);
        }
        let [step, round] = at;
        self.run.enter(step, round)?;
        let leaders = self.update(breakage);
        if leaders.is_some() {
            let after = self.known();
            self.run.account(step, breakage, &after)?;
        }
        Ok(leaders)
    }

    /// Updates the motions for a breakage. None where the update of the factor failed, or moves points beyond the size of the body.
    fn update(&mut self, breakage: &Breakage) -> Option<Leaders> {
        let scale = self.factor().recip();
        let Run {
            equations, state, ..
        } = &mut *self.run;
        let points = self.problem.system.points_of_breakage(&breakage.bonds);
        let farthest = scale * equations.size_or_prescribed(state);
        let lagging = &mut self.lagging;
        let leaders = equations.update_and_forward_solve(state, breakage, |factor, half| {
            let correction = ForwardSubstituted {
                factor,
                by_row: half.by_row(),
                scale,
            };
            lagging.follow(correction, &points, (state, farthest))
        })?;
        let start = Instant::now();
        self.know(&breakage.bonds);
        self.add_up_forces();
        self.run.equations.count_bond_work(start);
        Some(leaders)
    }

    /// Equilibrium at the load factor of the state, as far as known.
    pub(super) fn known(&self) -> Balanced {
        self.line.scaled(self.factor())
    }

    /// Ratio of the displacements of the state to the delayed ones.
    fn factor(&self) -> f64 {
        match self.run.state.load_factor {
            same if same == self.load_factor => 1.0,
            other => other / self.load_factor,
        }
    }

    /// Sets the motions of the observed points, and of those on which a breakage of some bonds depends, in the state.
    pub(super) fn know(&mut self, bonds: &[u32]) {
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

    /// Ends with the motions of all points at the load factor of the state.
    pub(super) fn catch_up(mut self) {
        self.know_all();
    }

    fn know_all(&mut self) {
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
    pub(super) fn before(mut self, breakage: &Breakage) -> Balanced {
        self.know_all();
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
