//! Malicious input.

use super::*;
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// A square of two triangles, with `extra` sections behind it.
fn square(extra: &str) -> String {
    format!(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes\n\
         $Elements\n2\n1 2 2 1 1 1 2 3\n2 2 2 1 1 1 3 4\n$EndElements\n{extra}"
    )
}

/// A million load steps have a row each; more are probably a typing error.
#[test]
fn more_load_steps_than_make_sense_are_refused() {
    let place = Place::new();
    for setting in [
        "fracture.steps=4294967295",
        "fracture.refine_first_break=4294967295",
    ] {
        let output = place.ligament(["check", "case.toml", "--set", setting]);
        assert_refused(&output, &["1000000"]);
    }
}

/// 25 million points are estimated to take more memory than there is, before any of them is made; a case may say otherwise.
#[test]
fn memory_is_foreseen() {
    let place = Place::new();
    for command in ["check", "run"] {
        let output = place.limited(
            "ulimit -v 4000000",
            &format!("{command} case.toml --set lattice.cells=[5000,5000]"),
        );
        assert_refused(&output, &["GB of memory", "solver.memory"]);
    }
    let output = place.ligament(["run", "case.toml", "--set", "solver.memory=1e-3"]);
    assert_refused(&output, &["0.0 GB are available"]);
    assert!(!place.path("results").exists());
    assert_success(&place.ligament(["run", "case.toml", "--set", "solver.memory=1"]));
}

/// A mesh is read, or refused with a message about memory, for any limit: the program never ends in another way. Limits start where
/// the file itself does not fit, and rise in steps smaller than the memory of the checks of cells.
#[test]
fn memory_of_meshes_is_foreseen() {
    let place = Place::new();
    fs::write(place.path("quads.msh"), quadrangles(350)).unwrap();
    fs::write(place.path("boxes.msh"), boxes(38)).unwrap();
    for (mesh, command) in [
        ("quads.msh", "inspect quads.msh"),
        ("boxes.msh", "new boxes.msh --out boxes.toml --force"),
    ] {
        let mut codes = Vec::new();
        for megabytes in (60..300).step_by(8) {
            let limit = format!("export RAYON_NUM_THREADS=2; ulimit -v {}", 1000 * megabytes);
            let output = place.limited(&limit, command);
            let code = output.status.code();
            // Far below, even the program itself finds no room to start.
            if code == Some(1) || codes.contains(&Some(1)) {
                assert!(matches!(code, Some(0 | 1)), "{megabytes} MB: {output:?}");
                codes.push(code);
            }
            // With even more memory it works as before.
            if codes.ends_with(&[Some(0); 4]) {
                break;
            }
            if code == Some(1) {
                assert_refused(&output, &[mesh]);
            }
        }
        assert!(codes.len() > 4, "{mesh}: {codes:?}");
        assert_eq!(codes.last(), Some(&Some(0)), "{mesh}: {codes:?}");
    }
}

/// A mesh of format 2.2 of nodes in space and cells of a type by their corners.
fn mesh_of(nodes: &[[usize; 3]], code: u8, cells: &[Vec<usize>]) -> String {
    let mut text = format!(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{}\n",
        nodes.len()
    );
    for (index, [x, y, z]) in nodes.iter().enumerate() {
        let _ = writeln!(text, "{} {x} {y} {z}", index + 1);
    }
    let _ = write!(text, "$EndNodes\n$Elements\n{}\n", cells.len());
    for (index, corners) in cells.iter().enumerate() {
        let corners: Vec<String> = corners.iter().map(|it| (it + 1).to_string()).collect();
        let _ = writeln!(text, "{} {code} 2 1 1 {}", index + 1, corners.join(" "));
    }
    text + "$EndElements\n"
}

/// A square of `side` by `side` quadrangles.
fn quadrangles(side: usize) -> String {
    let n = side + 1;
    let nodes: Vec<[usize; 3]> = (0..n * n).map(|it| [it % n, it / n, 0]).collect();
    let corner = |cell: usize| cell % side + n * (cell / side);
    let cell = |cell| [0, 1, n + 1, n].map(|it| corner(cell) + it).to_vec();
    let cells: Vec<Vec<usize>> = (0..side * side).map(cell).collect();
    mesh_of(&nodes, 3, &cells)
}

/// A cube of `side` hexahedra along each side.
fn boxes(side: usize) -> String {
    let n = side + 1;
    let place = |it: usize, n: usize| [it % n, it / n % n, it / (n * n)];
    let nodes: Vec<[usize; 3]> = (0..n * n * n).map(|it| place(it, n)).collect();
    let cell = |cell| {
        let [x, y, z] = place(cell, side);
        let base = x + n * (y + n * z);
        let face = [0, 1, n + 1, n].map(|it| base + it);
        face.into_iter().chain(face.map(|it| it + n * n)).collect()
    };
    let cells: Vec<Vec<usize>> = (0..side * side * side).map(cell).collect();
    mesh_of(&nodes, 5, &cells)
}

/// A body in the plane whose factor does not fit into the memory is solved without a matrix, with a message; by both drivers, and the same
/// bonds break as with a factor.
#[test]
fn a_factor_that_does_not_fit_is_not_made() {
    let place = Place::new();
    let settings = "--set lattice.cells=[120,60] --set model.horizon_factor=3 --set fracture.stop={bonds=20} \
                    --set load.0.displacement.x=2e-3";
    for control in [
        "stepped --set fracture.steps=4",
        "event --unset fracture.steps",
    ] {
        let run = |out: &str, memory: &str| {
            let words = format!(
                "run case.toml --out {out} --force {settings} --set solver.memory={memory} --set fracture.control={control}"
            );
            assert_success(&place.ligament(words.split_whitespace().collect::<Vec<_>>()));
            let summary = fs::read_to_string(place.path(out).join("summary.json")).unwrap();
            let summary: serde_json::Value = serde_json::from_str(&summary).unwrap();
            let solver = &summary["solver"];
            let text = |key: &str| solver[key].as_str().unwrap().to_owned();
            let broken = fs::read_to_string(place.path(out).join("breaks.csv")).unwrap();
            // Order, step and round; cells at the ends.
            let kept = |line: &str| -> Vec<String> {
                let columns: Vec<&str> = line.split(',').collect();
                [0, 1, 2, 6, 7].map(|it| columns[it].to_owned()).to_vec()
            };
            let bonds: Vec<Vec<String>> = broken.lines().map(kept).collect();
            (text("method"), text("reason"), bonds)
        };
        let [small, large] = [run("small", "0.12"), run("large", "2")];
        assert_eq!([small.0.as_str(), &large.0], ["iterative", "direct"]);
        assert!(small.1.contains("does not fit into memory"), "{}", small.1);
        assert!(small.2.len() > 20 && small.2 == large.2, "{control}");
    }
    let words = format!("check case.toml {settings} --set solver.memory=0.12");
    let told = place.ligament(words.split_whitespace().collect::<Vec<_>>());
    assert!(stdout(&told).contains("the factor does not fit into memory"));
}

/// `check` estimates the disk space of fields and bonds: at least as much as they take, and at most twice as much.
#[test]
fn room_on_the_disk_is_foreseen() {
    let place = Place::new();
    let settings =
        "--set output.bonds=true --set output.fields_every=1 --set lattice.cells=[60,30]";
    let with_settings = |command: &str| {
        let words = format!("{command} {settings}");
        let output = place.ligament(words.split_whitespace().collect::<Vec<_>>());
        assert_success(&output);
        stdout(&output)
    };
    let told = with_settings("check case.toml --all");
    let line = |what: &str| told.lines().find(|line| line.starts_with(what)).unwrap();
    assert!(line("  free on the disk ").ends_with(" MB"), "{told}");
    // "about 10.9 MB, at most 12 states of 0.9 MB"
    let words: Vec<&str> = line("  fields on disk ").split_whitespace().collect();
    let place_of = |word: &str| words.iter().position(|&it| it == word).unwrap();
    let most: usize = words[place_of("states") - 1].parse().unwrap();
    let foreseen: f64 = words[words.len() - 2].parse().unwrap();

    with_settings("run case.toml --out out --quiet");
    let mut states = BTreeMap::new();
    for file in fs::read_dir(place.path("out")).unwrap() {
        let file = file.unwrap();
        let name = file.file_name().into_string().unwrap();
        if let Some((_, state)) = name.split_once('_')
            && name.ends_with(".vtu")
        {
            *states.entry(state.to_owned()).or_default() +=
                file.metadata().unwrap().len() as f64 / 1e6;
        }
    }
    assert!((2..=most).contains(&states.len()), "{states:?}");
    let largest = states.into_values().fold(0.0, f64::max);
    // The line is rounded to 0.1 MB.
    let is_near = largest <= foreseen + 0.05 && foreseen <= 2.0 * largest;
    assert!(is_near, "{largest} MB, {words:?}");
}

/// Sections without values cost nothing, however many there are.
#[test]
fn empty_sections_of_a_mesh_take_no_memory() {
    let place = Place::new();
    let mut nodes = String::new();
    for node in 1..=200_u32 {
        for row in 1..=200_u32 {
            let _ = writeln!(nodes, "{} {node} {row} 0", 200 * (node - 1) + row);
        }
    }
    let mut cells = String::new();
    for (cell, corner) in (0..199_u32)
        .flat_map(|x| (1..200_u32).map(move |y| 200 * x + y))
        .enumerate()
    {
        let [a, b, c, d] = [corner, corner + 200, corner + 201, corner + 1];
        let _ = writeln!(cells, "{} 3 2 1 1 {a} {b} {c} {d}", cell + 1);
    }
    let empty = "$NodeData\n1\n\"a\"\n1\n0\n3\n0\n1\n0\n$EndNodeData\n".repeat(10_000);
    let mesh = format!(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n40000\n{nodes}$EndNodes\n$Elements\n39601\n{cells}$EndElements\n{empty}"
    );
    fs::write(place.path("many.msh"), mesh).unwrap();
    assert_success(&place.limited("ulimit -v 1500000", "inspect many.msh"));
}

/// A mesh that does not fit into the available memory is an error with its size, and does not end the program by a signal.
///
/// The limits lie between the memory of the program itself (30 MB) and that of a mesh of 400,000 cells (140 MB).
#[test]
fn a_mesh_without_memory_is_refused() {
    let place = Place::new();
    let n = 640;
    let mut mesh = format!("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{}\n", n * n);
    for node in 0..n * n {
        let _ = writeln!(mesh, "{} {} {} 0", node + 1, node % n, node / n);
    }
    let _ = writeln!(mesh, "$EndNodes\n$Elements\n{}", (n - 1) * (n - 1));
    for cell in 0..(n - 1) * (n - 1) {
        let a = 1 + n * (cell / (n - 1)) + cell % (n - 1);
        let _ = writeln!(
            mesh,
            "{} 3 2 1 1 {a} {} {} {}",
            cell + 1,
            a + 1,
            a + 1 + n,
            a + n
        );
    }
    fs::write(place.path("large.msh"), mesh + "$EndElements\n").unwrap();
    assert_success(&place.limited("ulimit -v 400000", "inspect large.msh"));
    for kilobytes in [80_000, 100_000, 120_000] {
        let limits = format!("ulimit -v {kilobytes}");
        let output = place.limited(&limits, "inspect large.msh");
        assert_refused(&output, &["no memory for this mesh", "MB more"]);
    }
}

/// A name may have any length, a column may not.
#[test]
fn a_name_may_be_longer_than_a_column() {
    let place = Place::new();
    let name = "n".repeat(70_000);
    let names = format!("$PhysicalNames\n1\n2 1 \"{name}\"\n$EndPhysicalNames\n");
    fs::write(place.path("long.msh"), square(&names)).unwrap();
    let output = place.ligament(["inspect", "long.msh"]);
    assert_success(&output);
    assert!(stdout(&output).contains(&name));
}

/// Constants whose products leave the range of double precision have no stiffness.
#[test]
fn constants_without_a_stiffness_are_refused() {
    let place = Place::new();
    let orthotropic = "young_1 = 1e10\nyoung_2 = 1e9\npoisson_12 = 0.2\nshear_modulus = 1e9\n";
    let case = SMALL_BAR
        .replace("young = 1e9\npoisson = 0.2\n", orthotropic)
        .replace("nhpd", "orthotropic");
    fs::write(place.path("orthotropic.toml"), case).unwrap();
    for key in ["young_1", "shear_modulus"] {
        let setting = format!("material.{key}=1e308");
        let output = place.ligament(["check", "orthotropic.toml", "--set", &setting]);
        assert_refused(&output, &["double precision"]);
    }
}

/// Pipes and devices are refused at once as input files.
#[test]
fn pipes_and_devices_are_refused() {
    let place = Place::new();
    assert!(
        Command::new("mkfifo")
            .arg(place.path("pipe"))
            .status()
            .unwrap()
            .success()
    );
    for arguments in [
        &["inspect", "pipe"][..],
        &["inspect", "/dev/zero"],
        &["run", "pipe"],
        &["sweep", "pipe"],
        &["new", "pipe", "--out", "new.toml"],
    ] {
        assert_refused(&place.ligament(arguments), &["pipe or a device"]);
    }
    place.run();
    fs::remove_file(place.path("out/history.csv")).unwrap();
    fs::rename(place.path("pipe"), place.path("out/history.csv")).unwrap();
    let output = place.ligament(["explain", "out", "--at", "0.05,0.03"]);
    assert_eq!(output.status.code(), Some(1));
}

/// Titles and names come from others: their control characters are shown, not sent to the terminal.
#[test]
fn escape_sequences_are_not_sent() {
    let place = Place::new();
    let case = SMALL_BAR.replace("Small bar", "Small\\u001b]0;renamed\\u0007 bar\\u009b2J");
    fs::write(place.path("case.toml"), case).unwrap();
    fs::write(
        place.path("names.msh"),
        square("$PhysicalNames\n1\n2 1 \"a\u{1b}[31mred\"\n$EndPhysicalNames\n"),
    )
    .unwrap();
    for arguments in [
        ["run", "case.toml"],
        ["check", "case.toml"],
        ["inspect", "names.msh"],
    ] {
        let output = place.ligament(arguments);
        let said = stdout(&output) + &stderr(&output);
        assert_success(&output);
        assert!(said.contains("\\u{1b}"), "{said}");
        assert!(!said.contains(['\u{1b}', '\u{7}', '\u{9b}']), "{said:?}");
    }
}

/// The case of a study may have a name that looks like an option.
#[test]
fn a_name_is_no_option() {
    let place = Place::new();
    fs::write(place.path("-case.toml"), SMALL_BAR).unwrap();
    let study =
        "case = \"-case.toml\"\n[[axis]]\nkey = \"model.horizon_factor\"\nvalues = [2.2, 2.4]\n";
    fs::write(place.path("study.toml"), study).unwrap();
    assert_success(&place.ligament(["sweep", "study.toml", "--out", "./-out"]));
}

/// Python imports its packages from its own folders, not from files in the current folder.
#[test]
fn files_of_the_current_folder_are_no_packages() {
    let place = Place::new();
    let write = "open('executed', 'w').close()\n";
    for name in ["numpy.py", "meshio.py", "contextlib.py", "pathlib.py"] {
        fs::write(place.path(name), write).unwrap();
    }
    fs::write(place.path("a.inp"), "*NODE\n").unwrap();
    let python = std::env::var("LIGAMENT_PYTHON").unwrap_or_else(|_| "python3".to_owned());
    let arguments = ["mesh", "--via-meshio", "a.inp", "--python", &python];
    let output = place.ligament(arguments);
    assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
    assert!(
        !stderr(&output).contains("cannot start"),
        "{}",
        stderr(&output)
    );
    assert!(!place.path("executed").exists(), "{}", stderr(&output));
}
