//! Stored samples: rows that grow, and counts at the points of the body that replace earlier ones.
//!
//! A part is written by one process at a time. Its rows are valid up to the length stored with the counts, so that both describe the same
//! samples however the process ended. The size of the counts depends on the body, not on the number of samples.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use ligament::ensemble::{Ensemble, Sample};
use ligament_output::csv::read::CsvTable;
use ligament_output::csv::{Table, Value};
use ligament_output::{Error, read_json, read_text, replace_file};
use serde::{Deserialize, Serialize};

use super::grid::Grid;
use super::row::{self, COLUMNS, Row};
use crate::run_table::folder::StudyFolder;

/// Subfolder of the parts.
pub(super) const PARTS: &str = "parts";

/// Time after which the next completed sample causes all to be stored.
const PAUSE: Duration = Duration::from_secs(2);

/// Numbers of samples with first breakage and with damage at the points of a body.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Counts {
    /// Samples in which a bond of the point was among the first to break, shape (n_points).
    pub(super) first_break: Vec<u64>,
    /// Samples in which a bond of the point was broken in the end, shape (n_points).
    pub(super) damaged: Vec<u64>,
}

impl Counts {
    /// Counts without samples.
    fn none(n_points: usize) -> Self {
        Self {
            first_break: vec![0; n_points],
            damaged: vec![0; n_points],
        }
    }

    /// Adds a sample of an ensemble.
    fn count(&mut self, sample: &Sample, ensemble: &Ensemble) {
        let first = sample.path.first.iter().flat_map(|it| it.ends);
        for point in first.collect::<BTreeSet<u32>>() {
            self.first_break[point as usize] += 1;
        }
        let bonds = ensemble.problem().system.ends.iter();
        let bonds = bonds.zip(&sample.path.outcome.state.intact);
        let broken = bonds.filter(|(_, intact)| !**intact);
        for point in broken
            .flat_map(|(ends, _)| *ends)
            .collect::<BTreeSet<u32>>()
        {
            self.damaged[point as usize] += 1;
        }
    }

    /// Adds the counts of other samples.
    pub(super) fn add(&mut self, other: &Self) {
        for (all, others) in [
            (&mut self.first_break, &other.first_break),
            (&mut self.damaged, &other.damaged),
        ] {
            all.resize(all.len().max(others.len()), 0);
            for (count, other) in all.iter_mut().zip(others) {
                *count += other;
            }
        }
    }
}

/// Data that are stored beside the rows.
#[derive(Debug, Serialize, Deserialize)]
struct PartData {
    /// Length of the rows, bytes.
    length: u64,
    #[serde(flatten)]
    counts: Counts,
}

/// An open part to which samples are added.
pub(super) struct Part<'a> {
    table: Table,
    beside: PathBuf,
    counts: Counts,
    stored: Instant,
    grid: Grid,
    ensemble: &'a Ensemble,
    /// Tags of the points of the body (n_points).
    tags: Vec<i64>,
}

impl<'a> Part<'a> {
    /// Opens a part in the folder of an ensemble, or creates it.
    pub(super) fn open(
        folder: &StudyFolder,
        name: &str,
        grid: Grid,
        ensemble: &'a Ensemble,
    ) -> anyhow::Result<Self> {
        let file = |ending| folder.path().join(PARTS).join(format!("{name}.{ending}"));
        let (rows, beside) = (file("csv"), file("json"));
        let tags = ensemble.model().body().grid().tags;
        let columns = columns(grid);
        let names: Vec<&str> = columns.iter().map(String::as_str).collect();
        let (table, counts) = match beside.is_file() {
            true => {
                let PartData { length, counts } = read_json(&beside)?;
                (Table::open_truncated(rows, names.len(), length)?, counts)
            }
            false => (Table::create(rows, &names)?, Counts::none(tags.len())),
        };
        Ok(Self {
            table,
            beside,
            counts,
            stored: Instant::now(),
            grid,
            ensemble,
            tags,
        })
    }

    /// Adds a sample.
    pub(super) fn add(&mut self, sample: &Sample) -> anyhow::Result<()> {
        let body = self.ensemble.model().body();
        let mut values = row::values(sample, body, &self.tags);
        let loads = self.grid.loads(&sample.path.outcome).into_iter();
        values.extend(loads.map(|it| it.map_or(Value::Missing, Value::Float)));
        self.table.append(&values)?;
        self.counts.count(sample, self.ensemble);
        if self.stored.elapsed() >= PAUSE {
            self.store()?;
        }
        Ok(())
    }

    /// Stores the added samples.
    pub(super) fn store(&mut self) -> anyhow::Result<()> {
        let committed = PartData {
            length: self.table.sync()?.length,
            counts: self.counts.clone(),
        };
        let text = serde_json::to_string(&committed)? + "\n";
        replace_file(&self.beside, text.as_bytes())?;
        self.stored = Instant::now();
        Ok(())
    }
}

/// Stored samples of a part.
#[derive(Debug)]
pub(super) struct StoredSamples {
    /// File with the rows of the samples.
    pub(super) path: PathBuf,
    pub(super) rows: Vec<Row>,
    pub(super) counts: Counts,
}

/// The parts in the folder of an ensemble, in the order of their names.
pub(super) fn stored(folder: &StudyFolder, grid: Grid) -> anyhow::Result<Vec<StoredSamples>> {
    let entries = fs::read_dir(folder.path().join(PARTS))
        .into_iter()
        .flatten();
    let mut found: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
    found.retain(|path| path.extension().is_some_and(|it| it == "json"));
    found.sort();
    found
        .iter()
        .map(|beside| samples_of_file(beside, grid))
        .collect()
}

fn samples_of_file(beside: &Path, grid: Grid) -> anyhow::Result<StoredSamples> {
    let path = beside.with_extension("csv");
    let gone = || Error::Unreadable {
        path: path.clone(),
        reason: "a part of the samples is gone".to_owned(),
    };
    let PartData { length, counts } = read_json(beside)?;
    let text = read_text(&path)?;
    let text = text.get(..length as usize).ok_or_else(gone)?;
    let sheet = CsvTable::parse(&path, text)?;
    if sheet.columns() != columns(grid) {
        return Err(gone().into());
    }
    let rows = sheet.rows(Row::read)?;
    Ok(StoredSamples { path, rows, counts })
}

/// Columns of the rows of a part: the columns of a sample, and the loads at the displacements of the grid.
fn columns(grid: Grid) -> Vec<String> {
    let loads = (0..grid.n).map(|it| format!("load_{it}"));
    COLUMNS
        .map(str::to_owned)
        .into_iter()
        .chain(loads)
        .collect()
}
