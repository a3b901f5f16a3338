//! Initial cracks of a body.

use ligament_model::bonds::precrack::Ends;

use crate::body::Body;

/// An initial crack of a body.
#[derive(Debug, Clone, PartialEq)]
pub struct PreCrack {
    /// Line or surface of the crack.
    pub shape: CrackShape,
    /// Whether bonds that only touch the crack are cut.
    pub ends: Ends,
}

/// The line of a crack in the plane, or its surface in space.
#[derive(Debug, Clone, PartialEq)]
pub enum CrackShape {
    /// A polyline in the plane by its vertices, two or more, m.
    Line(Vec<[f64; 2]>),
    /// A disk in space.
    Disk {
        /// Centre of the disk, m.
        centre: [f64; 3],
        /// Normal of the disk, of arbitrary length.
        normal: [f64; 3],
        /// Radius, m.
        radius: f64,
    },
    /// A plane polygon in space by its corners, three or more, m.
    Polygon(Vec<[f64; 3]>),
    /// Triangles in space.
    Triangles {
        /// Positions of the corners, m.
        points: Vec<[f64; 3]>,
        /// Indices of each triangle's corners in `points`.
        triangles: Vec<[u32; 3]>,
    },
    /// The faces of a surface group of a solid mesh, or the edges of a curve group of a mesh in the plane.
    Group(String),
}

impl PreCrack {
    /// A polyline in the plane by its vertices (m), which cuts the bonds that pass through it.
    pub fn along(points: Vec<[f64; 2]>) -> Self {
        Self {
            shape: CrackShape::Line(points),
            ends: Ends::Excluded,
        }
    }

    /// Whether the crack runs along a group of the body.
    pub(crate) fn is_along_group(&self) -> bool {
        matches!(self.shape, CrackShape::Group(_))
    }

    /// Positions on the crack that a box around it has to contain, m.
    pub(crate) fn positions(&self, body: &dyn Body) -> Vec<Vec<f64>> {
        match &self.shape {
            CrackShape::Line(points) => points.iter().map(|it| it.to_vec()).collect(),
            CrackShape::Polygon(points) | CrackShape::Triangles { points, .. } => {
                points.iter().map(|it| it.to_vec()).collect()
            }
            CrackShape::Disk { centre, radius, .. } => {
                let corner = |side: f64| centre.iter().map(|it| it + side * radius).collect();
                vec![corner(-1.0), corner(1.0)]
            }
            CrackShape::Group(group) => {
                let points = body.points_of(group).unwrap_or_default();
                points.iter().map(|it| body.position(*it)).collect()
            }
        }
    }

    /// Vertices of a line in the plane, m; none of a surface.
    pub fn line(&self) -> &[[f64; 2]] {
        match &self.shape {
            CrackShape::Line(points) => points,
            CrackShape::Disk { .. }
            | CrackShape::Polygon(_)
            | CrackShape::Triangles { .. }
            | CrackShape::Group(_) => &[],
        }
    }
}
