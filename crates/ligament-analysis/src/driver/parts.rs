//! Transitions of a run between the parts of a programme.

use super::path::Path;
use crate::bond_numbers::sum_over_bonds;
use crate::equilibrium::{ControlledQuantity, Dissipation, Target};
use crate::history::StepRecord;
use crate::load_program::{LoadCourse, PartControl};

impl Path<'_> {
    /// Begins the part of this index of a programme at the end of the present part.
    pub(super) fn begin_part(&mut self, part: usize) {
        let Some(here) = self.problem.loads.course().filter(|it| it.part != part) else {
            return;
        };
        let start = here.factors(self.state.load_factor);
        let next = LoadCourse::new(here.programme.clone(), part, &start);
        let (begins, _) = next.programme.parts[part].span;
        let Some(loads) = self.problem.loads.in_course(next) else {
            return;
        };
        self.state.load_factor = begins;
        self.energies.begin_part(begins);
        (self.course.part, self.course.part_start) = (part, start);
        let control = loads.course().and_then(LoadCourse::control);
        let value = control.map(|it| match it {
            PartControl::Motion(motion) => motion.value(&self.state.displacement),
            PartControl::DissipatedEnergy { .. } => self.dissipated_energy(),
        });
        self.course.control_start = value.unwrap_or(0.0);
        self.problem.loads = loads.clone();
        self.equilibrium.load_with(loads);
    }

    /// Prescribes the state of the following equilibria at a share of the present part: by its controlling motion or energy, or
    /// else by the load factor of the state.
    pub(super) fn aim(&mut self, share: f64) {
        let loads = &self.problem.loads;
        let control = (loads.course()).and_then(|it| Some((it, it.control()?)));
        let (subdomain, layout) = (
            self.problem.system.subdomain(),
            self.problem.system.layout(),
        );
        let held = control.and_then(|(course, control)| {
            let start = self.course.control_start;
            let way = control.end() - start;
            let rate = loads.in_course(course.rate())?;
            let value = start + share * way;
            Some(match control {
                PartControl::Motion(motion) => ControlledQuantity::Motion(Target {
                    subdomain: subdomain.clone(),
                    weights: Target::owned_weights(
                        subdomain,
                        layout,
                        motion.weights.iter().copied(),
                    ),
                    rate,
                    value,
                    way,
                }),
                PartControl::DissipatedEnergy { .. } => ControlledQuantity::Energy(Dissipation {
                    step: way / course.n_steps() as f64,
                    energy: value,
                    rate,
                }),
            })
        });
        self.equilibrium.aim(held);
    }

    /// Energy dissipated by the bonds, J.
    pub(super) fn dissipated_energy(&self) -> f64 {
        let dissipated = self.state.dissipated.iter().copied();
        sum_over_bonds(&*self.problem.system, dissipated)
    }

    /// Whether a motion or energy controls the present part instead of the load factor.
    pub(super) fn is_controlled(&self) -> bool {
        let course = self.problem.loads.course();
        course.and_then(LoadCourse::control).is_some()
    }

    /// Load factor of the control load in a record.
    pub(super) fn control_factor(&self, record: &StepRecord) -> f64 {
        match self.problem.loads.course() {
            Some(loads) => record.factors[loads.programme.control],
            None => record.load_factor,
        }
    }
}
