//! Probes: what the history records beside displacement and load.

use ligament_analysis::Component;
use ligament_analysis::probe::{self, PointField};
use ligament_model::BondSystem;
use ligament_model::bonds::precrack;

use super::conditions::Axis;

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
        /// Two positions, m: the displacement of the point nearest to the second less that nearest to the first.
        positions: [[f64; 2]; 2],
        /// Component read, m or rad.
        component: Component,
    },
    /// A field at a point.
    At {
        /// Position, m; the nearest point is read.
        position: [f64; 2],
        /// Field read.
        field: PointField,
    },
    /// The force that the bonds carry through a line.
    Section {
        /// Ends of the line, m.
        line: [[f64; 2]; 2],
        /// Component read, N.
        component: Axis,
    },
}

impl Reading {
    /// Whether it is a motion of points, or a difference of such.
    pub(crate) fn is_motion(&self) -> bool {
        match self {
            Self::Between { .. } => true,
            Self::At { field, .. } => matches!(field, PointField::Motion(_)),
            Self::Section { .. } => false,
        }
    }
}

impl Probe {
    /// The probe on the points and bonds of a model.
    pub(crate) fn on(&self, system: &BondSystem) -> probe::Probe {
        let nearest = |position: [f64; 2]| system.cloud.nearest_point(position);
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
            Reading::Section {
                line: [start, end],
                component,
            } => {
                let component = match component {
                    Axis::X => Component::X,
                    Axis::Y => Component::Y,
                };
                let (faces, cloud) = (&system.faces, &system.cloud);
                let cut = faces.cut().iter().filter(|_| faces.close());
                let ends = system.bonds.ends.iter().copied();
                let ends = ends.chain(cut.map(|it| it.ends));
                probe::Reading::SectionForce {
                    bonds: precrack::crossing_bonds(ends, cloud, start, end),
                    component,
                }
            }
        };
        probe::Probe {
            name: self.name.clone(),
            reading,
        }
    }
}
