//! Factors of the patch correction in space: the equations that they meet, turned bodies, threads, and the forces of the cells.
#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::f64::consts::FRAC_1_SQRT_2;

use ligament_mesh::{SolidCell, SolidMesh};
use ligament_model::bonds::BondSet;
use ligament_model::cloud::PointCloud;
use ligament_model::correction::Correction;
use ligament_model::correction::patch::{
    CellForces, Points, Settings, correct, forces_of_solid_mesh,
};
use ligament_model::horizon::Horizons;
use ligament_model::law::{BondStiffness, Law};
use ligament_model::material::{Elasticity, Isotropic, Plane, Space, Stiffness};
use ligament_model::tensor::{SymTensor, cross, dot, minus, norm};

const MATERIAL: Isotropic = Isotropic {
    young: 3.0,
    poisson: 0.2,
};

/// Lame's constants lambda and mu.
const LAME: [f64; 2] = [3.0 * 0.2 / (1.2 * 0.6), 0.5 * 3.0 / 1.2];

fn stiffness() -> Vec<Stiffness> {
    let stiffness = Elasticity::Isotropic(MATERIAL).stiffness::<3>(Plane::Strain);
    stiffness.into_iter().collect()
}

/// A cube of n^3 nodes one apart, moved by up to a tenth without a pattern, in six tetrahedra a cell.
fn mesh(n: u32) -> SolidMesh {
    let node = |[x, y, z]: [u32; 3]| (z * n + y) * n + x;
    let mut seed = 1_u64;
    let mut shift = || {
        seed = seed
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        0.2 * ((seed >> 33) as f64 / f64::from(1_u32 << 31) - 0.5)
    };
    let nodes = (0..n.pow(3)).map(|k| [k % n, k / n % n, k / (n * n)]);
    let positions = nodes
        .map(|place| place.map(|it| f64::from(it) + shift()))
        .collect();
    let mut cells = Vec::new();
    for k in 0..(n - 1).pow(3) {
        let m = n - 1;
        let corner = [k % m, k / m % m, k / (m * m)];
        for [a, b, c] in [
            [0, 1, 2],
            [1, 2, 0],
            [2, 0, 1],
            [1, 0, 2],
            [0, 2, 1],
            [2, 1, 0],
        ] {
            let mut place = corner;
            let mut corners = [node(place); 4];
            for (next, axis) in [a, b, c].into_iter().enumerate() {
                place[axis] += 1;
                corners[next + 1] = node(place);
            }
            if (b + 3 - a) % 3 == 2 {
                corners.swap(2, 3);
            }
            cells.push(SolidCell::Tetrahedron(corners));
        }
    }
    SolidMesh {
        node_tags: (1..=u64::from(n.pow(3))).collect(),
        positions,
        cells,
        ..SolidMesh::default()
    }
}

/// What goes into the correction of a mesh, and what comes out.
struct Case {
    cloud: PointCloud<3>,
    bonds: BondSet<3>,
    forces: CellForces<3>,
    stiffness: BondStiffness,
    correction: Correction,
}

fn corrected(mesh: &SolidMesh, horizon: f64, turn: bool) -> Case {
    corrected_by(&Settings::DEFAULT, mesh, horizon, turn)
}

fn corrected_by(settings: &Settings, mesh: &SolidMesh, horizon: f64, turn: bool) -> Case {
    let of_cells = vec![0; mesh.cells.len()];
    let cloud = PointCloud::from_mesh(mesh, 1.0, &of_cells, 1);
    let bonds = BondSet::search(&cloud, &Horizons::unified(horizon, cloud.len()));
    let forces = forces_of_solid_mesh(&mesh.cells, &cloud, &of_cells, stiffness());
    let stiffness = Law::NHPD.densities(&bonds, &cloud, &[MATERIAL.into()], Space::Solid);
    let alpha = vec![1.0; bonds.len()];
    let points = Points {
        cloud: &cloud,
        forces: forces.clone(),
        turn,
    };
    let nearest_to = alpha.clone();
    let correction = correct(&bonds, &points, &stiffness, (alpha, &nearest_to), settings);
    Case {
        bonds,
        forces,
        stiffness,
        correction,
        cloud,
    }
}

impl Case {
    /// Sums over the strains of the squares of the force and of the moment that given factors leave at each point, from the sheet's
    /// formulas for a bond and the stress of the continuum.
    fn left(&self, axial: impl Fn(usize) -> f64, shear: impl Fn(usize) -> f64) -> Vec<[f64; 2]> {
        let mut all = vec![[0.0; 2]; self.cloud.len()];
        for (number, &[i, j]) in SymTensor::<3>::COMPONENTS.iter().enumerate() {
            let size = if i == j { 1.0 } else { FRAC_1_SQRT_2 };
            let is_component = |row, column| [row, column] == [i, j];
            let strain = SymTensor::<3>::from_fn(|row, column| match is_component(row, column) {
                true => size,
                false => 0.0,
            });
            let mut sums: Vec<[[f64; 3]; 2]> = (self.forces.on_points())
                .map(|forces| [forces[number].map(|it| -it), [0.0; 3]])
                .collect();
            for (bond, &[a, b]) in self.bonds.ends.iter().enumerate() {
                let (n, length) = (self.bonds.direction[bond], self.bonds.length[bond]);
                let weight = self.cloud.volumes[a as usize] * self.cloud.volumes[b as usize];
                let along = strain.times(n);
                let stretch = dot(n, along);
                let gamma = [0, 1, 2].map(|k| along[k] - stretch * n[k]);
                let normal = weight * axial(bond) * self.stiffness.axial[bond] * stretch;
                let across = weight * shear(bond) * self.stiffness.shear[bond];
                let force = [0, 1, 2].map(|k| normal * n[k] + across * gamma[k]);
                let moment = cross(n, gamma).map(|it| -0.5 * across * length * it);
                for (end, sign) in [(a, -1.0), (b, 1.0)] {
                    let [forces, moments] = &mut sums[end as usize];
                    *forces = [0, 1, 2].map(|k| forces[k] + sign * force[k]);
                    *moments = [0, 1, 2].map(|k| moments[k] + moment[k]);
                }
            }
            for (all, sums) in all.iter_mut().zip(sums) {
                *all = [0, 1].map(|k| all[k] + dot(sums[k], sums[k]));
            }
        }
        all
    }

    /// q_n and q_t of a bond.
    fn factors(&self, bond: usize) -> [f64; 2] {
        let axial = self.correction.length_factor[bond] * self.correction.domain_factor[bond];
        [axial, axial * self.correction.shear_ratio[bond]]
    }

    fn root_mean_square(&self, which: usize, left: &[[f64; 2]]) -> f64 {
        (left.iter().map(|it| it[which]).sum::<f64>() / self.cloud.len() as f64).sqrt()
    }
}

/// The forces and moments of single bonds under six strains, added up as vectors, against the 18 equations: their squares are those that
/// the report has, but for the scales.
#[test]
fn uniform_strains_become_equilibria() {
    let case = corrected(&mesh(7), 2.7, true);
    let left = case.left(|bond| case.factors(bond)[0], |bond| case.factors(bond)[1]);
    let before = case.left(|_| 1.0, |_| 1.0);
    let ratio = |which| case.root_mean_square(which, &left) / case.root_mean_square(which, &before);
    // Of forces what corners and edges of few bonds cannot meet is left, of moments, which count for a twenty-fifth, something more.
    assert!(ratio(0) < 0.02, "forces {}", ratio(0));
    assert!(ratio(1) < 0.8, "moments {}", ratio(1));
    // What the report has, by hand.
    let report = case
        .correction
        .report
        .as_ref()
        .and_then(|it| it.patch())
        .unwrap();
    let volume: f64 = case.cloud.volumes.iter().sum();
    let of_bond = |bond: usize| {
        let [a, b] = case.bonds.ends[bond].map(|end| case.cloud.volumes[end as usize]);
        [case.stiffness.axial[bond], case.stiffness.shear[bond]].map(|it| a * b * it)
    };
    let of_bonds = (0..case.bonds.len()).map(|bond| {
        let [axial, shear] = of_bond(bond);
        case.bonds.length[bond] * (axial + shear)
    });
    let factor = volume * (3.0 * LAME[0] + 12.0 * LAME[1]) / of_bonds.sum::<f64>();
    let mut squares = vec![[0.0; 2]; case.cloud.len()];
    for (bond, ends) in case.bonds.ends.iter().enumerate() {
        let [axial, shear] = of_bond(bond).map(|it| factor * it * it);
        for &end in ends {
            squares[end as usize][0] += axial + shear;
            squares[end as usize][1] += 0.25 * shear * case.bonds.length[bond].powi(2);
        }
    }
    let weight = Settings::DEFAULT.moment_weight;
    let scaled = left.iter().zip(&squares);
    let total: f64 = scaled
        .map(|(it, by)| it[0] / by[0] + weight * weight * it[1] / by[1])
        .sum();
    let expected = (total / (18 * case.cloud.len()) as f64).sqrt();
    assert!(
        (report.left / expected - 1.0).abs() < 1e-8,
        "{} {expected}",
        report.left
    );
}

/// The regularisation is large, so that directions are short: with that of the settings rounding grows up to what the iteration leaves (2e-2 of
/// a factor at worst).
#[test]
fn a_turned_body_has_the_same_factors() {
    let straight = mesh(6);
    let (one, two) = ((0.7_f64).sin_cos(), (1.9_f64).sin_cos());
    let mut turned = straight.clone();
    for [x, y, z] in &mut turned.positions {
        (*x, *y) = (one.1 * *x - one.0 * *y, one.0 * *x + one.1 * *y);
        (*y, *z) = (two.1 * *y - two.0 * *z, two.0 * *y + two.1 * *z);
    }
    let settings = Settings {
        regularisation: 1e-3,
        ..Settings::DEFAULT
    };
    let [straight, turned] = [straight, turned].map(|it| corrected_by(&settings, &it, 2.7, true));
    assert_eq!(straight.bonds.ends, turned.bonds.ends);
    for bond in 0..straight.bonds.len() {
        for (one, other) in straight.factors(bond).into_iter().zip(turned.factors(bond)) {
            assert!(
                (one / other - 1.0).abs() < 1e-6,
                "bond {bond}: {one} {other}"
            );
        }
    }
}

#[test]
fn threads_change_no_bit() {
    let mesh = mesh(11);
    let [one, two] = [1, 2].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| corrected(&mesh, 1.9, false).correction)
    });
    assert_eq!(one, two);
}

/// Inside a body of one material cells pull with nothing, and on its outline with the tractions: on a cube of unit cells, the whole force
/// of a uniform stress on a side is that stress times the area.
#[test]
fn cells_give_tractions() {
    let mut mesh = mesh(5);
    mesh.positions
        .iter_mut()
        .flatten()
        .for_each(|it| *it = it.round());
    let of_cells = vec![0; mesh.cells.len()];
    let cloud = PointCloud::from_mesh(&mesh, 1.0, &of_cells, 1);
    let forces = forces_of_solid_mesh(&mesh.cells, &cloud, &of_cells, stiffness());
    let mut side = [0.0; 3];
    for (forces, position) in forces.on_points().zip(&mesh.positions) {
        // eps_xx = 1 and gamma_xy = 1.
        let half = FRAC_1_SQRT_2;
        let force = minus(forces[0], forces[2].map(|it| -half * it));
        if position.iter().all(|it| (1.0..=3.0).contains(it)) {
            assert!(norm(force) < 1e-14);
        }
        if position[0] == 4.0 && position[1..].iter().all(|it| (1.0..=3.0).contains(it)) {
            side = minus(side, force.map(|it| -it));
        }
    }
    let [lambda, mu] = LAME;
    // Nine nodes inside the side, of one square each.
    let expected = [lambda + 2.0 * mu, mu, 0.0].map(|it| 9.0 * it);
    assert!(norm(minus(side, expected)) < 1e-12, "{side:?} {expected:?}");
}
