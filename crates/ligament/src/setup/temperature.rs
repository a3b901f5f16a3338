//! Changes of temperature.

use super::conditions::{Place, Position};

/// A change of temperature at load factor 1.
#[derive(Debug, Clone, PartialEq)]
pub struct Temperature {
    /// Part of the body: the cells of a group that has any, else the points.
    pub place: Place,
    /// How much the temperature changes.
    pub change: TemperatureChange,
}

/// How much the temperature changes.
#[derive(Debug, Clone, PartialEq)]
pub enum TemperatureChange {
    /// One change everywhere, K.
    Uniform(f64),
    /// Changes at positions, each of which belongs to the point within a tenth of the distance to the nearest other point.
    Table(Vec<Sample>),
    /// A field that the mesh brings along.
    Field {
        /// Name of the field.
        name: String,
        /// Time step, where the mesh has several.
        time_step: Option<i32>,
        /// Value that is subtracted from the field, in its unit.
        reference: f64,
    },
}

/// A change of temperature at a position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// Position, m.
    pub position: Position,
    /// Change, K.
    pub change: f64,
}
