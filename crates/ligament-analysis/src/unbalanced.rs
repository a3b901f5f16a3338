//! Reasons why no equilibrium was found.

use std::fmt::{self, Display, Formatter};

use ligament_linalg::FactorError;
use ligament_model::surface::Missed;

use crate::contact::ContactProblem;
use crate::unknowns::Component;

/// Advice to the user for [`Unbalanced::RanksDisagree`].
const RANKS_DISAGREE: &str = "the processes that solve the equations together have computed different forces: let all of them run the \
                              same program on processors of one kind";

/// Component of the motion of a point, as the place of an error.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Place {
    /// Point index.
    pub point: u32,
    /// Component of the motion.
    pub component: Component,
}

/// Reason why no equilibrium was found: a result of the run, not an error.
#[derive(Debug, Clone, PartialEq)]
pub enum Unbalanced {
    /// Newton-Raphson did not converge.
    NotConverged {
        /// Relative residual of the last iterate.
        residual: f64,
        /// Number of iterations.
        iterations: usize,
        /// Place of the largest residual.
        place: Place,
    },
    /// A degree of freedom fixed for want of stiffness would have to carry a load.
    LoadOnAddedSupport {
        /// Degree of freedom of the added support.
        place: Place,
        /// Force on the added support, N or N m.
        force: f64,
    },
    /// Supports, loads and added supports do not balance on a part of the body.
    NoForceBalance {
        /// Direction of the resultant.
        component: Component,
        /// Resultant of the forces, N.
        resultant: f64,
        /// Sum of the sizes of the forces, N.
        size: f64,
        /// Number of points of the part.
        points: usize,
        /// First point of the part.
        first: u32,
    },
    /// A force is not finite.
    ForceOutOfRange {
        /// Degree of freedom with such a force.
        place: Place,
    },
    /// The stored energy is not finite.
    EnergyOutOfRange {
        /// Stored energy, J.
        energy: f64,
    },
    /// A pivot of the indefinite matrix vanished.
    VanishingPivot {
        /// Place of the pivot.
        place: Place,
    },
    /// L L^T was required where bonds have negative stiffness, and found a pivot that is not positive.
    NotPositiveDefinite {
        /// Place of the pivot.
        place: Place,
    },
    /// Conjugate gradients found a motion without energy.
    NegativeCurvature,
    /// The energy of the motions is negative; it is the stored energy, unless the temperature changes.
    NegativeEnergy {
        /// Energy of the motions, J.
        energy: f64,
    },
    /// The loads of a stage do not move its controlling motion.
    Unmoved,
    /// No bond softens further under the loads of a stage controlled by dissipated energy.
    NothingDissipates,
    /// Processes that solve the equations together have computed different forces.
    RanksDisagree,
    /// Surfaces moved through each other, or into each other, in one step, so that they could not meet.
    Missed {
        /// Name of the contact.
        contact: String,
        /// Place at which the surfaces missed each other, and their motion.
        missed: Missed,
    },
    /// The matrix could not be factorised.
    NoFactor(FactorError),
}

impl Place {
    /// Description of the place, with a name for its point.
    pub fn words(self, name: &dyn Fn(u32) -> String) -> String {
        format!("{}, component {}", name(self.point), self.component.name())
    }

    /// Unit of a force at the place.
    pub fn unit(self) -> &'static str {
        if self.component.is_rotation() {
            "N m"
        } else {
            "N"
        }
    }
}

impl Unbalanced {
    /// The reason for a contact of a problem, given by its number, that surfaces missed.
    pub(crate) fn missed(problem: &ContactProblem, (contact, missed): (usize, Missed)) -> Self {
        let contact = problem.contacts[contact].name.clone();
        Self::Missed { contact, missed }
    }

    /// Description of the reason, with names for points.
    pub fn words(&self, name: &dyn Fn(u32) -> String) -> String {
        match self {
            Self::NotConverged {
                residual,
                iterations,
                place,
            } => format!(
                "Newton-Raphson did not converge: residual {residual:.1e} after {iterations} iterations, largest at {}",
                place.words(name)
            ),
            Self::LoadOnAddedSupport { place, force } => format!(
                "no bond resists the motion of {} under {force:.3e} {}; add a support, or balance the loads",
                place.words(name),
                place.unit()
            ),
            Self::NoForceBalance {
                component,
                resultant,
                size,
                points,
                first,
            } => format!(
                "what supports and loads exert on the part of {points} points from {} does not balance: {resultant:.3e} N are left \
                 along {} of forces of {size:.3e} N in all",
                name(*first),
                component.name()
            ),
            Self::ForceOutOfRange { place } => format!(
                "the forces at {} are not a number, or too large for one; look for a size, stiffness or load that is out of \
                 all proportion",
                place.words(name)
            ),
            Self::EnergyOutOfRange { energy } => format!(
                "the stored energy is {energy}: look for a size, stiffness or load that is out of all proportion"
            ),
            Self::VanishingPivot { place } => format!(
                "the stiffness lost stability: vanishing pivot at {}",
                place.words(name)
            ),
            Self::NotPositiveDefinite { place } => format!(
                "the stiffness is not positive definite, as L L^T needs (pivot at {}): bonds have a negative shear stiffness \
                 (large Poisson's ratio); let the factorisation be \"auto\" or \"ldlt\"",
                place.words(name)
            ),
            Self::NegativeCurvature => "the stiffness is not positive definite, as conjugate gradients need: some motion costs no energy; let \
                                        solver.method be direct, which tells where"
                .to_owned(),
            Self::NegativeEnergy { energy } => {
                format!("the stiffness lost stability: negative strain energy {energy:.3e} J")
            }
            Self::Unmoved => "the loads of the stage do not move the probe that controls it: let another probe control it, or another load \
                              grow".to_owned(),
            Self::NothingDissipates => "no bond softens farther however far the loads of the stage go, so that they dissipate no energy: give \
                                        the stage other loads, or less to dissipate"
                .to_owned(),
            Self::RanksDisagree => RANKS_DISAGREE.to_owned(),
            Self::Missed { contact, missed } => unseen(contact, missed, &name(missed.point)),
            Self::NoFactor(error) => format!("the stiffness has no factor: {error}"),
        }
    }
}

/// Description of what surfaces of a contact moved through undetected, at a place.
fn unseen(contact: &str, missed: &Missed, place: &str) -> String {
    let Missed { way, seen, .. } = *missed;
    format!(
        "the surfaces of the contact `{contact}` move by {way:.3e} m against each other at {place}, and through each other unseen: take {:.0} \
         times as many steps (`fracture.steps`; in a motion shorter ones), so that they move by at most {seen:.3e} m in each; along the \
         exact path, which keeps what faces what, take load steps",
        (way / seen).ceil()
    )
}

impl Display for Unbalanced {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(&self.words(&|point| format!("point {point}")))
    }
}

impl std::error::Error for Unbalanced {}
