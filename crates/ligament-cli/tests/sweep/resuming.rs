//! Sweeps that are stopped and continued.

use super::*;
use std::io::Read;
use std::process::{Child, Stdio};
use std::thread;
use std::time::{Duration, Instant};

/// Longer than anything here takes, however busy the machine is.
const PATIENCE: Duration = Duration::from_secs(120);

/// Two short runs and one of some seconds.
const LONG: &str = r#"case = "bar/case.toml"
[[axis]]
key = "lattice.cells"
values = [[12, 6], [120, 60], [14, 6]]
[set]
"fracture.steps" = 300
"#;

fn wait_until(what: &str, mut holds: impl FnMut() -> bool) {
    let start = Instant::now();
    while !holds() {
        assert!(start.elapsed() < PATIENCE, "{what}");
        thread::sleep(Duration::from_millis(5));
    }
}

fn start(place: &Place) -> Child {
    let mut command = place.command(&["--jobs", "1"]);
    command.stdout(Stdio::null()).stderr(Stdio::piped());
    command.spawn().unwrap()
}

/// Nothing is computed twice and nothing is missing after a kill at any time; no run outlives its sweep.
#[test]
fn a_killed_sweep_goes_on() {
    let place = Place::with(LONG);
    // At first in the middle of the long run, then wherever the next ones happen to be.
    for pause in [0, 40, 150] {
        let mut sweep = start(&place);
        wait_until("a run is done", || !place.summaries().is_empty());
        thread::sleep(Duration::from_millis(pause));
        sweep.kill().unwrap();
        sweep.wait().unwrap();
        let done = place.summaries();
        let rest = place.sweep(&["--list"]);
        assert_success(&rest);
        let to_do = format!("3 runs, {} to do", 3 - done.len());
        assert!(stdout(&rest).contains(&to_do), "{to_do}: {}", stdout(&rest));
    }
    let before = place.summaries();
    let output = place.sweep(&["--jobs", "1"]);
    assert_success(&output);
    let after = place.summaries();
    assert_eq!(after.len(), 3);
    for (name, written) in &before {
        assert_eq!(after[name], *written, "{name} was computed again");
    }
    let counted = format!("{} were done already", before.len());
    assert!(
        stdout(&output).contains(&counted),
        "{counted}: {}",
        stdout(&output)
    );

    let table = place.table();
    assert_eq!(table.column("status"), ["done"; 3]);
    assert_success(&place.sweep(&["--force"]));
    assert_eq!(
        place.table().lasting(),
        table.lasting(),
        "the same as without interruption"
    );
    let anew = place.summaries();
    assert!(
        anew.iter().all(|(name, written)| after[name] != *written),
        "--force computes anew"
    );
}

/// A sweep that repeats all runs keeps the earlier results of a run until it has new ones; after a kill the same study continues.
#[test]
fn a_killed_sweep_that_does_all_anew_loses_nothing() {
    let place = Place::with(LONG);
    assert_success(&place.sweep(&["--jobs", "1"]));
    let (first, table) = (place.summaries(), place.table());
    let mut command = place.command(&["--jobs", "1", "--force"]);
    command.stdout(Stdio::null()).stderr(Stdio::null());
    let mut sweep = command.spawn().unwrap();
    let own = |summaries: BTreeMap<String, SystemTime>| -> BTreeMap<String, SystemTime> {
        summaries
            .into_iter()
            .filter(|(name, _)| first.contains_key(name))
            .collect()
    };
    let new =
        |now: &BTreeMap<String, SystemTime>| now.iter().filter(|it| first[it.0] != *it.1).count();
    wait_until("a run is done anew", || new(&own(place.summaries())) == 1);
    sweep.kill().unwrap();
    sweep.wait().unwrap();
    assert_eq!(own(place.summaries()).len(), 3, "all have results");
    assert_success(&place.sweep(&["--collect"]));
    assert_eq!(place.table().lasting(), table.lasting());
    assert!(stdout(&place.sweep(&["--list"])).contains("3 runs, 2 to do"));
    let before = own(place.summaries());
    assert_success(&place.sweep(&["--jobs", "1"]));
    let after = own(place.summaries());
    assert_eq!(new(&after), 3, "the rest was done anew");
    assert_eq!(
        before
            .iter()
            .filter(|(name, written)| after[*name] == **written)
            .count(),
        1
    );
    assert_eq!(place.summaries().len(), 3, "nothing is left beside");
}

/// A run ends when its sweep is killed, although nobody tells it.
#[cfg(target_os = "linux")]
#[test]
fn runs_do_not_outlive_their_sweep() {
    let place = Place::with(LONG);
    let folder = place.folder.path().canonicalize().unwrap();
    let runs = || {
        let all = fs::read_dir("/proc").unwrap().filter_map(Result::ok);
        // A process that ends while it is looked at is none.
        let is_ours = |it: &fs::DirEntry| {
            let name = fs::read_link(it.path().join("cwd")).unwrap_or_default();
            let line = fs::read(it.path().join("cmdline")).unwrap_or_default();
            name == folder && String::from_utf8_lossy(&line).contains("--leash")
        };
        all.filter(is_ours).count()
    };
    let mut sweep = start(&place);
    let long = place.path("out/runs/cells=_120__60_");
    wait_until("the long run writes", || long.join("history.csv").is_file());
    assert_eq!(runs(), 1);
    sweep.kill().unwrap();
    sweep.wait().unwrap();
    wait_until("the run ends", || runs() == 0);
    assert!(
        !long.join("summary.json").exists(),
        "it was not done, but ended"
    );
}

/// The same command while it runs is refused and does no harm; after its end it finds everything done.
#[test]
fn two_sweeps_at_once_are_refused() {
    let place = Place::with(LONG);
    let mut sweep = start(&place);
    wait_until("a run is done", || !place.summaries().is_empty());
    for arguments in [&[][..], &["--force"], &["--shard", "1/2"]] {
        let second = place.sweep(arguments);
        // Only if the first one is through already may the second one run.
        if sweep.try_wait().unwrap().is_none() {
            assert_eq!(second.status.code(), Some(1));
            assert!(
                stderr(&second).contains("another study works on out"),
                "{}",
                stderr(&second)
            );
        }
    }
    let mut said = String::new();
    sweep
        .stderr
        .take()
        .unwrap()
        .read_to_string(&mut said)
        .unwrap();
    assert!(sweep.wait().unwrap().success(), "{said}");
    assert_eq!(place.table().column("status"), ["done"; 3]);
}

/// Runs with changed inputs are repeated with a message, the others are not; new values add runs and keep the earlier ones.
#[test]
fn changed_inputs_are_computed_anew() {
    let study = GRID.replace("bar/case.toml", "bar/hot.toml");
    let place = Place::with(&study);
    let hot = SMALL_BAR.replace(
        "[fracture]",
        "[[temperature]]\nfile = \"field.csv\"\n[fracture]",
    );
    let hot = hot.replace(
        "tensile_strength",
        "thermal_expansion = 1e-5\ntensile_strength",
    );
    fs::write(place.path("bar/hot.toml"), &hot).unwrap();
    let field = |change: f64| {
        let cells = (0..72).map(|k| {
            let (x, y) = (
                0.005 + 0.01 * f64::from(k % 12),
                0.005 + 0.01 * f64::from(k / 12),
            );
            format!("{x},{y},{change}\n")
        });
        fs::write(
            place.path("bar/field.csv"),
            "x,y,change\n".to_owned() + &cells.collect::<String>(),
        )
        .unwrap();
    };
    field(1.0);
    assert_success(&place.sweep(&[]));
    let first = place.summaries();
    assert_eq!(first.len(), 6);
    assert_success(&place.sweep(&[]));
    assert_eq!(place.summaries(), first, "nothing changed");

    // A file of the case.
    field(2.0);
    let output = place.sweep(&[]);
    assert_success(&output);
    assert!(
        stderr(&output).contains("repeated, because its inputs changed (now file = "),
        "{}",
        stderr(&output)
    );
    let second = place.summaries();
    assert!(second.iter().all(|(name, written)| first[name] != *written));

    // The case itself.
    fs::write(
        place.path("bar/hot.toml"),
        hot.replace("poisson = 0.2", "poisson = 0.25"),
    )
    .unwrap();
    let output = place.sweep(&[]);
    assert_success(&output);
    assert!(
        stderr(&output).contains("(now poisson = 0.25)"),
        "{}",
        stderr(&output)
    );
    let third = place.summaries();
    assert!(third.iter().all(|(name, written)| second[name] != *written));

    // Another value of an axis, and comments.
    place.study(&("# one more\n".to_owned() + &study.replace("to = 3.2", "to = 3.7")));
    let output = place.sweep(&[]);
    assert_success(&output);
    let fourth = place.summaries();
    assert_eq!(fourth.len(), 8);
    assert!(third.iter().all(|(name, written)| fourth[name] == *written));
    assert!(
        stderr(&output).contains("6 of 8 runs were done already"),
        "{}",
        stderr(&output)
    );
}
