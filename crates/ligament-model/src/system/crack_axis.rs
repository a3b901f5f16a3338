//! The normal of a crack from the directions of the bonds that it broke.

use nalgebra::Matrix3;

use crate::tensor::{ORDER, SymTensor, dot};

/// Sum of e (x) e over directions e, which have no sign; in the plane as the sum over the doubled angles, e_x^2 - e_y^2 and 2 e_x e_y.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct AxisSum<const D: usize> {
    values: [f64; 6],
}

impl<const D: usize> AxisSum<D> {
    /// Number of values of a sum.
    pub(super) const N_VALUES: usize = if D == 2 { 2 } else { ORDER.len() };

    /// Adds a direction to the sum.
    pub(super) fn add(&mut self, direction: [f64; D]) {
        if let [x, y] = direction.as_slice() {
            self.values[0] = self.values[0] + x * x - y * y;
            self.values[1] += 2.0 * x * y;
            return;
        }
        let dyad = SymTensor::dyad(direction, direction);
        for (sum, value) in self.values.iter_mut().zip(dyad.components()) {
            *sum += value;
        }
    }

    /// The sum of two sums.
    pub(super) fn plus(self, other: Self) -> Self {
        Self {
            values: std::array::from_fn(|place| self.values[place] + other.values[place]),
        }
    }

    /// Values of the sum, of which there are `N_VALUES`.
    pub(super) fn values(self) -> impl Iterator<Item = f64> {
        self.values.into_iter().take(Self::N_VALUES)
    }

    /// The sum with given values.
    pub(super) fn from_values(values: &[f64]) -> Self {
        let mut sum = Self::default();
        for (value, given) in sum.values.iter_mut().zip(values) {
            *value = *given;
        }
        sum
    }

    /// Principal axis of the directions, oriented towards a given direction; that direction itself where no axis dominates.
    pub(super) fn axis_towards(self, direction: [f64; D]) -> [f64; D] {
        let axis = match D {
            2 => self.axis_in_plane(),
            _ => self.axis_in_space(),
        };
        let Some(axis) = axis else {
            return direction;
        };
        let axis = std::array::from_fn(|place| axis[place]);
        if dot(axis, direction) < 0.0 {
            axis.map(|component| -component)
        } else {
            axis
        }
    }

    fn axis_in_plane(self) -> Option<[f64; 3]> {
        let [cosine, sine, ..] = self.values;
        let size = cosine.hypot(sine);
        let (x, y) = (
            (0.5 * (1.0 + cosine / size)).max(0.0).sqrt(),
            (0.5 * (1.0 - cosine / size)).max(0.0).sqrt(),
        );
        (size != 0.0).then_some([x, y.copysign(sine), 0.0])
    }

    /// Eigenvector of the largest eigenvalue, if it is simple.
    fn axis_in_space(self) -> Option<[f64; 3]> {
        let tensor = SymTensor::<3>::from_components(&self.values);
        let matrix = Matrix3::from_fn(|row, column| tensor.at(row, column));
        let eigen = matrix.symmetric_eigen();
        let mut order = [0, 1, 2];
        order.sort_by(|&one, &other| eigen.eigenvalues[other].total_cmp(&eigen.eigenvalues[one]));
        let [largest, next, _] = order.map(|place| eigen.eigenvalues[place]);
        // Relative gap of the eigenvalues below which the axis is one of rounding.
        const LEADS: f64 = 1e-9;
        let axis = eigen.eigenvectors.column(order[0]);
        (largest - next > LEADS * largest).then(|| [axis[0], axis[1], axis[2]])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The sum over directions about an axis, at equal angles to it, leads along it, on the side of a given direction; those around a
    /// circle lead nowhere. Sums of some terms of size one round to 1e-15.
    fn assert_axis<const D: usize>(directions: &[[f64; D]], towards: [f64; D], expected: [f64; D]) {
        let mut sum = AxisSum::default();
        directions.iter().for_each(|it| sum.add(*it));
        let values: Vec<f64> = sum.values().collect();
        assert_eq!(AxisSum::from_values(&values), sum);
        let found = sum.axis_towards(towards);
        for (found, expected) in found.into_iter().zip(expected) {
            assert!((found - expected).abs() < 1e-14, "{found} for {expected}");
        }
    }

    #[test]
    fn axes_have_no_sign() {
        let about_x = [[0.8, 0.6], [0.8, -0.6]];
        assert_axis(&about_x, [1.0, 0.1], [1.0, 0.0]);
        assert_axis(&about_x, [-1.0, 0.1], [-1.0, 0.0]);
        assert_axis(&[[0.8, 0.6], [-0.6, 0.8]], [0.6, 0.8], [0.6, 0.8]);
        let about_z = [
            [0.6, 0.0, 0.8],
            [-0.6, 0.0, 0.8],
            [0.0, 0.6, -0.8],
            [0.0, 0.6, 0.8],
        ];
        assert_axis(&about_z, [0.1, 0.0, 0.9], [0.0, 0.0, 1.0]);
        assert_axis(&about_z, [0.1, 0.0, -0.9], [0.0, 0.0, -1.0]);
        let all = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        assert_axis(&all, [0.0, 0.6, 0.8], [0.0, 0.6, 0.8]);
    }
}
