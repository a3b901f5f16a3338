//! Iterative solution without a matrix: conjugate gradients with block Jacobi and the rigid motions of aggregates.
//!
//! The stiffness is always computed from the present bonds; only the preconditioner is stored. The blocks of points are recomputed where
//! bonds broke, and the share of these bonds is subtracted from the coarse stiffness. The coarse space is rebuilt where a part
//! became detached, and where the iterations in excess of its initial rate have cost as much as a rebuild. Its equations have a factor, and in
//! large bodies in space an iteration with a coarser space, a third level.

mod aggregates;
mod clusters;
mod coarse;
mod coarse_basis;
mod coarse_factor;
mod coarse_iteration;
mod coarse_stiffness;
mod conjugate;
mod operator;
mod point_blocks;
mod resistance;
mod unresisted;

use std::collections::BTreeSet;
use std::io::Read;
use std::sync::Arc;
use std::time::Instant;

use ligament_linalg::{FactorError, Inertia, RankOne};
use ligament_model::element::{StiffnessFactors, Term};
use ligament_model::thermal::ThermalStrain;
use ligament_model::{Bonds, UnbrokenBonds};

use self::coarse::Coarse;
use self::conjugate::{Found, Limit, TwoLevels};
use self::operator::Operator;
use self::point_blocks::PointBlocks;
use super::factor_record::FactorRecord;
use super::terms::{self, Coupled, due_bonds};
use super::{AllowedResidual, SOFT_HOLD, TangentSolver, Unsolved};
use crate::breakage::Breakage;
use crate::checkpoint::CheckpointError;
use crate::contact::resisting::{self, Resisting};
use crate::costs::Costs;
use crate::serial::{Serial, Sink};
use crate::solver::IterativeChoice;
use crate::state::State;
use crate::unknowns::Unknowns;
use crate::vectors::dot_of_chunks;

pub(super) use point_blocks::vanishing_of_block;

/// Largest number of elements changed at once for an update of the coarse stiffness; more cost as much as a rebuild.
const MOST_IN_PLACE: usize = 100;

/// Number of iterations that cost as much as a new coarse space.
const RENEWAL: f64 = 40.0;

/// First bytes of the checkpoint of this solver, which differ from any other solver's.
pub(super) const MARK: u64 = 0x6576_6974_6172_6574;

/// An iterative solver for symmetric, definite stiffnesses of linear bonds.
pub(crate) struct IterativeSolver {
    system: Arc<dyn Bonds>,
    unknowns: Arc<Unknowns>,
    choice: IterativeChoice,
    levels: Option<TwoLevels>,
    /// Bonds and supports from which the coarse space was built, and later updates of its stiffness.
    coarse_of: FactorRecord,
    /// Remaining stiffness of softening bonds in the coarse stiffness, shape (n_bonds); empty where none softens.
    in_coarse: Vec<StiffnessFactors>,
    /// Bonds and supports from which the blocks of the points were computed.
    blocks_of: FactorRecord,
    /// Points whose blocks are outdated.
    stale: BTreeSet<u32>,
    /// Whether the coarse space must be rebuilt.
    is_due: bool,
    /// Iterations per decade of residual reduction with the new coarse space.
    pace: Option<f64>,
    /// Iterations in excess of that rate since then.
    excess: f64,
    /// Falling stiffness of bonds, with their numbers; in no preconditioner.
    falling: Vec<(u32, Term)>,
    /// Closed pairs across cracks.
    closed: Vec<Resisting>,
    /// Whether faces may be pressed against each other.
    presses: bool,
}

/// Free degrees of freedom and additional terms of the equations of one state.
struct Moment {
    free: Vec<bool>,
    beside: Vec<Term>,
}

impl IterativeSolver {
    /// Builds a solver without a preconditioner.
    pub(crate) fn new(
        system: Arc<dyn Bonds>,
        unknowns: Arc<Unknowns>,
        choice: IterativeChoice,
        presses: bool,
    ) -> Self {
        Self {
            presses,
            system,
            unknowns,
            choice,
            levels: None,
            coarse_of: FactorRecord::default(),
            in_coarse: Vec::new(),
            blocks_of: FactorRecord::default(),
            stale: BTreeSet::new(),
            is_due: true,
            pace: None,
            excess: 0.0,
            falling: Vec::new(),
            closed: Vec::new(),
        }
    }

    /// Bonds and supports of a state.
    fn made_of(&self, state: &State) -> FactorRecord {
        if !self.presses {
            return FactorRecord::begun(state, state.held.clone(), Vec::new());
        }
        let cut_off = vec![false; state.held.len()];
        let coupled = Coupled {
            system: &*self.system,
            unknowns: &self.unknowns,
            cut_off: &cut_off,
            hold_share: SOFT_HOLD,
        };
        let held = (0..state.held.len()).filter(|&dof| state.held[dof]);
        let mut beside = coupled.of_holds(held);
        beside.extend(coupled.of_contact(&self.closed, 1.0));
        FactorRecord::begun(state, cut_off, beside)
    }

    fn moment(&self, making: &FactorRecord) -> Moment {
        let dofs = self.unknowns.degrees_of_freedom();
        let mut free = vec![false; making.held.len()];
        for &dof in dofs {
            free[dof as usize] = !making.held[dof as usize];
        }
        let at_dofs = |(unknown, value): &(usize, f64)| (dofs[*unknown] as usize, *value);
        let beside = making.beside.iter();
        let beside = beside.map(|it| (it.weight, it.entries.iter().map(at_dofs).collect()));
        Moment {
            free,
            beside: beside.collect(),
        }
    }

    fn operator<'a>(&'a self, moment: &'a Moment, bonds: UnbrokenBonds<'a>) -> Operator<'a> {
        Operator {
            system: &*self.system,
            unknowns: &self.unknowns,
            bonds,
            free: &moment.free,
            beside: &moment.beside,
        }
    }

    /// Builds both levels; or returns the degrees of freedom without stiffness.
    fn levels_of(
        &self,
        making: &FactorRecord,
    ) -> Result<Result<TwoLevels, Vec<usize>>, FactorError> {
        let moment = self.moment(making);
        let operator = self.operator(&moment, making.bonds());
        let (blocks, loose) = PointBlocks::new(&operator)?;
        if !loose.is_empty() {
            return Ok(Err(loose));
        }
        let coarse = Coarse::new(&operator, blocks.diagonal(), &self.choice)?;
        Ok(Ok(TwoLevels { blocks, coarse }))
    }

    /// Recomputes outdated blocks; returns the degrees of freedom without stiffness.
    ///
    /// # Errors
    ///
    /// If a block is not definite.
    fn renew_blocks(&mut self, making: FactorRecord) -> Result<Vec<usize>, FactorError> {
        let newly_held = (making.held.iter().zip(&self.blocks_of.held))
            .enumerate()
            .filter(|(_, (now, before))| now != before);
        let layout = self.unknowns.layout();
        let of_holds = newly_held.map(|(dof, _)| layout.point(dof));
        self.stale.extend(of_holds);
        if self.stale.is_empty() {
            return Ok(Vec::new());
        }
        let stale = std::mem::take(&mut self.stale);
        let Some(mut levels) = self.levels.take() else {
            return Ok(Vec::new());
        };
        let moment = self.moment(&making);
        let operator = self.operator(&moment, making.bonds());
        // Both ends of a softening bond must have entries from the same state.
        let loose = if making.remaining.is_empty() {
            levels.blocks.renew(&operator, stale.iter().copied())?
        } else {
            let (blocks, loose) = PointBlocks::new(&operator)?;
            levels.blocks = blocks;
            loose
        };
        self.levels = Some(levels);
        self.blocks_of = making;
        if !loose.is_empty() {
            self.stale = stale;
        }
        Ok(loose)
    }

    /// Updates the excess of iterations by a solution, which decides whether the coarse space is rebuilt.
    fn judge(&mut self, found: &Found) {
        if found.iterations == 0 || !found.decades.is_finite() || found.decades <= 0.0 {
            return;
        }
        let iterations = found.iterations as f64;
        match self.pace {
            None => self.pace = Some(iterations / found.decades),
            Some(pace) => self.excess += (iterations - pace * found.decades).max(0.0),
        }
        self.is_due |= self.excess > RENEWAL;
    }

    /// Updates the coarse stiffness by terms at unknowns; marks it for a rebuild where that fails.
    fn change_coarse(&mut self, terms: Vec<RankOne>) {
        let Some(levels) = &mut self.levels else {
            return;
        };
        if levels
            .coarse
            .change(&at_degrees_of_freedom(&self.unknowns, &terms))
        {
            self.coarse_of.changes.push(terms);
        } else {
            self.is_due = true;
        }
    }

    /// Whether the coarse stiffness is updated for `n_elements` changes; too many mark it for a rebuild.
    fn is_changed_in_place(&mut self, n_elements: usize) -> bool {
        self.is_due |= n_elements > MOST_IN_PLACE;
        n_elements > 0 && !self.is_due && self.levels.is_some()
    }

    /// Couplings of the unknowns of the coarse space.
    fn coupled(&self) -> Coupled<'_> {
        Coupled {
            system: &*self.system,
            unknowns: &self.unknowns,
            cut_off: &self.coarse_of.held,
            hold_share: SOFT_HOLD,
        }
    }

    /// Unknowns among some degrees of freedom.
    fn unknown_of(&self, mut dofs: Vec<usize>) -> Vec<usize> {
        dofs.retain(|&dof| self.unknowns.is_unknown(dof));
        dofs
    }

    fn stale_at(&mut self, dofs: impl Iterator<Item = usize>) {
        let layout = self.unknowns.layout();
        self.stale.extend(dofs.map(|dof| layout.point(dof)));
    }
}

impl TangentSolver for IterativeSolver {
    fn follow(
        &mut self,
        breakage: &Breakage,
        _: &State,
        _: ThermalStrain<'_>,
        costs: &mut Costs,
    ) -> Option<Vec<f64>> {
        let start = Instant::now();
        let terms = breakage.lost_terms().chain(breakage.gained_terms());
        let entries = terms.flat_map(|(_, entries)| entries);
        let dofs: BTreeSet<usize> = entries.map(|(dof, _)| dof).collect();
        self.stale_at(dofs.into_iter());
        // The rigid motions of a detached part are among the softest motions.
        self.is_due |= !breakage.holds.is_empty();
        self.falling
            .retain(|(bond, _)| !breakage.bonds.contains(bond));
        if self.is_changed_in_place(breakage.n_elements()) {
            self.change_coarse(self.coupled().of_breakage(breakage));
        }
        costs.change += start.elapsed();
        None
    }

    fn fall(&mut self, falling: Vec<(u32, Term)>) -> bool {
        let changes = !(falling.is_empty() && self.falling.is_empty());
        self.falling = falling;
        changes
    }

    fn update_for_softening(&mut self, state: &State, costs: &mut Costs) {
        let start = Instant::now();
        let n_bonds = state.softening.remaining.len();
        let mut in_blocks = self.blocks_of.remaining.clone();
        in_blocks.resize(n_bonds, StiffnessFactors::WHOLE);
        let due = due_bonds(&in_blocks, state);
        let ends = &self.system.ends;
        let of_due = due.into_iter().flat_map(|bond| ends[bond]);
        self.stale.extend(of_due);
        self.in_coarse.resize(n_bonds, StiffnessFactors::WHOLE);
        let due = due_bonds(&self.in_coarse, state);
        if self.is_changed_in_place(due.len()) {
            let mut in_coarse = std::mem::take(&mut self.in_coarse);
            let terms = self.coupled().of_softening(&due, &mut in_coarse, state);
            self.in_coarse = in_coarse;
            self.change_coarse(terms);
        }
        costs.change += start.elapsed();
    }

    fn close(&mut self, mut resisting: Vec<Resisting>, _: &mut Costs) {
        let (gone, come) = resisting::changes(&self.closed, &mut resisting);
        let layout = self.unknowns.layout();
        let entries = gone.iter().chain(&come).flat_map(|it| &it.row);
        self.stale
            .extend(entries.map(|(dof, _)| layout.point(*dof)));
        self.closed = resisting;
    }

    fn prepare(&mut self, state: &State, costs: &mut Costs) -> Result<Vec<usize>, FactorError> {
        let start = Instant::now();
        let making = self.made_of(state);
        if !self.is_due && self.levels.is_some() {
            let loose = self.renew_blocks(making)?;
            costs.change += start.elapsed();
            return Ok(self.unknown_of(loose));
        }
        match self.levels_of(&making)? {
            Err(loose) => return Ok(self.unknown_of(loose)),
            Ok(levels) => self.levels = Some(levels),
        }
        self.coarse_of = making.clone();
        self.in_coarse.clone_from(&making.remaining);
        self.blocks_of = making;
        self.stale.clear();
        (self.is_due, self.pace, self.excess) = (false, None, 0.0);
        costs.factorisations += 1;
        costs.factorisation += start.elapsed();
        Ok(Vec::new())
    }

    fn solve(
        &mut self,
        state: &State,
        force: Vec<f64>,
        left: AllowedResidual,
        costs: &mut Costs,
    ) -> Result<Vec<f64>, Unsolved> {
        let start = Instant::now();
        let Some(mut levels) = self.levels.take() else {
            return Err(Unsolved::Indefinite(vec![0.0; force.len()]));
        };
        let dofs = self.unknowns.degrees_of_freedom();
        let mut moment = self.moment(&self.blocks_of);
        let falling = self.falling.iter().map(|(_, term)| term.clone());
        moment.beside.extend(falling);
        let at_dofs = |values: &[f64], other: f64| {
            let mut all = vec![other; moment.free.len()];
            for (&dof, value) in dofs.iter().zip(values) {
                if moment.free[dof as usize] {
                    all[dof as usize] = *value;
                }
            }
            all
        };
        let given = at_dofs(&force, 0.0);
        let limit = match &left {
            AllowedResidual::Share(share) => {
                Limit::Norm(share * dot_of_chunks(&given, &given).sqrt())
            }
            AllowedResidual::AtMost(sizes) => Limit::Sizes(at_dofs(sizes, f64::INFINITY)),
        };
        let operator = self.operator(&moment, state.bonds());
        let mut found = conjugate::solve(&operator, &mut levels, given, &limit);
        if !(found.is_definite || self.falling.is_empty()) {
            // The body is not stable at these loads, as after a peak, and its secants are.
            self.falling.clear();
            self.levels = Some(levels);
            costs.solve += start.elapsed();
            return self.solve(state, force, left, costs);
        }
        if found.is_stalled {
            let given = at_dofs(&force, 0.0);
            if let Some(motion) = unresisted::motion(&operator, &levels.blocks, &given) {
                (found.motions, found.is_definite) = (motion, false);
            }
        }
        let solution = dofs.iter().map(|&dof| found.motions[dof as usize]);
        let solution = solution.collect();
        self.levels = Some(levels);
        self.judge(&found);
        costs.solves += 1;
        costs.iterations += found.iterations;
        costs.solve += start.elapsed();
        if found.is_definite {
            Ok(solution)
        } else {
            Err(Unsolved::Indefinite(solution))
        }
    }

    fn tolerance(&self) -> Option<f64> {
        Some(self.choice.tolerance)
    }

    fn is_changed(&self) -> bool {
        false
    }

    fn discard(&mut self) {
        self.is_due = true;
    }

    fn inertia(&self) -> Option<Inertia> {
        None
    }

    fn write(&self, out: &mut dyn Sink) {
        MARK.write(out);
        self.levels.is_some().write(out);
        self.is_due.write(out);
        self.pace.write(out);
        self.excess.write(out);
        self.stale.iter().copied().collect::<Vec<u32>>().write(out);
        self.closed.write(out);
        self.falling.write(out);
        if self.levels.is_some() {
            self.coarse_of.write(out);
            self.in_coarse.write(out);
            self.blocks_of.write(out);
        }
    }

    fn restore(&mut self, from: &mut dyn Read) -> Result<(), CheckpointError> {
        if u64::read(from)? != MARK {
            return Err(CheckpointError::OtherMethod);
        }
        let has_levels = bool::read(from)?;
        self.is_due = Serial::read(from)?;
        self.pace = Serial::read(from)?;
        self.excess = Serial::read(from)?;
        let stale: Vec<u32> = Serial::read(from)?;
        self.closed = Serial::read(from)?;
        self.falling = Serial::read(from)?;
        self.stale = stale.into_iter().collect();
        if !terms::fits(&self.falling, &*self.system) {
            return Err(CheckpointError::OtherModel);
        }
        if !has_levels {
            return Ok(());
        }
        self.coarse_of = Serial::read(from)?;
        self.in_coarse = Serial::read(from)?;
        self.blocks_of = Serial::read(from)?;
        let fits = |making: &FactorRecord| making.fits(&*self.system, &self.unknowns);
        let n_points = self.system.n_points();
        let mut stale = self.stale.iter();
        if !fits(&self.coarse_of)
            || !fits(&self.blocks_of)
            || stale.any(|it| *it as usize >= n_points)
        {
            return Err(CheckpointError::OtherModel);
        }
        let levels = self.levels_of(&self.coarse_of);
        let Ok(Ok(mut levels)) = levels else {
            return Err(CheckpointError::OtherArithmetic);
        };
        let mut changes = self.coarse_of.changes.iter();
        if !changes.all(|it| (levels.coarse).change(&at_degrees_of_freedom(&self.unknowns, it))) {
            return Err(CheckpointError::OtherArithmetic);
        }
        let moment = self.moment(&self.blocks_of);
        let operator = self.operator(&moment, self.blocks_of.bonds());
        let blocks = PointBlocks::new(&operator);
        levels.blocks = blocks.map_err(|_| CheckpointError::OtherArithmetic)?.0;
        self.levels = Some(levels);
        Ok(())
    }
}

/// Renumbers terms from unknowns to degrees of freedom.
fn at_degrees_of_freedom(unknowns: &Unknowns, terms: &[RankOne]) -> Vec<RankOne> {
    let dofs = unknowns.degrees_of_freedom();
    let of_terms = terms.iter().map(|it| {
        let entries = it.entries.iter();
        RankOne {
            weight: it.weight,
            entries: entries
                .map(|(unknown, value)| (dofs[*unknown] as usize, *value))
                .collect(),
        }
    });
    of_terms.collect()
}
