//! Every command on a solid: it works, or refuses solids.

use std::fs;

use super::block::{Block, SOLID, case};
use super::{folder_with, with_case};
use crate::support::{assert_success, ligament_in, stderr, stdout};

const BREAKING: &str =
    "[fracture]\nsteps = 6\n[[fracture.criterion]]\nkind = \"tension\"\n[output]\nfields_every = 2";

fn breaking() -> String {
    let [head, support, load, _] = SOLID;
    case([head, support, load, BREAKING]).replace("2e-4", "8e-4")
}

/// A run that is cut short goes on to the bits of one that was not, and is the same when it is repeated.
#[test]
fn runs_go_on_and_repeat() {
    let folder = folder_with(&Block::new(1.0));
    let place = folder.path();
    let (is_good, said) = with_case(place, &breaking(), &["run", "case.toml", "--out", "whole"]);
    assert!(is_good, "{said}");
    let short = [
        "run",
        "case.toml",
        "--out",
        "part",
        "--set",
        "fracture.stop={ displacement = 2e-4 }",
    ];
    assert_success(&ligament_in(place, &short));
    let short = fs::read_to_string(place.join("part/history.csv")).unwrap();
    let whole = fs::read_to_string(place.join("whole/history.csv")).unwrap();
    assert!(
        whole.starts_with(&short) && whole.len() > short.len(),
        "{short}\n{whole}"
    );
    assert_success(&ligament_in(
        place,
        &["resume", "part", "--set", "fracture.stop.displacement=1.0"],
    ));
    assert_eq!(
        fs::read_to_string(place.join("part/history.csv")).unwrap(),
        whole
    );
    let output = ligament_in(place, &["repeat", "whole"]);
    assert_success(&output);
    assert!(
        stdout(&output).contains("the same to the last bit"),
        "{output:?}"
    );
}

/// Studies of solids: a sweep and a calibration. The strength of brittle bonds is in proportion to their limit.
#[test]
fn studies_take_solids() {
    let folder = folder_with(&Block::new(1.0));
    let place = folder.path();
    fs::write(place.join("case.toml"), breaking()).unwrap();
    let study = "title = \"t\"\ncase = \"case.toml\"\n[[axis]]\nkey = \"material.young\"\nvalues = [30e9, 60e9]\n";
    fs::write(place.join("study.toml"), study).unwrap();
    let output = ligament_in(place, &["sweep", "study.toml", "--out", "sweep"]);
    assert_success(&output);
    assert!(stdout(&output).contains("2 done, 0 failed"), "{output:?}");
    let calibrate = [
        "calibrate",
        "case.toml",
        "--key",
        "material.young",
        "--target",
        "1e10",
        "--of",
        "elastic_stiffness",
        "--out",
        "calibrated",
    ];
    let output = ligament_in(place, &calibrate);
    assert_success(&output);
}

/// Commands for bodies in the plane refuse solids.
#[test]
fn what_is_of_the_plane_alone_says_so() {
    let folder = folder_with(&Block::new(1.0));
    let place = folder.path();
    fs::write(place.join("case.toml"), case(SOLID)).unwrap();
    assert_success(&ligament_in(
        place,
        &["run", "case.toml", "--out", "results"],
    ));
    for (arguments, words) in [
        (
            &["stiffness", "case.toml"][..],
            "case.toml:2:8: mesh.file: the body is a solid",
        ),
        (
            &["yield", "--case", "case.toml"],
            "case.toml:2:8: mesh.file: the body is a solid",
        ),
        (
            &[
                "profile", "results", "--from", "0,0", "--to", "1,0", "--field", "damage",
            ],
            "this one is a solid",
        ),
        (
            &[
                "profile", "results", "--from", "0,0,0", "--to", "1,0,0", "--field", "damage",
            ],
            "lines through solids are not sampled",
        ),
    ] {
        let output = ligament_in(place, arguments);
        assert!(!output.status.success(), "{arguments:?}: {output:?}");
        let said = stderr(&output);
        assert!(said.contains(words), "{arguments:?}: {said}");
    }
    let lattice = "[solid_lattice]\ncells = [6, 4, 4]\nspacing = [0.1, 0.1, 0.1]\nset = { left = { left = 1 }, right = { right = 1 } }";
    let [_, support, load, more] = SOLID;
    fs::write(
        place.join("lattice.toml"),
        case([lattice, support, load, more]),
    )
    .unwrap();
    let output = ligament_in(place, &["stiffness", "lattice.toml"]);
    assert!(
        stderr(&output).contains("solid_lattice: the body is a solid"),
        "{output:?}"
    );
}
