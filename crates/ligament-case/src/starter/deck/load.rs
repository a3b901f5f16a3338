//! Loads of a case.

use super::amplitude::Amplitude;
use super::units::number as text_of;

/// A load of a case, with its values in steps.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Load {
    /// Name, by the keyword and line of the deck.
    pub(super) name: String,
    /// Lines for the place and the distribution of the load.
    pub(super) lines: Vec<String>,
    /// Key of the action.
    pub(super) key: &'static str,
    /// Components with their fractions of the value; none for a pressure.
    pub(super) direction: Vec<(&'static str, f64)>,
    pub(super) values: Vec<Value>,
    /// Nodes whose displacement is prescribed, or with a force, ascending.
    pub(super) nodes: Vec<u32>,
}

/// Value of a load from a step on, in SI units.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Value {
    /// Number of the step, from 1.
    pub(super) step: usize,
    pub(super) size: f64,
    pub(super) amplitude: Option<Amplitude>,
}

impl Load {
    /// Creates a load without a name and a step.
    pub(super) fn new(
        lines: Vec<String>,
        key: &'static str,
        direction: Vec<(&'static str, f64)>,
        size: f64,
    ) -> Self {
        let value = Value {
            step: 1,
            size,
            amplitude: None,
        };
        Self {
            name: String::new(),
            lines,
            key,
            direction,
            values: vec![value],
            nodes: Vec::new(),
        }
    }

    /// Value at factor 1: the first nonzero value.
    pub(super) fn size(&self) -> f64 {
        let mut sizes = self.values.iter().map(|it| it.size);
        sizes.find(|it| *it != 0.0).unwrap_or(0.0)
    }

    /// Text of the action at factor 1.
    pub(super) fn action(&self) -> String {
        let component = |(axis, share): &(&str, f64)| {
            let size = share * self.size();
            format!("{axis} = {}", text_of(size))
        };
        let components: Vec<String> = self.direction.iter().map(component).collect();
        let unit = match self.key {
            "displacement" => "m, rad",
            "velocity" => "m/s",
            "acceleration" | "base_acceleration" => "m/s^2",
            "force" => "N in total",
            "force_per_length" => "N/m",
            "force_per_area" => "N/m^2",
            "body_force" => "N/m^3",
            _ => "Pa",
        };
        match components.is_empty() {
            true => format!("{} = {} # {unit}\n", self.key, text_of(self.size())),
            false => format!("{} = {{ {} }} # {unit}\n", self.key, components.join(", ")),
        }
    }
}
