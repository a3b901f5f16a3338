//! Elements: the kinematics of bonds.
//!
//! | element | a point has | couples | deformation of a bond | laws |
//! |---|---|---|---|---|
//! | [`pair`]: beam | displacements and rotations | its two ends | stretch, shear less the mean rotation, relative rotation | micropolar ones |
//! | [`pair`]: spring | displacements | its two ends | stretch, shear | `bbpd`, `pds` |
//! | [`imaginary`] | two displacements | up to six points of a lattice | the strains of a small rectangle around it | `mbb-pd` |
//! | [`true_strain`] | the same | the same | the same, over distances after the deformation | `mbb-pd` |
//! | [`pairwise`] | the same | the same, with forces on two ends | the same as the first | `mbb-pd` as printed |
//!
//! The beam and spring elements exist in the plane and in space, where shear and relative rotation are vectors, the others in the plane.
//!
//! A law gives the rigidities, independently of the kinematics; an element gives the kinematics, independently of the law. Elements have the
//! number M of components of the motion of a point as a type parameter; arrays over degrees of freedom have M entries a point.

pub mod bond_deformation;
pub mod imaginary;
pub mod pair;
pub mod pairwise;
pub mod strain_stiffness;
pub mod true_strain;

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::bonds::{BondSet, Incidence};
use crate::communicator::Wire;
use crate::deformation::Deformation;
use crate::ghosts::Ghosts;
use crate::layout::Layout;
use crate::subdomain::Subdomain;
use crate::tensor::SymTensor;

pub use bond_deformation::BondDeformation;
use strain_stiffness::StrainStiffness;

/// Kinematics of the bonds of a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ElementKind {
    /// Bonds between points with rotations: [`pair`].
    Beam,
    /// Bonds between points without rotations: [`pair`].
    Spring,
    /// Bonds without rotations that couple points beside their ends: [`imaginary`].
    Imaginary,
    /// Imaginary elements with true strains: [`true_strain`].
    TrueStrain,
    /// Imaginary elements with forces on the two ends alone: [`pairwise`].
    Pairwise,
}

impl ElementKind {
    /// Whether the element has strains of its own, of a rectangle around the bond.
    pub fn has_strains(self) -> bool {
        match self {
            Self::Beam | Self::Spring => false,
            Self::Imaginary | Self::TrueStrain | Self::Pairwise => true,
        }
    }

    /// Whether forces are linear in the displacements.
    pub fn is_linear(self) -> bool {
        self != Self::TrueStrain
    }

    /// Whether forces derive from an energy, so that the stiffness is symmetric.
    pub fn has_energy(self) -> bool {
        self != Self::Pairwise
    }

    /// Whether a rotation of the whole body costs no energy, although bonds resist shear: without rotations of the points it is a shear of
    /// bonds of two points.
    pub(crate) fn rotates_freely(self) -> bool {
        self != Self::Spring
    }

    /// Names of the strains of a [`BondDeformation`] in results, in their order.
    pub const fn strain_names(self) -> &'static [&'static str] {
        match self {
            Self::Beam | Self::Spring => &["stretch", "shear", "rotation"],
            Self::Imaginary | Self::TrueStrain | Self::Pairwise => {
                &["strain_xx", "strain_xy", "strain_yy"]
            }
        }
    }
}

/// Rigidities of all bonds: stiffness densities times the volumes and lengths that the bonds represent.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Rigidities {
    /// Omega alpha V_A V_B k_n l, shape (n_bonds), J.
    pub axial: Vec<f64>,
    /// Omega alpha V_A V_B k_t l, shape (n_bonds), J.
    pub shear: Vec<f64>,
    /// Omega alpha V_A V_B k_theta, shape (n_bonds), J.
    pub rotational: Vec<f64>,
    /// Stiffness over the strains of imaginary elements, shape (n_bonds), J; empty for other elements.
    pub strain: Vec<StrainStiffness>,
}

impl Rigidities {
    /// Axial and shear rigidities of all bonds, J.
    pub fn spring_rigidities(&self) -> impl Iterator<Item = &f64> {
        self.axial.iter().chain(&self.shear)
    }

    /// Whether every bond resists stretch and shear, so that the stiffness is definite; collective.
    pub fn all_positive(&self, subdomain: &Subdomain) -> bool {
        !subdomain.any(!self.spring_rigidities().all(|&rigidity| rigidity > 0.0))
    }

    /// Whether some bond has a negative stiffness, so that the stiffness of the body may be indefinite; collective.
    pub fn some_negative(&self, subdomain: &Subdomain) -> bool {
        let is_negative = if self.strain.is_empty() {
            self.spring_rigidities().any(|&rigidity| rigidity < 0.0)
        } else {
            !self.strain.iter().all(StrainStiffness::is_positive)
        };
        subdomain.any(is_negative)
    }

    /// Whether some bond has a negative shear stiffness; collective.
    pub fn some_negative_shear(&self, subdomain: &Subdomain) -> bool {
        subdomain.any(self.shear.iter().any(|&rigidity| rigidity < 0.0))
    }

    /// Fraction of the energy of a bond that belongs to its first or its second end: mostly a half.
    pub fn share(&self, bond: u32, is_first: bool) -> f64 {
        let of_strain = self.strain.get(bond as usize);
        of_strain.map_or(0.5, |it| it.share(is_first))
    }

    /// Whether a bond resists rotations of its ends, if these have rotations.
    pub(crate) fn resist_rotations(&self, bond: usize) -> bool {
        self.shear[bond] != 0.0 || self.rotational[bond] != 0.0
    }

    /// Degrees of freedom that bonds may resist: all displacements, and rotations where a bond resists them, shape (n_degrees_of_freedom);
    /// collective.
    pub fn resisted(&self, ends: &[[u32; 2]], layout: Layout, subdomain: &Subdomain) -> Vec<bool> {
        let all = 0..layout.n_degrees_of_freedom();
        let mut resisted: Vec<bool> = all
            .map(|dof| !layout.component(dof).is_rotation())
            .collect();
        let resisting = (0..)
            .zip(ends)
            .filter(|(bond, _)| self.resist_rotations(*bond));
        for end in resisting.flat_map(|(_, ends)| ends) {
            resisted[layout.range(*end)].fill(true);
        }
        if subdomain.is_whole() {
            return resisted;
        }
        // Only the owner of a point has all of its bonds.
        let mut marks: Vec<f64> = (resisted.iter().map(|&it| f64::from(u8::from(it)))).collect();
        Ghosts::all(subdomain).update(&mut marks, layout.components.len());
        marks.into_iter().map(|it| it > 0.0).collect()
    }
}

/// Remaining stiffness of a bond: factors of its rigidities.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct StiffnessFactors {
    /// Factor of the axial rigidity.
    pub axial: f64,
    /// Factor of the shear rigidity.
    pub shear: f64,
    /// Factor of the rotational rigidity.
    pub rotational: f64,
}

impl Wire<3> for StiffnessFactors {
    fn numbers(&self) -> [f64; 3] {
        [self.axial, self.shear, self.rotational]
    }

    fn from_numbers([axial, shear, rotational]: [f64; 3]) -> Self {
        Self {
            axial,
            shear,
            rotational,
        }
    }
}

impl StiffnessFactors {
    /// Whole stiffness: factors 1.
    pub const WHOLE: Self = Self {
        axial: 1.0,
        shear: 1.0,
        rotational: 1.0,
    };

    /// No stiffness: factors 0.
    pub const NOTHING: Self = Self {
        axial: 0.0,
        shear: 0.0,
        rotational: 0.0,
    };

    /// Whether a factor differs from its value in `other` by more than a relative tolerance.
    #[inline]
    pub fn differs_from(&self, other: &Self, tolerance: f64) -> bool {
        let differs = |one: f64, other: f64| (one - other).abs() > tolerance * one.max(other);
        differs(self.axial, other.axial)
            || differs(self.shear, other.shear)
            || differs(self.rotational, other.rotational)
    }

    /// Decrease of the factors from this state to `later`.
    pub fn lost(&self, later: &Self) -> Self {
        Self {
            axial: self.axial - later.axial,
            shear: self.shear - later.shear,
            rotational: self.rotational - later.rotational,
        }
    }
}

/// Element of a bond in D dimensions, between points with M components of motion: its kinematics with its rigidities. Loops over all bonds
/// have the element as a type parameter, so that it is resolved once, not bond by bond.
pub trait Element<const D: usize, const M: usize>:
    Copy + PartialEq + std::fmt::Debug + Send + Sync + 'static
{
    /// Deformation of the bond.
    type Deformation: Deformation;

    /// Data shared by the elements of a body: the lattice of imaginary elements, nothing for pairs.
    type Lattice: std::fmt::Debug + Send + Sync + 'static;

    /// The element of a bond with its whole stiffness, while the bonds marked in `intact` (n_bonds) are unbroken.
    fn new(
        lattice: &Self::Lattice,
        bonds: &BondSet<D>,
        rigidities: &Rigidities,
        intact: &[bool],
        bond: usize,
    ) -> Self;

    /// Bonds whose elements couple each point, and the other points that these elements couple; `None` where bonds couple their ends alone.
    fn couplings(_lattice: &Self::Lattice) -> Option<[&Arc<Incidence>; 2]> {
        None
    }

    /// Bonds whose elements may change when some bonds break, these left out, ascending.
    fn dependent_bonds(_lattice: &Self::Lattice, _bonds: &[u32]) -> Vec<u32> {
        Vec::new()
    }

    /// The element with its rigidities times the remaining factors.
    fn weakened(self, remaining: &StiffnessFactors) -> Self;

    /// Deformation for the motions of all points, shape (M n_points), m and rad.
    fn deformation(&self, motions: &[f64]) -> Self::Deformation;

    /// Deformation in a uniform strain without rotations.
    fn deformation_in(&self, strain: &SymTensor<D>) -> Self::Deformation;

    /// Energy 1/2 u^T K u', J, for two deformations of the same bond.
    fn mutual_energy(&self, one: &Self::Deformation, other: &Self::Deformation) -> f64;

    /// Adds the internal forces and moments K u on the coupled points, N and N m.
    fn forces(&self, deformation: &Self::Deformation, add: impl FnMut(u32, [f64; M]));

    /// Internal forces at the ends A and B of a bond of two points, N and N m; `None` for an element that couples other points.
    fn end_forces(&self, _deformation: &Self::Deformation) -> Option<[[f64; M]; 2]> {
        None
    }

    /// Sum over the points of internal force (x) position, its symmetric part, J.
    fn dyad(&self, deformation: &Self::Deformation) -> SymTensor<D>;

    /// Terms of K as a sum of rigidity g g^T; the rows g are given by degree of freedom.
    fn terms(&self) -> Vec<Term>;

    /// Adds the blocks of K in the columns of a coupled point, at the rows of the coupled points up to this one.
    fn upper_blocks(&self, point: u32, add: impl FnMut(u32, Block<M>));

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

/// Block of a stiffness between two points: rows of the first, columns of the second.
pub type Block<const M: usize> = [[f64; M]; M];

/// A term rigidity g g^T of an element stiffness: the rigidity, J, and the entries of g by degree of freedom.
pub type Term = (f64, Vec<(usize, f64)>);

#[cfg(test)]
mod tests;
