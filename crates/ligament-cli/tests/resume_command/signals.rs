//! Runs that a signal stops.

use std::io::{BufRead, BufReader, Read};
use std::process::Stdio;
use std::time::Duration;

use super::bench::{
    Bench, EVENT, SOFTENING, STEPPED, assert_same, rows, send, started, succeeded, termination,
    wait_for_rows,
};

/// Each signal stops a run, with an exit code and a summary that report it, and the resumed run has the results of one that was
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

/// A signal before the first solution stops the run as a later one does, and leaves no folder.
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

/// The second signal ends the program as if it had no handlers.
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
