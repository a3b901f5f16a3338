//! What the limits of bonds are made from.

use super::crack_energies::Lattice;
use crate::bonds::BondSet;
use crate::cloud::PointCloud;
use crate::material::{Isotropic, Material, Plane};
use crate::portion::Portion;
use crate::scatter::{Factors, Scattered};
use crate::system::BondSystem;

/// Body, materials and law, from which criteria make the limits of the bonds.
#[derive(Debug, Clone)]
pub struct Basis<'a> {
    /// The bonds.
    pub system: &'a BondSystem,
    /// Points whose bonds never fail, shape (n_points).
    pub no_fail: &'a [bool],
    /// State of the plane.
    pub plane: Plane,
    /// The materials.
    pub materials: &'a [Material],
    /// The elastic constants that the law makes of those of each material; none with axes, shape (n_materials).
    pub constants: Vec<Option<Isotropic>>,
    /// The bonds as a lattice far from its edges, for those with strains of their own.
    pub lattice: Lattice,
    /// Factors by which a property varies at random, where one does.
    pub scatter: Option<&'a Factors>,
}

impl Basis<'_> {
    /// A value of each material, from the constants that the law makes of its own; infinite where it has none, shape
    /// (n_materials).
    pub fn each(&self, value: impl Fn(&Isotropic, &Material) -> Option<f64>) -> Vec<f64> {
        let value = |(constants, material): (&Option<Isotropic>, &Material)| {
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
        let BondSystem { cloud, bonds, .. } = self.system;
        weakest(cloud, bonds, self.no_fail, of_materials)
    }

    /// What of the body the ends of limits are made from.
    pub(super) fn ends(&self) -> LimitEnds<'_> {
        LimitEnds {
            ends: &self.system.bonds.ends,
            horizons: &self.system.bonds.horizon,
            scatter: self.scatter,
            portion: self.system.cloud.portion.as_ref(),
        }
    }
}

/// Bonds whose limits are made, in the plane or in space.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LimitEnds<'a> {
    /// Points of each bond, shape (n_bonds).
    pub(crate) ends: &'a [[u32; 2]],
    /// Horizon of each bond, shape (n_bonds), m.
    pub(crate) horizons: &'a [f64],
    /// Factors by which a property varies at random, where one does.
    pub(crate) scatter: Option<&'a Factors>,
    /// The part of this process in the body, where it is one of several.
    pub(crate) portion: Option<&'a Portion>,
}

impl LimitEnds<'_> {
    /// Multiplies values of the bonds (n_bonds) by a function of the factor by which a property varies, where it does.
    pub(crate) fn scatter(self, of: Scattered, values: &mut [f64], share: fn(f64) -> f64) {
        let Some(factors) = self.scatter.filter(|it| it.of == of) else {
            return;
        };
        for (value, &ends) in values.iter_mut().zip(self.ends) {
            *value *= share(factors.of_bond(ends));
        }
    }
}

/// The smallest of the values of the materials (n_materials) that have a share in an end of each bond or that it crosses, and infinity
/// where an end is marked in `no_fail` (n_points), shape (n_bonds).
pub(crate) fn weakest<const D: usize>(
    cloud: &PointCloud<D>,
    bonds: &BondSet<D>,
    no_fail: &[bool],
    of_materials: &[f64],
) -> Vec<f64> {
    let materials = weakest_materials(cloud, bonds, of_materials);
    let of_bond = |(ends, material): (&[u32; 2], usize)| {
        if ends.iter().any(|end| no_fail[*end as usize]) {
            f64::INFINITY
        } else {
            of_materials[material]
        }
    };
    bonds.ends.iter().zip(materials).map(of_bond).collect()
}

/// The material with the smallest of the values (n_materials) among those that have a share in an end of each bond or that it crosses,
/// the first of equals, shape (n_bonds).
pub(super) fn weakest_materials<const D: usize>(
    cloud: &PointCloud<D>,
    bonds: &BondSet<D>,
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
