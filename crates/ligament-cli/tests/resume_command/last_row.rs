//! Runs of all kinds that are stopped at one of their states, up to the last one, and continued.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use ligament_analysis::distributed_matrix::SingleProcess;
use ligament_case::case::CaseFile;
use ligament_output::summary::Build;
use ligament_run::progress::ProgressMode;
use ligament_run::{resume, run};
use tempfile::TempDir;

use super::bench::{assert_same, results, termination};

const BODY: &str = r#"
lattice = { cells = [12, 8], spacing = 0.001, set = { bottom = { bottom = 1 }, top = { top = 1 } } }
material = { young = 30e9, poisson = 0.2, density = 2500.0, fracture_energy = 100.0, tensile_strength = 3e6 }
model = { law = "nhpd", horizon_factor = 3.0 }
precrack = [{ points = [[-0.001, 0.0041], [0.0041, 0.0041]] }]
support = [{ group = "bottom", displacement = { x = 0.0, y = 0.0 } }]
output = { fields_every = 2, bonds = true, checkpoint_every = 1e-6 }
"#;

/// Load steps, also with bonds that soften, and stages; the exact path; explicit steps with contact and both kinds of damping, implicit
/// steps, and motions with equilibria where the body is at rest.
const KINDS: [(&str, &str); 7] = [
    (
        "steps",
        r#"load = [{ group = "top", displacement = { y = 6e-6 } }]
fracture = { steps = 5, criterion = [{ kind = "critical-stretch" }] }"#,
    ),
    (
        "softening",
        r#"load = [{ group = "top", displacement = { y = 2e-5 } }]
fracture = { steps = 4, criterion = [{ kind = "bond-energy", limit = 1e-4, after = "bilinear" }] }"#,
    ),
    (
        "stages",
        r#"load = [{ name = "pull", group = "top", displacement = { y = 4e-6 } }]
stage = [{ loads = { pull = 1.0 }, steps = 2 }, { loads = { pull = 0.5 }, steps = 2 }, { loads = { pull = 1.1 }, steps = 2 }]
fracture = { criterion = [{ kind = "critical-stretch" }] }"#,
    ),
    (
        "event",
        r#"load = [{ group = "top", displacement = { y = 6e-6 } }]
fracture = { control = "event", stop = { bonds = 12 } }"#,
    ),
    (
        "explicit",
        r#"analysis = "motion"
motion = { duration = 1e-5, rows = 8, damping = { mass = 1e4, stiffness = 1e-9 } }
rigid = [{ name = "pin", shape = "circle", centre = [0.006, 0.0101], radius = 0.002, velocity = { y = -40.0 }, friction = 0.3 }]
fracture = { criterion = [{ kind = "critical-stretch" }] }"#,
    ),
    (
        "implicit",
        r#"analysis = "motion"
load = [{ group = "top", velocity = { y = 2.0 } }]
motion = { duration = 1e-5, rows = 5, scheme = "implicit", step = 1e-6 }
fracture = { criterion = [{ kind = "critical-stretch" }] }"#,
    ),
    (
        "auto",
        r#"analysis = "motion"
load = [{ group = "top", displacement = { y = 8e-6 }, amplitude = { shape = "ramp", duration = 1.0 } }]
motion = { duration = 1.0, rows = 5, scheme = "auto", step = 1e-3, damping = { mass = 1e3 } }
fracture = { criterion = [{ kind = "critical-stretch" }] }"#,
    ),
];

/// A case with a folder for its runs.
struct Place(TempDir);

impl Place {
    fn new(kind: &str) -> Self {
        let folder = TempDir::new().unwrap();
        let (keys, tables): (Vec<&str>, Vec<&str>) =
            kind.lines().partition(|line| line.starts_with("analysis"));
        let case = format!("{}\n{BODY}{}\n", keys.join("\n"), tables.join("\n"));
        fs::write(folder.path().join("case.toml"), case).unwrap();
        Self(folder)
    }

    fn out(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// Runs the case until the program has checked `asks` times whether it is to stop; returns the number of checks.
    fn run(&self, name: &str, asks: usize, settings: &[&str]) -> usize {
        let settings: Vec<String> = settings.iter().map(|it| (*it).to_owned()).collect();
        let case = CaseFile::load(&self.out("case.toml"), &settings).unwrap();
        let (out, asked) = (self.out(name), AtomicUsize::new(0));
        let request = run::Request {
            is_stopped: &|| asked.fetch_add(1, Ordering::Relaxed) >= asks,
            ..run::Request::new(&case, &out, Build::default())
        };
        request.run(ProgressMode::Quiet).unwrap();
        asked.load(Ordering::Relaxed)
    }

    fn resume(&self, name: &str, settings: &[&str]) {
        let settings: Vec<String> = settings.iter().map(|it| (*it).to_owned()).collect();
        let request = resume::Request {
            folder: &self.out(name),
            mesh: None,
            settings: &settings,
            threads: None,
            build: Build::default(),
            is_stopped: &|| false,
            communicator: Arc::new(SingleProcess),
        };
        request.resume(ProgressMode::Quiet).unwrap();
    }
}

fn model(folder: &Path) -> String {
    fs::read_to_string(folder.join("model.vtu")).unwrap()
}

/// A run that is stopped at any state, the last one too, goes on to the files of a run that never stopped: also the fields of the model that are
/// written at the end.
#[test]
fn a_run_goes_on_from_each_of_its_states() {
    for (name, kind) in KINDS {
        let place = Place::new(kind);
        let n_asks = place.run("whole", usize::MAX, &[]);
        assert!(
            model(&place.out("whole")).contains("largest_utilisation"),
            "{name}"
        );
        assert!(n_asks > 4, "{name}: {n_asks}");
        // The first is before the first solution.
        let all = [1, 2, n_asks / 2, n_asks - 2, n_asks - 1];
        for asks in all {
            let out = format!("stopped-{asks}");
            if place.out(&out).exists() {
                continue;
            }
            place.run(&out, asks, &[]);
            let folder = place.out(&out);
            assert_eq!(termination(&folder), "stopped", "{name} {asks}");
            assert!(
                model(&folder).contains("largest_utilisation"),
                "{name} {asks}"
            );
            place.resume(&out, &[]);
            println!("{name}: after {asks} of {n_asks}");
            assert_same(&place.out("whole"), &folder);
        }
    }
}

/// A motion that a rule has ended ends there again without another one, and goes on with a later one as if that had been there from the start.
#[test]
fn a_motion_that_ended_by_a_rule_goes_on() {
    for (name, kind) in KINDS.iter().filter(|it| it.1.contains("analysis")) {
        let place = Place::new(kind);
        let [few, more] = ["motion.stop.bonds=1", "motion.stop.bonds=4"];
        place.run("whole", usize::MAX, &[more]);
        place.run("out", usize::MAX, &[few]);
        assert_eq!(termination(&place.out("out")), "bonds-broken", "{name}");
        let before = results(&place.out("out"));
        place.resume("out", &[]);
        assert!(results(&place.out("out")) == before, "{name}");
        place.resume("out", &[more]);
        assert_same(&place.out("whole"), &place.out("out"));
    }
}
