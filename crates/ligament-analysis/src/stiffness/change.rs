//! Changes of the factor in place while bonds break and soften.

use std::time::Instant;

use ligament_linalg::RankOne;
use ligament_model::element::{BondElement, Remaining};
use rayon::prelude::*;

use super::{SolverChoice, Stiffness, Update};
use crate::state::State;
use crate::unknowns::COMPONENTS;

/// Bonds that make a task worth while.
const TASK: usize = 4096;

/// Relative change of a bond's secant stiffness from which the factor is changed. On a softening bar 0.05 takes the iterations
/// of exact secants with a third of the factorisations; with 0.15 the states after the peak were others.
const SECANT_TOLERANCE: f64 = 0.05;

impl Stiffness<'_> {
    /// Changes the factor by what was noted, and solves for the force that the broken bonds carried: the correction of the
    /// unknowns, shape (n_unknowns). None where nothing was noted or the factor has to be made anew.
    ///
    /// K' du = K_b u, K' = K - K_b + the terms of the holds (a positive diagonal entry of the size of the one that was
    /// there). A hold carries no force in equilibrium, so the size of its term does not matter and du is zero there: up to
    /// rounding, which is taken away. For this the forces at the holds must be in the right-hand side.
    pub(crate) fn follow(&mut self, state: &State) -> Option<Vec<f64>> {
        let (broken, held) = (
            std::mem::take(&mut self.broken),
            std::mem::take(&mut self.held),
        );
        if broken.is_empty() && held.is_empty() {
            return None;
        }
        self.forget_unless_in_place(broken.len());
        let mut factor = self.factor.take()?;
        let start = Instant::now();
        let mut terms = self.hold_terms(&held);
        terms.extend(broken.iter().flat_map(|&bond| {
            let element = self.before_it_broke(bond, &self.remaining);
            self.terms_without(bond, &element)
        }));
        let force = self.unbalanced_force(&broken, state);
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
            let element = self.system.element(bond).weakened(&lost);
            terms.extend(self.terms_without(bond as u32, &element));
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

    /// Forgets the factor where `n_bonds` changes are too many for a change in place, or it is time to make it anew.
    fn forget_unless_in_place(&mut self, n_bonds: usize) {
        let SolverChoice {
            update,
            rebuild_every,
            most_bonds_in_place,
            ..
        } = self.choice;
        let period_before = self.n_changed / rebuild_every;
        self.n_changed += n_bonds;
        let in_place = update == Update::Incremental
            && self.n_changed / rebuild_every == period_before
            && n_bonds <= most_bonds_in_place;
        if !in_place {
            self.forget();
        }
    }

    /// A bond that just broke, with what was left of it of late (n_bonds).
    fn before_it_broke(&self, bond: u32, remaining: &[Remaining]) -> BondElement {
        let whole = self.system.element(bond as usize);
        match remaining.get(bond as usize) {
            None => whole,
            Some(remaining) => whole.weakened(remaining),
        }
    }

    /// What holds add to the matrix. They go in before bonds leave: no pivot vanishes in between.
    fn hold_terms(&self, held: &[usize]) -> Vec<RankOne> {
        let holds = held.iter().filter_map(|&dof| {
            let entries = vec![(self.number(dof)?, 1.0)];
            let diagonal = self.whole_diagonal(dof).abs();
            let weight = if diagonal == 0.0 { 1.0 } else { diagonal };
            Some(RankOne { weight, entries })
        });
        holds.collect()
    }

    /// The terms that take an element of a bond from the matrix.
    fn terms_without(&self, bond: u32, element: &BondElement) -> Vec<RankOne> {
        let [a, b] = self.system.bonds.ends[bond as usize].map(|end| COMPONENTS * end as usize);
        let degrees_of_freedom = [a, a + 1, a + 2, b, b + 1, b + 2];
        let of_mode = |(rigidity, gradient): (f64, [f64; 2 * COMPONENTS])| {
            let entries: Vec<(usize, f64)> = degrees_of_freedom
                .into_iter()
                .zip(gradient)
                .filter_map(|(dof, value)| Some((self.number(dof)?, value)))
                .filter(|&(_, value)| value != 0.0)
                .collect();
            let matters = rigidity != 0.0 && !entries.is_empty();
            matters.then_some(RankOne {
                weight: -rigidity,
                entries,
            })
        };
        element.modes().into_iter().filter_map(of_mode).collect()
    }

    /// Diagonal entry of the matrix with all bonds.
    fn whole_diagonal(&self, dof: usize) -> f64 {
        let (point, component) = (dof / COMPONENTS, dof % COMPONENTS);
        let bonds = self.system.bonds.incidence.of(point as u32).iter();
        bonds
            .map(|&bond| {
                let second = self.system.bonds.ends[bond as usize][1] as usize == point;
                let place = COMPONENTS * usize::from(second) + component;
                let modes = self.system.element(bond as usize).modes();
                modes
                    .iter()
                    .map(|(rigidity, gradient)| rigidity * gradient[place] * gradient[place])
                    .sum::<f64>()
            })
            .sum()
    }

    /// What the bonds exerted on their ends, as a force that nothing balances any more.
    fn unbalanced_force(&self, broken: &[u32], state: &State) -> Vec<(usize, f64)> {
        let mut force = Vec::with_capacity(2 * COMPONENTS * broken.len());
        for &bond in broken {
            let deformation = self.system.deformation(bond as usize, &state.displacement);
            let end_forces = self
                .before_it_broke(bond, &state.softening.remaining)
                .end_forces(&deformation);
            for (end, values) in self.system.bonds.ends[bond as usize].iter().zip(end_forces) {
                for (component, value) in values.into_iter().enumerate() {
                    let dof = COMPONENTS * *end as usize + component;
                    if let Some(unknown) = self.number(dof) {
                        force.push((unknown, value));
                    }
                }
            }
        }
        force
    }
}
