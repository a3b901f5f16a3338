//! The program on a case with a `[lattice]`.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::ffi::OsStr;
use std::path::Path;
use std::process::Command;

const TEXT: &str = include_str!("../../ligament-case/tests/data/lattice-plate.toml");

fn check(folder: &Path, settings: &[&str]) -> (Option<i32>, String) {
    let path = folder.join("case.toml");
    std::fs::write(&path, TEXT).unwrap();
    let arguments = [
        OsStr::new("check"),
        path.as_os_str(),
        "--model-only".as_ref(),
        "--all".as_ref(),
    ];
    let settings = settings.iter().flat_map(|it| ["--set", it]);
    let output = Command::new(env!("CARGO_BIN_EXE_ligament"))
        .args(arguments.into_iter().chain(settings.map(OsStr::new)))
        .output()
        .unwrap();
    let said = if output.status.success() {
        output.stdout
    } else {
        output.stderr
    };
    (output.status.code(), String::from_utf8(said).unwrap())
}

/// Cells, sets and pairs across a slit of one row, counted by hand: of the offset (i, j) with j = 2 or 3 the pairs that stand
/// j - 1 rows apart, 20 + 2 (19 + 18) + 2 (20) = 134.
#[test]
fn check_shows_the_lattice() {
    let folder = tempfile::tempdir().unwrap();
    let slit = "lattice.remove=[{ rectangle = [[-1, 0.051], [1, 0.059]] }]";
    let (code, said) = check(folder.path(), &[slit]);
    assert_eq!(code, Some(0), "{said}");
    for line in [
        "lattice\n  cells                 220 of 20 x 12 (20 removed)\n",
        "  area                  0.02200 m^2\n",
        "  thickness             ",
        "  set left              33 points, 3.333 mm of a side each\n",
        "  set rock              220 points\n",
        "  set disk              8 points\n",
        "  set tip               6 points\n",
        "  pairs across voids    134\n",
        "  horizon               30.00 mm\n",
        "warning: the body consists of 2 parts with no bond between them\n",
    ] {
        assert!(said.contains(line), "{line}\n{said}");
    }
}

#[test]
fn what_does_not_fit_the_lattice_is_told() {
    let folder = tempfile::tempdir().unwrap();
    for (setting, message) in [
        (
            "lattice.remove=[{ polygon = [[-1, -1], [1, -1], [0, 2]] }]",
            "lattice.remove: nothing is left of the 240 cells",
        ),
        (
            "lattice.set.nowhere.box=[[1, 1], [2, 2]]",
            "lattice.set.nowhere: no cell has its centre in this set",
        ),
        (
            "lattice.remove.0={ name = \"far\", circle = { centre = [9, 9], radius = 0.1 } }",
            "lattice.remove.0: no cell that is left borders on this hole",
        ),
        (
            "load.0.group=rigth",
            "load.0.group: no set of the lattice is called `rigth`; did you mean `right`?",
        ),
        (
            "load.0.group=rock",
            "load.0.group: a force per length needs a physical curve of a mesh, or rows or columns at a side of a lattice",
        ),
        (
            "material={ a = { group = \"left\", young = 1e9, poisson = 0.2 }, b = { group = \"rock\", young = 1e9, poisson = \
             0.2 } }",
            "material.b: cells of this material belong to material `a` as well",
        ),
        (
            "material={ a = { group = \"left\", young = 1e9, poisson = 0.2 } }",
            "material: 192 of 228 cells belong to the group of no material",
        ),
        (
            "model.horizon=0.0099",
            "model: 228 of 228 points have no neighbour in their horizon (the first is cell 1 at (0.005000, 0.005000))",
        ),
    ] {
        let (code, said) = check(folder.path(), &[setting]);
        assert_eq!(code, Some(1), "{said}");
        assert!(said.contains(message), "{setting}:\n{said}");
    }
}
