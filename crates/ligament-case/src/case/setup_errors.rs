//! Faults of a setup in the terms of a case: at the responsible keys, with settings by their keys and words.

use super::conditions::ACTIONS;
use super::document::Node;
use super::fault::{CaseError, Fault, KeyFault};
use super::key_path::KeyPath;
use super::sections::Case;
use super::source::Source;
use super::word::{Word, word_of};
use crate::point_table;
use ligament::error::Fault as SetupFault;
use ligament::setup::setting::Setting;
use ligament::{Field, SetupError};
use ligament_model::failure::{self, Unfit};
use ligament_model::law::{BondLaw, listed};
use serde::Serialize;

/// Parts of the elements of a setup's lists, each with the keys by which a case may give it; the last key is named where none is given.
const PARTS: [(&str, &[&str]); 5] = [
    ("place", &["box", "at", "group"]),
    ("action", &ACTIONS),
    ("change", &["change", "file", "mesh_field"]),
    ("reading", &["between", "at", "section", "tip"]),
    ("surface", &["points", "centre", "group"]),
];

impl Case {
    /// The error of a faulty field of the setup, at the responsible key.
    pub(super) fn error_at_key(&self, source: &Source, error: SetupError) -> CaseError {
        let SetupError { field, fault } = error;
        let document = &source.document;
        let mut key = self.key_of_field(document, field);
        let fault = match *fault {
            SetupFault::Missing { reason, .. } => Fault::Required {
                key: key_of_material(field.part.unwrap_or_default()),
                reason,
            },
            SetupFault::Unfit(unfit) => {
                key = unfit.field().map_or(key.clone(), |it| key.child(it));
                (*unfit).into()
            }
            SetupFault::NameTwice { name, first } => Fault::NotUnique {
                name,
                first: self.key_of_field(document, first.part("name")).to_string(),
                advice: match field.name {
                    "loads" => {
                        ": give one of the loads another `name` (the name of a load without one is its group)"
                    }
                    _ => "",
                },
            },
            SetupFault::Contradiction(reason) => Fault::Other(reason.said(setting_text)),
            SetupFault::NothingHappens => {
                "there is no [[load]] and no change of temperature, so nothing would happen".into()
            }
            SetupFault::SampledTwice {
                place,
                first,
                second,
            } => self.row_twice(field, &place, [first, second]),
            other => other.into(),
        };
        source.error(KeyFault::new(key, fault))
    }

    /// Key path responsible for a field of the setup.
    fn key_of_field(&self, document: &Node, field: Field) -> KeyPath {
        let section = self.section_of(field);
        // One property that varies at random is a table, also where it is the only one of a list.
        let is_table = field.name == "scatter" && document.at(&section.child(1)).is_none();
        let element = match field.index {
            Some(index) if field.name == "materials" => self.materials[index].key_path(),
            Some(index) if !is_table => section.child(index),
            _ => section,
        };
        let given = |key: &&&'static str| document.at(&element.child(key)).is_some();
        let part = match (field.name, field.part) {
            ("law" | "closing" | "closing_friction", None) => field.name,
            ("rotational_scale", Some("length")) => "cosserat_length",
            ("rotational_scale", _) => "rotational_factor",
            ("supports", None) if given(&&"displacement") => "displacement",
            ("materials", Some("elasticity")) | ("loads", Some("name")) | (_, None) => {
                return element;
            }
            ("materials", Some(part)) => key_of_material(part),
            ("temperatures", Some("name")) => "mesh_field",
            (_, Some(part)) => {
                let keys = PARTS
                    .iter()
                    .find(|it| field.index.is_some() && it.0 == part);
                let key = keys.and_then(|(_, keys)| keys.iter().find(given).or(keys.last()));
                key.copied().unwrap_or(part)
            }
        };
        let part = part.split('.').chain(field.key);
        let key = part.fold(element, |key, part| key.child(part));
        match (field.name, field.part, field.index) {
            ("precracks", Some("points"), Some(index)) => self.repeated_point(index, key),
            _ => key,
        }
    }

    /// Key path of the section that determines a field of the setup.
    fn section_of(&self, field: Field) -> KeyPath {
        let section = match field.name {
            "body" if self.mesh.is_some() => "mesh",
            "body" if self.solid_lattice.is_some() => "solid_lattice",
            "body" => "lattice",
            "law" | "horizon" | "rotational_scale" | "closing" | "closing_friction" => "model",
            "initial_velocities" => "initial_velocity",
            "rigid_bodies" => "rigid",
            "criteria" => "fracture.criterion",
            "scatter" => "fracture.scatter",
            "analysis.load_factors" => "fracture.steps",
            "analysis.stop" => "fracture.stop",
            "analysis" => "analysis",
            // The lists of a setup have their names in the plural.
            other => other.trim_end_matches('s'),
        };
        KeyPath(section.split('.').map(str::to_owned).collect())
    }

    /// The key of a repeated point of a pre-crack, or of its list of points.
    fn repeated_point(&self, index: usize, points: KeyPath) -> KeyPath {
        let given = self.precracks[index].points.iter();
        let mut pairs = given.flat_map(|points| points.windows(2));
        match pairs.position(|pair| pair[0] == pair[1]) {
            Some(before) => points.child(before + 1),
            None => points,
        }
    }

    /// The fault of a table of temperatures or factors with two rows for one point.
    fn row_twice(&self, field: Field, place: &str, samples: [usize; 2]) -> Fault {
        let file = field.index.and_then(|index| match field.name {
            "loads" => self.loads[index].profile.as_ref()?.file.as_ref(),
            _ => self.temperatures[index].file.as_ref(),
        });
        let Some(file) = file else {
            return format!("{place} has two values").into();
        };
        // The rows were read before: only their line numbers are needed.
        let lines = point_table::lines_of_rows(file);
        let [first, second] = samples.map(|it| lines.get(it).copied().unwrap_or_default());
        let file = file.display();
        format!("{file}:{second}: {place} has a row already, in line {first}").into()
    }
}

/// Key of a material section for a constant of the setup's material.
fn key_of_material(part: &'static str) -> &'static str {
    match part {
        "elasticity.poisson" => "poisson_12",
        "elasticity.out_of_plane" => "young_3",
        "expansion" => "thermal_expansion",
        "expansion.across" => "thermal_expansion_3",
        part => part.trim_start_matches("elasticity."),
    }
}

/// A setting of a setup in the form of a case.
fn setting_text(setting: &Setting) -> String {
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
fn criterion_setting_text(setting: &failure::Setting) -> String {
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
                reason: reason.said(criterion_setting_text),
            },
            Unfit::NotWith { .. } | Unfit::OutOfRange { .. } | Unfit::WithAxes { .. } => {
                Self::Other(unfit.said(criterion_setting_text))
            }
        }
    }
}
