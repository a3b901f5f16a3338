//! Folders of results under kills, full disks and other programs.

use super::*;
use std::process::{Child, Stdio};
use std::thread;
use std::time::{Duration, Instant};

/// Longer than anything here takes, however busy the machine is.
const PATIENCE: Duration = Duration::from_secs(120);

fn wait_until(what: &str, mut holds: impl FnMut() -> bool) {
    let start = Instant::now();
    while !holds() {
        assert!(start.elapsed() < PATIENCE, "{what}");
        thread::sleep(Duration::from_millis(2));
    }
}

fn long_run(place: &Place, more: &[&str]) -> Child {
    let mut command = place.command(["run", "case.toml", "--out", "out", "--quiet"]);
    command
        .args(LONG)
        .args(more)
        .stdout(Stdio::null())
        .stderr(Stdio::null());
    command.spawn().unwrap()
}

fn kill(mut child: Child) {
    child.kill().unwrap();
    child.wait().unwrap();
}

/// At any moment of `run --force` one whole set of results is in the folder.
#[test]
fn a_killed_replacement_leaves_the_earlier_results() {
    let place = Place::new();
    place.run();
    let earlier = place.contents("out");
    for pause in [0, 5, 20, 60, 150] {
        let child = long_run(&place, &["--force"]);
        wait_until("the new results begin", || {
            place.path("out.new/history.csv").is_file()
        });
        thread::sleep(Duration::from_millis(pause));
        kill(child);
        assert_eq!(place.contents("out"), earlier);
    }
    // Short runs, killed wherever they are: the results are the earlier ones or the new ones.
    for micros in (0..40).map(|it| 1500 * it) {
        let mut command = place.command(["run", "case.toml", "--out", "out", "--force", "--quiet"]);
        let child = command
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        thread::sleep(Duration::from_micros(micros));
        kill(child);
        // A kill between the two renames is repaired by the next command.
        place.ligament(["run", "case.toml", "--out", "out"]);
        let steps = |files: &[(String, Vec<u8>)]| {
            files
                .iter()
                .find(|it| it.0 == "history.csv")
                .unwrap()
                .1
                .clone()
        };
        let now = place.contents("out");
        assert_eq!(steps(&now), steps(&earlier));
        assert!(now.iter().any(|it| it.0 == "summary.json"));
    }
    assert_success(&place.ligament(["run", "case.toml", "--out", "out", "--force"]));
    let mut left: Vec<_> = fs::read_dir(place.folder.path())
        .unwrap()
        .map(|it| it.unwrap().file_name())
        .collect();
    left.sort();
    assert_eq!(left, ["case.toml", "out"], "nothing is left beside");
}

/// The second of two runs into one folder is refused with the number of the other process; a killed run is no obstacle.
#[test]
fn two_runs_into_one_folder_are_refused() {
    for earlier in [false, true] {
        let place = Place::new();
        if earlier {
            place.run();
        }
        let child = long_run(&place, &["--force"]);
        let begun = if earlier {
            "out.new/history.csv"
        } else {
            "out/history.csv"
        };
        wait_until("the first run begins", || place.path(begun).is_file());
        let second = place.ligament(["run", "case.toml", "--out", "out", "--force"]);
        let process = format!("process {}", child.id());
        assert_refused(&second, &["out is in use", &process, "--out"]);
        kill(child);
        assert_success(&place.ligament(["run", "case.toml", "--out", "out", "--force"]));
    }
}

/// `--force` removes only files of the program, and a link to a folder remains one.
#[test]
fn files_of_others_and_links_stay() {
    let place = Place::new();
    let arguments = [
        "run",
        "case.toml",
        "--out",
        "link",
        "--force",
        "--set",
        "output.bonds=true",
    ];
    fs::create_dir(place.path("elsewhere")).unwrap();
    std::os::unix::fs::symlink("elsewhere", place.path("link")).unwrap();
    assert_success(&place.ligament(arguments));
    fs::write(place.path("elsewhere/notes.txt"), "mine").unwrap();
    fs::create_dir(place.path("elsewhere/pictures")).unwrap();
    let plain = &arguments[..5];
    assert_success(&place.ligament(plain));
    assert_eq!(
        fs::read_link(place.path("link")).unwrap(),
        Path::new("elsewhere")
    );
    assert_eq!(
        fs::read_to_string(place.path("elsewhere/notes.txt")).unwrap(),
        "mine"
    );
    assert!(place.path("elsewhere/pictures").is_dir());
    let names =
        |name: &str| -> Vec<String> { place.contents(name).into_iter().map(|it| it.0).collect() };
    place.run();
    let mut fresh = names("out");
    fresh.push("notes.txt".to_owned());
    fresh.sort();
    assert_eq!(
        names("elsewhere"),
        fresh,
        "all files of the earlier run have gone"
    );
    assert!(!place.path("link.new").exists() && !place.path("elsewhere.new").exists());
}

/// A disk that accepts only some blocks of a file: the run ends with the reason, and earlier results are whole.
#[test]
fn a_full_disk_leaves_the_earlier_results() {
    let place = Place::new();
    place.run();
    let earlier = place.contents("out");
    // A write beyond the limit fails as on a full disk: its signal does not end the program.
    let limits = "ulimit -f 4";
    let output = place.limited(
        limits,
        "run case.toml --out out --force --set lattice.cells=[60,30]",
    );
    assert_refused(
        &output,
        &[
            "out has the earlier results",
            "out.new",
            "because: cannot write",
            "because: File too large",
        ],
    );
    assert_eq!(place.contents("out"), earlier);
    let output = place.limited(
        limits,
        "run case.toml --out new --set lattice.cells=[60,30]",
    );
    assert_refused(&output, &["cannot write new/"]);
    assert!(!place.path("new/summary.json").exists());
}

/// Not even the administrator can make folders in /proc.
#[cfg(target_os = "linux")]
#[test]
fn a_folder_that_cannot_be_made_is_told() {
    let place = Place::new();
    let output = place.ligament(["run", "case.toml", "--out", "/proc/results"]);
    assert_refused(&output, &["cannot create /proc/results"]);
    let output = place.ligament(["run", "case.toml", "--out", "case.toml/results"]);
    assert_refused(&output, &["case.toml/results"]);
}

/// A case in a folder whose name is not UTF-8: its resolved form cannot name the mesh, and nothing is made.
#[test]
fn a_path_that_is_no_text_makes_no_folder() {
    use std::os::unix::ffi::OsStrExt;
    let place = Place::new();
    let folder = place.path(OsStr::from_bytes(b"caf\xe9"));
    fs::create_dir(&folder).unwrap();
    let mesh = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../meshes/plate-coarse.msh");
    fs::copy(mesh, folder.join("plate.msh")).unwrap();
    let starter = place.ligament([OsStr::new("new"), folder.join("plate.msh").as_os_str()]);
    let case = stdout(&starter);
    fs::write(folder.join("case.toml"), case).unwrap();
    let arguments = [
        OsStr::new("run"),
        OsStr::new("case.toml"),
        OsStr::new("--out"),
        OsStr::new("../out"),
    ];
    let output = place
        .command(arguments)
        .current_dir(&folder)
        .output()
        .unwrap();
    // Whether it is refused or done, no partial result remains.
    assert_eq!(
        output.status.success(),
        place.path("out").exists(),
        "{}",
        stderr(&output)
    );
    // A folder of results may have such a name.
    let odd = place.path(OsStr::from_bytes(b"r\xe9sultats"));
    for _ in 0..2 {
        let arguments = [
            OsStr::new("run"),
            OsStr::new("case.toml"),
            OsStr::new("--force"),
            OsStr::new("--out"),
            odd.as_os_str(),
        ];
        assert_success(&place.ligament(arguments));
    }
    assert!(odd.join("summary.json").is_file());
}
