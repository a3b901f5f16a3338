//! States in equilibrium, and why there is none.

use ligament_model::contact::ClosedPair;
use ligament_model::deformation::Deformations;

use crate::internal::InternalForces;
use crate::serial;
use crate::unbalanced::Unbalanced;

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
    pub deformations: Deformations,
    /// Internal forces.
    pub internal: InternalForces,
    /// Energy stored in the intact bonds, J.
    pub stored_energy: f64,
    /// Energy that rounding makes of the displacements, or expansions of the bonds would store, J: less is no energy to speak of.
    pub energy_floor: f64,
    /// Residual relative to the forces that meet at a point.
    pub residual: f64,
    /// Newton-Raphson iterations.
    pub iterations: usize,
    /// The energy that the motions of the points cost ([`BondSweep::energy_of_motion`](ligament_model::sweep::BondSweep::energy_of_motion), the stored one unless the temperature
    /// changes) where it is negative, beyond rounding, J.
    pub negative_energy: Option<f64>,
    /// Points of degrees of freedom that turned out to be mechanisms and are held from now on.
    pub mechanisms: Vec<u32>,
    /// Pairs across cracks that are closed, in the order of their numbers; none where faces do not close.
    pub closed: Vec<ClosedPair>,
}

impl Balanced {
    /// The equilibrium of the same bonds at `factor` times the load factor: everything is proportional to it.
    pub fn scaled(&self, factor: f64) -> Self {
        Self {
            deformations: self.deformations.scaled(factor),
            internal: InternalForces {
                values: self.internal.values.iter().map(|f| factor * f).collect(),
                force_scale: factor.abs() * self.internal.force_scale,
                moment_scale: factor.abs() * self.internal.moment_scale,
                thermal: factor * self.internal.thermal,
            },
            stored_energy: factor * factor * self.stored_energy,
            energy_floor: factor * factor * self.energy_floor,
            iterations: 0,
            mechanisms: Vec::new(),
            closed: (self.closed.iter())
                .map(|it| ClosedPair {
                    gap: factor * it.gap,
                    ..*it
                })
                .collect(),
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

serial!(Stability { negative, expected });
