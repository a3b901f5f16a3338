//! Samples of the disk of the Brazilian test, as the command makes them, against their exact paths alone, on one thread.
//!
//! The paths alone begin from the prepared body with limits that are known. All else counts for the ensemble: model, factor, the path
//! without random factors, random fields, limits, rows, counts, tables, fields and plots. `LIGAMENT_SAMPLES` is the number of samples.
//! Seconds are of the processor, so that other programs matter little.
#![allow(clippy::unwrap_used, clippy::print_stdout, missing_docs)]

use std::io;

use ligament::ensemble::Ensemble;
use ligament_run::progress::ProgressMode;
use ligament_study::ensemble::{Request, Settings, Task, ensemble};
use rustix::time::{ClockId, clock_gettime};
use verification::bench::Bench;
use verification::problems;

const SEED: u64 = 7;

fn main() {
    let n: u64 = std::env::var("LIGAMENT_SAMPLES").map_or(20, |it| it.parse().unwrap());
    let scatter = "scatter = { of = \"strength\", modulus = 12.0, correlation_length = 0.005 }";
    let event = "control = \"event\", stop = { load_fraction = 0.5 }";
    let fracture = format!("fracture={{ {event}, {scatter} }}");
    let settings = [
        "mesh.file=../meshes/disk-2mm.msh",
        "solver.threads=1",
        &fracture,
    ];
    let case = verification::bench::case(problems::DISK, &settings);

    let bench = Bench::new(problems::DISK, &settings);
    let points = bench.points();
    let bare = ligament::run::on_threads(Some(1), || {
        let shared = Ensemble::new(bench.model, SEED).unwrap();
        let mut alone = 0.0;
        let mut broken = 0;
        for number in 0..n {
            let problem = shared.with_limits(&shared.scatter_of(number)).unwrap();
            let start = seconds();
            broken += shared.followed(&problem).unwrap().outcome.broken_bonds;
            alone += seconds() - start;
        }
        println!(
            "{points} points, {n} samples, {} bonds broken in the mean",
            broken as u64 / n
        );
        alone
    });
    let bare = bare.unwrap();

    let folder = tempfile::tempdir().unwrap();
    let request = Request {
        case: &case,
        samples: n,
        seed: SEED,
        points: 101,
        displacement: None,
        out: &folder.path().join("out"),
        is_stopped: &|| false,
        task: Task::Run(Settings {
            shard: None,
            jobs: Some(1),
            force: false,
            progress: ProgressMode::Quiet,
        }),
    };
    let start = seconds();
    ensemble(&request, &mut io::sink()).unwrap();
    let whole = seconds() - start;
    println!(
        "paths alone {:.2} s, ensemble {:.2} s, ratio {:.3}",
        bare,
        whole,
        whole / bare
    );
}

/// Processor time of the program so far, s.
fn seconds() -> f64 {
    let time = clock_gettime(ClockId::ProcessCPUTime);
    time.tv_sec as f64 + 1e-9 * time.tv_nsec as f64
}
