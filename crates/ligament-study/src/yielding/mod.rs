//! `ligament yield`: when families of bonds yield first, and what the directions of their bonds make of that.
//!
//! | module | holds |
//! |---|---|
//! | [`criteria`] | criteria by name with the same limits for all bonds |
//! | [`subject`] | the families that are compared, and the strains |
//! | [`of_case`] | families of a case: one point, or all |
//! | [`diagrams`], [`console`] | tables, polar diagrams and loci; the terminal |

use std::io::Write;
use std::path::PathBuf;

use ligament_model::failure::frictional::Calibration;
use ligament_output::folder::ResultFolder;

use ligament_case::case::CaseFile;

pub mod console;
pub mod criteria;
pub mod diagrams;
pub mod of_case;
pub mod subject;

use criteria::{Combination, Strengths};
use diagrams::Comparison;
use subject::{Strain, Subject};

/// The file by which a folder is known to hold yield domains.
pub const SUMMARY: &str = "yield.csv";

/// Horizons of lattices, in spacings.
const RATIOS: std::ops::RangeInclusive<f64> = 1.0..=50.0;

/// A request to `ligament yield`: the subject, and where to write.
#[derive(Debug)]
pub struct Request {
    /// The families.
    pub of: Families,
    /// Criteria with the same limits for all bonds; none for those of the figures, or of the case.
    pub combinations: Vec<Combination>,
    /// Poisson's ratio in the plane; none for 0, or that of the case.
    pub poisson: Option<f64>,
    /// Compressive over tensile strength.
    pub ratio: f64,
    /// How cohesion and friction come from the strengths.
    pub calibration: Calibration,
    /// Folder of the results.
    pub out: PathBuf,
    /// Whether earlier results there may be replaced.
    pub force: bool,
}

/// Whose bonds.
#[derive(Debug)]
pub enum Families {
    /// Lattices with horizons of so many spacings.
    Lattices(Vec<f64>),
    /// One point of a case.
    Point(Box<CaseFile>, Place),
    /// All points of a case.
    Field(Box<CaseFile>),
}

/// A point of a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Place {
    /// The one nearest to a position.
    At([f64; 2]),
    /// The one of this tag.
    Tag(u64),
}

/// What cannot be looked at.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum YieldError {
    /// A horizon without neighbours, or of thousands of them.
    #[error("m = {ratio}: the horizon of a lattice is {} to {} spacings", RATIOS.start(), RATIOS.end())]
    Ratio {
        /// The one given.
        ratio: f64,
    },
    /// A Poisson's ratio that no material has in the plane.
    #[error("nu = {poisson} is not between -1 and 1, as Poisson's ratio in the plane is")]
    Poisson {
        /// The one given.
        poisson: f64,
    },
    /// A ratio of strengths that is none.
    #[error(
        "the ratio of strengths is {ratio}, and should be positive: compressive over tensile strength"
    )]
    Strengths {
        /// The one given.
        ratio: f64,
    },
    /// Friction needs a compressive strength of at least the tensile one.
    #[error(
        "frictional sliding needs --ratio of 1 or more (compressive over tensile strength), got {ratio}"
    )]
    NoFriction {
        /// The one given.
        ratio: f64,
    },
    /// Two strengths that no friction fits.
    #[error(
        "no friction fits both strengths at nu = {poisson} in the plane: --calibration two-point needs nu below \
         1/{ratio} (tensile over compressive strength); take --calibration printed, or a smaller --ratio"
    )]
    NoTwoPoints {
        /// Poisson's ratio in the plane.
        poisson: f64,
        /// Compressive over tensile strength.
        ratio: f64,
    },
    /// A case whose bonds never fail.
    #[error(
        "the case has no [fracture] section, so its bonds have no limits: give it one (for example --set fracture.steps=1, \
         with a strength of the material), or take limits that are the same for all bonds with --criterion"
    )]
    NoCriteria,
    /// Bonds that do not see the strain by their direction.
    #[error(
        "the bonds of model.law = \"mbb-pd\" have all strains of the body whatever their direction, so that directions weaken nothing: \
         families yield at the limits that `ligament check` lists"
    )]
    NoDirections,
    /// A case without a Poisson's ratio for all directions, or with several.
    #[error("the case has {which}: give Poisson's ratio in the plane with --nu")]
    NoPoisson {
        /// The elastic constants that the case has instead, in words.
        which: &'static str,
    },
    /// No point has this tag.
    #[error("there is no {tagged} {tag}: their numbers are {lowest} to {highest}")]
    NoPoint {
        /// The noun that tags belong to: `node` or `cell`.
        tagged: &'static str,
        /// The one asked for.
        tag: u64,
        /// Lowest number.
        lowest: u64,
        /// Highest number.
        highest: u64,
    },
    /// A position away from the body.
    #[error("there is no point of the body within a horizon ({horizon:.3e} m) of ({}, {}); the nearest is {nearest}", at[0], at[1])]
    NotInBody {
        /// The position.
        at: [f64; 2],
        /// The nearest point.
        nearest: String,
        /// Horizon of the nearest point, m.
        horizon: f64,
    },
    /// A family that no strain makes yield.
    #[error(
        "no bond of {of} ever fails: its limits are infinite (no_fail, or a material without strength)"
    )]
    NeverYields {
        /// Whose.
        of: String,
    },
}

/// Computes errors and loci, tells of them and writes them.
///
/// # Errors
///
/// If the request makes no sense, the case cannot be read or has no such point, or the folder cannot be used.
pub fn yielding(request: &Request, screen: &mut (dyn Write + Send)) -> anyhow::Result<()> {
    request.check()?;
    match &request.of {
        Families::Lattices(ratios) => of_lattices(request, ratios, screen)?,
        Families::Point(case, place) => of_case::point(request, case, *place, screen)?,
        Families::Field(case) => of_case::field(request, case, screen)?,
    }
    Ok(writeln!(screen, "results in {}", request.out.display())?)
}

fn of_lattices(request: &Request, ratios: &[f64], screen: &mut dyn Write) -> anyhow::Result<()> {
    let poisson = request.poisson.unwrap_or(0.0);
    let strengths = request.strengths(poisson);
    let given = &request.combinations;
    let combinations = if given.is_empty() {
        Combination::of_the_figures()
    } else {
        given.clone()
    };
    let mut comparisons = Vec::new();
    for combination in &combinations {
        let of_ratio = |&ratio: &f64| Subject::of_lattice(ratio, combination, &strengths);
        comparisons.push(Comparison {
            criterion: combination.name().to_owned(),
            subjects: ratios.iter().map(of_ratio).collect::<Result<_, _>>()?,
        });
    }
    let strains = Strain::of_the_figures(poisson);
    diagrams::write(&request.folder()?, &comparisons, &strains)?;
    writeln!(
        screen,
        "lattices, nu = {poisson}, strains in units of the limit s0t, compressive over tensile strength {}\n",
        request.ratio
    )?;
    for comparison in &comparisons {
        console::tell(screen, comparison)?;
    }
    Ok(())
}

impl Request {
    fn check(&self) -> Result<(), YieldError> {
        if let Families::Lattices(ratios) = &self.of
            && let Some(&ratio) = ratios.iter().find(|ratio| !RATIOS.contains(ratio))
        {
            return Err(YieldError::Ratio { ratio });
        }
        if let Some(poisson) = self.poisson.filter(|it| it.is_nan() || it.abs() >= 1.0) {
            return Err(YieldError::Poisson { poisson });
        }
        let ratio = self.ratio;
        if !(ratio > 0.0 && ratio.is_finite()) {
            return Err(YieldError::Strengths { ratio });
        }
        Ok(())
    }

    fn strengths(&self, poisson: f64) -> Strengths {
        Strengths {
            poisson,
            ratio: self.ratio,
            calibration: self.calibration,
        }
    }

    /// The folder, new or empty.
    fn folder(&self) -> Result<ResultFolder, ligament_output::Error> {
        ResultFolder::create_marked(&self.out, SUMMARY, self.force)
    }
}
