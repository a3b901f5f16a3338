//! A solution whose parts are left behind while bonds break elsewhere, for as long as none of their bonds can be the next to break.
//!
//! After a breakage the displacements change by du, and most of a body hardly moves. What the backward substitution gives a part of the
//! factor follows from du at the border of the part alone, unless the breakage was in the part itself. So a part may wait: when it is
//! needed, the change of its border since the last time gives in one substitution what all breakages in between would have given.
//!
//! A part may wait as long as a rigorous [bound] keeps the ratios of measure to limit of all its bonds below the
//! largest one of the body. Parts are taken in the order of their bounds, so that no more of them are substituted than the bound asks for,
//! and those that a breakage is in, or whose motions and forces are asked for, always are.

mod borders;
mod bound;
mod division;

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use ligament_linalg::Factorisation;
use ligament_model::element::BondDeformation;

use crate::breaking::{FirstToBreak, Leaders};
use crate::problem::Problem;
use crate::state::State;
use crate::stiffness::Stiffness;

use borders::Bounds;
use division::Division;

/// Relative distance below the bonds that lead at which a bound counts as below them: rounding of a bound is less.
const SURELY: f64 = 1e-6;

/// A body whose parts can wait, and their bounds.
pub(crate) struct Body {
    division: Division,
    bounds: Bounds,
}

impl Body {
    /// A body with the stiffness of its factor; None where parts of it cannot wait: where equations are not linear, a stiffness is negative,
    /// something beside bonds resists motions, limits change with the state of the body, probes ask for more than motions, or the factor
    /// follows no dissection.
    pub(crate) fn new(problem: &Problem, stiffness: &Stiffness) -> Option<Self> {
        let division = Division::new(problem, stiffness)?;
        let bounds = Bounds::new(problem, &division)?;
        Some(Self { division, bounds })
    }

    /// Points whose motions and forces are known after each breakage, ascending.
    pub(crate) fn wanted(&self) -> &[u32] {
        &self.division.wanted
    }
}

/// The displacements of a body at a fixed load factor; those of some parts may be earlier ones.
pub(crate) struct Lagging<'a> {
    division: &'a Division,
    bounds: &'a Bounds,
    problem: &'a Problem,
    tie_tolerance: f64,
    /// Displacements and rotations, shape (n_degrees_of_freedom), m and rad.
    pub(crate) displacement: Vec<f64>,
    /// Motions of the border of each part when it was last substituted.
    references: Vec<Vec<f64>>,
    /// What no ratio of measure to limit in a part, and in those below it, exceeded then.
    at_most: Vec<f64>,
    /// What no such ratio exceeds now.
    now: Vec<f64>,
    /// Changes by row of the factor.
    changes: Vec<f64>,
}

/// A correction after the forward substitution, by row of the factor.
#[derive(Clone, Copy)]
pub(crate) struct HalfSolved<'a> {
    pub(crate) factor: &'a dyn Factorisation,
    pub(crate) by_row: &'a [f64],
    /// Factor from the load factor of the correction to that of the displacements.
    pub(crate) scale: f64,
}

impl<'a> Lagging<'a> {
    /// Starts from a state in equilibrium and its deformations (n_bonds).
    pub(crate) fn new(
        Body { division, bounds }: &'a Body,
        problem: &'a Problem,
        tie_tolerance: f64,
        state: &State,
        deformations: &[BondDeformation],
    ) -> Self {
        let n_parts = division.parts.len();
        let mut lagging = Self {
            division,
            bounds,
            problem,
            tie_tolerance,
            displacement: state.displacement.clone(),
            references: vec![Vec::new(); n_parts],
            at_most: vec![0.0; n_parts],
            now: vec![0.0; n_parts],
            changes: vec![0.0; division.degree_of_freedom.len()],
        };
        for part in (0..n_parts).rev() {
            lagging.refer(part);
            let bonds = division.bonds(part).iter();
            let of_bond = |&bond: &u32| lagging.ratio(bond, &deformations[bond as usize], state);
            lagging.now[part] = bonds.map(of_bond).fold(0.0, f64::max);
            lagging.take_in_below(part);
        }
        lagging
    }

    /// Takes in a correction after a breakage at some points; gives the bonds that are the first to break now.
    pub(crate) fn follow(
        &mut self,
        correction: HalfSolved<'_>,
        points: impl Iterator<Item = u32>,
        state: &State,
    ) -> FirstToBreak {
        let broken_in = self.division.parts_above(points);
        let mut leaders = Leaders::new(self.tie_tolerance);
        let mut substituted = Vec::new();
        let mut waiting = BinaryHeap::from([Waiting {
            at_most: f64::INFINITY,
            part: 0,
        }]);
        while let Some(Waiting { at_most, part }) = waiting.pop() {
            if at_most * (1.0 + SURELY) < leaders.lowest_tied {
                break;
            }
            self.substitute(part, correction, broken_in[part], state);
            self.judge(part, state, &mut leaders);
            substituted.push(part);
            for &below in &self.division.below[part] {
                let is_asked_for = broken_in[below] || self.division.is_wanted[below];
                let at_most = if is_asked_for {
                    f64::INFINITY
                } else {
                    self.at_most[below] + self.growth(below)
                };
                self.now[below] = at_most;
                waiting.push(Waiting {
                    at_most,
                    part: below,
                });
            }
        }
        for part in substituted.into_iter().rev() {
            self.take_in_below(part);
        }
        leaders.first_to_break()
    }

    /// Substitutes all parts, so that all displacements are those of now.
    pub(crate) fn catch_up(&mut self, factor: &dyn Factorisation, state: &State) {
        let nothing = HalfSolved {
            factor,
            by_row: &[],
            scale: 0.0,
        };
        for part in 0..self.division.parts.len() {
            self.substitute(part, nothing, false, state);
        }
    }

    /// What the ratios in a part may have grown by since it was last substituted.
    fn growth(&self, part: usize) -> f64 {
        let then = &self.references[part];
        self.bounds.growth(part, &self.displacement, then)
    }

    /// Brings the displacements of a part up to date; those above it are.
    fn substitute(
        &mut self,
        part: usize,
        correction: HalfSolved<'_>,
        is_broken_in: bool,
        state: &State,
    ) {
        let Division {
            parts,
            degree_of_freedom,
            ..
        } = self.division;
        let it = &parts[part];
        for (&row, then) in it.border.iter().zip(&self.references[part]) {
            self.changes[row] = self.displacement[degree_of_freedom[row] as usize] - then;
        }
        let own = &mut self.changes[it.rows.clone()];
        if is_broken_in {
            let by_row = correction.by_row[it.rows.clone()].iter();
            own.iter_mut()
                .zip(by_row)
                .for_each(|(own, value)| *own = correction.scale * value);
        } else {
            own.fill(0.0);
        }
        correction.factor.finish_part(it, &mut self.changes);
        for row in it.rows.clone() {
            let dof = degree_of_freedom[row] as usize;
            if !state.held[dof] {
                self.displacement[dof] += self.changes[row];
            }
        }
        self.refer(part);
    }

    /// Takes the motions of the border of a part as those that it was last substituted with.
    fn refer(&mut self, part: usize) {
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

    /// Judges the bonds of a part, which is up to date.
    fn judge(&mut self, part: usize, state: &State, leaders: &mut Leaders) {
        let bonds = self.division.bonds(part);
        let system = &self.problem.system;
        let deformations = system.measured(&state.intact, &self.displacement, bonds);
        let mut largest = 0.0_f64;
        for (&bond, deformation) in bonds.iter().zip(&deformations) {
            let ratio = self.ratio(bond, deformation, state);
            largest = largest.max(ratio);
            leaders.meet(bond, ratio);
        }
        self.now[part] = largest;
    }

    /// Largest ratio of measure to limit of a bond; 0 where it is broken.
    fn ratio(&self, bond: u32, deformation: &BondDeformation, state: &State) -> f64 {
        if !state.intact[bond as usize] {
            return 0.0;
        }
        let verdict = (self.problem.criteria).breaking(bond as usize, deformation);
        verdict.map_or(0.0, |it| it.ratio())
    }

    /// Takes what is known of the bonds of a part that was substituted, and of those of parts below it, as what none exceeds.
    fn take_in_below(&mut self, part: usize) {
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
        // Of equal ones the first part.
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
