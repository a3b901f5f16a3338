//! Elastic constants of the plane.

use nalgebra::{DMatrix, Matrix3, Vector3};

use super::anisotropic::Anisotropic;
use crate::tensor::SymTensor;

/// Stiffness C in the plane or in space, Pa: the stresses are C times the engineering strains (eps_ii, gamma_ij), both in the order of
/// [`SymTensor`]; shape (3, 3) or (6, 6).
pub type Stiffness = DMatrix<f64>;

/// Stress C : eps of a strain, Pa.
pub(crate) fn stress<const D: usize>(stiffness: &Stiffness, strain: &SymTensor<D>) -> SymTensor<D> {
    let strains: Vec<f64> = strain.engineering().collect();
    let rows = 0..strains.len();
    let components: Vec<f64> = rows
        .map(|it| stress_component(stiffness, &strains, it))
        .collect();
    SymTensor::from_components(&components)
}

/// Adds the stiffness kappa tr(eps) of a modulus (Pa) against changes of volume.
pub(crate) fn add_volumetric<const D: usize>(stiffness: &mut Stiffness, modulus: f64) {
    let places = SymTensor::<D>::COMPONENTS.iter().enumerate();
    let normal = places.filter(|(_, [i, j])| i == j).map(|(place, _)| place);
    for row in normal.clone() {
        for column in normal.clone() {
            stiffness[(row, column)] += modulus;
        }
    }
}

/// A component of the stress of engineering strains, Pa: a row of the stiffness times them.
pub(crate) fn stress_component(stiffness: &Stiffness, strains: &[f64], row: usize) -> f64 {
    let terms = strains.iter().enumerate();
    terms
        .map(|(column, strain)| stiffness[(row, column)] * strain)
        .sum()
}

crate::case_type! {
    /// State of the plane.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
    pub enum Plane {
        /// No stress out of the plane: thin bodies.
        #[default]
        Stress,
        /// No strain out of the plane: long bodies.
        Strain,
    }
}

/// The space in which a body deforms.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Space {
    /// A plane.
    Plane(Plane),
    /// Three dimensions.
    Solid,
}

impl Space {
    /// State of the plane of the body; sections of a solid are in plane strain.
    pub fn plane(self) -> Plane {
        match self {
            Self::Plane(plane) => plane,
            Self::Solid => Plane::Strain,
        }
    }
}

impl From<Isotropic> for Elasticity {
    fn from(constants: Isotropic) -> Self {
        Self::Isotropic(constants)
    }
}

impl From<Plane> for Space {
    fn from(plane: Plane) -> Self {
        Self::Plane(plane)
    }
}

/// Elastic constants.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Elasticity {
    /// Constants that are the same in all directions.
    Isotropic(Isotropic),
    /// Constants of a material with three planes of symmetry, one of them the plane of the body.
    Orthotropic(Orthotropic),
    /// Constants of a material without symmetry in the plane.
    Anisotropic(Anisotropic),
}

crate::case_type! {
    /// Constants of an isotropic material.
    #[derive(Debug, Clone, Copy, PartialEq)]
    pub struct Isotropic {
        /// Young's modulus, Pa.
        #[range("exclusiveMinimum" = 0)]
        pub young: f64,
        /// Poisson's ratio.
        #[range("exclusiveMinimum" = -1, "exclusiveMaximum" = 0.5)]
        pub poisson: f64,
    }
}

/// Constants of an orthotropic material in its axes 1 and 2.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Orthotropic {
    /// Young's moduli E_1, E_2, Pa.
    pub young: [f64; 2],
    /// Poisson's ratio nu_12: contraction along 2 under stress along 1.
    pub poisson: f64,
    /// Shear modulus G_12, Pa.
    pub shear_modulus: f64,
    /// Constants across the plane, which plane strain requires.
    pub out_of_plane: Option<OutOfPlane>,
    /// Angle zeta from the x axis to the axis 1, rad.
    pub angle: f64,
}

/// Constants of an orthotropic material across the plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OutOfPlane {
    /// Young's modulus E_3, Pa.
    pub young: f64,
    /// Poisson's ratios nu_13 and nu_23.
    pub poisson: [f64; 2],
}

impl Elasticity {
    /// Stiffness C of the plane in x and y: (sigma_xx, sigma_yy, sigma_xy) = C (eps_xx, eps_yy, gamma_xy), shape (3, 3), Pa.
    pub fn plane_stiffness(&self, plane: Plane) -> Matrix3<f64> {
        match self {
            Self::Isotropic(material) => material.plane_stiffness(plane),
            Self::Orthotropic(material) => material.plane_stiffness(plane),
            Self::Anisotropic(material) => material.stiffness,
        }
    }

    /// Stiffness in a state of the plane, or for D = 3 in space; `None` in space for a material that is given in the plane only.
    pub fn stiffness<const D: usize>(&self, plane: Plane) -> Option<Stiffness> {
        if D == 2 {
            let stiffness = self.plane_stiffness(plane);
            return Some(Stiffness::from_column_slice(3, 3, stiffness.as_slice()));
        }
        let Isotropic { young, poisson } = self.isotropic()?;
        let shear = 0.5 * young / (1.0 + poisson);
        let bulk = 2.0 * shear * poisson / (1.0 - 2.0 * poisson);
        let places = SymTensor::<D>::COMPONENTS;
        let of_places = |row: usize, column: usize| {
            let ([i, j], [k, l]) = (places[row], places[column]);
            let is_volume = i == j && k == l;
            let coupling = if is_volume { bulk } else { 0.0 };
            let size = if i == j { 2.0 } else { 1.0 };
            coupling + if row == column { size * shear } else { 0.0 }
        };
        Some(Stiffness::from_fn(places.len(), places.len(), of_places))
    }

    /// Stiffness in a space; `None` in three dimensions for a material that is given in the plane only.
    pub fn stiffness_in(&self, space: Space) -> Option<Stiffness> {
        match space {
            Space::Plane(plane) => self.stiffness::<2>(plane),
            Space::Solid => self.stiffness::<3>(space.plane()),
        }
    }

    /// Isotropic constants; `None` for other materials.
    pub fn isotropic(&self) -> Option<Isotropic> {
        match *self {
            Self::Isotropic(constants) => Some(constants),
            Self::Orthotropic(_) | Self::Anisotropic(_) => None,
        }
    }
}

impl Isotropic {
    /// Plane stiffness: E/(1 - nu^2) [1, nu; nu, 1] and G in plane stress; in plane strain with E/(1 - nu^2) and nu/(1 - nu) instead of E
    /// and nu.
    pub fn plane_stiffness(&self, plane: Plane) -> Matrix3<f64> {
        let (young, poisson) = (self.young, self.poisson);
        let shear = young / (2.0 * (1.0 + poisson));
        let (normal, coupling) = match plane {
            Plane::Stress => {
                let reduced = young / (1.0 - poisson * poisson);
                (reduced, poisson * reduced)
            }
            Plane::Strain => {
                let reduced = young / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
                ((1.0 - poisson) * reduced, poisson * reduced)
            }
        };
        Matrix3::new(
            normal, coupling, 0.0, coupling, normal, 0.0, 0.0, 0.0, shear,
        )
    }

    /// Effective constants for the equations of plane stress: E and nu, or E/(1 - nu^2) and nu/(1 - nu) in plane strain.
    pub fn in_plane(&self, plane: Plane) -> Self {
        match plane {
            Plane::Stress => *self,
            Plane::Strain => Self {
                young: self.young / (1.0 - self.poisson * self.poisson),
                poisson: self.poisson / (1.0 - self.poisson),
            },
        }
    }

    /// Young's modulus and Poisson's ratio of a bar in a space: the constants of the material, or in a plane [`in_plane`](Self::in_plane).
    pub fn bar_constants(&self, space: impl Into<Space>) -> Self {
        match space.into() {
            Space::Plane(plane) => self.in_plane(plane),
            Space::Solid => *self,
        }
    }

    /// Poisson's ratio at which the shear stiffness of the bonds vanishes: 1/3 in plane stress, 1/4 in plane strain and in space.
    pub fn central_force_poisson(space: impl Into<Space>) -> f64 {
        match space.into() {
            Space::Plane(Plane::Stress) => 1.0 / 3.0,
            Space::Plane(Plane::Strain) | Space::Solid => 0.25,
        }
    }

    /// The material with its Young's modulus and the Poisson's ratio of central forces, 1/3 or 1/4.
    pub fn with_central_forces(&self, space: impl Into<Space>) -> Self {
        Self {
            young: self.young,
            poisson: Self::central_force_poisson(space),
        }
    }

    /// Bulk modulus K = E/(3 (1 - 2 nu)), Pa.
    pub fn bulk_modulus(&self) -> f64 {
        self.young / (3.0 * (1.0 - 2.0 * self.poisson))
    }
}

impl Orthotropic {
    /// Stiffness of the plane in the axes 1 and 2 (OMPPD eq. 25): the inverse of the compliance S in plane stress, and of S_ij - S_i3
    /// S_j3/S_33 in plane strain.
    ///
    /// # Panics
    ///
    /// Panics if the material is not stable ([`Orthotropic::is_stable`]), or lacks constants that plane strain requires.
    pub fn principal_stiffness(&self, plane: Plane) -> Matrix3<f64> {
        let mut compliance = self.principal_compliance();
        if plane == Plane::Strain {
            let across = self
                .out_of_plane
                .expect("plane strain needs the constants across the plane");
            let coupling = self.coupling_across(&across);
            compliance -= across.young * coupling * coupling.transpose();
        }
        compliance
            .try_inverse()
            .expect("the compliance of a stable material has an inverse")
    }

    /// [`Orthotropic::principal_stiffness`] rotated by the angle zeta.
    pub fn plane_stiffness(&self, plane: Plane) -> Matrix3<f64> {
        let (s, c) = self.angle.sin_cos();
        // Strains in the axes 1 and 2 from those in x and y.
        let turn = Matrix3::new(
            c * c,
            s * s,
            c * s,
            s * s,
            c * c,
            -c * s,
            -2.0 * c * s,
            2.0 * c * s,
            c * c - s * s,
        );
        turn.transpose() * self.principal_stiffness(plane) * turn
    }

    /// Whether the stiffness of the plane can be computed: products of the constants may overflow.
    pub fn has_stiffness(&self) -> bool {
        let mut compliance = self.principal_compliance();
        let is_fine = |it: &Matrix3<f64>| {
            it.try_inverse()
                .is_some_and(|it| it.iter().all(|c| c.is_finite()))
        };
        let in_plane = is_fine(&compliance);
        let across = self.out_of_plane.is_none_or(|across| {
            let coupling = self.coupling_across(&across);
            compliance -= across.young * coupling * coupling.transpose();
            is_fine(&compliance)
        });
        in_plane && across
    }

    /// Whether every strain costs energy, that is, whether the compliance is positive definite.
    pub fn is_stable(&self) -> bool {
        let mut compliance = self.principal_compliance();
        let in_plane = compliance.cholesky().is_some();
        let across = self.out_of_plane.is_none_or(|across| {
            let coupling = self.coupling_across(&across);
            compliance -= across.young * coupling * coupling.transpose();
            across.young > 0.0 && compliance.cholesky().is_some()
        });
        in_plane && across
    }

    fn principal_compliance(&self) -> Matrix3<f64> {
        let [young_1, young_2] = self.young;
        let coupling = -self.poisson / young_1;
        Matrix3::new(
            1.0 / young_1,
            coupling,
            0.0,
            coupling,
            1.0 / young_2,
            0.0,
            0.0,
            0.0,
            1.0 / self.shear_modulus,
        )
    }

    /// Compliances S_13 and S_23, and zero.
    fn coupling_across(&self, across: &OutOfPlane) -> Vector3<f64> {
        let [one, two] = [0, 1].map(|axis| -across.poisson[axis] / self.young[axis]);
        Vector3::new(one, two, 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const YOUNG: f64 = 7.0;
    const POISSON: f64 = 0.3;
    const ISOTROPIC: Isotropic = Isotropic {
        young: YOUNG,
        poisson: POISSON,
    };

    /// An isotropic material written as an orthotropic one.
    fn as_orthotropic(angle: f64) -> Orthotropic {
        Orthotropic {
            young: [YOUNG; 2],
            poisson: POISSON,
            shear_modulus: YOUNG / (2.0 * (1.0 + POISSON)),
            out_of_plane: Some(OutOfPlane {
                young: YOUNG,
                poisson: [POISSON; 2],
            }),
            angle,
        }
    }

    /// NHPD eq. 11: energies E/(2 (1 - nu^2)) and E (1 - nu)/(2 (1 + nu)(1 - 2 nu)) of a uniaxial strain of size one.
    #[test]
    fn uniaxial_strain_energies_are_the_papers() {
        let energy = |plane| 0.5 * ISOTROPIC.plane_stiffness(plane)[(0, 0)];
        let stress = YOUNG / (2.0 * (1.0 - POISSON * POISSON));
        let strain = YOUNG * (1.0 - POISSON) / (2.0 * (1.0 + POISSON) * (1.0 - 2.0 * POISSON));
        assert!((energy(Plane::Stress) / stress - 1.0).abs() < 1e-14);
        assert!((energy(Plane::Strain) / strain - 1.0).abs() < 1e-14);
    }

    /// Isotropic constants in either form, at any angle, give one stiffness; rounding of 9 products bounds the difference.
    #[test]
    fn isotropy_is_a_case_of_orthotropy() {
        for plane in [Plane::Stress, Plane::Strain] {
            for angle in [0.0, 0.3, 1.1] {
                let difference =
                    as_orthotropic(angle).plane_stiffness(plane) - ISOTROPIC.plane_stiffness(plane);
                assert!(difference.norm() < 1e-13 * YOUNG, "{plane:?} {angle}");
            }
        }
    }

    /// OMPPD eqs 25, 29 and 30: C_11 = E_1/(1 - nu_12 nu_21) with nu_21 = nu_12 E_2/E_1, and C_xx and C_ss off the axes.
    #[test]
    fn off_axis_moduli_are_the_papers() {
        let lamina = Orthotropic {
            young: [15e9, 5e9],
            poisson: 0.25,
            shear_modulus: 4.8e9,
            out_of_plane: None,
            angle: 0.0,
        };
        let minor = 0.25 * 5.0 / 15.0;
        let c = lamina.principal_stiffness(Plane::Stress);
        let [c11, c12, c22, c66] = [15e9, minor * 15e9, 5e9, 4.8e9 * (1.0 - 0.25 * minor)]
            .map(|value| value / (1.0 - 0.25 * minor));
        for (found, expected) in [c[(0, 0)], c[(0, 1)], c[(1, 1)], c[(2, 2)]]
            .into_iter()
            .zip([c11, c12, c22, c66])
        {
            assert!((found / expected - 1.0).abs() < 1e-14);
        }
        let psi: f64 = 0.4;
        // Axes turned by psi: the material lies at -psi in them.
        let turned = Orthotropic {
            angle: -psi,
            ..lamina
        }
        .plane_stiffness(Plane::Stress);
        let (s2, c2) = (psi.sin().powi(2), psi.cos().powi(2));
        let c_xx = c11 * c2 * c2 + c22 * s2 * s2 + (2.0 * c12 + 4.0 * c66) * s2 * c2;
        let c_ss = (c11 + c22 - 2.0 * c12) * s2 * c2 + c66 * (c2 - s2).powi(2);
        assert!((turned[(0, 0)] / c_xx - 1.0).abs() < 1e-14);
        assert!((turned[(2, 2)] / c_ss - 1.0).abs() < 1e-14);
    }

    #[test]
    fn unstable_constants_are_told() {
        assert!(as_orthotropic(0.0).is_stable());
        let too_large = Orthotropic {
            poisson: 1.1,
            ..as_orthotropic(0.0)
        };
        assert!(!too_large.is_stable());
        let across = OutOfPlane {
            young: YOUNG,
            poisson: [0.7; 2],
        };
        assert!(
            !Orthotropic {
                out_of_plane: Some(across),
                ..as_orthotropic(0.0)
            }
            .is_stable()
        );
    }
}
