//! Calls of `ligament sweep`.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::time::SystemTime;

use crate::support::{SMALL_BAR, assert_success, ligament, stderr, stdout};

mod faults;
#[cfg(unix)]
mod geometry;
mod judging;
mod resuming;
mod shards;
mod tables;

/// Two strengths and three horizons.
const GRID: &str = r#"title = "Bars"
case = "bar/case.toml"
[[axis]]
key = "material.tensile_strength"
values = [1e6, 1.2e6]
[[axis]]
key = "model.horizon_factor"
range = { from = 2.2, to = 3.2, step = 0.5 }
"#;

/// A folder with the case `bar/case.toml` and a study.
struct Place {
    folder: tempfile::TempDir,
}

impl Place {
    fn with(study: &str) -> Self {
        let place = Self {
            folder: tempfile::tempdir().unwrap(),
        };
        fs::create_dir(place.path("bar")).unwrap();
        fs::write(place.path("bar/case.toml"), SMALL_BAR).unwrap();
        place.study(study);
        place
    }

    fn study(&self, text: &str) {
        fs::write(self.path("study.toml"), text).unwrap();
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_ligament"));
        command
            .current_dir(self.folder.path())
            .args(["sweep", "study.toml", "--out", "out"])
            .args(arguments);
        command
    }

    fn sweep(&self, arguments: &[&str]) -> Output {
        self.command(arguments).output().unwrap()
    }

    /// Names of the runs that have results, with the time at which their summaries were written.
    fn summaries(&self) -> BTreeMap<String, SystemTime> {
        summaries(&self.path("out"))
    }

    fn table(&self) -> Table {
        Table::read(&self.path("out/table.csv"))
    }
}

fn summaries(out: &Path) -> BTreeMap<String, SystemTime> {
    let runs = fs::read_dir(out.join("runs")).into_iter().flatten();
    let runs = runs.filter_map(|entry| {
        let entry = entry.unwrap();
        let written = fs::metadata(entry.path().join("summary.json")).ok()?;
        let name = entry.file_name().into_string().unwrap();
        Some((name, written.modified().unwrap()))
    });
    runs.collect()
}

/// A CSV table without quoted fields but those of its columns that are asked for.
struct Table {
    columns: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl Table {
    fn read(path: &Path) -> Self {
        let text = fs::read_to_string(path).unwrap();
        let mut lines = text.lines().map(fields);
        let columns = lines.next().unwrap();
        let rows: Vec<Vec<String>> = lines.collect();
        assert!(rows.iter().all(|row| row.len() == columns.len()), "{text}");
        Self { columns, rows }
    }

    fn column(&self, name: &str) -> Vec<&str> {
        let index = self.columns.iter().position(|column| column == name);
        let index = index.unwrap_or_else(|| panic!("no {name} in {:?}", self.columns));
        self.rows.iter().map(|row| row[index].as_str()).collect()
    }

    fn numbers(&self, name: &str) -> Vec<f64> {
        let cells = self.column(name);
        cells.iter().map(|cell| cell.parse().unwrap()).collect()
    }

    /// The table without values that differ between repetitions: times, memory, and its path.
    fn lasting(&self) -> Vec<Vec<&str>> {
        let lasts = |name: &&String| {
            !["seconds", "peak_bytes", "folder", "solver.threads"].contains(&name.as_str())
                && !name.ends_with("_seconds")
        };
        let columns: Vec<&String> = self.columns.iter().filter(lasts).collect();
        let mut all = vec![columns.iter().map(|name| name.as_str()).collect()];
        let columns: Vec<Vec<&str>> = columns.iter().map(|name| self.column(name)).collect();
        all.extend((0..self.rows.len()).map(|row| columns.iter().map(|of| of[row]).collect()));
        all
    }
}

/// The fields of a line, unquoted.
fn fields(line: &str) -> Vec<String> {
    let mut fields = vec![String::new()];
    let mut quoted = false;
    for letter in line.chars() {
        match letter {
            '"' => quoted = !quoted,
            ',' if !quoted => fields.push(String::new()),
            letter => fields.last_mut().unwrap().push(letter),
        }
    }
    fields
}
