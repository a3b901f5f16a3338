//! A case whose runs are stopped and killed, and the contents of their folders.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

use serde_json::Value;
use tempfile::TempDir;

const CASE: &str = r#"
lattice = { cells = [24, 24], spacing = 0.001, set = { bottom = { bottom = 1 }, top = { top = 1 } } }
material = { young = 30e9, poisson = 0.3, fracture_energy = 100.0, tensile_strength = 3e6, density = 2400.0 }
model = { law = "mppd", horizon_factor = 3.0 }
precrack = [{ points = [[-0.001, 0.0121], [0.0081, 0.0121]] }]
support = [{ group = "bottom", displacement = { x = 0.0, y = 0.0 } }]
"#;

pub(super) const STEPPED: &str = "load = [{ group = \"top\", displacement = { y = 1e-5 } }]
fracture = { steps = 100, bonds_per_iteration = 1, stop = { bonds = 150 } }
output = { fields_every = 7, during_breakage = 3, bonds = true, checkpoint_every = EVERY }";
pub(super) const EVENT: &str = "load = [{ group = \"top\", displacement = { y = 1e-5 } }]
fracture = { control = \"event\", stop = { bonds = 150 } }
output = { fields_every = 20, bonds = true, checkpoint_every = EVERY }";
pub(super) const SOFTENING: &str = "load = [{ group = \"top\", displacement = { y = 2e-4 } }]
output = { fields_every = 7, checkpoint_every = EVERY }
fracture = { steps = 60, stop = { load_fraction = 0.3 }, criterion = [{ kind = \"bond-energy\", limit = 1e-4, after = \"bilinear\" }] }";

/// A ball with a mass hits the body, with friction; in explicit steps it turns.
pub(super) const EXPLICIT: &str = "analysis = \"motion\"
motion = { duration = 4e-5, rows = 60 }
rigid = [{ name = \"ball\", shape = \"circle\", centre = [0.012, 0.02705], radius = 0.003, mass = 0.005, inertia = 1e-8, \
    velocity = { x = 2.0, y = -20.0 }, friction = 0.3 }]
fracture = { }
output = { fields_every = 7, bonds = true, checkpoint_every = EVERY }";
pub(super) const IMPLICIT: &str = "analysis = \"motion\"
motion = { scheme = \"implicit\", duration = 4e-5, step = 2e-7, rows = 50 }
rigid = [{ name = \"ball\", shape = \"circle\", centre = [0.012, 0.02705], radius = 0.003, mass = 0.005, velocity = { x = 2.0, y = -20.0 }, \
    friction = 0.3 }]
fracture = { }
output = { fields_every = 7, bonds = true, checkpoint_every = EVERY }";

/// A place for runs of one case.
pub(super) struct Bench {
    folder: TempDir,
}

impl Bench {
    /// A case with a way of breaking bonds, and a number of seconds between two checkpoints.
    pub(super) fn new(fracture: &str, every: &str) -> Self {
        let folder = TempDir::new().unwrap();
        let case = format!("{CASE}{}\n", fracture.replace("EVERY", every));
        fs::write(folder.path().join("case.toml"), case).unwrap();
        Self { folder }
    }

    pub(super) fn out(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub(super) fn run(&self, name: &str, more: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_ligament"));
        let case = self.folder.path().join("case.toml");
        command
            .arg("run")
            .arg(case)
            .arg("--out")
            .arg(self.out(name));
        command.args(["--threads", "1"]).args(more);
        command
    }

    pub(super) fn resume(&self, name: &str, more: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_ligament"));
        command.arg("resume").arg(self.out(name)).args(more);
        command
    }
}

fn done(mut command: Command) -> Output {
    command.output().unwrap()
}

/// Runs a command, which must succeed; returns its standard error.
pub(super) fn succeeded(command: Command) -> String {
    let output = done(command);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(0), "{said}");
    said
}

/// Runs a command, which must fail; returns the reasons in one line.
pub(super) fn refused(command: Command) -> String {
    let output = done(command);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(1), "{said}");
    said.replace('\n', " ")
}

pub(super) fn started(mut command: Command) -> Child {
    let quiet = command.stdout(Stdio::null()).stderr(Stdio::null());
    quiet.spawn().unwrap()
}

/// Sends signals to a program, one right after the other.
pub(super) fn send(signals: &[&str], child: &Child) {
    let kills: Vec<_> = signals
        .iter()
        .map(|signal| format!("kill {signal} {}", child.id()))
        .collect();
    let sent = Command::new("sh").args(["-c", &kills.join("; ")]).status();
    assert!(sent.unwrap().success());
}

/// Rows of the history.
pub(super) fn rows(folder: &Path) -> usize {
    let table = fs::read_to_string(folder.join("history.csv"));
    table.unwrap_or_default().lines().count()
}

/// Waits until the history has more than `before` rows.
pub(super) fn wait_for_rows(folder: &Path, before: usize, child: &mut Child) {
    let start = Instant::now();
    while rows(folder) <= before {
        assert!(child.try_wait().unwrap().is_none(), "it ended too early");
        assert!(start.elapsed() < Duration::from_secs(100));
        std::thread::sleep(Duration::from_millis(1));
    }
}

/// Whether a key of a summary contains times, memory, threads or the build.
fn is_passing(key: &str) -> bool {
    ["stages", "threads", "provenance"].contains(&key) || key.ends_with("seconds")
}

fn without_passing(value: &mut Value) {
    if let Value::Object(map) = value {
        map.retain(|key, _| !is_passing(key));
        map.values_mut().for_each(without_passing);
    }
}

/// The results in a folder, without checkpoints, times and memory.
pub(super) fn results(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut files = BTreeMap::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_str().unwrap().to_owned();
        let mut content = fs::read(&path).unwrap();
        if name == "summary.json" {
            let mut summary: Value = serde_json::from_slice(&content).unwrap();
            without_passing(&mut summary);
            content = summary.to_string().into_bytes();
        }
        if name == "case.resolved.toml" {
            let text = String::from_utf8(content).unwrap();
            let kept = text.lines().filter(|line| !line.starts_with("threads"));
            content = kept.collect::<Vec<_>>().join("\n").into_bytes();
        }
        if name != "timings.csv" && !name.starts_with("checkpoint") && !name.starts_with('.') {
            files.insert(name, content);
        }
    }
    assert!(files.contains_key("summary.json"), "{:?}", files.keys());
    files
}

/// Two folders hold the same results to the last byte.
pub(super) fn assert_same(one: &Path, other: &Path) {
    let (one, other) = (results(one), results(other));
    assert!(one.len() > 8, "{:?}", one.keys());
    assert_eq!(
        one.keys().collect::<Vec<_>>(),
        other.keys().collect::<Vec<_>>()
    );
    let differs = one.iter().find(|(name, content)| other[*name] != **content);
    assert_eq!(differs.map(|(name, _)| name), None);
}

/// Short name of the end of a run, from its summary.
pub(super) fn termination(folder: &Path) -> String {
    let text = fs::read_to_string(folder.join("summary.json")).unwrap();
    let summary: Value = serde_json::from_str(&text).unwrap();
    summary["termination"].as_str().unwrap().to_owned()
}
