//! Probes: what the history records beside displacement and load.

use ligament_analysis::Component;
use ligament_analysis::probe::{self, PointField};

use super::conditions::Axis;
use super::dimension::{Dim, Dimension};

/// A number read off the body at every load step.
#[derive(Debug, Clone, PartialEq)]
pub struct Probe<const D: usize = 2> {
    /// Name, unique among the probes.
    pub name: String,
    /// Quantity that the probe reads.
    pub reading: Reading<D>,
}

/// What a probe reads.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Reading<const D: usize = 2> {
    /// Displacement of one point relative to another.
    Between {
        /// Two positions, m: the displacement of the point nearest to the second less that nearest to the first.
        positions: [[f64; D]; 2],
        /// Component read, m or rad.
        component: Component,
    },
    /// A field at a point.
    At {
        /// Position, m; the nearest point is read.
        position: [f64; D],
        /// Field read.
        field: PointField,
    },
    /// The force that the bonds carry through a line of the plane, or through a plane of space.
    Section {
        /// Ends of the line, m: what is on its right pulls at what is on its left; in space a point of the plane and one before it along
        /// its normal: what is before the plane pulls at what is behind it.
        line: [[f64; D]; 2],
        /// Component read, N.
        component: Axis,
    },
}

impl<const D: usize> Reading<D> {
    /// Whether it is a motion of points, or a difference of such.
    pub(crate) fn is_motion(&self) -> bool {
        match self {
            Self::Between { .. } => true,
            Self::At { field, .. } => matches!(field, PointField::Motion(_)),
            Self::Section { .. } => false,
        }
    }
}

impl<const D: usize> Probe<D>
where
    Dim: Dimension<D>,
{
    /// The probe on the points and bonds of a model.
    pub(crate) fn on(&self, system: &<Dim as Dimension<D>>::System) -> probe::Probe {
        let nearest = |position: [f64; D]| Dim::cloud(system).nearest_point(position);
        let reading = match self.reading {
            Reading::Between {
                positions,
                component,
            } => probe::Reading::RelativeDisplacement {
                points: positions.map(nearest),
                component,
            },
            Reading::At { position, field } => probe::Reading::Field {
                point: nearest(position),
                field,
            },
            Reading::Section { line, component } => probe::Reading::SectionForce {
                bonds: Dim::crossing(system, line),
                component: component.displacement(),
            },
        };
        probe::Probe {
            name: self.name.clone(),
            reading,
        }
    }
}
