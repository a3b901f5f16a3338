//! `ligament yield`.

use std::path::{Path, PathBuf};

use clap::Args;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use ligament_analysis::solver::MOST_THREADS;
use ligament_model::failure::frictional::Calibration;
use ligament_study::yielding::criteria::Combination;
use ligament_study::yielding::{BodyPoint, Families, Request, yielding};

use super::argument_parsers::{output_folder, position};
use super::case_args::CaseArgs;
use crate::terminal;

pub(super) const EXAMPLES: &str = "\
Examples:
  ligament yield                                    lattices, m = 2, 3, 3.2, 4, 5: results/yield
  ligament yield --m 3 --nu 0.25 --criterion frictional --calibration two-point
  ligament yield --criterion sliding+stretch --ratio 1
  ligament yield --case case.toml --at 0.01,0.02    the family of a point, with the criteria of the case
  ligament yield --case case.toml --point 120 --criterion stretch
  ligament yield --case case.toml                   all points: how anisotropic is the mesh?

Criteria: stretch (tension and compression), tension, compression, sliding, frictional; joined by
+ the first that is met. Their limits are the same for all bonds, in units of the tensile limit s0t.";

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
    /// Take a key out of the case, e.g. fracture.criterion (may be repeated; before any --set)
    #[arg(long = "unset", value_name = "KEY", requires = "case")]
    pub unset: Vec<String>,
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
    #[arg(long, default_value = "printed", value_parser = calibrations())]
    pub calibration: Calibration,
    /// Threads to compute with [default: solver.threads of the case, or one per processor]
    #[arg(long, value_name = "N", requires = "case", value_parser = clap::value_parser!(u32).range(1..=i64::from(MOST_THREADS)))]
    pub threads: Option<u32>,
    /// Folder for the results [default: results/yield, or results/NAME-yield with the name of the case's folder]
    #[arg(short, long, alias = "output", value_parser = output_folder(), value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Replace earlier results in the folder
    #[arg(long)]
    pub force: bool,
}

fn calibrations() -> impl TypedValueParser<Value = Calibration> {
    let possible = [
        ("printed", "As printed: exact for a bar at nu = 0 alone"),
        ("two-point", "Exact for a bar in tension and compression"),
    ];
    let possible = possible.map(|(name, help)| PossibleValue::new(name).help(help));
    PossibleValuesParser::new(possible).map(|name| match name.as_str() {
        "printed" => Calibration::Printed,
        _ => Calibration::TwoPoint,
    })
}

impl YieldArgs {
    /// Executes the command.
    pub(super) fn execute(self) -> anyhow::Result<()> {
        let (of, default_out) = match self.case {
            None => (Families::Lattices(self.m), PathBuf::from("results/yield")),
            Some(file) => {
                let case = CaseArgs {
                    file,
                    overrides: self.overrides,
                    unset: self.unset,
                    threads: self.threads,
                };
                let case = Box::new(case.load()?);
                let out = Path::new("results").join(format!("{}-yield", case.name()));
                let place = self
                    .at
                    .map(BodyPoint::At)
                    .or(self.point.map(BodyPoint::Tag));
                let of = match place {
                    Some(place) => Families::Point(case, place),
                    None => Families::Field(case),
                };
                (of, out)
            }
        };
        let request = Request {
            of,
            combinations: self.criteria,
            poisson: self.nu,
            ratio: self.ratio,
            calibration: self.calibration,
            out: self.out.unwrap_or(default_out),
            force: self.force,
        };
        yielding(&request, &mut terminal::stdout())
    }
}
