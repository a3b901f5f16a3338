//! Equilibrium of linear bonds with crack faces that may close: Newton's method on the set of closed pairs, with an exact line
//! search (semismooth Newton, Hintermueller 2002).
//!
//! The energy is piecewise quadratic with a continuous derivative, and convex where that of the bonds is. Each iteration solves
//! with the stiffness of the pairs closed at present; where other pairs close along the step, it ends at the minimum of the energy
//! along it. The energy therefore falls from iteration to iteration and no set of closed pairs recurs.
//!
//! With friction the tangent has what sticking pairs resist, but not the change of the friction of sliding ones with their pressure, so that
//! it stays symmetric: the iteration converges linearly with mu times the coupling of pressure and shear, where that is below one. There
//! is no energy then; a step ends where the residual forces do no work along it.

use super::equations::Equations;
use super::iterate::Iterate;
use super::line_search;
use super::residual::Residual;
use super::rigid::{self, Correction};
use crate::balanced::Attempt;
use crate::breakage::Breakage;
use crate::contact::faces;
use crate::history::{Observer, ObserverError};
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

/// Largest number of trials of the search along a correction with friction. Long corrections leap over ways in which pairs stick and slide in turn,
/// and end after a few of them; where friction turns round within a small part of each, the residual stays as it is.
const TRIES: usize = 5;

/// Number of iterations without a falling residual after which the search goes on to the end.
const PATIENCE: usize = 10;

/// Residual up to which the last iterate, or else the nearest one, is accepted: a part that only touches another one carries no
/// force, and residuals relative to a small share of the largest force so far do not fall below the rounding of that force.
const LARGEST_RESIDUAL: f64 = 1e-8;

/// Halvings of a step in the search for the lowest energy, or for where friction turns round, the number of bits of a double.
const HALVINGS: usize = 53;

/// Brings a state into equilibrium at its load factor.
pub(super) fn balance(
    equations: &mut Equations,
    state: &mut State,
    breakage: &Breakage,
    observer: &mut dyn Observer,
) -> Result<Attempt, ObserverError> {
    equations.prescribe(state);
    let mut mechanisms = Vec::new();
    let sought = equations.accuracy.sought(breakage);
    let mut iterations = usize::from(equations.follow(state, breakage));
    let mut iterate = equations.measure(state);
    let mut before = f64::INFINITY;
    let largest = sought.max(LARGEST_RESIDUAL);
    let (limit, mut fall) = pace(equations);
    // Pairs of parts that only touch each other close and open by rounding, so that a worse iterate can follow a solution.
    let mut nearest: Option<Nearest> = None;
    loop {
        let residual = iterate.residual;
        if iterations > 0 {
            observer.iteration(iterations, residual.relative, iterate.stored_energy)?;
        }
        let is_over = iterations == limit;
        // One more iteration removes the residual due to the soft supports of detached parts.
        let falls = equations.solver.tolerance().is_none() && residual.relative < FALLS * before;
        let tolerance = match is_over {
            true => largest,
            false if falls => REFINED,
            false => sought,
        };
        before = residual.relative;
        let is_small = equations.is_small(&residual, tolerance);
        // A force at an added support may in the end be carried by closed faces.
        if is_small && (residual.carried.is_none() || is_over) {
            equations.remember(iterate.extents);
            return Ok(equations.settled(iterate, iterations, mechanisms));
        }
        if is_over && let Some(Nearest { motions, rigid, .. }) = nearest {
            (state.displacement, state.rigid) = (motions, rigid);
            let iterate = equations.measure(state);
            equations.remember(iterate.extents);
            return Ok(equations.settled(iterate, iterations, mechanisms));
        }
        if is_over || !residual.relative.is_finite() {
            return Ok(equations.not_settled(&residual, iterations));
        }
        keep_nearer(&mut nearest, &residual, largest, state);
        let tries = fall.tries(iterations, residual.relative);
        let next = match next(equations, state, &iterate, sought, tries, &mut mechanisms) {
            Ok(next) => next,
            Err(unbalanced) => return Ok(Attempt::Unbalanced(unbalanced)),
        };
        let (opened, closed) = faces::changes(&iterate.met.closed, &next.met.closed);
        let is_same = opened.is_empty() && closed.is_empty();
        if is_same && next.residual.relative > fall.slowly * residual.relative {
            equations.solver.discard();
        }
        iterate = next;
        iterations += 1;
    }
}

/// Largest number of iterations, and the fall of the residual before the first one.
fn pace(equations: &Equations) -> (usize, Fall) {
    let (limit, slowly) = if equations.meeting.depends_on_way() {
        (WAY_LIMIT, WAY_FALLS)
    } else {
        (ITERATION_LIMIT, FALLS)
    };
    let fall = Fall {
        slowly,
        lowest: f64::INFINITY,
        iteration: 0,
    };
    (limit, fall)
}

/// Corrects a state for the relative residual `sought`, with so many `tries` along the correction with friction, and measures it; appends the points
/// of mechanisms that the solver found.
fn next(
    equations: &mut Equations,
    state: &mut State,
    iterate: &Iterate,
    sought: f64,
    tries: usize,
    mechanisms: &mut Vec<u32>,
) -> Result<Iterate, Unbalanced> {
    let mut correction = rigid::correction(equations, state, iterate, sought, mechanisms)?;
    correction.shorten(equations);
    Ok(search(equations, state, iterate, &correction, tries))
}

/// Where the residual of an iteration last fell.
struct Fall {
    /// Ratio of residuals below which one falls; the factor is made anew where successive ones do not.
    slowly: f64,
    lowest: f64,
    /// Iteration that had it.
    iteration: usize,
}

impl Fall {
    /// Number of trials of the search along the correction of an iterate.
    fn tries(&mut self, iteration: usize, residual: f64) -> usize {
        if residual < self.slowly * self.lowest {
            (self.lowest, self.iteration) = (residual, iteration);
        }
        if iteration < self.iteration + PATIENCE {
            TRIES
        } else {
            HALVINGS
        }
    }
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

/// Records the residual and displacements of an iterate without forces at added supports, if its residual is at most `largest` and
/// that of the nearest iterate so far.
fn keep_nearer(nearest: &mut Option<Nearest>, residual: &Residual, largest: f64, state: &State) {
    let least = nearest.as_ref().map_or(largest, |it| it.residual);
    if residual.relative <= least && residual.carried.is_none() {
        *nearest = Some(Nearest {
            residual: residual.relative,
            motions: state.displacement.clone(),
            rigid: state.rigid.clone(),
        });
    }
}

/// Moves the state along a correction to the minimum of the energy, or to its end, and measures the state there; with friction to where the
/// residual forces do little work along the correction, found by so many `tries`.
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
    if equations.meeting.depends_on_way() {
        let (mut at, mut found) = (1.0, next);
        line_search::part(-start, -end, tries, |part| {
            correction.add_to(equations, state, part - at);
            at = part;
            found = equations.measure(state);
            -correction.slope(equations, state, &found)
        });
        return found;
    }
    let pairs = equations.meeting.faces.pairs().iter();
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
