//! Vectors and symmetric tensors in D dimensions.

use nalgebra::{DMatrix, Dyn, SymmetricEigen};

/// Components of a symmetric tensor as row and column, in the order of calculations: the components of the plane come first, so that the plane is a
/// part of space.
pub(crate) const ORDER: [[usize; 2]; 6] = [[0, 0], [1, 1], [0, 1], [2, 2], [0, 2], [1, 2]];

/// Names of the components of a symmetric tensor, in order.
const NAMES: [&str; 6] = ["xx", "yy", "xy", "zz", "xz", "yz"];

/// Scalar product a . b.
#[inline(always)]
pub fn dot<const D: usize>(a: [f64; D], b: [f64; D]) -> f64 {
    let mut sum = a[0] * b[0];
    for axis in 1..D {
        sum += a[axis] * b[axis];
    }
    sum
}

/// Vector product a x b.
#[inline(always)]
pub fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// Difference a - b.
#[inline(always)]
pub fn minus<const D: usize>(a: [f64; D], b: [f64; D]) -> [f64; D] {
    std::array::from_fn(|axis| a[axis] - b[axis])
}

/// Length of a vector.
#[inline(always)]
pub fn norm<const D: usize>(a: [f64; D]) -> f64 {
    dot(a, a).sqrt()
}

/// Unit vectors orthogonal to a unit vector: one in the plane, to its left, and two in space ([`tangents`]).
pub fn directions_across<const D: usize>(n: [f64; D]) -> Vec<[f64; D]> {
    match D {
        2 => vec![std::array::from_fn(
            |axis| if axis == 0 { -n[1] } else { n[0] },
        )],
        _ => {
            let tangents = tangents(std::array::from_fn(|axis| n[axis]));
            let resized = |it: [f64; 3]| std::array::from_fn(|axis| it[axis]);
            tangents.map(resized).to_vec()
        }
    }
}

/// Two unit vectors orthogonal to a unit vector n and to each other, right-handed with it: n x t_1 = t_2. The first is derived from the axis
/// least inclined to n, the first of equals.
pub fn tangents(n: [f64; 3]) -> [[f64; 3]; 2] {
    let mut least = 0;
    for axis in 1..3 {
        if n[axis].abs() < n[least].abs() {
            least = axis;
        }
    }
    let mut first = n.map(|component| -n[least] * component);
    first[least] += 1.0;
    let size = norm(first);
    let first = first.map(|component| component / size);
    [first, cross(n, first)]
}

/// A symmetric tensor S of second order in D dimensions, such as a strain or a stress. Shear strains are tensor components, eps_xy = gamma_xy/2.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SymTensor<const D: usize> {
    rows: [[f64; D]; D],
}

impl<const D: usize> Default for SymTensor<D> {
    fn default() -> Self {
        Self::ZERO
    }
}

impl<const D: usize> SymTensor<D> {
    /// The zero tensor.
    pub const ZERO: Self = Self {
        rows: [[0.0; D]; D],
    };

    /// Row and column of each component in their order: xx, yy, xy and in space also zz, xz, yz.
    pub const COMPONENTS: &'static [[usize; 2]] = ORDER.split_at(D * (D + 1) / 2).0;

    /// Names of the components in their order.
    pub const NAMES: &'static [&'static str] = NAMES.split_at(D * (D + 1) / 2).0;

    /// Names of the components in their order, in the plane with the normal component across it.
    pub const NAMES_WITH_NORMAL: &'static [&'static str] = match D {
        2 => NAMES.split_at(4).0,
        _ => Self::NAMES,
    };

    /// The tensor with components in order, zero where some of the last are missing: in space the tensor of a plane with its normal component.
    pub fn from_first_components(components: &[f64]) -> Self {
        let mut values = components.iter();
        Self::from_fn(|_, _| *values.next().unwrap_or(&0.0))
    }

    /// The tensor whose components a function gives by row and column (row <= column).
    #[inline]
    pub fn from_fn(mut component: impl FnMut(usize, usize) -> f64) -> Self {
        let mut rows = [[0.0; D]; D];
        for &[row, column] in Self::COMPONENTS {
            let value = component(row, column);
            rows[row][column] = value;
            rows[column][row] = value;
        }
        Self { rows }
    }

    /// The tensor with D (D + 1)/2 components in order.
    pub fn from_components(components: &[f64]) -> Self {
        assert_eq!(components.len(), Self::COMPONENTS.len());
        Self::from_first_components(components)
    }

    /// The unit tensor times a value.
    pub fn isotropic(value: f64) -> Self {
        Self::from_fn(|row, column| if row == column { value } else { 0.0 })
    }

    /// The symmetric part of the dyad f (x) x: (f_i x_j + f_j x_i)/2.
    #[inline]
    pub fn dyad(f: [f64; D], x: [f64; D]) -> Self {
        Self::from_fn(|row, column| {
            if row == column {
                f[row] * x[row]
            } else {
                0.5 * (f[row] * x[column] + f[column] * x[row])
            }
        })
    }

    /// The component S_ij.
    #[inline(always)]
    pub fn at(&self, row: usize, column: usize) -> f64 {
        self.rows[row][column]
    }

    /// The engineering strains of a strain in their order: eps_ii, and gamma_ij = 2 eps_ij.
    pub fn engineering(&self) -> impl Iterator<Item = f64> {
        let rows = self.rows;
        Self::COMPONENTS.iter().map(move |&[row, column]| {
            let component = rows[row][column];
            if row == column {
                component
            } else {
                2.0 * component
            }
        })
    }

    /// The strain with engineering strains in their order: eps_ii, and gamma_ij = 2 eps_ij.
    pub fn from_engineering(strains: &[f64]) -> Self {
        let tensor = Self::from_components(strains);
        Self::from_fn(|row, column| {
            let strain = tensor.at(row, column);
            if row == column { strain } else { 0.5 * strain }
        })
    }

    /// The components in their order.
    pub fn components(&self) -> impl Iterator<Item = f64> {
        let rows = self.rows;
        (Self::COMPONENTS.iter()).map(move |&[row, column]| rows[row][column])
    }

    /// The vector S n.
    #[inline]
    pub fn times(&self, n: [f64; D]) -> [f64; D] {
        self.rows.map(|row| dot(row, n))
    }

    /// The tensor with a function applied to each component.
    #[inline]
    pub fn map(&self, function: impl Fn(f64) -> f64) -> Self {
        Self {
            rows: self.rows.map(|row| row.map(&function)),
        }
    }

    /// The tensor with every component times a factor.
    #[inline]
    pub fn scaled(&self, factor: f64) -> Self {
        self.map(|value| factor * value)
    }

    /// The sum of two tensors.
    #[inline]
    pub fn plus(&self, other: &Self) -> Self {
        Self {
            rows: std::array::from_fn(|row| {
                std::array::from_fn(|column| self.rows[row][column] + other.rows[row][column])
            }),
        }
    }

    /// The sum of the normal components.
    #[inline]
    pub fn trace(&self) -> f64 {
        (0..D).map(|axis| self.at(axis, axis)).sum()
    }

    /// The double contraction S : T, the sum over i and j of S_ij T_ij.
    pub fn contracted(&self, other: &Self) -> f64 {
        let work_conjugate = self.components().zip(other.engineering());
        work_conjugate.map(|(one, other)| one * other).sum()
    }

    /// The tensor Q S Q^T in axes whose unit vectors are the rows of Q.
    pub fn rotated(&self, axes: [[f64; D]; D]) -> Self {
        let columns = axes.map(|axis| self.times(axis));
        Self::from_fn(|row, column| dot(axes[row], columns[column]))
    }

    /// The principal values, the largest first.
    pub fn principal_values(&self) -> [f64; D] {
        if D == 2 {
            let [xx, yy, xy] = [self.rows[0][0], self.rows[1][1], self.rows[0][1]];
            let (mean, radius) = (0.5 * (xx + yy), (0.5 * (xx - yy)).hypot(xy));
            return std::array::from_fn(|it| {
                if it == 0 {
                    mean + radius
                } else {
                    mean - radius
                }
            });
        }
        let mut values = self.eigen().eigenvalues;
        values
            .as_mut_slice()
            .sort_by(|one, other| other.total_cmp(one));
        std::array::from_fn(|it| values[it])
    }

    /// Unit vector along which the principal value is largest; of the two the one whose first component other than zero is positive.
    pub fn principal_direction(&self) -> [f64; D] {
        if D == 2 {
            let [xx, yy, xy] = [self.rows[0][0], self.rows[1][1], self.rows[0][1]];
            let (sine, cosine) = (0.5 * (2.0 * xy).atan2(xx - yy)).sin_cos();
            return std::array::from_fn(|axis| if axis == 0 { cosine } else { sine });
        }
        let eigen = self.eigen();
        let vector = eigen.eigenvectors.column(eigen.eigenvalues.imax());
        let first = vector.iter().find(|it| **it != 0.0);
        let sign = first.map_or(1.0, |it| it.signum());
        std::array::from_fn(|axis| sign * vector[axis])
    }

    fn eigen(&self) -> SymmetricEigen<f64, Dyn> {
        SymmetricEigen::new(DMatrix::from_fn(D, D, |row, column| self.rows[row][column]))
    }

    /// The part of the tensor in the first E dimensions; for E > D with zeros beyond the D dimensions.
    #[inline]
    pub fn resized<const E: usize>(&self) -> SymTensor<E> {
        SymTensor::from_fn(|row, column| {
            if row < D && column < D {
                self.rows[row][column]
            } else {
                0.0
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_plane_is_the_first_part_of_space() {
        assert_eq!(SymTensor::<2>::NAMES, ["xx", "yy", "xy"]);
        assert_eq!(SymTensor::<3>::NAMES, ["xx", "yy", "xy", "zz", "xz", "yz"]);
        let values = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0];
        let tensor = SymTensor::<3>::from_components(&values);
        assert_eq!((tensor.at(2, 0), tensor.at(1, 2)), (5.0, 6.0));
        assert_eq!(tensor.components().collect::<Vec<_>>(), values);
        let plane = tensor.resized::<2>();
        assert_eq!(plane, SymTensor::from_components(&values[..3]));
        assert_eq!(plane.resized::<3>().at(2, 2), 0.0);
        assert_eq!(plane.engineering().collect::<Vec<_>>(), [1.0, 2.0, 6.0]);
        assert_eq!(SymTensor::from_engineering(&[1.0, 2.0, 6.0]), plane);
    }

    /// A quarter of a turn about z takes x to y; the dyad of two vectors does the work f . S x.
    #[test]
    fn products_are_those_of_matrices() {
        let tensor = SymTensor::<3>::from_components(&[1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
        let turned = tensor.rotated([[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]);
        let expected = SymTensor::from_components(&[2.0, 1.0, -3.0, 4.0, 6.0, -5.0]);
        assert_eq!(turned, expected);
        let (f, x) = ([1.0, -2.0, 0.5], [2.0, 4.0, -1.0]);
        let work = dot(f, tensor.times(x));
        assert_eq!(SymTensor::dyad(f, x).contracted(&tensor), work);
        let doubled = tensor.plus(&tensor);
        assert_eq!(doubled, tensor.scaled(2.0));
        assert_eq!(SymTensor::isotropic(3.0).times(x), x.map(|it| 3.0 * it));
    }

    /// Values and directions of tensors made from them: the axes of two rotations, and a plane turned by -70 degrees, whose direction is
    /// the one with a positive x.
    #[test]
    fn principal_values_and_directions_are_those_a_tensor_is_made_of() {
        let axes =
            [[2.0, -1.0, 2.0], [2.0, 2.0, -1.0], [-1.0, 2.0, 2.0]].map(|it| it.map(|it| it / 3.0));
        let sum = |values: [f64; 3]| {
            let parts = (0..3).map(|it| SymTensor::dyad(axes[it], axes[it]).scaled(values[it]));
            parts.fold(SymTensor::<3>::ZERO, |sum, part| sum.plus(&part))
        };
        let is_close = |found: &[f64], expected: &[f64]| {
            (found.iter().zip(expected)).all(|(one, other)| (one - other).abs() < 1e-14)
        };
        for (values, largest) in [([-4.0, 5.0, 1.0], 1), ([-1.0, -7.0, -3.0], 0)] {
            let (tensor, mut sorted) = (sum(values), values);
            sorted.sort_by(|one, other| other.total_cmp(one));
            let found = (tensor.principal_values(), tensor.principal_direction());
            assert!(is_close(&found.0, &sorted), "{found:?}");
            assert!(is_close(&found.1, &axes[largest]), "{found:?}");
        }
        let (sine, cosine) = (-70.0_f64).to_radians().sin_cos();
        let [along, across] = [[-cosine, -sine], [sine, -cosine]];
        let plane = SymTensor::dyad(along, along).scaled(3.0);
        let plane = plane.plus(&SymTensor::dyad(across, across).scaled(-2.0));
        assert!(is_close(&plane.principal_values(), &[3.0, -2.0]));
        assert!(is_close(&plane.principal_direction(), &[cosine, sine]));
    }

    #[test]
    fn tangents_are_a_right_handed_frame() {
        let n = [2.0 / 3.0, -1.0 / 3.0, 2.0 / 3.0];
        let [one, other] = tangents(n);
        assert!(dot(n, one).abs() < 1e-16 && (norm(one) - 1.0).abs() < 1e-15);
        assert_eq!(minus(cross(n, one), other), [0.0; 3]);
    }
}
