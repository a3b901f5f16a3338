//! Bodies on a regular lattice: what their points and bonds must be, and that they behave as a mesh with the same points.
#![allow(clippy::unwrap_used)]

use std::collections::BTreeSet;
use std::f64::consts::PI;

use ligament_mesh::{Cell, Mesh};
use ligament_model::bonds::hole::bonds_across;
use ligament_model::{BondSet, Horizons, Lattice, PointCloud, Shape};
use verification::bench::{Bench, Run};
use verification::numbers::{deviation, largest, relative_error};

fn cloud_of(lattice: &Lattice) -> PointCloud {
    PointCloud::from_lattice(lattice, 0.02, &vec![0; lattice.cells.len()], 1)
}

fn whole(size: [u32; 2], spacing: [f64; 2]) -> Lattice {
    Lattice::new(size, spacing, [0.3, -7.0], Vec::new())
}

/// Offsets (i, j) between cells whose distance is at most `reach`, one of each pair of opposite ones.
fn half_of_offsets(spacing: [f64; 2], reach: f64) -> Vec<[i64; 2]> {
    let within = |&[i, j]: &[i64; 2]| {
        let (x, y) = (i as f64 * spacing[0], j as f64 * spacing[1]);
        x * x + y * y <= reach * reach * (1.0 + 1e-9)
    };
    (0..=9)
        .flat_map(|j| (-9..=9).map(move |i| [i, j]))
        .filter(|&[i, j]| j > 0 || i > 0)
        .filter(within)
        .collect()
}

/// A point inside has 12, 28, 36, 48 or 80 bonds for a horizon of 2, 3, 3.2, 4 or 5 spacings (MPPD, section 3); of an offset
/// (i, j) there are (nx - |i|)(ny - |j|) bonds in all. Volumes, nearest distances and sizes are those of the cells. The spacing is
/// no binary number and the corner lies far out, so that rounding could decide about bonds as long as the horizon.
#[test]
fn families_and_bonds_are_counted_in_closed_form() {
    for (m, family) in [(2.0, 12), (3.0, 28), (3.2, 36), (4.0, 48), (5.0, 80)] {
        for spacing in [[0.0007, 0.0007], [0.0007, 0.0011], [0.3, 0.1]] {
            let lattice = whole([21, 17], spacing);
            let cloud = cloud_of(&lattice);
            let [dx, dy] = spacing;
            let nearest = dx.min(dy);
            assert!(cloud.spacing.iter().all(|&it| it == nearest));
            assert!(cloud.volumes.iter().all(|&it| it == dx * dy * 0.02));
            assert_eq!(cloud.cell_size(5), spacing);
            assert_eq!(cloud.squared_gyration(5), (dx * dx + dy * dy) / 12.0);

            let bonds = BondSet::search(&cloud, &Horizons::from_spacing(&cloud.spacing, m));
            let count = |[i, j]: [i64; 2]| ((21 - i.abs()) * (17 - j.abs())).max(0) as usize;
            let offsets = half_of_offsets(spacing, m * nearest);
            let expected: usize = offsets.iter().map(|&offset| count(offset)).sum();
            assert_eq!(bonds.len(), expected, "m = {m}, {spacing:?}");
            let middle = bonds.incidence.at(8 * 21 + 10).len();
            assert_eq!(middle, 2 * offsets.len(), "m = {m}, {spacing:?}");
            assert!(dx != dy || middle == family, "m = {m}");
            let unified = Horizons::unified(m * nearest, cloud.len());
            assert_eq!(BondSet::search(&cloud, &unified).ends, bonds.ends);
        }
    }
}

/// A slit between two rows takes no cell but all pairs across it: j (nx - |i|) for each offset (i, j). It may be as thin as
/// one likes, and it may lie along the rim of cells that a rectangle removes.
#[test]
fn a_slit_takes_the_pairs_across_it() {
    for height in [1e-6, 1e-3, 1e-2] {
        let at = 0.5 * 0.01 * 12.0;
        let slit = Shape::rectangle([[-1.0, at - 0.5 * height], [1.0, at + 0.5 * height]]);
        let lattice = Lattice::new([14, 12], [0.01; 2], [0.0; 2], vec![slit]);
        let removed = if height < 0.01 { 0 } else { 28 };
        assert_eq!(
            lattice.cells.len(),
            14 * 12 - removed,
            "the rim belongs to it"
        );
        let cloud = cloud_of(&lattice);
        let bonds = BondSet::search(&cloud, &Horizons::from_spacing(&cloud.spacing, 3.0));
        let across = bonds_across(&lattice.holes, &bonds, &cloud);
        let across = across.iter().filter(|it| **it).count() as i64;
        let offsets = half_of_offsets([1.0; 2], 3.0);
        // Two removed rows leave of the offset (i, j) the pairs that stand j - 2 rows apart.
        let rows = removed as i64 / 14;
        let pairs = |&[i, j]: &[i64; 2]| (j - rows).max(0) * (14 - i.abs());
        let expected: i64 = offsets.iter().map(pairs).sum();
        assert!(expected > 0);
        assert_eq!(across, expected, "height {height}");
    }
}

/// A round hole: cells and pairs against the discriminant of the quadratic equation of line and circle.
#[test]
fn a_round_hole_takes_its_cells_and_the_pairs_across_it() {
    let (centre, mut found) = ([0.617, 0.3517], 0);
    for radius in [0.02, 0.049, 0.1, 0.173] {
        let hole = Shape::Circle { centre, radius };
        let lattice = Lattice::new([60, 40], [0.02; 2], [0.0; 2], vec![hole]);
        let places: Vec<[f64; 2]> = (0..40)
            .flat_map(|j| {
                (0..60).map(move |i| [0.02 * f64::from(i) + 0.01, 0.02 * f64::from(j) + 0.01])
            })
            .map(|[x, y]| [x - centre[0], y - centre[1]])
            .filter(|[x, y]| x * x + y * y > radius * radius)
            .collect();
        assert_eq!(lattice.cells.len(), places.len());
        let cloud = cloud_of(&lattice);
        let bonds = BondSet::search(&cloud, &Horizons::from_spacing(&cloud.spacing, 4.0));
        let across = bonds_across(&lattice.holes, &bonds, &cloud);
        for (bond, &[a, b]) in bonds.ends.iter().enumerate() {
            let ([x, y], [u, v]) = (places[a as usize], places[b as usize]);
            let [p, q] = [u - x, v - y];
            let (square, half) = (p * p + q * q, x * p + y * q);
            let discriminant = half * half - square * (x * x + y * y - radius * radius);
            let expected = discriminant > 0.0 && -half > 0.0 && -half < square;
            assert_eq!(across[bond], expected, "{:?} {:?}", [x, y], [u, v]);
            found += usize::from(expected);
        }
    }
    assert!(found > 20, "{found} pairs across holes");
}

/// What the laws say of a point inside, added up directly: bonds that only resist stretch, c = 9 E/(pi t delta^3) at nu = 1/3,
/// have in a strain along x the energy (1/4) sum of c cos^4 l V over the family, against E/(2 (1 - nu^2)). 1e-12: rounding of
/// some ten terms.
#[test]
fn energy_inside_is_the_sum_over_the_family() {
    let text = r#"
lattice = { cells = [15, 13], spacing = [0.002, 0.003], thickness = 0.05, set = { left = { left = 1 }, right = { right = 1 } } }
material = { young = 7e9, poisson = 0.3333333333333333 }
model = { law = "bbpd", horizon = 0.0081, calibration = "integral" }
correction = { alpha = "none", surface = "none" }
support = [{ group = "left", displacement = { x = 0.0, y = 0.0 } }]
load = [{ group = "right", displacement = { x = 1e-5 } }]
"#;
    let bench = Bench::new(text, &[]);
    let (delta, volume): (f64, f64) = (0.0081, 0.002 * 0.003 * 0.05);
    let c = 9.0 * 7e9 / (PI * 0.05 * delta.powi(3));
    let energy: f64 = half_of_offsets([0.002, 0.003], delta)
        .iter()
        .map(|&[i, j]| {
            let (x, y) = (0.002 * i as f64, 0.003 * j as f64);
            let l = x.hypot(y);
            2.0 * 0.25 * c * (x / l).powi(4) * l * volume
        })
        .sum();
    let expected = energy / (7e9 / (2.0 * (1.0 - 1.0 / 9.0)));
    let found = bench.model.fixed.energy_ratios[0].at_points[6 * 15 + 7];
    assert!(
        relative_error(found, expected) < 1e-12,
        "{found} {expected}"
    );
}

/// Squares of four nodes each, one beside the other with the same distance between them: nodes as the points of a lattice of
/// spacing `side`, each with a quarter of its square.
fn scattered_squares(columns: u32, rows: u32, side: f64) -> Mesh {
    let node = |i: u32, j: u32| j * columns + i;
    let squares = (0..rows / 2).flat_map(|j| (0..columns / 2).map(move |i| (2 * i, 2 * j)));
    Mesh {
        node_tags: (1..=u64::from(columns * rows)).collect(),
        positions: (0..rows)
            .flat_map(|j| (0..columns).map(move |i| [i, j]))
            .map(|cell| cell.map(|k| (f64::from(k) + 0.5) * side))
            .collect(),
        cells: squares
            .map(|(i, j)| {
                let corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)];
                Cell::Quadrangle(corners.map(|(i, j)| node(i, j)))
            })
            .collect(),
        groups: Vec::new(),
        fields: Vec::new(),
        remarks: Vec::new(),
    }
}

/// What the lattice and the mesh of the next test have in common.
const TORN: &str = r#"
material = { young = 15e9, poisson = 0.21, tensile_strength = 3.81e6 }
model = { law = "nhpd", horizon_factor = 3.0 }
correction = { tolerance = 1e-10, max_sweeps = 5000 }
precrack = [{ points = [[-0.1, 0.035], [0.0301, 0.035]] }]
support = [{ box = [[0.0, 0.0], [1.0, 0.0025]], displacement = { x = 0.0, y = 0.0 } }]
load = [{ box = [[0.0, 0.0675], [1.0, 0.0725]], displacement = { y = 1e-4 } }]
fracture = { control = "event", stop = { bonds = 40 } }
"#;

/// A lattice and a mesh of scattered squares with the same points: with four times the thickness the mesh's nodes have the
/// volumes of the cells. Omega makes up for the thickness in the law's constants, so that everything else is the same:
/// displacements, the order of breaking, the loads. Boxes end exactly on rows of points. 1e-9: the sweeps of the correction,
/// rounded differently, and the residual of the solutions.
#[test]
fn a_lattice_is_the_mesh_with_the_same_points_and_volumes() {
    let lattice =
        format!("lattice = {{ cells = [16, 14], spacing = 0.005, thickness = 0.01 }}\n{TORN}");
    let lattice = Bench::new(&lattice, &[]);
    let mesh = format!("mesh = {{ file = \"\", thickness = 0.04 }}\n{TORN}");
    let mesh = Bench::on(
        &scattered_squares(16, 14, 0.005),
        &mesh,
        &["model.bonds_through_voids=true"],
    );
    let (one, other) = (&lattice.model, &mesh.model);
    let ends = |bench: &Bench| -> Vec<[u32; 2]> {
        let bonds = bench.bonds_in_file().into_iter();
        bonds.map(|bond| bench.nodes_of_bond(bond)).collect()
    };
    assert_eq!(*one.plane().bonds.ends, ends(&mesh));
    assert!(one.cut_bonds() > 0 && one.cut_bonds() == other.cut_bonds());
    let volumes = mesh.in_file(&other.plane().cloud.volumes);
    assert!(deviation(&one.plane().cloud.volumes, &volumes) < 1e-12);
    let omega = |bench: &Bench| bench.of_bonds(&bench.model.fixed.domain_factor);
    let quarter: Vec<f64> = omega(&mesh).iter().map(|omega| 0.25 * omega).collect();
    assert!(deviation(&omega(&lattice), &quarter) < 1e-9);

    let (one, other) = (lattice.solve(), mesh.solve());
    let moved = mesh.in_file(other.displacement());
    assert!(deviation(one.displacement(), &moved) < 1e-9);
    let (one, other) = (lattice.break_up(), mesh.break_up());
    let broken = |bench: &Bench, run: &Run| -> Vec<(usize, [u32; 2])> {
        let breaks = run.breaks.iter();
        breaks
            .map(|it| (it.step, bench.nodes_of_bond(it.bond)))
            .collect()
    };
    assert!(broken(&lattice, &one).len() >= 40);
    assert_eq!(broken(&lattice, &one), broken(&mesh, &other));
    let reactions =
        |run: &Run| -> Vec<f64> { run.outcome.history.iter().map(|it| it.reaction).collect() };
    assert!(deviation(&reactions(&one), &reactions(&other)) < 1e-9);
}

/// A plate with a crack in its middle, pulled at both ends, is the same seen from the other side: bonds break in pairs that
/// are each other's image in the line x = 0, and their number is that of both tips.
#[test]
fn a_cracked_lattice_breaks_symmetrically() {
    let text = r#"
[lattice]
cells = [32, 30]
spacing = 0.003
corner = [-0.048, -0.045]
set = { bottom = { bottom = 3 }, top = { top = 3 } }
[material]
young = 15e9
poisson = 0.21
tensile_strength = 3.81e6
[model]
law = "nhpd"
horizon_factor = 3.0
[[precrack]]
points = [[-0.0151, 0.0], [0.0151, 0.0]]
[[support]]
group = "bottom"
displacement = { x = 0.0, y = 0.0 }
[[load]]
group = "top"
displacement = { x = 0.0, y = 1e-4 }
[fracture]
control = "event"
stop = { bonds = 60 }
"#;
    let bench = Bench::new(text, &[]);
    let run = bench.break_up();
    let image = |point: u32| 32 * (point / 32) + 31 - point % 32;
    let bonds = &bench.model.plane().bonds;
    let broken: BTreeSet<[u32; 2]> = (run.breaks.iter())
        .map(|it| bonds.ends[it.bond as usize])
        .collect();
    assert!(broken.len() >= 60);
    for &[a, b] in &broken {
        let mut ends = [image(a), image(b)];
        ends.sort_unstable();
        assert!(broken.contains(&ends), "{a} {b}");
    }
    let right = |ends: &&[u32; 2]| ends.map(|end| end % 32 > 15) == [true; 2];
    assert_eq!(2 * broken.iter().filter(right).count(), broken.len());
    // Seen from the other side u_x changes its sign.
    let u = run.displacement();
    let mirrored: Vec<f64> = (0..bench.points() as u32)
        .flat_map(|point| {
            let there = 3 * image(point) as usize;
            [-u[there], u[there + 1], -u[there + 2]]
        })
        .collect();
    assert!(
        deviation(&mirrored, u) < 1e-8,
        "{:e}",
        deviation(&mirrored, u)
    );
}

/// A force per length on rows and columns: each point of n rows takes dx/n of it, the total is that on the side; what other
/// sets hold has no length. The force goes through every section (1e-9: equilibrium). A force in total is the same on both.
#[test]
fn rows_and_columns_have_a_length() {
    let text = r#"
lattice = { cells = [30, 12], spacing = [0.002, 0.003], thickness = 0.01, set = { right = { right = 3 }, top = { top = 2 }, spot = { circle = { centre = [0.03, 0.018], radius = 0.006 } } } }
material = { young = 15e9, poisson = 0.21 }
model = { law = "nhpd", horizon_factor = 3.0 }
support = [{ box = [[0.0, 0.0], [0.004, 0.02]], displacement = { x = 0.0, y = 0.0 } }]
load = [
    { group = "right", force_per_length = { x = 1e4 } },
    { group = "top", force_per_length = { y = 5e3 } },
    { name = "all", group = "spot", force = { x = 30.0 } },
]
probe = [{ name = "middle", section = [[0.04, -1.0], [0.04, 1.0]], component = "x" }]
"#;
    let bench = Bench::new(text, &[]);
    let run = bench.solve();
    let size = |name: &str| bench.group(name).len();
    assert_eq!([size("right"), size("top")], [36, 60]);
    // Centres within 6 mm: the circle is drawn around a corner of the cells.
    let near = |i: f64, j: f64| (0.002 * (i + 0.5)).hypot(0.003 * (j + 0.5)) <= 0.006;
    let quarter = (0..4)
        .flat_map(|i| (0..4).map(move |j| (f64::from(i), f64::from(j))))
        .filter(|&(i, j)| near(i, j))
        .count();
    assert_eq!(size("spot"), 4 * quarter);
    let force = |name: &str| run.group_force(&bench, name);
    for (name, expected) in [
        ("right", [360.0, 0.0]),
        ("top", [0.0, 300.0]),
        ("all", [30.0, 0.0]),
        ("support-1", [-390.0, -300.0]),
    ] {
        let found = force(name);
        let near = (0..2).all(|axis| (found[axis] - expected[axis]).abs() < 1e-6);
        assert!(near, "{name}: {found:?}");
    }
    assert!(relative_error(run.last().probes[0], 360.0) < 1e-9);
    let at_right: Vec<f64> = (bench.group("right").iter())
        .map(|&point| run.displacement()[3 * point as usize])
        .collect();
    assert!(largest(at_right) > 0.0);
    let case =
        verification::bench::case(text, &["load.2={group=\"spot\", force_per_length={x=1.0}}"]);
    let setup = case.setup_on(bench.model.setup.body.clone()).unwrap();
    let error = ligament::Loading::new(&ligament::Model::build(setup, &mut ()).unwrap());
    let error = error.unwrap_err().to_string();
    assert!(error.contains("this group has no length"), "{error}");
}

/// Bonds of n x n cells on a plate of 100 mm at m = 3 that a crack on its axis from -a to a meets, without and with those that
/// only touch its ends; lengths in quarters of a millimetre, so that all is whole numbers.
fn met_by_a_crack(n: i64, half_length: i64) -> [usize; 2] {
    let d = 400 / n;
    let at = |k: i64| (2 * k - n + 1) * d / 2;
    let mut met = [0; 2];
    for [p, q] in half_of_offsets([1.0; 2], 3.0) {
        for column in 0..n {
            for row in 0..n - q {
                let (below, above) = (at(row), at(row + q));
                if !(0..n).contains(&(column + p)) || below >= 0 || above <= 0 {
                    continue;
                }
                // The axis is crossed at x - p d y/(q d).
                let crossing = (at(column) * q - p * below).abs();
                met[0] += usize::from(crossing < half_length * q);
                met[1] += usize::from(crossing <= half_length * q);
            }
        }
    }
    met
}

/// A crack of 10 mm in the middle of a plate of 100 mm, between two rows, with and without the bonds through its ends, against
/// whole numbers; across the whole plate it cuts q (n - |p|) bonds of the offset (p, q): 882 at 2 mm, 1782 at 1 mm.
#[test]
fn a_crack_with_its_ends_cuts_what_meets_it() {
    for (n, cut, across) in [(50, [82, 98], 882), (100, [174, 186], 1782)] {
        let spacing = 0.1 / n as f64;
        let count = |half_length: f64, ends: &str| {
            let text = format!(
                "lattice = {{ cells = [{n}, {n}], spacing = {spacing:?}, corner = [-0.05, -0.05], set = {{ top = {{ top = 3 }}, \
                 bottom = {{ bottom = 3 }} }} }}\n\
                 material = {{ young = 65.8e9, poisson = 0.3 }}\nmodel = {{ law = \"pds\", horizon_factor = 3.0 }}\n\
                 support = [{{ group = \"bottom\", displacement = {{ x = 0.0, y = 0.0 }} }}]\n\
                 load = [{{ group = \"top\", displacement = {{ y = 1e-4 }} }}]\n\
                 precrack = [{{ points = [[{:?}, 0.0], [{half_length:?}, 0.0]], ends = \"{ends}\" }}]\n",
                -half_length
            );
            Bench::new(&text, &[]).model.cut_bonds()
        };
        // Without its ends a crack from 0.1 um before them: bonds through them pass it, however their coordinates are rounded.
        let found = [count(0.005 - 1e-7, "excluded"), count(0.005, "included")];
        assert_eq!(found, met_by_a_crack(n, 20));
        assert_eq!(found, cut);
        assert_eq!(count(0.06, "included"), across);
    }
}
