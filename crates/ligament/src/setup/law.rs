//! The bond law, with what each law leaves open.

use ligament_model::law::bbpd;
use ligament_model::law::beam::ShearForm;
use ligament_model::law::rotational::{Profile, RotationalStiffness};
use ligament_model::material::Space;
use ligament_model::{Elasticity, ElementKind, Isotropic, Material};

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
    /// All strains of a small rectangle around each bond of a lattice.
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

/// What a law leaves open, to be chosen; none of what the law settles itself.
#[derive(Debug, Default)]
pub struct Open<'a> {
    /// Origin of the constants.
    pub calibration: Option<&'a mut Calibration>,
    /// Stiffness against relative rotation.
    pub rotational_stiffness: Option<&'a mut RotationalStiffness>,
    /// Strains that the bonds resist.
    pub form: Option<&'a mut Form>,
    /// Distances that the strains are taken over.
    pub strains: Option<&'a mut Strains>,
}

impl Law {
    /// All laws, each with the usual choice of what it leaves open.
    pub const ALL: [Self; 8] = [
        Self::Nhpd,
        Self::Bbpd {
            calibration: Calibration::Integral,
        },
        Self::BbpdConical {
            calibration: Calibration::Integral,
        },
        Self::Pds {
            calibration: Calibration::Integral,
        },
        Self::Mppd {
            calibration: Calibration::Integral,
            rotational_stiffness: RotationalStiffness::Decaying,
        },
        Self::MppdBeam {
            calibration: Calibration::Discrete,
        },
        Self::Orthotropic {
            rotational_stiffness: RotationalStiffness::Decaying,
        },
        Self::MbbPd {
            form: Form::Full,
            strains: Strains::Small,
        },
    ];

    /// Name of the law as papers and case files abbreviate it.
    pub const fn name(&self) -> &'static str {
        self.words()[0]
    }

    /// Name of the law and what it is, in a sentence.
    pub const fn words(&self) -> [&'static str; 2] {
        match self {
            Self::Nhpd => [
                "nhpd",
                "Beam-like bonds with non-unified horizons: normal, shear and rotational stiffness.",
            ],
            Self::Bbpd { .. } => [
                "bbpd",
                "Central forces alone; Poisson's ratio 1/3, or 1/4 in plane strain.",
            ],
            Self::BbpdConical { .. } => [
                "bbpd-conical",
                "Central forces with a stiffness that falls with the length.",
            ],
            Self::Pds { .. } => [
                "pds",
                "Normal and constant shear stiffness, no rotations of the points.",
            ],
            Self::Mppd { .. } => ["mppd", "Normal and constant shear stiffness, rotations."],
            Self::MppdBeam { .. } => [
                "mppd-beam",
                "Micropolar bonds in the form of a beam: shear stiffness falls with the length.",
            ],
            Self::Orthotropic { .. } => [
                "orthotropic",
                "Stiffness by the direction in the axes of an orthotropic material, rotations.",
            ],
            Self::MbbPd { .. } => [
                "mbb-pd",
                "All strains of a small rectangle around each bond of a lattice.",
            ],
        }
    }

    /// What the law leaves open.
    pub fn open(&mut self) -> Open<'_> {
        let mut open = Open::default();
        match self {
            Self::Nhpd => {}
            Self::Bbpd { calibration }
            | Self::BbpdConical { calibration }
            | Self::Pds { calibration }
            | Self::MppdBeam { calibration } => open.calibration = Some(calibration),
            Self::Mppd {
                calibration,
                rotational_stiffness,
            } => {
                open.calibration = Some(calibration);
                open.rotational_stiffness = Some(rotational_stiffness);
            }
            Self::Orthotropic {
                rotational_stiffness,
            } => open.rotational_stiffness = Some(rotational_stiffness),
            Self::MbbPd { form, strains } => {
                open.form = Some(form);
                open.strains = Some(strains);
            }
        }
        open
    }

    /// Origin of the constants; None where the paper's constants are the only ones.
    pub fn calibration(mut self) -> Option<Calibration> {
        self.open().calibration.copied()
    }

    /// Rotational stiffness over the length of its bonds; None where points have no rotations.
    pub fn rotational_profile(&self) -> Option<Profile> {
        match *self {
            Self::Nhpd | Self::MppdBeam { .. } => Some(Profile {
                rotational: RotationalStiffness::Beam,
                shear_falls: true,
            }),
            Self::Mppd {
                rotational_stiffness,
                ..
            }
            | Self::Orthotropic {
                rotational_stiffness,
            } => Some(Profile {
                rotational: rotational_stiffness,
                shear_falls: false,
            }),
            Self::Bbpd { .. }
            | Self::BbpdConical { .. }
            | Self::Pds { .. }
            | Self::MbbPd { .. } => None,
        }
    }

    /// Whether Poisson's ratio follows from the law, whatever the materials have.
    pub fn fixes_poisson(&self) -> bool {
        matches!(self, Self::Bbpd { .. } | Self::BbpdConical { .. })
    }

    /// Elastic constants that the law makes of a material: Young's modulus with the Poisson's ratio of central forces where the law knows no
    /// other. None for a material with axes.
    pub fn constants(&self, material: &Material, space: Space) -> Option<Isotropic> {
        let given = material.elasticity.isotropic()?;
        Some(if self.fixes_poisson() {
            bbpd::central(&given, space)
        } else {
            given
        })
    }

    /// Elasticity of a material with the constants that the law makes of its own.
    pub fn effective_elasticity(&self, material: &Material, space: Space) -> Elasticity {
        let constants = self.constants(material, space);
        constants.map_or(material.elasticity, Elasticity::Isotropic)
    }

    /// Whether the law exists in a space.
    pub fn exists_in(&self, space: Space) -> bool {
        match self {
            Self::Nhpd
            | Self::Bbpd { .. }
            | Self::BbpdConical { .. }
            | Self::Pds { .. }
            | Self::Mppd { .. }
            | Self::MppdBeam { .. } => true,
            Self::Orthotropic { .. } | Self::MbbPd { .. } => matches!(space, Space::Plane(_)),
        }
    }

    /// Form of the shear stiffness over the length of bonds between points that turn; none between others.
    pub fn shear_form(&self, space: Space) -> Option<ShearForm> {
        match self {
            Self::Nhpd => Some(ShearForm::of_nhpd(space)),
            Self::MppdBeam { .. } => Some(ShearForm::Falling),
            Self::Mppd { .. } | Self::Orthotropic { .. } => Some(ShearForm::Constant),
            Self::Bbpd { .. }
            | Self::BbpdConical { .. }
            | Self::Pds { .. }
            | Self::MbbPd { .. } => None,
        }
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
}
