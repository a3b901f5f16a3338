//! `ligament new` for solids: its cases check and run as they are.

use std::path::Path;

use ligament::setup::Law;
use ligament_case::case::{CaseFile, schema};
use ligament_case::starter::{StarterError, mesh_case, solid_lattice_case};
use ligament_cli::check::{CheckExtent, Lines, check};

use super::block::Block;
use super::{folder_with, meshes};
use crate::support::{assert_success, ligament_in};

fn case(text: &str, folder: &Path) -> CaseFile {
    let parsed = CaseFile::parse(&folder.join("case.toml"), text.to_owned(), &[]);
    parsed.unwrap_or_else(|error| panic!("{error}\n{text}"))
}

fn checked(case: &CaseFile) -> String {
    let mut report = Vec::new();
    check(case, CheckExtent::Model, None, Lines::All, &mut report)
        .unwrap_or_else(|error| panic!("{error:#}\n{}", case.source.text));
    String::from_utf8(report).unwrap()
}

/// The text with all commented settings active.
fn with_all_settings(text: &str) -> String {
    let lines = text.lines().map(|line| match line.strip_prefix('#') {
        Some(setting) if setting.starts_with(|it: char| it.is_alphabetic() || it == '[') => setting,
        _ => line,
    });
    lines.collect::<Vec<_>>().join("\n")
}

/// Groups are found by their names or by where they lie, and the body is moved along the right axis.
#[test]
fn meshes_of_the_repository_have_cases_that_check() {
    let folder = tempfile::tempdir().unwrap();
    for (mesh, held, loaded, axis, sign) in [
        ("bar.msh", "left", "right", 0, 1.0),
        ("thick-disk.msh", "platen-bottom", "platen-top", 1, -1.0),
        ("cavity.msh", "plane-z", "top", 2, 1.0),
    ] {
        let starter = mesh_case(&meshes().join(mesh), folder.path(), Law::NHPD).unwrap();
        let case = case(&starter.text, folder.path());
        assert!(case.case.is_solid());
        assert_eq!(case.case.supports[0].group.as_deref(), Some(held), "{mesh}");
        assert_eq!(case.case.loads[0].group.as_deref(), Some(loaded), "{mesh}");
        let moved = case.case.loads[0].displacement.unwrap();
        let moved = [moved.x, moved.y, moved.z];
        assert!(moved[axis].unwrap() * sign > 0.0, "{mesh}: {moved:?}");
        assert_eq!(moved.iter().flatten().count(), 1, "{mesh}: {moved:?}");
    }
    // One of them with everything: the pre-crack cuts bonds, probes and output are known.
    let starter = mesh_case(&meshes().join("thick-disk.msh"), folder.path(), Law::PDS);
    let report = checked(&case(
        &with_all_settings(&starter.unwrap().text),
        folder.path(),
    ));
    assert!(!report.contains("(0 cut by pre-cracks)"), "{report}");
}

/// A bar of eight cubes with nodes called left and right below its ends and load above its middle is bent in three points.
#[test]
fn a_load_between_two_ends_bends() {
    let folder = tempfile::tempdir().unwrap();
    let mut text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n4\n0 1 \"left\"\n0 2 \"right\"\n0 3 \"load\"\n3 4 \"beam\"\n\
                    $EndPhysicalNames\n$Nodes\n36\n"
        .to_owned();
    for node in 0..36 {
        text += &format!("{} {} {} {}\n", node + 1, node % 9, node / 9 % 2, node / 18);
    }
    text += "$EndNodes\n$Elements\n11\n1 15 2 1 1 1\n2 15 2 2 2 9\n3 15 2 3 3 23\n";
    for cell in 1..=8 {
        let base = [cell, cell + 1, cell + 10, cell + 9];
        let corners = base.into_iter().chain(base.map(|it| it + 18));
        let corners: Vec<String> = corners.map(|it| it.to_string()).collect();
        text += &format!("{} 5 2 4 4 {}\n", cell + 3, corners.join(" "));
    }
    let file = folder.path().join("beam.msh");
    std::fs::write(&file, text + "$EndElements\n").unwrap();
    let starter = mesh_case(&file, folder.path(), Law::NHPD).unwrap();
    let case = case(&starter.text, folder.path()).case;
    let [left, right] = case.supports.as_slice() else {
        panic!("{}", starter.text);
    };
    assert_eq!(
        [&left.group, &right.group].map(|it| it.as_deref()),
        [Some("left"), Some("right")]
    );
    let [pinned, sliding] = [left, right].map(|it| it.displacement.unwrap());
    assert_eq!([pinned.x, pinned.y, pinned.z], [Some(0.0); 3]);
    assert_eq!([sliding.x, sliding.y, sliding.z], [None, None, Some(0.0)]);
    assert_eq!(case.loads[0].group.as_deref(), Some("load"));
    let moved = case.loads[0].displacement.unwrap();
    assert!(moved.z.is_some_and(|z| z < 0.0), "{}", starter.text);
}

/// A mesh without groups is held and pulled by boxes at its ends, and breaks.
#[test]
fn without_groups_boxes_are_taken_and_the_case_runs() {
    let mut block = Block::new(0.1);
    (block.group, block.triangles) = (0, Vec::new());
    let folder = folder_with(&block);
    assert_success(&ligament_in(folder.path(), &["new", "block.msh"]));
    let text = std::fs::read_to_string(folder.path().join("case.toml")).unwrap();
    assert!(
        text.contains("# two corners, m: the points in this box"),
        "{text}"
    );
    assert!(!text.contains("thickness"), "{text}");
    let run = [
        "run",
        "case.toml",
        "--out",
        "results",
        "--set",
        "fracture.steps=10",
    ];
    assert_success(&ligament_in(folder.path(), &run));
    let breaks = std::fs::read_to_string(folder.path().join("results/breaks.csv")).unwrap();
    assert!(breaks.lines().count() > 10, "{breaks}");
}

/// Lattices of cubes for every law of solids are valid for the program and for editors; laws of the plane are refused.
#[test]
fn lattices_take_the_laws_of_solids() {
    let (mut schemas, mut compiler) = (boon::Schemas::new(), boon::Compiler::new());
    compiler.add_resource("case.json", schema()).unwrap();
    let index = compiler.compile("case.json", &mut schemas).unwrap();
    let mut count = 0;
    for law in Law::ALL {
        match solid_lattice_case([6, 6, 12], 0.01, law) {
            Ok(starter) => {
                count += 1;
                checked(&case(&starter.text, Path::new("")));
                for text in [starter.text.clone(), with_all_settings(&starter.text)] {
                    let document: serde_json::Value = toml::from_str(&text).unwrap();
                    let valid = schemas.validate(&document, index);
                    assert!(valid.is_ok(), "{:#}\n{text}", valid.unwrap_err());
                    case(&text, Path::new(""));
                }
            }
            Err(StarterError::NeedsPlane(refused)) => assert_eq!(refused, law),
            Err(other) => panic!("{other}"),
        }
    }
    assert_eq!(count, 6);
    let folder = tempfile::tempdir().unwrap();
    let made = ligament_in(
        folder.path(),
        &["new", "--lattice", "6,6,12,0.01", "--law", "pds"],
    );
    assert_success(&made);
}
