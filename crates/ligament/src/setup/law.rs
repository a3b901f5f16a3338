//! The bond law, with what each law leaves open.

use ligament_model::ElementKind;
use ligament_model::law::rotational::RotationalStiffness;

/// A bond law with its open choices.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Law {
    /// Beam-like bonds with non-unified horizons: normal, shear and rotational stiffness.
    Nhpd,
    /// Central forces alone; Poisson's ratio 1/3, or 1/4 in plane strain.
    Bbpd {
        /// Origin of the constants.
        calibration: Calibration,
    },
    /// Central forces with a stiffness that falls with the length of the bond.
    BbpdConical {
        /// Origin of the constants.
        calibration: Calibration,
    },
    /// Normal and constant shear stiffness, no rotations of the points.
    Pds {
        /// Origin of the constants.
        calibration: Calibration,
    },
    /// Normal and constant shear stiffness, with rotations of the points.
    Mppd {
        /// Origin of the constants.
        calibration: Calibration,
        /// Stiffness against relative rotation.
        rotational_stiffness: RotationalStiffness,
    },
    /// Normal and shear stiffness in the form of a beam, with rotations: shear stiffness falls with the length.
    MppdBeam {
        /// Origin of the constants; the integrals leave them 7.5 % off at nu = 0 with a horizon factor of 3.
        calibration: Calibration,
    },
    /// Stiffness by the direction in the axes of an orthotropic material, with rotations.
    Orthotropic {
        /// Stiffness against relative rotation.
        rotational_stiffness: RotationalStiffness,
    },
    /// All strains of a small rectangle around each bond of a square lattice.
    MbbPd {
        /// Strains that the bonds resist.
        form: Form,
        /// Distances that the strains are taken over.
        strains: Strains,
    },
}

/// Origin of the constants of a law.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Calibration {
    /// Integrals over a full circle, as in the papers.
    #[default]
    Integral,
    /// Sums over the family of each point.
    Discrete,
}

/// Strains that the bonds of MBB-PD resist.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Form {
    /// All bonds resist all three strains.
    #[default]
    Full,
    /// Bonds along x and y resist their own strain alone.
    Rows,
    /// The printed form, with forces on the two ends alone.
    Pairwise,
}

/// Distances that the strains of MBB-PD are taken over.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Strains {
    /// The distances before the deformation.
    #[default]
    Small,
    /// The distances after the deformation.
    True,
}

impl Law {
    /// Name of the law as papers and case files abbreviate it.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Nhpd => "nhpd",
            Self::Bbpd { .. } => "bbpd",
            Self::BbpdConical { .. } => "bbpd-conical",
            Self::Pds { .. } => "pds",
            Self::Mppd { .. } => "mppd",
            Self::MppdBeam { .. } => "mppd-beam",
            Self::Orthotropic { .. } => "orthotropic",
            Self::MbbPd { .. } => "mbb-pd",
        }
    }

    /// Whether Poisson's ratio follows from the law, whatever the materials have.
    pub fn fixes_poisson(&self) -> bool {
        matches!(self, Self::Bbpd { .. } | Self::BbpdConical { .. })
    }

    /// Kinematics of its bonds.
    pub fn element(&self) -> ElementKind {
        match self {
            Self::Nhpd | Self::Mppd { .. } | Self::MppdBeam { .. } | Self::Orthotropic { .. } => {
                ElementKind::Beam
            }
            Self::Bbpd { .. } | Self::BbpdConical { .. } | Self::Pds { .. } => ElementKind::Spring,
            Self::MbbPd { form, strains } => match (form, strains) {
                (Form::Pairwise, _) => ElementKind::Pairwise,
                (_, Strains::True) => ElementKind::TrueStrain,
                _ => ElementKind::Imaginary,
            },
        }
    }

    /// Origin of the constants; None where the paper's constants are the only ones.
    pub fn calibration(&self) -> Option<Calibration> {
        match *self {
            Self::Bbpd { calibration }
            | Self::BbpdConical { calibration }
            | Self::Pds { calibration }
            | Self::Mppd { calibration, .. }
            | Self::MppdBeam { calibration } => Some(calibration),
            Self::Nhpd | Self::Orthotropic { .. } | Self::MbbPd { .. } => None,
        }
    }
}
