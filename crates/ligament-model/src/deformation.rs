//! Deformations of all bonds of a body.
//!
//! A bond in the plane has at most three strains, which are what criteria measure. One in space has a stretch and two vectors, of which
//! criteria see the lengths: they stand beside the vectors, so that what judges bonds reads the same array in the plane and in space.

use std::ops::Deref;

use rayon::prelude::*;

use crate::element::BondDeformation;

/// Deformation of a bond in space between the points A and B, with the unit vector n from A to B and the projection P = I - n n^T.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SpaceDeformation {
    /// Stretch s = n . (u_B - u_A)/l.
    pub stretch: f64,
    /// Shear gamma = P (u_B - u_A)/l - 1/2 (phi_A + phi_B) x n, at right angles to n, rad.
    pub shear: [f64; 3],
    /// Relative rotation phi_B - phi_A of the ends, rad.
    pub rotation: [f64; 3],
}

impl SpaceDeformation {
    /// A multiple of it.
    #[inline]
    pub fn scaled(&self, factor: f64) -> Self {
        Self {
            stretch: factor * self.stretch,
            shear: self.shear.map(|strain| factor * strain),
            rotation: self.rotation.map(|strain| factor * strain),
        }
    }

    /// What is left of it without another one.
    #[inline]
    pub fn less(&self, other: &Self) -> Self {
        let less = |one: [f64; 3], other: [f64; 3]| std::array::from_fn(|k| one[k] - other[k]);
        Self {
            stretch: self.stretch - other.stretch,
            shear: less(self.shear, other.shear),
            rotation: less(self.rotation, other.rotation),
        }
    }

    /// Strains that criteria measure: s, |gamma| and the size of the relative rotation.
    #[inline]
    pub fn measured(&self) -> BondDeformation {
        let size = |[x, y, z]: [f64; 3]| (x * x + y * y + z * z).sqrt();
        BondDeformation::new([self.stretch, size(self.shear), size(self.rotation)])
    }
}

/// Deformations of all bonds. It reads as the slice of what criteria measure of them, shape (n_bonds).
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Deformations {
    measured: Vec<BondDeformation>,
    /// Deformations of bonds in space, shape (n_bonds); empty in the plane.
    in_space: Vec<SpaceDeformation>,
}

impl Deformations {
    /// Deformations of bonds in the plane, shape (n_bonds).
    pub fn in_plane(deformations: Vec<BondDeformation>) -> Self {
        Self {
            measured: deformations,
            in_space: Vec::new(),
        }
    }

    /// Deformations of bonds in space, shape (n_bonds).
    pub fn in_space(deformations: Vec<SpaceDeformation>) -> Self {
        Self {
            measured: (deformations.par_iter())
                .map(SpaceDeformation::measured)
                .collect(),
            in_space: deformations,
        }
    }

    /// Strains that criteria measure, shape (n_bonds).
    #[inline]
    pub fn measured(&self) -> &[BondDeformation] {
        &self.measured
    }

    /// Deformations of bonds in space, shape (n_bonds); empty in the plane.
    #[inline]
    pub fn vectors(&self) -> &[SpaceDeformation] {
        &self.in_space
    }

    /// Multiples of all of them.
    pub fn scaled(&self, factor: f64) -> Self {
        if self.in_space.is_empty() {
            let all = self.measured.par_iter();
            return Self::in_plane(all.map(|it| it.scaled(factor)).collect());
        }
        let all = self.in_space.par_iter();
        Self::in_space(all.map(|it| it.scaled(factor)).collect())
    }

    /// Deformations on the line from here along slopes (n_bonds), `by` times the slopes ahead.
    pub fn ahead(&self, slopes: &Self, by: f64) -> Self {
        if self.in_space.is_empty() {
            let both = self.measured.par_iter().zip(&slopes.measured);
            let ahead = both.map(|(here, slope)| here.less(&slope.scaled(-by)));
            return Self::in_plane(ahead.collect());
        }
        let both = self.in_space.par_iter().zip(&slopes.in_space);
        Self::in_space(
            both.map(|(here, slope)| here.less(&slope.scaled(-by)))
                .collect(),
        )
    }
}

impl Deref for Deformations {
    type Target = [BondDeformation];

    fn deref(&self) -> &[BondDeformation] {
        &self.measured
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Lengths of sums are no sums of lengths: what criteria measure ahead on a line comes from the vectors.
    #[test]
    fn a_line_in_space_is_one_of_vectors() {
        let deformation = |stretch, x, y| SpaceDeformation {
            stretch,
            shear: [x, y, 0.0],
            rotation: [0.0, y, x],
        };
        let here = Deformations::in_space(vec![deformation(1.0, 3.0, 0.0)]);
        let slopes = Deformations::in_space(vec![deformation(-1.0, 0.0, 2.0)]);
        let ahead = here.ahead(&slopes, 2.0);
        assert_eq!(ahead[0], BondDeformation::new([-1.0, 5.0, 5.0]));
        assert_eq!(
            ahead.scaled(-2.0)[0],
            BondDeformation::new([2.0, 10.0, 10.0])
        );
        assert_eq!(ahead.vectors()[0], deformation(-1.0, 3.0, 4.0));
    }
}
