//! Records of a run, and the observer that receives them with messages to the user.

use ligament_model::Bonds;
use ligament_model::element::BondDeformation;
use ligament_model::failure::CriteriaInState;
use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::balanced::Balanced;
use crate::connectivity::Fragments;
use crate::contact::{ContactReading, RigidRates, RigidState};
use crate::costs::Costs;
use crate::load_program::LoadProgram;
use crate::serial::Sink;
use crate::softened::{FarthestSoftened, SoftenedOfAll};
use crate::state::State;

pub use crate::termination::Termination;
use crate::user_message::Message;

/// Record of a load step at rest (or where the run was stopped), or of an event of the exact path: the state at the load at which
/// the next bonds break, just before breakage.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct StepRecord {
    /// Number of the step; 0 for the unloaded body.
    pub step: usize,
    /// Load factor; in a programme of stages the completed share of the stage.
    pub load_factor: f64,
    /// Index of the part of the programme of stages; 0 without one.
    pub part: usize,
    /// Factors of the loads of a programme of stages; empty without one.
    pub factors: Vec<f64>,
    /// Displacement of the control load along its direction, m; rad with a couple, m^3 with a pressure.
    pub displacement: f64,
    /// Force of the control load along its direction, N; a couple, N m, or a pressure, Pa.
    pub reaction: f64,
    /// Energy stored in the bonds, J.
    pub stored_energy: f64,
    /// Energy released by all breakages so far, J.
    pub released_energy: f64,
    /// Energy dissipated by the laws of the bonds so far, J; for a brittle bond the energy stored at its limit. Energy released
    /// beyond that became kinetic.
    pub dissipated_energy: f64,
    /// Energies of contact; None without friction and contact between surfaces, and in a motion, where [`InMotion`] has them.
    pub contact: Option<ContactAtRest>,
    /// Work done by supports and loads so far, J.
    pub external_work: f64,
    /// Lower bound of the scale of energy errors, J: energy due to rounding and to free thermal expansions.
    pub energy_floor: f64,
    /// Number of broken bonds so far.
    pub broken_bonds: usize,
    /// Number of bonds broken in this step; on the exact path those that break at this load, not yet included in `broken_bonds`.
    pub broken_in_step: usize,
    /// Largest utilisation of an intact bond: measure over limit, s/s_0 for most criteria.
    pub largest_ratio: f64,
    /// Number of rounds of breaking in this step.
    pub rounds: usize,
    /// Number of solves in this step.
    pub solves: usize,
    /// Number of connected parts of the body.
    pub fragments: usize,
    /// Whether no bond was left to break. A step that is not at rest shows the last equilibrium before the run ended.
    pub at_rest: bool,
    /// Number of negative eigenvalues of the stiffness; 0 where it is positive definite.
    pub negative_eigenvalues: usize,
    /// Number of pairs of points across cracks that carry pressure; 0 where faces do not close.
    pub closed_pairs: usize,
    /// Forces of each boundary group on the body, and moments on its points where points have rotations, shape (n_groups,
    /// n_components), N and N m.
    pub group_forces: Vec<Vec<f64>>,
    /// Values of the probes.
    pub probes: Vec<f64>,
    /// Time steps and energies of a motion, whose load factor is the time; None in statics.
    pub motion: Option<InMotion>,
    /// Resultants of each contact between surfaces.
    pub contacts: Vec<ContactReading>,
    /// State of each rigid body.
    pub rigid_bodies: Vec<RigidState>,
}

/// Energies of contact in statics.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct ContactAtRest {
    /// Energy stored in contacts between surfaces, J.
    pub contact_energy: f64,
    /// Energy that friction and the begin and end of contacts between surfaces have taken so far, J.
    pub friction_energy: f64,
}

/// Time steps and energies of a motion.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct InMotion {
    /// Number of time steps so far.
    pub time_steps: usize,
    /// Energy of the body at time zero, J: of its first velocities and of a static preload.
    pub initial_energy: f64,
    /// Kinetic energy of displacements and rotations, J; with central differences 1/2 v^T M v' with the velocities in the middles of the steps
    /// before and after, which the scheme conserves.
    pub kinetic_energy: f64,
    /// Energy that damping and dashpots have taken so far, J.
    pub damping_energy: f64,
    /// Energy stored in contacts between surfaces, J.
    pub contact_energy: f64,
    /// Energy that friction and the begin and end of contacts have taken so far, J.
    pub friction_energy: f64,
}

impl InMotion {
    /// Energies that can never be negative, with their names, J.
    pub fn taken(&self) -> [(&'static str, f64); 3] {
        [
            ("damping", self.damping_energy),
            ("contact", self.contact_energy),
            ("friction", self.friction_energy),
        ]
    }

    /// Energy besides the stored and released energies of the bonds, less the energy at time zero, J.
    fn beside_bonds(&self) -> f64 {
        let now =
            self.kinetic_energy + self.damping_energy + self.contact_energy + self.friction_energy;
        now - self.initial_energy
    }
}

impl StepRecord {
    /// [Energy imbalance](Self::missing_energy) over the [energy put in](Self::energy_put_in), with the sign of a negative work; 0 where no
    /// energy was put in.
    pub fn energy_error(&self) -> f64 {
        let put_in = self.energy_put_in();
        let is_negative_work = put_in == -self.external_work;
        match put_in == 0.0 {
            true => 0.0,
            false if is_negative_work => self.missing_energy() / self.external_work,
            false => self.missing_energy() / put_in,
        }
    }

    /// Size of the external work and, in a motion, the energy at time zero, but at least the energy floor, J.
    pub fn energy_put_in(&self) -> f64 {
        let at_start = self.motion.map_or(0.0, |it| it.initial_energy.max(0.0));
        (self.external_work.abs() + at_start).max(self.energy_floor)
    }

    /// External work minus stored and released energy and minus the energies of contact and friction, J; in a motion also minus the kinetic
    /// energy and the energy of damping, plus the energy at time zero.
    pub fn missing_energy(&self) -> f64 {
        let of_bonds = self.external_work - self.stored_energy - self.released_energy;
        let of_bonds = self.contact.map_or(of_bonds, |it| {
            of_bonds - it.contact_energy - it.friction_energy
        });
        self.motion
            .map_or(of_bonds, |it| of_bonds - it.beside_bonds())
    }
}

/// Record of a bond that broke.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct BreakRecord {
    /// Position in the order of all breakages, from 1.
    pub order: usize,
    /// Load step.
    pub step: usize,
    /// Round of breaking in the step, from 1.
    pub round: usize,
    /// Load factor.
    pub load_factor: f64,
    /// Displacement of the control load just before the breakage, m.
    pub displacement: f64,
    /// Force of the control load just before the breakage, N.
    pub reaction: f64,
    /// Global number of the bond.
    pub bond: u32,
    /// Numbers in the body of the ends A < B of the bond.
    pub ends: [u32; 2],
    /// Number of the criterion by which the bond broke.
    pub criterion: usize,
    /// Measure of the criterion over the limit when the bond broke, s/s_0 for most criteria.
    pub ratio: f64,
    /// Deformation of the bond at its breakage.
    pub deformation: BondDeformation,
}

/// Largest overlap of crack faces in a run.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct LargestOverlap {
    /// Depth of the overlap, m.
    pub depth: f64,
    /// Points on either side of the crack.
    pub ends: [u32; 2],
    /// Load step, or event.
    pub step: usize,
}

/// Equilibrium state, for observers that read fields.
///
/// On a divided body ([`Topology::subdomain`](ligament_model::Topology::subdomain)), displacements and forces are given at
/// all points, bonds are the local ones, and quantities computed from the bonds of a point are valid at owned points alone. Any
/// observer may read a view without the other processes.
pub struct View<'a> {
    /// Bond system of the state.
    pub system: &'a dyn Bonds,
    /// State of the system.
    pub state: &'a State,
    /// Deformations and forces.
    pub balanced: &'a Balanced,
    /// Supports and loads.
    pub loads: &'a dyn LoadProgram,
    /// Failure criteria; empty in an elastic analysis.
    pub criteria: &'a CriteriaInState<'a>,
    /// Connected parts.
    pub fragments: &'a Fragments,
    /// Accumulated costs of the equations.
    pub costs: &'a Costs,
    /// Softened bonds over all processes.
    pub softened: SoftenedOfAll,
    /// Whether the run ends with this state.
    pub is_last: bool,
    /// Velocities and accelerations of a motion; None in statics.
    pub motion: Option<Rates<'a>>,
    /// Whether the whole body is known; otherwise motions and forces are known only at supported and loaded points, and there are
    /// no deformations.
    pub is_whole: bool,
}

/// Velocities and accelerations of the points.
#[derive(Debug, Clone, Copy)]
pub struct Rates<'a> {
    /// Velocities, shape (n_degrees_of_freedom), m/s and rad/s.
    pub velocity: &'a [f64],
    /// Accelerations, shape (n_degrees_of_freedom), m/s^2 and rad/s^2.
    pub acceleration: &'a [f64],
    /// Rates of the rigid bodies.
    pub rigid: &'a [RigidRates],
}

impl View<'_> {
    /// Number of unbroken bonds whose force has begun to fall beyond a limit.
    pub fn softened_bonds(&self) -> usize {
        self.softened.bonds
    }

    /// Bond farthest beyond its limit under a softening law.
    pub fn farthest_softened(&self) -> Option<FarthestSoftened> {
        self.softened.farthest
    }
}

/// Failure of an observer.
#[derive(Debug, Error)]
#[error(transparent)]
pub struct ObserverError(#[from] pub Box<dyn std::error::Error + Send + Sync>);

/// State of a run from which it can be restarted, with the same bits.
///
/// Its checkpoint contains, as bytes, all data that do not follow from the problem.
pub struct Moment<'a> {
    /// Reason why the run ends here, if it does.
    pub end: Option<&'a Termination>,
    /// Writes the checkpoint.
    pub checkpoint: &'a dyn Fn(&mut dyn Sink),
}

impl Moment<'_> {
    /// The checkpoint in memory.
    pub fn bytes(&self) -> Vec<u8> {
        let mut bytes = Vec::new();
        (self.checkpoint)(&mut bytes);
        bytes
    }
}

/// Continuation of a run after a restart point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Onward {
    /// The run continues.
    Go,
    /// The run ends here.
    Stop,
}

/// Observer of a run. All methods except [`Observer::step`] have defaults.
pub trait Observer {
    /// Called once, before a part of a run that may take long.
    fn begins(&mut self, _ahead: Ahead) {}

    /// Called after a Newton-Raphson iteration.
    fn iteration(
        &mut self,
        _iteration: usize,
        _residual: f64,
        _stored_energy: f64,
    ) -> Result<(), ObserverError> {
        Ok(())
    }

    /// Called at the beginning of a round of breaking, before its iterations.
    fn round(
        &mut self,
        _step: usize,
        _round: usize,
        _load_factor: f64,
        _broken: usize,
    ) -> Result<(), ObserverError> {
        Ok(())
    }

    /// Called after bonds broke.
    fn broke(&mut self, _records: &[BreakRecord]) -> Result<(), ObserverError> {
        Ok(())
    }

    /// Called with a message to the user.
    fn message(&mut self, _message: Message) -> Result<(), ObserverError> {
        Ok(())
    }

    /// Called before [`Observer::moment`], with the reason if the run ends there; returns whether the observer writes its
    /// checkpoint.
    ///
    /// On a divided body all processes take part if one writes it, and rank 0 alone receives its bytes.
    fn asks(&mut self, _end: Option<&Termination>) -> Result<bool, ObserverError> {
        Ok(true)
    }

    /// Called where the run can be restarted later; returns whether the run continues now.
    fn moment(&mut self, _moment: &Moment<'_>) -> Result<Onward, ObserverError> {
        Ok(Onward::Go)
    }

    /// Whether the observer reads the body itself after a step, and not only its record.
    ///
    /// Where it does not, the exact path may delay updates of parts of the body, and the view is not [whole](View::is_whole). Load steps may
    /// delay them between two records in any case; their views are whole.
    fn looks(&self, _step: usize) -> bool {
        true
    }

    /// Whether the observer reads the body in an equilibrium of a load step in which `broken` bonds broke so far, before others break.
    ///
    /// On a divided body all processes take part if one reads it.
    fn looks_between_breakages(
        &mut self,
        _step: usize,
        _broken: usize,
    ) -> Result<bool, ObserverError> {
        Ok(false)
    }

    /// Called in an equilibrium between the breakages of a load step that an observer reads; its record is no row of the history.
    fn between_breakages(
        &mut self,
        _record: &StepRecord,
        _view: &View<'_>,
    ) -> Result<(), ObserverError> {
        Ok(())
    }

    /// Called at the end of a load step or event.
    fn step(&mut self, record: &StepRecord, view: &View<'_>) -> Result<(), ObserverError>;
}

/// Work that a run is about to do.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Ahead {
    /// Time steps of a motion.
    TimeSteps {
        /// Number of steps.
        count: usize,
        /// Whether each solves equations.
        is_implicit: bool,
    },
    /// Solutions with a factor of the stiffness.
    Factor {
        /// Multiplications of the factorisation.
        multiplications: f64,
    },
}
