//! The fast subset of `ligament verify`: values of the papers, computed by the functions of `ligament run`.
#![allow(clippy::unwrap_used)]

use ligament::verify::entry::Verdict;
use ligament::verify::table::Extent;
use ligament::verify::tally::Tally;
use ligament::verify::{EXPERIMENTS, Experiment};

/// Runs the fast subset of an experiment: every entry is met, within its tolerance, or a declared misprint or open question
/// whose independent value is met.
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
    }
    let tally = Tally::of(&findings);
    assert!(
        tally.count(Verdict::Shown) < tally.entries(),
        "{} judges nothing",
        experiment.name
    );
    for plot in &findings.plots {
        plot.to_svg().unwrap();
    }
}

/// Every experiment has a test of its own below, so that they run side by side and fail one by one.
macro_rules! experiments {
    ($($name:ident),*) => {
        $(#[test]
        fn $name() {
            let name = stringify!($name);
            passes(EXPERIMENTS.iter().find(|experiment| experiment.name == name).unwrap());
        })*

        #[test]
        fn all_experiments_are_tested() {
            let tested = [$(stringify!($name)),*];
            assert!(EXPERIMENTS.iter().map(|experiment| experiment.name).eq(tested));
        }
    };
}

experiments!(frequencies, statics, lamina, tension, moduli, poisson, disk);
