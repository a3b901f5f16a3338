//! Changes of the factor in place while bonds break and soften.

use std::time::Instant;

use ligament_linalg::RankOne;
use ligament_model::element::{Remaining, Term};
use rayon::prelude::*;

use super::{SolverChoice, Stiffness, Update};
use crate::boundary::Boundary;
use crate::breakage::Breakage;
use crate::connectivity::Hold;
use crate::state::State;
use crate::unknowns::COMPONENTS;

/// Bonds that make a task worth while.
const TASK: usize = 4096;

/// Relative change of a bond's secant stiffness from which the factor is changed. On a softening bar 0.05 takes the iterations
/// of exact secants with a third of the factorisations; with 0.15 the states after the peak were others.
const SECANT_TOLERANCE: f64 = 0.05;

impl Stiffness<'_> {
    /// Changes the factor by a breakage, and solves for the force that the broken bonds carried: the correction of the
    /// unknowns, shape (n_unknowns). None where nothing broke or the factor has to be made anew.
    ///
    /// K' du = (K - K') u, K' the matrix of the bonds that are left + the terms of the holds (a positive diagonal entry of the size
    /// of the one that was there). A hold carries no force in equilibrium, so the size of its term does not matter and du is zero there:
    /// up to rounding, which is taken away. For this the forces at the holds must be in the right-hand side.
    pub(crate) fn follow(
        &mut self,
        breakage: &Breakage,
        state: &State,
        boundary: &Boundary,
    ) -> Option<Vec<f64>> {
        if self.factor.is_none() || (breakage.bonds.is_empty() && breakage.holds.is_empty()) {
            return None;
        }
        self.forget_unless_in_place(breakage.n_elements());
        let mut factor = self.factor.take()?;
        let start = Instant::now();
        let mut terms = self.hold_terms(&breakage.holds);
        // What adds stiffness goes first, so that every matrix on the way is definite if the last one is.
        terms.extend(
            breakage
                .gained_terms()
                .filter_map(|term| self.at_unknowns(term, 1.0)),
        );
        terms.extend(
            breakage
                .lost_terms()
                .filter_map(|term| self.at_unknowns(term, -1.0)),
        );
        let expansion = boundary.thermal_strain_at(state.load_factor);
        let force = breakage.unbalanced_force(&state.displacement, expansion);
        let force: Vec<(usize, f64)> = (force.into_iter())
            .filter_map(|(dof, value)| Some((self.number(dof)?, value)))
            .collect();
        let half_solved = factor.change(&terms, &force);
        self.costs.change += start.elapsed();
        self.costs.changes += 1;
        // After a change that failed the factor is made anew, and that tells what is wrong if anything is.
        let Ok(half_solved) = half_solved else {
            self.stale = Some(factor);
            return None;
        };
        let start = Instant::now();
        let mut correction = factor.finish(half_solved);
        self.keep_held(state, &mut correction);
        self.costs.backward += start.elapsed();
        self.costs.solves += 1;
        self.is_changed = true;
        self.factor = Some(factor);
        Some(correction)
    }

    /// Brings the factor up to date with what is left of softening bonds.
    ///
    /// Bonds that are near enough to what the factor has of them wait: the iteration finds the residual with the bonds as they
    /// are, and gets as near with a factor that is a little off.
    pub(crate) fn weaken(&mut self, state: &State) {
        if self.factor.is_none() {
            return;
        }
        let remaining = &state.softening.remaining;
        // A factor of the elastic body has all of every bond.
        self.remaining.resize(remaining.len(), Remaining::WHOLE);
        let in_factor = &self.remaining;
        let is_due = |bond: &usize| {
            state.intact[*bond] && in_factor[*bond].is_off(&remaining[*bond], SECANT_TOLERANCE)
        };
        let due: Vec<usize> = (0..remaining.len())
            .into_par_iter()
            .with_min_len(TASK)
            .filter(is_due)
            .collect();
        if due.is_empty() {
            return;
        }
        self.forget_unless_in_place(due.len());
        let Some(mut factor) = self.factor.take() else {
            return;
        };
        let start = Instant::now();
        let mut terms = Vec::with_capacity(COMPONENTS * due.len());
        for &bond in &due {
            let lost = self.remaining[bond].lost(&remaining[bond]);
            let of_element = self.system.terms(&state.intact, bond, &lost).into_iter();
            terms.extend(of_element.filter_map(|term| self.at_unknowns(term, -1.0)));
            self.remaining[bond] = remaining[bond];
        }
        // What adds stiffness goes first, so that every matrix on the way is definite if the last one is.
        terms.sort_by_key(|term| term.weight < 0.0);
        let changed = factor.change(&terms, &[]);
        self.costs.change += start.elapsed();
        self.costs.changes += 1;
        match changed {
            Ok(_) => {
                self.is_changed = true;
                self.factor = Some(factor);
            }
            Err(_) => self.stale = Some(factor),
        }
    }

    /// Forgets the factor where `n_elements` changes are too many for a change in place, or it is time to make it anew.
    fn forget_unless_in_place(&mut self, n_elements: usize) {
        let SolverChoice {
            update,
            rebuild_every,
            most_bonds_in_place,
            ..
        } = self.choice;
        let period_before = self.n_changed / rebuild_every;
        self.n_changed += n_elements;
        let in_place = update == Update::Incremental
            && self.n_changed / rebuild_every == period_before
            && n_elements <= most_bonds_in_place;
        if !in_place {
            self.forget();
        }
    }

    /// What holds add to the matrix. They go in before bonds leave: no pivot vanishes in between.
    fn hold_terms(&self, holds: &[Hold]) -> Vec<RankOne> {
        let held = holds.iter().map(|hold| hold.degree_of_freedom);
        let holds = held.filter_map(|dof| {
            let entries = vec![(self.number(dof)?, 1.0)];
            let diagonal = self.whole_diagonal(dof).abs();
            let weight = if diagonal == 0.0 { 1.0 } else { diagonal };
            Some(RankOne { weight, entries })
        });
        holds.collect()
    }

    /// A term of an element times a factor, at the unknowns; none where it changes nothing.
    fn at_unknowns(&self, (rigidity, entries): Term, factor: f64) -> Option<RankOne> {
        let entries: Vec<(usize, f64)> = (entries.into_iter())
            .filter_map(|(dof, value)| Some((self.number(dof)?, value)))
            .collect();
        let matters = rigidity != 0.0 && !entries.is_empty();
        matters.then_some(RankOne {
            weight: factor * rigidity,
            entries,
        })
    }

    /// Diagonal entry of the matrix with all bonds.
    fn whole_diagonal(&self, dof: usize) -> f64 {
        let whole = vec![true; self.system.ends().len()];
        let point = (dof / COMPONENTS) as u32;
        let elements = self.system.elements_at_points().at(point).iter();
        elements
            .flat_map(|&bond| self.system.terms(&whole, bond as usize, &Remaining::WHOLE))
            .map(|(rigidity, entries)| {
                let own = entries.iter().filter(|(of, _)| *of == dof);
                own.map(|(_, value)| rigidity * value * value).sum::<f64>()
            })
            .sum()
    }
}
