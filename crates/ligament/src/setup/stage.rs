//! Stages of a loading: what happens one after the other.

/// A stage of a loading, in which loads go to other factors than they have.
#[derive(Debug, Clone, PartialEq)]
pub struct Stage {
    /// Name, unique among the stages.
    pub name: String,
    /// Loads that change, by their names, the temperature as [`TEMPERATURE`]; every other load keeps its factor, which is 0 before
    /// the first stage that names it.
    pub loads: Vec<(String, Course)>,
    /// Load steps of the stage; of load steps alone.
    pub steps: Option<usize>,
    /// What grows in equal steps; without it the factors do.
    pub control: Option<Control>,
}

/// What grows in equal steps over a stage, while the loads of the stage follow: their factors, which go there from what they are in a
/// fixed proportion, may fall and change sign.
#[derive(Debug, Clone, PartialEq)]
pub struct Control {
    /// What grows.
    pub quantity: Quantity,
    /// Value of the quantity at the end of the stage, m, rad or J.
    pub to: f64,
}

/// What controls a stage.
#[derive(Debug, Clone, PartialEq)]
pub enum Quantity {
    /// Names of probes of motions with their weights in a sum.
    Probes(Vec<(String, f64)>),
    /// The energy that bonds have taken for good since the loading began: of bonds that soften in load steps, of brittle ones along the exact
    /// path, where it says how far the stage goes.
    DissipatedEnergy,
}

/// Name of the changes of temperature, all together, among the loads of a stage.
pub const TEMPERATURE: &str = "temperature";

/// The factor of a load in a stage, along straight lines between these points from the factor that it has at the start.
#[derive(Debug, Clone, PartialEq)]
pub struct Course {
    /// Share of the stage that is over, ascending, more than 0 and at most 1, and the factor there; the last one stays to the end.
    pub points: Vec<[f64; 2]>,
}

impl Course {
    /// A straight line to a factor at the end of the stage.
    pub fn to(factor: f64) -> Self {
        Self::through(&[factor])
    }

    /// Factors one after the other at the ends of equal parts of the stage.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn factors_follow_straight_lines() {
        let cycle = Course::through(&[1.0, -1.0]);
        assert_eq!(cycle.points, [[0.5, 1.0], [1.0, -1.0]]);
        let at = |share: f64| cycle.at(share, 0.5);
        assert_eq!(
            [0.0, 0.25, 0.5, 0.75, 1.0].map(at),
            [0.5, 0.75, 1.0, 0.0, -1.0]
        );
        let table = Course {
            points: vec![[0.25, 2.0]],
        };
        assert_eq!(
            [0.125, 0.25, 1.0].map(|share| table.at(share, 0.0)),
            [1.0, 2.0, 2.0]
        );
    }
}
