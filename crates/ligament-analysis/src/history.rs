//! What a run reports while it goes on.

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
use crate::serial;
use crate::softened::{FarthestSoftened, SoftenedOfAll};
use crate::state::State;

pub use crate::termination::Termination;

/// One load step at rest (or where the run was stopped), or one event of the exact path: the state at the load at which
/// the next bonds break, just before they do.
#[derive(Debug, Clone, PartialEq)]
pub struct StepRecord {
    /// Number of the step; 0 is the unloaded body.
    pub step: usize,
    /// Load factor; in a programme of stages the share of the stage that is over.
    pub load_factor: f64,
    /// Part of the programme of stages; 0 without one.
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
    /// Energy that the laws of the bonds took for good so far, J: of a brittle bond what it stored at its limit. What was released
    /// beyond that went into motion.
    pub dissipated_energy: f64,
    /// Work done by supports and loads so far, J.
    pub external_work: f64,
    /// Energy below which work is no measure of what the energies miss, J: rounding, and that of expansions which the body gives way to.
    pub energy_floor: f64,
    /// Broken bonds so far.
    pub broken_bonds: usize,
    /// Bonds broken in this step; on the exact path those that break at this load, and are not yet among `broken_bonds`.
    pub broken_in_step: usize,
    /// Largest utilisation of an intact bond: measure over limit, s/s_0 for most criteria.
    pub largest_ratio: f64,
    /// Rounds of breaking in this step.
    pub rounds: usize,
    /// Solves with a factor in this step.
    pub solves: usize,
    /// Connected parts of the body.
    pub fragments: usize,
    /// Whether no bond was left to break. A step that is not at rest shows the last equilibrium before the run ended.
    pub at_rest: bool,
    /// Negative eigenvalues of the stiffness; 0 where it is positive definite.
    pub negative_eigenvalues: usize,
    /// Pairs of points across cracks that carry pressure; 0 where faces do not close.
    pub closed_pairs: usize,
    /// Forces that each group of the boundary exerts on the body, and the moments on its points, as far as points turn, shape
    /// (n_groups, n_components).
    pub group_forces: Vec<Vec<f64>>,
    /// Values of the probes.
    pub probes: Vec<f64>,
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
});

impl StepRecord {
    /// External work - stored - released energy over the external work, or the energy floor where that is larger: what the energy
    /// balance misses; 0 without work.
    pub fn energy_error(&self) -> f64 {
        let scale = if self.external_work.abs() < self.energy_floor {
            self.energy_floor
        } else {
            self.external_work
        };
        if scale == 0.0 {
            0.0
        } else {
            self.missing_energy() / scale
        }
    }

    /// External work - stored - released energy, J.
    pub fn missing_energy(&self) -> f64 {
        self.external_work - self.stored_energy - self.released_energy
    }
}

/// One bond that broke.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BreakRecord {
    /// Place in the order of all breakages, from 1.
    pub order: usize,
    /// Load step.
    pub step: usize,
    /// Round of breaking in the step, from 1.
    pub round: usize,
    /// Load factor.
    pub load_factor: f64,
    /// Displacement of the control load just before, m.
    pub displacement: f64,
    /// Force of the control load just before, N.
    pub reaction: f64,
    /// Number of the bond among all bonds of the body.
    pub bond: u32,
    /// Ends A < B of the bond.
    pub ends: [u32; 2],
    /// Number of the criterion by which the bond broke.
    pub criterion: usize,
    /// Measure of the criterion over the limit when the bond broke, s/s_0 for most criteria.
    pub ratio: f64,
    /// Deformation of the bond then.
    pub deformation: BondDeformation,
}

/// The faces that passed through each other farthest in a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LargestOverlap {
    /// How far, m.
    pub depth: f64,
    /// Points on either side.
    pub ends: [u32; 2],
    /// Load step, or event.
    pub step: usize,
}

serial!(LargestOverlap { depth, ends, step });

/// Something that a user should know.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum Notice {
    /// Supports and loads do not hold the intact body, or a part of it: gauges do.
    #[error(
        "{} points are not held by supports and loads: {} rigid motions of theirs are free (first at point {})",
        .0.points, .0.motions.len(), .0.first
    )]
    FreeBody(FreeBody),
    /// Points came loose, and rigid motions of theirs are held.
    #[error(
        "step {step}: {points} points came loose ({motions} rigid motions held from now on, first at point {first})"
    )]
    PartsDetached {
        /// Load step.
        step: usize,
        /// Points of the loose parts.
        points: usize,
        /// Motions held.
        motions: usize,
        /// First point of the first loose part.
        first: u32,
    },
    /// Points without stiffness in some direction are held there.
    #[error("step {step}: {} mechanism(s) held, first at point {}", points.len(), points[0])]
    Mechanisms {
        /// Load step.
        step: usize,
        /// Points of the degrees of freedom held.
        points: Vec<u32>,
    },
    /// The stored energy became negative, and the run goes on because it was asked to.
    #[error(
        "step {step}: the stored energy became negative: results from here on are not those of a stable body"
    )]
    NegativeEnergy {
        /// Load step.
        step: usize,
    },
    /// Work and energies do not balance.
    #[error(
        "step {step}: work, stored and released energy miss each other by {error:.1e} of the work: results from here on are not to be \
         trusted"
    )]
    EnergyUnbalanced {
        /// Load step.
        step: usize,
        /// What is missing, relative to the work.
        error: f64,
    },
    /// Bonds have dissipated more than was spent on the body.
    #[error(
        "step {step}: bonds have dissipated more than the work that was done on the body less what it stores, by {share:.1e} of the work: \
         the load steps are too coarse for the way that bonds soften, take smaller ones"
    )]
    DissipatedBeyondWork {
        /// Load step.
        step: usize,
        /// What they dissipated beyond it, relative to the largest work.
        share: f64,
    },
    /// A force has passed what the body carries.
    #[error(
        "step {step}: no larger force has an equilibrium any more; to follow the body past its peak, let a probe control a stage (its \
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
        /// Negative eigenvalues.
        negative: usize,
        /// Expected ones.
        expected: usize,
    },
    /// Faces of cracks pass through each other.
    #[error(
        "step {}: the faces of a crack pass through each other, by {:.2e} m between points {} and {}, and nothing keeps them from \
         it; `closing` lets them carry pressure", .0.step, .0.depth, .0.ends[0], .0.ends[1]
    )]
    Overlap(LargestOverlap),
    /// The body breaks in the first load step.
    #[error(transparent)]
    AtOnce(AtOnce),
    /// The loads move the body as a whole.
    #[error(
        "nothing resists the loads: they move the body as a whole and do not deform it, so that all forces are rounding; hold a \
         part of it by a support"
    )]
    Undeformed,
}

/// A state in equilibrium, for observers that want fields.
///
/// Where processes share the body ([`BondTopology::subdomain`](ligament_model::BondTopology::subdomain)), displacements and forces are given
/// at all points, bonds are those that this process stores, and what follows from the bonds of a point is right at owned points alone. Any
/// observer may read a view without the other processes.
pub struct View<'a> {
    /// The system.
    pub system: &'a dyn Bonds,
    /// State of the system.
    pub state: &'a State,
    /// Deformations and forces.
    pub balanced: &'a Balanced,
    /// Supports and loads.
    pub loads: &'a dyn LoadProgram,
    /// Failure criteria; none in an elastic analysis.
    pub criteria: &'a Criteria,
    /// Connected parts.
    pub fragments: &'a Fragments,
    /// What the equations have cost so far.
    pub costs: &'a Costs,
    /// What softened over all processes.
    pub softened: SoftenedOfAll,
    /// Whether the run ends with this state.
    pub is_last: bool,
    /// Whether all of the body is known: otherwise motions and forces are those of supported and loaded points alone, and there are no
    /// deformations.
    pub is_whole: bool,
}

impl View<'_> {
    /// Number of the unbroken bonds whose force has begun to fall beyond a limit.
    pub fn softened_bonds(&self) -> usize {
        self.softened.bonds
    }

    /// The bond farthest beyond its limit under a law that softens.
    pub fn farthest_softened(&self) -> Option<FarthestSoftened> {
        self.softened.farthest
    }
}

/// Failure of an observer.
#[derive(Debug, Error)]
#[error(transparent)]
pub struct ObserverError(#[from] pub Box<dyn std::error::Error + Send + Sync>);

/// A moment of a run from which it can go on later, to the same bits.
///
/// The checkpoint of it are bytes, in which stands all that is not made of the problem alone.
pub struct Moment<'a> {
    /// The reason why the run ends here, if it does.
    pub end: Option<&'a Termination>,
    /// Makes the checkpoint of the moment.
    pub checkpoint: &'a dyn Fn() -> Vec<u8>,
}

/// What becomes of a run after a moment.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Onward {
    /// The run goes on.
    Go,
    /// The run stops here.
    Stop,
}

/// Watches a run. All methods but [`Observer::step`] may be left as they are.
pub trait Observer {
    /// A Newton-Raphson iteration was done.
    fn iteration(
        &mut self,
        _iteration: usize,
        _residual: f64,
        _stored_energy: f64,
    ) -> Result<(), ObserverError> {
        Ok(())
    }

    /// The driver enters a round: later iterations belong to it.
    fn round(
        &mut self,
        _step: usize,
        _round: usize,
        _load_factor: f64,
        _broken: usize,
    ) -> Result<(), ObserverError> {
        Ok(())
    }

    /// Bonds broke.
    fn broke(&mut self, _records: &[BreakRecord]) -> Result<(), ObserverError> {
        Ok(())
    }

    /// Something happened that a user should know.
    fn notice(&mut self, _notice: &Notice) -> Result<(), ObserverError> {
        Ok(())
    }

    /// A moment comes next from which the run could go on, or in which it ends for a reason; tells whether its checkpoint is asked for.
    ///
    /// Where processes share the body out all of them make it if one asks, and one that did not may find it empty.
    fn asks(&mut self, _end: Option<&Termination>) -> Result<bool, ObserverError> {
        Ok(true)
    }

    /// The run could go on later from here; tells whether it goes on now.
    fn moment(&mut self, _moment: &Moment<'_>) -> Result<Onward, ObserverError> {
        Ok(Onward::Go)
    }

    /// Whether the observer looks at the body itself after a step, and not at its record alone.
    ///
    /// Where it does not, the exact path may leave parts of the body behind, and the view is not [whole](View::is_whole).
    fn looks(&self, _step: usize) -> bool {
        true
    }

    /// A load step ended.
    fn step(&mut self, record: &StepRecord, view: &View<'_>) -> Result<(), ObserverError>;
}
