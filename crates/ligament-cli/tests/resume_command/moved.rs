//! Results that were moved, or whose case was edited, and are resumed.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use ligament_mesh::gmsh;
use tempfile::TempDir;

use super::bench::{refused, results, succeeded, termination};

const CASE: &str = r#"
mesh = { file = "meshes/disk.msh" }
material = { young = 15e9, poisson = 0.21, density = 2500.0, tensile_strength = 3.81e6 }
model = { law = "nhpd", horizon_factor = 3.0 }
support = [{ group = "platen-bottom", displacement = { x = 0.0, y = 0.0 } }]
load = [{ name = "press", group = "platen-top", displacement = { y = -4e-4 }, profile = { file = "press.csv" } }]
fracture = { steps = 40, stop = { bonds = 6 } }
output = { fields_every = 20, model = false }
"#;

/// A project with a case, its mesh and table, and the results of a run that a rule ended.
fn project(folder: &Path) {
    let mesh = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../meshes/disk-4mm.msh");
    fs::create_dir_all(folder.join("meshes")).unwrap();
    let nodes = gmsh::parse(&fs::read(&mesh).unwrap()).unwrap().positions;
    let rows = nodes.iter().map(|[x, y]| format!("{x:?},{y:?},1\n"));
    let rows: String = rows.collect();
    fs::write(folder.join("press.csv"), format!("x,y,factor\n{rows}")).unwrap();
    fs::copy(mesh, folder.join("meshes/disk.msh")).unwrap();
    fs::write(folder.join("case.toml"), CASE).unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_ligament"));
    let case = folder.join("case.toml");
    command.arg("run").arg(case).arg("--out");
    command.arg(folder.join("results/out")).arg("--quiet");
    succeeded(command);
}

/// Goes on with the results of a project until more bonds are broken.
fn resume(folder: &Path, more: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_ligament"));
    command.arg("resume").arg(folder.join("results/out"));
    command.args(["--set", "fracture.stop.bonds=9"]).args(more);
    command
}

/// Tables and fields of a project.
fn tables(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let all = results(&folder.join("results/out")).into_iter();
    all.filter(|(name, _)| name != "case.resolved.toml")
        .collect()
}

fn renamed(from: &Path, to: PathBuf) -> PathBuf {
    fs::rename(from, &to).unwrap();
    to
}

/// A project that is moved as a whole is resumed like one that was not; a mesh elsewhere is found by `--mesh`, and another one refused.
#[test]
fn results_that_moved_go_on() {
    let place = TempDir::new().unwrap();
    let [stayed, first] = ["stayed", "first"].map(|it| place.path().join(it));
    for folder in [&stayed, &first] {
        project(folder);
    }
    succeeded(resume(&stayed, &[]));
    assert_eq!(termination(&stayed.join("results/out")), "bonds-broken");

    let moved = renamed(&first, place.path().join("moved"));
    let mesh = renamed(
        &moved.join("meshes/disk.msh"),
        place.path().join("elsewhere.msh"),
    );
    let before = results(&moved.join("results/out"));
    let said = refused(resume(&moved, &[]));
    assert!(said.contains("first/meshes/disk.msh"), "{said}");
    assert!(said.contains("give its new place with --mesh"), "{said}");

    let text = fs::read_to_string(&mesh).unwrap();
    let other = place.path().join("other.msh");
    fs::write(&other, text.replacen("0.0", "0.1", 1)).unwrap();
    // Another mesh in the place of the original relative to the results is refused as well.
    fs::copy(&other, moved.join("meshes/disk.msh")).unwrap();
    let said = refused(resume(&moved, &[]));
    assert!(said.contains("give its new place with --mesh"), "{said}");
    let said = refused(resume(&moved, &["--mesh", other.to_str().unwrap()]));
    assert!(said.contains("other inputs (now file = "), "{said}");
    assert_eq!(results(&moved.join("results/out")), before);

    succeeded(resume(&moved, &["--mesh", mesh.to_str().unwrap()]));
    assert!(tables(&moved) == tables(&stayed));
    // The table moved with the results, and now the mesh.
    fs::copy(&mesh, moved.join("elsewhere.msh")).unwrap();
    fs::remove_file(&mesh).unwrap();
    let again = renamed(&moved, place.path().join("again"));
    let mut command = Command::new(env!("CARGO_BIN_EXE_ligament"));
    command
        .args(["repeat", "--quiet"])
        .arg(again.join("results/out"));
    succeeded(command);
}

/// An edit of the case since the run is reported, because the resumed run ignores it; an unchanged or missing case is not.
#[test]
fn an_edited_case_is_told() {
    let place = TempDir::new().unwrap();
    let folder = place.path().join("first");
    project(&folder);
    let case = folder.join("case.toml");
    let words = "case.toml has changed since; the run goes on with ";
    let said = succeeded(resume(&folder, &[]));
    assert!(!said.contains("changed since"), "{said}");
    fs::write(&case, CASE.replace("15e9", "16e9")).unwrap();
    // Also after it was resumed once.
    for bonds in ["fracture.stop.bonds=12", "fracture.stop.bonds=15"] {
        let said = succeeded(resume(&folder, &["--set", bonds]));
        assert!(said.contains(words), "{said}");
        assert!(said.contains("results/out/case.resolved.toml"), "{said}");
    }
    fs::remove_file(&case).unwrap();
    let said = succeeded(resume(&folder, &["--set", "fracture.stop.bonds=18"]));
    assert!(!said.contains("changed since"), "{said}");
}
