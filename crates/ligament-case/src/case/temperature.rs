//! `[[temperature]]`: changes of temperature.

use std::path::{Path, PathBuf};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::fault::{Fault, KeyFault};
use super::key_path::KeyPath;
use super::mesh_section::absolute;
use super::region::{RawRegion, Region};
use super::values::exactly_one;
use super::values::{Point, not_exactly_one, require};

/// A change of temperature at load factor 1. Where several reach, the last of them holds.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Temperature {
    /// Where; the whole body without it.
    #[serde(flatten)]
    pub region: Option<Region>,
    /// How much.
    #[serde(flatten)]
    pub change: TemperatureChange,
}

/// How much the temperature changes.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum TemperatureChange {
    /// By the same everywhere.
    Uniform {
        /// The change, K.
        change: f64,
    },
    /// By a table of points.
    Table {
        /// The file, as an absolute path: columns `x`, `y` (m) and `change` (K).
        file: PathBuf,
    },
    /// By a field of the mesh file.
    Field {
        /// Name of the field.
        mesh_field: String,
        /// Time step of the field, where the file has several.
        #[serde(skip_serializing_if = "Option::is_none")]
        time_step: Option<i32>,
        /// What is subtracted from its values, in their unit.
        reference: f64,
    },
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = exactly_one(&["change", "file", "mesh_field"])))]
pub(super) struct RawTemperature {
    /// The part of the body; the whole body without it or a `box`.
    group: Option<String>,
    /// The part of the body in this rectangle, by two opposite corners, m.
    r#box: Option<[Point; 2]>,
    /// Change of the temperature at load factor 1, the same everywhere there, K.
    change: Option<f64>,
    /// A CSV file with the columns `x`, `y` (m) and `change` (K), from the folder of the case file.
    #[schemars(length(min = 1))]
    file: Option<String>,
    /// A scalar field at the nodes in the mesh file, K; `ligament inspect` lists them.
    mesh_field: Option<String>,
    /// Time step of the `mesh_field`, where the file has several.
    time_step: Option<i32>,
    /// Subtracted from the values of the `mesh_field`, K.
    #[schemars(extend("default" = 0.0))]
    reference: Option<f64>,
}

impl RawTemperature {
    /// Checks the section; `folder` is that of the case file.
    pub(super) fn check(self, key: &KeyPath, folder: &Path) -> Result<Temperature, KeyFault> {
        for (name, is_given) in [
            ("time_step", self.time_step.is_some()),
            ("reference", self.reference.is_some()),
        ] {
            if is_given && self.mesh_field.is_none() {
                let fault = Fault::NotWith {
                    key: name,
                    setting: "`change` or `file`".to_owned(),
                    reason: "it belongs to a `mesh_field`",
                };
                return Err(KeyFault::new(key.child(name), fault));
            }
        }
        let change = match (self.change, self.file, self.mesh_field) {
            (Some(change), None, None) => TemperatureChange::Uniform { change },
            (None, Some(file), None) => {
                require(!file.is_empty(), || key.child("file"), "a path", &file)?;
                TemperatureChange::Table {
                    file: absolute(&folder.join(file)),
                }
            }
            (None, None, Some(mesh_field)) => TemperatureChange::Field {
                mesh_field,
                time_step: self.time_step,
                reference: self.reference.unwrap_or(0.0),
            },
            (change, file, field) => {
                let given = [
                    ("change", change.is_some()),
                    ("file", file.is_some()),
                    ("mesh_field", field.is_some()),
                ];
                return Err(not_exactly_one(key, &given));
            }
        };
        Ok(Temperature {
            region: RawRegion::optional(key, self.group, self.r#box)?,
            change,
        })
    }
}
