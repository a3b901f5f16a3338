//! Limited-memory BFGS: approximates the stiffness along the last steps of an iteration (Nocedal 1980; Nocedal and Wright 2006,
//! algorithm 7.4).

use std::io::Read;

use crate::checkpoint::CheckpointError;
use crate::serial::{Serial, Sink};
use crate::unbalanced::Unbalanced;

/// Largest number of recorded steps.
const DEPTH: usize = 20;

/// A step du of an iteration and the change K du of the residual force, both of shape (n_unknowns).
#[derive(Clone)]
struct Pair {
    step: Vec<f64>,
    change: Vec<f64>,
    /// du . K du, J.
    work: f64,
}

/// Recorded steps of an iteration, the newest first.
#[derive(Clone, Default)]
pub(super) struct Curvature {
    pairs: Vec<Pair>,
}

impl Curvature {
    /// Corrections H r for N residual forces r, all of shape (n_unknowns).
    ///
    /// `dot` is the scalar product over all unknowns, and `solve` multiplies by the inverse of a stiffness near the tangent. H is
    /// that inverse after the BFGS updates by all recorded steps; it is positive definite if the stiffness is, and maps the change
    /// of the newest step to that step.
    pub(super) fn corrections<const N: usize>(
        &self,
        mut forces: [Vec<f64>; N],
        dot: &dyn Fn(&[f64], &[f64]) -> f64,
        solve: impl FnOnce([Vec<f64>; N]) -> Result<[Vec<f64>; N], Unbalanced>,
    ) -> Result<[Vec<f64>; N], Unbalanced> {
        let mut shares = Vec::with_capacity(self.pairs.len());
        for pair in &self.pairs {
            shares.push(forces.each_mut().map(|force| {
                let share = dot(&pair.step, force) / pair.work;
                add(force, -share, &pair.change);
                share
            }));
        }
        let mut corrections = solve(forces)?;
        for (pair, shares) in self.pairs.iter().zip(shares).rev() {
            for (correction, share) in corrections.iter_mut().zip(shares) {
                let given = dot(&pair.change, correction) / pair.work;
                add(correction, share - given, &pair.step);
            }
        }
        Ok(corrections)
    }

    /// Records a step, the change of the residual force (n_unknowns) and their scalar product. Steps of negative curvature are left
    /// out, because no positive definite stiffness has them.
    pub(super) fn learn(&mut self, step: Vec<f64>, change: Vec<f64>, work: f64) {
        if work > 0.0 {
            self.pairs.truncate(DEPTH - 1);
            self.pairs.insert(0, Pair { step, change, work });
        }
    }

    /// Appends the recorded steps, with a function that appends values at the unknowns.
    pub(super) fn write(&self, values: impl Fn(&[f64], &mut dyn Sink), out: &mut dyn Sink) {
        self.pairs.len().write(out);
        for Pair { step, change, work } in &self.pairs {
            values(step, out);
            values(change, out);
            work.write(out);
        }
    }

    /// Reads recorded steps, with a function that reads values at the unknowns.
    ///
    /// # Errors
    ///
    /// If the bytes are damaged or belong to another body.
    pub(super) fn read(
        values: impl Fn(&mut dyn Read) -> Result<Vec<f64>, CheckpointError>,
        from: &mut dyn Read,
    ) -> Result<Self, CheckpointError> {
        let count = usize::read(from)?;
        let mut pair = || {
            Ok(Pair {
                step: values(from)?,
                change: values(from)?,
                work: Serial::read(from)?,
            })
        };
        let pairs: Result<Vec<Pair>, CheckpointError> = (0..count).map(|_| pair()).collect();
        Ok(Self { pairs: pairs? })
    }

    /// Removes all recorded steps.
    pub(super) fn discard(&mut self) {
        self.pairs.clear();
    }
}

fn add(to: &mut [f64], factor: f64, values: &[f64]) {
    for (to, value) in to.iter_mut().zip(values) {
        *to += factor * value;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vectors::dot;

    /// A symmetric positive definite stiffness.
    const STIFFNESS: [[f64; 3]; 3] = [[4.0, 1.0, 0.5], [1.0, 3.0, -1.0], [0.5, -1.0, 2.0]];

    fn times_stiffness(u: &[f64]) -> Vec<f64> {
        STIFFNESS.iter().map(|row| dot(row, u)).collect()
    }

    /// On a quadratic energy with exact searches the method equals conjugate gradients: it ends after as many steps as there are
    /// unknowns, here three, whatever positive definite stiffness is solved with. 1e-12: rounding of forces of size 1.
    #[test]
    fn a_linear_body_takes_as_many_steps_as_unknowns() {
        let mut curvature = Curvature::default();
        let (mut u, mut force) = (vec![0.0; 3], vec![1.0, -2.0, 0.7]);
        for step in 0..3 {
            assert!(dot(&force, &force) > 1e-4, "too early: {step}");
            let near = |[it]: [Vec<f64>; 1]| Ok([vec![it[0], 0.3 * it[1], 2.0 * it[2]]]);
            let [correction] = curvature
                .corrections([force.clone()], &dot, near)
                .expect("a solution");
            let change = times_stiffness(&correction);
            let part = dot(&force, &correction) / dot(&correction, &change);
            let scaled = |values: Vec<f64>| values.into_iter().map(|it| part * it).collect();
            let (step, change): (Vec<f64>, Vec<f64>) = (scaled(correction), scaled(change));
            add(&mut u, 1.0, &step);
            add(&mut force, -1.0, &change);
            let work = dot(&step, &change);
            curvature.learn(step, change, work);
        }
        assert!(force.iter().all(|it| it.abs() < 1e-12), "{force:?}");
        let expected = [1.0, -2.0, 0.7];
        let found = times_stiffness(&u);
        assert!(
            (0..3).all(|i| (found[i] - expected[i]).abs() < 1e-12),
            "{u:?}"
        );
    }

    #[test]
    fn a_step_along_which_the_body_gave_way_is_left_out() {
        let mut curvature = Curvature::default();
        curvature.learn(vec![1.0, 0.0], vec![-1.0, 0.5], -1.0);
        assert_eq!(
            curvature.corrections([vec![3.0, 4.0]], &dot, Ok),
            Ok([vec![3.0, 4.0]])
        );
        curvature.learn(vec![1.0, 0.0], vec![2.0, 0.0], 2.0);
        assert_eq!(
            curvature.corrections([vec![3.0, 4.0]], &dot, Ok),
            Ok([vec![1.5, 4.0]])
        );
        curvature.discard();
        assert_eq!(
            curvature.corrections([vec![3.0, 4.0]], &dot, Ok),
            Ok([vec![3.0, 4.0]])
        );
    }
}
