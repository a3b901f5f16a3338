//! A family of bonds with a name, the subject of a curve.

use ligament_model::BondSystem;
use ligament_model::failure::{Criteria, Criterion};
use ligament_post::yielding::{Family, PrincipalStretches, WorstOrientation, lattice};

use super::criteria::{Combination, Strengths};
use super::error::YieldError;

/// A family of bonds with its criteria and a name.
#[derive(Debug, Clone)]
pub struct Subject {
    /// Name of the subject: "m = 3", "node 12".
    pub name: String,
    /// Number of bonds.
    pub size: usize,
    directions: Vec<f64>,
    criteria: Criteria,
    /// Arguments for the error of the paper's tables, where the subject is a lattice.
    printed: Option<(Combination, Strengths)>,
}

/// A uniform strain of the diagrams.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Strain {
    /// Name of the strain in files.
    pub name: &'static str,
    /// Description of the strain.
    pub words: &'static str,
    /// Principal stretches of the strain, of size one.
    pub stretches: PrincipalStretches,
}

impl Strain {
    /// The strains of the figures: a bar in tension, which is the paper's simple extension at nu = 0, and pure shear.
    pub fn in_figures(poisson: f64) -> [Self; 2] {
        [
            Self {
                name: "tension",
                words: "bar in tension",
                stretches: PrincipalStretches::new(1.0, -poisson),
            },
            Self {
                name: "shear",
                words: "pure shear",
                stretches: PrincipalStretches::new(1.0, -1.0),
            },
        ]
    }
}

impl Subject {
    /// The family of an inner point of a square lattice with a horizon of `ratio` m spacings.
    ///
    /// # Errors
    ///
    /// If no friction fits the strengths.
    pub fn from_lattice(
        ratio: f64,
        combination: &Combination,
        strengths: &Strengths,
    ) -> Result<Self, YieldError> {
        let directions = lattice::directions(ratio);
        Ok(Self {
            name: format!("m = {ratio}"),
            size: lattice::family_size(ratio),
            criteria: combination.criteria(strengths, directions.len())?,
            directions,
            printed: Some((combination.clone(), *strengths)),
        })
    }

    /// The family of a point of a body, with the criteria of the body's bonds.
    pub fn at_point(name: String, system: &BondSystem, criteria: &Criteria, point: u32) -> Self {
        let bonds = system.bonds.incidence.at(point);
        let angle = |&bond: &u32| {
            let [a, b] = system.bonds.direction[bond as usize];
            b.atan2(a)
        };
        let of_family = |values: &[f64]| -> Vec<f64> {
            let bonds = bonds.iter().map(|&bond| bond as usize);
            bonds.filter_map(|bond| values.get(bond).copied()).collect()
        };
        // First yield depends only on the limit, not on the law after it.
        let criterion = |it: &Criterion| Criterion {
            coefficient: of_family(&it.coefficient).into(),
            ..Criterion::brittle(it.name, it.measure, of_family(&it.limit))
        };
        Self {
            name,
            size: bonds.len(),
            directions: bonds.iter().map(angle).collect(),
            criteria: Criteria {
                list: criteria.list.iter().map(criterion).collect(),
            },
            printed: None,
        }
    }

    /// The bonds of the subject.
    pub fn family(&self) -> Family<'_> {
        Family::from_directions(&self.directions, &self.criteria)
    }

    /// Name of the criterion with an index.
    pub fn criterion_name(&self, place: usize) -> &'static str {
        self.criteria.list[place].name
    }

    /// The error of the paper's tables; `None` where they have none.
    ///
    /// # Errors
    ///
    /// If no friction fits the strengths.
    pub fn printed_measure(
        &self,
        path: PrincipalStretches,
    ) -> Result<Option<WorstOrientation>, YieldError> {
        match &self.printed {
            Some((combination, strengths)) => {
                combination.printed_measure(strengths, &self.directions, path)
            }
            None => Ok(None),
        }
    }
}
