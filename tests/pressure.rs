//! Pressure on the outline of meshes and lattices: statics, the work that it does, and its faults.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

use std::collections::BTreeMap;
use std::f64::consts::PI;

use ligament::Loading;
use ligament_mesh::Group;
use ligament_run::summary::write;
use verification::bench::{self, Bench};
use verification::meshes;
use verification::numbers::relative_error;

/// Ring of radii 0.1 and 0.2 m in plane strain; each test brings its loads along.
const RING: &str = r#"
mesh = { file = "../meshes/annulus-coarse.msh", thickness = 0.05, plane = "strain" }
material = { young = 65.8e9, poisson = 0.2 }
model = { law = "nhpd", horizon_factor = 3.0 }
"#;

/// The forces of a bench over p t, by its points that have one: outward normals times lengths, m.
fn normals(bench: &Bench, per_length: f64) -> BTreeMap<usize, [f64; 2]> {
    let forces = bench.boundary.force.chunks(3).enumerate();
    let outward = |force: &[f64]| [-force[0] / per_length, -force[1] / per_length];
    let loaded = forces.filter(|(_, force)| force.iter().any(|value| *value != 0.0));
    loaded
        .map(|(point, force)| (point, outward(force)))
        .collect()
}

/// Sums of n, of x times n and of x . n over the points, with the normals n (m) and the positions x: resultant, moment
/// and twice the area that they enclose.
fn sums(bench: &Bench, normals: &BTreeMap<usize, [f64; 2]>) -> [f64; 4] {
    normals.iter().fold([0.0; 4], |sum, (&point, n)| {
        let [x, y] = bench.positions()[point];
        let more = [n[0], n[1], x * n[1] - y * n[0], x * n[0] + y * n[1]];
        [0, 1, 2, 3].map(|k| sum[k] + more[k])
    })
}

/// A pressure on a closed curve has neither resultant nor moment, to the rounding of some hundred terms of 1e-2 m (1e-15
/// each): on the polygon of straight edges both sums are exact. By Gauss the sum of x . n is twice the area inside: what both
/// curves enclose is that of the cells.
#[test]
fn a_closed_curve_has_no_resultant() {
    let one = |group: &str| {
        let load = format!("load = [{{ group = \"{group}\", pressure = 3e6 }}]\n");
        Bench::new(&format!("{RING}{load}"), &[])
    };
    let mut area = 0.0;
    for (group, sign) in [("inside", -1.0), ("outside", 1.0)] {
        let bench = one(group);
        let normals = normals(&bench, 3e6 * 0.05);
        assert_eq!(normals.len(), bench.group(group).len());
        let [x, y, moment, twice] = sums(&bench, &normals);
        println!("{group}: {x:.1e} {y:.1e} m, {moment:.1e} m^2");
        assert!(x.abs() < 1e-13 && y.abs() < 1e-13 && moment.abs() < 1e-14);
        assert!(sign * twice > 0.0, "outward is away from the cells");
        for (&point, n) in &normals {
            // Nodes lie on the circle, about equally far from each other: the normal of a node is a radius.
            let [p, q] = bench.positions()[point];
            let radius = p.hypot(q);
            let along = sign * (p * n[0] + q * n[1]) / (radius * n[0].hypot(n[1]));
            assert!(along > 0.999, "{p} {q}: {along}");
        }
        area += 0.5 * twice;
    }
    let mesh = meshes::read("meshes/annulus-coarse.msh");
    assert!(relative_error(area, mesh.area()) < 1e-12);
}

/// A straight side of edges of length h under a pressure that grows from zero: the integrals of the shape functions times the pressure.
#[test]
fn an_edge_gives_each_node_the_integral_of_its_shape_function() {
    let mesh = meshes::lattice(4, 0.25, [1.0, -3.0]);
    let text = r#"
mesh = { file = "other", thickness = 0.5 }
material = { young = 15e9, poisson = 0.21 }
model = { law = "nhpd", horizon_factor = 3.0 }
support = [{ group = "bottom", displacement = { x = 0.0, y = 0.0 } }]
load = [{ group = "top", pressure = 8.0, profile = { along = "x", zero = 1.0, one = 2.0 } }]
"#;
    let bench = Bench::on(&mesh, text, &[]);
    // Of p t h = 1 N an edge with the factors a and b gives (2 a + b)/6 to the node of a.
    let forces = bench.in_file(&bench.boundary.force);
    for (node, expected) in [
        (20, -1.0 / 24.0),
        (21, -0.25),
        (22, -0.5),
        (23, -0.75),
        (24, -11.0 / 24.0),
    ] {
        let force = &forces[3 * node..3 * node + 3];
        assert!(force[0] == 0.0 && force[2] == 0.0);
        assert!(
            (force[1] - expected).abs() < 1e-15,
            "node {node}: {force:?}"
        );
    }
    assert_eq!(bench.boundary.control.magnitude, 8.0);
}

/// A lattice of 12 x 11 cells of 2 x 3 mm with a rectangular hole of 3 x 2 cells, a round one, and a notch of two cells in its
/// right side. Forces counted by hand: p t dy on faces along y, p t dx on those along x.
const STAIRCASE: &str = r#"
material = { young = 15e9, poisson = 0.21 }
model = { law = "nhpd", horizon_factor = 3.0 }
[lattice]
cells = [12, 11]
spacing = [0.002, 0.003]
thickness = 0.5
[[lattice.remove]]
name = "slot"
rectangle = [[0.004, 0.006], [0.010, 0.012]]
[[lattice.remove]]
name = "bore"
circle = { centre = [0.012, 0.021], radius = 0.0051 }
[[lattice.remove]]
rectangle = [[0.023, 0.006], [0.025, 0.012]]
[lattice.set]
left = { left = 2 }
right = { right = 3 }
top = { top = 1 }
bottom = { bottom = 1 }
notch = { box = [[0.020, 0.004], [0.024, 0.014]] }
"#;

fn pressed(groups: &[&str]) -> Bench {
    let load = |group: &&str| format!("[[load]]\ngroup = \"{group}\"\npressure = 1e6\n");
    let loads: String = groups.iter().map(load).collect();
    Bench::new(&format!("{STAIRCASE}{loads}"), &[])
}

/// Faces of the cells beside the rectangular hole, whose centre lies at (0.007, 0.009), and of the rows of the sides: only
/// those on the rectangle, in the outermost row, have a face.
#[test]
fn a_face_towards_a_hole_belongs_to_it() {
    let near = |[x, y]: [f64; 2], [a, b]: [f64; 2]| (x - a).abs() < 1e-12 && (y - b).abs() < 1e-12;
    let bench = pressed(&["slot"]);
    let mut found = 0;
    for (point, n) in normals(&bench, 1e6 * 0.5) {
        let [x, y] = bench.positions()[point];
        let (beside, above) = ((x - 0.007).abs() > 0.003, (y - 0.009).abs() > 0.003);
        assert!(beside != above, "no cell at a corner: {x} {y}");
        let outward = [(0.007 - x).signum() * 0.003, (0.009 - y).signum() * 0.002];
        let expected = if beside {
            [outward[0], 0.0]
        } else {
            [0.0, outward[1]]
        };
        assert!(near(n, expected), "{x} {y}: {n:?}");
        found += 1;
    }
    assert_eq!(found, 2 * (3 + 2));
    assert_eq!(
        bench.group("slot").len(),
        found,
        "the group is the cells at its rim"
    );

    for (group, count, expected) in [
        ("left", 11, [-0.003, 0.0]),
        // Two of its eleven faces are at the notch, whose cells have other ones behind them.
        ("right", 9, [0.003, 0.0]),
        ("top", 12, [0.0, 0.002]),
        ("bottom", 12, [0.0, -0.002]),
    ] {
        let normals = normals(&pressed(&[group]), 1e6 * 0.5);
        assert_eq!(normals.len(), count, "{group}");
        assert!(normals.values().all(|&n| near(n, expected)), "{group}");
    }
    // All faces of the cells of a set: the notch with its back and its two flanks, and the side of one cell above and below.
    let normals = normals(&pressed(&["notch"]), 1e6 * 0.5);
    let sum = |axis: usize| normals.values().map(|n| n[axis].abs()).sum::<f64>();
    assert!(relative_error(sum(0), 4.0 * 0.003) < 1e-12);
    assert!(relative_error(sum(1), 2.0 * 0.002) < 1e-12);
}

/// Staircases are closed: no resultant, no moment, and twice the area of the removed cells, or of the body where all of its
/// outline is under pressure. A pressure of different signs at different sides does the same to each.
#[test]
fn staircases_are_closed() {
    for (groups, cells) in [
        (vec!["slot"], -6.0),
        (vec!["bore"], -12.0),
        (
            vec!["slot", "bore", "left", "right", "top", "bottom", "notch"],
            f64::NAN,
        ),
    ] {
        let bench = pressed(&groups);
        let mut normals = normals(&bench, 1e6 * 0.5);
        let mut expected = cells;
        if cells.is_nan() {
            // `right` and `notch` both have the faces of the two cells above and below the notch.
            for point in bench.group("right") {
                let [x, y] = bench.positions()[point as usize];
                let twice = x > 0.022 && [0.0045, 0.0135].iter().any(|it| (y - it).abs() < 1e-9);
                if twice {
                    normals.get_mut(&(point as usize)).unwrap()[0] -= 0.003;
                }
            }
            expected = bench.points() as f64;
        }
        let [x, y, moment, twice] = sums(&bench, &normals);
        assert!(
            x.abs() < 1e-15 && y.abs() < 1e-15 && moment.abs() < 1e-17,
            "{groups:?}"
        );
        // The centres of cells lie half a cell inside of their faces: of x . n each face is short by half of its cell's area.
        let faces = normals
            .values()
            .map(|n| n[0].abs() / 0.003 + n[1].abs() / 0.002)
            .sum::<f64>();
        let found = (twice / 6e-6 + 0.5 * faces) / 2.0;
        println!("{groups:?}: {found} cells of {expected}");
        assert!(
            (found - expected).abs() < 1e-9,
            "{groups:?}: {found} {expected}"
        );
    }
}

/// With a pressure as first load the history's force is the pressure and its displacement the volume by which the surface gave
/// way: here t times what the shoelace formula gives, to first order, for the polygon of the hole. Their product is twice the
/// stored energy (Clapeyron); 1e-9 to which equilibria are solved. The sign of the pressure is that of the displacements.
#[test]
fn displacement_is_the_volume_swept() {
    let mesh = meshes::read("meshes/annulus-coarse.msh");
    for pressure in [1e8_f64, -1e8] {
        let load = format!("load = [{{ group = \"inside\", pressure = {pressure:?} }}]\n");
        let bench = Bench::new(&format!("{RING}{load}"), &[]);
        let run = bench.solve();
        let displacement = bench.in_file(run.displacement());
        let u = |node: u32| [0, 1].map(|axis| displacement[3 * node as usize + axis]);
        let cross = |a: [f64; 2], b: [f64; 2]| a[0] * b[1] - a[1] * b[0];
        let is_inner = |node: u32| {
            let [x, y] = mesh.positions[node as usize];
            x.hypot(y) < 0.15
        };
        let inner = meshes::rim(&mesh)
            .into_iter()
            .filter(|edge| is_inner(edge[0]));
        let at = |node: u32| mesh.positions[node as usize];
        // The rim has the cells on its left, and so the hole on its right.
        let grown: f64 = inner
            .map(|[p, q]| -0.5 * (cross(at(p), u(q)) + cross(u(p), at(q))))
            .sum();
        let last = run.last();
        println!("{pressure:e} Pa: {:.4e} m^3", last.displacement);
        assert!(relative_error(last.displacement, pressure.signum() * 0.05 * grown) < 1e-9);
        assert!(last.displacement > 0.0 && last.reaction == 1e8);
        assert!(relative_error(last.stored_energy, 0.5 * last.displacement * 1e8) < 1e-9);
        let [x, y, _] = run.group_force(&bench, "inside");
        assert!(
            x.abs() < 1e-6 && y.abs() < 1e-6,
            "no resultant: {x:e} {y:e}"
        );
    }
}

/// A run tells its numbers with their units.
#[test]
fn a_pressure_is_told_in_pascal() {
    let case = bench::case(
        &format!("{RING}load = [{{ group = \"inside\", pressure = 1e8 }}]\n"),
        &[],
    );
    let folder = tempfile::tempdir().unwrap();
    let summary = bench::run_program(&case, &folder.path().join("ring"));
    let mut text = Vec::new();
    write(&summary, &mut text).unwrap();
    let text = String::from_utf8(text).unwrap();
    assert!(text.contains(" TPa/m^3\n"), "{text}");
    assert!(text.contains("100.0 MPa at 902"), "{text}");
    let json = std::fs::read_to_string(folder.path().join("ring/summary.json")).unwrap();
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!(json["units"]["displacement"], "m^3");
    assert_eq!(json["units"]["force"], "Pa");
}

/// A disk cut out of a lattice, its outside a group: the faces are those of cells whose neighbour's centre lies outside, also
/// where that is beyond the rectangle, counted here cell by cell.
#[test]
fn the_outside_of_a_disk_is_a_group() {
    let text = r#"
material = { young = 65.8e9, poisson = 0.2 }
model = { law = "nhpd", horizon_factor = 3.0 }
load = [{ group = "rim", pressure = 1.0 }]
[lattice]
cells = [44, 44]
spacing = 0.1
corner = [-2.2, -2.2]
[[lattice.remove]]
name = "rim"
outside = { centre = [0.0, 0.0], radius = 2.2 }
"#;
    let bench = Bench::new(text, &[]);
    let is_in = |i: i32, j: i32| (f64::from(i) + 0.5).hypot(f64::from(j) + 0.5) < 22.0;
    let cells = (-30..30).flat_map(|j| (-30..30).map(move |i| (i, j)));
    let cells: Vec<(i32, i32)> = cells.filter(|&(i, j)| is_in(i, j)).collect();
    assert_eq!(bench.points(), cells.len());
    assert!(bench.model.across_voids() == 0, "a disk is convex");
    let normals = normals(&bench, 1.0);
    let mut faces = 0;
    for (point, &(i, j)) in cells.iter().enumerate() {
        let side = |di: i32, dj: i32| f64::from(u8::from(!is_in(i + di, j + dj)));
        let expected = [side(1, 0) - side(-1, 0), side(0, 1) - side(0, -1)].map(|it| 0.1 * it);
        let found = normals.get(&point).copied().unwrap_or_default();
        assert!(
            (0..2).all(|axis| (found[axis] - expected[axis]).abs() < 1e-15),
            "{i} {j}"
        );
        faces += usize::from(expected != [0.0; 2]);
    }
    assert_eq!(bench.group("rim").len(), faces);
    assert!(faces as f64 > 2.0 * PI * 22.0 * 0.7, "{faces}");
}

fn fault(bench: &Bench, text: &str, settings: &[&str]) -> String {
    let case = bench::case(text, settings);
    let setup = case.setup_on(bench.model.setup.body.clone()).unwrap();
    let loading = Loading::new(&ligament::Model::build(setup, &mut ()).unwrap());
    case.error_at_key(loading.unwrap_err()).to_string()
}

/// An edge inside the body has cells on both sides, a diagonal of a cell is no edge of one: both are told by their nodes. So
/// is a group without any edge.
#[test]
fn only_the_outline_takes_a_pressure() {
    let mut mesh = meshes::lattice(4, 0.25, [0.0; 2]);
    let group = |name: &str, number: i32, edge: [u32; 2]| Group {
        name: name.to_owned(),
        dimension: 1,
        number,
        nodes: edge.to_vec(),
        edges: vec![edge],
        ..Group::default()
    };
    mesh.groups.push(group("seam", 3, [6, 7]));
    mesh.groups.push(group("across", 4, [6, 12]));
    let mut corner = group("corner", 5, [0, 0]);
    (corner.dimension, corner.nodes, corner.edges) = (0, vec![0], Vec::new());
    mesh.groups.push(corner);
    let text = r#"
mesh = { file = "other" }
material = { young = 15e9, poisson = 0.21 }
model = { law = "nhpd", horizon_factor = 3.0 }
support = [{ group = "bottom", displacement = { x = 0.0, y = 0.0 } }]
load = [{ group = "top", pressure = 8.0 }]
"#;
    let bench = Bench::on(&mesh, text, &[]);
    for (name, message) in [
        (
            "seam",
            "load.0.group: pressures and quiet edges are on the outline of the body, but the edge of this group from node 7 to node 8, around \
             (0.375000, 0.250000), has cells on both sides",
        ),
        (
            "across",
            "load.0.group: pressures and quiet edges are on the outline of the body, but the edge of this group from node 7 to node 13, around \
             (0.375000, 0.375000), is no edge of a cell",
        ),
        (
            "corner",
            "load.0.group: a pressure needs a physical curve on the outline of a mesh, a physical surface of a solid, or cells of a \
             lattice at a side or a hole: this group has no part of the outline",
        ),
    ] {
        let error = fault(&bench, text, &[&format!("load.0.group={name}")]);
        assert!(error.contains(message), "{error}");
    }
    let inner = "lattice.set.middle.box=[[0.012, 0.009], [0.016, 0.012]]";
    let load = "[[load]]\ngroup = \"left\"\npressure = 1.0\n";
    let text = format!("{STAIRCASE}{load}");
    let bench = Bench::new(&text, &[inner]);
    assert_eq!(bench.group("middle").len(), 2);
    let error = fault(&bench, &text, &[inner, "load.0.group=middle"]);
    assert!(
        error.contains("this group has no part of the outline"),
        "{error}"
    );
}

/// A ring bursts: along the exact path and in load steps, each just above a breakage of the exact path, the first bonds break
/// at the same pressure; the measure is proportional to the load (dead load).
#[test]
fn a_ring_bursts_in_both_drivers() {
    let load = "load = [{ group = \"inside\", pressure = 1e8 }]\n";
    let text = RING.replace("poisson = 0.2", "poisson = 0.2, tensile_strength = 60e6") + load;
    let event = "fracture = { control = \"event\", stop = { bonds = 20 } }\n";
    let exact = Bench::new(&format!("{text}{event}"), &[]).break_up();
    let first = &exact.breaks[0];
    assert!(first.load_factor > 0.0 && first.load_factor < 1.0);
    assert!(relative_error(first.reaction, 1e8 * first.load_factor) < 1e-12);
    let steps = format!(
        "fracture = {{ steps = [{:?}, {:?}], stop = {{ bonds = 1 }} }}\n",
        first.load_factor * (1.0 - 1e-6),
        first.load_factor * (1.0 + 1e-6)
    );
    let stepped = Bench::new(&format!("{text}{steps}"), &[]).break_up();
    assert_eq!(stepped.breaks[0].bond, first.bond);
    assert_eq!(stepped.breaks[0].step, 2);
}
