//! The report on the console.

use std::io::{self, Write};

use super::Printable;
use crate::experiment::{Experiment, Findings};

/// Lists all experiments on the console.
pub fn list(console: &mut dyn Write, experiments: &[Experiment]) -> io::Result<()> {
    for Experiment {
        name,
        title,
        source,
        ..
    } in experiments
    {
        writeln!(console, "{name:<14}{title} ({source})")?;
    }
    Ok(())
}

/// Says on the console what is run next.
pub(crate) fn announce(console: &mut dyn Write, experiment: &Experiment) -> io::Result<()> {
    writeln!(console, "{}: {}", experiment.name, experiment.title)?;
    console.flush()
}

/// Shows the tables of an experiment on the console.
pub(crate) fn tell(console: &mut dyn Write, findings: &Findings) -> io::Result<()> {
    for table in &findings.tables {
        let Printable { head, rows, notes } = Printable::from_table(table);
        writeln!(
            console,
            "\n  {}, {}",
            table.heading.title, table.heading.quantity
        )?;
        let width = |column: usize| {
            let cells = rows
                .iter()
                .chain([&head])
                .map(|row| row[column].chars().count());
            cells.max().unwrap_or(0)
        };
        for row in [&head].into_iter().chain(&rows) {
            let cells = row.iter().enumerate();
            let padded: Vec<String> = cells
                .map(|(k, cell)| format!("{cell:<0$}", width(k)))
                .collect();
            writeln!(console, "    {}", padded.join("  ").trim_end())?;
        }
        for (number, note) in notes.iter().enumerate() {
            writeln!(console, "    [{}] {note}", number + 1)?;
        }
    }
    writeln!(console)
}
