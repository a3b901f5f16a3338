//! Probes: what the history records beside displacement and load.

use ligament_analysis::Component;
use ligament_analysis::probe::{PointField, PointReading};

use super::conditions::{Axis, Position};

/// A number read off the body at every load step.
#[derive(Debug, Clone, PartialEq)]
pub struct Probe {
    /// Name, unique among the probes.
    pub name: String,
    /// Quantity that the probe reads.
    pub reading: Reading,
}

/// What a probe reads.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Reading {
    /// Displacement of one point relative to another.
    Between {
        /// Two positions, m: the displacement at the second less that at the first.
        positions: [Position; 2],
        /// Component read, m or rad.
        component: Component,
    },
    /// A field at a position.
    At {
        /// Position, m: what the points of the cell around it have, in parts; where no cell is, or a pre-crack parts them, the nearest point.
        position: Position,
        /// Field read.
        field: PointField,
    },
    /// The force that the bonds carry through a line of the plane, or through a plane of space.
    Section {
        /// Ends of the line, m: what is on its right pulls at what is on its left; in space a point of the plane and one before it along
        /// its normal: what is before the plane pulls at what is behind it.
        line: [Position; 2],
        /// Component read, N.
        component: Axis,
    },
}

impl Reading {
    /// Whether it is a virial stress.
    pub(crate) fn is_stress(&self) -> bool {
        let is_stress = |it: &PointField| matches!(it.reading, PointReading::Stress(_));
        matches!(self, Self::At { field, .. } if is_stress(field))
    }

    /// Whether it is a motion of points, or a difference of such.
    pub(crate) fn is_motion(&self) -> bool {
        match self {
            Self::Between { .. } => true,
            Self::At { field, .. } => field.is_motion(),
            Self::Section { .. } => false,
        }
    }
}
