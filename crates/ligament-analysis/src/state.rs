//! What changes during a run.

use ligament_model::BondSystem;

use crate::unknowns::COMPONENTS;

/// Motion of the points and which bonds are left.
#[derive(Debug, Clone, PartialEq)]
pub struct State {
    /// Load factor.
    pub load_factor: f64,
    /// Displacements and rotations, shape (3 n_points), m and rad.
    pub displacement: Vec<f64>,
    /// Which bonds are unbroken, shape (n_bonds).
    pub intact: Vec<bool>,
    /// Degrees of freedom held because nothing else would hold them, shape (3 n_points).
    pub held: Vec<bool>,
}

impl State {
    /// The unloaded body with all its bonds.
    pub fn fresh(system: &BondSystem) -> Self {
        let n = COMPONENTS * system.cloud.len();
        Self {
            load_factor: 0.0,
            displacement: vec![0.0; n],
            intact: vec![true; system.bonds.len()],
            held: vec![false; n],
        }
    }

    /// Number of broken bonds.
    pub fn broken_bonds(&self) -> usize {
        self.intact.iter().filter(|intact| !**intact).count()
    }
}
