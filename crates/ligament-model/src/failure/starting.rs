//! Bonds that begin to soften by the stress around them, at whatever deformation they have then.

use super::hooke::Moduli;

/// Share of the largest principal stress by which a bond must be pulled across to begin: a stray principal stress in a direction in
/// which nothing opens, as at the edge of a platen, begins nothing.
pub const SHARE: f64 = 0.25;

/// Deformation over F_t/E below which no bond begins: one that hardly takes part has none to speak of, and would never end.
const LEAST: f64 = 0.5;

/// By how much the energy of the whole life of a bond exceeds the least that its law of softening takes.
const BEYOND_LEAST: f64 = 1.001;

/// What the stress around a bond must come to for the bond to begin.
#[derive(Debug, Clone, PartialEq)]
pub enum Surface {
    /// The largest principal stress comes to the tensile strength F_t, and pulls the bond across.
    Tension,
    /// On some plane |tau| + sigma_n tan(phi) comes to the cohesion c. Bonds of all directions begin then: any of them left sound, or stiff
    /// under pressure, would be a strut that carries more than the strength.
    Shear {
        /// tan(phi), shape (n_bonds).
        slope: Vec<f64>,
    },
}

/// Where bonds begin to soften.
#[derive(Debug, Clone, PartialEq)]
pub struct Starting {
    /// The surface that the stress comes to.
    pub(crate) surface: Surface,
    /// F_t/E' or c/E', shape (n_bonds); infinite where a bond never fails.
    pub(super) strength: Vec<f64>,
    /// Critical stretch e_c of brittle bonds of the fracture energy that a bond takes, shape (n_bonds).
    pub(super) critical: Vec<f64>,
    /// Moduli of the bonds, shape (n_bonds).
    pub(super) moduli: Vec<Moduli>,
    /// Places of the criteria by which bonds break that never began, counted back from this one in the list.
    pub(super) never_began: &'static [usize],
}

impl Starting {
    /// F_t/E' or c/E' of each bond, shape (n_bonds); infinite where a bond never fails.
    pub fn strengths(&self) -> &[f64] {
        &self.strength
    }

    /// Critical stretch of each bond if it were brittle with the fracture energy that it takes, shape (n_bonds).
    pub fn critical_stretches(&self) -> &[f64] {
        &self.critical
    }

    /// What comes to the strength, over E' in plain text.
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

    /// The deformation at which a bond began that has the deformation e at a stress so many times the strength: that at the strength, not
    /// below half of F_t/E, nor so large that nothing would be left of the energy.
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
