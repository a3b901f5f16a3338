//! The bending test: strips of the thinnest section of a body against cantilevers (Timoshenko) and bars in torsion (Saint-Venant) that the
//! program solves, where it finds the section, and what `ligament check` tells of it.
#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::f64::consts::{FRAC_PI_4, PI};

use ligament::bending_test::{
    BendingTest, MOST_SIDES, Section as Thin, THICK, TOO_STIFF, most_points,
};
use ligament::bending_test::{bending_test, smallest_ligament, thinnest_section};
use ligament::body::SolidMeshBody;
use ligament::prelude::*;
use ligament::setup::{Axis, CrackShape, PreCrack, Surface};
use ligament_case::case::CaseFile;
use ligament_cli::check::{CheckExtent, Lines, check};
use ligament_mesh::{Cell, SolidCell, SolidMesh};
use ligament_model::Canvas;
use ligament_model::correction::patch::Settings;
use verification::bench::{case, mesh_setting};
use verification::solids::block;

const YOUNG: f64 = 10e9;
const POISSON: f64 = 0.21;

/// Height of the strips, a tenth of their length, m.
const HEIGHT: f64 = 0.4;

/// Squares of a box of so many by so many, split along one and the other diagonal in turn, where `inside` says so of their middle.
fn squares(cells: [u32; 2], side: f64, inside: impl Fn([f64; 2]) -> bool) -> Mesh {
    let [nx, ny] = cells;
    let node = |i: u32, j: u32| i + (nx + 1) * j;
    let place = |i: u32, j: u32| [i, j].map(|it| side * f64::from(it));
    let mut triangles = Vec::new();
    for (i, j) in (0..ny).flat_map(|j| (0..nx).map(move |i| (i, j))) {
        if !inside(place(i, j).map(|it| it + 0.5 * side)) {
            continue;
        }
        let [a, b, c, d] = [
            node(i, j),
            node(i + 1, j),
            node(i + 1, j + 1),
            node(i, j + 1),
        ];
        triangles.extend(match (i + j) % 2 {
            0 => [[a, b, c], [a, c, d]],
            _ => [[a, b, d], [b, c, d]],
        });
    }
    let mut used: Vec<u32> = triangles.as_flattened().to_vec();
    used.sort_unstable();
    used.dedup();
    let new = |node: u32| used.binary_search(&node).unwrap() as u32;
    let positions = used.iter().map(|it| place(it % (nx + 1), it / (nx + 1)));
    Mesh {
        node_tags: (1..=used.len() as u64).collect(),
        positions: positions.collect(),
        cells: triangles
            .into_iter()
            .map(|it| Cell::Triangle(it.map(new)))
            .collect(),
        ..Mesh::default()
    }
}

/// A strip of ten times its height with so many cells across.
fn strip(across: u32) -> Mesh {
    squares([10 * across, across], HEIGHT / f64::from(across), |_| true)
}

fn patched(mesh: Mesh, law: Law) -> Setup {
    let mut setup = Setup::new(
        MeshBody::from(mesh),
        Material::isotropic(YOUNG, POISSON),
        law,
    );
    setup.correction.surface = Surface::Patch(Settings::default());
    setup
}

fn tested(model: &Model) -> (Thin, BendingTest) {
    let section = thinnest_section(model, usize::MAX).unwrap();
    (section, bending_test(model, &section, usize::MAX).unwrap())
}

/// Deflection of Timoshenko's cantilever under a force at its end over that of the strip, with the left side held.
fn cantilever(mut setup: Setup) -> f64 {
    let length = 10.0 * HEIGHT;
    let [left, right] = [0.0, length].map(|x| [[x - 1e-6, -1.0, 0.0], [x + 1e-6, 1.0, 0.0]]);
    let poisson = match setup.law.row.fixes_poisson {
        true => 1.0 / 3.0,
        false => POISSON,
    };
    setup.supports = vec![Support::new(
        Place::Box(left),
        &[Component::X, Component::Y],
    )];
    setup.loads = vec![Load::new(
        Place::Box(right),
        Action::Force([0.0, -1.0, 0.0]),
    )];
    let history = setup.solve(&mut NoObserver).unwrap().outcome.history;
    let bending = length.powi(3) / (3.0 * YOUNG * HEIGHT.powi(3) / 12.0);
    let shear = length * 2.0 * (1.0 + poisson) / (5.0 / 6.0 * HEIGHT * YOUNG);
    (bending + shear) / history.last().unwrap().displacement
}

/// The strip at the thinnest section is as many times too stiff as the cantilever, to 4 % with rotations and without: the cantilever has a held
/// end and a place for the force, where bonds are other than between. At one cell across, where a horizon is three heights, ends reach
/// everywhere: 14 %; measured 12.3 % at most.
#[test]
fn a_strip_is_as_much_too_stiff_as_its_cantilever() {
    let mut stiffness = Vec::new();
    for (law, counts) in [
        (Law::NHPD, &[1_u32, 2, 3, 4, 6, 8][..]),
        (Law::BBPD, &[1, 2, 4]),
    ] {
        for &across in counts {
            let setup = patched(strip(across), law);
            let (section, test) = tested(&Model::build(setup.clone(), &mut ()).unwrap());
            let expected = cantilever(setup);
            let tolerance = if across == 1 { 0.14 } else { 0.04 };
            let error = test.bending / expected - 1.0;
            assert!(
                error.abs() < tolerance,
                "{law:?} {across}: {test:?}, {expected}"
            );
            assert!((section.thickness - HEIGHT).abs() < 1e-9, "{section:?}");
            assert_eq!(
                (section.thickness / section.spacing).round(),
                f64::from(across)
            );
            stiffness.push(test.bending);
        }
    }
    // What is known of the cantilevers: 60, 31, 16 and 11 % too little deflection.
    for (found, missing) in stiffness.iter().zip([0.6, 0.31, 0.16, 0.11]) {
        assert!((1.0 - 1.0 / found - missing).abs() < 0.03, "{stiffness:?}");
    }
}

/// Ahead of a pre-crack of 0.15 m from below, 0.25 m of the strip are left, which are 0.83 horizons of 0.3 m; its mouth lies outside. A crack
/// within the strip has two tips, and the nearer side counts. Without a pre-crack the section is the thinnest.
#[test]
fn the_smallest_ligament_lies_ahead_of_a_tip() {
    let ligament = |precracks: Vec<PreCrack>| {
        let mut setup = patched(strip(4), Law::NHPD);
        setup.precracks = precracks;
        smallest_ligament(&Model::build(setup, &mut ()).unwrap(), usize::MAX).unwrap()
    };
    let found = ligament(vec![PreCrack::along(vec![[2.05, -0.1], [2.05, 0.15]])]);
    assert!((found.thickness - 0.25).abs() < 1e-12, "{found:?}");
    assert!((found.place[1] - 0.275).abs() < 1e-12, "{found:?}");
    assert!((found.horizons() - 0.25 / 0.3).abs() < 1e-9, "{found:?}");
    let found = ligament(vec![PreCrack::along(vec![[2.05, 0.05], [2.05, 0.15]])]);
    assert!((found.thickness - 0.05).abs() < 1e-12, "{found:?}");
    assert!((ligament(Vec::new()).thickness - HEIGHT).abs() < 1e-9);
}

/// A block of unit cells.
fn solid_block(cells: [usize; 3]) -> SolidMesh {
    let grid = block(cells, 0.0);
    let Canvas::Solid(cells) = grid.canvas else {
        unreachable!("a block is of solid cells")
    };
    SolidMesh {
        node_tags: (1..=grid.positions.len() as u64).collect(),
        positions: grid.positions,
        cells,
        ..SolidMesh::default()
    }
}

/// Around a round crack in the middle of a block of 8 by 8 by 4 cells, a disk of a radius of 2.1 cells across its height: 1.9 cells are left on all sides.
#[test]
fn the_ligament_of_a_disk_is_measured_from_its_rim() {
    let body = SolidMeshBody::from(solid_block([8, 8, 4]));
    let mut setup = Setup::new(body, Material::isotropic(YOUNG, 0.2), Law::NHPD);
    setup.precracks = vec![PreCrack {
        shape: CrackShape::Disk {
            centre: [4.0, 4.0, 2.05],
            normal: [0.0, 0.0, 1.0],
            radius: 2.1,
        },
        ..PreCrack::along(Vec::new())
    }];
    let model = Model::build(setup, &mut ()).unwrap();
    let found = smallest_ligament(&model, usize::MAX).unwrap();
    assert!((found.thickness - 1.9).abs() < 1e-9, "{found:?}");
}

/// The notched beam softens, and its horizon of 28 mm at the tip of the notch is more than a quarter of the ligament of 100 mm.
#[test]
fn the_check_warns_of_a_wide_horizon() {
    let warning = "the horizon is 0.28 of the ligament of 0.1000 m";
    let path = verification::repository().join("cases/petersson-beam/opening.toml");
    for (settings, expected) in [(&[][..], true), (&["model.horizon_factor=1.4"], false)] {
        let settings: Vec<String> = settings.iter().map(|it: &&str| (*it).to_owned()).collect();
        let case = CaseFile::load(&path, &settings).unwrap();
        let mut report = Vec::new();
        check(&case, CheckExtent::Matrix, None, Lines::Main, &mut report).unwrap();
        let report = String::from_utf8(report).unwrap();
        assert_eq!(report.contains(warning), expected, "{report}");
    }
}

/// The answer hangs on no axis, and thick bodies are no cause for alarm.
#[test]
fn a_turned_strip_is_as_stiff_and_a_thick_one_stiff_enough() {
    let test = |angle: f64, across: u32| {
        let (sin, cos) = angle.sin_cos();
        let mut mesh = strip(across);
        for place in &mut mesh.positions {
            let [x, y] = *place;
            *place = [cos * x - sin * y, sin * x + cos * y];
        }
        tested(&Model::build(patched(mesh, Law::NHPD), &mut ()).unwrap())
    };
    let ((_, straight), (_, turned)) = (test(0.0, 3), test(0.7, 3));
    // The bits of the places decide between ways through the strip that are alike: other cells, up to three per cent.
    assert!(
        (straight.bending / turned.bending - 1.0).abs() < 0.03,
        "{straight:?}, {turned:?}"
    );
    let (section, thick) = test(0.0, 12);
    assert!(
        (section.horizons() - 4.0).abs() < 1e-9 && section.horizons() < THICK,
        "{section:?}"
    );
    assert!((0.95..TOO_STIFF).contains(&thick.bending), "{thick:?}");
}

/// Two blocks and a web of three cells between them: the section is the web's, and it is tested without the blocks.
#[test]
fn the_thinnest_section_is_found_between_thick_ones() {
    let web = |[x, y]: [f64; 2]| !(6.0..18.0).contains(&x) || (4.0..7.0).contains(&y);
    let model = Model::build(patched(squares([24, 12], 1.0, web), Law::NHPD), &mut ()).unwrap();
    let (section, test) = tested(&model);
    assert!((section.thickness - 3.0).abs() < 1e-9, "{section:?}");
    assert!((section.place[1] - 5.5).abs() < 1e-9, "{section:?}");
    assert!((section.place[0] - 12.0).abs() < 2.0, "{section:?}");
    assert!((1.1..1.4).contains(&test.bending), "{test:?}");
}

/// PDS has E, nu and G of the material and resists every rotation: its cantilever of four times its height is tens of times too stiff, the strip
/// is, and the program says so before it is run.
#[test]
fn bonds_that_resist_rotations_do_not_bend() {
    let pds = Law::PDS;
    let model = Model::build(patched(strip(6), pds), &mut ()).unwrap();
    let (_, test) = tested(&model);
    assert!(test.bending > 30.0, "{test:?}");
    let is_told = |model: &Model| {
        let mut warnings = model.warnings.iter();
        warnings.any(|it| it.kind == "rotation-resisted" && it.text.contains("law = \"pds\""))
    };
    assert!(is_told(&model));
    let mut central = patched(strip(6), pds);
    central.materials[0].material = Material::isotropic(YOUNG, 1.0 / 3.0);
    assert!(!is_told(&Model::build(central, &mut ()).unwrap()));
    assert!(!is_told(
        &Model::build(patched(strip(6), Law::NHPD), &mut ()).unwrap()
    ));
}

/// Radius and length of the round bar, m.
const ROUND: [f64; 2] = [1.0, 4.0];

/// A round bar of so many cells across: squares around its axis become circles.
fn round_bar(across: usize) -> SolidMesh {
    let [radius, length] = ROUND;
    let side = 2.0 * radius / across as f64;
    let layers = (length / side).round() as usize;
    let grid = block([across, across, layers], 0.0);
    let Canvas::Solid(cells) = grid.canvas else {
        unreachable!("a block is of solid cells")
    };
    let middle = 0.5 * across as f64;
    let places = grid.positions.iter().map(|&[x, y, z]| {
        let (x, y) = (side * (x - middle), side * (y - middle));
        let (radius, angle) = match x.abs() >= y.abs() {
            _ if x == 0.0 && y == 0.0 => (0.0, 0.0),
            true => (x, FRAC_PI_4 * y / x),
            false => (y, 2.0 * FRAC_PI_4 - FRAC_PI_4 * x / y),
        };
        [
            radius * angle.cos(),
            radius * angle.sin(),
            length * z / layers as f64,
        ]
    });
    SolidMesh {
        node_tags: (1..=grid.positions.len() as u64).collect(),
        positions: places.collect(),
        cells: cells
            .into_iter()
            .flat_map(|it| {
                it.tetrahedra()
                    .map(SolidCell::Tetrahedron)
                    .collect::<Vec<_>>()
            })
            .collect(),
        ..SolidMesh::default()
    }
}

fn bar(across: usize, rotational_factor: f64) -> Setup {
    let body = SolidMeshBody::from(round_bar(across));
    let mut setup = Setup::new(body, Material::isotropic(YOUNG, 0.2), Law::NHPD);
    setup.horizon = Horizon::Factor(2.5);
    setup.correction.surface = Surface::Patch(Settings::default());
    setup.rotational_scale = RotationalScale::Factor(rotational_factor);
    setup
}

/// Torque of the bar with its right end turned by an angle over that of Saint-Venant, G J angle/L with J = A^2/(2 pi) of its section A.
fn torque(mut setup: Setup, section: f64) -> f64 {
    let [_, length] = ROUND;
    let angle = 1e-4;
    let end = |z: f64| Place::Box([[-2.0, -2.0, z - 1e-6], [2.0, 2.0, z + 1e-6]]);
    let turned = |name: &str, value: Displacement, along: Axis| Load {
        name: name.to_owned(),
        profile: Some(Profile::Linear {
            along,
            zero: 0.0,
            one: 1.0,
        }),
        ..Load::new(end(length), Action::Displacement(value))
    };
    setup.supports = vec![
        Support::new(end(0.0), &[Component::X, Component::Y]),
        Support::new(Place::At([0.0; 3]), &[Component::Z]),
    ];
    let (x, y) = (Some(-angle), Some(angle));
    setup.loads = vec![
        turned(
            "along-x",
            Displacement {
                x,
                ..Displacement::default()
            },
            Axis::Y,
        ),
        turned(
            "along-y",
            Displacement {
                y,
                ..Displacement::default()
            },
            Axis::X,
        ),
    ];
    let history = setup.solve(&mut NoObserver).unwrap().outcome.history;
    let energy = history.last().unwrap().stored_energy;
    let shear_modulus = YOUNG / 2.4;
    2.0 * energy * length / (shear_modulus * section * section / (2.0 * PI) * angle * angle)
}

/// A plate of 3,844 points, two cells thick: its strip has a quarter of them and is tested without being asked for, in a body too large for
/// other tests. An outline of more sides than are compared is no section.
#[test]
fn a_large_thin_solid_is_tested_by_its_strip() {
    let mesh = solid_block([30, 30, 3]);
    let points = mesh.positions.len();
    let body = SolidMeshBody::from(mesh);
    let mut setup = Setup::new(body, Material::isotropic(YOUNG, 0.2), Law::NHPD);
    setup.horizon = Horizon::Factor(2.1);
    let model = Model::build(setup, &mut ()).unwrap();
    let section = thinnest_section(&model, MOST_SIDES).unwrap();
    let most = most_points(3);
    let test = bending_test(&model, &section, most).unwrap();
    assert!(points > most && test.points < points / 2, "{test:?}");
    assert!((section.thickness - 3.0).abs() < 1e-9, "{section:?}");
    let few = thinnest_section(&model, 100).unwrap_err().to_string();
    assert!(few.contains("4320 sides"), "{few}");
}

/// A bar in torsion is as much too stiff as the test says, within 4 %: the ends of the bar are held in their plane. Without rotational stiffness
/// it is less so.
#[test]
fn a_round_bar_is_as_much_too_stiff_in_torsion_as_its_strip() {
    let mut torsion = Vec::new();
    for rotational_factor in [1.0, 0.0] {
        let setup = bar(6, rotational_factor);
        let model = Model::build(setup.clone(), &mut ()).unwrap();
        let volume: f64 = model.system.volumes.iter().sum();
        let (section, test) = tested(&model);
        let expected = torque(setup, volume / ROUND[1]);
        let found = test.torsion.unwrap();
        assert!(
            (found / expected - 1.0).abs() < 0.04,
            "{test:?}, {expected}"
        );
        assert!((section.thickness - 2.0).abs() < 0.1, "{section:?}");
        torsion.push(found);
    }
    let [with, without] = torsion[..] else {
        panic!("{torsion:?}")
    };
    assert!(with > without + 0.02 && with > 1.03, "{torsion:?}");
}

const CASE: &str = r#"
[mesh]
file = "strip.msh"
thickness = 0.01
plane = "stress"
[material]
young = 10e9
poisson = 0.21
[model]
law = "nhpd"
horizon_factor = 3.0
[correction]
surface = "patch"
[[support]]
at = [0.0, 0.0]
displacement = { x = 0.0, y = 0.0, rotation = 0.0 }
[[load]]
at = [4.0, 0.4]
force = { y = -1e3 }
"#;

fn checked(across: u32, extent: CheckExtent, settings: &[&str]) -> String {
    let folder = tempfile::tempdir().unwrap();
    let mesh = mesh_setting(&strip(across), folder.path());
    let settings: Vec<&str> = [mesh.as_str()]
        .into_iter()
        .chain(settings.iter().copied())
        .collect();
    let mut report = Vec::new();
    check(
        &case(CASE, &settings),
        extent,
        None,
        Lines::All,
        &mut report,
    )
    .unwrap();
    String::from_utf8(report).unwrap()
}

#[test]
fn the_check_warns_of_thin_bodies_and_of_no_others() {
    let report = checked(2, CheckExtent::Matrix, &[]);
    for line in [
        "strip at the thinnest section, bent\n  thinnest section      0.4000 m at (",
        "2.0 distances of points across, 0.7 horizons",
        "  in bending            1.4",
        "warning: the body is 1.4",
        "distances keep the error within 5 %",
    ] {
        assert!(report.contains(line), "{line}\n{report}");
    }
    let by_the_paper = checked(2, CheckExtent::Matrix, &["correction.surface=\"domain\""]);
    let cure = "a finer mesh and correction.surface = \"patch\" reduce this";
    assert!(by_the_paper.contains(cure), "{by_the_paper}");
    for (across, line) in [
        (8, "  in bending            1.0"),
        (20, "not tested            more than 6 horizons across"),
    ] {
        let report = checked(across, CheckExtent::Matrix, &[]);
        assert!(
            report.contains(line) && !report.contains("warning"),
            "{line}\n{report}"
        );
    }
    assert!(!checked(2, CheckExtent::Model, &[]).contains("strip"));
    let pds = checked(
        2,
        CheckExtent::Matrix,
        &["model.law=\"pds\"", "support.0.displacement={x=0.0, y=0.0}"],
    );
    assert!(pds.contains("a finer mesh does not help"), "{pds}");
    assert!(
        pds.contains("warning: law = \"pds\": points have no rotations"),
        "{pds}"
    );
}
