//! The command line.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};
use clap_complete::Shell;

use crate::case::MOST_THREADS;
use crate::yielding::criteria::Combination;

/// Peridynamics for the plane: mesh in, cracks out.
///
/// A case file (TOML) names a Gmsh mesh, materials, supports and loads; `ligament run` computes
/// displacements, reactions and the breaking of bonds and writes them for ParaView.
#[derive(Debug, Parser)]
#[command(name = "ligament", version, after_help = OVERVIEW, arg_required_else_help = true)]
pub struct Cli {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

const OVERVIEW: &str = "\
Examples:
  ligament mesh disk.geo                    mesh a Gmsh geometry: writes disk.msh
  ligament inspect disk.msh                 its groups, for the case file to name
  ligament check cases/disk/case.toml       is the case consistent with its mesh?
  ligament run cases/disk/case.toml         results in results/disk
  ligament explain results/disk --point 12  why its bonds broke, or did not

All values are in SI units: m, N, Pa, s, rad.
Exit codes: 0 done, 1 error in the input or the run, 2 wrong usage.";

/// The commands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Run a case: solve it, break bonds, write fields and history
    #[command(after_help = RUN_EXAMPLES)]
    Run(RunArgs),
    /// Check a case and its mesh without running it
    ///
    /// Reads the case and its mesh, builds points and bonds, and reports what a run would use:
    /// groups found, points held and loaded, bonds cut by pre-cracks, entries of the matrix, time and
    /// memory.
    #[command(after_help = CHECK_EXAMPLES)]
    Check(CheckArgs),
    /// Tell why a bond broke or did not, from the results of a run
    ///
    /// Prints the life of a bond, or of all bonds of a point: horizon, factors, limits, how near it came
    /// to them along the path, and when, in which order and by which criterion bonds broke. Reads the
    /// folder of the results alone.
    #[command(after_help = EXPLAIN_EXAMPLES)]
    Explain(ExplainArgs),
    /// Show what is in a mesh: cells, size, edge lengths, groups
    #[command(after_help = INSPECT_EXAMPLES)]
    Inspect(InspectArgs),
    /// Mesh a Gmsh geometry (needs the program gmsh)
    ///
    /// Calls gmsh to make a planar mesh, reads it back and shows what is in it. An existing mesh is
    /// replaced only by one that could be read.
    #[command(after_help = MESH_EXAMPLES)]
    Mesh(MeshArgs),
    /// When bonds yield first, and how the directions of the bonds distort that
    ///
    /// Turns a uniform strain through all orientations to a family of bonds and finds the load at which
    /// the first bond meets a failure criterion: for square lattices with horizons of m spacings, for a
    /// point of a case, or as a field over all points of a case. Writes tables (CSV), polar diagrams
    /// of the error and loci (SVG), or fields (VTU).
    #[command(after_help = YIELD_EXAMPLES)]
    Yield(YieldArgs),
    /// Run the published cases and compare with their printed values
    ///
    /// Runs cases of the papers that the models are from, and prints for every known value what this
    /// program computes, the difference, and whether that is as it should be; known misprints with
    /// their reasons. Writes the same as Markdown, CSV and plots (SVG).
    #[command(after_help = VERIFY_EXAMPLES)]
    Verify(VerifyArgs),
    /// Print a completion script for a shell
    #[command(after_help = COMPLETIONS_EXAMPLES)]
    Completions(CompletionsArgs),
}

const RUN_EXAMPLES: &str = "\
Examples:
  ligament run cases/disk/case.toml
  ligament run case.toml --out results/fine --set model.horizon_factor=4
  ligament run case.toml --set mesh.plane=strain --set load.0.displacement.y=-1e-4
  ligament run case.toml --set fracture.steps=10 --set fracture.stop.bonds=300

A --set takes any key of the case file; the entries of a list such as [[load]] count from 0.
The value is TOML; a bare word is a string. Values are in SI units: m, N, Pa, s, rad.
Paths, also in --set mesh.file=..., are relative to the folder of the case file.";

const CHECK_EXAMPLES: &str = "\
Examples:
  ligament check cases/disk/case.toml
  ligament check case.toml --set model.horizon_factor=4
  ligament check case.toml --model-only    points and bonds alone, no matrix: for large meshes
  ligament check case.toml --out check     writes check/points.vtu to look at in ParaView";

const EXPLAIN_EXAMPLES: &str = "\
Examples:
  ligament explain results/disk --point 812         all bonds of node 812
  ligament explain results/disk --at 0.01,-0.02     of the point nearest to x, y (m)
  ligament explain results/disk --bond 812 815      the bond between two nodes
  ligament explain results/disk --bond 812 815 --csv bond.csv

Nodes have the tags of the mesh file, cells of a lattice count from 1 row by row: both as in the
result files. Bonds are seen in the steps that have fields (output.fields_every); the largest
utilisation and the breakages are those of all steps.";

const INSPECT_EXAMPLES: &str = "\
Examples:
  ligament inspect meshes/disk.msh

Reads Gmsh files of the formats 2.2 and 4.1, ASCII or binary. Lengths are taken to be in m.";

const MESH_EXAMPLES: &str = "\
Examples:
  ligament mesh disk.geo
  ligament mesh disk.geo --out meshes/disk-1mm.msh --set h=0.001
  ligament mesh disk.geo --gmsh ~/gmsh/bin/gmsh

A --set gives a number that the geometry declares by DefineConstant[ h = ... ].
Lengths of the geometry are in m.";

const YIELD_EXAMPLES: &str = "\
Examples:
  ligament yield                                    lattices, m = 2, 3, 3.2, 4, 5: results/yield
  ligament yield --m 3 --nu 0.25 --criterion frictional --calibration two-point
  ligament yield --criterion sliding+stretch --ratio 1
  ligament yield --case case.toml --at 0.01,0.02    the family of a point, with the criteria of the case
  ligament yield --case case.toml --point 120 --criterion stretch
  ligament yield --case case.toml                   all points: how anisotropic is the mesh?

Criteria: stretch (tension and compression), tension, compression, sliding, frictional; joined by
+ the first that is met. Their limits are the same for all bonds, in units of the tensile limit s0t.";

const VERIFY_EXAMPLES: &str = "\
Examples:
  ligament verify                    everything: results/verification/README.md
  ligament verify disk --fast        one experiment, and of it what the tests run
  ligament verify --list             the experiments

The exit code is 1 if a value that should agree does not.";

const COMPLETIONS_EXAMPLES: &str = "\
Examples:
  ligament completions bash > ~/.local/share/bash-completion/completions/ligament
  ligament completions zsh > ~/.zfunc/_ligament
  ligament completions fish > ~/.config/fish/completions/ligament.fish";

/// `ligament run`.
#[derive(Debug, Args)]
pub struct RunArgs {
    /// The case file and changes to it.
    #[command(flatten)]
    pub case: CaseArgs,
    /// Folder for the results [default: results/NAME with the name of the case's folder]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Replace results of an earlier run in the folder
    #[arg(long)]
    pub force: bool,
    /// Show no progress, only the final result and errors
    #[arg(long, short)]
    pub quiet: bool,
}

/// `ligament check`.
#[derive(Debug, Args)]
pub struct CheckArgs {
    /// The case file and changes to it.
    #[command(flatten)]
    pub case: CaseArgs,
    /// Prepare points, bonds and their correction only, and leave the matrix out
    #[arg(long)]
    pub model_only: bool,
    /// Write horizons, volumes and energy ratios of the points to points.vtu in this folder
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}

/// What `run` and `check` have in common.
#[derive(Debug, Args)]
pub struct CaseArgs {
    /// The case file (TOML)
    #[arg(value_name = "CASE.toml")]
    pub file: PathBuf,
    /// Change a setting of the case file, e.g. model.horizon_factor=4 (may be repeated)
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub overrides: Vec<String>,
    /// Threads to compute with [default: solver.threads of the case, or one per processor]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=i64::from(MOST_THREADS)))]
    pub threads: Option<u32>,
}

/// `ligament explain`.
#[derive(Debug, Args)]
pub struct ExplainArgs {
    /// The folder with the results of a run
    #[arg(value_name = "RESULTS")]
    pub results: PathBuf,
    /// What to explain.
    #[command(flatten)]
    pub subject: SubjectArgs,
    /// Write a table with a row a bond and step, replacing what is there
    #[arg(long, value_name = "FILE")]
    pub csv: Option<PathBuf>,
    /// Write limits, breakages and paths as JSON, replacing what is there
    #[arg(long, value_name = "FILE")]
    pub json: Option<PathBuf>,
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
    #[arg(long, value_name = "X,Y", value_parser = position, allow_hyphen_values = true)]
    pub at: Option<[f64; 2]>,
}

/// `ligament inspect`.
#[derive(Debug, Args)]
pub struct InspectArgs {
    /// The mesh (Gmsh .msh)
    #[arg(value_name = "MESH")]
    pub mesh: PathBuf,
}

/// `ligament mesh`.
#[derive(Debug, Args)]
pub struct MeshArgs {
    /// The geometry (Gmsh .geo)
    #[arg(value_name = "FILE.geo")]
    pub geometry: PathBuf,
    /// The mesh to write [default: FILE.msh next to the geometry]
    #[arg(long, value_name = "FILE.msh")]
    pub out: Option<PathBuf>,
    /// The gmsh program, if it is not on the PATH
    #[arg(
        long,
        value_name = "PATH",
        default_value = "gmsh",
        hide_default_value = true
    )]
    pub gmsh: PathBuf,
    /// Set a number of the geometry, e.g. h=0.001 (may be repeated)
    #[arg(long = "set", value_name = "NAME=VALUE", value_parser = number_setting)]
    pub numbers: Vec<(String, f64)>,
}

/// `ligament yield`.
#[derive(Debug, Args)]
pub struct YieldArgs {
    /// Horizons of lattices in spacings
    #[arg(long, value_name = "RATIO", value_delimiter = ',', default_values_t = [2.0, 3.0, 3.2, 4.0, 5.0], conflicts_with = "case")]
    pub m: Vec<f64>,
    /// Look at the bonds of this case (TOML) instead
    #[arg(long, value_name = "CASE.toml")]
    pub case: Option<PathBuf>,
    /// Of the case, only the point nearest to this position, m
    #[arg(long, value_name = "X,Y", requires = "case", allow_hyphen_values = true, value_parser = position)]
    pub at: Option<[f64; 2]>,
    /// Of the case, only the node (or cell of a lattice) of this number
    #[arg(long, value_name = "NUMBER", requires = "case", conflicts_with = "at")]
    pub point: Option<u64>,
    /// Change a setting of the case, e.g. model.horizon_factor=4 (may be repeated)
    #[arg(long = "set", value_name = "KEY=VALUE", requires = "case")]
    pub overrides: Vec<String>,
    /// A criterion with the same limits for all bonds, e.g. sliding+stretch (may be repeated) [default:
    /// those of the figures of the paper, or those of the case]
    #[arg(long = "criterion", value_name = "NAME")]
    pub criteria: Vec<Combination>,
    /// Poisson's ratio in the plane [default: 0, or that of the case]
    #[arg(long, value_name = "NU", allow_negative_numbers = true)]
    pub nu: Option<f64>,
    /// Compressive over tensile strength, for criteria with the same limits for all bonds
    #[arg(
        long,
        value_name = "RATIO",
        default_value_t = 3.0,
        allow_negative_numbers = true
    )]
    pub ratio: f64,
    /// How the friction of `frictional` comes from the strengths
    #[arg(long, value_enum, default_value_t = YieldCalibration::Printed)]
    pub calibration: YieldCalibration,
    /// Threads to compute with [default: solver.threads of the case, or one per processor]
    #[arg(long, value_name = "N", requires = "case", value_parser = clap::value_parser!(u32).range(1..=i64::from(MOST_THREADS)))]
    pub threads: Option<u32>,
    /// Folder for the results [default: results/yield, or results/NAME-yield with the name of the case's folder]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Replace earlier results in the folder
    #[arg(long)]
    pub force: bool,
}

/// How the friction of bonds comes from two strengths.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum YieldCalibration {
    /// As printed: exact for a bar at nu = 0 alone
    Printed,
    /// Exact for a bar in tension and compression
    TwoPoint,
}

/// `ligament verify`.
#[derive(Debug, Args)]
pub struct VerifyArgs {
    /// Experiments to run [default: all]
    #[arg(value_name = "NAME")]
    pub names: Vec<String>,
    /// List the experiments with their sources, and run none
    #[arg(long)]
    pub list: bool,
    /// Run the subset that the tests run
    #[arg(long)]
    pub fast: bool,
    /// Folder for the report
    #[arg(long, value_name = "DIR", default_value = "results/verification")]
    pub out: PathBuf,
    /// Replace an earlier report in the folder
    #[arg(long)]
    pub force: bool,
}

/// `ligament completions`.
#[derive(Debug, Args)]
pub struct CompletionsArgs {
    /// The shell
    #[arg(value_name = "SHELL")]
    pub shell: Shell,
}

fn number_setting(text: &str) -> Result<(String, f64), String> {
    let (name, value) = text
        .split_once('=')
        .ok_or("expected NAME=VALUE, such as h=0.001")?;
    let number = value
        .trim()
        .parse::<f64>()
        .ok()
        .filter(|number| number.is_finite());
    let number = number.ok_or_else(|| format!("`{value}` is not a number"))?;
    match name.trim() {
        "" => Err("there is no name before `=`".to_owned()),
        name => Ok((name.to_owned(), number)),
    }
}

fn position(text: &str) -> Result<[f64; 2], String> {
    let number = |text: &str| text.trim().parse::<f64>().ok().filter(|it| it.is_finite());
    let numbers = text
        .split_once(',')
        .and_then(|(x, y)| Some([number(x)?, number(y)?]));
    numbers.ok_or_else(|| "expected X,Y in m, such as 0.01,-0.02".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_definition_is_consistent() {
        Cli::command().debug_assert();
    }

    #[test]
    fn positions_are_two_numbers() {
        assert_eq!(position("-0.01, 2e-3"), Ok([-0.01, 2e-3]));
        for wrong in ["0.01", "0.01,", "1,2,3", "1,nan"] {
            assert!(
                position(wrong).is_err_and(|error| error.contains("X,Y")),
                "{wrong}"
            );
        }
    }

    #[test]
    fn numbers_for_the_geometry_are_numbers() {
        assert_eq!(number_setting("h=1e-3"), Ok(("h".to_owned(), 1e-3)));
        assert!(number_setting("h").is_err_and(|error| error.contains("NAME=VALUE")));
        assert_eq!(position("1e-2, -0.5"), Ok([0.01, -0.5]));
        assert!(position("0.1").is_err() && position("0.1,nan").is_err());
        assert!(number_setting("h=2mm").is_err_and(|error| error.contains("`2mm`")));
    }
}
