//! The part of a body that a process among several keeps: the points that it owns or reads, and the cells between them.

use ligament_model::PointCloud;

use crate::body::{AnyBody, Restricted};
use crate::error::SetupError;
use crate::loading::points_known_to_all;
use crate::setup::Setup;

/// A body with its points and the materials of its cells, as one process keeps them.
pub(crate) struct LocalBody<const D: usize> {
    pub(crate) body: AnyBody,
    pub(crate) cloud: PointCloud<D>,
    /// Index of the material of each cell, shape (n_cells).
    pub(crate) material_of_cell: Vec<u32>,
    /// Numbers of the points in the whole body, ascending.
    pub(crate) points: Vec<u32>,
}

impl<const D: usize> LocalBody<D> {
    /// The part of a whole body (`cloud`, divided between processes; `material_of_cell` has shape (n_cells)) on this process: owned points, those
    /// that may have bonds with them, those known to all processes, and all corners of cells that these bonds may cross.
    ///
    /// # Errors
    ///
    /// If a place of a support, a load or a probe is wrong.
    pub(crate) fn new(
        setup: &Setup,
        cloud: &PointCloud<D>,
        material_of_cell: &[u32],
    ) -> Result<Self, SetupError> {
        let body = setup.body.geometry::<D>();
        let horizons = setup.horizon.of_points(cloud);
        let mut is_here = cloud.near_owned(&horizons.radius);
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
        Ok(Self {
            body: AnyBody::shared(body),
            cloud: cloud.part(&points),
            material_of_cell: cells
                .iter()
                .map(|&cell| material_of_cell[cell as usize])
                .collect(),
            points,
        })
    }

    /// Values at the points of this process from those at the points of the whole body.
    pub(crate) fn of_points<T: Copy>(&self, of_all: &[T]) -> Vec<T> {
        let values = self.points.iter().map(|&point| of_all[point as usize]);
        values.collect()
    }
}
