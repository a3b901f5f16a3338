//! Probes: quantities that the history records beside displacement and load.

use ligament_analysis::Component;
use ligament_analysis::probe::{PointField, PointReading};
use ligament_model::stress::tip_field::TipQuantity;

use super::conditions::{Axis, Position};

/// A quantity of the body that is recorded at every load step.
#[derive(Debug, Clone, PartialEq)]
pub struct Probe {
    /// Name, unique among the probes.
    pub name: String,
    /// Quantity that the probe reads.
    pub reading: Reading,
}

/// Quantity that a probe reads.
#[derive(Debug, Clone, PartialEq)]
pub enum Reading {
    /// Displacement of one point relative to another.
    Between {
        /// Two positions, m: the reading is the displacement at the second minus the displacement at the first.
        positions: [Position; 2],
        /// Component read, m or rad.
        component: Component,
    },
    /// A field at a position.
    At {
        /// Position, m. The reading is interpolated between the points of the cell around it; outside of cells, or where a pre-crack
        /// separates the points, the value of the nearest point.
        position: Position,
        /// Field read.
        field: PointField,
    },
    /// The force that the bonds carry through a line of the plane, or through a plane of space.
    Section {
        /// Ends of the line, m, with the force of the right side on the left side; in space a point of the plane and one before it along
        /// its normal, with the force of the side before the plane on the side behind it.
        line: [Position; 2],
        /// Component read, N.
        component: Axis,
    },
    /// The mean of a field over the volume of a group.
    Mean {
        /// Name of the group.
        group: String,
        /// Field read.
        field: PointField,
    },
    /// The force of supports and loads on a group.
    Force {
        /// Name of the group.
        group: String,
        /// Component read: a force, N, or the sum of the moments on the points, N m.
        component: Component,
    },
    /// A quantity at the tip of a straight pre-crack in the plane, or at the front of a plane one in a solid.
    Tip(Tip),
}

/// A quantity at the tip or the front of a pre-crack.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tip {
    /// Position of the tip, an end of a pre-crack, or of a place on the front, m.
    pub position: Position,
    /// Quantity read.
    pub quantity: TipQuantity,
    /// Radii of the ring around the tip over which the quantity is integrated, m; without them two and four horizons.
    pub radii: Option<[f64; 2]>,
    /// Length of the front of a solid's pre-crack over which the quantity is a mean, m; without it twice the outer radius.
    pub front_length: Option<f64>,
    /// Whether the ring follows the tip of a crack that grows in the plane.
    pub growing: bool,
}

impl Reading {
    /// Whether the quantity is a virial stress.
    pub(crate) fn is_stress(&self) -> bool {
        let is_stress = |it: &PointField| matches!(it.reading, PointReading::Stress(_));
        matches!(self, Self::At { field, .. } | Self::Mean { field, .. } if is_stress(field))
    }

    /// Whether the quantity is a motion of points, or a difference of motions.
    pub(crate) fn is_motion(&self) -> bool {
        match self {
            Self::Between { .. } => true,
            Self::At { field, .. } | Self::Mean { field, .. } => field.is_motion(),
            Self::Section { .. } | Self::Force { .. } | Self::Tip(_) => false,
        }
    }

    /// Positions between whose points the quantity is read, m.
    pub(crate) fn positions(&self) -> &[Position] {
        match self {
            Self::At { position, .. } => std::slice::from_ref(position),
            Self::Between { positions, .. } => positions,
            _ => &[],
        }
    }

    /// Group over which the quantity is read.
    pub(crate) fn group(&self) -> Option<&String> {
        match self {
            Self::Mean { group, .. } | Self::Force { group, .. } => Some(group),
            _ => None,
        }
    }
}
