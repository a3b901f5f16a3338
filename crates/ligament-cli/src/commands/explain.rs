//! `ligament explain`.

use std::path::PathBuf;

use clap::Args;
use ligament_output::is_standard_output;

use super::argument_parsers::{numbers, output_file};
use crate::explain::{Position, Request, Subject, explain};
use crate::terminal;

pub(super) const EXAMPLES: &str = "\
Examples:
  ligament explain results/disk --point 812         all bonds of node 812
  ligament explain results/disk --at 0.01,-0.02     the point nearest to x, y (m), in a solid x, y, z
  ligament explain results/disk --bond 812 815      the bond between two nodes
  ligament explain results/disk --bond 812 815 --csv bond.csv

Nodes have the tags of the mesh file, and cells of a lattice count from 1 row by row, as in the result
files. The history of a bond has the steps with fields (output.fields_every); its largest utilisation
and its breakage are those of all steps.";

/// `ligament explain`.
#[derive(Debug, Args)]
pub struct ExplainArgs {
    /// The folder with the results of a run
    #[arg(value_name = "RESULTS")]
    pub results: PathBuf,
    /// What to explain.
    #[command(flatten)]
    pub subject: SubjectArgs,
    /// Write a table with a row per bond and step
    #[arg(long, value_name = "FILE", value_parser = output_file())]
    pub csv: Option<PathBuf>,
    /// Write limits, breakages and paths as JSON
    #[arg(long, value_name = "FILE", value_parser = output_file())]
    pub json: Option<PathBuf>,
    /// Replace the files of --csv and --json if there are some
    #[arg(long)]
    pub force: bool,
}

/// What `explain` explains: one of these.
#[derive(Debug, Args)]
#[group(required = true, multiple = false)]
pub struct SubjectArgs {
    /// All bonds of the point with this tag
    #[arg(long, value_name = "TAG")]
    pub point: Option<i64>,
    /// The bond between the points with these tags
    #[arg(long, value_names = ["A", "B"], num_args = 2)]
    pub bond: Option<Vec<i64>>,
    /// All bonds of the point nearest to this position, in the coordinates of the mesh, m
    #[arg(long, value_name = "X,Y[,Z]", value_parser = position, allow_hyphen_values = true)]
    pub at: Option<Position>,
}

impl ExplainArgs {
    /// Executes the command.
    pub(super) fn execute(self) -> anyhow::Result<()> {
        let subject = match (
            self.subject.point,
            self.subject.bond.as_deref(),
            self.subject.at,
        ) {
            (Some(tag), ..) => Subject::Point(tag),
            (_, Some(&[a, b]), _) => Subject::Bond([a, b]),
            (_, _, Some(position)) => Subject::At(position),
            _ => unreachable!("one of them is required, and a bond has two ends"),
        };
        let request = Request {
            folder: self.results,
            subject,
            csv: self.csv,
            json: self.json,
            force: self.force,
        };
        let is_spoilt = |it: &&PathBuf| is_standard_output(it);
        match request.csv.iter().chain(&request.json).find(is_spoilt) {
            Some(file) => explain(&request, &mut terminal::for_messages(file)),
            None => explain(&request, &mut terminal::stdout()),
        }
    }
}

/// A position in the plane or in space, m.
fn position(text: &str) -> Result<Position, String> {
    let in_plane = numbers(text).map(Position::InPlane);
    let position = in_plane.or_else(|| numbers(text).map(Position::InSpace));
    position.ok_or_else(|| "expected X,Y in m, such as 0.01,-0.02, or X,Y,Z of a solid".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_have_two_or_three_coordinates() {
        assert_eq!(position("-0.01,2"), Ok(Position::InPlane([-0.01, 2.0])));
        assert_eq!(position("1,2,3"), Ok(Position::InSpace([1.0, 2.0, 3.0])));
        assert!(position("1").is_err() && position("1,2,3,4").is_err());
    }
}
