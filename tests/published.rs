//! The fast subset of `ligament-verify`: values of the papers, computed by the functions of `ligament run`.
#![allow(clippy::unwrap_used)]

use ligament_output::csv::read::records;
use ligament_verify::entry::Verdict;
use ligament_verify::table::{Extent, Table};
use ligament_verify::tally::Tally;
use ligament_verify::{Compute, Experiment, experiments, published_experiments};
use verification::numbers::largest;
use verification::repository;

/// Runs the fast subset of an experiment: every entry is met, within its tolerance, or a declared misprint or open
/// question whose independent value is met.
fn passes(experiment: &Experiment) {
    let findings = experiment.run(Extent::Fast).unwrap();
    assert!(!findings.tables.is_empty(), "{}", experiment.name);
    for table in &findings.tables {
        let name = &table.heading.name;
        assert!(!table.rows.is_empty(), "{name} has no fast entries");
        for row in &table.rows {
            assert!(
                row.verdict != Verdict::Failed,
                "{name}, {}: known {}, computed {}, allowed {}",
                table.labels(row),
                row.entry.known,
                row.computed,
                row.entry.allowed
            );
        }
        is_stored(experiment, table);
    }
    for case in experiment.case_files() {
        assert!(repository().join(case).is_file(), "{case}");
    }
    let tally = Tally::from_findings(&findings);
    assert!(
        tally.count(Verdict::Shown) < tally.entries(),
        "{} judges nothing",
        experiment.name
    );
    for plot in &findings.plots {
        plot.for_screen().unwrap();
    }
}

/// The stored report, `cases/verification`, is what the program computes: labels, verdicts, and values to 1e-6 of the
/// largest in their table. The order of breaking amplifies rounding, which processors do differently: peaks may differ
/// by 1 %.
fn is_stored(experiment: &Experiment, table: &Table) {
    let tolerance = if [
        "disk",
        "griffith",
        "cracks",
        "strength_disk",
        "strength_crack",
        "strength_glass",
        "motion_branching",
        "motion_kalthoff",
        "contact_flaw",
    ]
    .contains(&experiment.name)
        || matches!(experiment.compute, Compute::Measured(_))
    {
        1e-2
    } else {
        1e-6
    };
    let size = largest(table.rows.iter().map(|row| row.computed));
    let file = format!("cases/verification/{}.csv", table.heading.name);
    let text = std::fs::read_to_string(repository().join(&file)).unwrap();
    let stored = records(&text);
    let n_keys = table.heading.keys.len();
    for row in &table.rows {
        let place = format!("{file}, {}", table.labels(row));
        let line = stored
            .iter()
            .find(|line| line.iter().take(n_keys).eq(&row.entry.labels));
        let cells: Vec<&str> = line.expect(&place).iter().skip(n_keys).collect();
        let [known, computed, _, verdict, ..] = cells[..] else {
            panic!("{place}: too few cells");
        };
        assert_eq!(known, row.entry.known.to_string(), "{place}");
        assert_eq!(verdict, row.verdict.words(), "{place}");
        let computed: f64 = computed.parse().unwrap();
        let difference = (computed - row.computed).abs();
        assert!(
            difference <= tolerance * size,
            "{place}: stored {computed}, now {}",
            row.computed
        );
    }
}

/// Every experiment has a test of its own below, so that they run side by side and fail one by one.
macro_rules! experiments {
    ($($name:ident),*) => {
        $(#[test]
        fn $name() {
            let name = stringify!($name);
            let mut all = published_experiments().unwrap().iter();
            passes(all.find(|experiment| experiment.name == name).unwrap());
        })*

        #[test]
        fn all_experiments_are_tested() {
            let tested = [$(stringify!($name)),*];
            let all = published_experiments().unwrap().iter();
            assert!(all.map(|experiment| experiment.name).eq(tested));
        }
    };
}

experiments!(
    frequencies,
    statics,
    readings,
    lamina,
    tension,
    maps,
    directions,
    moduli,
    poisson,
    yielding,
    anisotropy,
    disk,
    slots,
    inclined,
    griffith,
    softening,
    plates,
    cylinder,
    cracks,
    cost,
    patch_test,
    bars,
    incompressible,
    ring,
    hole,
    horizons,
    disk_modes,
    strength_squares,
    strength_hole,
    strength_disk,
    strength_crack,
    strength_bar,
    strength_cube,
    strength_glass,
    motion_waves,
    motion_vibration,
    motion_lamb,
    motion_branching,
    motion_kalthoff,
    motion_spall,
    motion_stretching,
    motion_disk,
    motion_splitting,
    motion_contact,
    motion_schemes,
    contact_sliding,
    contact_hertz,
    contact_flaw,
    converge,
    refine
);

/// Measured tests: those with a fast run are run, and every value lies in the band that was written down before, or is missed for the reason
/// in the table.
#[test]
fn measured_tests() {
    let is_fast = |it: &&Experiment| match it.compute {
        Compute::Measured(test) => test.run.iter().any(|run| run.fast),
        Compute::Code(_) | Compute::File(_) => false,
    };
    let mut run = 0;
    for experiment in experiments().unwrap().iter().filter(is_fast) {
        passes(experiment);
        run += 1;
    }
    assert!(run > 0, "no measured test is among the tests");
}
