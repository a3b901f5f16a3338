//! `[[support]]`, `[[initial_velocity]]` and `[[temperature]]`: supports of the body, its velocities at time zero and changes of its temperature.

use std::path::{Path, PathBuf};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::fault::KeyFault;
use super::key_path::KeyPath;
use super::mesh_section::complete_path;
use super::places::{Coordinates, Corners, Vector, place, place_or_everywhere};
use super::values::{exactly_one, one_of, refuse};
use crate::point_table::Tables;
use ligament::setup::{self, Displacement, SpringStiffness, TemperatureChange};

/// A support: displacements held at zero, or resisted by springs.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = exactly_one(&["group", "box", "at"])))]
pub struct Support {
    /// The points of this physical group of the mesh, or of this set or hole of the lattice.
    pub group: Option<String>,
    /// The points in this rectangle, by two opposite corners `[[x, y], [x, y]]`, in a solid in this box, m.
    pub r#box: Option<Corners>,
    /// The point nearest to `[x, y]`, in a solid to `[x, y, z]`, m.
    pub at: Option<Coordinates>,
    /// The components that are held, each at 0: `{ x = 0.0 }`, `{ x = 0.0, y = 0.0 }`; m, rotation in rad.
    pub displacement: Option<Displacement>,
    /// An inclined roller: the direction along which the points are held while they are free across it, `[1.0, 1.0]` is at 45 degrees.
    pub normal: Option<Coordinates>,
    /// Springs to the ground in the place of what holds, in total over the points.
    pub stiffness: Option<SpringStiffness>,
}

impl Support {
    pub(super) fn setup(&self, key: &KeyPath) -> Result<setup::Support, KeyFault> {
        let given = self.displacement.unwrap_or_default();
        let moved = given.components().find(|(_, value)| *value != 0.0);
        if let Some((component, value)) = moved {
            let reason = format!(
                "a support holds at 0, found {value:?}: put prescribed displacements in a [[load]]"
            );
            let key = key.child("displacement").child(component.name());
            return Err(KeyFault::new(key, reason));
        }
        Ok(setup::Support {
            place: place(key, self.group.as_ref(), self.r#box, self.at)?,
            held: given.components().map(|(component, _)| component).collect(),
            normal: self.normal.map(|it| it.position()),
            stiffness: self.stiffness.unwrap_or_default(),
        })
    }
}

/// A velocity at time zero. Where several reach, the last of them holds.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct InitialVelocity {
    /// The points of this physical group of the mesh, or of this set or hole of the lattice; without a place the whole body moves.
    pub group: Option<String>,
    /// The points in this rectangle, by two opposite corners `[[x, y], [x, y]]`, in a solid in this box, m.
    pub r#box: Option<Corners>,
    /// The point nearest to `[x, y]`, in a solid to `[x, y, z]`, m.
    pub at: Option<Coordinates>,
    /// The velocity, m/s.
    pub velocity: Vector,
}

impl InitialVelocity {
    pub(super) fn setup(&self, key: &KeyPath) -> Result<setup::InitialVelocity, KeyFault> {
        Ok(setup::InitialVelocity {
            place: place_or_everywhere(key, self.group.as_ref(), self.r#box, self.at)?,
            velocity: self.velocity.position(),
        })
    }
}

/// A change of temperature at load factor 1. Where several reach, the last of them holds.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = exactly_one(&["change", "file", "mesh_field"])))]
pub struct Temperature {
    /// The part of the body; the whole body without it or a `box`.
    pub group: Option<String>,
    /// The part of the body in this rectangle, by two opposite corners, in a solid in this box, m.
    pub r#box: Option<Corners>,
    /// Change of the temperature at load factor 1, the same everywhere there, K.
    pub change: Option<f64>,
    /// A CSV file with the columns `x`, `y` (m; of a solid also `z`) and `change` (K), from the folder of the case file.
    #[schemars(length(min = 1))]
    pub file: Option<PathBuf>,
    /// A scalar field at the nodes in the mesh file, K; `ligament inspect` lists them.
    pub mesh_field: Option<String>,
    /// Time step of the `mesh_field`, where the file has several.
    pub time_step: Option<i32>,
    /// Subtracted from the values of the `mesh_field`, K.
    #[schemars(extend("default" = 0.0))]
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

    /// The change of temperature, with its table.
    pub(super) fn setup(
        &self,
        key: &KeyPath,
        tables: Tables,
    ) -> Result<setup::Temperature, KeyFault> {
        let table = |file: &PathBuf| {
            let samples = tables.samples(file, ["change", " (K)"]);
            let samples = samples.map_err(|reason| KeyFault::new(key.child("file"), reason))?;
            Ok(TemperatureChange::Table(samples))
        };
        let field = (self.mesh_field.clone()).map(|name| TemperatureChange::Field {
            name,
            time_step: self.time_step,
            reference: self.reference.unwrap_or_default(),
        });
        let uniform = self.change.map(TemperatureChange::Uniform);
        let changes = [
            ("change", uniform.map(Ok)),
            ("file", self.file.as_ref().map(table)),
            ("mesh_field", field.map(Ok)),
        ];
        Ok(setup::Temperature {
            change: one_of(key, changes)??,
            place: place_or_everywhere(key, self.group.as_ref(), self.r#box, None)?,
        })
    }
}
