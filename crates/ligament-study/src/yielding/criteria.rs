//! Criteria by name, with the same limits for all bonds.

use std::str::FromStr;

use ligament_model::failure::frictional::{self, Calibration, Friction};
use ligament_model::failure::{Criteria, Criterion, Measure, sliding, stretch};
use ligament_model::{Isotropic, Plane};
use ligament_post::yielding::{
    Family, PrincipalStretches, WorstOrientation, margin, printed_orientations,
};

use super::error::YieldError;
use ligament::suggestion::hint;

/// A criterion with one limit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Part {
    Tension,
    Compression,
    Sliding,
    Frictional,
}

/// Words of the command line with their criteria.
const WORDS: [(&str, &[Part]); 5] = [
    ("stretch", &[Part::Tension, Part::Compression]),
    ("tension", &[Part::Tension]),
    ("compression", &[Part::Compression]),
    ("sliding", &[Part::Sliding]),
    ("frictional", &[Part::Frictional]),
];

/// Criteria of the paper's figures: single ones, and both criteria of sliding combined with the limits of stretch.
const FIGURES: [&str; 5] = [
    "stretch",
    "sliding",
    "frictional",
    "sliding+stretch",
    "frictional+stretch",
];

/// Combination of criteria, such as `sliding+stretch`; the first one that is met decides.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Combination {
    name: String,
    parts: Vec<Part>,
}

/// Strengths from which limits follow: the strengths of a bar with strain limit s_0t in tension and a multiple of it in compression.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Strengths {
    /// Poisson's ratio in the plane.
    pub poisson: f64,
    /// Compressive over tensile strength, |s_0c|/s_0t.
    pub ratio: f64,
    /// Rule for cohesion and friction from the strengths.
    pub calibration: Calibration,
}

impl FromStr for Combination {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let known: Vec<String> = WORDS.iter().map(|(word, _)| (*word).to_owned()).collect();
        let mut parts = Vec::new();
        for word in text.split('+').map(str::trim) {
            let (_, stands_for) = (WORDS.iter().find(|(it, _)| *it == word)).ok_or_else(|| {
                let hint = hint(word, &known, "criteria", '`');
                format!("no criterion `{word}`{hint} (joined by `+`, the first that is met)")
            })?;
            for part in *stands_for {
                if !parts.contains(part) {
                    parts.push(*part);
                }
            }
        }
        Ok(Self {
            name: text.to_owned(),
            parts,
        })
    }
}

impl Combination {
    /// Combinations in the paper's figures.
    pub fn in_figures() -> Vec<Self> {
        FIGURES.iter().flat_map(|words| words.parse()).collect()
    }

    /// Name of the combination.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The criteria for `n_bonds` bonds, in units of s_0t.
    ///
    /// # Errors
    ///
    /// If no friction fits the strengths.
    pub fn criteria(&self, strengths: &Strengths, n_bonds: usize) -> Result<Criteria, YieldError> {
        let list = self.parts.iter().map(|part| {
            let brittle =
                |name, measure, limit| Criterion::brittle(name, measure, vec![limit; n_bonds]);
            Ok(match part {
                Part::Tension => brittle("tension", Measure::Tension, strengths.stretch(1.0)),
                Part::Compression => brittle(
                    "compression",
                    Measure::Compression,
                    strengths.stretch(strengths.ratio),
                ),
                Part::Sliding => brittle("sliding", Measure::Sliding, strengths.sliding()),
                Part::Frictional => {
                    let Friction { cohesion, slope } = strengths.friction()?;
                    Criterion {
                        coefficient: vec![slope; n_bonds].into(),
                        ..brittle("frictional", Measure::Friction, cohesion)
                    }
                }
            })
        });
        Ok(Criteria {
            list: list.collect::<Result<_, YieldError>>()?,
        })
    }

    /// The error of MPPD Tables 7, 8 or 9 for bonds at these directions (rad), the worst of the printed orientations; `None` for other
    /// criteria, which have no table, and where no bond yields.
    ///
    /// # Errors
    ///
    /// If no friction fits the strengths.
    pub fn printed_measure(
        &self,
        strengths: &Strengths,
        directions: &[f64],
        path: PrincipalStretches,
    ) -> Result<Option<WorstOrientation>, YieldError> {
        let criteria = self.criteria(strengths, directions.len())?;
        let family = Family::from_directions(directions, &criteria);
        let utilisation = family.theoretical_utilisation(path);
        if utilisation <= 0.0 {
            return Ok(None);
        }
        let friction = match self.parts[..] {
            [Part::Tension | Part::Compression] | [Part::Tension, Part::Compression] => {
                return Ok(family.worst_of(path, printed_orientations()));
            }
            [Part::Sliding] => Friction {
                cohesion: strengths.sliding(),
                slope: 0.0,
            },
            [Part::Frictional] => strengths.friction()?,
            _ => return Ok(None),
        };
        let on_locus = path.scaled(1.0 / utilisation);
        Ok(Some(margin::worst(directions, friction, on_locus)))
    }
}

impl Strengths {
    /// Strengths of the MPPD paper's tables: nu = 0, and a compressive strength of three times the tensile one.
    pub const TABLE_STRENGTHS: Self = Self {
        poisson: 0.0,
        ratio: 3.0,
        calibration: Calibration::Printed,
    };

    /// Material of the bar, with E = 1, so that stresses equal strains.
    fn bar(&self) -> Isotropic {
        Isotropic {
            young: 1.0,
            poisson: self.poisson,
        }
    }

    fn stretch(&self, strength: f64) -> f64 {
        stretch::limit(&self.bar(), strength, Plane::Stress)
    }

    fn sliding(&self) -> f64 {
        sliding::limit(&self.bar(), 1.0, Plane::Stress)
    }

    fn friction(&self) -> Result<Friction, YieldError> {
        let Self { poisson, ratio, .. } = *self;
        if ratio < 1.0 {
            return Err(YieldError::NoFriction { ratio });
        }
        let strengths = [1.0, ratio];
        frictional::condition(&self.bar(), strengths, Plane::Stress, self.calibration)
            .ok_or(YieldError::NoTwoPoints { poisson, ratio })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STRENGTHS: Strengths = Strengths {
        poisson: 0.25,
        ratio: 3.0,
        calibration: Calibration::Printed,
    };

    #[test]
    fn combinations_are_read_and_unknown_words_told() {
        let both: Combination = "sliding + stretch".parse().unwrap();
        let criteria = both.criteria(&STRENGTHS, 2).unwrap();
        let limits: Vec<(&str, f64)> = criteria
            .list
            .iter()
            .map(|it| (it.name, it.limit[1]))
            .collect();
        assert_eq!(
            limits,
            [("sliding", 0.625), ("tension", 1.0), ("compression", 3.0)]
        );
        let once: Combination = "stretch+tension".parse().unwrap();
        assert_eq!(once.criteria(&STRENGTHS, 1).unwrap().list.len(), 2);
        let error = "slidding".parse::<Combination>().unwrap_err();
        assert!(error.contains("did you mean `sliding`"), "{error}");
    }

    #[test]
    fn strengths_without_friction_are_told() {
        let frictional: Combination = "frictional".parse().unwrap();
        let with = |poisson, ratio, calibration| {
            let strengths = Strengths {
                poisson,
                ratio,
                calibration,
            };
            frictional.criteria(&strengths, 1).map(|_| ())
        };
        assert_eq!(with(0.3, 3.0, Calibration::TwoPoint), Ok(()));
        assert_eq!(
            with(0.34, 3.0, Calibration::TwoPoint),
            Err(YieldError::NoTwoPoints {
                poisson: 0.34,
                ratio: 3.0
            })
        );
        assert_eq!(
            with(0.0, 0.5, Calibration::Printed),
            Err(YieldError::NoFriction { ratio: 0.5 })
        );
    }
}
