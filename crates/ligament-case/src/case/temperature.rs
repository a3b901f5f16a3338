//! `[[temperature]]`: changes of temperature.

use std::path::{Path, PathBuf};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::fault::KeyFault;
use super::key_path::KeyPath;
use super::mesh_section::complete_path;
use super::region::{Corners, place_or_everywhere};
use super::values::{exactly_one, one_of, refuse};
use ligament::setup::{self, TemperatureChange};

/// A change of temperature at load factor 1. Where several reach, the last of them holds.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = exactly_one(&["change", "file", "mesh_field"])))]
pub struct Temperature {
    /// The part of the body; the whole body without it or a `box`.
    pub group: Option<String>,
    /// The part of the body in this rectangle, by two opposite corners, in a solid in this box, m.
    #[schemars(extend("x-unit" = "m"))]
    pub r#box: Option<Corners>,
    /// Change of the temperature at load factor 1, the same everywhere there, K.
    #[schemars(extend("x-unit" = "K"))]
    pub change: Option<f64>,
    /// A CSV file with the columns `x`, `y` (m; of a solid also `z`) and `change` (K), from the folder of the case file.
    #[schemars(length(min = 1))]
    pub file: Option<PathBuf>,
    /// A scalar field at the nodes in the mesh file, K; `ligament inspect` lists them.
    #[schemars(extend("x-unit" = "K"))]
    pub mesh_field: Option<String>,
    /// Time step of the `mesh_field`, where the file has several.
    pub time_step: Option<i32>,
    /// Subtracted from the values of the `mesh_field`, K.
    #[schemars(extend("default" = 0.0, "x-unit" = "K"))]
    pub reference: Option<f64>,
}

impl Temperature {
    /// Fills in missing keys; `folder` is that of the case file.
    pub(super) fn complete(&mut self, key: &KeyPath, folder: &Path) -> Result<(), KeyFault> {
        if let Some(file) = &mut self.file {
            complete_path(&key.child("file"), file, folder)?;
        }
        if self.mesh_field.is_some() {
            self.reference.get_or_insert(0.0);
            return Ok(());
        }
        let reason = "it belongs to a `mesh_field`";
        refuse(
            key,
            self,
            &["time_step", "reference"],
            "`change` or `file`",
            reason,
        )
    }

    /// The change of temperature; for a file still without its rows.
    pub(super) fn setup(
        &self,
        key: &KeyPath,
        dimensions: usize,
    ) -> Result<setup::Temperature, KeyFault> {
        let table = self.file.as_ref();
        let field = (self.mesh_field.clone()).map(|name| TemperatureChange::Field {
            name,
            time_step: self.time_step,
            reference: self.reference.unwrap_or_default(),
        });
        let changes = [
            ("change", self.change.map(TemperatureChange::Uniform)),
            ("file", table.map(|_| TemperatureChange::Table(Vec::new()))),
            ("mesh_field", field),
        ];
        let group = self.group.as_ref();
        Ok(setup::Temperature {
            change: one_of(key, changes)?,
            place: place_or_everywhere(key, dimensions, group, self.r#box, None)?,
        })
    }
}
