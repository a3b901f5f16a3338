//! Masses of the degrees of freedom.

use ligament_model::LumpedMass;

use super::mode::Rotations;
use crate::unknowns::{Layout, Unknowns};

/// Relative difference from the largest displacement below which a displacement counts as largest.
const TIE: f64 = 1e-6;

/// Masses of the degrees of freedom.
pub(super) struct Masses {
    layout: Layout,
    /// Mass of each degree of freedom, zero where it is fixed or massless, shape (n_degrees_of_freedom).
    of_dof: Vec<f64>,
    /// Degrees of freedom that are not unknowns.
    known: Vec<usize>,
}

impl Masses {
    /// Masses of the unknowns.
    pub(super) fn new(mass: &LumpedMass, unknowns: &Unknowns, rotations: Rotations) -> Self {
        let layout = unknowns.layout();
        let of_component = |dof: usize| {
            let point = layout.point(dof) as usize;
            match (layout.component(dof).is_rotation(), rotations) {
                (false, _) => mass.mass[point],
                (true, Rotations::Inertia) => mass.inertia[point],
                (true, Rotations::Massless) => 0.0,
            }
        };
        let n_dofs = layout.n_degrees_of_freedom();
        Self {
            layout,
            of_dof: (0..n_dofs)
                .map(|dof| unknowns.number(dof).map_or(0.0, |_| of_component(dof)))
                .collect(),
            known: (0..n_dofs)
                .filter(|&dof| unknowns.number(dof).is_none())
                .collect(),
        }
    }

    /// Mass of each degree of freedom, zero where it is fixed or massless, shape (n_degrees_of_freedom).
    pub(super) fn of_dof(&self) -> &[f64] {
        &self.of_dof
    }

    /// Sets the values at fixed degrees of freedom to zero.
    pub(super) fn clear_known(&self, shape: &mut [f64]) {
        for &dof in &self.known {
            shape[dof] = 0.0;
        }
    }

    /// Removes the components of a shape along other orthonormal shapes.
    pub(super) fn remove(&self, others: &[Vec<f64>], shape: &mut [f64]) {
        for other in others {
            let along = inner(&self.of_dof, other, shape);
            for (value, other) in shape.iter_mut().zip(other) {
                *value -= along * other;
            }
        }
    }

    /// Scales a shape to phi^T M phi = 1, with the first of the largest displacements positive.
    pub(super) fn normalise(&self, shape: &mut [f64]) {
        let norm = inner(&self.of_dof, shape, shape).sqrt();
        let displacements = || self.layout.displacements(shape);
        let largest = displacements().fold(0.0_f64, |largest, value| largest.max(value.abs()));
        let first = displacements().find(|value| value.abs() >= (1.0 - TIE) * largest);
        let sign = first.map_or(1.0, f64::signum);
        let factor = sign / norm;
        shape.iter_mut().for_each(|value| *value *= factor);
    }
}

/// Weighted sum of products, sum w_i a_i b_i.
pub(super) fn inner(weight: &[f64], a: &[f64], b: &[f64]) -> f64 {
    let products = weight.iter().zip(a).zip(b);
    products.map(|((weight, a), b)| weight * a * b).sum()
}
