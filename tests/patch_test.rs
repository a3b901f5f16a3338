//! The patch test of a model, and what `ligament check` tells of it.
//!
//! E and Poisson's ratio are known: they are those of the material.
#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::path::Path;

use ligament::patch_test::{PatchTest, Untested, patch_test};
use ligament::prelude::*;
use ligament::setup::Surface;
use ligament_case::case::CaseFile;
use ligament_cli::check::{CheckExtent, Lines, check};
use ligament_model::correction::patch::Settings;
use verification::{meshes, repository};

const YOUNG: f64 = 15e9;
const POISSON: f64 = 0.21;

fn bar() -> Setup {
    let body = MeshBody::from(meshes::read("meshes/plate-tall.msh"));
    Setup::new(body, Material::isotropic(YOUNG, POISSON), Law::NHPD)
}

fn patched(mut setup: Setup) -> Setup {
    setup.correction.surface = Surface::Patch(Settings::default());
    setup
}

fn tested(setup: Setup) -> PatchTest {
    patch_test(&Model::build(setup, &mut ()).unwrap()).unwrap()
}

/// Share of E along x and y that is missing or too much, and what is missing of nu.
fn errors(test: &PatchTest) -> [f64; 3] {
    let body = test.constants.unwrap().body;
    let [x, y, _] = body.young.map(|young| young / YOUNG - 1.0);
    [x, y, body.poisson[0][1] - POISSON]
}

/// The patch correction was made for it; without it the bar is several per cent too soft, and its bonds strain by a tenth too much or too
/// little.
#[test]
fn the_patch_correction_passes_the_patch_test() {
    for plane in [Plane::Stress, Plane::Strain] {
        let mut setup = bar();
        setup.section = Section::Plane {
            state: plane,
            thickness: 0.01,
        };
        let without = tested(setup.clone());
        let with = tested(patched(setup));
        let [x, y, nu] = errors(&with);
        assert!(
            x.abs() < 3e-4 && y.abs() < 3e-4 && nu.abs() < 3e-4,
            "{with:?}"
        );
        assert!(with.scatter.iter().all(|it| *it < 3e-3), "{with:?}");
        let [x, ..] = errors(&without);
        assert!((-0.08..-0.02).contains(&x), "{without:?}");
        assert!(without.scatter.iter().all(|it| *it > 0.05), "{without:?}");
        assert!(without.largest > without.scatter[0], "{without:?}");
    }
}

/// Of ten bonds a point, some of a larger body have no factors that meet their equations: what is left there does not add up over the
/// body, and the iteration finds its way all the same.
#[test]
fn few_bonds_make_no_soft_body() {
    let mut setup = patched(Setup::new(
        MeshBody::from(meshes::read("meshes/disk-1.5mm.msh")),
        Material::isotropic(YOUNG, POISSON),
        Law::NHPD,
    ));
    setup.horizon = Horizon::Factor(2.0);
    let test = tested(setup);
    let [x, y, nu] = errors(&test);
    assert!(
        x.abs() < 5e-4 && y.abs() < 5e-4 && nu.abs() < 5e-4,
        "{test:?}"
    );
    assert!(test.scatter.iter().all(|it| *it < 5e-3), "{test:?}");
}

/// Young's modulus from pulling the bar is that of the patch test: a force is spread over its sides along x, and the displacement of a free
/// bar is its elongation, whichever side comes first. Both are solutions of the same equations.
#[test]
fn pulling_the_bar_gives_the_same_modulus() {
    let test = tested(bar());
    let moved = |pulled: &str, other: &str, sign: f64| {
        let mut setup = bar();
        let force = |sign: f64| Action::ForcePerLength([sign, 0.0, 0.0]);
        setup.loads = vec![
            Load::new(pulled, force(sign)),
            Load::new(other, force(-sign)),
        ];
        let history = setup.solve(&mut NoObserver).unwrap().outcome.history;
        history.last().unwrap().displacement
    };
    // 1 N/m on sides 0.1 m apart, in a thickness of 1 m.
    let found = test.constants.unwrap().body.young[0];
    for elongation in [moved("right", "left", 1.0), moved("left", "right", -1.0)] {
        let young = 0.1 / elongation;
        assert!((found / young - 1.0).abs() < 1e-8, "{found:e}, {young:e}");
    }
}

/// Constants come along the axes of the material: its four in any direction of these.
#[test]
fn an_orthotropic_body_is_read_along_its_axes() {
    let angle = 0.5;
    let constants = |angle: f64| {
        let mut setup = patched(bar());
        setup.law = Law::ORTHOTROPIC;
        setup.materials[0].material.elasticity =
            Elasticity::Orthotropic(ligament_model::Orthotropic {
                young: [15e9, 5e9],
                poisson: 0.25,
                shear_modulus: 4.8e9,
                out_of_plane: None,
                angle,
            });
        tested(setup).constants.unwrap()
    };
    for angle in [0.0, angle] {
        let found = constants(angle);
        assert_eq!(found.angle, Some(angle));
        let pairs = [
            (found.body.young[0], 15e9),
            (found.body.young[1], 5e9),
            (found.body.poisson[0][1], 0.25),
            (found.body.shear_modulus.at(0, 1), 4.8e9),
        ];
        for (found, given) in pairs {
            // The correction meets its equations to a part in some hundred where the bonds along one axis are soft.
            assert!(
                (found / given - 1.0_f64).abs() < 0.01,
                "{angle}: {found:e}, {given:e}"
            );
        }
    }
}

/// Square cells are as stiff as their material with the patch correction, also where the body is longer than high: along its length it has
/// E and nu, and in shear its bonds strain uniformly.
#[test]
fn a_lattice_has_a_patch_test() {
    for cells in [[40, 20], [30, 30], [160, 10]] {
        let lattice = LatticeBody::new(cells, [0.005; 2], [0.0; 2], &[], &[].into()).unwrap();
        let setup = Setup::new(lattice, Material::isotropic(YOUNG, POISSON), Law::NHPD);
        let test = tested(patched(setup));
        let [x, y, nu] = errors(&test);
        assert!(
            x.abs() < 1e-3 && y.abs() < 1e-3 && nu.abs() < 1e-3,
            "{cells:?}: {x}, {y}, {nu}"
        );
        // Corners have half the bonds of an edge, and their equations are not all met: 15 % are left there in shear.
        assert!(test.scatter.iter().all(|it| *it < 2.5e-2), "{test:?}");
    }
}

/// A pre-crack is left out: the body is the same without it.
#[test]
fn precracks_are_left_out() {
    let mut cracked = bar();
    cracked.precracks = vec![PreCrack::along(vec![[0.02, 0.1], [0.08, 0.1]])];
    assert_eq!(tested(cracked), tested(bar()));
}

#[test]
fn points_without_cells_have_none() {
    let places = vec![[0.0; 2], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
    let points = Points::new(places, vec![1.0; 4]).unwrap();
    let setup = Setup::new(points, Material::isotropic(YOUNG, POISSON), Law::NHPD);
    let error = patch_test(&Model::build(setup, &mut ()).unwrap()).unwrap_err();
    assert!(matches!(error, Untested::NoCells), "{error}");
}

/// What `ligament check` prints of a case of the repository.
fn checked(case: &str, settings: &[&str], extent: CheckExtent) -> String {
    let settings: Vec<String> = settings.iter().map(|it| (*it).to_owned()).collect();
    let path = repository().join(Path::new(case));
    let case = CaseFile::load(&path, &settings).unwrap();
    let mut report = Vec::new();
    check(&case, extent, None, Lines::All, &mut report).unwrap();
    String::from_utf8(report).unwrap()
}

#[test]
fn the_check_tells_how_stiff_the_body_is() {
    let case = "cases/verification/patch-test.toml";
    let report = checked(case, &[], CheckExtent::Matrix);
    for line in [
        "Young's modulus       15.00 GPa (",
        " %) along x, ",
        " for 0.2100",
        "strains of the bonds  differ from the mean strain by 0.",
        " % rms (along x, along y, in shear), at most ",
        "time, patch test",
    ] {
        assert!(report.contains(line), "{line}\n{report}");
    }
    let report = checked(case, &[], CheckExtent::Model);
    assert!(!report.contains("free body"), "{report}");
}

#[test]
fn several_materials_have_no_modulus_but_strains() {
    let strains = |correction: &str| {
        let setting = format!("correction.surface={correction:?}");
        let report = checked(
            "cases/bimaterial-bar/case.toml",
            &[&setting],
            CheckExtent::Matrix,
        );
        let none =
            "E, nu                 none: a body of several materials does not strain uniformly";
        assert!(report.contains(none), "{report}");
        let (_, rest) = report
            .split_once("differ from the mean strain by ")
            .unwrap();
        let (first, _) = rest.split_once(',').unwrap();
        first.parse::<f64>().unwrap()
    };
    let (with, without) = (strains("patch"), strains("domain"));
    assert!(with < 0.5 && without > 5.0, "{with}, {without}");
}

#[test]
fn the_check_says_that_large_bodies_are_left_out() {
    let large = ["lattice.cells=[150, 150]", "model.horizon_factor=1.5"];
    let report = checked(
        "cases/verification/lattice.toml",
        &large,
        CheckExtent::Matrix,
    );
    let line = "not computed          it needs a factor of the matrix, and the body has more than 20000 points; use --patch-test";
    assert!(report.contains(line), "{report}");
}
