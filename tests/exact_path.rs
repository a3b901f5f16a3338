//! The exact equilibrium path: against an independent calculation, closed forms, and the stepped driver.
//!
//! Each test states its problem and where its expectation comes from. An assertion that something is zero or equal
//! stands beside one that the thing compared is there at all.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

use verification::bench::Bench;
use verification::numbers::{largest, relative_error, short};
use verification::problems::DISK;
use verification::table::Table;

/// The shared disk without load steps.
fn disk(more: &[&str]) -> Bench {
    let text = DISK.replace("{ steps = 50 }", "{ control = \"event\" }");
    Bench::new(&text, more)
}

/// The first 200 breakages of the disk, bond for bond, with load factor, displacement and load (`reference/README.md`).
///
/// 1e-8: rounding times the condition number of the stiffness; the reference's own bonds are no closer than 1.9e-5.
#[test]
fn events_of_the_disk() {
    let expected = Table::reference("disk-event.csv");
    let settings = ["mesh.file=reference/disk.msh", "fracture.stop.bonds=200"];
    let bench = disk(&settings);
    let run = bench.break_up();
    assert_eq!((expected.len(), run.breaks.len()), (200, 200));
    let mut worst = [0.0_f64; 3];
    for (row, record) in run.breaks.iter().enumerate() {
        let tags = ["a", "b"].map(|end| expected.count(row, end) as u64);
        assert_eq!(
            (
                record.order,
                record.step,
                bench.tags_of_bond(record.bond as usize)
            ),
            (row + 1, row + 1, tags)
        );
        let step = &run.outcome.history[record.step];
        assert_eq!(step.load_factor, record.load_factor);
        assert_eq!(step.broken_bonds, row);
        for (k, (column, of_bond, of_step)) in [
            ("factor", record.load_factor, step.load_factor),
            ("displacement", record.displacement, step.displacement),
            ("load", record.reaction, step.reaction),
        ]
        .into_iter()
        .enumerate()
        {
            assert_eq!(of_bond, of_step, "{column} of breakage {}", row + 1);
            let error = relative_error(of_bond, expected.number(row, column));
            worst[k] = worst[k].max(error);
            assert!(
                error < 1e-8,
                "{column} of breakage {} off by {error:.1e}",
                row + 1
            );
        }
    }
    println!(
        "200 events: factor, displacement, load off by {}",
        short(&worst)
    );
    let peak = run.outcome.peak().unwrap();
    let load = expected.column("load");
    assert!(relative_error(peak.reaction, largest(load)) < 1e-8);
    assert!(run.outcome.first_peak(0.02).unwrap().reaction <= peak.reaction);
}
