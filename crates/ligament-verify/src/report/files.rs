//! The tables of a report as CSV, and its plots as SVG.

use ligament_output::folder::ResultFolder;
use ligament_output::{csv, replace_file};

use crate::entry::Verdict;
use crate::experiment::{Experiment, Findings};
use crate::table::Table;
use crate::tally::Tally;

/// File that marks a folder with a report, with one row per experiment.
pub(crate) const SUMMARY: &str = "verification.csv";

/// Width of pictures of bodies, mm.
const WIDTH: f64 = 160.0;

/// Resolution of pictures of bodies, dots per inch: 700 pixels across.
const DOTS_PER_INCH: f64 = 110.0;

/// The table of experiments, which grows during the run.
pub(crate) struct Summary(csv::Table);

impl Summary {
    /// Creates the table in a folder.
    pub(crate) fn create(folder: &ResultFolder) -> Result<Self, ligament_output::Error> {
        let columns = ["experiment", "source", "entries"].into_iter();
        let columns: Vec<&str> = columns.chain(Verdict::ALL.map(Verdict::words)).collect();
        csv::Table::create(folder.file(SUMMARY), &columns).map(Self)
    }

    /// Adds an experiment.
    pub(crate) fn append(
        &mut self,
        experiment: &Experiment,
        tally: &Tally,
    ) -> Result<(), ligament_output::Error> {
        let head = [
            experiment.name.into(),
            experiment.source.into(),
            tally.entries().into(),
        ];
        let row: Vec<csv::Value<'_>> = head
            .into_iter()
            .chain(tally.counts().map(csv::Value::from))
            .collect();
        self.0.append(&row)
    }
}

/// Writes the tables of an experiment as CSV and its plots as SVG.
pub(crate) fn write(folder: &ResultFolder, findings: &Findings) -> anyhow::Result<()> {
    for table in &findings.tables {
        write_csv(folder, table)?;
    }
    for plot in &findings.plots {
        let svg = plot.for_screen()?.to_svg(&plot.title);
        folder.write(&format!("{}.svg", plot.name), svg)?;
    }
    for maps in &findings.maps {
        let png = maps.draw(WIDTH)?.to_png(DOTS_PER_INCH)?;
        replace_file(&folder.file(&format!("{}.png", maps.name)), &png)?;
    }
    Ok(())
}

fn write_csv(folder: &ResultFolder, table: &Table) -> Result<(), ligament_output::Error> {
    let path = folder.file(&format!("{}.csv", table.heading.name));
    let labels = table.heading.keys.iter().map(String::as_str);
    let values = [
        "known", "computed", "allowed", "verdict", "instead", "reason",
    ];
    let columns: Vec<&str> = labels.chain(values).collect();
    let mut file = csv::Table::create(path, &columns)?;
    for row in &table.rows {
        let entry = &row.entry;
        let (known, allowed) = (entry.known.to_string(), entry.allowed.to_string());
        let instead = entry
            .standing
            .replacement_value()
            .map(ToString::to_string)
            .unwrap_or_default();
        let mut cells: Vec<csv::Value<'_>> = entry
            .labels
            .iter()
            .map(|label| label.as_str().into())
            .collect();
        cells.extend([
            csv::Value::from(known.as_str()),
            row.computed.into(),
            allowed.as_str().into(),
            row.verdict.words().into(),
            instead.as_str().into(),
            entry.standing.reason().unwrap_or_default().into(),
        ]);
        file.append(&cells)?;
    }
    Ok(())
}
