//! Request for yield domains.

use std::path::PathBuf;

use ligament_case::case::CaseFile;
use ligament_model::failure::Calibration;
use ligament_output::folder::{Kind, ResultFolder};

use super::criteria::{Combination, Strengths};
use super::error::{RATIOS, YieldError};

/// File that marks a folder of yield domains.
pub(super) const SUMMARY: &str = "yield.csv";

/// A request to `ligament yield`: the subject, and where to write.
#[derive(Debug)]
pub struct Request {
    /// Families to be studied.
    pub of: Families,
    /// Criteria with the same limits for all bonds; if empty, the criteria of the figures, or of the case.
    pub combinations: Vec<Combination>,
    /// Poisson's ratio in the plane; by default 0, or the ratio of the case.
    pub poisson: Option<f64>,
    /// Compressive over tensile strength.
    pub ratio: f64,
    /// Rule for cohesion and friction from the strengths.
    pub calibration: Calibration,
    /// Folder of the results.
    pub out: PathBuf,
    /// Whether earlier results in the output folder may be replaced.
    pub force: bool,
}

/// Families of bonds to be studied.
#[derive(Debug)]
pub enum Families {
    /// Lattices with these horizons, in spacings.
    Lattices(Vec<f64>),
    /// One point of a case.
    Point(Box<CaseFile>, BodyPoint),
    /// All points of a case.
    Field(Box<CaseFile>),
}

/// A point of a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum BodyPoint {
    /// The point nearest to a position, m.
    At([f64; 2]),
    /// The point with this tag.
    Tag(u64),
}

/// Files of a folder of yield diagrams, except files with a criterion in their name.
const FILES: [&str; 4] = [
    "distribution.svg",
    "locus.csv",
    "orientation.csv",
    "points.vtu",
];

/// Kind of the folder of yield diagrams.
const KIND: Kind = Kind {
    owns: |name| {
        let is_diagram = |start: &&str| name.starts_with(*start) && name.ends_with(".svg");
        FILES.contains(&name) || ["bond-", "error-", "locus-"].iter().any(is_diagram)
    },
    ..Kind::with_marker(SUMMARY)
};

impl Request {
    pub(super) fn check(&self) -> Result<(), YieldError> {
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

    pub(super) fn strengths(&self, poisson: f64) -> Strengths {
        Strengths {
            poisson,
            ratio: self.ratio,
            calibration: self.calibration,
        }
    }

    /// Creates the folder of the results.
    pub(super) fn folder(&self) -> Result<ResultFolder, ligament_output::Error> {
        ResultFolder::create_of_kind(&self.out, KIND, self.force)
    }
}
