//! Reasons why a surface is not a pre-crack.

use std::fmt;

/// Reasons why a surface is not a pre-crack.
#[derive(Debug, Clone, PartialEq)]
pub enum UnfitCrack {
    /// A disk whose normal has no direction.
    NoNormal,
    /// A disk whose radius is not positive.
    NoRadius {
        /// The radius, m.
        radius: f64,
    },
    /// A polygon with fewer than three corners, or a surface without a triangle.
    TooFewCorners {
        /// Number of corners.
        corners: usize,
    },
    /// A polygon or a triangle whose corners lie on a line.
    NoArea {
        /// Number of the triangle from 0; `None` for a polygon.
        triangle: Option<usize>,
    },
    /// A corner of a polygon off the plane of the others.
    NotPlane {
        /// Number of the corner, from 0.
        corner: usize,
        /// Distance of the corner from the plane, m.
        distance: f64,
    },
    /// A polygon that crosses itself.
    CrossesItself,
    /// A triangle that refers to a point that does not exist.
    NoSuchPoint {
        /// Number of the triangle, from 0.
        triangle: usize,
        /// Number of the point.
        point: u32,
    },
}

impl fmt::Display for UnfitCrack {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoNormal => write!(f, "the normal of the disk has no direction; give a vector"),
            Self::NoRadius { radius } => {
                write!(
                    f,
                    "the radius of the disk is {radius}, but must be positive"
                )
            }
            Self::TooFewCorners { corners } => {
                write!(f, "a surface needs three corners or more, not {corners}")
            }
            Self::NoArea { triangle: None } => {
                write!(f, "the corners of the polygon lie on a line")
            }
            Self::NoArea {
                triangle: Some(triangle),
            } => write!(f, "triangle {triangle} has no area; leave it out"),
            Self::NotPlane { corner, distance } => write!(
                f,
                "corner {corner} of the polygon lies {distance:.3e} m off the plane of the others; \
                 move it there, or give a surface of triangles"
            ),
            Self::CrossesItself => write!(f, "the polygon crosses itself; order its corners"),
            Self::NoSuchPoint { triangle, point } => {
                write!(
                    f,
                    "triangle {triangle} names point {point}, which there is not"
                )
            }
        }
    }
}

impl std::error::Error for UnfitCrack {}
