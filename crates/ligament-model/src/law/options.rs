//! Options of bond laws.

use super::rotational::RotationalStiffness;
use crate::material::PoissonForm;

crate::case_type! {
    /// Origin of the constants of a law.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
    pub enum Calibration {
        /// Integrals over a full circle, as in the papers.
        #[default]
        Integral,
        /// Sums over the family of each point.
        Discrete,
    }
}

crate::case_type! {
    /// Strains that the bonds of MBB-PD resist.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
    pub enum Form {
        /// Every bond resists all three strains.
        #[default]
        Full,
        /// Bonds along x and y resist only their own strain.
        Rows,
        /// The form as printed, with forces only on the two ends of a bond.
        Pairwise,
    }
}

crate::case_type! {
    /// Distances in the denominators of the strains of MBB-PD.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
    pub enum Strains {
        /// The distances before the deformation.
        #[default]
        Small,
        /// The distances after the deformation.
        True,
    }
}

/// Options of a law; `None` where the law leaves no choice.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Options {
    /// Origin of the constants.
    pub calibration: Option<Calibration>,
    /// Stiffness against relative rotation.
    pub rotational_stiffness: Option<RotationalStiffness>,
    /// Strains that the bonds resist.
    pub form: Option<Form>,
    /// Distances in the denominators of the strains.
    pub strains: Option<Strains>,
    /// What carries the stiffness that bonds cannot have at a large Poisson's ratio.
    pub poisson: Option<PoissonForm>,
}

impl Options {
    /// No options.
    pub const NONE: Self = Self {
        calibration: None,
        rotational_stiffness: None,
        form: None,
        strains: None,
        poisson: None,
    };

    /// The options, completed by options of `others`.
    pub fn or(self, others: Self) -> Self {
        Self {
            calibration: self.calibration.or(others.calibration),
            rotational_stiffness: self.rotational_stiffness.or(others.rotational_stiffness),
            form: self.form.or(others.form),
            strains: self.strains.or(others.strains),
            poisson: self.poisson.or(others.poisson),
        }
    }

    /// Name of the first option that is set in only one of both.
    pub fn first_different_option(&self, others: &Self) -> Option<&'static str> {
        [
            (
                "calibration",
                self.calibration.is_some() != others.calibration.is_some(),
            ),
            (
                "rotational_stiffness",
                self.rotational_stiffness.is_some() != others.rotational_stiffness.is_some(),
            ),
            ("form", self.form.is_some() != others.form.is_some()),
            (
                "strains",
                self.strains.is_some() != others.strains.is_some(),
            ),
            (
                "poisson",
                self.poisson.is_some() != others.poisson.is_some(),
            ),
        ]
        .into_iter()
        .find_map(|(name, differs)| differs.then_some(name))
    }
}

/// Options with one option set.
macro_rules! alone {
    ($($name:ident: $option:ty),+) => {
        $(impl From<$option> for Options {
            fn from(chosen: $option) -> Self {
                Self { $name: Some(chosen), ..Self::NONE }
            }
        })+
    };
}

alone! { calibration: Calibration, rotational_stiffness: RotationalStiffness, form: Form, strains: Strains, poisson: PoissonForm }
