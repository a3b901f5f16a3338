//! Elements: the kinematics of bonds.
//!
//! | element | a point has | couples | deformation of a bond | laws |
//! |---|---|---|---|---|
//! | [`beam`] | two displacements and a rotation | its two ends | stretch, shear less the mean rotation, relative rotation | micropolar ones |
//! | [`spring`] | two displacements | its two ends | stretch, shear | `bbpd`, `pds` |
//! | [`imaginary`] | two displacements | up to six points of a lattice | the strains of a small rectangle around it | `mbb-pd` |
//! | [`true_strain`] | the same | the same | the same, over distances after the deformation | `mbb-pd` |
//! | [`pairwise`] | the same | the same, with forces on two ends | the same as the first | `mbb-pd` as printed |
//!
//! A law chooses the rigidities and knows no kinematics; an element knows nothing of laws. Arrays over degrees of freedom have
//! three components a point for all elements; the rotations of a body without them are zero and no unknowns.

pub mod beam;
pub mod imaginary;
pub mod pair;
pub mod pairwise;
pub mod spring;
pub mod true_strain;

use crate::bonds::{BondSet, Incidence};

/// Components of a point: displacement along x, along y, rotation.
pub const UNKNOWNS: usize = 3;

/// Which kinematics the bonds of a body have.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ElementKind {
    /// With rotations of the points: [`BeamBond`].
    Beam,
    /// Without: [`SpringBond`].
    Spring,
    /// Without, and with points beside its ends: [`ImaginaryElement`].
    Imaginary,
    /// The same with true strains: [`TrueStrainElement`].
    TrueStrain,
    /// The same with forces on its ends alone: [`PairwiseElement`].
    Pairwise,
}

impl ElementKind {
    /// Whether it has strains of its own, of a rectangle around the bond.
    pub fn has_strains(self) -> bool {
        match self {
            Self::Beam | Self::Spring => false,
            Self::Imaginary | Self::TrueStrain | Self::Pairwise => true,
        }
    }

    /// Names of the components of a deformation in results, in the order of the fields of [`BondDeformation`].
    pub const fn strain_names(self) -> &'static [&'static str] {
        match self {
            Self::Beam | Self::Spring => &["stretch", "shear", "rotation"],
            Self::Imaginary | Self::TrueStrain | Self::Pairwise => {
                &["strain_xx", "strain_xy", "strain_yy"]
            }
        }
    }
}

/// Deformation of a bond.
///
/// An [imaginary element](imaginary) has its strains S_xx, S_xy and S_yy in the places of stretch, shear and rotation.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct BondDeformation {
    /// Stretch s.
    pub stretch: f64,
    /// Shear deformation gamma, rad.
    pub shear: f64,
    /// Relative rotation theta_B - theta_A, rad.
    pub rotation: f64,
}

impl BondDeformation {
    /// That of an imaginary element with the strains (S_xx, S_yy, S_xy).
    #[inline]
    pub fn of_strain([xx, yy, xy]: [f64; 3]) -> Self {
        Self {
            stretch: xx,
            shear: xy,
            rotation: yy,
        }
    }

    /// The strains (S_xx, S_yy, S_xy) of an imaginary element.
    #[inline]
    pub fn strain(&self) -> [f64; 3] {
        [self.stretch, self.rotation, self.shear]
    }

    /// Its components in the order of [`ElementKind::strain_names`].
    #[inline]
    pub fn components(&self) -> [f64; 3] {
        [self.stretch, self.shear, self.rotation]
    }

    /// A multiple of it.
    #[inline]
    pub fn scaled(&self, factor: f64) -> Self {
        Self {
            stretch: factor * self.stretch,
            shear: factor * self.shear,
            rotation: factor * self.rotation,
        }
    }

    /// What is left of it without another one.
    #[inline]
    pub fn less(&self, other: &Self) -> Self {
        Self {
            stretch: self.stretch - other.stretch,
            shear: self.shear - other.shear,
            rotation: self.rotation - other.rotation,
        }
    }
}

/// Rigidities of all bonds: stiffness densities times what the bonds stand for.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Rigidities {
    /// Omega alpha V_A V_B k_n l, shape (n_bonds), J.
    pub axial: Vec<f64>,
    /// Omega alpha V_A V_B k_t l, shape (n_bonds), J.
    pub shear: Vec<f64>,
    /// Omega alpha V_A V_B k_theta, shape (n_bonds), J.
    pub rotational: Vec<f64>,
}

impl Rigidities {
    /// Rigidities against stretch and shear, which bonds of springs have.
    pub fn of_springs(&self) -> impl Iterator<Item = &f64> {
        self.axial.iter().chain(&self.shear)
    }
}

/// What is left of the stiffness of a bond: factors of its rigidities.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Remaining {
    /// Of the axial one.
    pub axial: f64,
    /// Of the one against shear.
    pub shear: f64,
    /// Of the one against relative rotation.
    pub rotational: f64,
}

impl Remaining {
    /// All of it.
    pub const WHOLE: Self = Self {
        axial: 1.0,
        shear: 1.0,
        rotational: 1.0,
    };

    /// Nothing of it.
    pub const NOTHING: Self = Self {
        axial: 0.0,
        shear: 0.0,
        rotational: 0.0,
    };

    /// Whether some factor differs from the other's by more than a relative tolerance.
    pub fn is_off(&self, other: &Self, tolerance: f64) -> bool {
        let is_off = |one: f64, other: f64| (one - other).abs() > tolerance * one.max(other);
        is_off(self.axial, other.axial)
            || is_off(self.shear, other.shear)
            || is_off(self.rotational, other.rotational)
    }

    /// What was lost from here to `later`.
    pub fn lost(&self, later: &Self) -> Self {
        Self {
            axial: self.axial - later.axial,
            shear: self.shear - later.shear,
            rotational: self.rotational - later.rotational,
        }
    }
}

/// The elements of all bonds: what makes the element of a bond from the bonds that are left.
pub trait Elements: Sync {
    /// Element of a bond.
    type Element: Element;

    /// The element of a bond while the bonds marked in `intact` (n_bonds) are unbroken.
    fn element(
        &self,
        bonds: &BondSet,
        rigidities: &Rigidities,
        intact: &[bool],
        bond: usize,
    ) -> Self::Element;

    /// Whether the points turn, and their rotations have a stiffness where bonds resist them.
    fn turns_points(&self) -> bool;

    /// Whether a rotation of the whole body costs nothing, although bonds resist shear.
    fn turns_freely(&self) -> bool;

    /// Whether forces are linear in the displacements.
    fn is_linear(&self) -> bool {
        true
    }

    /// Whether forces are those of an energy, so that the stiffness is symmetric.
    fn has_energy(&self) -> bool {
        true
    }

    /// Whether some bond has a negative stiffness, so that that of the body may be indefinite.
    fn some_negative(&self, rigidities: &Rigidities) -> bool {
        rigidities.of_springs().any(|&rigidity| rigidity < 0.0)
    }

    /// Share of the energy of a bond that belongs to one of its ends.
    fn share(&self, _bonds: &BondSet, _bond: u32, _point: u32) -> f64 {
        0.5
    }

    /// Bonds whose elements may change when some bonds break, themselves left out, ascending.
    fn leaning(&self, _bonds: &[u32]) -> Vec<u32> {
        Vec::new()
    }

    /// The bonds whose elements couple each point, and the other points that they couple it with; None where bonds couple
    /// their ends alone.
    fn couplings(&self) -> Option<[&Incidence; 2]> {
        None
    }
}

/// What every element does. Loops over all bonds take the element as a type and ask for it once, not bond by bond.
pub trait Element: Copy + PartialEq + std::fmt::Debug + Send + Sync + 'static {
    /// The element with its rigidities times what is left of them.
    fn weakened(self, remaining: &Remaining) -> Self;

    /// Deformation for the unknowns [u_x, u_y, theta] of all points, shape (3 n_points).
    fn deformation(&self, unknowns: &[f64]) -> BondDeformation;

    /// Deformation in a uniform strain (eps_xx, eps_yy, gamma_xy) without rotations.
    fn deformation_in(&self, strain: [f64; 3]) -> BondDeformation;

    /// 1/2 u^T K u', J, for two deformations of the same bond.
    fn mutual_energy(&self, one: &BondDeformation, other: &BondDeformation) -> f64;

    /// Adds the internal forces and moments K u on the points that the element couples, N and N m.
    fn forces(&self, deformation: &BondDeformation, add: impl FnMut(u32, [f64; UNKNOWNS]));

    /// Internal forces at the ends A and B of a bond of two points, N and N m; None for one that couples others as well.
    fn end_forces(&self, _deformation: &BondDeformation) -> Option<[[f64; UNKNOWNS]; 2]> {
        None
    }

    /// Sum over the points of internal force (x) position, its symmetric part (xx, yy, xy), J.
    fn dyad(&self, deformation: &BondDeformation) -> [f64; 3];

    /// K as a sum of rigidity g g^T; the rows g are given by degree of freedom (of 3 n_points).
    fn terms(&self) -> [Term; 3];

    /// Adds the blocks of K in the columns of one of its points, at the rows of points up to this one.
    fn upper_blocks(&self, point: u32, add: impl FnMut(u32, Block));

    /// Adds the derivatives of the forces by the unknowns: row, column, value.
    fn derivatives(&self, mut add: impl FnMut(usize, usize, f64)) {
        for (rigidity, entries) in self.terms() {
            for (row, one) in &entries {
                for (column, other) in &entries {
                    add(*row, *column, rigidity * one * other);
                }
            }
        }
    }
}

/// A block of a stiffness between two points: rows of the first, columns of the second.
pub type Block = [[f64; UNKNOWNS]; UNKNOWNS];

/// A term rigidity g g^T of an element stiffness: the rigidity, J, and the entries of g by degree of freedom.
pub type Term = (f64, Vec<(usize, f64)>);

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]
mod tests {
    use super::*;
    use nalgebra::{Matrix6, Vector6};

    const LENGTH: f64 = 0.7;

    fn springs(angle: f64, shear_sign: f64) -> SpringBond {
        SpringBond {
            length: LENGTH,
            direction: [angle.cos(), angle.sin()],
            axial_rigidity: 5.0,
            shear_rigidity: 3.0 * shear_sign,
        }
    }

    fn beam(angle: f64, shear_sign: f64) -> BondElement {
        BondElement::Beam(Pair {
            ends: [0, 1],
            bond: BeamBond {
                springs: springs(angle, shear_sign),
                rotational_rigidity: 0.2 * shear_sign,
            },
        })
    }

    fn spring(angle: f64, shear_sign: f64) -> BondElement {
        BondElement::Spring(Pair {
            ends: [0, 1],
            bond: springs(angle, shear_sign),
        })
    }

    fn deformation(bond: &BondElement, u: &Vector6<f64>) -> BondDeformation {
        bond.deformation(u.as_slice())
    }

    /// The stiffness by its terms, shape (6, 6).
    fn stiffness(bond: &BondElement) -> Matrix6<f64> {
        let terms = bond.terms().into_iter();
        terms.fold(Matrix6::zeros(), |sum, (rigidity, entries)| {
            let mut gradient = Vector6::zeros();
            for (dof, value) in entries {
                gradient[dof] = value;
            }
            sum + rigidity * gradient * gradient.transpose()
        })
    }

    /// Some unknowns of both ends.
    fn unknowns() -> Vector6<f64> {
        Vector6::new(0.3, -0.1, 0.2, 0.5, 0.4, -0.3)
    }

    /// A rigid motion moves a point by translation + rotation x position, and turns it by the rotation.
    fn rigid_motion(angle: f64, translation: [f64; 2], rotation: f64) -> Vector6<f64> {
        let at = |p: [f64; 2]| {
            [
                translation[0] - rotation * p[1],
                translation[1] + rotation * p[0],
                rotation,
            ]
        };
        let b = [2.0 + LENGTH * angle.cos(), -1.0 + LENGTH * angle.sin()];
        let both = [at([2.0, -1.0]), at(b)];
        Vector6::from_iterator(both.into_iter().flatten())
    }

    const TRANSLATIONS: [[f64; 2]; 2] = [[1.0, 0.0], [0.0, 1.0]];

    /// What a motion costs, relative to the rigidities: round-off of entries of size 50 bounds a zero at 1e-12.
    fn force(bond: &BondElement, u: &Vector6<f64>) -> f64 {
        (stiffness(bond) * u).norm()
    }

    /// A beam has exactly three zero-energy modes, all rigid motions.
    #[test]
    fn rigid_motions_cost_a_beam_nothing() {
        for shear_sign in [1.0, -1.0] {
            let bond = beam(0.6, shear_sign);
            let eigenvalues = stiffness(&bond).symmetric_eigenvalues();
            assert_eq!(eigenvalues.iter().filter(|it| it.abs() < 1e-12).count(), 3);
            for (translation, rotation) in TRANSLATIONS
                .map(|t| (t, 0.0))
                .into_iter()
                .chain([([0.3, -0.2], 1.0)])
            {
                assert!(force(&bond, &rigid_motion(0.6, translation, rotation)) < 1e-12);
            }
        }
    }

    /// A spring bond has two rigidities on four displacements: translations cost nothing, a rotation shears it, unless it has
    /// no shear rigidity; rotations of its ends do nothing.
    #[test]
    fn a_rotation_shears_a_spring() {
        let bond = spring(0.6, 1.0);
        for translation in TRANSLATIONS {
            assert!(force(&bond, &rigid_motion(0.6, translation, 0.0)) < 1e-12);
        }
        let rotation = rigid_motion(0.6, [0.3, -0.2], 1.0);
        assert!((deformation(&bond, &rotation).shear - 1.0).abs() < 1e-14);
        assert!(force(&spring(0.6, 0.0), &rotation) < 1e-12);
        let turned_ends = Vector6::new(0.0, 0.0, 0.7, 0.0, 0.0, -0.4);
        assert_eq!(deformation(&bond, &turned_ends), BondDeformation::default());
    }

    /// force = d energy / du and stiffness = d force / du by central differences; both are exact for a quadratic
    /// energy, so that only round-off (1e-16 / 1e-4 steps) remains.
    #[test]
    fn forces_and_stiffness_are_derivatives() {
        for bond in [beam(2.1, 1.0), spring(2.1, 1.0)] {
            let u = unknowns();
            let force = |u: &Vector6<f64>| {
                let ends = bond.end_forces(&deformation(&bond, u)).unwrap();
                Vector6::from_iterator(ends.into_iter().flatten())
            };
            let energy = |u: &Vector6<f64>| bond.energy(&deformation(&bond, u));
            let step = 1e-4;
            for i in 0..6 {
                let [mut forward, mut backward] = [u, u];
                forward[i] += step;
                backward[i] -= step;
                let slope = (energy(&forward) - energy(&backward)) / (2.0 * step);
                assert!((slope - force(&u)[i]).abs() < 1e-10, "force {i}");
                let column = (force(&forward) - force(&backward)) / (2.0 * step);
                assert!(
                    (column - stiffness(&bond).column(i)).norm() < 1e-9,
                    "column {i}"
                );
            }
            assert!(force(&u).norm() > 0.1, "the test must see forces");
        }
    }

    /// Turning the bond and its unknowns together leaves the energy as it is.
    #[test]
    fn energy_does_not_depend_on_the_orientation() {
        for element in [beam, spring] {
            let u = unknowns();
            let energy = |angle: f64, u: &Vector6<f64>| {
                let bond = element(angle, 1.0);
                bond.energy(&deformation(&bond, u))
            };
            let reference = energy(0.4, &u);
            for turn in [0.3, 1.2, 2.9, -2.0] {
                let (sin, cos) = f64::sin_cos(turn);
                let mut turned = u;
                for end in [0, UNKNOWNS] {
                    turned[end] = cos * u[end] - sin * u[end + 1];
                    turned[end + 1] = sin * u[end] + cos * u[end + 1];
                }
                assert!((energy(0.4 + turn, &turned) / reference - 1.0).abs() < 1e-13);
            }
        }
    }
}
