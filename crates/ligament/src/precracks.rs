//! Pre-cracks of a setup as lines and surfaces that cut bonds.

use ligament_mesh::Cell;
use ligament_model::bonds::precrack::{
    Crack, Ends, PreCrack as Line, SolidPreCrack, count_touched_bonds, cut_bonds,
};
use ligament_model::{BondSet, PointCloud};

use crate::body::{Body, Geometry};
use crate::error::{Fault, Field, SetupError};
use crate::setup::{CrackShape, PreCrack};

/// The lines or surfaces that cut bonds of a body.
///
/// # Errors
///
/// If a surface is degenerate, or the body has no group of its name.
pub(crate) fn cracks<const D: usize>(
    body: &dyn Geometry<D>,
    precracks: &[PreCrack],
) -> Result<Vec<Crack>, SetupError> {
    let numbered = precracks.iter().enumerate();
    let crack = |(index, crack): (usize, &PreCrack)| {
        let field = Field::element("precracks", index);
        let surface = match &crack.shape {
            CrackShape::Line(points) => {
                return Ok(Crack::Line(Line {
                    points: points.clone(),
                    ends: crack.ends,
                }));
            }
            CrackShape::Disk {
                centre,
                normal,
                radius,
            } => SolidPreCrack::disk(*centre, *normal, *radius),
            CrackShape::Polygon(corners) => SolidPreCrack::polygon(corners),
            CrackShape::Triangles { points, triangles } => {
                SolidPreCrack::triangles(points, triangles)
            }
            CrackShape::Group(group) => {
                let triangles = triangles_of_group(field, body, group)?;
                SolidPreCrack::triangles(&ligament_model::raised(&body.positions()), &triangles)
            }
        };
        let surface = surface.map_err(|unfit| {
            let reason = Fault::Contradiction(unfit.to_string().into());
            field.part("surface").error(reason)
        })?;
        Ok(Crack::Surface(match crack.ends {
            Ends::Excluded => surface,
            Ends::Included => surface.with_rim(),
        }))
    };
    numbered.map(crack).collect()
}

/// The faces of a surface group as triangles, with quadrangles split along a diagonal.
fn triangles_of_group(
    field: Field,
    body: &dyn Body,
    group: &str,
) -> Result<Vec<[u32; 3]>, SetupError> {
    let Some(faces) = body.faces_of(group) else {
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
    let triangles: Vec<[u32; 3]> = faces.iter().flat_map(Cell::triangles).collect();
    if triangles.is_empty() {
        return Err(field.part("surface").error(Fault::NoArea));
    }
    Ok(triangles)
}

/// Effect of the pre-cracks of a body on its bonds.
pub(crate) struct Precracked {
    /// Whether a pre-crack cuts each bond, shape (n_bonds).
    pub(crate) is_cut: Vec<bool>,
    /// Number of bonds that only touch an end of a pre-crack.
    pub(crate) touched: usize,
    /// Indices of the pre-cracks that cut no bond.
    pub(crate) idle: Vec<usize>,
    /// Share of each point's bonds that pre-cracks cut, shape (n_points).
    pub(crate) share: Vec<f64>,
}

impl Precracked {
    pub(crate) fn new<const D: usize>(
        cracks: &[Crack],
        bonds: &BondSet<D>,
        cloud: &PointCloud<D>,
    ) -> Self {
        let is_cut = cut_bonds(cracks, &bonds.ends, cloud);
        let count = |is_cut: &[bool]| {
            cloud
                .subdomain
                .count(is_cut.iter().filter(|it| **it).count())
        };
        let is_idle = |index: &usize| match cracks {
            [_] => count(&is_cut) == 0,
            _ => count(&cut_bonds(&cracks[*index..=*index], &bonds.ends, cloud)) == 0,
        };
        Self {
            idle: (0..cracks.len()).filter(is_idle).collect(),
            touched: count_touched_bonds(cracks, bonds, cloud, &is_cut),
            share: share(cloud, bonds, &is_cut),
            is_cut,
        }
    }
}

/// Share of the bonds of each point that pre-cracks cut, by number, shape (n_points).
fn share<const D: usize>(cloud: &PointCloud<D>, bonds: &BondSet<D>, is_cut: &[bool]) -> Vec<f64> {
    let n_cut = is_cut.iter().filter(|is_cut| **is_cut).count();
    if cloud.subdomain.count(n_cut) == 0 {
        return vec![0.0; cloud.len()];
    }
    let shares = cloud.over_families(|point| {
        let family = bonds.incidence.at(point);
        let cut = family.iter().filter(|bond| is_cut[**bond as usize]).count();
        [cut as f64 / family.len().max(1) as f64]
    });
    shares.into_iter().map(|[share]| share).collect()
}
