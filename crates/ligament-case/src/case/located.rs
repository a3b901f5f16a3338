//! Conversion of faulty fields of a setup to the responsible keys of the case.

use ligament::error::Fault as SetupFault;
use ligament::{Field, SetupError};

use super::fault::{CaseError, Fault, KeyFault};
use super::key_path::KeyPath;
use super::sections::Case;
use super::setting;
use super::source::Source;
use crate::point_table;

impl Case {
    /// The error of a faulty field of the setup, at the responsible key.
    pub(super) fn located(&self, source: &Source, error: SetupError) -> CaseError {
        let SetupError { field, fault } = error;
        let mut key = self.key_of_field(field);
        let fault = match *fault {
            SetupFault::Missing { reason, .. } => Fault::Required {
                key: missing_key(field),
                reason,
            },
            SetupFault::Unfit(unfit) => {
                key = unfit
                    .field()
                    .map_or(key.clone(), |it| format!("{key}.{it}"));
                (*unfit).into()
            }
            SetupFault::NameTwice { name, first } => Fault::NotUnique {
                name,
                first: self.key_of_field(first.part("name")),
                advice: match field.name {
                    "loads" => {
                        ": give one of the loads another `name` (the name of a load without one is its group)"
                    }
                    _ => "",
                },
            },
            SetupFault::Contradiction(reason) => Fault::Other(reason.said(setting::of_setup)),
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
        let path = KeyPath::parse(&key).unwrap_or_else(|| KeyPath(vec![key]));
        source.error(KeyFault::new(path, fault))
    }

    /// Key path responsible for a field of the setup.
    fn key_of_field(&self, field: Field) -> String {
        let list = match field.name {
            "body" if self.mesh.is_some() => "mesh",
            "body" if self.solid_lattice.is_some() => "solid_lattice",
            "body" => "lattice",
            "law" | "horizon" | "rotational_scale" | "closing" | "closing_friction" => "model",
            "materials" => "material",
            "precracks" => "precrack",
            "supports" => "support",
            "loads" => "load",
            "stages" => "stage",
            "temperatures" => "temperature",
            "initial_velocities" => "initial_velocity",
            "probes" => "probe",
            "contacts" => "contact",
            "rigid_bodies" => "rigid",
            "criteria" => "fracture.criterion",
            "scatter" => "fracture.scatter",
            "analysis.load_factors" => "fracture.steps",
            "analysis.stop" => "fracture.stop",
            other => other,
        };
        let Some(index) = field.index else {
            let part = match (field.name, field.part) {
                ("law", None) => Some("law"),
                ("closing", None) => Some("closing"),
                ("closing_friction", None) => Some("closing_friction"),
                ("rotational_scale", Some("length")) => Some("cosserat_length"),
                ("rotational_scale", _) => Some("rotational_factor"),
                (_, part) => part,
            };
            return part.map_or(list.to_owned(), |part| format!("{list}.{part}"));
        };
        let element = match field.name {
            "materials" => self.materials[index].key(),
            "scatter" if self.varies_once() => list.to_owned(),
            _ => format!("{list}.{index}"),
        };
        let part = match (field.name, field.part) {
            ("supports", None) if self.supports[index].displacement.is_some() => "displacement",
            ("materials", Some("elasticity")) | ("loads", Some("name")) | (_, None) => {
                return element;
            }
            ("materials", Some(_)) => missing_key(field),
            ("precracks", Some("surface")) => self.precracks[index].surface_key(),
            ("precracks", Some("points")) => &self.points_key(index),
            (_, Some("place")) => self.place_key(field.name, index),
            (_, Some("action")) => self.loads[index].action_key(),
            (_, Some("change")) => self.temperatures[index].change_key(),
            (_, Some("reading")) => self.probes[index].reading_key(),
            ("temperatures", Some("name")) => "mesh_field",
            (_, Some(other)) => other,
        };
        format!("{element}.{part}")
    }

    /// The key of the points of a pre-crack, or of a point that equals its predecessor.
    fn points_key(&self, index: usize) -> String {
        let points = self.precracks[index].points.iter();
        let mut pairs = points.flat_map(|points| points.windows(2));
        let repeated = pairs.position(|pair| pair[0] == pair[1]);
        repeated.map_or("points".to_owned(), |before| {
            format!("points.{}", before + 1)
        })
    }

    /// Whether one property varies at random, which is a table and no list.
    fn varies_once(&self) -> bool {
        let fracture = self.fracture.as_ref();
        let scatter = fracture.and_then(|it| it.scatter.as_ref());
        scatter.is_some_and(|it| it.0.len() == 1)
    }

    /// The key for the place of an element of a list.
    fn place_key(&self, list: &str, index: usize) -> &'static str {
        let (corners, at) = match list {
            "supports" => (self.supports[index].r#box, self.supports[index].at),
            "loads" => (self.loads[index].r#box, self.loads[index].at),
            "temperatures" => (self.temperatures[index].r#box, None),
            "initial_velocities" => {
                let initial = &self.initial_velocities[index];
                (initial.r#box, initial.at)
            }
            "quiet" => (None, None),
            "far_field.near" => {
                let near = self.far_field.iter().flat_map(|it| &it.near);
                (near.clone().nth(index).and_then(|it| it.r#box), None)
            }
            _ => (self.no_fail[index].r#box, None),
        };
        match (corners, at) {
            (Some(_), _) => "box",
            (None, Some(_)) => "at",
            (None, None) => "group",
        }
    }

    /// The fault of two rows of a table of temperatures or factors for one point.
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

/// The key of a material that is responsible for a part of the setup's material.
fn missing_key(field: Field) -> &'static str {
    match field.part {
        Some("elasticity.poisson") => "poisson_12",
        Some("elasticity.out_of_plane") => "young_3",
        Some("expansion") => "thermal_expansion",
        Some("expansion.across") => "thermal_expansion_3",
        Some(part) => part.trim_start_matches("elasticity."),
        None => "",
    }
}
