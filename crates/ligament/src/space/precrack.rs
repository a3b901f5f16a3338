//! Cracks that are in a solid from the start.

use ligament_mesh::{Cell, SolidMesh};
use ligament_model::bonds::precrack::{Ends, SolidPreCrack};

use crate::body::{Body, Origin};
use crate::error::{Fault, Field, SetupError};

/// A crack that is in a solid from the start.
#[derive(Debug, Clone, PartialEq)]
pub struct SolidCrack {
    /// Surface of the crack.
    pub surface: CrackSurface,
    /// Whether bonds that only touch the crack are cut.
    pub ends: Ends,
}

/// The surface of a crack in a solid.
#[derive(Debug, Clone, PartialEq)]
pub enum CrackSurface {
    /// A disk.
    Disk {
        /// Middle, m.
        centre: [f64; 3],
        /// Normal; it need not have the length 1.
        normal: [f64; 3],
        /// Radius, m.
        radius: f64,
    },
    /// A plane polygon by its corners, three or more, m.
    Polygon(Vec<[f64; 3]>),
    /// Triangles by the numbers of their corners among points, m.
    Triangles {
        /// Corners, m.
        points: Vec<[f64; 3]>,
        /// The triangles.
        triangles: Vec<[u32; 3]>,
    },
    /// The faces of a surface group of the mesh.
    Group(String),
}

/// The surfaces that cut bonds of a body.
pub(super) fn surfaces(
    body: &dyn Body<3>,
    precracks: &[SolidCrack],
) -> Result<Vec<SolidPreCrack>, SetupError> {
    let cracks = precracks.iter().enumerate();
    let surface = |(index, crack): (usize, &SolidCrack)| {
        let field = Field::element("precracks", index);
        let surface = match &crack.surface {
            CrackSurface::Disk {
                centre,
                normal,
                radius,
            } => SolidPreCrack::disk(*centre, *normal, *radius),
            CrackSurface::Polygon(corners) => SolidPreCrack::polygon(corners),
            CrackSurface::Triangles { points, triangles } => {
                SolidPreCrack::triangles(points, triangles)
            }
            CrackSurface::Group(group) => {
                let triangles = faces_of_group(field, body, group)?;
                SolidPreCrack::triangles(body.positions(), &triangles)
            }
        };
        let surface = surface.map_err(|unfit| {
            let reason = Fault::Contradiction(unfit.to_string().into());
            field.part("surface").error(reason)
        })?;
        Ok(match crack.ends {
            Ends::Excluded => surface,
            Ends::Included => surface.with_rim(),
        })
    };
    cracks.map(surface).collect()
}

/// The faces of a surface group as triangles, quadrangles along a diagonal.
fn faces_of_group(
    field: Field,
    body: &dyn Body<3>,
    group: &str,
) -> Result<Vec<[u32; 3]>, SetupError> {
    let Origin::SolidMesh(mesh) = body.origin() else {
        let reason = "only meshes have groups of faces: give a polygon or a disk";
        return Err(field
            .part("surface")
            .error(Fault::Contradiction(reason.into())));
    };
    if body.points_of(group).is_none() {
        return Err(field.part("surface").error(Fault::UnknownName {
            what: body.group_kind(),
            found: group.to_owned(),
            candidates: body.group_names(),
        }));
    }
    let triangles = triangles_of(mesh, group);
    if triangles.is_empty() {
        return Err(field.part("surface").error(Fault::NoArea));
    }
    Ok(triangles)
}

fn triangles_of(mesh: &SolidMesh, group: &str) -> Vec<[u32; 3]> {
    let faces = mesh.groups_named(group).flat_map(|it| &it.faces);
    let split = |face: &Cell| match *face {
        Cell::Triangle(corners) => vec![corners],
        Cell::Quadrangle([a, b, c, d]) => vec![[a, b, c], [a, c, d]],
    };
    faces.flat_map(split).collect()
}
