//! Records and notices of a run, and the observer that receives them.

use ligament_model::Bonds;
use ligament_model::element::BondDeformation;
use ligament_model::failure::Criteria;
use thiserror::Error;

use crate::at_once::AtOnce;
use crate::balanced::Balanced;
use crate::connectivity::Fragments;
use crate::costs::Costs;
use crate::gauges::FreeBody;
use crate::load_program::LoadProgram;
use crate::motion::contact::{ContactReading, RigidState};
use crate::serial;
use crate::serial::Sink;
use crate::softened::{FarthestSoftened, SoftenedOfAll};
use crate::state::State;

pub use crate::ahead::Ahead;
pub use crate::termination::Termination;

/// Record of a load step at rest (or where the run was stopped), or of an event of the exact path: the state at the load at which
/// the next bonds break, just before breakage.
#[derive(Debug, Clone, PartialEq)]
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
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ContactAtRest {
    /// Energy stored in contacts between surfaces, J.
    pub contact_energy: f64,
    /// Energy that friction and the begin and end of contacts between surfaces have taken so far, J.
    pub friction_energy: f64,
}

serial!(ContactAtRest {
    contact_energy,
    friction_energy
});

/// Time steps and energies of a motion.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
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
    /// Energy that friction and the birth and end of contacts have taken so far, J.
    pub friction_energy: f64,
}

serial!(InMotion {
    time_steps,
    initial_energy,
    kinetic_energy,
    damping_energy,
    contact_energy,
    friction_energy,
});

impl InMotion {
    /// Energies that are positive or zero, whatever happens, by their names, J.
    pub fn taken(&self) -> [(&'static str, f64); 3] {
        [
            ("damping", self.damping_energy),
            ("contact", self.contact_energy),
            ("friction", self.friction_energy),
        ]
    }

    /// Energy at work beside the stored and released energies of the bonds, less the energy at time zero, J.
    fn beside_bonds(&self) -> f64 {
        let now =
            self.kinetic_energy + self.damping_energy + self.contact_energy + self.friction_energy;
        now - self.initial_energy
    }
}

serial!(StepRecord {
    step,
    load_factor,
    part,
    factors,
    displacement,
    reaction,
    stored_energy,
    released_energy,
    dissipated_energy,
    contact,
    external_work,
    energy_floor,
    broken_bonds,
    broken_in_step,
    largest_ratio,
    rounds,
    solves,
    fragments,
    at_rest,
    negative_eigenvalues,
    closed_pairs,
    group_forces,
    probes,
    motion,
    contacts,
    rigid_bodies,
});

impl StepRecord {
    /// [Energy imbalance](Self::missing_energy) over the external work or the energy floor, whichever is larger; 0 without work. In a
    /// motion the energy at time zero counts as work.
    pub fn energy_error(&self) -> f64 {
        let at_start = self.motion.map_or(0.0, |it| it.initial_energy);
        let scale = if self.external_work.abs() + at_start < self.energy_floor {
            self.energy_floor
        } else if at_start > 0.0 {
            self.external_work.abs() + at_start
        } else {
            self.external_work
        };
        if scale == 0.0 {
            0.0
        } else {
            self.missing_energy() / scale
        }
    }

    /// External work - stored - released energy - that of contact and friction, J; in a motion the kinetic energy, the energies of damping, contact and friction count as
    /// well, and the energy at time zero.
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
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LargestOverlap {
    /// Depth of the overlap, m.
    pub depth: f64,
    /// Points on either side of the crack.
    pub ends: [u32; 2],
    /// Load step, or event.
    pub step: usize,
}

serial!(LargestOverlap { depth, ends, step });

/// Notice to the user.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum Notice {
    /// Supports and loads do not fix the intact body or a part of it, so that gauges do.
    #[error(
        "the supports leave a part of {} points free: {} rigid motions (first at point {})",
        .0.points, .0.motions.len(), .0.first
    )]
    FreeBody(FreeBody),
    /// Points became detached, and their rigid motions are fixed.
    #[error(
        "step {step}: {points} points (around point {first}) broke off; {motions} rigid motions are fixed"
    )]
    PartsDetached {
        /// Load step.
        step: usize,
        /// Number of points of the detached parts.
        points: usize,
        /// Number of fixed motions.
        motions: usize,
        /// First point of the first detached part.
        first: u32,
    },
    /// Points without stiffness in some direction are fixed there.
    #[error("step {step}: fixed {} mechanism(s), first at point {}", points.len(), points[0])]
    Mechanisms {
        /// Load step.
        step: usize,
        /// Points of the fixed degrees of freedom.
        points: Vec<u32>,
    },
    /// The stored energy became negative, and the stop rules let the run continue.
    #[error(
        "step {step}: the stored energy is negative: from here on the body is unstable and the results are not valid"
    )]
    NegativeEnergy {
        /// Load step.
        step: usize,
    },
    /// Work and energies do not balance.
    #[error(
        "step {step}: work, stored and released energy differ by {error:.1e} of the work: do not trust the results from here on"
    )]
    EnergyUnbalanced {
        /// Load step.
        step: usize,
        /// Energy imbalance, relative to the work.
        error: f64,
    },
    /// Bonds have dissipated more than the work on the body minus its stored energy.
    #[error(
        "step {step}: bonds have dissipated more than the work minus the stored energy, by {share:.1e} of the work: the load steps are too \
         coarse for the softening; take smaller steps"
    )]
    DissipatedBeyondWork {
        /// Load step.
        step: usize,
        /// Excess of the dissipated energy, relative to the largest work.
        share: f64,
    },
    /// A force has exceeded the peak load of the body.
    #[error(
        "step {step}: there is no equilibrium at a larger force; to follow the body past its peak, let a probe control a stage (its \
         `control`), or follow the exact path"
    )]
    PastPeak {
        /// The last load step.
        step: usize,
    },
    /// The intact model has more negative eigenvalues than its rotations explain.
    #[error(
        "the intact model is unstable: {negative} negative eigenvalues where {expected} are expected; \
         results are not to be trusted (Poisson's ratio too large for this horizon factor)"
    )]
    Unstable {
        /// Number of negative eigenvalues.
        negative: usize,
        /// Expected number of negative eigenvalues.
        expected: usize,
    },
    /// Faces of cracks pass through each other.
    #[error(
        "step {}: the faces of a crack overlap by {:.2e} m between points {} and {}, because they carry no pressure; `closing` lets \
         them", .0.step, .0.depth, .0.ends[0], .0.ends[1]
    )]
    Overlap(LargestOverlap),
    /// A part of a body has turned so far that forces linear in the motions are in error.
    #[error(
        "step {step}: a part of {points} points (around point {first}) has turned by {angle:.2} rad; forces are linear in the motions, so that turning \
         strains it by {:.1e} and costs energy", .angle * .angle / 2.0
    )]
    Turned {
        /// Load step, or row of a motion.
        step: usize,
        /// Number of points.
        points: usize,
        /// First point.
        first: u32,
        /// Angle, rad.
        angle: f64,
    },
    /// The body breaks in the first load step.
    #[error(transparent)]
    AtOnce(AtOnce),
    /// The equilibria ended, and the body moves.
    #[error(
        "time {time:.6e} s: the body loses its balance: a step without inertia would set free more than {share:.1e} of the work, or let a part slip \
         off another one, so that it moves from here on"
    )]
    LostBalance {
        /// Time of the last equilibrium, s.
        time: f64,
        /// Share of the work so far.
        share: f64,
    },
    /// The body came to rest after a motion, and equilibria follow each other again.
    #[error("time {time:.6e} s: the body is at rest again, after a motion of {:.3e} s in which {broken} bonds broke", time - since)]
    AtRest {
        /// Time of the first equilibrium, s.
        time: f64,
        /// Time at which the motion began, s.
        since: f64,
        /// Number of bonds broken in the motion.
        broken: usize,
    },
    /// The loads move the body as a whole, without deformation.
    #[error(
        "nothing resists the loads: they move the body as a whole and do not deform it, so that all forces are rounding; hold a \
         part of it by a support"
    )]
    Undeformed,
}

/// Equilibrium state, for observers that read fields.
///
/// On a divided body ([`BondTopology::subdomain`](ligament_model::BondTopology::subdomain)), displacements and forces are given at
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
    pub criteria: &'a Criteria,
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
    /// Whether the whole body is known; otherwise motions and forces are those of supported and loaded points alone, and there are
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
    /// Called once, before a run does what may take long.
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

    /// Called with a notice to the user.
    fn notice(&mut self, _notice: &Notice) -> Result<(), ObserverError> {
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

    /// Whether the observer reads the body itself after a step, and not its record alone.
    ///
    /// Where it does not, the exact path may delay updates of parts of the body, and the view is not [whole](View::is_whole).
    fn looks(&self, _step: usize) -> bool {
        true
    }

    /// Called at the end of a load step or event.
    fn step(&mut self, record: &StepRecord, view: &View<'_>) -> Result<(), ObserverError>;
}
