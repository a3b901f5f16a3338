//! Input of the limits of bonds: body, materials and law.

use super::crack_energies::Lattice;
use super::joint::{crosses, shares_of_length};
use crate::material::{Material, Plane, Space, VolumetricSplit};
use crate::scatter::{Factors, Scattered};
use crate::system::BondSystem;

/// Body in D dimensions, materials and law, from which criteria make the limits of the bonds.
#[derive(Debug, Clone)]
pub struct Basis<'a, const D: usize = 2> {
    /// The bonds.
    pub system: &'a BondSystem<D>,
    /// Points whose bonds never fail, shape (n_points).
    pub no_fail: &'a [bool],
    /// The space in which the body deforms.
    pub space: Space,
    /// The materials (n_materials); in a body of several then all of them with the strengths of each material, shape (n_materials, n_materials),
    /// and of each interface, shape (n_joints, n_materials).
    pub materials: &'a [Material],
    /// Interfaces between two materials, by their indices, with strengths of their own, shape (n_joints).
    pub joints: &'a [[usize; 2]],
    /// Elastic constants of each material under the law, and of its bonds; None for a material with axes, shape (n_materials).
    pub constants: Vec<Option<VolumetricSplit>>,
    /// The bonds as a lattice far from its edges, for those with strains of their own; in the plane alone.
    pub lattice: Option<Lattice>,
    /// Random factors, each of another property.
    pub scatter: &'a [Factors],
}

impl<const D: usize> Basis<'_, D> {
    /// A value of each of `materials` from its constants under the law; infinite where it has none, shape (n).
    pub fn each(&self, value: impl Fn(&VolumetricSplit, &Material) -> Option<f64>) -> Vec<f64> {
        let value = |(constants, material): (&Option<VolumetricSplit>, &Material)| {
            value(constants.as_ref()?, material)
        };
        let of_materials = self.constants.iter().zip(self.materials);
        of_materials
            .map(|it| value(it).unwrap_or(f64::INFINITY))
            .collect()
    }

    /// The smallest of the values of the materials in which a bond lies, or of the interfaces that it crosses, and infinity where an end is
    /// marked in `no_fail`, shape (n_bonds). Of several materials it is the mean over the length, each with the strengths of the weakest.
    pub fn weakest(&self, of_materials: &[f64]) -> Vec<f64> {
        let limits = self.weakest_of_bonds(of_materials);
        let of_bond = |(ends, (limit, _)): (&[u32; 2], (f64, usize))| {
            if ends.iter().any(|end| self.no_fail[*end as usize]) {
                f64::INFINITY
            } else {
                limit
            }
        };
        let ends = self.system.bonds.ends.iter();
        ends.zip(limits).map(of_bond).collect()
    }

    /// The material of each bond with the smallest value, as in [`weakest`](Self::weakest); where several make up the mean, the one with the
    /// largest value, which is the softest. Shape (n_bonds).
    pub(super) fn weakest_materials(&self, of_materials: &[f64]) -> Vec<usize> {
        let limits = self.weakest_of_bonds(of_materials);
        limits.map(|(_, material)| material).collect()
    }

    /// Springs in series: the modulus of a bond from the moduli of its materials (Pa), 1/sum of phi_i/M_i with the fractions phi_i of its length.
    pub(super) fn in_series(&self, bond: usize, moduli: &[f64]) -> f64 {
        if let [only] = moduli {
            return *only;
        }
        match shares_of_length(self.system, bond)[..] {
            [(material, _)] => moduli[material],
            ref several => {
                let compliances = several.iter().map(|&(it, share)| share / moduli[it]);
                1.0 / compliances.sum::<f64>()
            }
        }
    }

    fn weakest_of_bonds(&self, values: &[f64]) -> impl Iterator<Item = (f64, usize)> {
        (0..self.system.bonds.len()).map(move |bond| self.weakest_of_bond(bond, values))
    }

    fn weakest_of_bond(&self, bond: usize, values: &[f64]) -> (f64, usize) {
        let BondSystem { cloud, bonds, .. } = self.system;
        if let [only] = values {
            return (*only, 0);
        }
        let shares = shares_of_length(self.system, bond);
        let joints = self.joints.iter().enumerate();
        let crossed = joints.filter(|(_, between)| crosses(cloud, bonds, bond, **between));
        let n_materials = cloud.n_materials;
        let mut rows: Vec<usize> = crossed.map(|(joint, _)| n_materials + joint).collect();
        if rows.is_empty() {
            if let [(material, _)] = shares[..] {
                return (values[material], material);
            }
            rows.extend(shares.iter().map(|it| it.0));
        }
        let of_row = |row: usize| {
            let indices = shares.iter().map(|it| n_materials * (1 + row) + it.0);
            let terms = indices
                .clone()
                .zip(&shares)
                .map(|(it, (_, share))| share * values[it]);
            let softest = indices.reduce(|a, b| if values[b] > values[a] { b } else { a });
            (terms.sum(), softest.unwrap_or_default())
        };
        let weaker =
            |one: (f64, usize), other: (f64, usize)| if other.0 < one.0 { other } else { one };
        rows.into_iter()
            .map(of_row)
            .reduce(weaker)
            .unwrap_or((f64::INFINITY, 0))
    }

    /// The given limits, or the smallest limits of the materials, like [`weakest`](Self::weakest).
    pub(super) fn given_or(
        &self,
        given: Option<f64>,
        of_materials: impl FnOnce() -> Vec<f64>,
    ) -> Vec<f64> {
        let given = given.map(|limit| vec![limit; self.materials.len()]);
        self.weakest(&given.unwrap_or_else(of_materials))
    }

    /// The factors of a property; none where it does not vary.
    pub(super) fn factors(&self, of: Scattered) -> Option<&Factors> {
        self.scatter.iter().find(|it| it.of == of)
    }

    /// Multiplies values of the bonds (n_bonds) by a function of the factor by which a property varies, where it does.
    pub(super) fn scatter(&self, of: Scattered, values: &mut [f64], share: fn(f64) -> f64) {
        let Some(factors) = self.factors(of) else {
            return;
        };
        for (value, &ends) in values.iter_mut().zip(&*self.system.bonds.ends) {
            *value *= share(factors.of_bond(ends));
        }
    }
}

impl Basis<'_> {
    /// State of the plane, and the lattice of bonds with strains of their own.
    ///
    /// # Panics
    ///
    /// Panics where the bonds are none of a [`lattice`](Self::lattice) in a plane.
    pub(super) fn plane_and_lattice(&self) -> (Plane, &Lattice) {
        match (self.space, &self.lattice) {
            (Space::Plane(plane), Some(lattice)) => (plane, lattice),
            _ => panic!("bonds with strains of their own are those of a lattice in a plane"),
        }
    }
}
