//! What points, bonds and their correction must keep on every mesh.
//!
//! Each test states its problem and where its expectation comes from. An assertion that something is zero or equal
//! stands beside one that the thing compared is there at all.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

use ligament::prelude::*;
use ligament_mesh::{Cell, Mesh};
use ligament_model::BondSet;
use ligament_model::Horizons;
use ligament_model::PointCloud;
use ligament_model::bonds::outline::{PlaneOutline, bonds_outside};
use ligament_run::model::Model;
use verification::bench::{Bench, domain};
use verification::meshes;
use verification::numbers::deviation;
use verification::numbers::largest;
use verification::numbers::relative_error;
use verification::numbers::short;
use verification::problems::BAR;
use verification::problems::DISK;
use verification::problems::TWO;

fn cloud_of(mesh: &Mesh, thickness: f64) -> PointCloud {
    PointCloud::from_mesh(mesh, thickness, &vec![0; mesh.cells.len()], 1)
}

/// The volumes of the points add up to the area inside the rim of the mesh (shoelace formula over the edges that have a
/// cell on one side only) times the thickness. 1e-12: a sum of some thousand rounded terms.
#[test]
fn volumes_add_up_to_the_area() {
    let thickness = 0.37;
    for path in meshes::all() {
        let mesh = meshes::read(&path);
        let area: f64 = (meshes::rim(&mesh).iter())
            .map(|edge| edge.map(|node| mesh.positions[node as usize]))
            .map(|[p, q]| 0.5 * (p[0] * q[1] - q[0] * p[1]))
            .sum();
        let volume: f64 = cloud_of(&mesh, thickness).volumes.iter().sum();
        let error = relative_error(volume, area * thickness);
        assert!(error < 1e-12, "{}: off by {error:.1e}", path.display());
    }
    let plate = meshes::read("meshes/plate.msh");
    assert!(relative_error(plate.area(), 0.2 * 0.1) < 1e-12);
}

/// Bonds and bond horizons against all pairs of points: l <= max(h_A, h_B); H is the mean of the two where each horizon
/// holds the other point, else the larger one (NHPD eq. 1). Inclusive as far as the coordinates tell.
#[test]
fn search_finds_what_all_pairs_give() {
    for name in [
        "meshes/plate-coarse",
        "meshes/bimaterial",
        "tests/reference/square",
        "tests/reference/disk",
    ] {
        let cloud = cloud_of(&meshes::read(format!("{name}.msh")), 1.0);
        for factor in [1.0, 2.0, 3.0, 4.5] {
            let radius: Vec<f64> = cloud
                .spacing
                .iter()
                .map(|nearest| factor * nearest)
                .collect();
            let found = BondSet::search(&cloud, &Horizons::from_spacing(&cloud.spacing, factor));
            let (mut bond, mut one_sided) = (0, 0);
            for a in 0..cloud.len() {
                for b in a + 1..cloud.len() {
                    let [p, q] = [cloud.positions[a], cloud.positions[b]];
                    let length = (q[0] - p[0]).hypot(q[1] - p[1]);
                    let holds = [a, b]
                        .map(|end| length <= radius[end] * (1.0 + cloud.tolerance(end as u32)));
                    if holds == [false; 2] {
                        continue;
                    }
                    one_sided += usize::from(holds != [true; 2]);
                    let horizon = match holds {
                        [true, true] => 0.5 * (radius[a] + radius[b]),
                        [true, false] => radius[a],
                        _ => radius[b],
                    };
                    assert_eq!(
                        found.ends[bond],
                        [a as u32, b as u32],
                        "{name}, lambda {factor}"
                    );
                    assert!(relative_error(found.horizon[bond], horizon) < 1e-14);
                    assert!(relative_error(found.length[bond], length) < 1e-14);
                    let [x, y] = found.direction[bond];
                    assert!(largest([p[0] + x * length - q[0], p[1] + y * length - q[1]]) < 1e-15);
                    bond += 1;
                }
            }
            assert_eq!(
                found.len(),
                bond,
                "{name}, lambda {factor}: number of bonds"
            );
            assert!(
                one_sided > 10,
                "the horizons are not uniform: some bonds are one-sided"
            );
        }
    }
}

/// Square lattice, horizon exactly three spacings: 28 neighbours (MPPD Fig. 25), four of them at the horizon itself, where
/// rounding of the coordinates must not decide. Spacings and places are no binary fractions.
#[test]
fn the_horizon_is_inclusive_on_a_lattice() {
    for (side, corner) in [
        (0.1, [0.0, 0.0]),
        (0.007, [3.3, -7.1]),
        (1.0 / 3.0, [0.1, 0.2]),
    ] {
        let n = 12;
        let cloud = cloud_of(&meshes::lattice(n, side, corner), 1.0);
        let bonds = BondSet::search(&cloud, &Horizons::from_spacing(&cloud.spacing, 3.0));
        for j in 3..=n - 3 {
            for i in 3..=n - 3 {
                let family = bonds.incidence.at(j * (n + 1) + i);
                assert_eq!(family.len(), 28, "side {side}, point ({i}, {j})");
            }
        }
        let at_the_horizon = bonds
            .length
            .iter()
            .filter(|&&l| relative_error(l, 3.0 * side) < 1e-9);
        assert_eq!(at_the_horizon.count() as u32, 2 * (n + 1) * (n - 2));
    }
}

/// Coordinates of a square lattice in single precision and with seven digits, near the origin and a hundred spacings away from it, give the
/// bonds of the exact ones: the family of three spacings, and every bond along the straight outline.
#[test]
fn rounded_coordinates_have_the_bonds_of_exact_ones() {
    let bonds_of = |mesh: &Mesh| {
        let cloud = cloud_of(mesh, 1.0);
        let found = BondSet::search(&cloud, &Horizons::from_spacing(&cloud.spacing, 3.0));
        let leaves = bonds_outside(
            &PlaneOutline::from_cells(&mesh.cells, &cloud),
            &found,
            &cloud,
        );
        let inside = found.ends.iter().copied().zip(leaves);
        inside.filter(|it| !it.1).map(|it| it.0).collect::<Vec<_>>()
    };
    let seven_digits = |x: f64| format!("{x:.6e}").parse().unwrap();
    for corner in [[0.0, 0.0], [10.0, -7.0]] {
        let exact = meshes::lattice(20, 1.0 / 9.0, corner);
        let expected = bonds_of(&exact);
        // A bond (p, q) fits (21 - p)(21 - q) times: for 3 in rows and columns, 2 along diagonals and the others.
        assert_eq!(expected.len(), 5436);
        let roundings: [&dyn Fn(f64) -> f64; 2] = [&|x| f64::from(x as f32), &seven_digits];
        for (which, round) in roundings.into_iter().enumerate() {
            let moved = meshes::moved(&exact, |p| p.map(round));
            assert!(moved.positions != exact.positions);
            assert!(bonds_of(&moved) == expected, "{corner:?}, rounding {which}");
        }
    }
}

/// A cubic lattice of points in single precision has the bonds of the exact one, also far from the origin: 122 a point at three
/// spacings.
#[test]
fn rounded_points_in_space_have_the_bonds_of_exact_ones() {
    let places = |offset: f64, round: &dyn Fn(f64) -> f64| -> Vec<[f64; 3]> {
        let place =
            |k: u32| [k % 9, k / 9 % 9, k / 81].map(|it| round(offset + 0.1 * f64::from(it)));
        (0..729).map(place).collect()
    };
    let bonds_of = |positions: &[[f64; 3]]| {
        let cloud = PointCloud::from_points(positions, &[1e-3; 729], 1.0, &[0; 729], 1);
        BondSet::search(&cloud, &Horizons::from_spacing(&cloud.spacing, 3.0))
    };
    for offset in [0.0, 50.0] {
        let exact = bonds_of(&places(offset, &|x| x));
        assert_eq!(exact.incidence.at(4 * (1 + 9 + 81)).len(), 122);
        let rounded = bonds_of(&places(offset, &|x| f64::from(x as f32)));
        assert_eq!(rounded.ends, exact.ends, "{offset}");
    }
}

/// After the correction every point has the continuum's energy under uniaxial strain along x and along y. The stop rule
/// (sum of changes of Omega 1e-3) leaves 2e-5 at lambda = 2, where the iteration converges slowly, and 2e-6 above.
#[test]
fn the_correction_makes_uniaxial_energies_right() {
    for mesh in ["disk-4mm", "disk-2mm"] {
        for (factor, tolerance) in [(2, 1e-4), (3, 1e-5), (4, 1e-5)] {
            let file = format!("mesh.file=../meshes/{mesh}.msh");
            let model = Bench::new(DISK, &[&file, &format!("model.horizon_factor={factor}")]).model;
            let [x, y] = [0, 1].map(|it| &model.fixed.energy_ratios[it].at_points);
            let error = largest(x.iter().chain(y).map(|ratio| ratio - 1.0));
            println!(
                "{mesh}, lambda {factor}: {} sweeps, off by {error:.1e}",
                domain(&model).sweeps
            );
            assert!(domain(&model).converged);
            assert!(error < tolerance, "{mesh}, lambda {factor}: {error:.1e}");
            let (smallest, greatest) = model.correction_range;
            assert!(
                greatest > 1.5 * smallest,
                "the correction has something to correct"
            );
        }
    }
}

/// One, two, three or eight threads: no bit of bonds, correction, energies and rigidities differs. The disk has 4808 points: the
/// work on them is in several blocks of 1024, which the threads share. The sums over all bonds of the changes of Omega are
/// one number a correction: several are compared, ended after 1 to 8 sweeps and at their end.
#[test]
fn threads_do_not_change_a_bit_of_the_model() {
    let model = |threads, sweeps: usize| {
        let limit = format!("correction.max_sweeps={sweeps}");
        let mesh = "mesh.file=../meshes/disk-1.5mm.msh";
        let settings = [mesh, "correction.rule=mean", limit.as_str()];
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        let pool = pool.build().unwrap();
        pool.install(|| Bench::new(DISK, &settings).model)
    };
    let bits = |values: &[f64]| -> Vec<u64> { values.iter().map(|v| v.to_bits()).collect() };
    let arrays = |model: &Model| {
        let system = model.plane();
        let [x, y, biaxial, shear] =
            [0, 1, 2, 3].map(|it| &model.fixed.energy_ratios[it].at_points);
        [
            &*system.cloud.spacing,
            &system.weight,
            &system.rigidities.axial,
            &system.rigidities.shear,
            &system.rigidities.rotational,
            &model.criteria.list[0].limit,
            &model.fixed.domain_factor,
            x,
            y,
            biaxial,
            shear,
        ]
        .map(bits)
    };
    for sweeps in (1..=8).chain([10_000]) {
        let one = model(1, sweeps);
        assert_eq!(one.plane().cloud.len(), 4808);
        assert_eq!(domain(&one).converged, sweeps > 8);
        for threads in [2, 3, 8] {
            let other = model(threads, sweeps);
            assert_eq!(other.plane().bonds, one.plane().bonds);
            assert_eq!(other.correction, one.correction, "{threads} threads");
            assert!(arrays(&other) == arrays(&one), "{threads} threads");
        }
    }
}

/// Bonds have limits where they may break.
const BREAKING: &str = "fracture = { steps = 1 }\n";

/// Two materials: a point at the interface has a share of each by volume. A bond within a half has the densities of that half, one
/// along the interface the mean by the shares of its ends, one across it those of its lengths in both halves in series. A bond within a half has the
/// critical energy of that half; one along the interface or across it has the mean by its shares or lengths, at the smaller strength. Nothing but the axial density is compared: it says how stiff a material is. At nu = 1/3 no bond
/// has a shear stiffness, which those whose ends turn with the stiffer half would hand on in part to the axial one.
#[test]
fn bonds_between_materials_are_springs_in_series_at_the_smaller_strength() {
    let poisson = 1.0 / 3.0;
    let two = (TWO.replace("0.3\n", "0.21\n")).replace("0.21", &format!("{poisson:?}"));
    let bench = Bench::new(&format!("{BREAKING}{BAR}{two}"), &[]);
    let alone = |young: f64, poisson: f64, strength: f64| {
        let material = format!(
            "{{ young = {young:?}, poisson = {poisson:?}, tensile_strength = {strength:?} }}"
        );
        Bench::new(&format!("{BREAKING}{BAR}material = {material}\n"), &[])
    };
    let (left, right) = (alone(15e9, poisson, 3e6), alone(60e9, poisson, 8e6));
    let right_at_smaller = alone(60e9, poisson, 3e6);
    let (system, cloud) = (&**bench.model.plane(), &bench.model.plane().cloud);
    let side = |point: u32| {
        let x = bench.positions()[point as usize][0] - 0.05;
        if x.abs() < 1e-9 { 0 } else { x.signum() as i32 }
    };
    let mut volumes = [0.0; 2];
    for point in 0..bench.points() {
        let shares = cloud.shares(point);
        assert!(relative_error(shares[0] + shares[1], 1.0) < 1e-14);
        match side(point as u32) {
            0 => assert!(
                shares[0] > 0.2 && shares[1] > 0.2,
                "an interface point shares: {shares:?}"
            ),
            -1 => assert_eq!(shares, [1.0, 0.0]),
            _ => assert_eq!(shares, [0.0, 1.0]),
        }
        volumes = [0, 1].map(|k| volumes[k] + shares[k] * cloud.volumes[point]);
    }
    for volume in volumes {
        assert!(relative_error(volume, 0.05 * 0.05 * 0.02) < 1e-12);
    }
    // k_n of each bond: its rigidity over Omega alpha V_A V_B l.
    let density = |bench: &Bench, bond: usize| {
        let system = &**bench.model.plane();
        let [a, b] = system.bonds.ends[bond].map(|end| system.cloud.volumes[end as usize]);
        system.rigidities.axial[bond] / (system.weight[bond] * a * b * system.bonds.length[bond])
    };
    // e_0 of each bond from s_0^2 = e_0 (V_A + V_B)/(rigidity), NHPD eq. 16.
    let energy = |bench: &Bench, bond: usize| {
        let system = &**bench.model.plane();
        let [a, b] = system.bonds.ends[bond].map(|end| system.cloud.volumes[end as usize]);
        bench.limits()[bond].powi(2) * system.rigidities.axial[bond] / (a + b)
    };
    let (mut across, mut at_interface) = (0, 0);
    for (bond, ends) in system.bonds.ends.iter().enumerate() {
        // Share of the left material, mean of the ends.
        let share = 0.5 * (cloud.shares(ends[0] as usize)[0] + cloud.shares(ends[1] as usize)[0]);
        let [of_left, of_right] = [&left, &right].map(|bench| density(bench, bond));
        // Part of the length on the left of the interface.
        let [a, b] = ends.map(|end| 0.05 - bench.positions()[end as usize][0]);
        let part = a.max(b) / (a - b).abs();
        let expected = match ends.map(side) {
            [0, 0] => share * of_left + (1.0 - share) * of_right,
            [a, b] if a * b < 0 => 1.0 / (part / of_left + (1.0 - part) / of_right),
            [a, b] if a + b < 0 => of_left,
            _ => of_right,
        };
        let found = density(&bench, bond);
        // Lengths are found on cells, here by the positions of points: both differ by up to 1e-9.
        assert!(
            relative_error(found, expected) < 1e-8,
            "{ends:?}: {found} {expected} {part}"
        );
        let mean =
            |part: f64| part * energy(&left, bond) + (1.0 - part) * energy(&right_at_smaller, bond);
        let expected = match ends.map(side) {
            [0, 0] => mean(share),
            [a, b] if a * b < 0 => mean(part),
            [a, b] if a + b < 0 => energy(&left, bond),
            _ => energy(&right, bond),
        };
        let found = energy(&bench, bond);
        assert!(
            relative_error(found, expected) < 1e-8,
            "{ends:?}: {found} {expected}"
        );
        let sides = ends.map(side);
        across += usize::from(sides[0] * sides[1] < 0);
        at_interface += usize::from(sides[0] * sides[1] == 0);
    }
    assert!(
        across > 20 && at_interface > 20,
        "bonds cross the interface and end at it"
    );
    assert!(
        energy(&right, 0) > 1.3 * energy(&left, 0),
        "the materials differ in strength"
    );
}

/// Two materials of the same properties are one material: every number agrees to rounding of volumes added in two parts.
#[test]
fn equal_materials_are_one() {
    let equal = TWO
        .replace("60e9", "15e9")
        .replace("0.3", "0.21")
        .replace("8e6", "3e6");
    let two = Bench::new(&format!("{BREAKING}{BAR}{equal}"), &[]);
    let one = Bench::new(
        &format!(
            "{BREAKING}{BAR}material = {{ young = 15e9, poisson = 0.21, tensile_strength = 3e6 }}\n"
        ),
        &[],
    );
    let (a, b) = (two.solve(), one.solve());
    let numbers = [
        deviation(
            &two.model.plane().rigidities.axial,
            &one.model.plane().rigidities.axial,
        ),
        deviation(
            &two.model.plane().rigidities.shear,
            &one.model.plane().rigidities.shear,
        ),
        deviation(two.limits(), one.limits()),
        deviation(a.displacement(), b.displacement()),
        relative_error(a.last().reaction, b.last().reaction),
    ];
    println!(
        "equal materials: rigidities, s_0, u, reaction differ by {}",
        short(&numbers)
    );
    assert!(largest(numbers) < 1e-11);
    let different = Bench::new(&format!("{BAR}{TWO}"), &[]).solve();
    assert!(deviation(different.displacement(), b.displacement()) > 0.1);
}

/// Two bodies that lie on each other are none: their outlines cross.
#[test]
fn bodies_on_top_of_each_other_are_refused() {
    let mut mesh = meshes::lattice(4, 0.25, [0.0; 2]);
    let other = meshes::lattice(4, 0.25, [0.1, 0.3]);
    let first = mesh.positions.len() as u32;
    let moved = other.cells.iter().map(|cell| match *cell {
        Cell::Triangle(corners) => Cell::Triangle(corners.map(|node| node + first)),
        Cell::Quadrangle(corners) => Cell::Quadrangle(corners.map(|node| node + first)),
    });
    mesh.cells.extend(moved);
    mesh.positions.extend(other.positions);
    mesh.node_tags = (1..=mesh.positions.len() as u64).collect();
    mesh.groups.clear();
    let setup = Setup::new(
        MeshBody::from(mesh),
        Material::isotropic(1.0, 0.2),
        Law::NHPD,
    );
    let error = Model::build(setup, &mut ()).unwrap_err().to_string();
    assert!(
        error.starts_with("body: cells of the mesh overlap"),
        "{error}"
    );
}

/// The faces of a slot of a ten-thousandth of the mesh size keep the horizons of the mesh, and no bond joins them.
#[test]
fn a_thin_slot_does_not_shrink_horizons() {
    let whole = meshes::lattice(8, 0.125, [0.0; 2]);
    let gap = 0.125e-4;
    let mut mesh = whole.clone();
    // Nodes of the middle column above the middle of the body stand twice, those of the cells on their right to the right.
    let on_slot = |node: u32| {
        let [x, y] = whole.positions[node as usize];
        (x - 0.5).abs() < 1e-9 && y > 0.5 + 1e-9
    };
    let mut copies = std::collections::BTreeMap::new();
    for node in (0..whole.positions.len() as u32).filter(|&node| on_slot(node)) {
        let [x, y] = whole.positions[node as usize];
        copies.insert(node, mesh.positions.len() as u32);
        mesh.positions.push([x + gap, y]);
    }
    for cell in &mut mesh.cells {
        let is_right = cell
            .corners()
            .iter()
            .any(|&node| whole.positions[node as usize][0] > 0.5 + 1e-9);
        let copy = |node: u32| {
            copies
                .get(&node)
                .copied()
                .filter(|_| is_right)
                .unwrap_or(node)
        };
        *cell = match *cell {
            Cell::Triangle(corners) => Cell::Triangle(corners.map(copy)),
            Cell::Quadrangle(corners) => Cell::Quadrangle(corners.map(copy)),
        };
    }
    mesh.node_tags = (1..=mesh.positions.len() as u64).collect();
    mesh.groups.clear();
    let setup = |through: bool| {
        let body = MeshBody::from(mesh.clone());
        let mut setup = Setup::new(body, Material::isotropic(1.0, 0.2), Law::NHPD);
        setup.bonds_through_voids = through;
        Model::build(setup, &mut ())
    };
    let model = setup(false).unwrap();
    let least = |model: &Model| {
        model
            .plane()
            .cloud
            .spacing
            .iter()
            .copied()
            .fold(f64::INFINITY, f64::min)
    };
    assert!(
        relative_error(least(&model), 0.125 - gap) < 1e-9,
        "{}",
        least(&model)
    );
    let numbering = model.body().numbering();
    let in_file = |ends: &[u32; 2]| numbering.ends_in_file(*ends);
    let across = (model.plane().bonds.ends.iter().map(in_file)).filter(|ends| {
        let of = |node: &u32| copies.contains_key(node) || copies.values().any(|copy| copy == node);
        let [a, b] = ends.map(|end| mesh.positions[end as usize]);
        ends.iter().all(of) && (a[0] - b[0]).abs() > 0.5 * gap
    });
    assert_eq!(across.count(), 0);
    assert!(
        copies.len() == 4 && model.across_voids() > 20,
        "{}",
        model.across_voids()
    );
    assert!(relative_error(least(&setup(true).unwrap()), gap) < 1e-6);
}

/// A ring keeps its hole: every pair within a horizon whose straight line comes nearer to the middle than the polygon of the inner
/// outline is no bond, unless it is asked for, and all others are. The polygon is nearer than its corners by r (1 - cos(half its angle)).
#[test]
fn no_bond_runs_through_a_void() {
    let text = r#"
mesh = { file = "../meshes/annulus-coarse.msh", thickness = 0.05 }
material = { young = 65.8e9, poisson = 0.2 }
model = { law = "nhpd", horizon_factor = 4.0 }
load = [{ group = "inside", pressure = 1.0 }]
"#;
    let inside = Bench::new(text, &[]).model;
    let across = Bench::new(text, &["model.bonds_through_voids=true"]).model;
    assert_eq!(across.across_voids(), 0);
    let places = &across.plane().cloud.positions;
    let nearest = |ends: &[u32; 2]| {
        let [a, b] = ends.map(|end| places[end as usize]);
        let along = [b[0] - a[0], b[1] - a[1]];
        let square = along[0].powi(2) + along[1].powi(2);
        let foot = (-(a[0] * along[0] + a[1] * along[1]) / square).clamp(0.0, 1.0);
        (a[0] + foot * along[0]).hypot(a[1] + foot * along[1])
    };
    let on_rim = places.iter().filter(|p| p[0].hypot(p[1]) < 0.1 + 1e-6);
    let inner = 0.1 * (std::f64::consts::PI / on_rim.count() as f64).cos();
    let kept: Vec<[u32; 2]> = inside.plane().bonds.ends.to_vec();
    assert!(kept.iter().all(|ends| nearest(ends) > inner - 1e-9));
    let lost: Vec<[u32; 2]> = (across.plane().bonds.ends.iter().copied())
        .filter(|ends| !kept.contains(ends))
        .collect();
    assert_eq!(lost.len(), inside.across_voids());
    assert!(lost.len() > 50, "{} pairs", lost.len());
    assert!(lost.iter().all(|ends| nearest(ends) < 0.1 - 1e-9));
    assert_eq!(lost.len() + kept.len(), across.plane().bonds.len());
}
