//! Runs that are killed again and again.

use std::fs;
use std::path::Path;
use std::process::Stdio;
use std::time::Instant;

use super::bench::{Bench, EVENT, EXPLICIT, IMPLICIT, SOFTENING, STEPPED, assert_same, succeeded};

/// Kills a run, and its resumptions, again and again at moments of a fixed sequence; the final results are as if nothing
/// had happened. Returns the number of kills.
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
            let quiet = command.stdout(Stdio::null()).stderr(Stdio::piped());
            let mut child = quiet.spawn().unwrap();
            std::thread::sleep(whole.mul_f64(0.02 + 0.7 * share));
            let ended = child.try_wait().unwrap();
            child.kill().unwrap();
            let output = child.wait_with_output().unwrap();
            if ended.is_some() {
                let said = String::from_utf8_lossy(&output.stderr);
                assert_eq!(
                    output.status.code(),
                    Some(0),
                    "after {killed} kills: {said}"
                );
                break;
            }
            killed += 1;
            // Killed after its last file, the run is complete.
            if is_complete(&bench.out("killed")) {
                break;
            }
            // Killed before its first file, the run starts again.
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

/// Whether a run wrote its summary and has no checkpoint from which it could continue.
fn is_complete(folder: &Path) -> bool {
    let has_checkpoint = || {
        let mut files = fs::read_dir(folder).unwrap();
        files.any(|it| {
            it.unwrap()
                .file_name()
                .to_string_lossy()
                .starts_with("checkpoint")
        })
    };
    folder.join("summary.json").is_file() && !has_checkpoint()
}

#[test]
fn a_killed_run_goes_on() {
    let kinds = [STEPPED, EVENT, SOFTENING, EXPLICIT, IMPLICIT];
    for (fracture, seed) in kinds.into_iter().zip(1..) {
        let killed = kill_and_resume(fracture, 4, seed);
        println!("{killed} kills survived");
    }
}

#[test]
#[ignore = "takes minutes"]
fn hundreds_of_killed_runs_go_on() {
    let mut total = 0;
    let kinds = [STEPPED, EVENT, SOFTENING, EXPLICIT, IMPLICIT];
    for (fracture, seed) in kinds.into_iter().zip(11..) {
        total += kill_and_resume(fracture, 80, seed);
        println!("{total} kills survived so far");
    }
}
