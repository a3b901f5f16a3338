//! Problem: a body with its loads, criteria and probes.

use std::sync::Arc;

use ligament_model::Bonds;
use ligament_model::failure::{Criteria, CriteriaInState};
use ligament_model::stress::point_strain::Motion;
use rayon::prelude::*;

use crate::balanced::Balanced;
use crate::contact::ContactProblem;
use crate::load_program::LoadProgram;
use crate::probe::{Notch, Probe};
use crate::result_fields::Solution;
use crate::solver::SolverSettings;
use crate::state::State;

/// Relative change of energy below which an elastic solution is in equilibrium (NHPD's value).
pub const ELASTIC_ENERGY_TOLERANCE: f64 = 1e-4;

/// Problem: bonds, loads, criteria, solver and probes. A copy shares its data.
#[derive(Clone)]
pub struct Problem {
    /// Bonds between the points of the body.
    pub system: Arc<dyn Bonds>,
    /// Failure criteria; empty in an elastic analysis.
    pub criteria: Arc<Criteria>,
    /// Supports and loads.
    pub loads: Arc<dyn LoadProgram>,
    /// Settings of the solver of the equations.
    pub solver: SolverSettings,
    /// Probes of the history.
    pub probes: Arc<[Probe]>,
    /// Notches, slots and pre-cracks of the body.
    pub notches: Arc<[Notch]>,
    /// Coefficient of friction on faces of cracks that close.
    pub face_friction: f64,
    /// Contacts between surfaces and with rigid bodies in equilibria.
    pub contact: ContactProblem,
}

impl Problem {
    /// Whether contact takes energy in the equilibria of a body at rest.
    pub fn has_contact_at_rest(&self) -> bool {
        (self.face_friction > 0.0 || !self.contact.is_empty()) && !self.loads.is_in_time()
    }

    /// Whether parts of the body may be pressed against each other or against rigid bodies.
    pub fn may_press(&self) -> bool {
        self.system.faces_close || !self.contact.is_empty()
    }

    /// The criteria with the limits and stresses that the bonds have in an equilibrium.
    pub fn criteria_in(&self, state: &State, balanced: &Balanced) -> CriteriaInState<'_> {
        let deformations = &balanced.deformations;
        let stresses = balanced.stresses.get_or_init(|| {
            let sound = state.softening.sound(&state.intact);
            let motion = self.motion(state, &sound);
            self.criteria.stresses(&*self.system, motion, deformations)
        });
        let criteria = state.softening.criteria(&self.criteria);
        criteria.in_state(stresses, &state.intact, deformations)
    }

    /// An equilibrium state with its criteria, from which fields and probes are read.
    pub(crate) fn solution<'a>(&'a self, state: &'a State, balanced: &'a Balanced) -> Solution<'a> {
        Solution {
            system: &*self.system,
            criteria: &self.criteria,
            state,
            balanced,
            loads: &*self.loads,
            motion: None,
        }
    }

    /// Starts the softening of bonds whose stress in an equilibrium has reached the strength; returns whether there are any. This changes
    /// no force: a bond begins at the deformation at which its stress was the strength, and softens when equilibrium is sought again.
    pub(crate) fn begin_softening(&self, state: &mut State, balanced: &Balanced) -> bool {
        let begun = self.beginning(state, balanced);
        let some = self.system.subdomain.any(begun.is_some());
        if let Some(begun) = begun {
            state.softening.begin(&self.criteria, begun);
        }
        some
    }

    /// The deformations at which bonds began to soften by the stress around them, including the bonds that begin in an equilibrium; None
    /// where none begins.
    fn beginning(&self, state: &State, balanced: &Balanced) -> Option<Vec<Vec<f64>>> {
        let begun = state.softening.begun();
        if begun.iter().all(Vec::is_empty) {
            return None;
        }
        let sound = state.softening.sound(&state.intact);
        let (motion, system) = (self.motion(state, &sound), &*self.system);
        let deformations = &balanced.deformations;
        self.criteria.beginning(begun, system, motion, deformations)
    }

    /// The criteria in an equilibrium of the body before any bond began to soften.
    pub(crate) fn criteria_before_softening(
        &self,
        state: &State,
        balanced: &Balanced,
    ) -> CriteriaInState<'_> {
        let motion = self.motion(state, &state.intact);
        let (system, deformations) = (&*self.system, &balanced.deformations);
        let criteria = self.criteria_in(state, balanced);
        criteria.before_softening(system, motion, deformations)
    }

    /// Largest utilisation of the intact bonds in an equilibrium; 0 without criteria.
    pub(crate) fn largest_ratio(&self, state: &State, balanced: &Balanced) -> f64 {
        self.largest_ratio_by(&self.criteria_in(state, balanced), state, balanced)
    }

    /// Largest utilisation of the intact bonds by some criteria.
    pub(crate) fn largest_ratio_by(
        &self,
        criteria: &CriteriaInState<'_>,
        state: &State,
        balanced: &Balanced,
    ) -> f64 {
        let ratio = (&state.intact, balanced.deformations.measured())
            .into_par_iter()
            .enumerate()
            .filter(|(_, (intact, _))| **intact)
            .map(|(bond, (_, deformation))| criteria.utilisation(bond, deformation))
            .reduce(|| 0.0, f64::max);
        self.system.subdomain.max(ratio)
    }

    /// Displacement and force of the control load in an equilibrium, m and N.
    pub(crate) fn control(&self, state: &State, balanced: &Balanced) -> (f64, f64) {
        let (loads, load_factor) = (&self.loads, state.load_factor);
        (
            loads.control_displacement(load_factor, &state.displacement),
            loads.control_force(load_factor, &balanced.internal),
        )
    }

    fn motion<'a>(&'a self, state: &'a State, intact: &'a [bool]) -> Motion<'a> {
        Motion {
            intact,
            displacement: &state.displacement,
            expansion: self.loads.thermal_strain(state.load_factor),
        }
    }
}
