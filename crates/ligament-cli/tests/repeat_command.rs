//! `ligament repeat`: runs that are repeated from the record in their results, and told apart by a single bit.
#![cfg(unix)]
#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

use serde_json::Value;
use tempfile::TempDir;

const DISK: &str = r#"
mesh = { file = "disk.msh" }
material = { young = 15e9, poisson = 0.21, tensile_strength = 3.81e6, thermal_expansion = 1e-5 }
model = { law = "nhpd", horizon_factor = 3.0 }
support = [{ group = "platen-bottom", displacement = { x = 0.0, y = 0.0 } }]
load = [{ group = "platen-top", displacement = { y = -4e-4 } }]
temperature = [{ file = "change.csv" }]
fracture = { steps = 50, stop = { bonds = 12 } }
output = { fields_every = 20 }
"#;

/// A table that raises the temperature of all nodes of a mesh by a change.
fn table(mesh: &str, change: f64) -> String {
    let nodes = mesh.split("$Nodes").nth(1).unwrap();
    let mut rows = "x,y,change\n".to_owned();
    for line in nodes.split("$EndNodes").next().unwrap().lines() {
        // Other lines there have one word or four.
        if let [x, y, _] = line.split_whitespace().collect::<Vec<_>>()[..] {
            rows += &format!("{x},{y},{change}\n");
        }
    }
    rows
}

/// A notched lattice that takes some seconds to break.
const PLATE: &str = r#"
lattice = { cells = [36, 36], spacing = 0.001, set = { bottom = { bottom = 1 }, top = { top = 1 } } }
material = { young = 30e9, poisson = 0.3, fracture_energy = 100.0, tensile_strength = 3e6 }
model = { law = "mppd", horizon_factor = 3.0 }
precrack = [{ points = [[-0.001, 0.0181], [0.0121, 0.0181]] }]
support = [{ group = "bottom", displacement = { x = 0.0, y = 0.0 } }]
load = [{ group = "top", displacement = { y = 1e-5 } }]
"#;

/// A folder with a case.
struct Bench(TempDir);

/// The exit code, and all messages in one line.
type Said = (Option<i32>, String);

impl Bench {
    fn new(case: &str) -> Self {
        let folder = TempDir::new().unwrap();
        let mesh = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../meshes/disk-4mm.msh");
        fs::copy(mesh, folder.path().join("disk.msh")).unwrap();
        let mesh = fs::read_to_string(folder.path().join("disk.msh")).unwrap();
        fs::write(folder.path().join("change.csv"), table(&mesh, 1.0)).unwrap();
        fs::write(folder.path().join("case.toml"), case).unwrap();
        Self(folder)
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_ligament"));
        let command_here = command.current_dir(self.0.path());
        command_here.args(arguments).arg("--quiet");
        command
    }

    fn ligament(&self, arguments: &[&str]) -> Said {
        said(&self.command(arguments).output().unwrap())
    }

    /// Runs the case into `out`.
    fn run(&self, code: i32, more: &[&str]) {
        let arguments = [&["run", "case.toml", "--out", "out"], more].concat();
        let (found, words) = self.ligament(&arguments);
        assert_eq!(found, Some(code), "{words}");
    }

    fn repeat(&self, more: &[&str]) -> Said {
        self.ligament(&[&["repeat", "out"], more].concat())
    }

    /// Repeats the run, which has the same results and leaves no folder; returns the messages.
    fn assert_same(&self, more: &[&str]) -> String {
        let (code, words) = self.repeat(more);
        assert_eq!(code, Some(0), "{words}");
        assert!(words.contains("the same to the last bit"), "{words}");
        assert!(!self.path("out.repeat").exists());
        words
    }

    /// Repeats the run, which has other results; returns the messages.
    fn assert_different(&self) -> String {
        let (code, words) = self.repeat(&[]);
        assert_eq!(code, Some(5), "{words}");
        fs::remove_dir_all(self.path("out.repeat")).unwrap();
        words
    }

    /// Tries to repeat the run, which is refused; returns the reasons.
    fn refused(&self, more: &[&str]) -> String {
        let (code, words) = self.repeat(more);
        assert_eq!(code, Some(1), "{words}");
        assert!(!self.path("out.repeat").exists());
        words
    }

    /// Changes the text of a result.
    fn change(&self, name: &str, change: impl FnOnce(String) -> String) {
        let path = self.path("out").join(name);
        let text = fs::read_to_string(&path).unwrap();
        let changed = change(text.clone());
        assert_ne!(text, changed);
        fs::write(path, changed).unwrap();
    }

    fn summary(&self) -> Value {
        let text = fs::read_to_string(self.path("out/summary.json")).unwrap();
        serde_json::from_str(&text).unwrap()
    }

    fn set_summary(&self, summary: &Value) {
        fs::write(self.path("out/summary.json"), summary.to_string()).unwrap();
    }
}

fn said(output: &Output) -> Said {
    let words = [&output.stdout, &output.stderr].map(|it| String::from_utf8_lossy(it));
    (output.status.code(), words.concat().replace('\n', " "))
}

/// A run on one thread is repeated on one and on three; results go to another folder if one is named.
#[test]
fn equal_runs_have_equal_bits() {
    let bench = Bench::new(DISK);
    bench.run(0, &["--threads", "1"]);
    bench.assert_same(&[]);
    bench.assert_same(&["--threads", "3"]);
    let (code, words) = bench.repeat(&["--out", "again"]);
    assert_eq!(code, Some(0), "{words}");
    assert!(bench.path("again/summary.json").is_file() && words.contains("again"));
    let (code, words) = bench.repeat(&["--out", "again"]);
    assert!(
        code == Some(1) && words.contains("exists already"),
        "{words}"
    );
}

/// The record names the program and all files that were read.
#[test]
fn the_summary_says_what_it_came_from() {
    let bench = Bench::new(DISK);
    bench.run(0, &[]);
    let record = &bench.summary()["provenance"];
    let is_commit = |it: &str| it.len() == 40 && it.bytes().all(|it| it.is_ascii_hexdigit());
    // Outside a checkout there is none.
    assert!(record["commit"].as_str().is_none_or(is_commit), "{record}");
    assert_eq!(
        record["commit"].is_null(),
        record["uncommitted_changes"].is_null()
    );
    assert!(record["compiler"].as_str().unwrap().starts_with("rustc "));
    let inputs = record["inputs"].as_array().unwrap();
    let keys: Vec<Option<&str>> = inputs.iter().map(|input| input["key"].as_str()).collect();
    assert_eq!(keys, [None, Some("mesh.file"), Some("temperature.0.file")]);
    for input in inputs {
        let file = bench.path("out").join(input["file"].as_str().unwrap());
        assert_eq!(input["bytes"], fs::metadata(file).unwrap().len());
        assert_eq!(input["xxh64"].as_str().unwrap().len(), 16);
    }
}

/// One digit of one number is found, with its place and size; a difference of program or processor is told.
#[test]
fn a_changed_number_is_found() {
    let bench = Bench::new(DISK);
    bench.run(0, &[]);
    let summary = bench.summary();
    let history = fs::read_to_string(bench.path("out/history.csv")).unwrap();
    bench.change("history.csv", |table| {
        let mut lines: Vec<String> = table.lines().map(str::to_owned).collect();
        let mut cells: Vec<String> = lines[5].split(',').map(str::to_owned).collect();
        let value: f64 = cells[3].parse().unwrap();
        cells[3] = format!("{:?}", value * (1.0 + 1e-12));
        lines[5] = cells.join(",");
        lines.join("\n") + "\n"
    });
    let words = bench.assert_different();
    let place = "history.csv: line 6 (step 4), column reaction: ";
    for part in [
        "NOT THE SAME in 1 of",
        place,
        " then, ",
        " now, relative difference 1.0e-12",
    ] {
        assert!(words.contains(part), "{part}: {words}");
    }
    assert!(
        words.contains("program and processor are the same"),
        "{words}"
    );
    fs::write(bench.path("out/history.csv"), &history).unwrap();

    let mut other = summary.clone();
    other["first_break"]["reaction"] = 1.0.into();
    other["provenance"]["processor"] = "Abacus".into();
    bench.set_summary(&other);
    let words = bench.assert_different();
    for part in [
        "summary.json: `first_break.reaction`: 1.0 then",
        "Abacus then",
    ] {
        assert!(words.contains(part), "{part}: {words}");
    }
    bench.set_summary(&summary);

    // The fields of another load.
    fs::copy(
        bench.path("out/fields_0020.vtu"),
        bench.path("out/fields_0000.vtu"),
    )
    .unwrap();
    fs::remove_file(bench.path("out/fields_0020.vtu")).unwrap();
    let words = bench.assert_different();
    for part in [
        "NOT THE SAME in 2 of",
        "fields_0000.vtu: field displacement x at node ",
        "fields_0020.vtu: only the repetition has it",
    ] {
        assert!(words.contains(part), "{part}: {words}");
    }
}

/// A run whose mesh, table or case has changed, or whose mesh is missing, is not repeated; the message names the input.
#[test]
fn changed_inputs_are_named() {
    let bench = Bench::new(DISK);
    bench.run(0, &[]);
    fs::rename(bench.path("disk.msh"), bench.path("moved.msh")).unwrap();
    let words = bench.refused(&[]);
    assert!(
        words.contains("`mesh.file` cannot be read") && words.contains("--mesh"),
        "{words}"
    );
    bench.assert_same(&["--mesh", "moved.msh"]);
    let mesh = fs::read_to_string(bench.path("moved.msh")).unwrap();
    fs::write(bench.path("disk.msh"), mesh.replacen("0.0", "0.1", 1)).unwrap();
    fs::write(bench.path("change.csv"), table(&mesh, 2.0)).unwrap();
    let words = bench.refused(&[]);
    for part in [
        "`mesh.file`, ",
        "disk.msh: ",
        "`temperature.0.file`",
        "change.csv",
        " now",
    ] {
        assert!(words.contains(part), "{part}: {words}");
    }
    fs::write(bench.path("disk.msh"), &mesh).unwrap();
    fs::write(bench.path("change.csv"), table(&mesh, 1.0)).unwrap();
    bench.assert_same(&[]);
    bench.change("case.resolved.toml", |case| {
        case.replace("1.5e10", "1.6e10")
    });
    let words = bench.refused(&[]);
    assert!(
        words.contains("the case of the run") && words.contains("case.resolved.toml"),
        "{words}"
    );
}

/// Results of an earlier version, of a run that has not ended, and none at all.
#[test]
fn folders_that_are_not_as_they_should_be() {
    let bench = Bench::new(DISK);
    let words = bench.refused(&[]);
    assert!(words.contains("there is no such folder"), "{words}");
    bench.run(0, &[]);
    let mut summary = bench.summary();
    summary.as_object_mut().unwrap().remove("provenance");
    bench.set_summary(&summary);
    assert!(
        bench
            .assert_same(&[])
            .contains("have no record of commit and inputs")
    );
    let lock = File::create(bench.path("out/.lock")).unwrap();
    lock.lock().unwrap();
    assert!(bench.refused(&[]).contains("is in use"));
    // Closing would not do: a program that another test is about to start has a copy of the file until then.
    lock.unlock().unwrap();
    fs::create_dir(bench.path("out.repeat")).unwrap();
    let (code, words) = bench.repeat(&[]);
    assert!(
        code == Some(1) && words.contains("exists already"),
        "{words}"
    );
    fs::remove_dir(bench.path("out.repeat")).unwrap();
    fs::remove_file(bench.path("out/summary.json")).unwrap();
    assert!(bench.refused(&[]).contains("is incomplete"));
}

/// A run that was cut short by a signal or its time limit is repeated up to there, and is the same; so is one that was resumed later.
#[test]
fn runs_that_were_cut_short_are_compared_up_to_there() {
    for fracture in [
        "fracture = { steps = 100, bonds_per_iteration = 1, stop = { bonds = 400 } }",
        "fracture = { control = \"event\", stop = { bonds = 400 } }",
    ] {
        let bench = Bench::new(&format!("{PLATE}{fracture}\n"));
        let mut run = bench.command(&["run", "case.toml", "--out", "out"]);
        let mut child = run.stdout(Stdio::null()).spawn().unwrap();
        let start = Instant::now();
        let breaks = || fs::read_to_string(bench.path("out/breaks.csv")).unwrap_or_default();
        while breaks().lines().count() < 20 {
            assert!(start.elapsed() < Duration::from_secs(100));
            std::thread::sleep(Duration::from_millis(1));
        }
        let id = child.id().to_string();
        let sent = Command::new("kill").args(["-INT", &id]).status();
        assert!(sent.unwrap().success());
        assert_eq!(child.wait().unwrap().code(), Some(4));
        assert!(bench.assert_same(&[]).contains("cut short"));

        let (code, words) = bench.ligament(&["resume", "out"]);
        assert_eq!(code, Some(0), "{words}");
        assert!(bench.assert_same(&[]).contains("was resumed"));
        // A fifth of what the run takes on a quick machine.
        let time = ["--set", "fracture.stop.wall_time=0.05", "--force"];
        bench.run(0, &time);
        assert_eq!(bench.summary()["termination"], "wall-time");
        assert!(bench.assert_same(&[]).contains("cut short"));
    }
}

/// Natural modes, an elastic solution, and a body without supports.
#[test]
fn other_runs_are_repeated() {
    let fracture = DISK.find("temperature").unwrap();
    let elastic = &DISK[..fracture];
    let modal = elastic.replace("tensile", "density = 2500.0, tensile");
    let held = &modal[..modal.find("load").unwrap()];
    let modal = format!("analysis = \"modal\"\n{held}modal = {{ modes = 4 }}\n");
    let unheld = PLATE
        .replace("support = ", "# ")
        .replace("displacement = { y = 1e-5 }", "force = { y = 1e4 }");
    for (case, code) in [(elastic, 0), (&modal, 0), (&unheld, 3)] {
        let bench = Bench::new(case);
        bench.run(code, &[]);
        let words = bench.assert_same(&[]);
        assert_eq!(
            code == 3,
            words.contains("no equilibrium under load"),
            "{words}"
        );
    }
}

/// A block of cells that is pulled apart.
const BLOCK: &str = r#"
solid_lattice = { cells = [4, 4, 8], spacing = [0.01, 0.01, 0.01], set = { low = { bottom = 1 }, high = { top = 1 } } }
material = { young = 30e9, poisson = 0.2, tensile_strength = 3e6 }
model = { law = "nhpd", horizon_factor = 2.0 }
support = [{ group = "low", displacement = { x = 0.0, y = 0.0, z = 0.0 } }]
load = [{ group = "high", displacement = { z = 2e-5 } }]
fracture = { steps = 10, stop = { load_fraction = 0.3 } }
"#;

/// Files of cracks and surfaces are derived from results afterwards, and are not compared.
#[test]
fn surfaces_that_were_made_later_are_no_difference() {
    let bench = Bench::new(BLOCK);
    bench.run(0, &[]);
    bench.assert_same(&[]);
    for more in [["--step", "all"], ["--iso", "0.1"]] {
        let mut command = Command::new(env!("CARGO_BIN_EXE_ligament"));
        let command = command.arg("crack").arg(bench.path("out")).args(more);
        let (code, words) = said(&command.output().unwrap());
        assert_eq!(code, Some(0), "{words}");
    }
    for name in ["crack.stl", "crack_0005.vtu", "crack.pvd", "iso.vtu"] {
        assert!(bench.path("out").join(name).is_file(), "{name}");
    }
    bench.assert_same(&[]);
}
