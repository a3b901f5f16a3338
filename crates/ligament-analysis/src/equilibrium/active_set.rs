//! Equilibrium of linear bonds with crack faces that may close: Newton's method on the set of closed pairs, with an exact line
//! search (semismooth Newton, Hintermueller 2002).
//!
//! The energy is piecewise quadratic with a continuous derivative, and convex where the energy of the bonds is. Each iteration solves
//! with the stiffness of the pairs closed at present; where other pairs close along the step, it ends at the minimum of the energy
//! along it. The energy therefore falls from iteration to iteration and no set of closed pairs recurs.
//!
//! With friction the tangent has the stiffness of sticking pairs, but not the change of the friction of sliding pairs with their pressure,
//! so that it stays symmetric: the iteration converges linearly with mu times the coupling of pressure and shear, where that is below one.
//! There
//! is no energy then; a step ends where the residual forces do no work along it.

use super::equations::{Equations, Iterate, Iteration, Method};
use super::line_search;
use super::rigid::{self, Correction};
use crate::contact::faces;
use crate::state::State;
use crate::unbalanced::Unbalanced;
use ligament_model::surface::Pose;

/// Largest number of iterations. Faces that close as a whole take some five; a detached part that is pushed away takes all.
pub(super) const ITERATION_LIMIT: usize = 60;

/// Ratio of the final to the initial slope of the energy along a step up to which the whole step is taken.
pub(super) const ACCEPTED_SLOPE: f64 = 0.1;

/// Largest number of iterations with friction, which converge linearly, and with surfaces that move towards each other in parts.
const WAY_LIMIT: usize = 300;

/// Residual that is sought as long as it falls from iteration to iteration.
pub(super) const REFINED: f64 = 1e-12;

/// Ratio of successive residuals below which the residual counts as falling. Where it does not fall with the same pairs closed, an
/// updated factor has lost its accuracy.
pub(super) const FALLS: f64 = 0.1;

/// Ratio of successive residuals with friction below which the residual counts as falling: it falls by a constant factor.
const WAY_FALLS: f64 = 0.9;

/// Largest number of trials of the search along a correction with friction. Long corrections pass over ranges in which pairs stick and
/// slide in turn, and end after a few trials; where friction reverses within a small part of each correction, the residual does not fall.
const TRIES: usize = 5;

/// Number of iterations without a falling residual after which the search goes on to the end.
const PATIENCE: usize = 10;

/// Residual up to which the last iterate, or else the nearest one, is accepted: a part that only touches another one carries no
/// force, and residuals relative to a small share of the largest force so far do not fall below the rounding of that force.
const LARGEST_RESIDUAL: f64 = 1e-8;

/// Halvings of a step in the search for the lowest energy, or for the place where friction reverses: the number of bits of a double.
const HALVINGS: usize = 53;

/// Equilibrium at a load factor where faces and surfaces may meet.
pub(super) struct ActiveSet {
    /// Largest number of iterations.
    limit: usize,
    /// Ratio of residuals below which a residual falls; the matrix is factorised anew where successive ones do not fall.
    slowly: f64,
    /// Relative residual of the previous iterate.
    before: f64,
    /// Lowest relative residual, and the iteration that had it.
    lowest: (f64, usize),
    /// Pairs of parts that only touch each other close and open by rounding, so that a worse iterate can follow a solution.
    nearest: Option<Nearest>,
}

/// The nearest iterate to an equilibrium so far.
struct Nearest {
    /// Relative residual.
    residual: f64,
    /// Motions of all points, shape (n_degrees_of_freedom).
    motions: Vec<f64>,
    /// Displacements of rigid bodies that move by themselves, m.
    rigid: Vec<Pose>,
}

impl ActiveSet {
    pub(super) fn new(equations: &Equations) -> Self {
        let (limit, slowly) = match equations.contact.depends_on_way() {
            true => (WAY_LIMIT, WAY_FALLS),
            false => (ITERATION_LIMIT, FALLS),
        };
        Self {
            limit,
            slowly,
            before: f64::INFINITY,
            lowest: (f64::INFINITY, 0),
            nearest: None,
        }
    }

    /// Number of trials of the search along the correction of an iterate with friction.
    fn tries(&mut self, number: usize, residual: f64) -> usize {
        if residual < self.slowly * self.lowest.0 {
            self.lowest = (residual, number);
        }
        match number < self.lowest.1 + PATIENCE {
            true => TRIES,
            false => HALVINGS,
        }
    }

    /// Records an iterate without forces at added supports, if its residual is at most `largest` and the residual of the nearest one so
    /// far.
    fn keep_nearer(&mut self, iterate: &Iterate, state: &State, largest: f64) {
        let residual = iterate.residual.relative;
        let least = self.nearest.as_ref().map_or(largest, |it| it.residual);
        if residual <= least && iterate.residual.carried.is_none() {
            self.nearest = Some(Nearest {
                residual,
                motions: state.displacement.clone(),
                rigid: state.rigid.clone(),
            });
        }
    }
}

/// Largest residual of the last iterate, or else of the nearest one, that is accepted.
fn largest_residual(at: &Iteration<'_>) -> f64 {
    at.sought().max(LARGEST_RESIDUAL)
}

impl Method for ActiveSet {
    fn is_met(&mut self, at: &mut Iteration<'_>, iterate: &mut Iterate) -> bool {
        let (residual, is_over) = (iterate.residual, self.gives_up(at));
        // One more iteration removes the residual due to the soft supports of detached parts.
        let is_exact = at.equations.solver.tolerance().is_none();
        let tolerance = match is_over {
            true => largest_residual(at),
            false if is_exact && residual.relative < FALLS * self.before => REFINED,
            false => at.sought(),
        };
        self.before = residual.relative;
        // A force at an added support may in the end be carried by closed faces.
        if at.is_small(iterate, tolerance) && (residual.carried.is_none() || is_over) {
            return true;
        }
        if is_over && let Some(Nearest { motions, rigid, .. }) = self.nearest.take() {
            (at.state.displacement, at.state.rigid) = (motions, rigid);
            *iterate = at.equations.measure(at.state);
            return true;
        }
        false
    }

    fn gives_up(&self, at: &Iteration<'_>) -> bool {
        at.number == self.limit
    }

    fn correct(
        &mut self,
        at: &mut Iteration<'_>,
        iterate: &Iterate,
    ) -> Result<Iterate, Unbalanced> {
        let (residual, sought) = (iterate.residual.relative, at.sought());
        self.keep_nearer(iterate, at.state, largest_residual(at));
        let tries = self.tries(at.number, residual);
        let (equations, state) = (&mut *at.equations, &mut *at.state);
        let mechanisms = &mut at.mechanisms;
        let mut correction = rigid::correction(equations, state, iterate, sought, mechanisms)?;
        correction.shorten(equations);
        let next = search(equations, state, iterate, &correction, tries);
        let (opened, closed) = faces::changes(&iterate.met.closed, &next.met.closed);
        let is_same = opened.is_empty() && closed.is_empty();
        if is_same && next.residual.relative > self.slowly * residual {
            equations.solver.discard();
        }
        Ok(next)
    }
}

/// Moves the state along a correction to the minimum of the energy, or to its end, and measures the state there; with friction to where the
/// residual forces do little work along the correction, found by at most `tries` trials.
fn search(
    equations: &mut Equations,
    state: &mut State,
    iterate: &Iterate,
    correction: &Correction,
    tries: usize,
) -> Iterate {
    let start = correction.slope(equations, state, iterate);
    correction.add_to(equations, state, 1.0);
    let next = equations.measure(state);
    let end = correction.slope(equations, state, &next);
    if start >= 0.0 || end <= -ACCEPTED_SLOPE * start {
        return next;
    }
    if equations.contact.depends_on_way() {
        let mut at = 1.0;
        let (_, found) = line_search::part(-start, (-end, next), tries, |part| {
            correction.add_to(equations, state, part - at);
            at = part;
            let found = equations.measure(state);
            (-correction.slope(equations, state, &found), found)
        });
        return found;
    }
    let pairs = equations.contact.faces.pairs().iter();
    let gaps = iterate.met.gaps.iter().zip(&next.met.gaps);
    let moved: Vec<Moved> = (pairs.zip(gaps))
        .map(|(pair, (&gap, &next))| Moved {
            stiffness: pair.stiffness,
            gap,
            change: next - gap,
        })
        .collect();
    let length = lowest(start, end, &moved);
    correction.add_to(equations, state, length - 1.0);
    equations.measure(state)
}

/// A pair whose gap changes along a step.
pub(super) struct Moved {
    /// N/m.
    pub(super) stiffness: f64,
    /// Gap at the start, m.
    pub(super) gap: f64,
    /// Change of the gap over the step, m.
    pub(super) change: f64,
}

/// Part of a step at which the slope of the energy is zero, from the slopes at its ends and the gaps of the pairs.
pub(super) fn lowest(start: f64, end: f64, moved: &[Moved]) -> f64 {
    let force = |it: &Moved, part: f64| it.stiffness * (it.gap + part * it.change).min(0.0);
    let of_contact = |part: f64| -> f64 {
        let slopes = moved.iter();
        slopes.map(|it| force(it, part) * it.change).sum()
    };
    let (first, last) = (start - of_contact(0.0), end - of_contact(1.0));
    let slope = |part: f64| first + part * (last - first) + of_contact(part);
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if slope(middle) > 0.0 {
            high = middle;
        } else {
            low = middle;
        }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A point on a spring of 1 N/m, pulled by 1 N towards a wall 0.25 m away that gives way with 9 N/m: rest at u = 0.325, where
    /// 1 - u = 9 (u - 0.25). From 0 the step of the spring alone goes to 1, with slopes -1 at 0 and 0 + 9 . 0.75 at 1.
    #[test]
    fn the_energy_is_lowest_where_the_pressure_balances_the_pull() {
        let wall = Moved {
            stiffness: 9.0,
            gap: 0.25,
            change: -1.0,
        };
        let part = lowest(-1.0, 6.75, &[wall]);
        assert!((part - 0.325).abs() < 1e-12, "{part}");
    }

    #[test]
    fn without_pairs_the_slope_is_linear() {
        assert!((lowest(-1.0, 3.0, &[]) - 0.25).abs() < 1e-12);
    }
}
