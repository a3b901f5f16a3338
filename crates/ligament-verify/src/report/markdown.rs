//! The full report in Markdown.

use std::fmt::Write as _;

use super::Printable;
use crate::entry::Verdict;
use crate::experiment::{Experiment, Findings};
use crate::table::Table;
use crate::tally::Tally;

/// Text of the full report, with all entries of every table and the curves.
pub(crate) fn text(done: &[(Experiment, Findings)]) -> String {
    let mut text = String::from(INTRODUCTION);
    let words = Verdict::ALL.map(Verdict::words).join(" | ");
    let dashes = "---|".repeat(3 + Verdict::ALL.len());
    let _ = write!(
        text,
        "\n| experiment | source | entries | {words} |\n|{dashes}\n"
    );
    for (experiment, findings) in done {
        let tally = Tally::from_findings(findings);
        let counts = tally.counts().map(|count| count.to_string()).join(" | ");
        let (name, source, entries) = (experiment.name, experiment.source, tally.entries());
        let _ = writeln!(
            text,
            "| [{name}](#{name}) | {source} | {entries} | {counts} |"
        );
    }
    for (experiment, findings) in done {
        let _ = write!(
            text,
            "\n## {}\n\n**{}.** {}\n",
            experiment.name, experiment.title, experiment.setup
        );
        let cases = experiment.case_files().into_iter();
        let cases: Vec<String> = cases.map(|case| format!("`{case}`")).collect();
        if !cases.is_empty() {
            let _ = write!(text, "\nCases: {}.\n", cases.join(", "));
        }
        for table in &findings.tables {
            push_table(&mut text, table);
        }
        for plot in &findings.plots {
            let _ = write!(text, "\n![{}]({}.svg)\n", plot.title, plot.name);
        }
        for maps in &findings.maps {
            let (title, quantity, name) = (&maps.title, &maps.quantity, &maps.name);
            let _ = write!(text, "\n{title}: {quantity}.\n\n![{title}]({name}.png)\n");
        }
    }
    text
}

const INTRODUCTION: &str = "\
# The long report

Every table of `ligament-verify`, entry by entry; [README.md](README.md) has the short one, and what the verdicts mean. Each
table is also a CSV file here, with all digits. The cases named below can be run by themselves; what an entry changes in
them is its labels, such as `--set material.poisson=0.1 --set model.law=pds`.
";

fn push_table(text: &mut String, table: &Table) {
    let heading = &table.heading;
    let Printable { rows, notes } = Printable::from_table(table);
    let _ = write!(
        text,
        "\n### {}\n\n{}. Source: {}.\n\n| {} |\n|{}\n",
        heading.title,
        heading.quantity,
        heading.source,
        rows[0].join(" | "),
        "---|".repeat(rows[0].len()),
    );
    for row in &rows[1..] {
        let _ = writeln!(text, "| {} |", row.join(" | "));
    }
    let _ = write!(text, "\nTolerance: {}\n", heading.tolerance);
    for (number, note) in notes.iter().enumerate() {
        let _ = write!(text, "\n[{}] {note}\n", number + 1);
    }
}
