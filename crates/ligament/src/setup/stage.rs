//! Successive stages of a loading.

use ligament_model::case_type::Range;

/// A stage of a loading, in which load factors change.
#[derive(Debug, Clone, PartialEq)]
pub struct Stage {
    /// Name, unique among the stages.
    pub name: String,
    /// Names and courses of the loads that change, with [`TEMPERATURE`] for the temperature; every other load keeps its factor, which is 0
    /// before the first stage that names it.
    pub loads: Vec<(String, Course)>,
    /// Number of load steps of the stage; only in an analysis of load steps.
    pub steps: Option<usize>,
    /// Control whose quantity grows in equal steps; without it the factors do.
    pub control: Option<Control>,
}

impl Stage {
    /// Range of the number of load steps, each of which has a row in the history.
    pub const STEPS: Range<'static> = Range::new(&[("minimum", 1.0), ("maximum", 1e6)]);
}

/// Control of a stage by a quantity that grows in equal steps. The factors of the stage's loads change in a fixed proportion from their
/// values at the start, and may fall and change sign.
#[derive(Debug, Clone, PartialEq)]
pub struct Control {
    /// Controlling quantity.
    pub quantity: Quantity,
    /// Value of the quantity at the end of the stage, m, rad or J.
    pub to: f64,
}

/// Quantity that controls a stage.
#[derive(Debug, Clone, PartialEq)]
pub enum Quantity {
    /// Names of probes of motions with their weights in a sum.
    Probes(Vec<(String, f64)>),
    /// The energy dissipated by bonds since the start of the loading: of softening bonds in load steps, of brittle bonds along the exact
    /// path, where its value ends the stage.
    DissipatedEnergy,
}

/// Name of all changes of temperature among the loads of a stage.
pub const TEMPERATURE: &str = "temperature";

/// The factor of a load over a stage, piecewise linear from its value at the start.
#[derive(Debug, Clone, PartialEq)]
pub struct Course {
    /// Shares of the stage, ascending, more than 0 and at most 1, with the factors there; the last factor is kept to the end.
    pub points: Vec<[f64; 2]>,
}

impl Course {
    /// A linear course to a factor at the end of the stage.
    pub fn to(factor: f64) -> Self {
        Self::through(&[factor])
    }

    /// A course through factors at the ends of equal parts of the stage.
    pub fn through(factors: &[f64]) -> Self {
        let count = factors.len() as f64;
        let point = |(index, factor): (usize, &f64)| [(index + 1) as f64 / count, *factor];
        Self {
            points: factors.iter().enumerate().map(point).collect(),
        }
    }

    /// The factor at a share of the stage, from `start` at its start.
    pub fn at(&self, share: f64, start: f64) -> f64 {
        let mut before = [0.0, start];
        for &point in &self.points {
            if share <= point[0] {
                let part = (share - before[0]) / (point[0] - before[0]);
                return if part == 1.0 {
                    point[1]
                } else {
                    before[1] + part * (point[1] - before[1])
                };
            }
            before = point;
        }
        before[1]
    }
}
