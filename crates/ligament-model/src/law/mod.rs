//! Bond laws: from materials and bond horizons to the stiffness densities of the bonds.
//!
//! | law | densities | element |
//! |---|---|---|
//! | [`bbpd`] | k_n | spring |
//! | [`bbpd_conical`] | k_n that falls with the length | spring |
//! | [`pds`] | k_n, constant k_t | spring |
//! | [`mppd`] | those of [`pds`] and k_theta | beam |
//! | [`beam`] | k_n, k_t = 12 d/l^2, k_theta = d/l: MPPD's beam form, and NHPD's law | beam |
//! | [`orthotropic`] | k_n and k_t that depend on the direction, k_theta | beam |
//! | [`mbb_pd`] | a matrix over the strains of a small rectangle | imaginary |
//!
//! They come from integrals over a full circle; [`calibration`] puts sums over the families of the points in their place.

pub mod bbpd;
pub mod bbpd_conical;
pub mod beam;
pub mod calibration;
mod materials;
pub mod mbb_pd;
pub mod mppd;
pub mod orthotropic;
pub mod pds;
pub mod rotational;

use nalgebra::Matrix3;
use rayon::prelude::*;

use crate::bonds::BondSet;
use crate::bonds::retained::retained;
use crate::cloud::PointCloud;
use crate::element::imaginary::StrainStiffness;

/// Below this |1 - 3 nu| (or |1 - 4 nu| in plane strain) the shear stiffness counts as exactly zero, and with it the
/// rotational one: what rounding leaves of it would only make the system nearly singular.
pub(crate) const CENTRAL_FORCE_TOLERANCE: f64 = 1e-9;

/// Stiffness densities of the bonds.
#[derive(Debug, Clone, PartialEq)]
pub struct BondStiffness {
    /// Axial k_n, shape (n_bonds), N/m^6.
    pub axial: Vec<f64>,
    /// Shear k_t, shape (n_bonds), N/m^6; negative above the central-force Poisson's ratio.
    pub shear: Vec<f64>,
    /// Rotational k_theta, shape (n_bonds), N/m^5; of the sign of k_t.
    pub rotational: Vec<f64>,
    /// The micro-modulus matrix over (xx, yy, xy) of imaginary elements, shape (n_bonds), N/m^6; empty for the others.
    pub strain: Vec<StrainStiffness>,
    /// Factors of bonds across an interface ([`BondStiffness::in_series`]), shape (n_bonds); empty where there is none.
    pub series: Vec<f64>,
}

/// Densities of one bond.
pub(crate) struct Densities {
    pub(crate) axial: f64,
    pub(crate) shear: f64,
    pub(crate) rotational: f64,
}

/// Geometry of a bond as a law needs it.
pub(crate) struct BondGeometry<const D: usize = 2> {
    /// Length l, m.
    pub(crate) length: f64,
    /// Bond horizon H, m.
    pub(crate) horizon: f64,
    /// Direction cosines from A to B.
    pub(crate) direction: [f64; D],
}

impl BondStiffness {
    /// Densities from `constants` of the materials (n_materials), the first of which tells how stiff they are: a bond has those of
    /// its materials ([`materials::of_bond`]).
    pub(crate) fn from_constants<const D: usize, const N: usize>(
        bonds: &BondSet<D>,
        cloud: &PointCloud<D>,
        constants: &[[f64; N]],
        densities: impl Fn(&[f64; N], &BondGeometry<D>) -> Densities + Sync,
    ) -> Self {
        let axial_constants: Vec<f64> = constants.iter().map(|it| it[0]).collect();
        let of_ends = |ends| {
            materials::of_bond(cloud, ends, &axial_constants).fold(
                [0.0; N],
                |mut sum, (material, share)| {
                    for (value, constant) in sum.iter_mut().zip(&constants[material]) {
                        *value += share * constant;
                    }
                    sum
                },
            )
        };
        let geometry = |bond: usize| BondGeometry {
            length: bonds.length[bond],
            horizon: bonds.horizon[bond],
            direction: bonds.direction[bond],
        };
        let mut series = materials::series_factors(bonds, cloud, &axial_constants);
        let [mut axial, mut shear, mut rotational] = [(); 3].map(|()| vec![0.0; bonds.len()]);
        (&bonds.ends, &mut axial, &mut shear, &mut rotational)
            .into_par_iter()
            .enumerate()
            .for_each(|(bond, (&ends, axial, shear, rotational))| {
                let of_bond = densities(&of_ends(ends), &geometry(bond));
                (*axial, *shear, *rotational) = (of_bond.axial, of_bond.shear, of_bond.rotational);
            });
        for (bond, shares) in bonds.composition.numbered() {
            let of_material = |constants: &[f64; N]| densities(constants, &geometry(bond));
            let axial_of = constants
                .iter()
                .map(|it| of_material(it).axial)
                .collect::<Vec<_>>();
            let (softest, factor) = materials::softest(shares, [&axial_of, &axial_constants]);
            let of_bond = of_material(&constants[softest]);
            (axial[bond], shear[bond], rotational[bond]) =
                (of_bond.axial, of_bond.shear, of_bond.rotational);
            series[bond] = factor;
        }
        Self {
            axial,
            shear,
            rotational,
            strain: Vec::new(),
            series: some_other_than_one(series),
        }
    }

    /// The densities with those of bonds across an interface as two halves in series.
    ///
    /// Corrections take such bonds for bonds of the softer material. A uniform strain then leaves that material as it is without the
    /// stiffer one, as in a body whose parts pull each other along; and where both are strained as their stiffnesses say, so that the
    /// tractions agree, a bond that is half in each has the force of one that is all in the softer.
    pub fn in_series(mut self) -> Self {
        for densities in [&mut self.axial, &mut self.shear, &mut self.rotational] {
            for (density, factor) in densities.iter_mut().zip(&self.series) {
                *density *= factor;
            }
        }
        self
    }

    /// The densities with shear and rotation times some factors (n_bonds); as they are without any.
    pub fn with_shear(mut self, factors: &[f64]) -> Self {
        let of_bonds = self.shear.iter_mut().zip(&mut self.rotational);
        for ((shear, rotational), factor) in of_bonds.zip(factors) {
            (*shear, *rotational) = (*shear * factor, *rotational * factor);
        }
        self
    }

    /// The bonds for which `keep` (n_bonds) is true.
    pub fn retained(self, keep: &[bool]) -> Self {
        Self {
            axial: retained(self.axial, keep),
            shear: retained(self.shear, keep),
            rotational: retained(self.rotational, keep),
            strain: some_retained(self.strain, keep),
            series: some_retained(self.series, keep),
        }
    }
}

/// Factors; none where all are 1.
fn some_other_than_one(factors: Vec<f64>) -> Vec<f64> {
    match factors.iter().all(|&factor| factor == 1.0) {
        true => Vec::new(),
        false => factors,
    }
}

/// The values of the bonds for which `keep` (n_bonds) is true; none where there are none.
fn some_retained<T>(values: Vec<T>, keep: &[bool]) -> Vec<T> {
    if values.is_empty() {
        values
    } else {
        retained(values, keep)
    }
}

/// C_11 + C_22 + 2 C_12 of a plane, Pa, which does not depend on the axes and is what the laws' axial constants are in proportion to: the
/// softer of two materials has the smaller one.
pub(crate) fn bulk_stiffness(plane: &Matrix3<f64>) -> f64 {
    plane[(0, 0)] + plane[(1, 1)] + 2.0 * plane[(0, 1)]
}
