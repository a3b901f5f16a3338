//! Changes of temperature.

use super::conditions::Place;

/// A change of temperature at load factor 1.
#[derive(Debug, Clone, PartialEq)]
pub struct Temperature<const D: usize = 2> {
    /// Part of the body: the cells of a group that has any, else the points.
    pub place: Place<D>,
    /// How much the temperature changes.
    pub change: TemperatureChange<D>,
}

/// How much the temperature changes.
#[derive(Debug, Clone, PartialEq)]
pub enum TemperatureChange<const D: usize = 2> {
    /// One change everywhere, K.
    Uniform(f64),
    /// Changes at positions, each of which belongs to the point within a tenth of the distance to the nearest other point.
    Table(Vec<Sample<D>>),
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
pub struct Sample<const D: usize = 2> {
    /// Position, m.
    pub position: [f64; D],
    /// Change, K.
    pub change: f64,
}
