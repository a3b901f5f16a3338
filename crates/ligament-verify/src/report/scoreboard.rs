//! The page of the measured tests: first the values outside their bands, then a table of all runs, then a figure for each test.

use std::fmt::Write as _;

use crate::entry::Verdict;
use crate::experiment::{Experiment, Findings};
use crate::measured::scoreboard::{Score, Scores};
use crate::measured::test::VERIFIED;
use crate::table::{Row, Table};

/// A measured test with its scores and its table.
struct Test<'a> {
    experiment: &'a Experiment,
    findings: &'a Findings,
    scores: &'a Scores,
    table: &'a Table,
}

/// Name of the page's file.
pub(crate) const PAGE: &str = "experiments.md";

/// Text of the page; None where no measured test was run.
pub(crate) fn text(done: &[(Experiment, Findings)]) -> Option<String> {
    let tests = done.iter().filter_map(|(experiment, findings)| {
        Some(Test {
            experiment,
            findings,
            scores: findings.scores.as_ref()?,
            table: findings.tables.first()?,
        })
    });
    let mut tests: Vec<Test<'_>> = tests.collect();
    if tests.is_empty() {
        return None;
    }
    tests.sort_by_key(|test| std::cmp::Reverse(test.misses().count()));
    let mut text = String::from(INTRODUCTION);
    push_misses(&mut text, &tests);
    push_table(&mut text, &tests);
    for test in &tests {
        push_test(&mut text, test);
    }
    Some(text)
}

const INTRODUCTION: &str = "\
# Measured tests

Written by `ligament-verify experiments`. Each test has bands of acceptance that were written down before its first run here, with what the
source says of the material and nothing fitted. Ratios are computed over measured (*validation*: of the data and the program together), or over an
independent solution of the same body, material and softening by cohesive finite elements (*verification*: of the program alone); a number in bold
is out of its band. *Spent* is the energy dissipated over the area of the cracks, over the fracture energy that was given. Seconds are of processor
time, with meshing and output.
";

impl Test<'_> {
    fn misses(&self) -> impl Iterator<Item = &Row> {
        self.table.rows.iter().filter(|row| is_missed(row))
    }

    /// Row of a run, or a series, for a quantity.
    fn row(&self, run: &str, quantity: &str) -> Option<&Row> {
        let rows = self.table.rows.iter();
        let mut rows = rows.filter(|row| row.entry.labels == [run, quantity]);
        rows.next()
    }

    /// Quantities of the test, in the order of their first rows.
    fn quantities(&self) -> Vec<&str> {
        let mut quantities: Vec<&str> = Vec::new();
        for quantity in self.table.rows.iter().map(|row| &*row.entry.labels[1]) {
            if !quantities.contains(&quantity) {
                quantities.push(quantity);
            }
        }
        quantities
    }
}

fn is_missed(row: &Row) -> bool {
    matches!(row.verdict, Verdict::Missed | Verdict::Failed)
}

/// Text of a value, in bold where it is out of its band.
fn value_text(row: &Row) -> String {
    let value = match row.computed.is_finite() {
        true => format!(
            "{:.*}",
            if row.computed.abs() < 20.0 { 2 } else { 1 },
            row.computed
        ),
        false => "none".to_owned(),
    };
    match is_missed(row) {
        true => format!("**{value}**"),
        false => value,
    }
}

/// Text of the distance of a value beyond the nearer end of its band.
fn distance_beyond_band(table: &Table, row: &Row) -> String {
    let difference = table.difference(row).words(&row.entry.known);
    format!("{difference}, allowed {}", row.entry.allowed)
}

fn push_misses(text: &mut String, tests: &[Test<'_>]) {
    let rows = tests.iter().flat_map(|test| &test.table.rows);
    let (verified, validated): (Vec<&Row>, Vec<&Row>) =
        rows.partition(|row| row.entry.labels[1].ends_with(VERIFIED));
    let [verified, validated] = [verified, validated].map(|rows| {
        let missed = rows.iter().filter(|row| is_missed(row)).count();
        (missed, rows.len())
    });
    let _ = write!(
        text,
        "\n## Out of their bands\n\n{} of {} values over measured ones, {} of {} over independent ones.\n",
        validated.0, validated.1, verified.0, verified.1
    );
    if validated.0 + verified.0 == 0 {
        return;
    }
    text.push_str("\n| test | run | quantity | off by | likely reason |\n|---|---|---|---|---|\n");
    for test in tests {
        for row in test.misses() {
            let [run, quantity] = [0, 1].map(|place| &row.entry.labels[place]);
            let _ = writeln!(
                text,
                "| [{name}](#{name}) | {run} | {quantity} | {} | {} |",
                distance_beyond_band(test.table, row),
                row.entry.standing.reason().unwrap_or("not known"),
                name = test.experiment.name,
            );
        }
    }
}

fn push_table(text: &mut String, tests: &[Test<'_>]) {
    text.push_str(
        "\n## All runs\n\n| test | run | points | peak | verified | work | verified | spent | seconds | increments | failed |\n|---|---|---|---|---|---|---|---|---|---|---|\n",
    );
    for test in tests {
        for score in &test.scores.runs {
            let value = |quantity: &str| {
                let row = test.row(&score.run, quantity);
                row.map(value_text).unwrap_or_default()
            };
            let [peak, work] = ["peak", "area under the curve"]
                .map(|it| [value(it), value(&format!("{it}{VERIFIED}"))].join(" | "));
            let _ = writeln!(
                text,
                "| [{name}](#{name}) | {} | {} | {peak} | {work} | {} | {:.0} | {} | {} |",
                score.run,
                score.points,
                spent(score),
                score.seconds,
                score.increments,
                score.failed,
                name = test.experiment.name,
            );
        }
    }
}

fn spent(score: &Score) -> String {
    score.spent.map_or(String::new(), |it| format!("{it:.2}"))
}

fn push_test(text: &mut String, test: &Test<'_>) {
    let Test {
        experiment,
        findings,
        scores,
        table,
    } = test;
    let _ = write!(
        text,
        "\n## {}\n\n**{}** ({}). {} Case: `{}`.\n",
        experiment.name, experiment.title, table.heading.source, scores.material, scores.case
    );
    for plot in &findings.plots {
        let _ = write!(text, "\n![{}]({}.svg)\n", plot.title, plot.name);
    }
    let quantities = test.quantities();
    let _ = write!(
        text,
        "\n| run | {} |\n|---|{}\n",
        quantities.join(" | "),
        "---|".repeat(quantities.len())
    );
    let mut runs: Vec<&str> = Vec::new();
    for run in table.rows.iter().map(|row| &*row.entry.labels[0]) {
        if !runs.contains(&run) {
            runs.push(run);
        }
    }
    for run in runs {
        let cell = |quantity: &&str| test.row(run, quantity).map_or(String::new(), value_text);
        let cells: Vec<String> = quantities.iter().map(cell).collect();
        let _ = writeln!(text, "| {run} | {} |", cells.join(" | "));
    }
    let allowed = |quantity: &&str| {
        let rows = table
            .rows
            .iter()
            .filter(|row| row.entry.labels[1] == **quantity);
        let bands = rows.map(|row| format!("{} ({})", row.entry.known, row.entry.allowed));
        let mut bands: Vec<String> = bands.collect();
        bands.dedup();
        bands.join("; ")
    };
    let allowed: Vec<String> = quantities.iter().map(allowed).collect();
    let _ = writeln!(text, "| *band* | {} |", allowed.join(" | "));
    let _ = write!(text, "\nBands: {}\n", table.heading.tolerance);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiment::Compute;
    use crate::published::known_values;
    use crate::table::Extent;

    const ROWS: &str = "\
# title: Beam
# source: Author 2019
# quantity: computed over measured
# known: measured
# tolerance: peak: two specimens.
run,quantity,known,allowed,subset,standing,instead,reason
4 mm,peak,1.000,-0.1 to 0.1,fast,,,
3 mm,peak,1.000,-0.1 to 0.1,fast,missed,1.3,coarse mesh
";

    fn test(name: &'static str, second: f64) -> (Experiment, Findings) {
        let experiment = Experiment {
            name,
            title: "Beam",
            source: "Author 2019",
            setup: "",
            cases: &[],
            compute: Compute::Code(|_| Ok(Findings::default())),
        };
        let mut values = [1.04, second].into_iter();
        let table = known_values(name, ROWS).unwrap();
        let table = table.judge(Extent::Full, |_| Ok(values.next().unwrap()));
        let score = |run: &str, failed| Score {
            run: run.to_owned(),
            points: 400,
            increments: 50,
            failed,
            seconds: 3.4,
            spent: Some(0.98),
        };
        let scores = Scores {
            case: "cases/a/case.toml".to_owned(),
            material: "E 30 GPa.".to_owned(),
            runs: vec![score("4 mm", 0), score("3 mm", 2)],
        };
        let findings = Findings {
            tables: vec![table.unwrap()],
            scores: Some(scores),
            ..Findings::default()
        };
        (experiment, findings)
    }

    /// Misses stand first in every part of the page, in bold, with their distance from the band and the reason.
    #[test]
    fn what_missed_stands_first_and_is_not_hidden() {
        let text = text(&[test("met", 0.95), test("missed", 1.3)]).unwrap();
        for line in [
            "1 of 4 values over measured ones, 0 of 0 over independent ones.",
            "| [missed](#missed) | 3 mm | peak | +0.3000, allowed -0.1 to +0.1 | coarse mesh |",
            "| [missed](#missed) | 3 mm | 400 | **1.30** |  |  |  | 0.98 | 3 | 50 | 2 |",
            "| [met](#met) | 3 mm | 400 | 0.95 |  |  |  | 0.98 | 3 | 50 | 2 |",
            "| 3 mm | **1.30** |",
            "| *band* | 1.000 (-0.1 to +0.1) |",
        ] {
            assert!(text.lines().any(|it| it == line), "{line}\n{text}");
        }
        assert!(text.find("## missed").unwrap() < text.find("## met").unwrap());
    }

    #[test]
    fn without_measured_tests_there_is_no_page() {
        let (experiment, _) = test("met", 1.0);
        assert_eq!(text(&[(experiment, Findings::default())]), None);
    }
}
