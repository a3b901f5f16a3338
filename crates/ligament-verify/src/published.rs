//! Reader of tables of known values from CSV.
//!
//! ```text
//! # title: First flexural frequency
//! # source: Author 2019, Table 4
//! # quantity: f, Hz
//! # known: printed
//! # tolerance: why the tolerances are what they are
//! nu,law,known,allowed,subset,standing,instead,reason
//! 0,pds,2294.9,digits,fast,,,
//! 0.1,pds,2025.5,digits,full,misprint,2053,"why it is one"
//! ```
//!
//! The columns before `known` are the labels of an entry. `allowed` is `digits`, a share such as `3 %`, an amount in the unit of the table,
//! two differences such as `-0.02 to 0.005`, or `any`; `subset` is `fast` or `full`; `standing` is empty, `truncated`, `misprint`, `open` or
//! `missed`.

use std::path::{Path, PathBuf};

use anyhow::Context;
use ligament_output::csv::read::{StringRecord, records};

use super::entry::{Entry, Reliability};
use super::printed::{PrintedNumber, Tolerance};
use super::table::{Heading, KnownTable};

/// Columns of every table, after the columns of its labels.
const COLUMNS: [&str; 6] = [
    "known", "allowed", "subset", "standing", "instead", "reason",
];

/// The known values of a table, by the name of its file.
pub(super) fn known_table(table: &str) -> anyhow::Result<KnownTable> {
    let path = folder().join(format!("{table}.csv"));
    let text = std::fs::read_to_string(&path).with_context(|| path.display().to_string())?;
    Ok(known_values(table, &text)?)
}

/// Folder of the experiments and their tables.
pub(super) fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("src/published")
}

/// Error of a table, with its line.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("published table {name}, line {line}: {fault}")]
pub(super) struct TableError {
    /// Name of the table.
    pub(super) name: String,
    /// Line number, from 1.
    pub(super) line: usize,
    /// Description of the error.
    pub(super) fault: String,
}

/// Parses the known values of a table; `name` is the name of its file.
pub(super) fn known_values(name: &str, text: &str) -> Result<KnownTable, TableError> {
    let at = |line: usize| {
        move |fault| TableError {
            name: name.to_owned(),
            line: line + 1,
            fault,
        }
    };
    let n_notes = text
        .lines()
        .take_while(|line| line.starts_with('#'))
        .count();
    let below = text.splitn(n_notes + 1, '\n').last().unwrap_or_default();
    let mut rows = (n_notes..).zip(records(below));
    let (line, header) = rows.next().ok_or_else(|| at(0)(unknown_columns()))?;
    let columns: Vec<&str> = header.iter().collect();
    let n_keys = columns.len().saturating_sub(COLUMNS.len());
    if columns[n_keys..] != COLUMNS || n_keys == 0 {
        return Err(at(line)(unknown_columns()));
    }
    let heading = heading(name, text, &columns[..n_keys]).map_err(at(line))?;
    let entries = rows
        .map(|(line, cells)| entry(&cells, n_keys).map_err(at(line)))
        .collect::<Result<Vec<_>, _>>()?;
    if entries.is_empty() {
        return Err(at(line)("the table has no entries".to_owned()));
    }
    Ok(KnownTable { heading, entries })
}

fn heading(name: &str, text: &str, keys: &[&str]) -> Result<Heading, String> {
    let notes = || text.lines().map_while(|line| line.strip_prefix('#'));
    let heading_value = |key: &str| {
        notes()
            .filter_map(|note| note.split_once(':'))
            .find(|(word, _)| word.trim() == key)
            .map(|(_, heading_value)| heading_value.trim().to_owned())
            .ok_or_else(|| format!("no line `# {key}: ...` stands above the columns"))
    };
    Ok(Heading {
        name: name.to_owned(),
        title: heading_value("title")?,
        source: heading_value("source")?,
        quantity: heading_value("quantity")?,
        known: heading_value("known")?,
        tolerance: heading_value("tolerance")?,
        keys: keys.iter().copied().map(str::to_owned).collect(),
    })
}

fn entry(cells: &StringRecord, n_keys: usize) -> Result<Entry, String> {
    let expected = n_keys + COLUMNS.len();
    let labels = cells.iter().take(n_keys).map(str::to_owned);
    let rest: Vec<&str> = cells.iter().skip(n_keys).collect();
    let [known, allowed, subset, standing, instead, reason] = rest[..] else {
        return Err(format!("{} cells, expected {expected}", cells.len()));
    };
    Ok(Entry {
        labels: labels.collect(),
        known: number("known", known)?,
        allowed: read_allowed(allowed)?,
        is_fast: match subset {
            "fast" => true,
            "full" => false,
            _ => return Err(fault("subset", subset, "fast or full")),
        },
        standing: read_standing(standing, instead, reason)?,
    })
}

fn read_allowed(text: &str) -> Result<Tolerance, String> {
    let expected =
        "digits, a share such as 3 %, an amount, two differences such as -0.02 to 0.005, or any";
    let difference = |text: &str| text.trim().parse().ok().filter(|it: &f64| it.is_finite());
    if let Some((least, most)) = text.split_once(" to ") {
        let both = difference(least).zip(difference(most));
        let both = both.filter(|(least, most)| least < most);
        return both
            .map(|(least, most)| Tolerance::Between(least, most))
            .ok_or_else(|| fault("allowed", text, expected));
    }
    let positive = |text: &str| text.trim().parse().ok().filter(|value: &f64| *value > 0.0);
    let read = match (text, text.strip_suffix('%')) {
        ("digits", _) => Some(Tolerance::Digits),
        ("any", _) => Some(Tolerance::Any),
        (_, Some(share)) => positive(share).map(|percent| Tolerance::Relative(0.01 * percent)),
        (amount, None) => positive(amount).map(Tolerance::Absolute),
    };
    read.ok_or_else(|| fault("allowed", text, expected))
}

fn read_standing(standing: &str, instead: &str, reason: &str) -> Result<Reliability, String> {
    if standing.is_empty() {
        let unused = [("instead", instead), ("reason", reason)];
        return match unused.iter().find(|(_, text)| !text.is_empty()) {
            Some((column, text)) => Err(fault(column, text, "nothing, without a standing")),
            None => Ok(Reliability::Sound),
        };
    }
    if reason.is_empty() {
        return Err(fault("reason", reason, "what shows the standing"));
    }
    let reason = reason.to_owned();
    match standing {
        "truncated" => Ok(Reliability::Truncated { reason }),
        "misprint" => Ok(Reliability::Misprint {
            instead: number("instead", instead)?,
            reason,
        }),
        "open" => Ok(Reliability::Open {
            instead: number("instead", instead)?,
            reason,
        }),
        "missed" => Ok(Reliability::Missed {
            instead: number("instead", instead)?,
            reason,
        }),
        _ => Err(fault(
            "standing",
            standing,
            "nothing, truncated, misprint, open or missed",
        )),
    }
}

fn number(column: &str, text: &str) -> Result<PrintedNumber, String> {
    PrintedNumber::parse(text).ok_or_else(|| fault(column, text, "a number"))
}

fn fault(column: &str, found: &str, expected: &str) -> String {
    format!("`{found}` in column `{column}`, expected {expected}")
}

fn unknown_columns() -> String {
    format!("the columns should be labels, then {}", COLUMNS.join(","))
}

#[cfg(test)]
mod tests {
    use super::super::entry::Verdict;
    use super::super::table::{Extent, LabelError, Labels};
    use super::*;

    const HEAD: &str = "\
# title: First mode
# source: Author 2019, Table 4
# quantity: f, Hz
# known: printed
# tolerance: because
nu,law,known,allowed,subset,standing,instead,reason
";

    fn parse(rows: &str) -> Result<KnownTable, TableError> {
        known_values("t4", &format!("{HEAD}{rows}\n"))
    }

    #[test]
    fn a_table_has_heading_labels_values_and_standings() {
        let sound = "1/3,pds,982.2,digits,fast,,,";
        let misprint = "0.1,pds,2025.5,3 %,full,misprint,2053,\"not \"\"f\"\", g\"";
        let known = parse(&format!("{sound}\n{misprint}")).unwrap();
        assert_eq!(known.heading.source, "Author 2019, Table 4");
        assert_eq!(known.heading.keys, ["nu", "law"]);
        assert_eq!(known.entries[1].allowed, Tolerance::Relative(0.03));
        assert_eq!(known.entries[1].standing.reason(), Some("not \"f\", g"));
        let compute = |labels: Labels<'_>| Ok(1000.0 * labels.number("nu")?);
        let table = known.judge(Extent::Full, compute).unwrap();
        assert_eq!(table.rows[0].computed, 1000.0 / 3.0);
        assert_eq!(table.rows[1].verdict, Verdict::Failed);
        assert_eq!(
            table.known("nu", "law=pds"),
            Ok(vec![[1.0 / 3.0, 982.2], [0.1, 2025.5]])
        );
        assert_eq!(table.computed("nu", "law=bbpd"), Ok(vec![]));
        assert_eq!(known.judge(Extent::Fast, compute).unwrap().rows.len(), 1);
    }

    #[test]
    fn an_experiment_that_asks_for_the_wrong_label_is_told() {
        let known = parse("0,pds,1,digits,fast,,,").unwrap();
        let error = known
            .judge(Extent::Full, |labels| Ok(labels.number("law")?))
            .unwrap_err();
        let shown = format!("{error:#}");
        assert_eq!(
            shown,
            "t4, nu 0, law pds: `pds` of key `law` is neither a number nor a fraction such as 1/3"
        );
        let error = known
            .judge(Extent::Full, |labels| Ok(labels.number("mu")?))
            .unwrap_err();
        assert!(matches!(error.downcast_ref(), Some(LabelError::NoKey { key, .. }) if key == "mu"));
    }

    #[test]
    fn faults_are_told_with_their_line() {
        for (row, message) in [
            ("0,pds,1,digits,fast", "line 7: 5 cells, expected 8"),
            (
                "0,pds,one,digits,fast,,,",
                "line 7: `one` in column `known`, expected a number",
            ),
            ("0,pds,1,-2 %,fast,,,", "line 7: `-2 %` in column `allowed`"),
            (
                "0,pds,1,0.1 to -0.1,fast,,,",
                "line 7: `0.1 to -0.1` in column `allowed`",
            ),
            (
                "0,pds,1,digits,slow,,,",
                "line 7: `slow` in column `subset`, expected fast or full",
            ),
            (
                "0,pds,1,digits,fast,misprint,,x",
                "line 7: `` in column `instead`, expected a number",
            ),
            (
                "0,pds,1,digits,fast,misprint,2,",
                "line 7: `` in column `reason`",
            ),
            (
                "0,pds,1,digits,fast,wrong,2,x",
                "line 7: `wrong` in column `standing`",
            ),
            (
                "0,pds,1,digits,fast,,2,",
                "line 7: `2` in column `instead`, expected nothing",
            ),
        ] {
            let error = parse(row).unwrap_err().to_string();
            assert!(
                error.starts_with(&format!("published table t4, {message}")),
                "{error}"
            );
        }
        let error = known_values("t4", HEAD).unwrap_err().to_string();
        assert_eq!(
            error,
            "published table t4, line 6: the table has no entries"
        );
        let text = HEAD.replace("# known: printed\n", "");
        let error = known_values("t4", &text).unwrap_err();
        let fault = "no line `# known: ...` stands above the columns";
        assert_eq!(error.fault, fault);
        let text = HEAD.replace("nu,law,known", "nu,law,value");
        assert_eq!(
            known_values("t4", &text).unwrap_err().fault,
            unknown_columns()
        );
        assert_eq!(known_values("t4", "").unwrap_err().fault, unknown_columns());
    }
}
