//! Materials of a bond at an interface.
//!
//! Points on an interface contain both of its materials, and bonds may run within one material, along the interface or across it. Two halves
//! in series test the rule: with the mean of both ends' materials, as homogeneous laws suggest, a soft half beside a stiff one would be
//! restrained by bonds half as stiff as the stiff ones, whatever its own stiffness.

use super::restraint::Restraint;
use crate::bonds::BondSet;
use crate::cloud::PointCloud;
use crate::parallel;

/// Materials of a bond, by number, with fractions that sum to one.
///
/// A bond consists of the materials common to both ends, with the mean of their fractions: one from inside a half to its interface lies
/// within that half, one along the interface has both halves at its sides. A bond whose ends have no material in common crosses an
/// interface, and has the materials of its softer end: with springs in series the softer one decides. `stiffness` (n_materials) gives the
/// softer one; of equal ends it is the first.
pub(super) fn fractions_of_bond<'a, const D: usize>(
    cloud: &'a PointCloud<D>,
    ends: [u32; 2],
    stiffness: &[f64],
) -> impl Iterator<Item = (usize, f64)> + 'a {
    let ends = ends.map(|end| end as usize);
    let [first, second] = ends.map(|end| cloud.shares(end));
    let common = move |k: usize| {
        if first[k] > 0.0 && second[k] > 0.0 {
            first[k] + second[k]
        } else {
            0.0
        }
    };
    let total: f64 = (0..first.len()).map(common).sum();
    let [of_first, of_second] = ends.map(|end| cloud.mean_property(end, stiffness));
    let softer = if of_first <= of_second { first } else { second };
    let share = move |k: usize| {
        if total > 0.0 {
            common(k) / total
        } else {
            softer[k]
        }
    };
    (0..first.len()).map(move |material| (material, share(material)))
}

/// Factors 2/(1 + k_soft/k_stiff) of the bonds whose ends have no material in common, 1 of the others, from the `stiffness` (n_materials) of
/// the materials; shape (n_bonds), empty in a body of one material.
///
/// This is the ratio of the stiffness of a bond with half its length in either material, as springs in series, to the stiffness of a bond in the
/// softer one.
pub(super) fn series_factors<const D: usize>(
    bonds: &BondSet<D>,
    cloud: &PointCloud<D>,
    stiffness: &[f64],
) -> Vec<f64> {
    if cloud.n_materials == 1 {
        return Vec::new();
    }
    let of_bond = |ends: &[u32; 2]| {
        let ends = ends.map(|end| end as usize);
        let [first, second] = ends.map(|end| cloud.shares(end));
        if first.iter().zip(second).any(|(a, b)| *a > 0.0 && *b > 0.0) {
            return 1.0;
        }
        let [first, second] = ends.map(|end| cloud.mean_property(end, stiffness));
        2.0 / (1.0 + first.min(second) / first.max(second))
    };
    bonds.ends.iter().map(of_bond).collect()
}

/// The softest material of a bond with the fractions `shares` of its length in the materials (n_materials), and the stiffness of the bond, as springs
/// in series, over the stiffness of a bond in this material alone:
///
/// 1/sum of phi_i k_s/k_i, with the fractions phi_i, the stiffnesses k_i and the smallest of them k_s.
///
/// Of two sets of stiffnesses (n_materials) the first decides, or the second where one of the first is not positive.
pub(super) fn softest(shares: &[f64], [first, second]: [&[f64]; 2]) -> (usize, f64) {
    let crossed = || (0..shares.len()).filter(|&material| shares[material] > 0.0);
    let of_all = if crossed().all(|it| first[it] > 0.0) {
        first
    } else {
        second
    };
    let softer = |one: usize, other: usize| {
        if of_all[other] < of_all[one] {
            other
        } else {
            one
        }
    };
    let softest = crossed().reduce(softer).unwrap_or_default();
    let compliance: f64 = crossed()
        .map(|it| shares[it] * of_all[softest] / of_all[it])
        .sum();
    (softest, 1.0 / compliance)
}

/// Restraints of the rotations of the ends of bonds by stiffer materials: at each end
///
/// beta = 1 - k_t/(sum of phi_i k_ti), at least 0,
///
/// with the fractions phi_i of the materials of the end, from the shear densities of the bonds (n_bonds) and the density of a bond in one
/// material, `of_material`; shape (n_bonds), empty in a body of one material.
///
/// Where materials are sheared in series, each rotates in proportion to 1/k_ti, and the point between them by their mean with the weights
/// phi_i k_ti: beta is the relative deficit of the rotation of the point against the rotation of the bond's material.
pub(super) fn restraints<const D: usize>(
    bonds: &BondSet<D>,
    cloud: &PointCloud<D>,
    shear: &[f64],
    of_material: impl Fn(usize, usize) -> f64 + Sync,
) -> Vec<Restraint> {
    if cloud.n_materials == 1 {
        return Vec::new();
    }
    let of_bond = |bond: usize| {
        let materials = 0..cloud.n_materials;
        let of_materials: Vec<f64> = materials.map(|it| of_material(it, bond).abs()).collect();
        let own = shear[bond].abs();
        let ends = bonds.ends[bond].map(|end| {
            let mean = cloud.mean_property(end as usize, &of_materials);
            if mean > own { 1.0 - own / mean } else { 0.0 }
        });
        if ends == [0.0; 2] {
            return Restraint::NONE;
        }
        let stiffest = of_materials.into_iter().fold(own, f64::max);
        Restraint {
            ends,
            softness: own / stiffest,
        }
    };
    parallel::values(bonds.len(), Restraint::NONE, of_bond)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::horizon::Horizons;

    /// Points of a soft material, on the interface with a stiff one, and of the stiff one.
    fn cloud() -> PointCloud {
        let positions = [[0.0; 2], [1.0, 0.0], [2.0, 0.0]];
        PointCloud {
            material_shares: vec![1.0, 0.0, 0.25, 0.75, 0.0, 1.0],
            ..PointCloud::from_points(&positions, &[1.0; 3], 1.0, &[0, 0, 1], 2)
        }
    }

    fn shares(ends: [u32; 2], stiffness: [f64; 2]) -> Vec<f64> {
        fractions_of_bond(&cloud(), ends, &stiffness)
            .map(|it| it.1)
            .collect()
    }

    #[test]
    fn bonds_within_a_half_along_the_interface_and_across_it() {
        assert_eq!(shares([0, 0], [1.0, 9.0]), [1.0, 0.0]);
        assert_eq!(shares([0, 1], [1.0, 9.0]), [1.0, 0.0]);
        assert_eq!(shares([1, 2], [1.0, 9.0]), [0.0, 1.0]);
        assert_eq!(shares([1, 1], [1.0, 9.0]), [0.25, 0.75]);
        assert_eq!(shares([0, 2], [1.0, 9.0]), [1.0, 0.0]);
        assert_eq!(shares([0, 2], [9.0, 1.0]), [0.0, 1.0]);
    }

    /// A bond in the soft material is held at an end on the interface and at one behind it, by what they turn less than the soft one: with
    /// shares 1/4 and 3/4 and the densities 1 and 9 the mean is 7. Nothing holds a bond in the stiff material.
    #[test]
    fn ends_in_a_stiffer_material_hold_a_bond() {
        let cloud = cloud();
        let bonds = BondSet::<2>::search(&cloud, &Horizons::unified(2.5, 3));
        assert_eq!(*bonds.ends, [[0, 1], [0, 2], [1, 2]]);
        let of_material = |material: usize, _| [1.0, 9.0][material];
        let found = restraints(&bonds, &cloud, &[1.0, 1.0, 9.0], of_material);
        let soft = |ends| Restraint {
            ends,
            softness: 1.0 / 9.0,
        };
        let expected = [
            soft([0.0, 1.0 - 1.0 / 7.0]),
            soft([0.0, 1.0 - 1.0 / 9.0]),
            Restraint::NONE,
        ];
        assert_eq!(found, expected);
    }
}
