//! Micro-modulus matrices of bonds, from the stiffness of the plane.

use nalgebra::{Matrix3, Vector3};

use crate::bonds::BondSet;
use crate::element::imaginary::{StrainStiffness, entries};
use crate::law::{BondStiffness, LawInput, bulk_stiffness, materials};

/// Stiffness of bonds with given micro-modulus matrices and energy fractions of their first ends (n_bonds).
pub(super) fn bond_stiffness(bonds: &BondSet, matrices: &[(Matrix3<f64>, f64)]) -> BondStiffness {
    let along = |((matrix, _), &[a, b]): (&(Matrix3<f64>, f64), &[f64; 2])| {
        let stretch = Vector3::new(a * a, b * b, a * b);
        stretch.dot(&(matrix * stretch))
    };
    let strain = |(matrix, first_share): &(Matrix3<f64>, f64)| StrainStiffness {
        entries: entries(matrix),
        first_share: *first_share,
    };
    BondStiffness {
        axial: matrices.iter().zip(&bonds.direction).map(along).collect(),
        shear: matrices.iter().map(|(matrix, _)| matrix[(2, 2)]).collect(),
        rotational: vec![0.0; bonds.len()],
        strain: matrices.iter().map(strain).collect(),
        series: Vec::new(),
        held: Vec::new(),
        exchange: Vec::new(),
    }
}

/// Plane stiffness of the materials of each bond ([`materials::fractions_of_bond`]), shape (n_bonds), Pa.
pub(super) fn plane_stiffnesses(input: &LawInput<'_, 2>) -> Vec<Matrix3<f64>> {
    let (bonds, plane) = (input.bonds, input.space.plane());
    let of_materials: Vec<Matrix3<f64>> = (input.elasticity.iter())
        .map(|material| material.plane_stiffness(plane))
        .collect();
    let bulk: Vec<f64> = of_materials.iter().map(bulk_stiffness).collect();
    let of_bond = |&ends: &[u32; 2]| {
        let shares = materials::fractions_of_bond(input.cloud, ends, &bulk);
        shares.fold(Matrix3::zeros(), |sum, (material, share)| {
            sum + share * of_materials[material]
        })
    };
    let mut of_bonds: Vec<Matrix3<f64>> = bonds.ends.iter().map(of_bond).collect();
    for (bond, shares) in bonds.composition.numbered() {
        let (softest, _) = materials::softest(shares, [&bulk, &bulk]);
        of_bonds[bond] = of_materials[softest];
    }
    of_bonds
}
