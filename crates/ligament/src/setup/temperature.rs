//! Changes of temperature.

use super::conditions::{Place, Sample};

/// A change of temperature at load factor 1.
#[derive(Debug, Clone, PartialEq)]
pub struct Temperature {
    /// Part of the body: the cells of a group that has cells, otherwise the points.
    pub place: Place,
    /// Change of the temperature.
    pub change: TemperatureChange,
}

/// Change of the temperature.
#[derive(Debug, Clone, PartialEq)]
pub enum TemperatureChange {
    /// Uniform change of the temperature, K.
    Uniform(f64),
    /// Changes at positions, each assigned to the point within a tenth of its distance to the nearest other point.
    Table(Vec<Sample>),
    /// A field of the mesh file.
    Field {
        /// Name of the field.
        name: String,
        /// Time step, where the field has several.
        time_step: Option<i32>,
        /// Value that is subtracted from the field, in its unit.
        reference: f64,
    },
}
