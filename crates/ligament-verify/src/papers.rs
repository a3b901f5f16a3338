//! The five papers: their contents, and the tables of this report that compare them.

use ligament_output::csv::read::records;

use super::experiment::Findings;
use super::published::TableError;
use super::table::{LabelError, Row, Table};

/// The papers by their short names in `papers.csv`.
pub(super) const PAPERS: [(&str, &str); 5] = [
    (
        "NHPD",
        "Zhang, Yang and Zhuang, \"A micropolar peridynamics model with non-unified horizon for damage of solids with \
         different non-local effects\"",
    ),
    (
        "MPPD",
        "Diana and Casolo 2019, \"A bond-based micropolar peridynamic model with shear deformability: Elasticity, failure \
         properties and initial yield domains\"",
    ),
    (
        "OMPPD",
        "Diana and Casolo 2019, \"A full orthotropic micropolar peridynamic formulation for linearly elastic solids\"",
    ),
    (
        "MBB-PD",
        "Masoumi, Ravandi and Salehi, \"A modified bond-based peridynamics model without limitations on elastic properties\"",
    ),
    (
        "PDS",
        "Zhu and Ni 2017, \"Peridynamic formulations enriched with bond rotation effects\"",
    ),
];

/// A table, figure or statement of a paper.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Item {
    /// Short name of the paper.
    pub(super) paper: String,
    /// Place in the paper: `Table 4, PDS`.
    pub(super) place: String,
    /// Subject of the item.
    pub(super) content: String,
    /// Kind of comparison with the item.
    pub(super) comparison: Comparison,
    /// Remark: the reason why the item is not computed, or the substitute of printed values.
    pub(super) remark: String,
}

/// Comparison with an item.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Comparison {
    /// The item is no result, such as a sketch or a mesh.
    NoResult,
    /// The item is a picture without numbers, which is drawn.
    Drawn,
    /// The item is a result that is not computed.
    NotComputed,
    /// The item is compared in rows of tables.
    Rows(Vec<Selection>),
}

/// Rows of a table of this report.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Selection {
    /// Name of the table.
    pub(super) table: String,
    /// Labels of the rows, `model=PDS, of=lattice`; empty for all rows.
    pub(super) of: String,
}

const TEXT: &str = include_str!("papers.csv");

const COLUMNS: [&str; 5] = ["paper", "item", "content", "tables", "remark"];

/// All items, in the order of the page.
///
/// # Errors
///
/// If the list of items is wrong.
pub(super) fn items() -> Result<Vec<Item>, TableError> {
    let at = |line: usize, fault: &str| TableError {
        name: "papers".to_owned(),
        line: line + 1,
        fault: fault.to_owned(),
    };
    let mut rows = records(TEXT).into_iter().enumerate();
    if rows
        .next()
        .is_none_or(|(_, columns)| columns != COLUMNS[..])
    {
        return Err(at(
            0,
            &format!("the columns should be {}", COLUMNS.join(",")),
        ));
    }
    rows.map(|(line, cells)| {
        let [paper, place, content, tables, remark] = cells.iter().collect::<Vec<_>>()[..] else {
            return Err(at(line, "a row has a cell for each column"));
        };
        if PAPERS.iter().all(|(name, _)| *name != paper) {
            return Err(at(line, "there is no such paper"));
        }
        let comparison = match tables {
            "-" => Comparison::NoResult,
            "drawn" => Comparison::Drawn,
            "" if remark.is_empty() => {
                return Err(at(line, "an item that nothing compares needs the reason"));
            }
            "" => Comparison::NotComputed,
            tables => Comparison::Rows(tables.split(';').map(Selection::parse).collect()),
        };
        Ok(Item {
            paper: paper.to_owned(),
            place: place.to_owned(),
            content: content.to_owned(),
            comparison,
            remark: remark.to_owned(),
        })
    })
    .collect()
}

impl Item {
    fn selections(&self) -> &[Selection] {
        match &self.comparison {
            Comparison::Rows(selections) => selections,
            Comparison::NoResult | Comparison::Drawn | Comparison::NotComputed => &[],
        }
    }

    /// The rows that compare the item, with their tables.
    pub(super) fn rows<'a>(
        &self,
        done: impl Iterator<Item = &'a Findings> + Clone,
    ) -> Result<Vec<(&'a Table, &'a Row)>, LabelError> {
        let mut rows = Vec::new();
        for selection in self.selections() {
            let tables = done.clone().flat_map(|findings| &findings.tables);
            for table in tables.filter(|table| table.heading.name == selection.table) {
                for row in &table.rows {
                    if table.labels(row).contain_labels(&selection.of)? {
                        rows.push((table, row));
                    }
                }
            }
        }
        Ok(rows)
    }
}

impl Selection {
    /// Parses `table` or `table[key=label, ...]`.
    fn parse(text: &str) -> Self {
        let text = text.trim();
        let (table, of) = (text.strip_suffix(']'))
            .and_then(|text| text.split_once('['))
            .unwrap_or((text, ""));
        let [table, of] = [table, of].map(str::to_owned);
        Self { table, of }
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::super::published::known_values;
    use super::super::table::Labels;
    use super::*;

    fn holds(selection: &Selection, table: &str, labels: Labels<'_>) -> bool {
        selection.table == table && labels.contain_labels(&selection.of).unwrap()
    }

    /// Every known value from a paper is in one line of the page, and every line has values.
    #[test]
    fn every_value_of_a_paper_has_one_line() {
        let items = items().unwrap();
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/published");
        let mut found = vec![0; items.iter().map(|item| item.selections().len()).sum()];
        for file in std::fs::read_dir(folder).unwrap() {
            let path = file.unwrap().path();
            if path.extension().is_some_and(|it| it == "toml") {
                continue;
            }
            let name = path.file_stem().unwrap().to_str().unwrap();
            let known = known_values(name, &std::fs::read_to_string(&path).unwrap()).unwrap();
            let source = &known.heading.source;
            let authors = ["Diana and Casolo", "Zhang, Yang", "Masoumi", "Zhu and Ni"];
            let is_paper = authors.iter().any(|author| source.contains(author));
            for entry in &known.entries {
                let labels = Labels::new(&known.heading.keys, &entry.labels);
                let selections = items.iter().flat_map(Item::selections);
                let holding: Vec<usize> = (selections.enumerate())
                    .filter(|(_, selection)| holds(selection, name, labels))
                    .map(|(place, _)| place)
                    .collect();
                assert!(holding.len() <= 1, "{name}, {labels}: in several lines");
                assert!(
                    !is_paper || holding.len() == 1,
                    "{name}, {labels}: in no line of papers.csv"
                );
                holding.iter().for_each(|place| found[*place] += 1);
            }
        }
        for (selection, found) in items.iter().flat_map(Item::selections).zip(found) {
            assert!(found > 0, "{selection:?} has no values");
        }
    }

    #[test]
    fn a_selection_is_a_table_with_labels() {
        let parsed = Selection::parse(" t4[model=PDS, of=lattice]");
        assert_eq!(
            (&*parsed.table, &*parsed.of),
            ("t4", "model=PDS, of=lattice")
        );
        assert_eq!(Selection::parse("t4").of, "");
    }
}
