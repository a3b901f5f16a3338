//! Equilibrium states, and reasons for a missing equilibrium.

use std::sync::{Arc, OnceLock};

use ligament_model::Bonds;
use ligament_model::contact::{ClosedPair, PairFriction};
use ligament_model::deformation::Deformations;
use ligament_model::failure::Stresses;
use serde::{Deserialize, Serialize};

use crate::contact::Touching;
use crate::internal::InternalForces;
use crate::unbalanced::Unbalanced;

/// Result of an attempt to bring a state into equilibrium.
#[allow(
    clippy::large_enum_variant,
    reason = "an equilibrium is the usual result, and its arrays are on the heap as they are"
)]
#[derive(Debug, Clone, PartialEq)]
pub enum Attempt {
    /// The state is in equilibrium.
    Balanced(Balanced),
    /// There is no equilibrium, or none was found.
    Unbalanced(Unbalanced),
}

impl Attempt {
    /// Equilibrium, if there is one.
    pub fn balanced(self) -> Option<Balanced> {
        match self {
            Self::Balanced(balanced) => Some(balanced),
            Self::Unbalanced(_) => None,
        }
    }
}

/// Equilibrium state.
#[derive(Debug, Clone, PartialEq)]
pub struct Balanced {
    /// Deformation of every bond without its thermal expansion, shape (n_bonds).
    pub deformations: Deformations,
    /// Internal forces.
    pub internal: InternalForces,
    /// Energy stored in the intact bonds, J.
    pub stored_energy: f64,
    /// Energy due to rounding of the displacements or to expansions of the bonds, J; smaller energies count as zero.
    pub energy_floor: f64,
    /// Relative residual, over the forces at a point.
    pub residual: f64,
    /// Number of Newton-Raphson iterations.
    pub iterations: usize,
    /// Energy of the motions of the points ([`BondSweep::energy_of_motion`](ligament_model::sweep::BondSweep::energy_of_motion);
    /// the stored energy unless the temperature changes), J, where it is negative beyond rounding.
    pub negative_energy: Option<f64>,
    /// Points of mechanisms found in the solution, which are fixed from now on.
    pub mechanisms: Vec<u32>,
    /// Closed pairs across cracks, in the order of their numbers; none where faces do not close.
    pub closed: Vec<ClosedPair>,
    /// Contact between surfaces.
    pub touching: Arc<Touching>,
    /// Stresses across the bonds for each criterion, once some criterion was [asked](crate::problem::Problem::criteria_in).
    pub(crate) stresses: OnceLock<Vec<Option<Stresses>>>,
}

impl Balanced {
    /// Unloaded body, without deformations.
    pub(crate) fn unloaded(system: &dyn Bonds) -> Self {
        Self {
            deformations: Deformations::default(),
            internal: InternalForces {
                values: vec![0.0; system.layout.n_degrees_of_freedom()],
                force_scale: 0.0,
                moment_scale: 0.0,
                thermal: 0.0,
                on_rigid_bodies: Vec::new(),
            },
            stored_energy: 0.0,
            energy_floor: 0.0,
            residual: 0.0,
            iterations: 0,
            negative_energy: None,
            mechanisms: Vec::new(),
            closed: Vec::new(),
            touching: Arc::default(),
            stresses: OnceLock::new(),
        }
    }

    /// Forgets the stresses across the bonds, after their deformations have changed.
    pub(crate) fn forget_stresses(&mut self) {
        self.stresses = OnceLock::new();
    }

    /// Equilibrium of the same bonds at `factor` times the load factor, to which everything is proportional.
    pub fn scaled(&self, factor: f64) -> Self {
        Self {
            deformations: self.deformations.scaled(factor),
            internal: InternalForces {
                values: self.internal.values.iter().map(|f| factor * f).collect(),
                force_scale: factor.abs() * self.internal.force_scale,
                moment_scale: factor.abs() * self.internal.moment_scale,
                thermal: factor * self.internal.thermal,
                on_rigid_bodies: Vec::new(),
            },
            stored_energy: factor * factor * self.stored_energy,
            energy_floor: factor * factor * self.energy_floor,
            iterations: 0,
            mechanisms: Vec::new(),
            closed: (self.closed.iter())
                .map(|it| ClosedPair {
                    gap: factor * it.gap,
                    friction: it.friction.map(|it| PairFriction {
                        force: it.force.map(|it| factor * it),
                        ..it
                    }),
                    ..*it
                })
                .collect(),
            touching: Arc::default(),
            stresses: match self.stresses.get() {
                Some(stresses) => {
                    let of_criteria = stresses.iter();
                    let scaled = of_criteria.map(|it| it.as_ref().map(|it| it.scaled(factor)));
                    scaled.collect::<Vec<_>>().into()
                }
                None => OnceLock::new(),
            },
            ..*self
        }
    }
}

/// Actual and expected numbers of negative eigenvalues of the stiffness.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Stability {
    /// Number of negative eigenvalues of the stiffness.
    pub negative: usize,
    /// Number of negative eigenvalues of the rotation block: the stiffness of a stable intact model has no others.
    pub expected: usize,
}

impl Stability {
    /// Whether the stiffness has more negative eigenvalues than the rotations explain.
    pub fn is_unstable(&self) -> bool {
        self.negative > self.expected
    }
}
