//! The command line: a file for each command, with its options, its help and its execution.

pub mod argument_parsers;
mod calibrate;
mod case_args;
mod check;
mod cite;
mod completions;
mod converge;
mod crack;
mod ensemble;
mod explain;
mod inspect;
mod mesh;
mod new;
mod plot;
mod profile;
mod repeat;
mod report;
mod resume;
mod run;
mod schema;
mod stiffness;
mod sweep;
mod yielding;

use std::ffi::OsString;
use std::process::ExitCode;

use crate::build::VERSION;
use clap::{CommandFactory, Parser, Subcommand};

pub use calibrate::{CalibrateArgs, LineArgs, RunsArgs};
pub use case_args::CaseArgs;
pub use check::CheckArgs;
pub use cite::CiteArgs;
pub use completions::CompletionsArgs;
pub use converge::ConvergeArgs;
pub use crack::CrackArgs;
pub use ensemble::EnsembleArgs;
pub use explain::{ExplainArgs, SubjectArgs};
pub use inspect::InspectArgs;
pub use mesh::MeshArgs;
pub use new::NewArgs;
pub use plot::PlotArgs;
pub use profile::ProfileArgs;
pub use repeat::RepeatArgs;
pub use report::ReportArgs;
pub use resume::ResumeArgs;
pub use run::RunArgs;
pub use schema::SchemaArgs;
pub use stiffness::StiffnessArgs;
pub use sweep::{StudyRunsArgs, SweepArgs};
pub use yielding::YieldArgs;

/// Peridynamics of bodies in the plane and in space: mesh in, cracks out.
///
/// A case file (TOML) names a Gmsh mesh, materials, supports and loads; `ligament run` computes
/// displacements, reactions and the breaking of bonds and writes them for ParaView.
#[derive(Debug, Parser)]
#[command(name = "ligament", version, long_version = VERSION, after_help = OVERVIEW, arg_required_else_help = true)]
pub struct Cli {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

const OVERVIEW: &str = "\
Examples:
  ligament mesh disk.geo                    mesh a Gmsh geometry: writes disk.msh
  ligament mesh --via-meshio disk.inp       convert a mesh of another program: writes disk.msh
  ligament inspect disk.msh                 its groups, for the case file to name
  ligament new disk.msh                     a case to start from: writes case.toml
  ligament check cases/disk/case.toml       is the case consistent with its mesh?
  ligament run cases/disk/case.toml         results in results/disk
  ligament resume results/disk              continue a run that was stopped
  ligament repeat results/disk              run it again and compare all bits
  ligament sweep study.toml                 a case over horizons, meshes, strengths
  ligament converge case.toml               between which values is the peak? an interval
  ligament ensemble case.toml               a thousand samples of a random strength
  ligament plot results/disk                a picture of its damage
  ligament report results/disk              a page for a browser: fields, curves, bonds
  ligament crack results/disk               its cracks: path, tips, length, energy release rate
  ligament explain results/disk --point 12  why its bonds broke, or did not

All values are in SI units: m, N, Pa, s, rad.
Exit codes:
  0  done
  1  error in the input or the run
  2  wrong usage
  3  no equilibrium under load
  4  stopped by a signal (`ligament resume` continues)
  5  `ligament repeat` found other results
  6  the run ended while bonds were breaking: ignore the last state
A command overwrites a file only with --force; it always writes to a pipe or a device.";

/// The commands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Run a case: solve it, break bonds, write fields and history
    #[command(after_help = run::EXAMPLES)]
    Run(RunArgs),
    /// Continue a run that was stopped, killed or ended by a stop rule
    ///
    /// Continues from the last good checkpoint in the folder of the results. The results are the same to the
    /// last bit as if the run had never stopped. A run that ended by a stop rule continues with a new one.
    #[command(after_help = resume::EXAMPLES)]
    Resume(ResumeArgs),
    /// Repeat a run and compare: are its results the same to the last bit?
    ///
    /// Runs the case and the mesh that the folder of the results records, and compares all tables, fields and
    /// the summary bit by bit. Shows the first difference and its size, and whether another version, commit
    /// or processor may explain it.
    #[command(after_help = repeat::EXAMPLES)]
    Repeat(RepeatArgs),
    /// Run a case over all combinations of some settings: a table, plots, fitted lines
    ///
    /// A study file names a case and axes: keys of the case with their values. Runs all combinations in
    /// parallel, as cores and memory allow, each in its own process; a failed run does not affect the others.
    /// Writes a table of all runs (CSV), plots (SVG) and least-squares lines.
    #[command(after_help = sweep::EXAMPLES)]
    Sweep(SweepArgs),
    /// Between which values do the results of a case lie as its points become finer? An interval for each
    ///
    /// Runs the case at two sizes with two meshes each, and gives an interval for each result, or the reason why it has no limit.
    /// Writes the intervals as table (CSV), JSON and plots (SVG).
    #[command(after_help = converge::EXAMPLES)]
    Converge(ConvergeArgs),
    /// Run many samples of a case whose strength or fracture energy varies at random
    ///
    /// All samples share the body, its corrections and its intact factor. Writes a row for each sample (CSV), quantiles of
    /// the load over the displacement, Weibull plots (SVG), and where fracture begins on the body (VTU). Nothing that is
    /// stored grows with samples times points.
    #[command(after_help = ensemble::EXAMPLES)]
    Ensemble(EnsembleArgs),
    /// Check a case and its mesh without running it
    ///
    /// Reads the case and its mesh, builds points and bonds, and reports what a run would use:
    /// groups found, points held and loaded, bonds cut by pre-cracks, entries of the matrix, time and
    /// memory.
    #[command(after_help = check::EXAMPLES)]
    Check(CheckArgs),
    /// Find the value of a key with which a result meets a target
    ///
    /// Runs the case with different values, of the tensile strength for example, until the peak load equals that of
    /// a test: first in proportion, then between values on both sides of the target. Keeps a record of its runs.
    #[command(after_help = calibrate::EXAMPLES)]
    Calibrate(CalibrateArgs),
    /// Explain why a bond broke or did not, from the results of a run
    ///
    /// Prints the history of a bond, or of all bonds of a point: horizon, factors, limits, the utilisation
    /// along the path, and when, in which order and by which criterion bonds broke. Needs only the folder
    /// of the results.
    #[command(after_help = explain::EXAMPLES)]
    Explain(ExplainArgs),
    /// Draw fields, cracks, curves and modes from the results of runs (PNG, SVG)
    ///
    /// Draws a field on the deformed body as filled contours with a colour bar, the crack as broken
    /// bonds, force-displacement curves, or the shapes of modes, at the size and resolution of a
    /// publication. Needs only the folders of the results, also of a run that was cut short.
    #[command(after_help = plot::EXAMPLES)]
    Plot(PlotArgs),
    /// Write a report of runs as one page for a browser, to look at, send and print (HTML)
    ///
    /// Writes a single file that needs no network: summary, warnings, curves linked to the steps, and the
    /// deformed body with any field and its cracks, whose points and bonds tell their values.
    #[command(after_help = report::EXAMPLES)]
    Report(ReportArgs),
    /// Measure the cracks of a run, lines in the plane and surfaces in solids: path, tips, length, area, energy release rate
    ///
    /// Finds the cracks in stored results. Writes them as tables and for ParaView, and the growth of their
    /// tips, length and area over the load, with the energy release rate.
    #[command(after_help = crack::EXAMPLES)]
    Crack(CrackArgs),
    /// Sample fields of a run along a straight line, as a table
    ///
    /// Samples the fields of a stored step at equally spaced points of a line and writes them as CSV.
    #[command(after_help = profile::EXAMPLES)]
    Profile(ProfileArgs),
    /// Show what is in a mesh: cells, size, edge lengths, groups
    #[command(after_help = inspect::EXAMPLES)]
    Inspect(InspectArgs),
    /// Mesh a Gmsh geometry (needs the program gmsh), or convert a mesh of another program
    ///
    /// Calls gmsh to mesh the surfaces or volumes of the geometry, reads the mesh back and shows its contents. --via-meshio
    /// converts a mesh of Abaqus, Nastran, Exodus, MED, VTK and others with the Python package meshio, and keeps
    /// its groups. An existing mesh is replaced only with --force, and only by a mesh that can be read.
    #[command(after_help = mesh::EXAMPLES)]
    Mesh(MeshArgs),
    /// Write a commented case to start from, for a mesh or a lattice
    ///
    /// Chooses supports and loads by the names of the groups, or by their positions, and writes a case that
    /// runs as it is: material and loading are marked as examples, other settings are there as comments.
    #[command(after_help = new::EXAMPLES)]
    New(NewArgs),
    /// Tabulate the stiffness of bonds over their direction
    ///
    /// Computes k_n, k_t and k_theta of the law of a case for every material and direction. Writes a table (CSV)
    /// with the off-axis moduli of the continuum, and polar diagrams (SVG); prints the values along x and y and
    /// the extremes.
    #[command(after_help = stiffness::EXAMPLES)]
    Stiffness(StiffnessArgs),
    /// Compute the first yield of bonds, and its error from their few directions
    ///
    /// Applies a uniform strain in all orientations to a family of bonds and finds the load at which the first
    /// bond meets a failure criterion: for square lattices with horizons of m spacings, for a point of a
    /// case, or as a field over all points of a case. Writes tables (CSV), polar diagrams of the error and
    /// loci (SVG), or fields (VTU).
    #[command(after_help = yielding::EXAMPLES)]
    Yield(YieldArgs),
    /// Print the JSON schema of a case file, for editors
    ///
    /// With the schema an editor completes keys and values, shows descriptions, units and defaults, and marks
    /// errors.
    #[command(after_help = schema::EXAMPLES)]
    Schema(SchemaArgs),
    /// Print references to cite, as BibTeX: this program, and the papers behind what a case uses
    ///
    /// The papers are those of the law, the corrections, the failure criteria, the softening, random properties and the scheme of a
    /// motion. The mesh of the case is not read.
    #[command(after_help = cite::EXAMPLES)]
    Cite(CiteArgs),
    /// Print a completion script for a shell
    #[command(after_help = completions::EXAMPLES)]
    Completions(CompletionsArgs),
}

impl Cli {
    /// Executes the command, and returns the exit code; `program` is the command that calls this program.
    ///
    /// # Errors
    ///
    /// Any error of the command, in words for the user.
    pub fn execute(self, program: &[OsString]) -> anyhow::Result<ExitCode> {
        let done = match self.command {
            Command::Run(args) => return args.execute(),
            Command::Resume(args) => return args.execute(),
            Command::Repeat(args) => return args.execute(),
            Command::Sweep(args) => args.execute(program),
            Command::Converge(args) => args.execute(program),
            Command::Ensemble(args) => return args.execute(),
            Command::Check(args) => return args.execute(),
            Command::Calibrate(args) => args.execute(),
            Command::Explain(args) => args.execute(),
            Command::Plot(args) => args.execute(),
            Command::Report(args) => args.execute(),
            Command::Crack(args) => args.execute(),
            Command::Profile(args) => args.execute(),
            Command::Inspect(args) => args.execute(),
            Command::Mesh(args) => args.execute(),
            Command::New(args) => args.execute(),
            Command::Stiffness(args) => args.execute(),
            Command::Yield(args) => args.execute(),
            Command::Schema(args) => args.execute(),
            Command::Cite(args) => args.execute(),
            Command::Completions(args) => args.execute(Self::command()),
        };
        done.map(|()| ExitCode::SUCCESS)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_definition_is_consistent() {
        Cli::command().debug_assert();
    }
}
