//! Limits and measures of the bonds of a block in space.
#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::f64::consts::PI;

use super::fracture_energy::{
    BOND_ENERGY, CRITICAL_STRETCH, critical_stretch, stretch_at_strength,
};
use super::*;
use crate::bonds::BondSet;
use crate::cloud::PointCloud;
use crate::deformation::Deformation;
use crate::element::pair::{Pair, PairMechanics};
use crate::element::{BondDeformation, ElementKind};
use crate::horizon::Horizons;
use crate::law::Law;
use crate::material::{Elasticity, Isotropic, Material, Space, VolumetricSplit};
use crate::system::BondSystem;
use crate::tensor::{dot, tangents};

const YOUNG: f64 = 30e9;

/// A bond of all blocks that may fail.
const ANY: usize = 25;

fn material(poisson: f64) -> Material {
    Material {
        tensile_strength: Some(3e6),
        compressive_strength: Some(30e6),
        fracture_energy: Some(80.0),
        ..Material::isotropic(YOUNG, poisson)
    }
}

/// A block of a cubic lattice with the spacing 1, from 0 to `size` - 1 along each axis.
fn block(size: [i32; 3], horizon: f64, poisson: f64, element: ElementKind) -> BondSystem<3> {
    let [nx, ny, nz] = size;
    let mut positions = Vec::new();
    for i in 0..nx {
        for j in 0..ny {
            for k in 0..nz {
                positions.push([i, j, k].map(f64::from));
            }
        }
    }
    let n = positions.len();
    let cloud = PointCloud::from_points(&positions, &vec![1.0; n], 1.0, &vec![0; n], 1);
    let bonds = BondSet::<3>::search(&cloud, &Horizons::unified(horizon, n));
    let materials = [Isotropic {
        young: YOUNG,
        poisson,
    }];
    let space = Space::Solid;
    let stiffness = match element {
        ElementKind::Beam => {
            Law::NHPD.densities(&bonds, &cloud, &materials.map(Elasticity::Isotropic), space)
        }
        _ => Law::PDS.densities(&bonds, &cloud, &materials.map(Elasticity::Isotropic), space),
    };
    let ones = vec![1.0; bonds.len()];
    BondSystem::new(cloud, bonds, element, stiffness, ones.clone(), &ones)
}

/// The first criterion of a choice for the bonds of a system of one material, whose first point never fails.
fn made(
    system: &BondSystem<3>,
    material: Material,
    choice: impl Into<Choice>,
) -> Result<Criterion, (usize, NoLimit)> {
    let mut no_fail = vec![false; system.cloud.len()];
    no_fail[0] = true;
    let basis = Basis {
        system,
        no_fail: &no_fail,
        space: Space::Solid,
        constants: vec![material.elasticity.isotropic().map(VolumetricSplit::whole)],
        materials: &[material],
        joints: &[],
        lattice: None,
        scatter: &[],
    };
    criteria(&[choice.into()], &basis).map(|mut made| made.list.remove(0))
}

/// Bonds of a large lattice that a plane across x between two layers of points separates, when each is stretched to its critical stretch:
/// G_c per area of the plane, by the sum over the bonds alone. The families are whole in the middle of the block; a finite number of
/// lengths and directions misses the mean 1/2 of |cos phi| by what is asserted.
#[test]
fn splitting_a_block_takes_the_fracture_energy() {
    let size = [12, 13, 13];
    let system = block(size, 3.0, 0.25, ElementKind::Spring);
    let limits = made(&system, material(0.25), CRITICAL_STRETCH)
        .unwrap()
        .limit;
    // Scales the densities to the bulk modulus, which the integral misses on a lattice: only whole families count.
    let bonds = &system.bonds;
    let place = |point: u32| {
        let p = system.cloud.positions[point as usize];
        [0, 1, 2].map(|axis| p[axis] + 0.5 * f64::from(size[axis] - 1))
    };
    let middle = (0..system.cloud.len() as u32)
        .find(|&point| place(point) == [5.0, 6.0, 6.0])
        .unwrap_or_default();
    let sum: f64 = (bonds.incidence.at(middle).iter())
        .map(|&bond| system.rigidities.axial[bond as usize])
        .sum();
    let scale = 18.0 * YOUNG / 1.5 / sum;
    let mut energy = 0.0;
    for (bond, ends) in bonds.ends.iter().enumerate() {
        let [a, b] = ends.map(place);
        let crosses = (a[0] < 5.5) != (b[0] < 5.5);
        // Each bond through a window of one point's area: counted where its lower end lies above that area.
        let lower = if a[0] < b[0] { a } else { b };
        if crosses && lower[1] == 6.0 && lower[2] == 6.0 {
            energy += 0.5 * scale * system.rigidities.axial[bond] * limits[bond].powi(2);
        }
    }
    assert!((energy / 80.0 - 1.0).abs() < 0.015, "{energy}");
    // In the continuum the stretch is sqrt(5 G/(9 K H)).
    let continuous = critical_stretch(80.0, YOUNG / 1.5, 0.8 * 3.0, Space::Solid);
    let expected: f64 = (5.0 * 80.0 / (9.0 * YOUNG / 1.5 * 3.0)).sqrt();
    assert!((continuous / expected - 1.0).abs() < 1e-14);
}

/// e_0 is the energy of the uniaxial strain F_t/E, and s_0 the stretch at which the share of the bond reaches it: V e_0 = 1/2 K s_0^2 for
/// two points of volume V, half of which belongs to each.
#[test]
fn strength_is_an_energy() {
    let system = block([4, 4, 4], 2.0, 0.2, ElementKind::Beam);
    let limits = made(&system, material(0.2), strength::STRENGTH)
        .unwrap()
        .limit;
    let [mode, ..] = crate::correction::StrainMode::<3>::uniaxial();
    let isotropic = Isotropic {
        young: YOUNG,
        poisson: 0.2,
    };
    let stiffness = crate::Elasticity::Isotropic(isotropic).stiffness::<3>(crate::Plane::Strain);
    let energy = mode.energy(&stiffness.unwrap()) * (3e6 / YOUNG).powi(2);
    assert!(
        (strength::critical_energy(&isotropic, 3e6, Space::Solid) / energy - 1.0).abs() < 1e-14
    );
    for (bond, &limit) in limits.iter().enumerate() {
        if system.bonds.ends[bond].contains(&0) {
            assert_eq!(limit, f64::INFINITY);
        } else {
            let stored = 0.5 * system.rigidities.axial[bond] * limit * limit;
            assert!((stored / energy - 1.0).abs() < 1e-12);
        }
    }
}

/// Strains of a bar under its strength F: F/E along it, sliding F (1 + nu)/(2 E) at 45 degrees.
#[test]
fn limits_of_a_bar() {
    let system = block([4, 4, 4], 2.0, 0.2, ElementKind::Beam);
    let own = Choice {
        limit: Some(0.01),
        ..Choice::from(stretch::TENSION)
    };
    for (choice, expected) in [
        (stretch::TENSION.into(), 1e-4),
        (stretch::COMPRESSION.into(), 1e-3),
        (sliding::SLIDING.into(), 0.6e-4),
        (own, 0.01),
    ] {
        let found = made(&system, material(0.2), choice).unwrap().limit[ANY];
        assert!((found / expected - 1.0).abs() < 1e-14);
    }
}

/// Bonds that soften by their energy begin at the strength and take the fracture energy: (s_G/s_0)^2 times what they store at s_0, which
/// a straight fall ends at that many s_0.
#[test]
fn softening_takes_the_fracture_energy() {
    let system = block([5, 5, 5], 2.0, 0.2, ElementKind::Beam);
    let with_strength = |strength: f64| Material {
        tensile_strength: Some(strength),
        ..material(0.2)
    };
    let choice = Choice {
        after: softening::linear::LAW,
        ..Choice::from(BOND_ENERGY)
    };
    let criterion = made(&system, with_strength(1e3), choice.clone()).unwrap();
    let isotropic = Isotropic {
        young: YOUNG,
        poisson: 0.2,
    };
    let begin = stretch_at_strength(&isotropic, 1e3, Space::Solid);
    let brittle = made(&system, material(0.2), CRITICAL_STRETCH)
        .unwrap()
        .limit;
    for (bond, &limit) in criterion.limit.iter().enumerate() {
        if limit.is_finite() {
            assert!((limit / begin - 1.0).abs() < 1e-14);
            let taken = criterion.after.total_dissipated(bond);
            assert!((taken / (brittle[bond] / limit).powi(2) - 1.0).abs() < 1e-12);
        }
    }
    let shear = system.rigidities.shear[3] / system.rigidities.axial[3];
    assert_eq!(criterion.coefficients(3), [shear]);
    // A strength at which bonds store more than the fracture energy leaves nothing.
    let refused = made(&system, with_strength(1e9), choice);
    assert!(matches!(refused, Err((0, NoLimit::NothingLeft { .. }))));
}

#[test]
fn criteria_of_the_plane_are_refused_by_name() {
    let system = block([2, 2, 2], 1.0, 0.2, ElementKind::Beam);
    let refused = KINDS.iter().filter_map(|kind| {
        let refused = made(&system, material(0.2), **kind).err();
        refused.map(|(_, reason)| (kind.word, reason.to_string()))
    });
    let expected = ["mixed-mode", "printed-opening", "printed-sliding", "printed-mixed"].map(|it| {
        let words = format!(
            "the criterion \"{it}\" exists in the plane alone; in space take one of \"strength\", \"bond-rankine\", \
             \"rankine\", \"mohr-coulomb\", \"tension\", \"compression\", \"fibre\", \"sliding\", \"frictional\", \"critical-stretch\", \"bond-energy\""
        );
        (it, words)
    });
    assert_eq!(refused.collect::<Vec<_>>(), expected);
    assert!(Choice::from(strength::STRENGTH).check(true).is_ok());
    assert!(matches!(
        Choice::from(strength::STRENGTH).suits(&Material::isotropic(1.0, 0.2)),
        Err(Unfit::Missing { .. })
    ));
}

/// Stress over the tensile strength of 3 MPa at which the first bond of 40,000 directions slides in a bar along no axis: the strain
/// e ((1 + nu) a a^T - nu I) moves the end of a bond, s along it and gamma across it.
fn yields_at(criterion: &Criterion, sign: f64, poisson: f64) -> f64 {
    const COUNT: u32 = 40_000;
    let (axis, strain) = ([1.0 / 3.0, -2.0 / 3.0, 2.0 / 3.0], sign * 3e6 / YOUNG);
    let of_bond = |bond: u32| {
        let (sin, cos) = (PI * (3.0 - 5.0_f64.sqrt()) * f64::from(bond)).sin_cos();
        let height = (2.0 * f64::from(bond) + 1.0) / f64::from(COUNT) - 1.0;
        let radius = (1.0 - height * height).sqrt();
        let n = [radius * cos, radius * sin, height];
        let along = (1.0 + poisson) * dot(axis, n);
        let moved = [0, 1, 2].map(|k| strain * (along * axis[k] - poisson * n[k]));
        let stretch = dot(moved, n);
        let sliding = (dot(moved, moved) - stretch * stretch).sqrt();
        let deformation = BondDeformation::new([stretch, sliding, 0.0]);
        criterion.measure(ANY, &deformation).max(0.0) / criterion.limit[ANY]
    };
    1.0 / (0..COUNT).map(of_bond).fold(0.0, f64::max)
}

/// A bar with bonds in all directions of space yields at both strengths by the calibration of two points. By the printed one with F_c = 3 F_t
/// it yields where a bar in plane stress does, at 1.016 F_t and 2.605 F_t for nu = 0.1 of an independent calculation, printed to 3 digits.
#[test]
fn friction_of_a_bar() {
    for (poisson, calibration, expected) in [
        (0.25, Calibration::TwoPoint, [1.0, 3.0]),
        (-0.3, Calibration::TwoPoint, [1.0, 3.0]),
        (0.0, Calibration::Printed, [1.0, 3.0]),
        (0.1, Calibration::Printed, [1.016, 2.605]),
    ] {
        let system = block([3, 3, 3], 2.0, poisson, ElementKind::Beam);
        let material = Material {
            compressive_strength: Some(9e6),
            ..material(poisson)
        };
        let choice = Choice {
            calibration: Some(calibration),
            ..Choice::from(frictional::FRICTIONAL)
        };
        let criterion = made(&system, material, choice).unwrap();
        for (sign, expected) in [1.0, -1.0].into_iter().zip(expected) {
            let found = yields_at(&criterion, sign, poisson);
            assert!((found / expected - 1.0).abs() < 4e-4, "{poisson}: {found}");
        }
    }
}

/// A bond that is an arc of a circle of the radius R, whose ends are turned against each other by l/R about an axis across it: a fibre at
/// kappa outside of its axis is longer by kappa/R. A bond that is twisted by as much as well counts the root of 2 of that.
#[test]
fn fibres_of_a_bond_that_bends() {
    let system = block([3, 3, 3], 2.0, 0.2, ElementKind::Beam);
    let (kappa, radius, stretch) = (0.05, 400.0, 1e-4);
    let choice = Choice {
        fibre_distance: Some(kappa),
        ..Choice::from(fibre::FIBRE)
    };
    let criterion = made(&system, material(0.2), choice).unwrap();
    assert!((criterion.limit[ANY] / (3e6 / YOUNG) - 1.0).abs() < 1e-14);
    for (bond, &n) in system.bonds.direction.iter().enumerate() {
        let length = system.bonds.length[bond];
        let [one, other] = tangents(n);
        let measured = |twist: f64| {
            let turned = [0, 1, 2].map(|k| 0.6 * one[k] + 0.8 * other[k] + twist * n[k]);
            let end = |side: f64| {
                let moved = n.map(|it| side * stretch * length * it);
                [moved, turned.map(|it| side * length / radius * it)].concat()
            };
            let element = Pair::<3, 6> {
                ends: [0, 1],
                length,
                direction: n,
                axial_rigidity: 0.0,
                shear_rigidity: 0.0,
                rotational_rigidity: 0.0,
            };
            let deformation = element.between(&end(-0.5), &end(0.5));
            criterion.measure(bond, &deformation.measured())
        };
        for (twist, factor) in [(0.0, 1.0), (1.0, 2.0_f64.sqrt())] {
            let expected = stretch + factor * kappa / radius;
            assert!((measured(twist) / expected - 1.0).abs() < 1e-12);
        }
    }
}
