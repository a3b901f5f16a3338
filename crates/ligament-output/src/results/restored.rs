//! Stored steps of a run, restored into bonds, criteria and states, from which the functions of the analysis read what they read in the run.

use std::sync::Arc;

use ligament_analysis::ElementKind;
use ligament_model::failure::{
    AfterLimit, Criteria, CriteriaInState, Criterion, Measure, Surroundings,
};
use ligament_model::stress::point_strain::Motion;
use ligament_model::system::stored::without_stiffness;
use ligament_model::{Bonds, Deformations};

use super::bond_arrays::steps_of;
use super::stored::{Motions, StoredCriterion, StoredModel, StoredRun};
use super::tables::CRITERIA_FILE;
use crate::Error;

/// Bonds and criteria of a stored run.
#[derive(Debug)]
pub struct RestoredBody {
    /// Points of the model, and its bonds in the order of their ends, without stiffness.
    pub system: Arc<dyn Bonds>,
    /// Index of each bond among the pairs of the stored model, shape (n_bonds).
    pub pairs: Vec<usize>,
    /// Criteria with the limits at the end of the run.
    pub criteria: Criteria,
    /// Limits of each criterion before bonds began to soften by the stress around them, shape (n_bonds); empty where that changed no limit.
    at_start: Vec<Vec<f64>>,
    /// Step in which each bond broke, shape (n_bonds).
    broke_in: Vec<Option<usize>>,
    /// Step in which each bond began to soften by the stress around it, shape (n_bonds); empty where no criterion lets bonds begin.
    began_in: Vec<Option<usize>>,
    /// Step in which the force of each bond began to fall beyond a limit, shape (n_bonds).
    softened_in: Vec<Option<usize>>,
    /// Whether a stored step is just before the breakages of its step.
    follows_path: bool,
}

/// The body at the end of a stored step, on the exact path before the breakages of the step.
pub struct RestoredStep<'a> {
    /// Whether each bond is unbroken, shape (n_bonds).
    pub intact: Vec<bool>,
    /// Deformation of each bond without its thermal expansion, shape (n_bonds).
    pub deformations: Deformations,
    /// The criteria with the limits of the step and the stresses across the bonds.
    pub criteria: CriteriaInState<'a>,
}

impl RestoredBody {
    /// The body of a run with elements of a kind, on the exact path or not.
    ///
    /// # Errors
    ///
    /// If this version does not know a measure or a law of the criteria.
    pub fn new(run: &StoredRun, element: ElementKind, follows_path: bool) -> Result<Self, Error> {
        let model = &run.model;
        let absence = model.bonds.absence.iter().enumerate();
        let bonds = absence.filter(|(_, absence)| absence.is_none());
        let mut pairs: Vec<usize> = bonds.map(|(pair, _)| pair).collect();
        // Pieces of several processes have the bonds in their own order.
        pairs.sort_by_key(|pair| model.bonds.ends[*pair]);
        let criteria = model.criteria.iter();
        let restored = criteria.map(|it| criterion(it, &pairs).ok_or_else(|| unknown(run, it)));
        let criteria = Criteria {
            list: restored.collect::<Result<_, _>>()?,
        };
        let at_start = (model.criteria.iter()).map(|it| of_bonds(&it.limit_at_start, &pairs));
        let breaks = run.breaks.iter().map(|it| (it.tags, it.at.step)).collect();
        let ends = of_bonds(&model.bonds.ends, &pairs);
        let steps_of = |events: Vec<_>| steps_of(&model.tags, &ends, events);
        let began_in = model
            .largest
            .iter()
            .flat_map(|it| of_bonds(&it.began_in, &pairs));
        Ok(Self {
            system: system(model, &pairs, element),
            at_start: at_start.collect(),
            broke_in: steps_of(breaks),
            began_in: began_in.map(|step| usize::try_from(step).ok()).collect(),
            softened_in: steps_of(run.softened.clone()),
            criteria,
            pairs,
            follows_path,
        })
    }

    /// The criteria with the limits at the end of a step.
    pub fn criteria_at(&self, step: usize) -> Criteria {
        let mut criteria = self.criteria.clone();
        for (criterion, at_start) in criteria.list.iter_mut().zip(&self.at_start) {
            for (bond, (limit, began_in)) in at_start.iter().zip(&self.began_in).enumerate() {
                if began_in.is_some_and(|it| it > step) {
                    Arc::make_mut(&mut criterion.limit)[bond] = *limit;
                }
            }
        }
        criteria
    }

    /// The body with the motions of a step, and the [criteria](Self::criteria_at) of the step.
    pub fn at<'a>(
        &self,
        step: usize,
        motions: &Motions,
        criteria: &'a Criteria,
    ) -> RestoredStep<'a> {
        let end = step.saturating_add(usize::from(!self.follows_path));
        let is_over = |of_bond: &Option<usize>| of_bond.is_some_and(|it| it < end);
        let intact: Vec<bool> = self.broke_in.iter().map(|it| !is_over(it)).collect();
        // As in the run, bonds that soften do not show the strain of the body.
        let mut sound = intact.clone();
        for softened_in in [&self.began_in, &self.softened_in] {
            for (sound, softened_in) in sound.iter_mut().zip(softened_in) {
                *sound &= !is_over(softened_in);
            }
        }
        let displacement = self.degrees_of_freedom(motions);
        let expansion = motions.thermal_strain.times(1.0);
        let deformations = self.system.deformations(&intact, &displacement, expansion);
        let motion = Motion {
            intact: &sound,
            displacement: &displacement,
            expansion,
        };
        let stresses = criteria.stresses(&*self.system, motion, &deformations);
        RestoredStep {
            criteria: (criteria.without_state()).in_state(&stresses, &intact, &deformations),
            deformations,
            intact,
        }
    }

    /// Displacements and rotations, shape (n_degrees_of_freedom), m and rad.
    fn degrees_of_freedom(&self, motions: &Motions) -> Vec<f64> {
        let layout = self.system.layout;
        let axes = if layout.is_in_space() { 3 } else { 2 };
        let n_rotations = layout.components.len() - axes;
        let both = motions.displacement.iter().zip(&motions.rotation);
        // In the plane a point turns about z alone.
        let of_point =
            both.flat_map(|(moved, turned)| moved[..axes].iter().chain(&turned[3 - n_rotations..]));
        of_point.copied().collect()
    }
}

/// Bonds without stiffness between the points of a model.
fn system(model: &StoredModel, pairs: &[usize], element: ElementKind) -> Arc<dyn Bonds> {
    let StoredModel {
        positions,
        in_space,
        volumes,
        bonds,
        ..
    } = model;
    let of_pairs = |value: &dyn Fn(usize) -> f64| pairs.iter().map(|pair| value(*pair)).collect();
    let arrays = (
        of_bonds(&bonds.ends, pairs),
        of_pairs(&|pair| horizon(model, pair)),
        of_pairs(&|pair| bonds.length_factor[pair] * bonds.domain_factor[pair]),
    );
    without_stiffness(positions, *in_space, volumes, element, arrays)
}

/// Horizon of a bond, m, as the mean of the horizons of its ends or the larger one: whichever has the seven digits of the stored model; the
/// stored number where neither has.
fn horizon(model: &StoredModel, pair: usize) -> f64 {
    let stored = model.bonds.horizon[pair];
    let [a, b] = model.bonds.ends[pair].map(|end| model.horizon[end as usize]);
    let mut possible = [0.5 * (a + b), a.max(b)].into_iter();
    let found = possible.find(|it| f64::from(*it as f32) == stored);
    found.unwrap_or(stored)
}

/// A criterion of the bonds of some pairs; `None` where its measure or its law after the limit is unknown.
fn criterion(stored: &StoredCriterion, pairs: &[usize]) -> Option<Criterion> {
    let mut measures = Measure::ALL.into_iter();
    let measure = measures.find(|it| it.word() == stored.measure)?;
    let n_coefficients = stored.coefficients.len();
    let n_expected = measure.coefficient_names().len();
    if n_coefficients != n_expected && (n_coefficients > 1 || measure.takes_stress()) {
        return None;
    }
    let coefficients = pairs
        .iter()
        .flat_map(|pair| stored.coefficients.iter().map(|it| it[*pair]));
    Some(Criterion {
        after: AfterLimit::from_text(&stored.after, of_bonds(&stored.parameter, pairs))?,
        coefficient: Arc::new(coefficients.collect()),
        surroundings: measure
            .takes_stress()
            .then(|| Arc::new(Surroundings::Stress)),
        ..Criterion::brittle("", measure, of_bonds(&stored.limit, pairs))
    })
}

/// The values of the bonds of some pairs; empty where there are none.
fn of_bonds<T: Copy>(values: &[T], pairs: &[usize]) -> Vec<T> {
    let of_bonds = pairs.iter().filter_map(|pair| values.get(*pair));
    of_bonds.copied().collect()
}

fn unknown(run: &StoredRun, criterion: &StoredCriterion) -> Error {
    Error::Unreadable {
        path: run.folder.join(CRITERIA_FILE),
        reason: format!(
            "this version does not know the measure `{}` of criterion {}, or its law `{}` after the limit",
            criterion.measure, criterion.name, criterion.after
        ),
    }
}
