//! The report of a verification: console, Markdown, CSV and SVG.

use std::fmt::Write as _;

use super::entry::Reliability;
use super::table::{Row, Table};

pub(super) mod console;
pub(super) mod files;
pub(super) mod markdown;
pub(super) mod page;
pub(super) mod scoreboard;

/// A table as text.
struct Printable {
    /// Names of the columns, and one row for each entry.
    rows: Vec<Vec<String>>,
    /// Footnotes with the reasons for verdicts, numbered from 1 in the rows.
    notes: Vec<String>,
}

impl Printable {
    fn from_table(table: &Table) -> Self {
        let values = [
            &table.heading.known,
            "computed",
            "difference",
            "allowed",
            "verdict",
        ];
        let head = table.heading.keys.iter().cloned();
        let head = head.chain(values.map(str::to_owned)).collect();
        let mut notes: Vec<String> = Vec::new();
        let rows = table.rows.iter().map(|row| words(table, row, &mut notes));
        Self {
            rows: std::iter::once(head).chain(rows).collect(),
            notes,
        }
    }
}

/// Text of a row; a new reason is appended to the notes.
fn words(table: &Table, row: &Row, notes: &mut Vec<String>) -> Vec<String> {
    let entry = &row.entry;
    let mut verdict = row.verdict.words().to_owned();
    match &entry.standing {
        Reliability::Misprint { instead, .. } => {
            let _ = write!(verdict, " for {instead}");
        }
        Reliability::Open { instead, .. } => {
            let _ = write!(verdict, " (independently {instead})");
        }
        Reliability::Sound | Reliability::Truncated { .. } | Reliability::Missed { .. } => {}
    }
    if let Some(reason) = entry.standing.reason() {
        let number = notes.iter().position(|it| it == reason).unwrap_or_else(|| {
            notes.push(reason.to_owned());
            notes.len() - 1
        });
        let _ = write!(verdict, " [{}]", number + 1);
    }
    let mut words = entry.labels.clone();
    words.extend([
        entry.known.to_string(),
        entry.known.like(row.computed),
        table.difference(row).words(&entry.known),
        entry.allowed.to_string(),
        verdict,
    ]);
    words
}

#[cfg(test)]
mod tests {
    use ligament_output::folder::{Kind, ResultFolder};

    use super::files::{SUMMARY, Summary};
    use super::*;
    use crate::entry::Verdict;
    use crate::experiment::{Compute, Experiment, Findings};
    use crate::published::known_values;
    use crate::table::{Extent, Labels};
    use crate::tally::Tally;

    const TABLE: &str = "\
# title: First mode
# source: Author 2019, Table 4
# quantity: f, Hz
# known: printed
# tolerance: because
nu,known,allowed,subset,standing,instead,reason
0,2294.9,digits,fast,,,
0.1,2025.5,digits,fast,misprint,2053,\"digits exchanged, as ...\"
0.25,1565.9,1 %,fast,,,
";

    const EXPERIMENT: Experiment = Experiment {
        name: "modes",
        title: "Modes",
        source: "Author 2019",
        setup: "A lamina.",
        cases: &["cases/a.toml", "cases/b.toml"],
        compute: Compute::Code(|_| findings()),
    };

    fn findings() -> anyhow::Result<Findings> {
        let known = known_values("t4", TABLE)?;
        let values = [("0", 2294.86), ("0.1", 2053.2), ("0.25", 1500.0)];
        let compute = |labels: Labels<'_>| {
            let nu = labels.text("nu")?;
            Ok(values
                .iter()
                .find(|(label, _)| *label == nu)
                .map_or(0.0, |it| it.1))
        };
        let table = known.judge(Extent::Full, compute)?;
        Ok(Findings {
            tables: vec![table],
            ..Findings::default()
        })
    }

    #[test]
    fn the_console_shows_each_entry_and_the_reasons() {
        let mut out = Vec::new();
        console::write(&mut out, &findings().unwrap()).unwrap();
        let expected = "
  First mode, f, Hz
    nu    printed  computed  difference  allowed  verdict
    0     2294.9   2294.86   0.00 %      digits   rounded
    0.1   2025.5   2053.20   +1.37 %     digits   misprint for 2053 [1]
    0.25  1565.9   1500.00   -4.21 %     1 %      FAILED
    [1] digits exchanged, as ...

";
        assert_eq!(String::from_utf8(out).unwrap(), expected);
    }

    #[test]
    fn markdown_has_counts_tables_and_notes() {
        let text = markdown::text(&[(EXPERIMENT, findings().unwrap())]);
        for line in [
            "| [modes](#modes) | Author 2019 | 3 | 1 | 0 | 0 | 1 | 0 | 0 | 0 | 1 |",
            "| nu | printed | computed | difference | allowed | verdict |",
            "| 0.1 | 2025.5 | 2053.20 | +1.37 % | digits | misprint for 2053 [1] |",
            "[1] digits exchanged, as ...",
            "Tolerance: because",
            "Cases: `cases/a.toml`, `cases/b.toml`.",
        ] {
            assert!(text.lines().any(|it| it == line), "{line}\n{text}");
        }
    }

    /// A table that no paper has stands below the papers, with counts and the largest difference.
    #[test]
    fn the_page_has_a_line_a_table() {
        let done = [(EXPERIMENT, findings().unwrap())];
        let text = page::text(&done, Extent::Fast).unwrap();
        for line in [
            "This is the fast subset (`--fast`).",
            "| [modes](report.md#modes) | First mode | printed | 1 to the digit; 1 misprint; 1 FAILED |",
        ] {
            assert!(text.lines().any(|it| it == line), "{line}\n{text}");
        }
    }

    /// Statements hold or do not; their numbers are bounds of ours.
    #[test]
    fn the_page_says_of_statements_that_they_hold() {
        let known = known_values("t4", &TABLE.replace("known: printed", "known: statement"));
        let table = known.unwrap().judge(Extent::Full, |_| Ok(2053.2));
        let findings = Findings {
            tables: vec![table.unwrap()],
            ..Findings::default()
        };
        let text = page::text(&[(EXPERIMENT, findings)], Extent::Full).unwrap();
        let outcome = "stated: 1 refuted; stated: 2 FAILED |";
        assert!(text.contains(outcome), "{text}");
    }

    #[test]
    fn tallies_add_up_and_are_told() {
        let tally = Tally::from_findings(&findings().unwrap());
        let sum: Tally = [tally, tally].into_iter().sum();
        assert_eq!((sum.entries(), sum.count(Verdict::Failed)), (6, 2));
        assert_eq!(
            tally.to_string(),
            "3 entries: 1 rounded, 1 misprint, 1 FAILED"
        );
    }

    #[test]
    fn csv_has_all_digits_and_the_reason() {
        let parent = tempfile::tempdir().unwrap();
        let folder = ResultFolder::create_of_kind(
            parent.path().join("out"),
            Kind::with_marker(SUMMARY),
            false,
        )
        .unwrap();
        let mut summary = Summary::create(&folder).unwrap();
        let findings = findings().unwrap();
        files::write(&folder, &findings).unwrap();
        summary
            .append(&EXPERIMENT, &Tally::from_findings(&findings))
            .unwrap();
        let text = std::fs::read_to_string(folder.file("t4.csv")).unwrap();
        let row = "0.1,2025.5,2053.2,digits,misprint,2053,\"digits exchanged, as ...\"";
        assert!(text.lines().any(|line| line == row), "{text}");
        let text = std::fs::read_to_string(folder.file(SUMMARY)).unwrap();
        assert!(
            text.ends_with("modes,Author 2019,3,1,0,0,1,0,0,0,1\n"),
            "{text}"
        );
    }
}
