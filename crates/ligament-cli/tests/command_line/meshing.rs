//! Calls of `ligament mesh` with a shell script in place of gmsh.

use super::*;
use ligament_mesh::gmsh;
use std::os::unix::fs::PermissionsExt;

const GEOMETRY: &str = "DefineConstant[ size = 0.1 ];\nDefineConstant[ radius = 1 ];\n";

/// A folder with a geometry and a script that is called as gmsh; `$OUT` is the mesh to write.
fn folder(script: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("plate.geo"), GEOMETRY).unwrap();
    let gmsh = folder.path().join("gmsh");
    fs::write(&gmsh, format!("#!/bin/sh\nOUT=$4\n{script}\n")).unwrap();
    fs::set_permissions(&gmsh, fs::Permissions::from_mode(0o755)).unwrap();
    folder
}

fn mesh(folder: &Path, more: &[&str]) -> Output {
    let (geometry, gmsh) = (folder.join("plate.geo"), folder.join("gmsh"));
    let arguments = [
        OsStr::new("mesh"),
        geometry.as_os_str(),
        "--gmsh".as_ref(),
        gmsh.as_os_str(),
    ];
    ligament(arguments.into_iter().chain(more.iter().map(OsStr::new)))
}

fn files(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<_> = entries
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

#[test]
fn the_mesh_is_written_and_shown() {
    let script = format!(
        "echo \"$@\" > \"$(dirname \"$0\")/arguments\"\ncp {} \"$OUT\"",
        plate().display()
    );
    let folder = folder(&script);
    let output = mesh(
        folder.path(),
        &["--set", "size=0.001", "--set", "radius=-2"],
    );
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert!(
        stdout(&output).contains("plate.msh\n  nodes "),
        "{}",
        stdout(&output)
    );
    assert_eq!(
        files(folder.path()),
        ["arguments", "gmsh", "plate.geo", "plate.msh"]
    );
    let arguments = fs::read_to_string(folder.path().join("arguments")).unwrap();
    assert!(arguments.starts_with("-3 "), "{arguments}");
    let end = "-format msh41 -setnumber size 0.001 -setnumber radius -2\n";
    assert!(arguments.ends_with(end), "{arguments}");
}

#[test]
fn a_failure_shows_the_errors_of_gmsh_and_leaves_the_mesh_alone() {
    for script in [
        "echo 'Info    : Reading'\necho \"Error   : 'plate.geo', line 3: syntax error\"\necho x > \"$OUT\"\nexit 1",
        "echo \"Error   : 'plate.geo', line 3: syntax error\" >&2\necho x > \"$OUT\"",
    ] {
        let folder = folder(script);
        fs::write(folder.path().join("plate.msh"), "old").unwrap();
        let output = mesh(folder.path(), &["--force"]);
        assert_eq!(output.status.code(), Some(1));
        let expected = "plate.geo\n  Error   : 'plate.geo', line 3: syntax error\n";
        assert!(stderr(&output).ends_with(expected), "{}", stderr(&output));
        assert_eq!(
            fs::read_to_string(folder.path().join("plate.msh")).unwrap(),
            "old"
        );
        assert_eq!(files(folder.path()), ["gmsh", "plate.geo", "plate.msh"]);
    }
}

#[test]
fn a_failure_without_error_lines_shows_what_gmsh_said_last() {
    let output = mesh(folder("echo one\necho two\nexit 3").path(), &[]);
    assert!(
        stderr(&output).ends_with("\n  one\n  two\n"),
        "{}",
        stderr(&output)
    );
    let output = mesh(folder("exit 3").path(), &[]);
    assert!(
        stderr(&output).contains("gmsh said nothing (exit status: 3)"),
        "{}",
        stderr(&output)
    );
}

#[test]
fn a_mesh_that_cannot_be_read_does_not_replace_one() {
    let folder = folder("echo nonsense > \"$OUT\"");
    fs::write(folder.path().join("plate.msh"), "old").unwrap();
    let output = mesh(folder.path(), &["--force"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(
        stderr(&output).contains("that cannot be used"),
        "{}",
        stderr(&output)
    );
    assert_eq!(
        fs::read_to_string(folder.path().join("plate.msh")).unwrap(),
        "old"
    );
}

#[test]
fn without_gmsh_there_is_a_hint_how_to_install_it() {
    let folder = folder("");
    let geometry = folder.path().join("plate.geo");
    let nowhere = folder.path().join("no-gmsh");
    let output = ligament([
        OsStr::new("mesh"),
        geometry.as_os_str(),
        "--gmsh".as_ref(),
        nowhere.as_os_str(),
    ]);
    assert_eq!(output.status.code(), Some(1));
    assert!(
        stderr(&output).contains("cannot find the program"),
        "{}",
        stderr(&output)
    );
    assert!(
        stderr(&output).contains("pip install gmsh"),
        "{}",
        stderr(&output)
    );
}

#[test]
fn the_geometry_is_never_replaced() {
    let folder = folder("echo x > \"$OUT\"");
    let geometry = folder.path().join(".").join("plate.geo");
    let output = mesh(folder.path(), &["--out", &geometry.display().to_string()]);
    assert_eq!(output.status.code(), Some(1));
    assert!(
        stderr(&output).contains("is the geometry itself"),
        "{}",
        stderr(&output)
    );
    assert_eq!(fs::read_to_string(geometry).unwrap(), GEOMETRY);
}

#[test]
fn a_misspelt_number_is_refused() {
    let output = mesh(folder("").path(), &["--set", "siez=0.1"]);
    assert_eq!(output.status.code(), Some(1));
    let expected =
        "plate.geo does not mention `siez`; did you mean `size`? it declares: `size`, `radius`\n";
    assert!(stderr(&output).ends_with(expected), "{}", stderr(&output));
}

#[test]
fn a_geometry_that_is_not_there_is_named() {
    let output = ligament(["mesh", "nowhere/plate.geo"]);
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(
        stderr(&output),
        "error: there is no geometry nowhere/plate.geo\n"
    );
}

/// A plate whose coordinates are multiplied by 1/2, which is exact: from a geometry, and from the mesh itself with its y in the place of z.
#[test]
fn meshes_are_scaled_and_turned() {
    let folder = folder(&format!("cp {} \"$OUT\"", plate().display()));
    let half = |path: &str| {
        let mesh = gmsh::parse(&fs::read(folder.path().join(path)).unwrap()).unwrap();
        mesh.positions
    };
    let original = gmsh::parse(&fs::read(plate()).unwrap()).unwrap();
    let expected: Vec<[f64; 2]> = (original.positions.iter())
        .map(|it| it.map(|coordinate| 0.5 * coordinate))
        .collect();
    let output = mesh(folder.path(), &["--scale", "0.5"]);
    assert_success(&output);
    assert_eq!(half("plate.msh"), expected);
    let upright: Vec<[f64; 3]> = original
        .positions
        .iter()
        .map(|it| [it[0], 7.0, it[1]])
        .collect();
    let mut text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n".to_owned();
    text += &format!("{}\n", upright.len());
    for (tag, [x, y, z]) in original.node_tags.iter().zip(&upright) {
        text += &format!("{tag} {x} {y} {z}\n");
    }
    text += &format!("$EndNodes\n$Elements\n{}\n", original.cells.len());
    for (number, cell) in (1..).zip(&original.cells) {
        let corners = cell.corners().iter();
        let corners: Vec<String> = corners
            .map(|it| original.node_tags[*it as usize].to_string())
            .collect();
        text += &format!("{number} 2 2 0 1 {}\n", corners.join(" "));
    }
    let standing = folder.path().join("standing.msh");
    fs::write(&standing, text + "$EndElements\n").unwrap();
    let converted = |more: &[&str]| {
        ligament(
            ["mesh".as_ref(), standing.as_os_str()]
                .into_iter()
                .chain(more.iter().map(OsStr::new)),
        )
    };
    let refused = converted(&["--scale", "0.5"]);
    assert_eq!(refused.status.code(), Some(1));
    assert!(
        stderr(&refused).contains("`--plane xz` turns it"),
        "{}",
        stderr(&refused)
    );
    let refused = converted(&["--size", "0.5"]);
    assert!(
        stderr(&refused).contains("--size and --set are for geometries"),
        "{}",
        stderr(&refused)
    );
    let output = converted(&["--scale", "0.5", "--plane", "xz"]);
    assert_success(&output);
    assert!(
        stdout(&output).contains("turned from the plane of x and z"),
        "{}",
        stdout(&output)
    );
    assert_eq!(half("standing-gmsh.msh"), expected);
}
