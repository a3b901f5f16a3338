//! Displacements at which the curves of samples are compared.

use ligament_analysis::Termination;
use ligament_analysis::driver::{LoadPoint, Outcome};

use serde::{Deserialize, Serialize};

/// Share by which the grid goes beyond the largest displacement of the body without random factors.
const BEYOND: f64 = 1.25;

/// Displacements 0, d, 2 d, ... at which the curves of samples are compared.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Grid {
    /// Largest displacement, in the unit of the control load.
    pub(super) end: f64,
    /// Number of displacements.
    pub(super) n: usize,
}

impl Grid {
    /// A grid of n displacements up to a given one, or beyond the displacements of the body without random factors.
    pub(super) fn new(n: usize, given: Option<f64>, sound: &Outcome) -> Self {
        let largest = sound.envelope().last().map_or(0.0, |it| it.displacement);
        let end = match sound.termination {
            Termination::FullLoad | Termination::StepsDone => largest,
            _ => two_digits(BEYOND * largest),
        };
        let end = given.unwrap_or(end);
        Self { end, n }
    }

    /// The displacements, shape (n).
    pub(super) fn displacements(self) -> Vec<f64> {
        let last = self.n.saturating_sub(1).max(1) as f64;
        (0..self.n)
            .map(|it| self.end * (it as f64 / last))
            .collect()
    }

    /// Loads of a path at the displacements, shape (n), with straight lines between its points. Beyond the end of the path the load is 0 if
    /// the body failed, otherwise unknown.
    pub(super) fn loads(self, outcome: &Outcome) -> Vec<Option<f64>> {
        let curve = outcome.envelope();
        let beyond = has_failed(&outcome.termination).then_some(0.0);
        let load = |displacement: f64| load_at(&curve, displacement).or(beyond);
        self.displacements().into_iter().map(load).collect()
    }
}

/// Whether a path ended because the body no longer carries its load.
fn has_failed(end: &Termination) -> bool {
    matches!(
        end,
        Termination::FellApart | Termination::Collapsed | Termination::LoadFraction { .. }
    )
}

/// Load of a curve of ascending displacements at one of them; where it drops, the load after the drop.
fn load_at(curve: &[LoadPoint], displacement: f64) -> Option<f64> {
    let next = curve.partition_point(|it| it.displacement <= displacement);
    let before = curve[..next].last()?;
    match curve.get(next) {
        None => (before.displacement == displacement).then_some(before.reaction),
        Some(after) => {
            let length = after.displacement - before.displacement;
            let share = (displacement - before.displacement) / length;
            Some((1.0 - share) * before.reaction + share * after.reaction)
        }
    }
}

/// A number rounded to two digits.
fn two_digits(value: f64) -> f64 {
    // A parsed number equals the written one.
    format!("{value:.1e}").parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(displacement: f64, reaction: f64) -> LoadPoint {
        LoadPoint {
            displacement,
            reaction,
            load_factor: 0.0,
        }
    }

    /// A curve that rises to (2, 4), drops to 1 and rises to (4, 2): by hand.
    #[test]
    fn loads_lie_on_straight_lines_and_after_drops() {
        let curve = [
            point(0.0, 0.0),
            point(2.0, 4.0),
            point(2.0, 1.0),
            point(4.0, 2.0),
        ];
        let found = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0].map(|it| load_at(&curve, it));
        let known = [Some(0.0), Some(2.0), Some(1.0), Some(1.5), Some(2.0), None];
        assert_eq!(found, known);
    }

    #[test]
    fn a_grid_ends_at_two_digits() {
        assert_eq!(two_digits(6.7461e-6), 6.7e-6);
        assert_eq!(two_digits(0.0), 0.0);
    }
}
