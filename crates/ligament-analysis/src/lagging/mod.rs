//! A solution whose parts are updated later, as long as none of their bonds can be the next to break.
//!
//! After a breakage the displacements change by du, and most of a body hardly moves. The backward substitution of a part of the
//! factor depends on du at the border of the part alone, unless the breakage was in the part itself. The update of a part may
//! therefore be delayed: later, the total change of its border gives in one substitution the sum of the changes by all breakages in
//! between.
//!
//! A part may be delayed as long as a rigorous [bound] keeps the ratios of measure to limit of all its bonds below the largest one
//! of the body. Parts are updated in the order of their bounds, so that no more of them are substituted than necessary; parts that
//! contain the breakage or observed points are always updated. The ratios of criteria of stress depend on bonds of other parts too
//! ([around]).

mod around;
mod borders;
mod bound;
mod descent;
mod division;
mod per_norm;
mod reach;

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use ligament_linalg::Factorisation;
use ligament_model::element::BondDeformation;
use ligament_model::failure::{CriteriaInState, Criterion};
use ligament_model::parallel;

use crate::breaking::{Leaders, Leading};
use crate::problem::Problem;
use crate::state::State;
use crate::stiffness::Stiffness;

use around::{Around, Changed};
use borders::Bounds;
use descent::{Descent, WorkVectors};
use division::Division;
use reach::Reach;

pub(crate) use descent::ForwardSubstituted;

/// Relative margin by which a bound must be below the leading bonds; the rounding of a bound is smaller.
const SURELY: f64 = 1e-6;

/// Largest number of parts that are substituted together.
const TOGETHER: usize = 8;

/// A body divided into parts that may be delayed, with their bounds.
pub(crate) struct Body {
    division: Division,
    bounds: Bounds,
    /// Largest ratio kappa of the bonds of each part and of its descendants, shape (n_parts), J^(-1/2); by criteria of stress also at its
    /// border, and in the bonds of each state.
    per_norm: Vec<f64>,
    /// Largest limit of these bonds, shape (n_parts), but for bonds that never break.
    largest_limit: Vec<f64>,
    /// Parts around the points; None without criteria of stress.
    reach: Option<Reach>,
}

impl Body {
    /// Divides a body as the factor of its stiffness; None where parts of it cannot be delayed: where equations are nonlinear, a
    /// stiffness is negative, other elements than bonds resist motions, limits change with the state of the body, stresses have no
    /// bound, probes read more than motions, or the factor has no nested dissection.
    pub(crate) fn new(problem: &Problem, stiffness: &Stiffness) -> Option<Self> {
        let division = Division::new(problem, stiffness)?;
        let bounds = Bounds::new(problem, &division)?;
        let (per_norm, reach) = match problem.criteria.list.iter().any(Criterion::follows_stress) {
            true => (Vec::new(), Some(Reach::new(problem, &division, &bounds)?)),
            false => {
                let whole = vec![true; division.part_of_bond.len()];
                let of_bond = |bond: u32| per_norm::of_bond(problem, &whole, bond as usize, None);
                (per_norm::of_parts(&division, of_bond), None)
            }
        };
        let limit = |bond: u32| {
            let limits = problem.criteria.list.iter();
            let limits = limits.map(|it| it.break_limit(bond as usize));
            limits.filter(|it| it.is_finite()).fold(0.0, f64::max)
        };
        let largest_limit = match &reach {
            Some(reach) => {
                let bonds = 0..division.part_of_bond.len() as u32;
                reach.largest(
                    &division,
                    &*problem.system,
                    &bonds.map(limit).collect::<Vec<_>>(),
                )
            }
            None => per_norm::of_parts(&division, limit),
        };
        Some(Self {
            division,
            bounds,
            per_norm,
            largest_limit,
            reach,
        })
    }

    /// Observed points, whose motions and forces are known after each breakage, ascending.
    pub(crate) fn wanted(&self) -> &[u32] {
        &self.division.wanted
    }
}

/// Displacements of a body at a fixed load factor, with the displacements of some parts delayed.
pub(crate) struct Lagging<'a> {
    division: &'a Division,
    bounds: &'a Bounds,
    per_norm: &'a [f64],
    largest_limit: &'a [f64],
    problem: &'a Problem,
    leading: Leading,
    /// The criteria without stresses.
    criteria: CriteriaInState<'a>,
    /// Ratios by criteria of stress; None without these.
    around: Option<Around<'a>>,
    /// Displacements and rotations, shape (n_degrees_of_freedom), m and rad.
    pub(crate) displacement: Vec<f64>,
    /// Motions of the border of each part at its last substitution.
    references: Vec<Vec<f64>>,
    /// Bound of the ratios of measure to limit in a part and its descendants at its last substitution.
    at_most: Vec<f64>,
    /// Present bound of these ratios.
    now: Vec<f64>,
    rooms: WorkVectors,
}

impl<'a> Lagging<'a> {
    /// Starts from an equilibrium state, the criteria in it and its deformations (n_bonds); also returns its leading bonds.
    pub(crate) fn new(
        body: &'a Body,
        (problem, leading): (&'a Problem, Leading),
        state: &State,
        criteria: CriteriaInState<'a>,
        deformations: &[BondDeformation],
    ) -> (Self, Leaders) {
        let Body {
            division, bounds, ..
        } = body;
        let n_parts = division.parts.len();
        let around = body.reach.as_ref().and_then(|reach| {
            let body = (division, reach, problem);
            Around::new(body, state, criteria, deformations)
        });
        let mut lagging = Self {
            division,
            bounds,
            per_norm: &body.per_norm,
            largest_limit: &body.largest_limit,
            problem,
            leading,
            criteria: problem.criteria.without_state(),
            around,
            displacement: state.displacement.clone(),
            references: vec![Vec::new(); n_parts],
            at_most: vec![0.0; n_parts],
            now: vec![0.0; n_parts],
            rooms: WorkVectors::default(),
        };
        let mut leaders = Leaders::new(leading);
        let judged = |part: usize| {
            let mut of_part = Leaders::new(leading);
            let mut largest = 0.0_f64;
            for &bond in division.bonds(part) {
                let deformation = &deformations[bond as usize];
                let (ratio, limit): (_, &dyn Fn() -> f64) = match &lagging.around {
                    Some(around) => (around.ratio(bond), &|| around.limit(bond)),
                    None => (lagging.ratio(bond, deformation, state), &|| {
                        lagging.limit(bond, deformation)
                    }),
                };
                largest = largest.max(ratio);
                of_part.add(bond, ratio, limit);
            }
            (largest, of_part)
        };
        let judged = parallel::map(0..n_parts, judged);
        for (part, (largest, of_part)) in judged.into_iter().enumerate().rev() {
            lagging.store_border_motions(part);
            lagging.now[part] = largest;
            leaders.merge(of_part);
            lagging.combine_child_bounds(part);
        }
        (lagging, leaders)
    }

    /// The criteria with the stresses of the bonds that break first.
    pub(crate) fn criteria(&self) -> &CriteriaInState<'a> {
        match &self.around {
            Some(around) => &around.criteria,
            None => &self.criteria,
        }
    }

    /// Applies a correction after a breakage at some points; returns the bonds that lead now. None, and no correction, where a point near the
    /// breakage would move farther than `farthest`, m.
    pub(crate) fn follow(
        &mut self,
        correction: ForwardSubstituted<'_>,
        points: &[u32],
        (state, farthest): (&State, f64),
    ) -> Option<Leaders> {
        let broken_in = self.division.parts_above(points.iter().copied());
        let mut is_asked_for: Vec<bool> = (broken_in.iter().zip(&self.division.is_wanted))
            .map(|(broken_in, wanted)| *broken_in || *wanted)
            .collect();
        if let Some(around) = &mut self.around {
            // Stresses are largest where bonds broke, and a large ratio that is known lets more parts wait.
            for part in around.begin(points, state) {
                is_asked_for[part] = true;
            }
        }
        let mut leaders = Leaders::new(self.leading);
        let descent = self.descent(correction, &broken_in, &state.held);
        let changed = descent.all(&is_asked_for);
        if self.moves_beyond(&changed, farthest) {
            return None;
        }
        let mut substituted = self.take_in_all(changed, state);
        let mut waiting = BinaryHeap::new();
        self.judge_all(&substituted, points, state, &mut leaders);
        self.wait(&substituted, &is_asked_for, &mut waiting);
        loop {
            let mut next = self.next(&mut waiting, &leaders);
            if next.is_empty() {
                next = self.behind(&leaders, &substituted);
            }
            if next.is_empty() {
                break;
            }
            let descent = self.descent(correction, &broken_in, &state.held);
            let changes = parallel::map(&next, |&part| descent.one(part));
            for (&part, changes) in next.iter().zip(&changes) {
                self.take_in(part, changes, &state.held);
            }
            let beside = self.judge_all(&next, &[], state, &mut leaders);
            self.wait(&next, &is_asked_for, &mut waiting);
            waiting.extend(self.bounds_around(beside));
            substituted.extend(next);
        }
        for part in substituted.into_iter().rev() {
            if let Some(around) = &mut self.around {
                around.combine(part);
                let bonds = self.division.bonds(part).iter();
                self.now[part] = bonds.map(|&bond| around.ratio(bond)).fold(0.0, f64::max);
            }
            self.combine_child_bounds(part);
        }
        Some(leaders)
    }

    /// Whether changes move a point farther than a distance, m.
    fn moves_beyond(&self, changed: &[descent::Changed], farthest: f64) -> bool {
        let Division {
            parts,
            degree_of_freedom,
            ..
        } = self.division;
        let layout = self.problem.system.layout;
        changed.iter().any(|(part, changes)| {
            let dofs = &degree_of_freedom[parts[*part].rows.clone()];
            dofs.iter().zip(changes).any(|(&dof, change)| {
                let motion = self.displacement[dof as usize] + change;
                motion.abs() > farthest && !layout.component(dof as usize).is_rotation()
            })
        })
    }

    /// The highest parts that were not substituted of those with a point whose motion a breakage of the leading bonds depends on: cells reach
    /// beyond the part of a bond.
    fn behind(&self, leaders: &Leaders, substituted: &[usize]) -> Vec<usize> {
        let bonds: Vec<u32> = leaders.bonds().map(|it| it.0).collect();
        let points = self.problem.system.points_of_breakage(&bonds).into_iter();
        let is_behind = self.division.parts_above(points);
        let parts = (0..is_behind.len()).filter(|&part| is_behind[part]);
        let is_substituted = |part: usize| substituted.contains(&part);
        let behind = parts.filter(|&part| !is_substituted(part));
        let above = |part: usize| self.division.parts[part].above;
        behind
            .filter(|&part| above(part).is_none_or(is_substituted))
            .collect()
    }

    /// Substitutes all parts, so that all displacements are up to date.
    pub(crate) fn catch_up(&mut self, factor: &dyn Factorisation, state: &State) {
        let nothing = ForwardSubstituted {
            factor,
            by_row: &[],
            scale: 0.0,
        };
        let n_parts = self.division.parts.len();
        let unbroken = vec![false; n_parts];
        let descent = self.descent(nothing, &unbroken, &state.held);
        let changed = descent.all(&vec![true; n_parts]);
        self.take_in_all(changed, state);
    }

    fn descent<'b>(
        &'b self,
        correction: ForwardSubstituted<'b>,
        broken_in: &'b [bool],
        held: &'b [bool],
    ) -> Descent<'b> {
        Descent {
            division: self.division,
            displacement: &self.displacement,
            references: &self.references,
            rooms: &self.rooms,
            correction,
            broken_in,
            held,
        }
    }

    /// Adds the changes of parts, each after its parent; returns these parts.
    fn take_in_all(&mut self, changed: Vec<descent::Changed>, state: &State) -> Vec<usize> {
        for (part, changes) in &changed {
            self.take_in(*part, changes, &state.held);
        }
        changed.into_iter().map(|(part, _)| part).collect()
    }

    /// Adds the changes of the motions of a part, by its rows; its ancestors must be up to date.
    fn take_in(&mut self, part: usize, changes: &[f64], held: &[bool]) {
        let Division {
            parts,
            degree_of_freedom,
            ..
        } = self.division;
        let dofs = &degree_of_freedom[parts[part].rows.clone()];
        for (&dof, change) in dofs.iter().zip(changes) {
            if !held[dof as usize] {
                self.displacement[dof as usize] += change;
            }
        }
        self.store_border_motions(part);
    }

    /// The delayed parts that are substituted next: the part with the largest bound, which may leave fewer bonds that lead; several where many
    /// bonds lead, and for criteria of stress, because each part changes ratios around it too. Empty where no bond that depends on one can lead.
    fn next(&self, waiting: &mut BinaryHeap<Waiting>, leaders: &Leaders) -> Vec<usize> {
        let (mut next, mut later) = (Vec::new(), Vec::new());
        let at_once = match (&self.around, self.leading) {
            (None, Leading::Tied(_)) => 1,
            _ => TOGETHER,
        };
        while next.len() < at_once
            && let Some(Waiting { at_most, part }) = waiting.pop()
        {
            let surely = at_most * (1.0 + SURELY);
            if !leaders.may_include(surely, self.largest_limit[part]) {
                later.push(Waiting { at_most, part });
                if surely < leaders.lowest {
                    break;
                }
                continue;
            }
            let Some(around) = &self.around else {
                next.push(part);
                continue;
            };
            let Some((present, most)) = around.present(part, self.at_most[part]) else {
                continue;
            };
            let again = Waiting {
                at_most: present,
                part,
            };
            if present < at_most {
                waiting.push(again);
                continue;
            }
            later.push(again);
            if !next.contains(&most) {
                next.push(most);
            }
        }
        waiting.extend(later);
        next
    }

    /// Queues the children of substituted parts, except those that are required.
    fn wait(&mut self, above: &[usize], is_asked_for: &[bool], waiting: &mut BinaryHeap<Waiting>) {
        let below = above.iter().flat_map(|&part| &self.division.below[part]);
        let below: Vec<usize> = below.copied().filter(|&it| !is_asked_for[it]).collect();
        let norms = parallel::map(&below, |&part| self.norm(part));
        let Some(around) = &mut self.around else {
            for (part, norm) in below.into_iter().zip(norms) {
                let at_most = self.at_most[part] + self.per_norm[part] * norm;
                self.now[part] = at_most;
                waiting.push(Waiting { at_most, part });
            }
            return;
        };
        for (&part, norm) in below.iter().zip(norms) {
            around.delay(part, norm);
        }
        waiting.extend(self.bounds_around(below));
    }

    /// Bounds of some delayed parts by criteria of stress.
    fn bounds_around(&self, parts: Vec<usize>) -> Vec<Waiting> {
        let bound = |part: usize| {
            let around = self.around.as_ref()?;
            let (at_most, _) = around.present(part, self.at_most[part])?;
            Some(Waiting { at_most, part })
        };
        parallel::flat_map(parts.len(), |place| bound(parts[place]))
    }

    /// Bound of the norm of the motion of a part since its last substitution.
    fn norm(&self, part: usize) -> f64 {
        let then = &self.references[part];
        self.bounds.norm(part, &self.displacement, then)
    }

    /// Stores the present motions of the border of a part as the motions at its last substitution.
    fn store_border_motions(&mut self, part: usize) {
        let Division {
            parts,
            degree_of_freedom,
            ..
        } = self.division;
        let motion = |&row: &usize| self.displacement[degree_of_freedom[row] as usize];
        let reference = &mut self.references[part];
        reference.clear();
        reference.extend(parts[part].border.iter().map(motion));
    }

    /// Computes the ratios of the bonds of parts, which must be up to date, and of bonds at points where some broke; returns the delayed
    /// parts beside them whose bounds changed.
    fn judge_all(
        &mut self,
        parts: &[usize],
        points: &[u32],
        state: &State,
        leaders: &mut Leaders,
    ) -> Vec<usize> {
        let Some(around) = &mut self.around else {
            let judged = parallel::map(parts, |&part| self.judged(part, state));
            for (&part, (largest, of_part)) in parts.iter().zip(judged) {
                self.now[part] = largest;
                leaders.merge(of_part);
            }
            return Vec::new();
        };
        let Changed {
            known,
            raised,
            beside,
        } = around.take_in(parts, points, &self.displacement, state);
        for (bond, ratio) in known {
            leaders.add(bond, ratio, || around.limit(bond));
        }
        for (part, ratio) in raised {
            for part in self.division.with_ancestors(part) {
                self.now[part] = self.now[part].max(ratio);
                self.at_most[part] = self.at_most[part].max(ratio);
            }
        }
        beside
    }

    /// Largest ratio in a part, and its leading bonds.
    fn judged(&self, part: usize, state: &State) -> (f64, Leaders) {
        let bonds = self.division.bonds(part);
        let system = &self.problem.system;
        let deformations = system.measured(&state.intact, &self.displacement, bonds);
        let mut largest = 0.0_f64;
        let mut leaders = Leaders::new(self.leading);
        for (&bond, deformation) in bonds.iter().zip(&deformations) {
            let ratio = self.ratio(bond, deformation, state);
            largest = largest.max(ratio);
            leaders.add(bond, ratio, || self.limit(bond, deformation));
        }
        (largest, leaders)
    }

    /// Largest ratio of measure to limit of a bond; 0 where it is broken.
    fn ratio(&self, bond: u32, deformation: &BondDeformation, state: &State) -> f64 {
        if !state.intact[bond as usize] {
            return 0.0;
        }
        let verdict = self.criteria.breaking(bond as usize, deformation);
        verdict.map_or(0.0, |it| it.ratio())
    }

    /// Limit by which a bond breaks.
    fn limit(&self, bond: u32, deformation: &BondDeformation) -> f64 {
        let verdict = self.criteria.breaking(bond as usize, deformation);
        verdict.map_or(0.0, |it| it.limit)
    }

    /// Sets the bound of a part that was substituted to the largest bound of its own bonds and of its children.
    fn combine_child_bounds(&mut self, part: usize) {
        let below = self.division.below[part].iter().map(|&it| self.now[it]);
        let at_most = below.fold(self.now[part], f64::max);
        (self.now[part], self.at_most[part]) = (at_most, at_most);
    }
}

/// A part that may have to be substituted.
struct Waiting {
    at_most: f64,
    part: usize,
}

impl Ord for Waiting {
    fn cmp(&self, other: &Self) -> Ordering {
        // Ties of the bound are resolved in favour of the first part.
        let by_bound = self.at_most.total_cmp(&other.at_most);
        by_bound.then(other.part.cmp(&self.part))
    }
}

impl PartialOrd for Waiting {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Waiting {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Waiting {}
