//! `ligament resume`: runs that are stopped, killed or damaged, against one that was never disturbed.
#![cfg(unix)]
#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a failed unwrap fails the test"
)]

use std::collections::BTreeMap;
use std::fs;
use std::io::{BufRead, BufReader, Read};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

use serde_json::Value;
use tempfile::TempDir;

const CASE: &str = r#"
lattice = { cells = [24, 24], spacing = 0.001, set = { bottom = { bottom = 1 }, top = { top = 1 } } }
material = { young = 30e9, poisson = 0.3, fracture_energy = 100.0, tensile_strength = 3e6 }
model = { law = "mppd", horizon_factor = 3.0 }
precrack = [{ points = [[-0.001, 0.0121], [0.0081, 0.0121]] }]
support = [{ group = "bottom", displacement = { x = 0.0, y = 0.0 } }]
"#;

const STEPPED: &str = "load = [{ group = \"top\", displacement = { y = 1e-5 } }]
fracture = { steps = 100, bonds_per_iteration = 1, stop = { bonds = 150 } }
output = { fields_every = 7, bonds = true, checkpoint_every = EVERY }";
const EVENT: &str = "load = [{ group = \"top\", displacement = { y = 1e-5 } }]
fracture = { control = \"event\", stop = { bonds = 150 } }
output = { fields_every = 20, bonds = true, checkpoint_every = EVERY }";
const SOFTENING: &str = "load = [{ group = \"top\", displacement = { y = 2e-4 } }]
output = { fields_every = 7, checkpoint_every = EVERY }
fracture = { steps = 60, stop = { load_fraction = 0.3 }, criterion = [{ kind = \"bond-energy\", limit = 1e-4, after = \"bilinear\" }] }";

/// A place for runs of one case.
struct Bench {
    folder: TempDir,
}

impl Bench {
    /// A case with a way of breaking bonds, and so many seconds between two checkpoints.
    fn new(fracture: &str, every: &str) -> Self {
        let folder = TempDir::new().unwrap();
        let case = format!("{CASE}{}\n", fracture.replace("EVERY", every));
        fs::write(folder.path().join("case.toml"), case).unwrap();
        Self { folder }
    }

    fn out(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn run(&self, name: &str, more: &[&str]) -> Command {
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

    fn resume(&self, name: &str, more: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_ligament"));
        command.arg("resume").arg(self.out(name)).args(more);
        command
    }
}

fn done(mut command: Command) -> Output {
    command.output().unwrap()
}

/// Does it, which must end well; gives what it wrote to standard error.
fn succeeded(command: Command) -> String {
    let output = done(command);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(0), "{said}");
    said
}

/// Does it, which must fail; gives the reasons in one line.
fn refused(command: Command) -> String {
    let output = done(command);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(1), "{said}");
    said.replace('\n', " ")
}

fn started(mut command: Command) -> Child {
    let quiet = command.stdout(Stdio::null()).stderr(Stdio::null());
    quiet.spawn().unwrap()
}

/// Sends signals to a program, one right after the other.
fn send(signals: &[&str], child: &Child) {
    let kills: Vec<_> = signals
        .iter()
        .map(|signal| format!("kill {signal} {}", child.id()))
        .collect();
    let sent = Command::new("sh").args(["-c", &kills.join("; ")]).status();
    assert!(sent.unwrap().success());
}

/// Rows of the history.
fn rows(folder: &Path) -> usize {
    let table = fs::read_to_string(folder.join("history.csv"));
    table.unwrap_or_default().lines().count()
}

/// Waits until the history has more rows than so many.
fn wait_for_rows(folder: &Path, before: usize, child: &mut Child) {
    let start = Instant::now();
    while rows(folder) <= before {
        assert!(child.try_wait().unwrap().is_none(), "it ended too early");
        assert!(start.elapsed() < Duration::from_secs(100));
        std::thread::sleep(Duration::from_millis(1));
    }
}

/// Keys of a summary that times, memory, threads and the build stand in.
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
fn results(folder: &Path) -> BTreeMap<String, Vec<u8>> {
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
fn assert_same(one: &Path, other: &Path) {
    let (one, other) = (results(one), results(other));
    assert!(one.len() > 8, "{:?}", one.keys());
    assert_eq!(
        one.keys().collect::<Vec<_>>(),
        other.keys().collect::<Vec<_>>()
    );
    let differs = one.iter().find(|(name, content)| other[*name] != **content);
    assert_eq!(differs.map(|(name, _)| name), None);
}

/// How a run ended, by its summary.
fn termination(folder: &Path) -> String {
    let text = fs::read_to_string(folder.join("summary.json")).unwrap();
    let summary: Value = serde_json::from_str(&text).unwrap();
    summary["termination"].as_str().unwrap().to_owned()
}

/// Each signal stops a run, which tells so by its exit code and a summary, and the run goes on to the results of one that was
/// never stopped: with load steps, along the exact path and with bonds that soften.
#[test]
fn a_signal_stops_a_run_that_goes_on_later() {
    for (fracture, signals) in [
        (STEPPED, ["-INT", "-TERM"].as_slice()),
        (EVENT, &["-HUP", "-INT"]),
        (SOFTENING, &["-TERM"]),
    ] {
        let bench = Bench::new(fracture, "0");
        // Large enough for a signal to come in time.
        let large = ["--quiet", "--set", "lattice.cells=[36, 36]"];
        succeeded(bench.run("whole", &large));
        let mut child = started(bench.run("stopped", &large));
        for signal in signals {
            let before = rows(&bench.out("stopped"));
            wait_for_rows(&bench.out("stopped"), before + 5, &mut child);
            send(&[signal], &child);
            assert_eq!(child.wait().unwrap().code(), Some(4), "{signal}");
            assert_eq!(termination(&bench.out("stopped")), "stopped");
            assert!(bench.out("stopped").join("checkpoint.bin").is_file());
            child = started(bench.resume("stopped", &["--threads", "2"]));
        }
        assert_eq!(child.wait().unwrap().code(), Some(0));
        assert_same(&bench.out("whole"), &bench.out("stopped"));
    }
}

/// A signal that comes before the first solution stops the run as a later one does, and leaves no folder.
#[test]
fn a_signal_stops_what_has_not_begun() {
    let bench = Bench::new(EVENT, "0");
    let mut command = bench.run("out", &["--set", "lattice.cells=[200, 200]"]);
    let mut child = command
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut told = BufReader::new(child.stderr.take().unwrap());
    // The first words come after the bonds and before the equations.
    let mut words = String::new();
    told.read_line(&mut words).unwrap();
    send(&["-INT"], &child);
    told.read_to_string(&mut words).unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(4), "{words}");
    // On a busy machine it may have come to its first solution, with which it can go on.
    let has_begun = !words.contains("stopped before the first solution: nothing was written");
    assert_eq!(bench.out("out").exists(), has_begun, "{words}");
}

/// The second signal ends the program, as if it knew none.
#[test]
fn a_second_signal_ends_it_at_once() {
    let bench = Bench::new(EVENT, "0");
    let mut child = started(bench.run("out", &["--set", "lattice.cells=[150, 150]"]));
    // It stops at the end of a solution only, and the first one takes longer than two signals that follow each other.
    while !bench.out("out").join("case.resolved.toml").is_file() {
        assert!(child.try_wait().unwrap().is_none(), "it ended too early");
        std::thread::sleep(Duration::from_millis(1));
    }
    send(&["-INT", "-TERM"], &child);
    // Of two that wait together the system hands on either first.
    let code = child.wait().unwrap().code();
    assert!([Some(128 + 2), Some(128 + 15)].contains(&code), "{code:?}");
}

/// Kills a run, and what goes on with it, again and again at moments of a fixed sequence; what is finished at last is as if nothing
/// had happened. Gives the number of kills.
fn kill_and_resume(fracture: &str, n_kills: usize, seed: u64) -> usize {
    let bench = Bench::new(fracture, "1e-6");
    let start = Instant::now();
    succeeded(bench.run("whole", &["--quiet"]));
    let whole = start.elapsed();
    let mut random = seed;
    let mut killed = 0;
    while killed < n_kills {
        let mut command = bench.run("killed", &["--quiet", "--force"]);
        let _ = fs::remove_dir_all(bench.out("killed"));
        loop {
            random = random
                .wrapping_mul(6364136223846793005)
                .wrapping_add(1442695040888963407);
            let share = (random >> 33) as f64 / (1u64 << 31) as f64;
            let mut child = started(command);
            std::thread::sleep(whole.mul_f64(0.02 + 0.7 * share));
            let ended = child.try_wait().unwrap();
            child.kill().unwrap();
            let status = child.wait().unwrap();
            if ended.is_some() {
                assert_eq!(status.code(), Some(0), "after {killed} kills");
                break;
            }
            killed += 1;
            // Killed before its first file, it starts anew.
            let has_begun = bench.out("killed").join("case.resolved.toml").is_file();
            command = if has_begun {
                bench.resume("killed", &["--quiet"])
            } else {
                bench.run("killed", &["--quiet"])
            };
        }
        assert_same(&bench.out("whole"), &bench.out("killed"));
    }
    killed
}

#[test]
fn a_killed_run_goes_on() {
    for (fracture, seed) in [(STEPPED, 1), (EVENT, 2), (SOFTENING, 3)] {
        let killed = kill_and_resume(fracture, 4, seed);
        println!("{killed} kills survived");
    }
}

#[test]
#[ignore = "takes minutes"]
fn hundreds_of_killed_runs_go_on() {
    let mut total = 0;
    for (fracture, seed) in [(STEPPED, 11), (EVENT, 12), (SOFTENING, 13)] {
        total += kill_and_resume(fracture, 80, seed);
        println!("{total} kills survived so far");
    }
}

/// A run of the exact path that was stopped after some breaks, with two checkpoints.
fn stopped(bench: &Bench) -> PathBuf {
    let out = bench.out("out");
    let mut child = started(bench.run("out", &[]));
    wait_for_rows(&out, 5, &mut child);
    send(&["-INT"], &child);
    assert_eq!(child.wait().unwrap().code(), Some(4));
    assert!(out.join("checkpoint.older.bin").is_file());
    out
}

#[test]
fn a_damaged_checkpoint_falls_back_to_the_one_before() {
    let bench = Bench::new(EVENT, "1e-6");
    succeeded(bench.run("whole", &["--quiet"]));
    let out = stopped(&bench);
    let newest = out.join("checkpoint.bin");
    let bytes = fs::read(&newest).unwrap();
    fs::write(&newest, &bytes[..bytes.len() / 2]).unwrap();
    let said = succeeded(bench.resume("out", &[]));
    assert!(said.contains("too early"), "{said}");
    assert!(
        said.contains("going on from the checkpoint before"),
        "{said}"
    );
    assert_same(&bench.out("whole"), &out);
}

#[test]
fn without_a_good_checkpoint_the_results_stay() {
    let bench = Bench::new(EVENT, "1e-6");
    let out = stopped(&bench);
    for name in ["checkpoint.bin", "checkpoint.older.bin"] {
        fs::write(out.join(name), "not a checkpoint").unwrap();
    }
    let before = results(&out);
    let said = refused(bench.resume("out", &[]));
    assert!(said.contains("no checkpoint of a run"), "{said}");
    assert!(said.contains("as they were"), "{said}");
    assert_eq!(results(&out), before);
}

/// The case, and a file that it reads, must be those that the run was begun with; a table must be as long as it was.
#[test]
fn a_checkpoint_of_other_inputs_is_refused() {
    let bench = Bench::new(EVENT, "1e-6");
    let out = stopped(&bench);
    let resolved = out.join("case.resolved.toml");
    let case = fs::read_to_string(&resolved).unwrap();
    fs::write(&resolved, case.replace("poisson = 0.3", "poisson = 0.25")).unwrap();
    let said = refused(bench.resume("out", &[]));
    assert!(said.contains("other inputs (now poisson = 0.25)"), "{said}");
    fs::write(&resolved, case).unwrap();

    let breaks = out.join("breaks.csv");
    let rows = fs::read(&breaks).unwrap();
    fs::write(&breaks, &rows[..rows.len() / 3]).unwrap();
    let said = refused(bench.resume("out", &[]));
    assert!(said.contains("breaks.csv has"), "{said}");
    fs::write(&breaks, rows).unwrap();
    succeeded(bench.resume("out", &["--quiet"]));
}

/// What was written so far must be as it was, to the last bit: a digit of a table, the end of a field.
#[test]
fn results_that_were_changed_are_named() {
    let bench = Bench::new(EVENT, "1e-6");
    let every = ["--set", "output.fields_every=1"];
    let out = bench.out("out");
    let mut child = started(bench.run("out", &every));
    wait_for_rows(&out, 5, &mut child);
    send(&["-INT"], &child);
    assert_eq!(child.wait().unwrap().code(), Some(4));
    let digit = |bytes: &mut Vec<u8>| {
        // In the first row with a load.
        let place = bytes.iter().rposition(|it| *it == b'\n').unwrap() / 2;
        let place = place + bytes[place..].iter().position(u8::is_ascii_digit).unwrap();
        bytes[place] = if bytes[place] == b'7' { b'3' } else { b'7' };
    };
    let cut = |bytes: &mut Vec<u8>| bytes.truncate(bytes.len() - 20);
    type Change<'a> = &'a dyn Fn(&mut Vec<u8>);
    let changes: [(&str, Change<'_>, &str); 4] = [
        ("history.csv", &digit, "was changed since"),
        ("criteria.csv", &|bytes| bytes[0] ^= 1, "was changed since"),
        ("fields_0001.vtu", &cut, "bytes where it had"),
        (
            "fields_0000.vtu",
            &|bytes| bytes[300] ^= 1,
            "was changed since",
        ),
    ];
    for (name, change, words) in changes {
        let path = out.join(name);
        let before = fs::read(&path).unwrap();
        let mut changed = before.clone();
        change(&mut changed);
        assert_ne!(changed, before);
        fs::write(&path, changed).unwrap();
        let said = refused(bench.resume("out", &[]));
        assert!(
            said.contains(name) && said.contains(words),
            "{name}: {said}"
        );
        fs::write(&path, before).unwrap();
    }
    succeeded(bench.resume("out", &["--quiet"]));
}

#[test]
fn only_settings_that_change_nothing_so_far_are_taken() {
    let bench = Bench::new(EVENT, "1e-6");
    stopped(&bench);
    for setting in [
        "material.young=2e9",
        "fracture.control=stepped",
        "fracture.tie_tolerance=1e-6",
        "fracture.stop={ bonds = 3 }",
        "nonsense",
    ] {
        let said = refused(bench.resume("out", &["--set", setting]));
        assert!(said.contains(setting), "{said}");
        assert!(said.contains("fracture.stop.bonds, "), "{said}");
    }
}

/// Another stop rule takes a run that ended further, to the results of a run that had it from the start.
#[test]
fn a_run_that_ended_by_a_rule_is_prolonged() {
    for fracture in [STEPPED, EVENT] {
        let bench = Bench::new(fracture, "30");
        let later = ["--quiet", "--set", "fracture.stop.bonds=230"];
        succeeded(bench.run("whole", &later));
        succeeded(bench.run("out", &["--quiet"]));
        assert_eq!(termination(&bench.out("out")), "bonds-broken");
        // Without another rule it ends where it did.
        let before = results(&bench.out("out"));
        succeeded(bench.resume("out", &["--quiet"]));
        assert_eq!(results(&bench.out("out")), before);
        succeeded(bench.resume("out", &later));
        assert_same(&bench.out("whole"), &bench.out("out"));
    }
}

#[test]
fn a_run_that_is_over_says_so() {
    let bench = Bench::new(
        &STEPPED.replace("stop = { bonds = 150 }", "stop = {}"),
        "1e-6",
    );
    let weak = ["--quiet", "--set", "material.tensile_strength=1e3"];
    succeeded(bench.run("out", &weak));
    assert_eq!(termination(&bench.out("out")), "fell-apart");
    let said = refused(bench.resume("out", &[]));
    assert!(
        said.contains("come to its end") && said.contains("fell apart"),
        "{said}"
    );
    let said = refused(bench.resume("nowhere", &[]));
    assert!(said.contains("no such folder"), "{said}");
}

#[test]
fn a_run_without_a_checkpoint_starts_anew() {
    let bench = Bench::new(EVENT, "0");
    succeeded(bench.run("whole", &["--quiet"]));
    let mut child = started(bench.run("out", &[]));
    wait_for_rows(&bench.out("out"), 5, &mut child);
    child.kill().unwrap();
    child.wait().unwrap();
    let said = succeeded(bench.resume("out", &[]));
    assert!(said.contains("no checkpoint yet: it starts anew"), "{said}");
    assert_same(&bench.out("whole"), &bench.out("out"));
}

/// A run that replaces earlier results leaves them whole while it is stopped, and takes their place when it is complete.
#[test]
fn a_run_that_replaces_others_goes_on() {
    let bench = Bench::new(EVENT, "0");
    let large = ["--quiet", "--set", "lattice.cells=[36, 36]"];
    succeeded(bench.run("whole", &large));
    succeeded(bench.run("out", &["--quiet"]));
    let earlier = results(&bench.out("out"));
    let mut child = started(bench.run("out", &[&large[..], &["--force"]].concat()));
    wait_for_rows(&bench.out("out.new"), 5, &mut child);
    send(&["-INT"], &child);
    assert_eq!(child.wait().unwrap().code(), Some(4));
    assert_eq!(results(&bench.out("out")), earlier);
    assert_eq!(termination(&bench.out("out.new")), "stopped");
    succeeded(bench.resume("out", &["--quiet"]));
    assert!(!bench.out("out.new").exists());
    assert_same(&bench.out("whole"), &bench.out("out"));
}

/// Processes that a launcher started together, and that cannot work together, do not all write into one folder.
#[cfg(not(feature = "petsc"))]
#[test]
fn several_processes_are_refused_where_the_program_is_built_for_one() {
    let bench = Bench::new(STEPPED, "0");
    let mut launched = bench.run("launched", &[]);
    launched.env("OMPI_COMM_WORLD_SIZE", "2");
    let said = refused(launched);
    assert!(
        said.contains("2 processes") && said.contains("--features petsc"),
        "{said}"
    );
    assert!(!bench.out("launched").exists());
}
