//! What the limits of bonds are made from.

use super::crack_energies::Lattice;
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
    /// The materials.
    pub materials: &'a [Material],
    /// The elastic constants that the law makes of those of each material, and those of its bonds; none with axes, shape (n_materials).
    pub constants: Vec<Option<VolumetricSplit>>,
    /// The bonds as a lattice far from its edges, for those with strains of their own; in the plane alone.
    pub lattice: Option<Lattice>,
    /// Factors by which properties vary at random, each another one.
    pub scatter: &'a [Factors],
}

impl<const D: usize> Basis<'_, D> {
    /// A value of each material, from the constants that the law makes of its own; infinite where it has none, shape
    /// (n_materials).
    pub fn each(&self, value: impl Fn(&VolumetricSplit, &Material) -> Option<f64>) -> Vec<f64> {
        let value = |(constants, material): (&Option<VolumetricSplit>, &Material)| {
            value(constants.as_ref()?, material)
        };
        let of_materials = self.constants.iter().zip(self.materials);
        of_materials
            .map(|it| value(it).unwrap_or(f64::INFINITY))
            .collect()
    }

    /// The smallest of the values of the materials (n_materials) that have a share in an end of each bond or that it crosses, and
    /// infinity where the bond never fails, shape (n_bonds).
    pub fn weakest(&self, of_materials: &[f64]) -> Vec<f64> {
        weakest(self.system, self.no_fail, of_materials)
    }

    /// The limits that are given, or the smallest of those of the materials (n_materials), like [`weakest`](Self::weakest).
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
    pub(super) fn of_plane(&self) -> (Plane, &Lattice) {
        match (self.space, &self.lattice) {
            (Space::Plane(plane), Some(lattice)) => (plane, lattice),
            _ => panic!("bonds with strains of their own are those of a lattice in a plane"),
        }
    }
}

/// The smallest of the values of the materials (n_materials) that have a share in an end of each bond or that it crosses, and infinity
/// where an end is marked in `no_fail` (n_points), shape (n_bonds).
pub(super) fn weakest<const D: usize>(
    system: &BondSystem<D>,
    no_fail: &[bool],
    of_materials: &[f64],
) -> Vec<f64> {
    let materials = weakest_materials(system, of_materials);
    let of_bond = |(ends, material): (&[u32; 2], usize)| {
        if ends.iter().any(|end| no_fail[*end as usize]) {
            f64::INFINITY
        } else {
            of_materials[material]
        }
    };
    system
        .bonds
        .ends
        .iter()
        .zip(materials)
        .map(of_bond)
        .collect()
}

/// The material with the smallest of the values (n_materials) among those that have a share in an end of each bond or that it crosses,
/// the first of equals, shape (n_bonds).
pub(super) fn weakest_materials<const D: usize>(
    BondSystem { cloud, bonds, .. }: &BondSystem<D>,
    of_materials: &[f64],
) -> Vec<usize> {
    let smaller = |one: usize, other: usize| {
        let is_smaller = of_materials[other] < of_materials[one];
        let is_equal = of_materials[other] == of_materials[one];
        if is_smaller || (is_equal && other < one) {
            other
        } else {
            one
        }
    };
    let among = |shares: &[f64]| {
        let present = (0..shares.len()).filter(|&material| shares[material] > 0.0);
        present.reduce(smaller).unwrap_or_default()
    };
    let at_points: Vec<usize> = (0..cloud.len()).map(|it| among(cloud.shares(it))).collect();
    let of_bond = |ends: &[u32; 2]| {
        let [a, b] = ends.map(|end| at_points[end as usize]);
        smaller(a, b)
    };
    let mut of_bonds: Vec<usize> = bonds.ends.iter().map(of_bond).collect();
    for (bond, shares) in bonds.composition.numbered() {
        of_bonds[bond] = smaller(of_bonds[bond], among(shares));
    }
    of_bonds
}
