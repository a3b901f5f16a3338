//! A natural mode.

/// Residual of a mode above which the user receives a notice.
pub const RESIDUAL_TOLERANCE: f64 = 1e-8;

ligament_model::case_type! {
    /// Inertia of the rotations of the points.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    #[auto("`inertia` where no bond has a negative shear stiffness, `massless` otherwise.")]
    pub enum Rotations {
        /// Rotations have the inertia of a square with the point's volume.
        Inertia,
        /// Rotations have no inertia and follow the displacements.
        Massless,
    }
}

/// A natural mode.
#[derive(Debug, Clone, PartialEq)]
pub struct Mode {
    /// Kind of the mode: a rigid motion or not.
    pub kind: ModeKind,
    /// Eigenvalue omega^2, 1/s^2.
    pub eigenvalue: f64,
    /// Largest |K phi - omega^2 M phi| over the forces at a point.
    pub residual: f64,
    /// Participation factors phi^T M r for the rigid motions r of size one along x, along y and about the centre of mass, kg^(1/2),
    /// kg^(1/2) and kg^(1/2) m; their squares are the effective masses and inertia.
    pub participation: Vec<f64>,
    /// Displacements and rotations, shape (n_degrees_of_freedom), with phi^T M phi = 1 kg and the first of the largest
    /// displacements positive.
    pub shape: Vec<f64>,
    /// Strain energy density of the mode, shape (n_points), J/m^3.
    pub strain_energy_density: Vec<f64>,
}

/// Kind of a mode.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ModeKind {
    /// Motion without energy.
    Rigid,
    /// Any other mode.
    Elastic,
}

impl ModeKind {
    /// Name in results.
    pub fn name(self) -> &'static str {
        match self {
            Self::Rigid => "rigid",
            Self::Elastic => "elastic",
        }
    }
}

impl Mode {
    /// Angular frequency omega, rad/s: 0 for a rigid motion, NaN where omega^2 is negative.
    pub fn angular_frequency(&self) -> f64 {
        match self.kind {
            ModeKind::Rigid => 0.0,
            ModeKind::Elastic => self.eigenvalue.sqrt(),
        }
    }

    /// Frequency omega/(2 pi), Hz.
    pub fn frequency(&self) -> f64 {
        self.angular_frequency() / std::f64::consts::TAU
    }
}
