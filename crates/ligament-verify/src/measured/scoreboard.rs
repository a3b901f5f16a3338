//! Scores of the runs of a measured test.

use ligament_run::end::End;

use super::reading::Reading;
use super::test::MeasuredTest;

/// Scores of a test.
#[derive(Debug, Clone, PartialEq)]
pub struct Scores {
    /// Case file, from the root of the repository.
    pub case: String,
    /// Material, and the properties that the source leaves open.
    pub material: String,
    /// Scores of the runs, in their order.
    pub runs: Vec<Score>,
}

/// Score of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct Score {
    /// Name of the run.
    pub run: String,
    /// Number of points of the body.
    pub points: usize,
    /// Number of increments: load steps, or events of the exact path.
    pub increments: usize,
    /// Number of increments that did not come to rest, including an increment that ended the run.
    pub failed: usize,
    /// Processor time with meshing and output, s.
    pub seconds: f64,
    /// Dissipated energy per area of the cracks over the fracture energy; None without a fracture energy or cracks.
    pub spent: Option<f64>,
}

impl Scores {
    /// Scores of the runs of a test.
    pub(super) fn new(test: &MeasuredTest, readings: &[Reading]) -> Self {
        Self {
            case: test.case.clone(),
            material: test.material.clone(),
            runs: readings.iter().map(Score::from_reading).collect(),
        }
    }
}

impl Score {
    fn from_reading(reading: &Reading) -> Self {
        let summary = &reading.summary;
        let ended = matches!(summary.end(), End::NoEquilibrium | End::Invalid);
        Self {
            run: reading.run.clone(),
            points: summary.model.points,
            increments: summary.steps,
            failed: reading.failed + usize::from(ended),
            seconds: reading.seconds,
            spent: summary.certificate.and_then(|it| it.spent_ratio()),
        }
    }
}
