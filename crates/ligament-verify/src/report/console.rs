//! The report on the console.

use std::io::{self, Write};

use ligament_output::columns::aligned;

use super::Printable;
use crate::experiment::{Experiment, Findings};

/// Lists all experiments on the console.
pub(crate) fn list(console: &mut dyn Write, experiments: &[Experiment]) -> io::Result<()> {
    let row = |it: &Experiment| [it.name, it.title, it.source].map(str::to_owned).to_vec();
    let rows: Vec<Vec<String>> = experiments.iter().map(row).collect();
    for line in aligned(&rows, usize::MAX) {
        writeln!(console, "{line}")?;
    }
    Ok(())
}

/// Prints the name of the next experiment.
pub(crate) fn announce(console: &mut dyn Write, experiment: &Experiment) -> io::Result<()> {
    writeln!(console, "{}: {}", experiment.name, experiment.title)?;
    console.flush()
}

/// Prints the tables of an experiment.
pub(crate) fn write(console: &mut dyn Write, findings: &Findings) -> io::Result<()> {
    for table in &findings.tables {
        let Printable { rows, notes } = Printable::from_table(table);
        writeln!(
            console,
            "\n  {}, {}",
            table.heading.title, table.heading.quantity
        )?;
        for line in aligned(&rows, usize::MAX) {
            writeln!(console, "    {line}")?;
        }
        for (number, note) in notes.iter().enumerate() {
            writeln!(console, "    [{}] {note}", number + 1)?;
        }
    }
    writeln!(console)
}
