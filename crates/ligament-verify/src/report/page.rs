//! The page of the papers: one line per table or figure, with its verdicts.

use std::fmt::Write as _;

use crate::entry::Verdict;
use crate::experiment::{Experiment, Findings};
use crate::papers::{Comparison, Item, PAPERS, items};
use crate::printed::Difference;
use crate::table::{Extent, Row, Table};
use crate::tally::Tally;

/// A row with its table.
type RowOfTable<'a> = (&'a Table, &'a Row);

/// Text of the page for the experiments that were run.
///
/// # Errors
///
/// If the list of the papers' contents is wrong.
pub(crate) fn text(done: &[(Experiment, Findings)], extent: Extent) -> anyhow::Result<String> {
    let items = items()?;
    let findings = || done.iter().map(|(_, findings)| findings);
    let mut compared = Vec::new();
    for item in &items {
        compared.push((item, item.rows(findings())?));
    }
    let mut text = String::from(INTRODUCTION);
    if extent == Extent::Fast {
        text.push_str("\nThis is the fast subset (`--fast`).\n");
    }
    push_counts(&mut text, &compared);
    for (name, reference) in PAPERS {
        let of_paper = || compared.iter().filter(|(item, _)| item.paper == name);
        if of_paper().all(|(_, rows)| rows.is_empty()) {
            continue;
        }
        let _ = write!(
            text,
            "\n## {name}\n\n{reference}.\n\n| there | content | against | outcome | remark |\n|---|---|---|---|---|\n"
        );
        for (item, rows) in of_paper() {
            let Item {
                place,
                content,
                remark,
                ..
            } = item;
            let _ = writeln!(
                text,
                "| {place} | {content} | {} | {} | {remark} |",
                kinds_of_known_values(rows),
                outcome(item, rows)
            );
        }
    }
    push_others(&mut text, done, &compared);
    Ok(text)
}

const INTRODUCTION: &str = "\
# Verification

Written by `ligament-verify`: what stands in five papers, and what this version of the program computes for it by the
functions of `ligament run`. Behind this page is the [long report](report.md), with every entry, the reasons, and the cases
to run.

- **to the digit**: the computed value, rounded, is the printed one (*rounded*), or cut off (*truncated*).
- **within**: as near as it should be, for the reason that stands under the table in the long report.
- **misprint**: the printed value, or the statement, is wrong by other evidence than our own calculation of it alone; the
  computed one is what should stand there.
- **differs, cause unknown**: the set-up of the paper, as far as it is told, does not lead to the printed value, and the
  computed one is that of an independent calculation.
- **missed**: the known value is right, and the method does not come near enough to it, for the reason in the note.
- **stated**: what the paper says in words, with a bound of ours that stands under the table in the long report: it holds, or
  does not.
- **not judged**: shown for comparison. **FAILED**: should be near, and is not.
";

/// Appends the numbers of values of each paper by verdict, separately for printed values and other references.
fn push_counts(text: &mut String, compared: &[(&Item, Vec<RowOfTable<'_>>)]) {
    let words = Verdict::ALL.map(Verdict::words).join(" | ");
    let dashes = "---|".repeat(3 + Verdict::ALL.len());
    let _ = write!(
        text,
        "\n| paper | against | values | {words} |\n|{dashes}\n"
    );
    let of_paper = |name| compared.iter().filter(move |(item, _)| item.paper == name);
    for (name, _) in PAPERS {
        for (against, is_printed) in [("the paper", true), ("other references", false)] {
            let rows = of_paper(name).flat_map(|(_, rows)| rows);
            let verdicts = rows
                .filter(|(table, _)| table.heading.is_of_a_paper() == is_printed)
                .map(|(_, row)| row.verdict);
            let tally = Tally::from_verdicts(verdicts);
            if tally.entries() > 0 {
                let counts = tally.counts().map(|count| count.to_string()).join(" | ");
                let _ = writeln!(
                    text,
                    "| {name} | {against} | {} | {counts} |",
                    tally.entries()
                );
            }
        }
    }
    for (name, _) in PAPERS {
        let missing: Vec<&str> = of_paper(name)
            .filter(|(item, _)| item.comparison == Comparison::NotComputed)
            .map(|(item, _)| item.place.as_str())
            .collect();
        if !missing.is_empty() {
            let _ = write!(text, "\nNot computed of {name}: {}.\n", missing.join("; "));
        }
    }
}

/// Appends the experiments with tables that compare with no paper.
fn push_others(
    text: &mut String,
    done: &[(Experiment, Findings)],
    compared: &[(&Item, Vec<RowOfTable<'_>>)],
) {
    let is_told = |table: &Table| {
        let rows = compared.iter().flat_map(|(_, rows)| rows);
        rows.into_iter()
            .any(|(listed, _)| listed.heading.name == table.heading.name)
    };
    let mut lines = String::new();
    for (experiment, findings) in done {
        for table in findings.tables.iter().filter(|table| !is_told(table)) {
            let rows: Vec<RowOfTable<'_>> = table.rows.iter().map(|row| (table, row)).collect();
            let _ = writeln!(
                lines,
                "| [{name}](report.md#{name}) | {} | {} | {} |",
                table.heading.title,
                table.heading.known,
                words(&rows),
                name = experiment.name,
            );
        }
    }
    if !lines.is_empty() {
        let _ = write!(
            text,
            "\n## Beside the papers\n\n| experiment | table | against | outcome |\n|---|---|---|---|\n{lines}"
        );
    }
}

/// Kinds of the known values of the rows, each once.
fn kinds_of_known_values(rows: &[RowOfTable<'_>]) -> String {
    let mut known: Vec<&str> = Vec::new();
    for (table, _) in rows {
        if !known.contains(&&*table.heading.known) {
            known.push(&table.heading.known);
        }
    }
    known.join("; ")
}

fn outcome(item: &Item, rows: &[RowOfTable<'_>]) -> String {
    match &item.comparison {
        Comparison::NoResult => "no result".to_owned(),
        Comparison::Drawn => "[drawn](report.md#maps)".to_owned(),
        Comparison::NotComputed => "**not computed**".to_owned(),
        Comparison::Rows(_) if rows.is_empty() => "not run".to_owned(),
        Comparison::Rows(_) => words(rows),
    }
}

/// Text with the numbers of values by verdict and of true statements.
fn words(rows: &[RowOfTable<'_>]) -> String {
    let is_statement = |row: &&RowOfTable<'_>| row.0.heading.known == "statement";
    let (statements, values): (Vec<RowOfTable<'_>>, Vec<_>) = rows.iter().partition(is_statement);
    let mut parts = words_of_values(&values);
    parts.extend(words_of_statements(&statements));
    parts.join("; ")
}

/// The rows by verdict, the best first.
fn by_verdict<'a>(
    rows: &'a [RowOfTable<'a>],
) -> impl Iterator<Item = (Verdict, Vec<RowOfTable<'a>>)> + 'a {
    let of_verdict = |verdict: Verdict| {
        let those = rows.iter().filter(|(_, row)| row.verdict == verdict);
        (verdict, those.copied().collect::<Vec<_>>())
    };
    (Verdict::ALL.into_iter().map(of_verdict)).filter(|(_, those)| !those.is_empty())
}

fn words_of_values(rows: &[RowOfTable<'_>]) -> Vec<String> {
    let part = |(verdict, those): (Verdict, Vec<RowOfTable<'_>>)| {
        let (count, largest) = (those.len(), largest(those.iter().copied()));
        match verdict {
            Verdict::Rounded => format!("{count} to the digit"),
            Verdict::Truncated => format!("{count} to the digit, truncated"),
            Verdict::Within => format!("{count} within {largest}"),
            Verdict::Differs => format!("{count} differ by up to {largest}, cause unknown"),
            Verdict::Missed => format!("{count} missed by up to {largest}"),
            Verdict::Misprint | Verdict::Shown | Verdict::Failed => {
                format!("{count} {}", verdict.words())
            }
        }
    };
    by_verdict(rows).map(part).collect()
}

/// Text with the numbers of statements by verdict; bounds represent the statements.
fn words_of_statements(rows: &[RowOfTable<'_>]) -> Vec<String> {
    let part = |(verdict, those): (Verdict, Vec<RowOfTable<'_>>)| {
        let count = those.len();
        match verdict {
            Verdict::Rounded | Verdict::Truncated => format!("stated: {count} hold"),
            Verdict::Within => format!("stated: {count} hold within their bounds"),
            Verdict::Misprint => format!("stated: {count} refuted"),
            Verdict::Differs => format!("stated: {count} do not hold, cause unknown"),
            Verdict::Missed => format!("stated: {count} do not hold"),
            Verdict::Shown | Verdict::Failed => format!("stated: {count} {}", verdict.words()),
        }
    };
    by_verdict(rows).map(part).collect()
}

/// Text of the largest difference from the known values, as a share and, in tables of amounts, as an amount.
fn largest<'a>(rows: impl Iterator<Item = RowOfTable<'a>> + Clone) -> String {
    let share = rows
        .clone()
        .filter_map(|(table, row)| match table.difference(row) {
            Difference::Share(share) => Some(share.abs()),
            Difference::Amount(_) => None,
        });
    let amount = rows.filter_map(|(table, row)| match table.difference(row) {
        Difference::Share(_) => None,
        Difference::Amount(amount) => Some((amount.abs(), &row.entry.known)),
    });
    let share = share.max_by(f64::total_cmp);
    let amount = amount.max_by(|one, other| one.0.total_cmp(&other.0));
    let share = share.map(|share| format!("{:.2} %", 100.0 * share));
    let amount = amount.map(|(amount, known)| known.like(amount));
    share
        .into_iter()
        .chain(amount)
        .collect::<Vec<_>>()
        .join(" or ")
}
