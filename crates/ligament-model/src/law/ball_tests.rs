use std::f64::consts::PI;

use super::*;
use crate::bonds::{BondSet, Incidence};
use crate::cloud::PointCloud;
use crate::deformation::SpaceDeformation;
use crate::element::pair::{Pair, PairMechanics};
use crate::element::{Element, Rigidities, StiffnessFactors};
use crate::law::BondStiffness;
use crate::material::{Elasticity, Isotropic, Space};
use crate::tensor::SymTensor;

const MATERIAL: Isotropic = Isotropic {
    young: 3.0,
    poisson: 0.2,
};
const SOLID: Space = Space::Solid;
const HORIZON: f64 = 0.7;
const PARTS: u32 = 40;

/// The bonds of a point with a full ball of neighbours. They lie on shells at the two Gauss points of each part of the radius, at the twelve corners
/// of an icosahedron, which integrate polynomials of the direction up to the fifth degree exactly, each with its part of the volume of the shell.
fn ball() -> (BondSet<3>, PointCloud<3>) {
    let golden = 0.5 * (1.0 + 5.0_f64.sqrt());
    let size = golden.hypot(1.0);
    let (one, other) = (1.0 / size, golden / size);
    let mut corners = Vec::new();
    for (a, b) in [(one, other), (one, -other), (-one, other), (-one, -other)] {
        corners.extend([[0.0, a, b], [a, b, 0.0], [b, 0.0, a]]);
    }
    let mut positions = vec![[0.0; 3]];
    let mut volumes = vec![1.0];
    let (mut ends, mut length, mut direction) = (Vec::new(), Vec::new(), Vec::new());
    let width = HORIZON / f64::from(PARTS);
    let gauss = 0.5 / 3.0_f64.sqrt();
    let places =
        (0..PARTS).flat_map(|part| [0.5 - gauss, 0.5 + gauss].map(|it| f64::from(part) + it));
    for place in places {
        let radius = place * width;
        for &corner in &corners {
            ends.push([0, positions.len() as u32]);
            length.push(radius);
            direction.push(corner);
            positions.push(corner.map(|it| radius * it));
            volumes.push(4.0 * PI * radius * radius * 0.5 * width / 12.0);
        }
    }
    let materials = vec![0; positions.len()];
    let bonds = BondSet {
        incidence: Incidence::new(&ends, positions.len()).into(),
        horizon: vec![HORIZON; ends.len()].into(),
        ends: ends.into(),
        length,
        direction,
        composition: Default::default(),
    };
    let cloud = PointCloud::from_points(&positions, &volumes, 1.0, &materials, 1);
    (bonds, cloud)
}

/// Energy density of the middle of the ball, whose bonds count by alpha, for deformations.
fn energy<const M: usize>(
    stiffness: &BondStiffness,
    alpha: impl Fn(f64) -> f64,
    deformation: impl Fn(&Pair<3, M>) -> SpaceDeformation,
) -> f64 {
    let (bonds, cloud) = ball();
    let factor = |bond: usize| alpha(bonds.length[bond] / HORIZON) * cloud.volumes[bond + 1];
    let scaled = |densities: &[f64], by_length: bool| -> Vec<f64> {
        let all = densities.iter().enumerate();
        all.map(|(bond, density)| {
            let length = if by_length { bonds.length[bond] } else { 1.0 };
            factor(bond) * density * length
        })
        .collect()
    };
    let rigidities = Rigidities {
        axial: scaled(&stiffness.axial, true),
        shear: scaled(&stiffness.shear, true),
        rotational: scaled(&stiffness.rotational, false),
        strain: Vec::new(),
    };
    let of_bond = |bond: usize| {
        let element =
            Pair::new(&(), &bonds, &rigidities, &[], bond).weakened(&StiffnessFactors::WHOLE);
        let deformation = deformation(&element);
        0.5 * element.mutual_energy(&deformation, &deformation)
    };
    (0..bonds.len()).map(of_bond).sum()
}

/// Uniaxial, hydrostatic, shear and some strain (eps_xx, eps_yy, eps_zz, gamma_xy, gamma_xz, gamma_yz).
const STRAINS: [[f64; 6]; 4] = [
    [1.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [1.0, 1.0, 1.0, 0.0, 0.0, 0.0],
    [0.0, 0.0, 0.0, 0.0, 1.0, 0.0],
    [0.31, -0.77, 0.12, 0.93, -0.41, 0.66],
];

fn tensor([xx, yy, zz, xy, xz, yz]: [f64; 6]) -> SymTensor<3> {
    SymTensor::from_engineering(&[xx, yy, xy, zz, xz, yz])
}

/// Elastic energy density lambda/2 tr^2 eps + mu eps : eps.
fn elastic(material: &Isotropic, [xx, yy, zz, xy, xz, yz]: [f64; 6]) -> f64 {
    let Isotropic { young, poisson } = *material;
    let mu = young / (2.0 * (1.0 + poisson));
    let lambda = 2.0 * mu * poisson / (1.0 - 2.0 * poisson);
    let square = xx * xx + yy * yy + zz * zz + 0.5 * (xy * xy + xz * xz + yz * yz);
    0.5 * lambda * (xx + yy + zz).powi(2) + mu * square
}

/// Rounding of sums over a thousand bonds: the rule of Gauss is exact for l^3.
const ROUNDING: f64 = 1e-13;

/// What the rule of Gauss with two points in each of 40 parts leaves of l^4.
const OF_GAUSS: f64 = 1e-7;

#[test]
fn energies_are_those_of_the_isotropic_body() {
    let (bonds, cloud) = ball();
    let materials = [MATERIAL];
    let pds = Law::PDS.densities(&bonds, &cloud, &materials.map(Elasticity::Isotropic), SOLID);
    let constant =
        Law::NHPD.densities(&bonds, &cloud, &materials.map(Elasticity::Isotropic), SOLID);
    let falling =
        Law::MPPD_BEAM.densities(&bonds, &cloud, &materials.map(Elasticity::Isotropic), SOLID);
    let mppd = Law::MPPD.densities(&bonds, &cloud, &materials.map(Elasticity::Isotropic), SOLID);
    for strain in STRAINS {
        let expected = elastic(&MATERIAL, strain);
        let spring = energy(
            &pds,
            |_| 1.0,
            |it: &Pair<3, 3>| it.deformation_in(&tensor(strain)),
        );
        let beam = |stiffness| {
            energy(
                stiffness,
                |_| 1.0,
                |it: &Pair<3, 6>| it.deformation_in(&tensor(strain)),
            )
        };
        for found in [spring, beam(&constant), beam(&falling), beam(&mppd)] {
            let error = found / expected - 1.0;
            assert!(error.abs() < ROUNDING, "{strain:?}: {error:e}");
        }
    }
    assert!(mppd.rotational[0] > 0.0 && mppd.rotational != constant.rotational);
}

#[test]
fn central_forces_have_a_poisson_s_ratio_of_a_quarter() {
    let (bonds, cloud) = ball();
    let conical = Law::BBPD_CONICAL.densities(&bonds, &cloud, &[MATERIAL.into()], SOLID);
    for strain in STRAINS {
        let expected = elastic(&MATERIAL.with_central_forces(SOLID), strain);
        let in_strain = |it: &Pair<3, 3>| it.deformation_in(&tensor(strain));
        let error = energy(&conical, |_| 1.0, in_strain) / expected - 1.0;
        assert!(error.abs() < OF_GAUSS, "{strain:?}: {error:e}");
    }
    let bbpd = Law::BBPD.densities(&bonds, &cloud, &[MATERIAL.into()], SOLID);
    for strain in STRAINS {
        let expected = elastic(&MATERIAL.with_central_forces(SOLID), strain);
        let found = energy(
            &bbpd,
            |_| 1.0,
            |it: &Pair<3, 3>| it.deformation_in(&tensor(strain)),
        );
        assert!((found / expected - 1.0).abs() < ROUNDING, "{strain:?}");
    }
    let quarter = Isotropic {
        poisson: 0.25,
        ..MATERIAL
    };
    assert_eq!(constants::bending(&quarter, SOLID, 1.0), 0.0);
}

/// Rotational springs have the energy 2 (mu - lambda) |omega|^2 per volume in a rigid rotation, and beams have none.
#[test]
fn rotations_cost_springs_what_they_should() {
    let (bonds, cloud) = ball();
    let (omega, mu) = ([0.3, -0.8, 0.5], 3.0 / 2.4);
    let lambda = 2.0 * mu * 0.2 / 0.6;
    let square: f64 = omega.iter().map(|it| it * it).sum();
    let pds = Law::PDS.densities(&bonds, &cloud, &[MATERIAL.into()], SOLID);
    let turned = |n: [f64; 3]| {
        [
            omega[1] * n[2] - omega[2] * n[1],
            omega[2] * n[0] - omega[0] * n[2],
            omega[0] * n[1] - omega[1] * n[0],
        ]
    };
    let found = energy(
        &pds,
        |_| 1.0,
        |it: &Pair<3, 3>| {
            let end = turned(it.direction).map(|component| it.length * component);
            it.between(&[0.0; 3], &end)
        },
    );
    let expected = 2.0 * (mu - lambda) * square;
    assert!((found / expected - 1.0).abs() < ROUNDING);
}

/// A uniform curvature phi = chi x costs pi H^4 d/12 chi : chi, whatever chi is: bending and torsion alike.
#[test]
fn curvatures_cost_chi_chi() {
    let (bonds, cloud) = ball();
    let nhpd = Law::NHPD.densities(&bonds, &cloud, &[MATERIAL.into()], SOLID);
    let chi = [[0.3, -1.2, 0.4], [0.9, 0.1, -0.6], [0.2, 0.8, -0.7]];
    let found = energy(
        &nhpd,
        |_| 1.0,
        |it: &Pair<3, 6>| SpaceDeformation {
            rotation: chi.map(|row| {
                let products = row.iter().zip(it.direction);
                it.length * products.map(|(a, b)| a * b).sum::<f64>()
            }),
            ..SpaceDeformation::default()
        },
    );
    let square: f64 = chi.iter().flatten().map(|it| it * it).sum();
    let expected =
        PI * HORIZON.powi(4) * constants::bending(&MATERIAL, SOLID, 1.0) / HORIZON.powi(2) / 12.0;
    assert!((found / (expected * square) - 1.0).abs() < ROUNDING);
}

/// Sums over the family make up for whatever factor the bonds have and for a density that is off.
#[test]
fn discrete_calibration_needs_no_integral() {
    let (bonds, cloud) = ball();
    let alpha: Vec<f64> = bonds.length.iter().map(|l| (-l).exp()).collect();
    let stiffness = Law::MPPD_BEAM.densities(&bonds, &cloud, &[MATERIAL.into()], SOLID);
    let mut calibrated =
        calibration::calibrated(stiffness, &alpha, &bonds, &cloud, &[MATERIAL], SOLID);
    // A bond takes the mean of both ends; the far ones have this bond alone and know nothing.
    let ratio = |densities: &[f64], shear: bool| -> f64 {
        let sum = (0..bonds.len()).map(|bond| {
            alpha[bond] * cloud.volumes[bond + 1] * bonds.length[bond] * densities[bond]
        });
        let bulk = MATERIAL.bulk_modulus();
        let target = if shear {
            10.0 * MATERIAL.young / (1.0 + MATERIAL.poisson) - 12.0 * bulk
        } else {
            18.0 * bulk
        };
        sum.sum::<f64>() / target
    };
    let far = 0.5;
    for (densities, shear) in [
        (&mut calibrated.axial, false),
        (&mut calibrated.shear, true),
    ] {
        // Half of the factor of a bond is that of its far end, whose family is the bond itself.
        let target = if shear {
            10.0 * MATERIAL.young / (1.0 + MATERIAL.poisson) - 12.0 * MATERIAL.bulk_modulus()
        } else {
            18.0 * MATERIAL.bulk_modulus()
        };
        for (bond, density) in densities.iter_mut().enumerate() {
            *density -= far * target / (alpha[bond] * cloud.volumes[0] * bonds.length[bond]);
        }
        let found = ratio(densities, shear);
        assert!((found / far - 1.0).abs() < 1e-9, "{found}");
    }
}

/// A bond across the interface of two materials is two halves in series: 2/(1/k_1 + 1/k_2), once for the whole bond. One from the interface
/// into a material is of that material.
#[test]
fn bonds_across_an_interface_are_in_series() {
    let positions = [[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [3.0, 0.5, 0.0]];
    let cloud = PointCloud {
        material_shares: vec![1.0, 0.0, 1.0, 0.0, 0.5, 0.5, 0.0, 1.0],
        ..PointCloud::from_points(&positions, &[1.0; 4], 1.0, &[0, 0, 0, 1], 2)
    };
    let bonds = BondSet::<3>::search(&cloud, &crate::horizon::Horizons::unified(2.5, 4));
    let stiff = Isotropic {
        young: 12.0,
        ..MATERIAL
    };
    let materials = [MATERIAL, stiff];
    let found = Law::NHPD
        .densities(&bonds, &cloud, &materials.map(Elasticity::Isotropic), SOLID)
        .in_series();
    let [soft, hard] = materials.map(|it| constants::axial(&it, SOLID, 1.0) / 2.5_f64.powi(4));
    let of = |ends: [u32; 2]| {
        let bond = bonds.ends.iter().position(|it| *it == ends);
        bond.map(|bond| found.axial[bond])
    };
    let close = |found: Option<f64>, expected: f64| {
        assert!(
            found.is_some_and(|it| (it / expected - 1.0).abs() < 1e-14),
            "{found:?} {expected}"
        );
    };
    close(of([0, 1]), soft);
    close(of([1, 2]), soft);
    close(of([2, 3]), hard);
    close(of([1, 3]), 2.0 / (1.0 / soft + 1.0 / hard));
    assert_eq!(of([0, 3]), None);
}
