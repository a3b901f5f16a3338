//! The points of a body on a process: of several processes each keeps the points that it owns or reads, and the cells between them.

use std::sync::Arc;

use ligament_model::PointCloud;

use crate::body::{AnyBody, Body, BodyOutline, Geometry, Restricted};
use crate::error::SetupError;
use crate::loading::points_known_to_all;
use crate::processes::partition_communicator;
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

impl<const D: usize> Discrete<D> {
    /// The points that this process keeps.
    pub(crate) fn on_this_process(self) -> Result<Self, SetupError> {
        let local = LocalBody::new(&self.setup, &self.cloud, &self.material_of_cell)?;
        Ok(Self {
            names: self.names.names(),
            no_fail: local.of_points(&self.no_fail),
            setup: Setup {
                body: local.body,
                ..self.setup
            },
            cloud: local.cloud,
            material_of_cell: local.material_of_cell,
        })
    }
}

/// All points of the body with their owners, not yet [completed](Geometry::completed), and the outline of a mesh, which bonds must not cross;
/// `material_of_cell` (n_cells) has the index of each cell's material.
pub(crate) fn points<'a, const D: usize>(
    setup: &Setup,
    body: &'a dyn Geometry<D>,
    material_of_cell: &[u32],
) -> Result<(PointCloud<D>, Bounds<'a, D>), SetupError> {
    let cloud = body.undivided(setup.thickness(), material_of_cell, setup.materials.len());
    require_distinct(body, &cloud)?;
    let outline = body.outline(&cloud);
    if let Some(outline) = &outline {
        forbid_overlap(body, &**outline)?;
    }
    let outline = outline.filter(|_| !setup.bonds_through_voids);
    let spacing = outline.as_ref().map(|it| it.spacing(&cloud));
    let subdomain = cloud.divided(partition_communicator(setup));
    let cloud = PointCloud {
        spacing: spacing.unwrap_or(cloud.spacing),
        subdomain,
        ..cloud
    };
    Ok((cloud, outline))
}

/// A body with its points and the materials of its cells, as one process keeps them.
struct LocalBody<const D: usize> {
    body: AnyBody,
    cloud: PointCloud<D>,
    /// Index of the material of each cell, shape (n_cells).
    material_of_cell: Vec<u32>,
    /// Numbers of the points in the whole body, ascending.
    points: Vec<u32>,
}

impl<const D: usize> LocalBody<D> {
    /// The part of a whole body (`cloud`, divided between processes; `material_of_cell` has shape (n_cells)) on this process: owned points, those
    /// that may have bonds with them, those known to all processes, and all corners of cells that these bonds may cross.
    ///
    /// # Errors
    ///
    /// If a place of a support, a load or a probe is wrong.
    fn new(
        setup: &Setup,
        cloud: &PointCloud<D>,
        material_of_cell: &[u32],
    ) -> Result<Self, SetupError> {
        let body = setup.body.geometry::<D>();
        let horizon = |point: u32| setup.horizon.at_spacing(cloud.spacing[point as usize]);
        let mut is_here = cloud.near_owned(horizon);
        let near = (0..cloud.len() as u32).filter(|&it| is_here[it as usize]);
        let [lowest, highest] = cloud.box_around(near);
        let mut is_known = vec![false; cloud.len()];
        for point in points_known_to_all(setup, cloud)? {
            is_known[point as usize] = true;
            is_here[point as usize] = true;
        }
        for corners in body.corners() {
            let [low, high] = cloud.box_around(corners.iter().copied());
            let meets = |axis: usize| low[axis] <= highest[axis] && lowest[axis] <= high[axis];
            let is_crossed = (0..D).all(meets);
            if is_crossed || corners.iter().any(|&it| is_known[it as usize]) {
                corners.iter().for_each(|&it| is_here[it as usize] = true);
            }
        }
        let points = (0..cloud.len() as u32).filter(|&it| is_here[it as usize]);
        let points: Vec<u32> = points.collect();
        let Restricted { body, cells } = body.restricted(&points);
        let materials = cells.iter().map(|&cell| material_of_cell[cell as usize]);
        let material_of_cell: Vec<u32> = materials.collect();
        Ok(Self {
            cloud: body.completed(cloud.part(&points), &material_of_cell),
            body: AnyBody::shared(body),
            material_of_cell,
            points,
        })
    }

    /// Values at the points of this process from those at the points of the whole body.
    fn of_points<T: Copy>(&self, of_all: &[T]) -> Vec<T> {
        let values = self.points.iter().map(|&point| of_all[point as usize]);
        values.collect()
    }
}
