//! States in equilibrium, and why there is none.

use std::fmt::{self, Display, Formatter};

use ligament_linalg::FactorError;
use ligament_model::element::BondDeformation;
use rayon::prelude::*;
use thiserror::Error;

use crate::internal::InternalForces;
use crate::unknowns::Component;

/// The end of an attempt to bring a state into equilibrium.
#[derive(Debug, Clone, PartialEq)]
pub enum Attempt {
    /// The state is in equilibrium.
    Balanced(Balanced),
    /// There is no equilibrium, or none was found.
    Unbalanced(Unbalanced),
}

impl Attempt {
    /// The equilibrium, if there is one.
    pub fn balanced(self) -> Option<Balanced> {
        match self {
            Self::Balanced(balanced) => Some(balanced),
            Self::Unbalanced(_) => None,
        }
    }
}

/// A state in equilibrium.
#[derive(Debug, Clone, PartialEq)]
pub struct Balanced {
    /// Deformation of every bond without what its temperature gives it, shape (n_bonds).
    pub deformations: Vec<BondDeformation>,
    /// Internal forces.
    pub internal: InternalForces,
    /// Energy stored in the intact bonds, J.
    pub stored_energy: f64,
    /// Residual relative to the forces that meet at a point.
    pub residual: f64,
    /// Newton-Raphson iterations.
    pub iterations: usize,
    /// The energy that the motions of the points cost ([`BondSweep::energy_of_motion`](ligament_model::sweep::BondSweep::energy_of_motion), the stored one unless the temperature
    /// changes) where it is negative, beyond rounding, J.
    pub negative_energy: Option<f64>,
    /// Points of degrees of freedom that turned out to be mechanisms and are held from now on.
    pub mechanisms: Vec<u32>,
}

impl Balanced {
    /// The equilibrium of the same bonds at `factor` times the load factor: everything is proportional to it.
    pub fn scaled(&self, factor: f64) -> Self {
        let deformations = self.deformations.par_iter();
        Self {
            deformations: deformations.map(|it| it.scaled(factor)).collect(),
            internal: InternalForces {
                values: self.internal.values.iter().map(|f| factor * f).collect(),
                force_scale: factor.abs() * self.internal.force_scale,
                moment_scale: factor.abs() * self.internal.moment_scale,
                thermal: factor * self.internal.thermal,
            },
            stored_energy: factor * factor * self.stored_energy,
            iterations: 0,
            mechanisms: Vec::new(),
            ..*self
        }
    }
}

/// Numbers of negative eigenvalues that the stiffness has, and that it should have.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Stability {
    /// Negative eigenvalues of the stiffness.
    pub negative: usize,
    /// Negative eigenvalues of the rotation block: the stiffness of a stable intact model has no others.
    pub expected: usize,
}

/// A component of the motion of a point, where something went wrong.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Place {
    /// Point index.
    pub point: u32,
    /// Component of its motion.
    pub component: Component,
}

impl Display for Place {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "point {}, component {}", self.point, self.component.name())
    }
}

/// Why no equilibrium was found: an outcome of the run, not an error.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum Unbalanced {
    /// Newton-Raphson did not get there.
    #[error(
        "Newton-Raphson did not converge: residual {residual:.1e} after {iterations} iterations, largest at {place}"
    )]
    NotConverged {
        /// Relative residual of the last iterate.
        residual: f64,
        /// Iterations done.
        iterations: usize,
        /// Place of the largest residual.
        place: Place,
    },
    /// A degree of freedom that is held for want of stiffness would have to carry a load.
    #[error(
        "nothing but a numerical hold would carry {force:.3e} {} at {place}: no bond resists this motion there",
        if .place.component.is_rotation() { "N m" } else { "N" }
    )]
    CarriedByHold {
        /// The held degree of freedom.
        place: Place,
        /// Force that it would carry, N or N m.
        force: f64,
    },
    /// Supports, loads and holds do not balance on a part of the body.
    #[error(
        "supports, loads and holds exert {resultant:.3e} N along {} on the part of {points} points from point {first}, where forces \
         of {size:.3e} N in all should cancel",
        .component.name()
    )]
    NoForceBalance {
        /// Direction of the resultant.
        component: Component,
        /// The resultant, N.
        resultant: f64,
        /// Sum of the sizes of the forces, N.
        size: f64,
        /// Number of points of the part.
        points: usize,
        /// First point of the part.
        first: u32,
    },
    /// A force is not a number, or too large for one.
    #[error("the forces at {place} are not a number, or too large for one")]
    ForceOutOfRange {
        /// A degree of freedom with such a force.
        place: Place,
    },
    /// The stored energy is not a number, or too large for one.
    #[error("the stored energy is {energy}: deformations or stiffnesses are too large for numbers")]
    EnergyOutOfRange {
        /// The energy, J.
        energy: f64,
    },
    /// A pivot of the indefinite matrix vanished.
    #[error(
        "the stiffness lost stability: vanishing pivot at {place}"
    )]
    VanishingPivot {
        /// Place of the pivot.
        place: Place,
    },
    /// L L^T was asked for where bonds have negative stiffness, and met a pivot that is not positive.
    #[error(
        "the stiffness is not positive definite, as L L^T needs (pivot at {place}): bonds \
         have a negative shear stiffness (large Poisson's ratio); let the factorisation be \"auto\" or \"ldlt\""
    )]
    NotPositiveDefinite {
        /// Place of the pivot.
        place: Place,
    },
    /// The energy of the motions is negative: the stored one, unless the temperature changes.
    #[error("the stiffness lost stability: negative strain energy {energy:.3e} J")]
    NegativeEnergy {
        /// The energy of the motions, J.
        energy: f64,
    },
    /// The matrix could not be factorised.
    #[error("the stiffness has no factor: {0}")]
    NoFactor(FactorError),
}
