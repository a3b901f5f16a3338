//! Studies in parts, on one machine or several.

use super::*;
use std::process::Stdio;

/// Shards in one folder and in folders of their own, collected, have the table of the whole study; a missing part is told.
#[test]
fn shards_together_are_the_whole() {
    let whole = Place::with(GRID);
    assert_success(&whole.sweep(&[]));
    let expected = whole.table();

    let shared = Place::with(GRID);
    let output = shared.sweep(&["--shard", "2/4"]);
    assert_success(&output);
    let names: Vec<String> = shared.summaries().into_keys().collect();
    assert_eq!(
        names,
        [
            "tensile_strength=1.2e6,horizon_factor=3.2",
            "tensile_strength=1e6,horizon_factor=2.7"
        ],
        "runs 2 and 6"
    );
    assert!(!shared.path("out/table.csv").exists());
    let part = shared.sweep(&["--collect"]);
    assert_success(&part);
    assert!(
        stdout(&part).contains("6 runs: 2 done, 0 failed, 4 missing"),
        "{}",
        stdout(&part)
    );
    assert!(stdout(&part).contains("missing: tensile_strength=1e6,horizon_factor=2.2"));
    assert_eq!(shared.table().column("status")[1], "done");
    assert_eq!(shared.table().column("status")[0], "missing");
    // At the same time, as an array of jobs does.
    let jobs: Vec<_> = ["1/4", "3/4", "4/4"]
        .map(|shard| {
            shared
                .command(&["--shard", shard, "--quiet"])
                .stdout(Stdio::null())
                .spawn()
                .unwrap()
        })
        .into_iter()
        .map(|mut child| child.wait().unwrap())
        .collect();
    assert!(jobs.iter().all(|status| status.success()));
    assert_success(&shared.sweep(&["--collect"]));
    assert_eq!(shared.table().lasting(), expected.lasting());

    // Two machines with folders of their own, with their copies of the study and its case.
    let machines = [Place::with(GRID), Place::with(GRID)];
    assert_success(&machines[0].sweep(&["--shard", "1/2"]));
    assert_success(&machines[1].sweep(&["--shard", "2/2"]));
    let here = Place::with(GRID);
    let folders = machines
        .each_ref()
        .map(|it| it.path("out").display().to_string());
    let collect = here.sweep(&["--collect", "--from", &folders[0], "--from", &folders[1]]);
    assert_success(&collect);
    assert_eq!(here.table().lasting(), expected.lasting());
    assert!(here.table().column("folder")[1].starts_with(&folders[1]));
}

#[test]
fn collecting_computes_nothing_and_wants_a_study() {
    let place = Place::with(GRID);
    let output = place.sweep(&["--collect"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(
        stderr(&output).contains("out is no folder of a study"),
        "{}",
        stderr(&output)
    );
    assert!(!place.path("out").exists());
    for wrong in ["0/4", "5/4", "4"] {
        assert_eq!(place.sweep(&["--shard", wrong]).status.code(), Some(2));
    }
    assert_eq!(place.sweep(&["--from", "x"]).status.code(), Some(2));
}
