//! The report as Markdown.

use std::fmt::Write as _;

use super::Printable;
use crate::entry::Verdict;
use crate::experiment::{Experiment, Findings};
use crate::table::{Extent, Table};
use crate::tally::Tally;

/// The report as Markdown.
pub(crate) fn text(done: &[(&Experiment, Findings)], extent: Extent) -> String {
    let mut text = String::from(INTRODUCTION);
    if extent == Extent::Fast {
        text.push_str("\nThis is the fast subset (`--fast`).\n");
    }
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
            "\n## {}\n\n**{}.** {}\n\nCases: {}.\n",
            experiment.name,
            experiment.title,
            experiment.setup,
            experiment
                .cases
                .iter()
                .map(|case| format!("`{}`", case.path))
                .collect::<Vec<_>>()
                .join(", ")
        );
        for table in &findings.tables {
            push_table(&mut text, table);
        }
        for plot in &findings.plots {
            let _ = write!(text, "\n![{}]({}.svg)\n", plot.title, plot.name);
        }
    }
    text
}

const INTRODUCTION: &str = "\
# Verification

Written by `ligament verify`: published values, and what this version of the program computes for them by the functions
of `ligament run`. Each table is also a CSV file here, with all digits. The cases named below can be run by themselves;
what an entry changes in them is its labels, such as `--set material.poisson=0.1 --set model.law=pds`.

- **met**: the computed value, rounded, is the known one. **within tolerance**: it is as near as *allowed*.
- **misprint**: the known value is a misprint, and the computed one is what should stand there. **not reproduced**: the
  set-up of the table does not lead to the known value, and the computed one is that of an independent calculation. Notes
  give the reasons; an entry that misses what it is compared with instead fails as any other.
- **missed**: the known value is right, and the method does not come near enough to it, for the reason in the note.
- **not judged**: shown for comparison. **FAILED**: should be near, and is not.
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
