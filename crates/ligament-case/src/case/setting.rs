//! Settings in messages, in the terms of a case.

use ligament::setup::setting::Setting;
use ligament_model::failure;
use ligament_model::failure::Unfit;
use ligament_model::law::{BondLaw, listed};
use serde::Serialize;

use super::fault::Fault;
use super::word::{Word, word_of};

/// A setting of a setup in the form of a case.
pub(super) fn of_setup(setting: &Setting) -> String {
    match setting {
        Setting::Law(laws) => format!("model.law = {}", listed(laws, BondLaw::quoted)),
        Setting::Calibration(it) => format!("model.calibration = {}", quoted(it)),
        Setting::RotationalStiffness(it) => format!("rotational_stiffness = {}", quoted(it)),
        Setting::Strains(it) => format!("strains = {}", quoted(it)),
        Setting::Form(it) => quoted(it),
        Setting::Alpha(it) => quoted(it),
        Setting::Surface(it) => quoted(&Word(*it)),
        Setting::Domain(it) => quoted(it),
        Setting::Scattered(it) => quoted(it),
        Setting::Lattice => "[lattice] in the place of [mesh]".to_owned(),
        Setting::Volumes => "`group`, `box`, or neither for the whole body".to_owned(),
    }
}

fn quoted(value: &impl Serialize) -> String {
    format!("\"{}\"", word_of(value))
}

/// A setting of a criterion in the form of a case.
fn of_criterion(setting: &failure::Setting) -> String {
    use failure::Setting as S;
    match setting {
        S::Field(_) => setting.to_string(),
        S::Criterion(word) => format!("kind = \"{word}\""),
        S::OneOfCriteria(_) => format!("{setting} of [fracture]"),
        S::FailureBy(word) => {
            format!("the case has a [fracture] section with the criterion \"{word}\"")
        }
        S::After(word) => format!("after = \"{word}\""),
        S::ExactPath => "control = \"event\"".to_owned(),
        S::LoadSteps => "load steps (`steps`)".to_owned(),
    }
}

impl From<Unfit> for Fault {
    fn from(unfit: Unfit) -> Self {
        match unfit {
            Unfit::Missing { field, reason } => Self::Required {
                key: field,
                reason: reason.said(of_criterion),
            },
            Unfit::NotWith { .. } | Unfit::OutOfRange { .. } | Unfit::WithAxes { .. } => {
                Self::Other(unfit.said(of_criterion))
            }
        }
    }
}
