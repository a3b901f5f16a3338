//! Rotational stiffness of a bond with a shear stiffness. The energy of uniform strains is independent of it, so the continuum does not
//! determine it: the papers choose, and leave it free.
//!
//! A third state of deformation determines it (MPPD note 5), the micro-rotations theta = chi . x of a uniform curvature chi. Their energy is
//! gamma chi^2/2 in a Cosserat continuum, and a fourth of the sum of k_theta (chi . xi)^2 V over the bonds of a point.

use std::f64::consts::PI;

use super::{BondStiffness, Densities, bulk_stiffness};
use crate::bonds::BondSet;
use crate::case_type::Range;
use crate::cloud::PointCloud;
use crate::material::{Elasticity, Plane};

crate::case_type! {
    /// A choice of k_theta for a given k_t. The decaying one (OMPPD after eq. 57) lets short bonds resist bending most, and one as long as the
    /// horizon not at all; with a quarter the moment at an end does not depend on the rotation of the other; that of a beam is from Gerstle 2007
    /// (OMPPD eq. 22).
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
    pub enum RotationalStiffness {
        /// k_theta = k_t l (1 - l/H)/2.
        #[default]
        Decaying,
        /// k_theta = k_t l/4.
        Quarter,
        /// k_theta = k_t l/12.
        Beam,
        /// k_theta = 0.
        #[case(serde(rename = "none"))]
        Zero,
    }
}

/// Scale of k_theta, which every choice of the form leaves free.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RotationalScale {
    /// Factor of the k_theta of the law.
    Factor(f64),
    /// Characteristic length l_b in bending of a Cosserat continuum, m, whose modulus of curvature is gamma = 4 G l_b^2 (N).
    CosseratLength(f64),
}

impl RotationalScale {
    /// Range of a factor.
    pub const FACTOR: Range<'static> = Range::NOT_NEGATIVE;

    /// Range of a length.
    pub const LENGTH: Range<'static> = Range::POSITIVE;
}

/// Dependence of k_theta on the length of bonds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Profile {
    /// Choice of k_theta for a given k_t.
    pub rotational: RotationalStiffness,
    /// Whether k_t falls with the square of the length, as in the form of a beam.
    pub shear_falls: bool,
}

impl RotationalStiffness {
    /// k_theta (N/m^5) for the shear stiffness k_t (N/m^6) of a bond of length l (m) with the bond horizon H (m).
    pub fn density(self, shear: f64, length: f64, horizon: f64) -> f64 {
        match self {
            Self::Decaying => 0.5 * shear * length * (1.0 - length / horizon).max(0.0),
            Self::Quarter => 0.25 * shear * length,
            Self::Beam => shear * length / 12.0,
            Self::Zero => 0.0,
        }
    }
}

impl Profile {
    /// Profile q(l) (m), to which k_theta is proportional: its value for k_t = 1, or for k_t = H^2/l^2.
    fn value(self, length: f64, horizon: f64) -> f64 {
        let shear = if self.shear_falls {
            (horizon / length).powi(2)
        } else {
            1.0
        };
        self.rotational.density(shear, length, horizon)
    }

    /// Integral of q(l) l^3 over the horizon, divided by H^5.
    fn moment(self) -> f64 {
        match (self.rotational, self.shear_falls) {
            (RotationalStiffness::Decaying, false) => 1.0 / 60.0,
            (RotationalStiffness::Decaying, true) => 1.0 / 24.0,
            (RotationalStiffness::Quarter, false) => 1.0 / 20.0,
            (RotationalStiffness::Quarter, true) => 1.0 / 12.0,
            (RotationalStiffness::Beam, false) => 1.0 / 60.0,
            (RotationalStiffness::Beam, true) => 1.0 / 36.0,
            (RotationalStiffness::Zero, _) => 0.0,
        }
    }
}

/// Moduli of curvature gamma (n_materials, N) of Cosserat continua with the characteristic length l_b (m) in bending,
///
/// gamma = 4 G l_b^2,
///
/// with the shear modulus G in the axes of the material. A strip of height h and thickness t then has the bending stiffness
/// t (E h^3/12 + gamma h) (Gauthier and Jahsman 1975).
pub fn curvature_moduli(materials: &[Elasticity], plane: Plane, length: f64) -> Vec<f64> {
    let modulus = |material: &Elasticity| {
        let c = match material {
            Elasticity::Orthotropic(it) => it.principal_stiffness(plane),
            other => other.plane_stiffness(plane),
        };
        4.0 * c[(2, 2)] * length.powi(2)
    };
    materials.iter().map(modulus).collect()
}

/// Constants of each material for its k_theta by a characteristic length (m) in bending, shape (n_materials): the stiffness that determines
/// the softer of two (Pa), and the modulus of curvature gamma (N).
pub fn curvature_constants(materials: &[Elasticity], plane: Plane, length: f64) -> Vec<[f64; 2]> {
    let moduli = curvature_moduli(materials, plane, length).into_iter();
    let of_material = |(material, modulus): (&Elasticity, f64)| {
        [bulk_stiffness(&material.plane_stiffness(plane)), modulus]
    };
    materials.iter().zip(moduli).map(of_material).collect()
}

/// Densities with k_theta times a factor.
pub fn scaled(mut stiffness: BondStiffness, factor: f64) -> BondStiffness {
    stiffness.rotational.iter_mut().for_each(|it| *it *= factor);
    stiffness
}

/// Densities of bonds in the plane with k_theta proportional to a profile q(l), for materials with given [constants](curvature_constants), the second
/// being gamma:
///
/// k_theta = 2 gamma q(l) / (pi t M), M = integral of q l^3 over the horizon,
///
/// so that the micro-rotations of a uniform curvature chi cost the energy gamma chi^2/2. Bonds without shear stiffness get none: nothing
/// would couple the rotations of the points to their displacements.
pub fn with_cosserat_length<const D: usize>(
    stiffness: BondStiffness,
    bonds: &BondSet<D>,
    cloud: &PointCloud<D>,
    constants: &[[f64; 2]],
    profile: Profile,
) -> BondStiffness {
    let unit = 2.0 / (PI * cloud.thickness * profile.moment());
    let of_curvature =
        BondStiffness::from_constants(bonds, cloud, constants, |[_, modulus], bond| Densities {
            axial: 0.0,
            shear: 0.0,
            rotational: unit * modulus * profile.value(bond.length, bond.horizon)
                / bond.horizon.powi(5),
        });
    let rotational = stiffness.shear.iter().zip(of_curvature.rotational);
    let rotational = rotational.map(|(&shear, it)| if shear == 0.0 { 0.0 } else { it });
    BondStiffness {
        rotational: rotational.collect(),
        ..stiffness
    }
}

/// Scales k_theta of bonds in the plane so that the sums over the families, instead of the integral, give the micro-rotations of a uniform
/// curvature the energy of the `moduli` of the materials (n_materials, N), averaged over its directions, by the factors
///
/// q = 4 gamma / sum(alpha V_B k_theta l^2) at a point, and for a bond the mean of its ends.
pub fn calibrated<const D: usize>(
    mut stiffness: BondStiffness,
    length_factor: &[f64],
    bonds: &BondSet<D>,
    cloud: &PointCloud<D>,
    moduli: &[f64],
) -> BondStiffness {
    let rotational = &stiffness.rotational;
    let factors = cloud.over_families(|point| {
        let of_bond = |&bond: &u32| {
            let volume = cloud.volumes[bonds.neighbour(bond, point) as usize];
            let bond = bond as usize;
            length_factor[bond] * volume * rotational[bond] * bonds.length[bond].powi(2)
        };
        let sum: f64 = bonds.incidence.at(point).iter().map(of_bond).sum();
        if sum == 0.0 {
            [1.0]
        } else {
            [4.0 * cloud.mean_property(point as usize, moduli) / sum]
        }
    });
    for (rotational, ends) in stiffness.rotational.iter_mut().zip(&*bonds.ends) {
        let [[a], [b]] = ends.map(|end| factors[end as usize]);
        *rotational *= 0.5 * (a + b);
    }
    stiffness
}
