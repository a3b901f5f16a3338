//! Axes of the numbers of a geometry, with a shell script in place of gmsh.

use super::*;
use std::os::unix::fs::PermissionsExt;

const STUDY: &str = r#"case = "bar/mesh.toml"
geometry = "plate.geo"
[[axis]]
number = "size"
values = [1, 2, 3]
[[axis]]
key = "model.horizon_factor"
values = [2.5, 3.0]
"#;

/// A mesh for each combination of numbers, made once; where gmsh fails, the runs of that mesh fail.
#[test]
fn each_mesh_is_made_once() {
    let place = Place::with(STUDY);
    let (from, to) = (
        SMALL_BAR.find("[lattice]").unwrap(),
        SMALL_BAR.find("[material]").unwrap(),
    );
    let case = SMALL_BAR[..from].to_owned() + "[mesh]\nthickness = 0.01\n" + &SMALL_BAR[to..];
    fs::write(place.path("bar/mesh.toml"), case).unwrap();
    fs::write(place.path("plate.geo"), "DefineConstant[ size = 0.1 ];\n").unwrap();
    let meshes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../meshes");
    let script = format!(
        "#!/bin/sh\ncase \"$*\" in *'size 3'*) echo 'Error : too large'; exit 1;; esac\n\
         echo made >> count\ncp {} \"$4\"\n",
        meshes.join("plate-coarse.msh").display()
    );
    let gmsh = place.path("gmsh");
    fs::write(&gmsh, script).unwrap();
    fs::set_permissions(&gmsh, fs::Permissions::from_mode(0o755)).unwrap();

    let list = place.sweep(&["--list"]);
    assert_success(&list);
    assert!(stdout(&list).contains("no mesh yet"), "{}", stdout(&list));
    let output = place.sweep(&["--gmsh", "./gmsh"]);
    assert_eq!(output.status.code(), Some(1));
    let table = place.table();
    assert_eq!(table.column("run")[0], "size=1,horizon_factor=2.5");
    assert_eq!(table.column("size"), ["1", "1", "2", "2", "3", "3"]);
    assert_eq!(
        table.column("status"),
        ["done", "done", "done", "done", "failed", "failed"]
    );
    assert!(
        table.column("error")[4].contains("too large"),
        "{}",
        table.column("error")[4]
    );
    let made = || {
        fs::read_to_string(place.path("count"))
            .unwrap()
            .lines()
            .count()
    };
    assert_eq!(made(), 2);
    place.sweep(&["--gmsh", "./gmsh"]);
    assert_eq!(made(), 2, "meshes are kept");

    // Another geometry is another mesh, and other runs.
    fs::write(place.path("plate.geo"), "DefineConstant[ size = 0.2 ];\n").unwrap();
    let before = place.summaries();
    let output = place.sweep(&["--gmsh", "./gmsh"]);
    assert!(
        stderr(&output).contains("repeated, because its inputs changed"),
        "{}",
        stderr(&output)
    );
    assert_eq!(made(), 4);
    let after = place.summaries();
    assert!(after.iter().all(|(name, written)| before[name] != *written));

    // A number that the geometry does not have stops all, and no program as well.
    place.study(&STUDY.replace("\"size\"", "\"sise\""));
    let output = place.sweep(&["--gmsh", "./gmsh"]);
    assert!(
        stderr(&output).contains("does not mention `sise`; did you mean `size`?"),
        "{}",
        stderr(&output)
    );
    let output = place.sweep(&["--gmsh", "./none"]);
    assert_eq!(output.status.code(), Some(1));
}
