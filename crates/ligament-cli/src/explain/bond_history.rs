//! Deformation and breakage of bonds over a run.

use ligament_analysis::fields::point_damage;
use ligament_model::ElementKind;
use ligament_model::element::BondDeformation;
use ligament_model::failure::{AfterLimit, Criterion, Softened};
use ligament_output::Error;
use ligament_output::results::stored::{StoredBreak, StoredRun, StoredStep};
use ligament_output::results::{RestoredBody, RestoredStep};
use ligament_plot::stored_loading::StoredLoading;

/// Deformation and breakage of some bonds over the steps with fields.
#[derive(Debug)]
pub(super) struct BondHistories {
    /// Steps with fields, ascending.
    pub(super) stored_steps: Vec<StoredStep>,
    /// The bonds, in the order of their ends.
    pub(super) of_bonds: Vec<BondHistory>,
    /// Indices of the requested pairs that are absent bonds.
    pub(super) absent: Vec<usize>,
    /// Damage of the point whose bonds are requested in each stored step, 0 to 1; empty for a single bond.
    pub(super) damage: Vec<f64>,
    /// The criteria of all bonds at the end of the run, with their names.
    pub(super) criteria: Vec<(String, Criterion)>,
    /// The loading of the run.
    pub(super) loading: StoredLoading,
    /// Whether bonds have strains of their own.
    pub(super) has_own_strains: bool,
    /// Names of the components of a deformation.
    pub(super) components: &'static [&'static str],
}

/// Deformation and breakage of a bond over a run.
#[derive(Debug)]
pub(super) struct BondHistory {
    /// Index of the pair in the stored model.
    pub(super) pair: usize,
    /// Index of the bond in the arrays of the criteria.
    pub(super) bond: usize,
    /// Ends of the bond.
    pub(super) ends: [u32; 2],
    /// Length, m.
    pub(super) length: f64,
    /// Direction cosines from the first to the second end.
    pub(super) direction: [f64; 3],
    /// State of the bond in each stored step, also after its breakage.
    pub(super) states: Vec<BondState>,
    /// Breakage of the bond, and the index of the criterion by which it failed.
    pub(super) breakage: Option<(StoredBreak, Option<usize>)>,
    /// Largest utilisation of the bond.
    pub(super) nearest: Option<LargestUtilisation>,
}

/// A bond in a stored step.
#[derive(Debug)]
pub(super) struct BondState {
    /// Whether the bond is unbroken.
    pub(super) is_intact: bool,
    /// Deformation without thermal strain.
    pub(super) deformation: BondDeformation,
    /// The bond under each criterion.
    pub(super) of_criteria: Vec<CriterionState>,
}

/// A bond under a criterion in a stored step.
#[derive(Debug, Clone, Copy)]
pub(super) struct CriterionState {
    /// Limit of the measure.
    pub(super) limit: f64,
    /// The measure.
    pub(super) measure: f64,
    /// Measure over limit, 0 where the measure is not positive.
    pub(super) utilisation: f64,
    /// Largest utilisation so far by which the bond softened.
    extreme: f64,
    /// What is left of a bond beyond its limit; nothing after its breakage.
    pub(super) softened: Softened,
}

/// The largest utilisation of a bond, with its step and criterion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct LargestUtilisation {
    pub(super) utilisation: f64,
    pub(super) step: usize,
    pub(super) criterion: usize,
}

impl BondHistories {
    /// Reads the histories of some bonds, chosen by their ends (ascending), and the damage of a point; each file of fields is read once.
    pub(super) fn read(
        run: &StoredRun,
        is_asked: impl Fn(&[u32; 2]) -> bool,
        point: Option<u32>,
        loading: StoredLoading,
    ) -> Result<Self, Error> {
        let element = match run.has_own_strains() && !run.model.in_space {
            false => ElementKind::Beam,
            true if loading.has_true_strains => ElementKind::TrueStrain,
            true => ElementKind::Imaginary,
        };
        let body = RestoredBody::new(run, element, loading.follows_path)?;
        let bonds = &run.model.bonds;
        let asked = (0..bonds.ends.len()).filter(|pair| is_asked(&bonds.ends[*pair]));
        let bonds_asked = (0..)
            .zip(&body.pairs)
            .filter(|it| is_asked(&bonds.ends[*it.1]));
        let names = run.model.criteria.iter().map(|it| it.name.clone());
        let criteria: Vec<_> = names.zip(body.criteria.list.iter().cloned()).collect();
        let begin = |(bond, pair): (usize, &usize)| BondHistory::begin(run, &criteria, bond, *pair);
        let mut lives = Self {
            stored_steps: Vec::new(),
            of_bonds: bonds_asked.map(begin).collect(),
            absent: asked
                .filter(|pair| bonds.absence[*pair].is_some())
                .collect(),
            damage: Vec::new(),
            has_own_strains: run.has_own_strains(),
            components: run.deformation_names,
            criteria,
            loading,
        };
        for step in run.field_steps() {
            // During a run, fields of a step may be written before the step's row.
            let (Some(row), Some(motions)) = (run.step(step), run.motions(step)?) else {
                continue;
            };
            lives.stored_steps.push(*row);
            let criteria = body.criteria_at(step);
            let restored = body.at(step, &motions, &criteria);
            for life in &mut lives.of_bonds {
                life.push(step, &restored);
            }
            let damage = point.map(|it| point_damage(&*body.system, &restored.intact, it));
            lives.damage.extend(damage);
        }
        for life in &mut lives.of_bonds {
            let steps = lives.stored_steps.iter().enumerate();
            let largest = steps.filter_map(|(place, it)| life.largest_in(place, it.step));
            let largest = largest.reduce(LargestUtilisation::or_larger);
            life.nearest = life.nearest.or(largest);
        }
        Ok(lives)
    }
}

impl BondHistory {
    /// The history of a bond before its states are read.
    fn begin(run: &StoredRun, criteria: &[(String, Criterion)], bond: usize, pair: usize) -> Self {
        let model = &run.model;
        let ends = model.bonds.ends[pair];
        let [a, b] = ends.map(|end| model.positions[end as usize]);
        let along = [0, 1, 2].map(|axis| b[axis] - a[axis]);
        let length = along[0].hypot(along[1]).hypot(along[2]);
        let tags = ends.map(|end| model.tags[end as usize]);
        let is_own = |it: &&StoredBreak| it.tags == tags || it.tags == [tags[1], tags[0]];
        let breakage = run.breaks.iter().find(is_own).map(|it| {
            let criterion = criteria.iter().position(|of| of.0 == it.criterion);
            (it.clone(), criterion)
        });
        let at_breakage = breakage.as_ref().and_then(|(broke, criterion)| {
            let criterion = (*criterion)?;
            Some(LargestUtilisation {
                utilisation: broke.utilisation * criteria[criterion].1.after.end(bond),
                step: broke.at.step,
                criterion,
            })
        });
        let largest = run.model.largest.as_ref();
        let of_run = largest.and_then(|largest| {
            Some(LargestUtilisation {
                utilisation: largest.utilisation[pair],
                step: usize::try_from(largest.step[pair]).ok()?,
                criterion: usize::try_from(largest.criterion[pair])
                    .ok()
                    .filter(|criterion| *criterion < criteria.len())?,
            })
        });
        Self {
            pair,
            bond,
            ends,
            length,
            direction: along.map(|component| component / length),
            states: Vec::new(),
            breakage,
            nearest: at_breakage.or(of_run),
        }
    }

    /// Adds the state of the bond in a stored step.
    fn push(&mut self, step: usize, restored: &RestoredStep<'_>) {
        let (bond, criteria) = (self.bond, &restored.criteria);
        let (is_intact, deformation) = (restored.intact[bond], restored.deformations[bond]);
        let of_criterion = |place: usize| {
            let utilisation = criteria.utilisation_by(place, bond, &deformation);
            let before = self.states.last().map(|it| it.of_criteria[place].extreme);
            // The utilisation may have been larger between stored steps.
            let nearest = self
                .nearest
                .filter(|it| it.criterion == place && it.step <= step);
            let known = nearest.map_or(utilisation, |it| utilisation.max(it.utilisation));
            let after = criteria.after(place);
            let (extreme, softened) =
                softened(after, bond, is_intact, [before.unwrap_or(0.0), known]);
            CriterionState {
                limit: criteria.limits(place)[bond],
                measure: criteria.measure(place, bond, &deformation),
                utilisation,
                extreme,
                softened,
            }
        };
        let of_criteria = (0..criteria.criteria().list.len())
            .map(of_criterion)
            .collect();
        self.states.push(BondState {
            is_intact,
            deformation,
            of_criteria,
        });
    }

    /// Largest utilisation in a stored step, the first of several; `None` once the bond is broken.
    pub(super) fn largest_in(&self, place: usize, step: usize) -> Option<LargestUtilisation> {
        let state = self.states.get(place).filter(|it| it.is_intact)?;
        let of_criteria = state.of_criteria.iter().enumerate();
        let utilisations = of_criteria.map(|(criterion, it)| LargestUtilisation {
            utilisation: it.utilisation,
            step,
            criterion,
        });
        utilisations.reduce(LargestUtilisation::or_larger)
    }
}

impl LargestUtilisation {
    /// The larger of two utilisations, the first of equals.
    fn or_larger(self, other: Self) -> Self {
        match other.utilisation > self.utilisation {
            true => other,
            false => self,
        }
    }
}

/// Largest utilisation of a bond by which it softened, and what is left of the bond, from the one before and the present one.
fn softened(
    after: &AfterLimit,
    bond: usize,
    is_intact: bool,
    [before, now]: [f64; 2],
) -> (f64, Softened) {
    let now = after.extreme(bond, now).filter(|_| is_intact);
    let extreme = now.map_or(before, |it| it.max(before));
    let left = after.at(bond, extreme);
    let softened = match is_intact {
        true => left,
        false => Softened {
            force: 0.0,
            secant: 0.0,
            ..left
        },
    };
    (extreme, softened)
}

#[cfg(test)]
mod tests {
    use ligament_model::failure::softening::linear;

    use super::*;

    /// mu = (r - kappa)/(r - 1) and omega = mu/kappa of the largest kappa so far, by hand for r = 4.
    #[test]
    fn softening_keeps_to_the_largest_utilisation() {
        let after = AfterLimit::new(linear::LAW, vec![4.0]);
        let state = |is_intact, before, now| {
            let (extreme, left) = softened(&after, 0, is_intact, [before, now]);
            (extreme, left.force, left.secant)
        };
        assert_eq!(state(true, 0.0, 0.5), (0.5, 1.0, 1.0));
        assert_eq!(state(true, 0.5, 2.5), (2.5, 0.5, 0.2));
        assert_eq!(state(true, 2.5, 0.0), (2.5, 0.5, 0.2));
        assert_eq!(state(false, 2.5, 9.0), (2.5, 0.0, 0.0));
        let (_, force, secant) = state(true, 2.5, 3.0);
        assert!((force - 1.0 / 3.0).abs() < 1e-15 && (secant - 1.0 / 9.0).abs() < 1e-15);
    }
}
