//! Bonds across the interface of two materials, and the materials that determine their limits.
//!
//! A bond has the strengths of the material in which it lies. Across a joint it has the smaller strengths, or the strengths of an interface there,
//! and under one stress it is stretched by the mean over its length of the strains of its materials: so is its limit.
//!
//! Points lie on the interface itself, and have cells of both materials. At an interface that is given they belong to the first material, so
//! that a crack along it runs between them and the second material: it separates the body once, and spends the fracture energy of the joint
//! once.

use crate::bonds::BondSet;
use crate::cloud::PointCloud;
use crate::system::BondSystem;

/// Whether a bond crosses the interface between two materials, by their indices: its ends lie on different sides of it, or its line passes
/// through both materials.
pub fn crosses<const D: usize>(
    cloud: &PointCloud<D>,
    bonds: &BondSet<D>,
    bond: usize,
    between: [usize; 2],
) -> bool {
    let within = bonds.composition.fractions(bond);
    let sides = bonds.ends[bond].map(|end| {
        let shares = cloud.shares(end as usize);
        between.into_iter().find(|&material| shares[material] > 0.0)
    });
    between.iter().all(|&material| {
        sides.contains(&Some(material)) || within.is_some_and(|it| it[material] > 0.0)
    })
}

/// Materials in which a bond lies, with the fractions of its length: those that its line crosses, else those that both ends have, else those
/// of either end.
pub(super) fn shares_of_length<const D: usize>(
    BondSystem { cloud, bonds, .. }: &BondSystem<D>,
    bond: usize,
) -> Vec<(usize, f64)> {
    let present = |shares: Vec<f64>| -> Vec<(usize, f64)> {
        let total: f64 = shares.iter().sum();
        let numbered = shares.into_iter().enumerate();
        let shares = numbered.map(|(material, share)| (material, share / total));
        shares.filter(|it| it.1 > 0.0).collect()
    };
    if let Some(shares) = bonds.composition.fractions(bond) {
        return present(shares.to_vec());
    }
    let [a, b] = bonds.ends[bond].map(|end| cloud.shares(end as usize));
    let both = || {
        a.iter()
            .zip(b)
            .map(|(a, b)| if a * b > 0.0 { a + b } else { 0.0 })
    };
    match both().any(|share| share > 0.0) {
        true => present(both().collect()),
        false => present(a.iter().zip(b).map(|(a, b)| a + b).collect()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::horizon::Horizons;

    /// Five points in a row, with the middle one on the interface; the bonds of each with the next two.
    #[test]
    fn bonds_beyond_the_first_material_and_the_interface_cross_it() {
        let positions: Vec<[f64; 2]> = (0..5).map(|x| [f64::from(x), 0.0]).collect();
        let mut cloud = PointCloud::from_points(&positions, &[1.0; 5], 1.0, &[0, 0, 0, 1, 1], 2);
        cloud.material_shares[4] = 0.5;
        cloud.material_shares[5] = 0.5;
        let bonds = BondSet::<2>::search(&cloud, &Horizons::unified(2.1, 5));
        let crossing = |between| -> Vec<[u32; 2]> {
            let all = (0..bonds.len()).filter(|&bond| crosses(&cloud, &bonds, bond, between));
            all.map(|bond| bonds.ends[bond]).collect()
        };
        assert_eq!(crossing([0, 1]), [[1, 3], [2, 3], [2, 4]]);
        assert_eq!(crossing([1, 0]), [[0, 2], [1, 2], [1, 3]]);
    }
}
