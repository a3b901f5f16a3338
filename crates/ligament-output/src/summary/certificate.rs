//! Certificate of a run in statics: its energies, what its cracks dissipated, its largest residual, and its ties.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Certificate of a run in statics.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default)]
pub struct CertificateSummary {
    /// Number of the last state at rest, which all values describe.
    pub step: usize,
    /// Number of bonds broken up to there.
    pub broken_bonds: usize,
    /// Work of supports and loads, J.
    pub work: f64,
    /// Energy stored in the bonds, J.
    pub stored: f64,
    /// Energy that breakages took out of the body, J: what bonds dissipated, and what would have become motion.
    pub released: f64,
    /// Energy that the laws of the bonds dissipated, J.
    pub dissipated: f64,
    /// Area of the cracks, m^2, of bonds that broke or have less than a tenth of their force left; none without cracks, of a divided
    /// body, and of one with more points than are traced in a moment.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub crack_area: Option<f64>,
    /// Dissipated energy over the area of the cracks, J/m^2.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub dissipated_per_area: Option<f64>,
    /// Fracture energy that the case gives, J/m^2; none where materials differ, and where no criterion has one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fracture_energy: Option<f64>,
    /// Largest residual of the states that were found, unbalanced force over the forces that meet at a point; none where no iteration was
    /// needed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub largest_residual: Option<f64>,
    /// Number of breakages that had the same utilisation as the one before, so that the numbers in the file decided their order.
    pub ties: usize,
}

impl CertificateSummary {
    /// Dissipated energy per area over the fracture energy, where there are both.
    pub fn spent_ratio(&self) -> Option<f64> {
        let both = self.dissipated_per_area.zip(self.fracture_energy);
        both.map(|(spent, given)| spent / given)
    }
}
