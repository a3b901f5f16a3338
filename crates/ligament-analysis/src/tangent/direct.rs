//! Direct solution with a symmetric factor, L L^T or L D L^T, that is updated in place or computed anew.

use std::io::Read;
use std::sync::Arc;
use std::time::Instant;

use ligament_linalg::{
    FactorError, FactorKind, Factorisation, Inertia, RankOne, SymmetricMatrix, VANISHING_PIVOT,
};
use ligament_model::element::{StiffnessFactors, Term};

use super::factor_record::FactorRecord;
use super::iterative;
use super::terms::{Coupled, due_bonds, fits};
use super::{AllowedResidual, HalfUpdated, IntactSolver, SOFT_HOLD, TangentSolver, Unsolved};
use crate::breakage::Breakage;
use crate::checkpoint::CheckpointError;
use crate::contact::resisting::{self, Resisting};
use crate::costs::Costs;
use crate::serial::{Damaged, Serial, Sink};
use crate::solver::{DirectChoice, Update};
use crate::state::State;
use crate::stiffness::Stiffness;
use ligament_model::thermal::ThermalStrain;

/// Number of times that the secants of softening bonds are factorised after a factor of their tangents was not definite.
const REFUSED: usize = 10;

/// A direct solver for symmetric stiffnesses.
pub(crate) struct DirectSolver {
    stiffness: Arc<Stiffness>,
    factor: Option<Box<dyn Factorisation>>,
    /// Outdated factor, whose memory is reused.
    stale: Option<Box<dyn Factorisation>>,
    /// Bonds, supports and updates from which the factor resulted.
    making: FactorRecord,
    /// Remaining stiffness of softening bonds in the factor, shape (n_bonds); empty where none softens.
    remaining: Vec<StiffnessFactors>,
    /// Falling stiffness of bonds in the factor, with their numbers.
    falling: Vec<(u32, Term)>,
    /// Number of next falling stiffnesses that are not added, because the body was not stable with the last one.
    refused: usize,
    /// Closed pairs across cracks, which are in the factor if there is one.
    closed: Vec<Resisting>,
    /// Whether faces may be pressed against each other.
    presses: bool,
    /// Groups of points that contacts between surfaces have coupled.
    coupled_by_contact: Vec<Vec<u32>>,
    /// Whether the pattern lacks some of these groups.
    lacks_coupled: bool,
    /// Number of elements lost or changed so far.
    n_changed: usize,
}

impl DirectSolver {
    /// Builds a solver without a factor; `presses` where faces may be pressed against each other.
    pub(crate) fn new(stiffness: Arc<Stiffness>, presses: bool) -> Self {
        Self {
            presses,
            coupled_by_contact: Vec::new(),
            lacks_coupled: false,
            stiffness,
            factor: None,
            stale: None,
            making: FactorRecord::default(),
            remaining: Vec::new(),
            falling: Vec::new(),
            refused: 0,
            closed: Vec::new(),
            n_changed: 0,
        }
    }

    /// An independent copy with the same factor.
    fn copy(&self) -> Self {
        Self {
            stiffness: self.stiffness.clone(),
            factor: self.factor.as_ref().map(|it| it.copied()),
            stale: None,
            making: self.making.clone(),
            remaining: self.remaining.clone(),
            falling: self.falling.clone(),
            refused: self.refused,
            closed: self.closed.clone(),
            presses: self.presses,
            coupled_by_contact: self.coupled_by_contact.clone(),
            lacks_coupled: self.lacks_coupled,
            n_changed: self.n_changed,
        }
    }

    fn coupled(&self) -> Coupled<'_> {
        Coupled {
            system: self.stiffness.system(),
            unknowns: self.stiffness.unknowns(),
            cut_off: &self.making.held,
            hold_share: self.hold_share(),
        }
    }

    /// Stiffness that an added support adds to a diagonal entry, as a share of that entry.
    fn hold_share(&self) -> f64 {
        if self.supports_are_soft() {
            SOFT_HOLD
        } else {
            1.0
        }
    }

    /// Whether added supports only make the tangent definite, because closing faces may carry their loads.
    fn supports_are_soft(&self) -> bool {
        self.presses
    }

    /// Adds to the pattern the points of contacts that it does not couple. The factor must then be recomputed.
    fn couple(&mut self, come: &[Resisting]) {
        let layout = self.stiffness.unknowns().layout();
        for it in come.iter().filter(|it| it.is_of_surfaces()) {
            let points = it.points(layout);
            if !self.stiffness.couples(&points) && !self.coupled_by_contact.contains(&points) {
                self.coupled_by_contact.push(points);
                self.lacks_coupled = true;
            }
        }
        if self.lacks_coupled {
            // Factors of another pattern are of no use.
            (self.factor, self.stale) = (None, None);
        }
    }

    /// Bonds and supports of a state for a new factor.
    fn begun(&self, state: &State) -> FactorRecord {
        let is_soft = self.supports_are_soft();
        let is_held = |&dof: &usize| state.held[dof];
        let dofs = 0..state.held.len();
        let cut_off: Vec<bool> = dofs.clone().map(|dof| !is_soft && is_held(&dof)).collect();
        let coupled = Coupled {
            system: self.stiffness.system(),
            unknowns: self.stiffness.unknowns(),
            cut_off: &cut_off,
            hold_share: self.hold_share(),
        };
        let mut beside = coupled.of_falling(&self.falling, 1.0);
        beside.extend(coupled.of_holds(dofs.filter(|dof| is_soft && is_held(dof))));
        beside.extend(coupled.of_contact(&self.closed, 1.0));
        FactorRecord::begun(state, cut_off, beside)
    }

    /// Updates the factor in place by rank-one terms; discards it where the update fails.
    fn change(
        &mut self,
        mut factor: Box<dyn Factorisation>,
        terms: Vec<RankOne>,
        costs: &mut Costs,
    ) {
        let start = Instant::now();
        let changed = factor.change(&terms, &[]);
        costs.change += start.elapsed();
        costs.changes += 1;
        match changed {
            Ok(_) => {
                self.making.changes.push(terms);
                self.factor = Some(factor);
            }
            Err(_) => self.stale = Some(factor),
        }
    }

    /// Discards the factor where `n_elements` changes are too many for an update in place, or a recomputation is due.
    fn forget_unless_in_place(&mut self, n_elements: usize) {
        let in_place = self.is_in_place(n_elements);
        self.n_changed += n_elements;
        if !in_place {
            self.discard();
        }
    }

    fn is_in_place(&self, n_elements: usize) -> bool {
        let DirectChoice {
            update,
            rebuild_every,
            most_bonds_in_place,
            ..
        } = *self.stiffness.choice();
        update == Update::Incremental
            && self.n_changed / rebuild_every == (self.n_changed + n_elements) / rebuild_every
            && n_elements <= most_bonds_in_place
    }

    /// Replaces N residual forces (n_unknowns) by their corrections.
    fn solve_with<const N: usize>(
        &mut self,
        state: &State,
        mut forces: [&mut [f64]; N],
        costs: &mut Costs,
        solve: impl FnOnce(&mut dyn Factorisation, [&mut [f64]; N]),
    ) {
        let start = Instant::now();
        let dofs = self.stiffness.unknowns().degrees_of_freedom();
        for force in &mut forces {
            for (value, &dof) in force.iter_mut().zip(dofs) {
                if self.making.held[dof as usize] {
                    *value = 0.0;
                }
            }
        }
        if let Some(factor) = &mut self.factor {
            solve(&mut **factor, forces.each_mut().map(|it| &mut **it));
        }
        for force in forces {
            self.keep_held(state, force);
        }
        costs.solves += N;
        costs.solve += start.elapsed();
    }

    /// Sets the correction at fixed degrees of freedom of the state to zero, removing its rounding.
    fn keep_held(&self, state: &State, correction: &mut [f64]) {
        if self.supports_are_soft() {
            return;
        }
        let dofs = self.stiffness.unknowns().degrees_of_freedom().iter();
        for (value, &dof) in correction.iter_mut().zip(dofs) {
            if state.held[dof as usize] {
                *value = 0.0;
            }
        }
    }
}

impl IntactSolver for DirectSolver {
    fn copied(&self) -> Box<dyn TangentSolver> {
        Box::new(self.copy())
    }
}

impl TangentSolver for DirectSolver {
    fn follow(
        &mut self,
        breakage: &Breakage,
        state: &State,
        expansion: ThermalStrain<'_>,
        costs: &mut Costs,
    ) -> Option<Vec<f64>> {
        let half = self.update_and_forward_solve(breakage, state, expansion, costs)?;
        let start = Instant::now();
        let mut correction = half.factor.finish(half.correction);
        self.keep_held(state, &mut correction);
        costs.backward += start.elapsed();
        costs.solves += 1;
        Some(correction)
    }

    fn can_update(&self, n_elements: usize) -> bool {
        self.factor.is_some() && self.is_in_place(n_elements)
    }

    fn factor(&self) -> Option<&dyn Factorisation> {
        self.factor.as_deref()
    }

    fn update_and_forward_solve(
        &mut self,
        breakage: &Breakage,
        state: &State,
        expansion: ThermalStrain<'_>,
        costs: &mut Costs,
    ) -> Option<HalfUpdated<'_>> {
        if self.factor.is_none() || (breakage.bonds.is_empty() && breakage.holds.is_empty()) {
            return None;
        }
        self.forget_unless_in_place(breakage.n_elements());
        let mut factor = self.factor.take()?;
        let start = Instant::now();
        let is_broken = |(bond, _): &mut (u32, Term)| breakage.bonds.contains(bond);
        let of_broken: Vec<(u32, Term)> = self.falling.extract_if(.., is_broken).collect();
        let coupled = self.coupled();
        let mut terms = coupled.of_falling(&of_broken, -1.0);
        terms.extend(coupled.of_breakage(breakage));
        // An added support carries no force in equilibrium, so that the size of its term does not matter and du is zero there up to
        // rounding, which is removed later. For this the right-hand side must contain the forces at the added supports.
        let force = breakage.unbalanced_force(&state.displacement, expansion);
        let force: Vec<(usize, f64)> = (force.into_iter())
            .filter_map(|(dof, value)| Some((coupled.number(dof)?, value)))
            .collect();
        let half_solved = factor.change(&terms, &force);
        costs.change += start.elapsed();
        costs.changes += 1;
        // After a failed update the factor is computed anew, which detects a singular matrix.
        let Ok(correction) = half_solved else {
            self.stale = Some(factor);
            return None;
        };
        self.making.changes.push(terms);
        let factor = &**self.factor.insert(factor);
        Some(HalfUpdated { factor, correction })
    }

    fn fall(&mut self, falling: Vec<(u32, Term)>) -> bool {
        let is_definite = self.stiffness.choice().factorisation == FactorKind::Llt;
        let changes = !(falling.is_empty() && self.falling.is_empty());
        if self.refused > 0 && !falling.is_empty() {
            self.refused -= 1;
            return false;
        }
        if is_definite && changes {
            self.falling = falling;
            self.discard();
        }
        is_definite && changes
    }

    fn update_for_softening(&mut self, state: &State, costs: &mut Costs) {
        if self.factor.is_none() || !self.falling.is_empty() {
            return;
        }
        // A factor of the elastic body has the whole stiffness of every bond.
        let n_bonds = state.softening.remaining.len();
        self.remaining.resize(n_bonds, StiffnessFactors::WHOLE);
        let due = due_bonds(&self.remaining, state);
        if due.is_empty() {
            return;
        }
        self.forget_unless_in_place(due.len());
        let Some(factor) = self.factor.take() else {
            return;
        };
        let start = Instant::now();
        let mut in_factor = std::mem::take(&mut self.remaining);
        let terms = self.coupled().of_softening(&due, &mut in_factor, state);
        self.remaining = in_factor;
        costs.change += start.elapsed();
        self.change(factor, terms, costs);
    }

    fn close(&mut self, mut resisting: Vec<Resisting>, costs: &mut Costs) {
        let (gone, come) = resisting::changes(&self.closed, &mut resisting);
        self.closed = resisting;
        self.couple(&come);
        let n_changes = gone.len() + come.len();
        if self.factor.is_none() || n_changes == 0 {
            return;
        }
        self.forget_unless_in_place(n_changes);
        let Some(factor) = self.factor.take() else {
            return;
        };
        // Terms that add stiffness come first, so that every intermediate matrix is definite if the last one is.
        let mut terms = self.coupled().of_contact(&come, 1.0);
        terms.extend(self.coupled().of_contact(&gone, -1.0));
        self.change(factor, terms, costs);
    }

    fn prepare(&mut self, state: &State, costs: &mut Costs) -> Result<Vec<usize>, FactorError> {
        if self.factor.is_some() {
            return Ok(Vec::new());
        }
        let start = Instant::now();
        if std::mem::take(&mut self.lacks_coupled) {
            self.stiffness = Arc::new(self.stiffness.with_coupled(&self.coupled_by_contact)?);
        }
        let making = self.begun(state);
        let matrix = making.matrix(&self.stiffness);
        costs.assembly += start.elapsed();
        let start = Instant::now();
        let factor = match self.stale.take() {
            Some(mut stale) => match stale.refactorise(&matrix) {
                Ok(()) => Ok(stale),
                Err(error) => {
                    self.stale = Some(stale);
                    Err(error)
                }
            },
            None => {
                let kind = self.stiffness.choice().factorisation;
                kind.factorise(self.stiffness.symbolic(), &matrix)
            }
        };
        costs.factorisation += start.elapsed();
        costs.factorisations += 1;
        let vanishing = match &factor {
            Ok(factor) => vanishing_pivots(factor.as_ref(), &matrix),
            Err(
                FactorError::ZeroPivot { unknown } | FactorError::NotPositiveDefinite { unknown },
            ) => vec![*unknown],
            Err(other) => return Err(other.clone()),
        };
        if !(vanishing.is_empty() || self.falling.is_empty()) {
            // Along its motion the body is not stable at these loads, as after a peak: secants are.
            self.falling.clear();
            self.refused = REFUSED;
            self.stale = factor.ok().or(self.stale.take());
            return self.prepare(state, costs);
        }
        if vanishing.is_empty() {
            self.factor = factor.ok();
            self.making = making;
            self.remaining.clone_from(&state.softening.remaining);
        }
        let dofs = self.stiffness.unknowns().degrees_of_freedom();
        Ok(vanishing.into_iter().map(|it| dofs[it] as usize).collect())
    }

    fn solve(
        &mut self,
        state: &State,
        mut force: Vec<f64>,
        _: AllowedResidual,
        costs: &mut Costs,
    ) -> Result<Vec<f64>, Unsolved> {
        self.solve_with(state, [&mut force], costs, |factor, [force]| {
            factor.solve_in_place(force);
        });
        Ok(force)
    }

    fn solve_both(
        &mut self,
        state: &State,
        mut forces: [Vec<f64>; 2],
        _: AllowedResidual,
        costs: &mut Costs,
    ) -> Result<[Vec<f64>; 2], Unsolved> {
        let both = forces.each_mut().map(Vec::as_mut_slice);
        self.solve_with(state, both, costs, |factor, both| {
            factor.solve_both_in_place(both)
        });
        Ok(forces)
    }

    fn tolerance(&self) -> Option<f64> {
        None
    }

    fn is_changed(&self) -> bool {
        self.factor.is_some() && !self.making.changes.is_empty()
    }

    fn discard(&mut self) {
        self.stale = self.factor.take().or(self.stale.take());
    }

    fn intact(&self) -> Option<Box<dyn IntactSolver>> {
        Some(Box::new(self.copy()))
    }

    fn inertia(&self) -> Option<Inertia> {
        self.factor.as_ref().map(|factor| factor.inertia())
    }

    fn write(&self, out: &mut dyn Sink) {
        self.n_changed.write(out);
        self.coupled_by_contact.write(out);
        self.falling.write(out);
        self.refused.write(out);
        let factor = self.factor.as_ref().map(|factor| factor.digest());
        factor.write(out);
        if factor.is_some() {
            self.making.write(out);
            self.remaining.write(out);
            self.closed.write(out);
        }
    }

    fn restore(&mut self, from: &mut dyn Read) -> Result<(), CheckpointError> {
        let first = u64::read(from)?;
        if first == iterative::MARK {
            return Err(CheckpointError::OtherMethod);
        }
        self.n_changed = first.try_into().map_err(|_| Damaged)?;
        self.coupled_by_contact = Serial::read(from)?;
        self.falling = Serial::read(from)?;
        self.refused = Serial::read(from)?;
        let system = self.stiffness.system();
        let mut points = self.coupled_by_contact.iter().flatten();
        if points.any(|it| *it as usize >= system.n_points()) || !fits(&self.falling, system) {
            return Err(CheckpointError::OtherModel);
        }
        if !self.coupled_by_contact.is_empty() {
            let stiffness = self.stiffness.with_coupled(&self.coupled_by_contact);
            self.stiffness = Arc::new(stiffness.map_err(|_| CheckpointError::OtherModel)?);
        }
        let Some(digest) = Option::<u64>::read(from)? else {
            return Ok(());
        };
        self.making = Serial::read(from)?;
        self.remaining = Serial::read(from)?;
        self.closed = Serial::read(from)?;
        if !(self.making).fits(self.stiffness.system(), self.stiffness.unknowns()) {
            return Err(CheckpointError::OtherModel);
        }
        let factor = self.making.factor(&self.stiffness);
        self.factor = factor.filter(|factor| factor.digest() == digest);
        match self.factor {
            Some(_) => Ok(()),
            None => Err(CheckpointError::OtherArithmetic),
        }
    }
}

fn vanishing_pivots(factor: &dyn Factorisation, matrix: &SymmetricMatrix) -> Vec<usize> {
    let pivots = factor.pivots();
    (0..pivots.len())
        .filter(|&i| pivots[i].abs() < VANISHING_PIVOT * matrix.diagonal(i).abs())
        .collect()
}
