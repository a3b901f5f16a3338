//! `ligament resume`: runs that are stopped, killed or damaged, compared with an undisturbed run.
#![cfg(unix)]
#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a failed unwrap fails the test"
)]

mod bench;
mod kills;
mod last_row;
mod moved;
mod signals;

use std::fs;
use std::path::PathBuf;

use bench::{
    Bench, EVENT, STEPPED, assert_same, refused, results, rows, send, started, succeeded,
    termination, wait_for_rows,
};

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
        said.contains("resuming from the checkpoint before it"),
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
    assert!(said.contains("results are unchanged"), "{said}");
    assert_eq!(results(&out), before);
}

/// The case, and its input files, must be the same as at the start of the run; a table must have its length.
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

/// Results written so far must be unchanged to the last bit: a digit of a table, the end of a field.
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

/// The model, which follows from case and mesh, is written again by a resumed run: a truncated one is whole again, also where the resumed
/// run is killed before its end.
#[test]
fn a_model_that_was_cut_is_whole_again() {
    let bench = Bench::new(EVENT, "1e-6");
    let out = stopped(&bench);
    let model = out.join("model.vtu");
    let whole = fs::read(&model).unwrap();
    fs::write(&model, &whole[..whole.len() - 50]).unwrap();
    let before = rows(&out);
    let mut child = started(bench.resume("out", &[]));
    wait_for_rows(&out, before + 3, &mut child);
    child.kill().unwrap();
    child.wait().unwrap();
    let text = fs::read_to_string(&model).unwrap();
    assert!(text.trim_end().ends_with("</VTKFile>"));
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

/// Another stop rule continues a run that ended, to the results of a run that had this rule from the start.
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
        said.contains("is complete") && said.contains("fell apart"),
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
    assert!(
        said.contains("no checkpoint yet, so it starts from the beginning"),
        "{said}"
    );
    assert_same(&bench.out("whole"), &bench.out("out"));
}

/// A run that replaces earlier results leaves them whole while it is stopped, and replaces them when it is complete.
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
