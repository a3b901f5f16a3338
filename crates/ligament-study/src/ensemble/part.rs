//! Stored samples: rows that grow, and counts at the points of the body that replace earlier ones.
//!
//! A part is written by one process at a time. Its rows count up to the length that stands beside the counts, so that both are of the same
//! samples however the process ended. The size of the counts is that of the body, whatever the number of samples.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use ligament::ensemble::Sample;
use ligament_analysis::driver::Problem;
use ligament_output::csv::read::Sheet;
use ligament_output::csv::{Table, Value};
use ligament_output::{Error, read_text, replace_file};
use serde::{Deserialize, Serialize};

use super::grid::Grid;
use super::row::{COLUMNS, Row};

/// Time after which samples are stored at the latest, once the next has ended.
const PAUSE: Duration = Duration::from_secs(2);

/// Numbers of samples in which something happened at the points of a body.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Counts {
    /// Samples in which a bond of the point was among the first to break, shape (n_points).
    pub(super) first_break: Vec<u64>,
    /// Samples in which a bond of the point was broken in the end, shape (n_points).
    pub(super) damaged: Vec<u64>,
}

impl Counts {
    /// Counts of no sample.
    fn none(n_points: usize) -> Self {
        Self {
            first_break: vec![0; n_points],
            damaged: vec![0; n_points],
        }
    }

    /// Adds a sample of the body of a problem.
    fn count(&mut self, sample: &Sample, problem: &Problem) {
        let first = sample.path.first.iter().flat_map(|it| it.ends);
        for point in first.collect::<BTreeSet<u32>>() {
            self.first_break[point as usize] += 1;
        }
        let mut is_damaged = vec![false; self.damaged.len()];
        let bonds = problem.system.ends().iter();
        for (ends, _) in bonds
            .zip(&sample.path.outcome.state.intact)
            .filter(|(_, intact)| !**intact)
        {
            ends.iter().for_each(|&end| is_damaged[end as usize] = true);
        }
        for (count, damaged) in self.damaged.iter_mut().zip(is_damaged) {
            *count += u64::from(damaged);
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

/// What is stored beside the rows.
#[derive(Debug, Serialize, Deserialize)]
struct Committed {
    /// Length of the rows, bytes.
    length: u64,
    #[serde(flatten)]
    counts: Counts,
}

/// A part to which samples are added.
pub(super) struct Part {
    table: Table,
    beside: PathBuf,
    counts: Counts,
    stored: Instant,
}

impl Part {
    /// Opens a part in a folder, or creates it, for samples of a body with so many points.
    pub(super) fn open(
        folder: &Path,
        name: &str,
        grid: Grid,
        n_points: usize,
    ) -> anyhow::Result<Self> {
        let [rows, beside] = ["csv", "json"].map(|ending| folder.join(format!("{name}.{ending}")));
        let columns = columns(grid);
        let names: Vec<&str> = columns.iter().map(String::as_str).collect();
        let (table, counts) = match committed(&beside)? {
            Some(it) => (Table::cut_back(rows, names.len(), it.length)?, it.counts),
            None => (Table::create(rows, &names)?, Counts::none(n_points)),
        };
        Ok(Self {
            table,
            beside,
            counts,
            stored: Instant::now(),
        })
    }

    /// Adds a sample.
    pub(super) fn add(
        &mut self,
        (sample, row): (&Sample, &Row),
        grid: Grid,
        problem: &Problem,
    ) -> anyhow::Result<()> {
        let loads = grid.loads(&sample.path.outcome).into_iter();
        let mut values = row.values();
        values.extend(loads.map(|it| it.map_or(Value::Missing, Value::Float)));
        self.table.append(&values)?;
        self.counts.count(sample, problem);
        if self.stored.elapsed() >= PAUSE {
            self.store()?;
        }
        Ok(())
    }

    /// Stores what was added.
    pub(super) fn store(&mut self) -> anyhow::Result<()> {
        let committed = Committed {
            length: self.table.synced()?.length,
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
pub(super) struct Stored {
    /// File of the rows.
    pub(super) path: PathBuf,
    pub(super) rows: Vec<Row>,
    /// Loads of each row at the displacements of the grid, shape (n_rows, n); none where they are unknown.
    pub(super) loads: Vec<Vec<Option<f64>>>,
    pub(super) counts: Counts,
}

/// The parts in a folder, in the order of their names.
pub(super) fn stored(folder: &Path, grid: Grid) -> anyhow::Result<Vec<Stored>> {
    let mut found: Vec<PathBuf> = match fs::read_dir(folder) {
        Err(_) => Vec::new(),
        Ok(entries) => entries.flatten().map(|entry| entry.path()).collect(),
    };
    found.retain(|path| path.extension().is_some_and(|it| it == "json"));
    found.sort();
    found.iter().map(|beside| of_file(beside, grid)).collect()
}

fn of_file(beside: &Path, grid: Grid) -> anyhow::Result<Stored> {
    let path = beside.with_extension("csv");
    let Committed { length, counts } = committed(beside)?.ok_or_else(|| gone(beside))?;
    let text = read_text(&path)?;
    let text = text.get(..length as usize).ok_or_else(|| gone(&path))?;
    let sheet = Sheet::parse(&path, text)?;
    let rows = sheet.rows(Row::read)?;
    let mut loads = vec![Vec::with_capacity(grid.n); rows.len()];
    for column in columns(grid).iter().skip(COLUMNS.len()) {
        let texts = sheet.texts(column).ok_or_else(|| gone(&path))?;
        for (of_row, text) in loads.iter_mut().zip(texts) {
            of_row.push(text.parse().ok());
        }
    }
    Ok(Stored {
        path,
        rows,
        loads,
        counts,
    })
}

/// What is stored beside the rows of a part; none without the file.
fn committed(beside: &Path) -> anyhow::Result<Option<Committed>> {
    if !beside.is_file() {
        return Ok(None);
    }
    let read = serde_json::from_str(&read_text(beside)?);
    read.map(Some).map_err(|error| {
        let reason = error.to_string();
        unreadable(beside, reason).into()
    })
}

fn gone(path: &Path) -> Error {
    unreadable(path, "a part of the samples is gone".to_owned())
}

fn unreadable(path: &Path, reason: String) -> Error {
    Error::Unreadable {
        path: path.to_owned(),
        reason,
    }
}

/// Columns of the rows of a part: those of a sample, and the loads at the displacements of the grid.
fn columns(grid: Grid) -> Vec<String> {
    let loads = (0..grid.n).map(|it| format!("load_{it}"));
    COLUMNS
        .iter()
        .map(|it| (*it).to_owned())
        .chain(loads)
        .collect()
}
