//! Elastic constants of the discrete body, from the energy of the bonds of a point in a uniform strain.

use nalgebra::{Matrix3, Vector3};

use crate::element::ElementKind;
use crate::element::imaginary::matrix;
use crate::material::Stiffness;
use crate::system::BondSystem;
use crate::tensor::SymTensor;

/// Stiffness C of the family of a point in x and y, (sigma_xx, sigma_yy, sigma_xy) = C (eps_xx, eps_yy, gamma_xy), Pa:
///
/// C = 1/(2 V_A) sum over B of Omega alpha V_A V_B l (k_n s s^T + k_t g g^T)
///
/// with the stretch s and the shear g of a bond for strains of size one; with imaginary elements C = 1/V_A times the sum of the point's
/// fractions of D. The common rotation of the points, where they have one, is free and minimises the energy; it is zero for symmetric
/// families. In an infinite lattice this is the stiffness of the body.
pub fn family_stiffness(system: &BondSystem, point: u32) -> Matrix3<f64> {
    let rigidities = &system.rigidities;
    if system.element.has_strains() {
        let family = system.bonds.incidence.at(point).iter();
        let sum = family.fold(Matrix3::zeros(), |sum, &bond| {
            let stiffness = &rigidities.strain[bond as usize];
            let is_first = system.bonds.ends[bond as usize][0] == point;
            sum + stiffness.share(is_first) * matrix(stiffness.entries)
        });
        return sum / system.cloud.volumes[point as usize];
    }
    let mut stiffness = Matrix3::zeros();
    // Coupling with the shear of a common rotation of size one, which is -1 for every bond.
    let mut coupling = Vector3::zeros();
    let mut rotation = 0.0;
    for &bond in system.bonds.incidence.at(point) {
        let bond = bond as usize;
        let [a, b] = system.bonds.direction[bond];
        let stretch = Vector3::new(a * a, b * b, a * b);
        let shear = Vector3::new(-a * b, a * b, 0.5 * (a * a - b * b));
        let (axial_rigidity, shear_rigidity) = (rigidities.axial[bond], rigidities.shear[bond]);
        stiffness += axial_rigidity * stretch * stretch.transpose()
            + shear_rigidity * shear * shear.transpose();
        coupling -= shear_rigidity * shear;
        rotation += shear_rigidity;
    }
    if system.element == ElementKind::Beam && rotation != 0.0 {
        stiffness -= coupling * coupling.transpose() / rotation;
    }
    stiffness / (2.0 * system.cloud.volumes[point as usize])
}

/// Engineering constants of a stiffness along some axes; for a stiffness of the plane, as in plane stress.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EngineeringConstants<const D: usize = 2> {
    /// Young's moduli along the axes, Pa.
    pub young: [f64; D],
    /// Poisson's ratios -eps_b/eps_a under stress along a, as \[a\]\[b\]: contraction along b; -1 for b = a.
    pub poisson: [[f64; D]; D],
    /// Shear moduli, Pa, each between two axes; zero on the diagonal.
    pub shear_modulus: SymTensor<D>,
}

impl<const D: usize> EngineeringConstants<D> {
    /// The constants along the first E axes; for E > D with zeros beyond the D axes.
    pub fn resized<const E: usize>(&self) -> EngineeringConstants<E> {
        let along = |values: &[f64; D]| {
            std::array::from_fn(|axis| values.get(axis).copied().unwrap_or(0.0))
        };
        EngineeringConstants {
            young: along(&self.young),
            poisson: std::array::from_fn(|row| self.poisson.get(row).map_or([0.0; E], along)),
            shear_modulus: self.shear_modulus.resized(),
        }
    }
}

impl EngineeringConstants {
    /// Constants of a stiffness of the plane (3, 3), Pa, along x and y: reciprocals of the entries of its inverse. `None` where the
    /// stiffness has no inverse.
    pub fn from_stiffness(stiffness: Matrix3<f64>) -> Option<Self> {
        let stiffness = Stiffness::from_column_slice(3, 3, stiffness.as_slice());
        Self::along(stiffness, [[1.0, 0.0], [0.0, 1.0]])
    }
}

impl<const D: usize> EngineeringConstants<D> {
    /// Constants of a stiffness, Pa, along orthogonal axes given by their unit vectors. `None` where the stiffness has no inverse.
    pub fn along(stiffness: Stiffness, axes: [[f64; D]; D]) -> Option<Self> {
        let compliance = stiffness.try_inverse()?;
        // Unit stress along an axis or between two; its work-conjugate strain is read from engineering strains.
        let stress = |i: usize, j: usize| {
            let dyad = SymTensor::dyad(axes[i], axes[j]);
            dyad.scaled(if i == j { 1.0 } else { 2.0 })
        };
        let strain = |read: SymTensor<D>, stress: SymTensor<D>| -> f64 {
            let rows = read.components().enumerate().map(|(row, read)| {
                let stresses = stress.components().enumerate();
                let strain: f64 = stresses.map(|(k, it)| compliance[(row, k)] * it).sum();
                read * strain
            });
            rows.sum()
        };
        let under = |a: usize, b: usize| strain(stress(b, b), stress(a, a));
        Some(Self {
            young: std::array::from_fn(|a| 1.0 / under(a, a)),
            poisson: std::array::from_fn(|a| std::array::from_fn(|b| -under(a, b) / under(a, a))),
            shear_modulus: SymTensor::from_fn(|a, b| match a == b {
                true => 0.0,
                false => 1.0 / strain(stress(a, b), stress(a, b)),
            }),
        })
    }
}
