//! Start of softening by the stress around a bond, at an arbitrary deformation of the bond.

use super::hooke::Moduli;

/// Least fraction of the largest principal stress across a bond that begins to soften: a principal stress in a direction in which nothing opens, as
/// at the edge of a platen, starts no softening.
pub const SHARE: f64 = 0.25;

/// Deformation over F_t/E below which no bond begins to soften, because it would never break.
const LEAST: f64 = 0.5;

/// Least ratio of the dissipated energy of a bond to the smallest energy that its law of softening allows.
const BEYOND_LEAST: f64 = 1.001;

/// Stress condition at which a bond begins to soften.
#[derive(Debug, Clone, PartialEq)]
pub enum Surface {
    /// The largest principal stress reaches the tensile strength F_t and pulls across the bond.
    Tension,
    /// On some plane |tau| + sigma_n tan(phi) reaches the cohesion c. Bonds of all directions then begin to soften: an undamaged bond, or one stiff
    /// under pressure, would be a strut that carries more than the strength.
    Shear {
        /// tan(phi), shape (n_bonds).
        slope: Vec<f64>,
    },
}

/// Stress conditions at which the bonds begin to soften.
#[derive(Debug, Clone, PartialEq)]
pub struct Starting {
    /// Stress condition, a surface in the space of stresses.
    pub(crate) surface: Surface,
    /// F_t/E' or c/E', shape (n_bonds); infinite where a bond never fails.
    pub(super) strength: Vec<f64>,
    /// Critical stretch e_c of brittle bonds with the same fracture energy, shape (n_bonds).
    pub(super) critical: Vec<f64>,
    /// Moduli of the bonds, shape (n_bonds).
    pub(super) moduli: Vec<Moduli>,
    /// Positions, counted back from this criterion in the list, of the criteria for bonds that never began to soften.
    pub(super) never_began: &'static [usize],
}

impl Starting {
    /// F_t/E' or c/E' of each bond, shape (n_bonds); infinite where a bond never fails.
    pub fn strengths(&self) -> &[f64] {
        &self.strength
    }

    /// Critical stretch of each bond as a brittle bond with its fracture energy, shape (n_bonds).
    pub fn critical_stretches(&self) -> &[f64] {
        &self.critical
    }

    /// Formula of the stress that is compared with the strength, over E', in plain text.
    pub fn formula(&self) -> &'static str {
        match self.surface {
            Surface::Tension => "sigma_1/E'",
            Surface::Shear { .. } => "(|tau| + sigma_n tan(phi))/E' on some plane",
        }
    }

    /// F_t/E' or c/E' of a bond, and its moduli.
    pub(crate) fn strength(&self, bond: usize) -> (f64, &Moduli) {
        (self.strength[bond], &self.moduli[bond])
    }

    /// Deformation at the start of softening of a bond with the deformation e and `utilisation` times the strength: e/utilisation, at least half of
    /// F_t/E and so small that some fracture energy is left.
    pub(super) fn began_at(
        &self,
        bond: usize,
        deformation: f64,
        utilisation: f64,
        least_energy: f64,
    ) -> f64 {
        let least = LEAST * self.strength[bond] / self.moduli[bond].bar;
        let most = self.critical[bond] / (BEYOND_LEAST * least_energy).sqrt();
        (deformation / utilisation).max(least).min(most)
    }
}
