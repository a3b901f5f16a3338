//! `ligament profile`.

use std::io::Write;
use std::path::PathBuf;

use clap::Args;
use ligament_output::csv::{Value, line};
use ligament_output::results::cracks::stored_openings;
use ligament_output::results::outputs::Outputs;
use ligament_output::results::steps::StepChoice;
use ligament_output::{check_file, write_file};
use ligament_plot::picture::profile::{ProfileRequest, profile};

use super::argument_parsers::{output_file, position};
use crate::terminal;

pub(super) const EXAMPLES: &str = "\
Examples:
  ligament profile results/plate --from 0,-0.1 --to 0,0.1 --field displacement.y
  ligament profile results/plate --from 0.0152,0 --to -0.0152,0 --opening    how far a pre-crack opens, from its tip
  ligament profile results/disk --from 0,-0.05 --to 0,0.05 --field damage stress_virial.xx --step peak --out axis.csv

The line lies in the body without load, in the coordinates of the case. Between the nodes of a mesh values are linear in
each triangle; a cell of a lattice has one value. Places outside of the body have empty fields. Fields are those of `ligament plot`.";

/// `ligament profile`.
#[derive(Debug, Args)]
pub struct ProfileArgs {
    /// The folder with the results of a run
    #[arg(value_name = "RESULT")]
    pub results: PathBuf,
    /// Where the line begins, m
    #[arg(long, value_name = "X,Y", value_parser = position, allow_hyphen_values = true)]
    pub from: [f64; 2],
    /// Where the line ends, m
    #[arg(long, value_name = "X,Y", value_parser = position, allow_hyphen_values = true)]
    pub to: [f64; 2],
    /// Fields, one column each: those of `ligament plot`
    #[arg(long, value_name = "NAME", num_args = 1.., required_unless_present = "opening")]
    pub field: Vec<String>,
    /// In place of fields the opening and sliding of a straight crack along the line, from the points within a horizon on both sides
    #[arg(long, conflicts_with = "field")]
    pub opening: bool,
    /// Step: a number, 45:120 (step 45 after 120 breakages), first (breakage), peak, last or all
    #[arg(long, value_name = "STEP", default_value = "last")]
    pub step: StepChoice,
    /// Number of equally spaced points on the line
    #[arg(long, value_name = "COUNT", default_value = "101", value_parser = clap::value_parser!(u32).range(2..=1_000_000))]
    pub samples: u32,
    /// The table [default: standard output]
    #[arg(short, long, alias = "output", value_parser = output_file(), value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Replace the table if there is one
    #[arg(long)]
    pub force: bool,
}

impl ProfileArgs {
    /// The table of the openings along the line.
    fn openings(&self) -> anyhow::Result<String> {
        let outputs = Outputs::list(&self.results)?;
        let names = ["step", "along", "x", "y", "opening", "sliding"];
        let mut text = line(&names.map(Value::from));
        for step in self.step.steps(&self.results, &outputs.states())? {
            let ends = [self.from, self.to];
            let samples = self.samples as usize;
            let name = step.state.to_string();
            for it in stored_openings(&self.results, step.state, ends, samples)? {
                let [x, y] = it.place;
                let place = [Value::Text(&name), it.along.into(), x.into(), y.into()];
                let jump = it
                    .jump
                    .map_or([Value::Missing, Value::Missing], |it| it.map(Value::from));
                text += &line(&place.into_iter().chain(jump).collect::<Vec<_>>());
            }
        }
        Ok(text)
    }

    /// Executes the command.
    pub(super) fn execute(self) -> anyhow::Result<()> {
        anyhow::ensure!(
            self.from != self.to,
            "the line has no length: give --from and --to different places"
        );
        if let Some(path) = &self.out {
            check_file(path, self.force)?;
        }
        let table = match self.opening {
            true => self.openings()?,
            false => profile(&ProfileRequest {
                folder: self.results,
                fields: self.field,
                step: self.step,
                ends: [self.from, self.to],
                samples: self.samples as usize,
            })?,
        };
        match self.out {
            None => Ok(write!(terminal::stdout(), "{table}")?),
            Some(path) => {
                write_file(&path, table.as_bytes(), self.force)?;
                Ok(writeln!(
                    terminal::for_messages(&path),
                    "{}",
                    path.display()
                )?)
            }
        }
    }
}
