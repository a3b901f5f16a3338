//! Stiffness densities of the bonds of a body, and their changes by corrections and interfaces.

use nalgebra::Matrix3;

use super::materials;
use super::restraint::{Exchange, Restraint};
use crate::bonds::BondSet;
use crate::bonds::retained::retained;
use crate::cloud::PointCloud;
use crate::element::StiffnessFactors;
use crate::element::imaginary::StrainStiffness;
use crate::parallel::{self, CHUNK};

/// Value of |1 - 3 nu| (or |1 - 4 nu| in plane strain) below which the shear and rotational stiffnesses count as exactly zero: a stiffness
/// left by rounding would only make the system nearly singular.
pub(crate) const CENTRAL_FORCE_TOLERANCE: f64 = 1e-9;

/// Stiffness densities of the bonds.
#[derive(Debug, Clone, PartialEq)]
pub struct BondStiffness {
    /// Axial density k_n, shape (n_bonds), N/m^6.
    pub axial: Vec<f64>,
    /// Shear density k_t, shape (n_bonds), N/m^6; negative above the central-force Poisson's ratio.
    pub shear: Vec<f64>,
    /// Rotational density k_theta, shape (n_bonds), N/m^5; of the sign of k_t.
    pub rotational: Vec<f64>,
    /// Micro-modulus matrix over (xx, yy, xy) of imaginary elements, shape (n_bonds), N/m^6; empty for other elements.
    pub strain: Vec<StrainStiffness>,
    /// Factors of bonds across an interface ([`BondStiffness::in_series`]), shape (n_bonds); empty where there is none.
    pub series: Vec<f64>,
    /// Restraints of the rotations of the ends by stiffer materials, shape (n_bonds); empty where there is none.
    pub held: Vec<Restraint>,
    /// Exchanges of restrained bonds ([`BondStiffness::exchanged`]), shape (n_bonds); empty where there is none.
    pub exchange: Vec<Exchange>,
}

/// Densities of one bond.
pub(crate) struct Densities {
    pub(crate) axial: f64,
    pub(crate) shear: f64,
    pub(crate) rotational: f64,
}

/// Geometry of a bond in a law.
pub(crate) struct BondGeometry<const D: usize = 2> {
    /// Length l, m.
    pub(crate) length: f64,
    /// Bond horizon H, m.
    pub(crate) horizon: f64,
    /// Direction cosines from A to B.
    pub(crate) direction: [f64; D],
}

/// Axial, shear and rotational densities of the bonds by a function of their numbers, each of shape (n_bonds).
fn of_each_bond(n_bonds: usize, of_bond: impl Fn(usize) -> Densities + Sync) -> [Vec<f64>; 3] {
    let [mut axial, mut shear, mut rotational] = [(); 3].map(|()| vec![0.0; n_bonds]);
    let chunks = axial.chunks_mut(CHUNK).zip(shear.chunks_mut(CHUNK));
    let chunks = chunks.zip(rotational.chunks_mut(CHUNK)).enumerate();
    parallel::for_each(chunks, |(chunk, ((axial, shear), rotational))| {
        for place in 0..axial.len() {
            let it = of_bond(CHUNK * chunk + place);
            (axial[place], shear[place], rotational[place]) = (it.axial, it.shear, it.rotational);
        }
    });
    [axial, shear, rotational]
}

impl BondStiffness {
    /// Densities from `constants` of the materials (n_materials), the first of which is a measure of stiffness: a bond has the densities of
    /// its materials ([`materials::fractions_of_bond`]).
    pub(crate) fn from_constants<const D: usize, const N: usize>(
        bonds: &BondSet<D>,
        cloud: &PointCloud<D>,
        constants: &[[f64; N]],
        densities: impl Fn(&[f64; N], &BondGeometry<D>) -> Densities + Sync,
    ) -> Self {
        let axial_constants: Vec<f64> = constants.iter().map(|it| it[0]).collect();
        let of_ends = |ends| {
            if let [of_all] = constants {
                return *of_all;
            }
            materials::fractions_of_bond(cloud, ends, &axial_constants).fold(
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
        let [mut axial, mut shear, mut rotational] = of_each_bond(bonds.len(), |bond| {
            densities(&of_ends(bonds.ends[bond]), &geometry(bond))
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
        let held = materials::restraints(bonds, cloud, &shear, |material, bond| {
            densities(&constants[material], &geometry(bond)).shear
        });
        Self {
            axial,
            shear,
            rotational,
            strain: Vec::new(),
            series: some_other_than(1.0, series),
            held: some_other_than(Restraint::NONE, held),
            exchange: Vec::new(),
        }
    }

    /// The densities, with bonds across an interface as two halves in series.
    ///
    /// Corrections treat such bonds as bonds of the softer material. A uniform strain then leaves that material as it is without the stiffer
    /// one, as in a body whose parts pull each other along; and where the strains of both agree with equal tractions, a bond that is half in
    /// each has the force of one that is all in the softer.
    pub fn in_series(mut self) -> Self {
        for densities in [&mut self.axial, &mut self.shear, &mut self.rotational] {
            for (density, factor) in densities.iter_mut().zip(&self.series) {
                *density *= factor;
            }
        }
        self
    }

    /// The densities after the correction, of bonds [in series](Self::in_series) and with the [exchanges](Self::exchanged) of restrained
    /// bonds; and the part of each to which the correction does not apply, shape (n_bonds), empty in a body of one material. Where k_t is
    /// negative, k_n keeps at least half of its value.
    pub(crate) fn after_correction(mut self) -> (Self, Vec<StiffnessFactors>) {
        if self.series.is_empty() && self.exchange.is_empty() {
            return (self, Vec::new());
        }
        let corrected = (
            self.axial.clone(),
            self.shear.clone(),
            self.rotational.clone(),
        );
        for (bond, exchange) in self.exchange.iter().enumerate() {
            let gained = exchange.gained * self.shear[bond];
            self.shear[bond] *= 1.0 - exchange.lost;
            self.rotational[bond] *= 1.0 - exchange.lost;
            self.axial[bond] += gained.max(-0.5 * self.axial[bond]);
        }
        let joined = self.in_series();
        let part = |before: f64, after: f64| {
            if after == 0.0 {
                0.0
            } else {
                1.0 - before / after
            }
        };
        let (axial, shear, rotational) = &corrected;
        let beyond = (0..axial.len()).map(|bond| StiffnessFactors {
            axial: part(axial[bond], joined.axial[bond]),
            shear: part(shear[bond], joined.shear[bond]),
            rotational: part(rotational[bond], joined.rotational[bond]),
        });
        let beyond = beyond.collect();
        (joined, beyond)
    }

    /// The densities with shear and rotation times some factors (n_bonds); unchanged for empty factors.
    pub fn with_shear(mut self, factors: &[f64]) -> Self {
        let of_bonds = self.shear.iter_mut().zip(&mut self.rotational);
        for ((shear, rotational), factor) in of_bonds.zip(factors) {
            (*shear, *rotational) = (*shear * factor, *rotational * factor);
        }
        self
    }

    /// The densities of the bonds for which `keep` (n_bonds) is true.
    pub fn retained(self, keep: &[bool]) -> Self {
        Self {
            axial: retained(self.axial, keep),
            shear: retained(self.shear, keep),
            rotational: retained(self.rotational, keep),
            strain: some_retained(self.strain, keep),
            series: some_retained(self.series, keep),
            held: some_retained(self.held, keep),
            exchange: some_retained(self.exchange, keep),
        }
    }
}

/// The values, or an empty array if all equal a common value.
fn some_other_than<T: PartialEq>(common: T, values: Vec<T>) -> Vec<T> {
    match values.iter().all(|value| *value == common) {
        true => Vec::new(),
        false => values,
    }
}

/// The values of the bonds for which `keep` (n_bonds) is true; empty for empty values.
fn some_retained<T>(values: Vec<T>, keep: &[bool]) -> Vec<T> {
    if values.is_empty() {
        values
    } else {
        retained(values, keep)
    }
}

/// Sum C_11 + C_22 + 2 C_12 of a plane, Pa, which is independent of the axes and proportional to the axial constants of the laws: the softer
/// of two materials has the smaller one.
pub(crate) fn bulk_stiffness(plane: &Matrix3<f64>) -> f64 {
    plane[(0, 0)] + plane[(1, 1)] + 2.0 * plane[(0, 1)]
}
