//! The points of a body on this process, and the outline of a mesh.

use std::sync::Arc;

use ligament_model::PointCloud;

use crate::body::{Body, BodyOutline, Geometry};
use crate::error::SetupError;
use crate::setup::Setup;
use crate::soundness::{forbid_overlap, require_distinct};

/// The outline of a meshed body, which bonds must not cross.
pub(crate) type Bounds<'a, const D: usize> = Option<Box<dyn BodyOutline<D> + 'a>>;

/// The outline of a mesh, if bonds must not cross it.
pub(crate) fn bounds<'a, const D: usize>(
    setup: &Setup,
    body: &'a dyn Geometry<D>,
    cloud: &PointCloud<D>,
) -> Bounds<'a, D> {
    match setup.bonds_through_voids {
        true => None,
        false => body.outline(cloud),
    }
}

/// The points of a body on this process.
pub(crate) struct Discrete<const D: usize> {
    /// Setup of the part of the body that this process keeps.
    pub(crate) setup: Setup,
    /// The points of the whole body.
    pub(crate) names: Arc<dyn Body>,
    pub(crate) cloud: PointCloud<D>,
    /// Index of the material of each cell, shape (n_cells).
    pub(crate) material_of_cell: Vec<u32>,
    /// Whether the bonds of each point never break, shape (n_points).
    pub(crate) no_fail: Vec<bool>,
}

/// All points of the body, not yet [completed](Geometry::completed), and the outline of a mesh, which bonds must not cross;
/// `material_of_cell` (n_cells) has the index of each cell's material.
pub(crate) fn points<'a, const D: usize>(
    setup: &Setup,
    body: &'a dyn Geometry<D>,
    material_of_cell: &[u32],
) -> Result<(PointCloud<D>, Bounds<'a, D>), SetupError> {
    let cloud = body.undivided(setup.thickness(), material_of_cell, setup.materials.len());
    let outline = body.outline(&cloud);
    if let Some(outline) = &outline {
        forbid_overlap(body, &**outline)?;
    }
    let outline = outline.filter(|_| !setup.bonds_through_voids);
    let spacing = outline.as_ref().map(|it| it.spacing(&cloud));
    let cloud = PointCloud {
        spacing: spacing.map_or(cloud.spacing, Arc::from),
        ..cloud
    };
    // The faces of a crack in the mesh may lie at one place: bonds do not see each other through it.
    require_distinct(body, &cloud)?;
    Ok((cloud, outline))
}
