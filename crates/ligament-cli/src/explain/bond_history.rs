//! Deformation and breakage of bonds over a run.

use ligament_model::element::BondDeformation;
use ligament_model::element::pair::Pair;
use ligament_model::failure::hooke::Moduli;
use ligament_model::failure::{AfterLimit, Measure, Softened};
use ligament_model::stress::point_strain::StrainAround;
use ligament_output::Error;
use ligament_output::results::stored::{
    Motions, StoredBreak, StoredCriterion, StoredRun, StoredStep,
};

use super::end_families::EndFamilies;
use super::strains::Strains;
use ligament::units::Units;
use ligament_plot::stored_loading::StoredLoading;

/// Deformation and breakage of some bonds over the steps with fields.
#[derive(Debug)]
pub(super) struct BondHistories {
    /// Steps with fields, ascending.
    pub(super) stored_steps: Vec<StoredStep>,
    /// The bonds, in the order of the pairs in the stored model, without absent bonds.
    pub(super) of_bonds: Vec<BondHistory>,
    /// Indices of the requested pairs that are absent bonds.
    pub(super) absent: Vec<usize>,
    /// Whether a stored step precedes the breakages of its step.
    pub(super) before_breakages: bool,
    /// Whether bonds have strains of their own.
    pub(super) has_own_strains: bool,
    /// Whether the stored steps are times of a motion.
    pub(super) in_time: bool,
    /// Names of the components of a deformation.
    pub(super) components: &'static [&'static str],
    /// Units of the displacement and the reaction of the stored steps.
    pub(super) units: Units,
}

/// Limits, deformation and breakage of a bond over a run.
#[derive(Debug)]
pub(super) struct BondHistory {
    /// Index of the pair in the stored model.
    pub(super) pair: usize,
    /// Ends of the bond.
    pub(super) ends: [u32; 2],
    /// Length, m.
    pub(super) length: f64,
    /// Direction cosines from the first to the second end.
    pub(super) direction: [f64; 3],
    /// Limits of the bond, one per criterion.
    pub(super) limits: Vec<Limit>,
    /// Deformation of the bond at each stored step, also after its breakage.
    pub(super) deformation: Vec<BondDeformation>,
    /// Strain of its ends in each stored step; empty where no criterion takes the stress around it.
    pub(super) around: Vec<Option<StrainAround>>,
    /// Number of stored steps at which the bond was intact.
    pub(super) n_intact: usize,
    /// Breakage of the bond, and the index of the criterion by which it failed.
    pub(super) breakage: Option<(StoredBreak, Option<usize>)>,
    /// Largest utilisation of the bond.
    pub(super) nearest: Option<LargestUtilisation>,
}

/// A criterion and its limit for a bond.
#[derive(Debug, Clone)]
pub(super) struct Limit {
    pub(super) name: String,
    pub(super) measure: Measure,
    pub(super) limit: f64,
    pub(super) coefficients: Vec<f64>,
    pub(super) after: AfterLimit,
}

/// The largest utilisation of a bond, with its step and criterion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct LargestUtilisation {
    pub(super) utilisation: f64,
    pub(super) step: usize,
    pub(super) criterion: usize,
}

/// Indices of the pairs of a point in the stored model, ascending.
pub(super) fn bonds_of(run: &StoredRun, point: u32) -> Vec<usize> {
    let ends = run.model.bonds.ends.iter().enumerate();
    let of_point = ends.filter(|(_, ends)| ends.contains(&point));
    of_point.map(|(pair, _)| pair).collect()
}

/// Index of the pair of two points (in ascending order) in the stored model, if one is in the horizon of the other.
pub(super) fn pair_of(run: &StoredRun, ends: [u32; 2]) -> Option<usize> {
    run.model.bonds.ends.iter().position(|it| *it == ends)
}

impl BondHistories {
    /// Reads the histories of some bonds; each file of fields is read once.
    pub(super) fn read(
        run: &StoredRun,
        pairs: Vec<usize>,
        loading: &StoredLoading,
    ) -> Result<Self, Error> {
        let is_absent = |pair: &usize| run.model.bonds.absence[*pair].is_some();
        let (absent, bonds): (Vec<usize>, Vec<usize>) = pairs.into_iter().partition(is_absent);
        let mut lives = Self {
            stored_steps: Vec::new(),
            of_bonds: Vec::new(),
            absent,
            before_breakages: loading.follows_path,
            in_time: loading.in_time,
            has_own_strains: run.has_own_strains(),
            components: run.deformation_names,
            units: loading.units,
        };
        for pair in bonds {
            lives.of_bonds.push(BondHistory::begin(run, pair)?);
        }
        let mut strains = Strains::from_run(run, loading.follows_path);
        let ends = lives.of_bonds.iter().map(|it| it.ends);
        let mut limits = lives.of_bonds.iter().flat_map(|it| &it.limits);
        let around = limits
            .any(|it| it.measure.takes_stress())
            .then(|| EndFamilies::new(run, ends, loading.follows_path));
        for step in run.field_steps() {
            // During a run, fields of a step may be written before the step's row.
            let (Some(row), Some(motions)) = (run.step(step), run.motions(step)?) else {
                continue;
            };
            lives.stored_steps.push(*row);
            if let Some(strains) = &mut strains {
                strains.go_to(step);
            }
            for life in &mut lives.of_bonds {
                life.deformation.push(match &strains {
                    Some(strains) => strains.deformation(life.pair, &motions),
                    None => life.deformed(run, &motions),
                });
                if let Some(around) = &around {
                    life.around
                        .push(around.strain((life.ends, life.direction), &motions, step));
                }
            }
        }
        for life in &mut lives.of_bonds {
            life.complete(run, &lives.stored_steps, loading.follows_path);
        }
        Ok(lives)
    }
}

impl Limit {
    fn from_criterion(criterion: &StoredCriterion, pair: usize) -> Option<Self> {
        let measure = Measure::ALL
            .into_iter()
            .find(|it| it.word() == criterion.measure)?;
        let parameter = criterion.parameter.get(pair).copied();
        Some(Self {
            name: criterion.name.clone(),
            measure,
            limit: criterion.limit[pair],
            coefficients: criterion.coefficients.iter().map(|it| it[pair]).collect(),
            after: AfterLimit::from_text(&criterion.after, parameter.into_iter().collect())?,
        })
    }

    /// The criterion's measure of a deformation, with the strain of the points around the bond.
    pub(super) fn measure(
        &self,
        deformation: &BondDeformation,
        around: Option<StrainAround>,
    ) -> f64 {
        let coefficients = &self.coefficients;
        self.measure.value(deformation, coefficients, || {
            Moduli::from_coefficients(coefficients).stress_across(deformation.stretch(), around)
        })
    }
}

impl BondHistory {
    fn begin(run: &StoredRun, pair: usize) -> Result<Self, Error> {
        let model = &run.model;
        let ends = model.bonds.ends[pair];
        let [a, b] = ends.map(|end| model.positions[end as usize]);
        let along = [0, 1, 2].map(|axis| b[axis] - a[axis]);
        let length = along[0].hypot(along[1]).hypot(along[2]);
        let limit = |criterion: &StoredCriterion| {
            Limit::from_criterion(criterion, pair).ok_or_else(|| Error::Unreadable {
                path: run.folder.join("criteria.csv"),
                reason: format!(
                    "criterion {} has the measure `{}` and after its limit `{}`, of which one is unknown here",
                    criterion.name, criterion.measure, criterion.after
                ),
            })
        };
        Ok(Self {
            pair,
            ends,
            length,
            direction: along.map(|component| component / length),
            limits: model.criteria.iter().map(limit).collect::<Result<_, _>>()?,
            deformation: Vec::new(),
            around: Vec::new(),
            n_intact: 0,
            breakage: None,
            nearest: None,
        })
    }

    /// Deformation of the bond for criteria, from the motions of all points, without thermal strain.
    fn deformed(&self, run: &StoredRun, motions: &Motions) -> BondDeformation {
        let moved = self.ends.map(|end| {
            let end = end as usize;
            (motions.displacement[end], motions.rotation[end])
        });
        let free = (!motions.thermal_strain.is_empty())
            .then(|| motions.thermal_strain.times(1.0).of_bond::<3>(self.ends));
        let [x, y, z] = self.direction;
        if run.model.in_space {
            let bond = Pair::<3, 6>::without_stiffness(self.length, [x, y, z]);
            let ends = moved.map(|([u, v, w], [a, b, c])| [u, v, w, a, b, c]);
            bond.measured(ends, free.as_ref())
        } else {
            let bond = Pair::<2, 3>::without_stiffness(self.length, [x, y]);
            let ends = moved.map(|([u, v, _], [.., turn])| [u, v, turn]);
            bond.measured(ends, free.map(|it| it.resized()).as_ref())
        }
    }

    /// Sets breakage and largest utilisation after all stored steps are read.
    fn complete(&mut self, run: &StoredRun, stored_steps: &[StoredStep], before_breakages: bool) {
        let tags = self.ends.map(|end| run.model.tags[end as usize]);
        let is_own = |it: &&StoredBreak| it.tags == tags || it.tags == [tags[1], tags[0]];
        self.breakage = run.breaks.iter().find(is_own).map(|it| {
            let criterion = self.limits.iter().position(|of| of.name == it.criterion);
            (it.clone(), criterion)
        });
        let is_intact = |stored_step: &&StoredStep| match &self.breakage {
            None => true,
            Some((it, _)) if before_breakages => stored_step.step <= it.at.step,
            Some((it, _)) => stored_step.step < it.at.step,
        };
        self.n_intact = stored_steps.iter().take_while(is_intact).count();
        self.nearest = self
            .nearest_at_breakage()
            .or_else(|| self.nearest_of_run(run))
            .or_else(|| self.nearest_of_stored_steps(stored_steps));
    }

    fn nearest_at_breakage(&self) -> Option<LargestUtilisation> {
        let (broke, criterion) = self.breakage.as_ref()?;
        let criterion = (*criterion)?;
        let limit = &self.limits[criterion];
        Some(LargestUtilisation {
            // The stress around a bond at its breakage is stored only in the table of broken bonds.
            utilisation: match limit.measure.takes_stress() {
                true => broke.utilisation * limit.after.end(0),
                false => (limit.measure(&broke.deformation, None) / limit.limit).max(0.0),
            },
            step: broke.at.step,
            criterion,
        })
    }

    /// Largest utilisation over all steps of the run; `None` where the run did not end.
    fn nearest_of_run(&self, run: &StoredRun) -> Option<LargestUtilisation> {
        let largest = run.model.largest.as_ref()?;
        Some(LargestUtilisation {
            utilisation: largest.utilisation[self.pair],
            step: usize::try_from(largest.step[self.pair]).ok()?,
            criterion: usize::try_from(largest.criterion[self.pair])
                .ok()
                .filter(|criterion| *criterion < self.limits.len())?,
        })
    }

    /// Largest utilisation over the steps with fields.
    fn nearest_of_stored_steps(&self, stored_steps: &[StoredStep]) -> Option<LargestUtilisation> {
        let mut nearest: Option<LargestUtilisation> = None;
        for (place, stored_step) in stored_steps.iter().enumerate().take(self.n_intact) {
            for criterion in 0..self.limits.len() {
                let utilisation = self.utilisation(criterion, place);
                if nearest.is_none_or(|it| utilisation > it.utilisation) {
                    nearest = Some(LargestUtilisation {
                        utilisation,
                        step: stored_step.step,
                        criterion,
                    });
                }
            }
        }
        nearest
    }

    /// The measure of a criterion in a stored step.
    pub(super) fn measure(&self, criterion: usize, stored_step: usize) -> f64 {
        let around = self.around.get(stored_step).copied().flatten();
        self.limits[criterion].measure(&self.deformation[stored_step], around)
    }

    /// Measure over limit of a criterion in a stored step, 0 where the measure is not positive.
    pub(super) fn utilisation(&self, criterion: usize, stored_step: usize) -> f64 {
        (self.measure(criterion, stored_step) / self.limits[criterion].limit).max(0.0)
    }

    /// Softened state of the bond under a criterion at a stored step, zero after its breakage.
    pub(super) fn remaining_softened_state(
        &self,
        criterion: usize,
        stored_steps: &[StoredStep],
        stored_step: usize,
    ) -> Softened {
        let softened = self.softened(criterion, stored_steps, stored_step);
        if stored_step < self.n_intact {
            return softened;
        }
        Softened {
            force: 0.0,
            secant: 0.0,
            ..softened
        }
    }

    /// Softened state of the bond under a criterion at a stored step, from the largest known utilisation up to it.
    pub(super) fn softened(
        &self,
        criterion: usize,
        stored_steps: &[StoredStep],
        stored_step: usize,
    ) -> Softened {
        let limit = &self.limits[criterion];
        let so_far = 0..=stored_step;
        let kappa = so_far.map(|it| self.utilisation(criterion, it));
        let kappa = kappa.fold(0.0, f64::max);
        // The utilisation may have been larger between stored steps.
        let is_past = |it: &LargestUtilisation| {
            it.criterion == criterion && it.step <= stored_steps[stored_step].step
        };
        let nearest = self.nearest.filter(is_past);
        limit
            .after
            .at(0, nearest.map_or(kappa, |it| kappa.max(it.utilisation)))
    }
}

/// A bond with limits and deformations, for tests.
#[cfg(test)]
pub(super) fn life_of(limits: Vec<Limit>, deformation: Vec<BondDeformation>) -> BondHistory {
    BondHistory {
        pair: 0,
        ends: [0, 1],
        length: 1.0,
        direction: [1.0, 0.0, 0.0],
        limits,
        n_intact: deformation.len(),
        deformation,
        around: Vec::new(),
        breakage: None,
        nearest: None,
    }
}

#[cfg(test)]
mod tests {
    use ligament_model::failure::softening::linear;

    use super::*;

    /// mu = (r - kappa)/(r - 1) and omega = mu/kappa of the largest kappa so far, by hand for r = 4.
    #[test]
    fn softening_keeps_to_the_largest_utilisation() {
        let limit = Limit {
            name: "tension".to_owned(),
            measure: Measure::Tension,
            limit: 2.0,
            coefficients: Vec::new(),
            after: AfterLimit::new(linear::LAW, vec![4.0]),
        };
        let stretched = |stretch| BondDeformation::new([stretch, 0.0, 0.0]);
        let mut life = life_of(vec![limit], [1.0, 5.0, -3.0].map(stretched).to_vec());
        let stored_steps = [0, 5, 10].map(|step| StoredStep {
            step,
            load_factor: 0.0,
            displacement: 0.0,
            reaction: 0.0,
            at_rest: true,
        });
        let state = |life: &BondHistory, stored_step| {
            let softened = life.softened(0, &stored_steps, stored_step);
            (softened.force, softened.secant)
        };
        assert_eq!(state(&life, 0), (1.0, 1.0));
        assert_eq!(state(&life, 1), (0.5, 0.2));
        assert_eq!(state(&life, 2), (0.5, 0.2));
        assert_eq!(
            life.nearest_of_stored_steps(&stored_steps)
                .map(|it| it.step),
            Some(5)
        );
        // Between the stored steps it was larger: kappa = 3.
        life.nearest = Some(LargestUtilisation {
            utilisation: 3.0,
            step: 7,
            criterion: 0,
        });
        assert_eq!(state(&life, 1), (0.5, 0.2));
        let (force, secant) = state(&life, 2);
        assert!((force - 1.0 / 3.0).abs() < 1e-15 && (secant - 1.0 / 9.0).abs() < 1e-15);
    }
}
