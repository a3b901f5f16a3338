//! Equilibrium of linear bonds whose crack faces may close: Newton's method on the pairs that are closed, with an exact line
//! search (semismooth Newton, Hintermueller 2002).
//!
//! The energy is piecewise quadratic, with a continuous derivative, and convex where that of the bonds is. Each iteration solves with the
//! stiffness of the pairs that are closed now; where that goes too far, because other pairs close on the way, the step ends where
//! the energy is lowest along it. So the energy falls from iteration to iteration and no set of closed pairs comes back.

use super::equations::Equations;
use super::iterate::Iterate;
use super::residual::Residual;
use crate::balanced::Attempt;
use crate::breakage::Breakage;
use crate::contact;
use crate::history::{Observer, ObserverError};
use crate::state::State;

/// Iterations after which a solve is given up. Faces that close as a whole take some five; a loose part that is pressed away takes all.
const ITERATION_LIMIT: usize = 60;

/// Slope of the energy at the end of a step, over that at its beginning, up to which the step goes all the way.
const ACCEPTED_SLOPE: f64 = 0.1;

/// Residual that is sought as long as it falls from iteration to iteration.
const REFINED: f64 = 1e-12;

/// Residual over the one before below which it falls. Where it does not, with the same pairs closed, a factor that went through
/// changes is worn out.
const FALLS: f64 = 0.1;

/// Residual up to which the last iterate, or else the nearest on the way, is an equilibrium all the same: a part that only touches another
/// one carries nothing, and forces that are judged by a small share of the largest so far do not fall below the rounding of those.
const LARGEST_RESIDUAL: f64 = 1e-8;

/// Halvings of a step in the search for the lowest energy: as many as a double has bits.
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
    let is_exact = equations.solver.tolerance().is_none();
    let mut iterations = usize::from(equations.follow(state, breakage));
    let mut iterate = equations.measure(state);
    let mut before = f64::INFINITY;
    let largest = sought.max(LARGEST_RESIDUAL);
    // Faces of a part that only touches another one close and open by rounding, and iterates farther off can follow a solution.
    let mut nearest: Option<(f64, Vec<f64>)> = None;
    loop {
        let residual = iterate.residual;
        if iterations > 0 {
            observer.iteration(iterations, residual.relative, iterate.stored_energy)?;
        }
        let is_over = iterations == ITERATION_LIMIT;
        // One more iteration takes off what the soft holds of loose parts leave.
        let falls = is_exact && residual.relative < FALLS * before;
        let tolerance = match is_over {
            true => largest,
            false if falls => REFINED,
            false => sought,
        };
        before = residual.relative;
        let is_small = equations.is_small(&residual, tolerance);
        // What a hold carries, faces that close may carry in the end.
        if is_small && (residual.carried.is_none() || is_over) {
            equations.remember(iterate.extents);
            return Ok(equations.settled(iterate, iterations, mechanisms));
        }
        if is_over && let Some((_, displacement)) = nearest {
            state.displacement = displacement;
            let iterate = equations.measure(state);
            equations.remember(iterate.extents);
            return Ok(equations.settled(iterate, iterations, mechanisms));
        }
        if is_over || !residual.relative.is_finite() {
            return Ok(equations.not_settled(&residual, iterations));
        }
        keep_nearer(&mut nearest, &residual, largest, state);
        let correction = match equations.correction(state, &iterate, sought, &mut mechanisms) {
            Ok(correction) => correction,
            Err(unbalanced) => return Ok(Attempt::Unbalanced(unbalanced)),
        };
        let next = search(equations, state, &iterate, &correction);
        let (opened, closed) = contact::changes(&iterate.closed, &next.closed);
        let is_same = opened.is_empty() && closed.is_empty();
        if is_same && next.residual.relative > FALLS * residual.relative {
            equations.solver.discard();
        }
        iterate = next;
        iterations += 1;
    }
}

/// Keeps the residual and the displacements of an iterate that holds carry nothing of, if its residual is at most the largest that counts, and
/// that of the nearest so far.
fn keep_nearer(
    nearest: &mut Option<(f64, Vec<f64>)>,
    residual: &Residual,
    largest: f64,
    state: &State,
) {
    let least = nearest.as_ref().map_or(largest, |it| it.0);
    if residual.relative <= least && residual.carried.is_none() {
        *nearest = Some((residual.relative, state.displacement.clone()));
    }
}

/// Goes along a correction to where the energy is lowest, or to its end, and measures the state there.
fn search(
    equations: &mut Equations,
    state: &mut State,
    iterate: &Iterate,
    correction: &[f64],
) -> Iterate {
    let start = equations.slope(state, iterate, correction);
    equations.add_correction(state, 1.0, correction);
    let next = equations.measure(state);
    let end = equations.slope(state, &next, correction);
    if start >= 0.0 || end <= -ACCEPTED_SLOPE * start {
        return next;
    }
    let pairs = equations.contact.pairs().iter();
    let gaps = iterate.gaps.iter().zip(&next.gaps);
    let moved: Vec<Moved> = (pairs.zip(gaps))
        .map(|(pair, (&gap, &next))| Moved {
            stiffness: pair.stiffness,
            gap,
            change: next - gap,
        })
        .collect();
    let length = lowest(start, end, &moved);
    equations.add_correction(state, length - 1.0, correction);
    equations.measure(state)
}

/// A pair on the way along a step.
struct Moved {
    /// N/m.
    stiffness: f64,
    /// Gap at the start, m.
    gap: f64,
    /// Change of the gap over the step, m.
    change: f64,
}

/// Part of a step at which the slope of the energy is zero, from the slopes at its ends and what the pairs do.
fn lowest(start: f64, end: f64, moved: &[Moved]) -> f64 {
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
