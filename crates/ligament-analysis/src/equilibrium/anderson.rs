//! Anderson's mixing of fixed-point iterates (Walker and Ni 2011): several corrections tell what the
//! iteration will go on to do.

use std::collections::VecDeque;

use nalgebra::{DMatrix, DVector};

/// Corrections that are mixed with the last one.
const DEPTH: usize = 5;

/// The last iterates u_k and corrections f_k = g(u_k) - u_k of an iteration u -> g(u).
pub(super) struct Mixing {
    /// What makes the components comparable, shape (n).
    scale: Vec<f64>,
    last: Option<(Vec<f64>, Vec<f64>)>,
    /// Differences of successive iterates and corrections.
    differences: VecDeque<(Vec<f64>, Vec<f64>)>,
}

impl Mixing {
    /// Without iterates, for components that count times `scale` (n).
    pub(super) fn new(scale: Vec<f64>) -> Self {
        Self {
            scale,
            last: None,
            differences: VecDeque::new(),
        }
    }

    /// The step from iterate `u` with the correction `f` that its neighbours suggest:
    ///
    /// f - sum_j gamma_j (du_j + df_j), with gamma the least squares of |f - sum_j gamma_j df_j|.
    pub(super) fn step(&mut self, u: Vec<f64>, f: Vec<f64>) -> Vec<f64> {
        if let Some((last_u, last_f)) = self.last.take() {
            self.differences.truncate(DEPTH - 1);
            self.differences
                .push_front((difference(&u, &last_u), difference(&f, &last_f)));
        }
        let step = self.mixed(&f);
        self.last = Some((u, f));
        step
    }

    /// Forgets the iterates: they mislead where bonds just began or ceased to soften.
    pub(super) fn restart(&mut self) {
        self.last = None;
        self.differences.clear();
    }

    fn mixed(&self, f: &[f64]) -> Vec<f64> {
        let n = self.differences.len();
        let dot = |one: &[f64], other: &[f64]| -> f64 {
            let products = one.iter().zip(other).zip(&self.scale);
            products.map(|((a, b), scale)| a * b * scale * scale).sum()
        };
        let of = |k: usize| &self.differences[k].1;
        let matrix = DMatrix::from_fn(n, n, |i, j| dot(of(i), of(j)));
        let side = DVector::from_fn(n, |i, _| dot(of(i), f));
        // Nearly parallel differences say nothing new; where they are too near, the plain correction is taken.
        let weights = matrix.cholesky().map(|it| it.solve(&side));
        let mut step = f.to_vec();
        if let Some(weights) = weights.filter(|it| it.iter().all(|weight| weight.is_finite())) {
            for (weight, (du, df)) in weights.iter().zip(&self.differences) {
                for ((value, du), df) in step.iter_mut().zip(du).zip(df) {
                    *value -= weight * (du + df);
                }
            }
        }
        step
    }
}

fn difference(one: &[f64], other: &[f64]) -> Vec<f64> {
    one.iter().zip(other).map(|(a, b)| a - b).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// g(u) = A u + b, which alone comes nearer by 0.9 an iteration.
    fn correction(u: &[f64]) -> Vec<f64> {
        vec![
            0.9 * u[0] + 0.1 * u[1] + 1.0 - u[0],
            0.8 * u[1] - 2.0 - u[1],
            0.3 * u[2] + 0.2 * u[0] - u[2],
        ]
    }

    fn size(f: &[f64]) -> f64 {
        f.iter()
            .fold(0.0, |largest: f64, value| largest.max(value.abs()))
    }

    /// Three independent differences span the space, in which the mixed step of a linear iteration is exact: the fifth iterate is
    /// the answer, of size 10. 1e-6: the normal equations square the condition of differences that differ a hundredfold in size
    /// (a thousandfold more with the second scale).
    #[test]
    fn a_linear_iteration_ends_after_as_many_steps_as_unknowns() {
        for scale in [1.0, 1e-3] {
            let mut mixing = Mixing::new(vec![1.0, scale, 1.0]);
            let (mut u, mut alone) = (vec![0.0; 3], vec![0.0; 3]);
            for _ in 0..5 {
                let step = mixing.step(u.clone(), correction(&u));
                u.iter_mut()
                    .zip(step)
                    .for_each(|(value, step)| *value += step);
                let step = correction(&alone);
                alone
                    .iter_mut()
                    .zip(step)
                    .for_each(|(value, step)| *value += step);
            }
            assert!(size(&correction(&u)) < 1e-6, "{u:?}");
            assert!(size(&correction(&alone)) > 0.1);
        }
    }

    #[test]
    fn a_fresh_start_takes_the_plain_correction() {
        let mut mixing = Mixing::new(vec![1.0; 3]);
        for u in [vec![0.0; 3], vec![1.0, 2.0, 3.0]] {
            mixing.restart();
            assert_eq!(mixing.step(u.clone(), correction(&u)), correction(&u));
        }
    }
}
