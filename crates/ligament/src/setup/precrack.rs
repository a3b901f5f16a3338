//! Initial cracks of a body.

use ligament_mesh::Mesh;
use ligament_model::bonds::precrack::Ends;

use super::Setup;

use crate::body::{Body, Origin};
use crate::coordinates::coordinates;

/// Angle of the cells at a node of the outline beyond which it is a re-entrant corner, degrees: that of an L is 270, those of a round hole of
/// eight edges are 225.
const RE_ENTRANT: f64 = 230.0;

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
    /// The faces of a surface group of a solid mesh.
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

impl Setup {
    /// Place where the stress of the elastic body is singular, in words: the tip of a pre-crack, or a re-entrant corner of a mesh in the plane.
    pub fn singular_place(&self) -> Option<String> {
        if !self.precracks.is_empty() {
            return Some("the tip of a pre-crack".to_owned());
        }
        let Origin::Mesh(mesh) = self.body.origin() else {
            return None;
        };
        let corner = re_entrant_corner(mesh)?;
        let position = coordinates(&mesh.positions[corner as usize]);
        Some(format!("the re-entrant corner at ({position}) m"))
    }
}

/// The first node of the outline with a re-entrant corner.
fn re_entrant_corner(mesh: &Mesh) -> Option<u32> {
    let angles = mesh.angles_at_nodes();
    let mut outline: Vec<u32> = mesh.outline().into_iter().flatten().collect();
    outline.sort_unstable();
    let mut outline = outline.into_iter();
    outline.find(|&node| angles[node as usize].to_degrees() > RE_ENTRANT)
}
