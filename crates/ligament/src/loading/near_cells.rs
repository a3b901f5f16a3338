//! Cells of the near field, which have bonds.

use ligament_model::PointCloud;

use super::places::Places;
use crate::coordinates::narrowed;
use crate::error::{Fault, Field, SetupError};
use crate::extent::Extent;
use crate::setup::{Position, Setup};

/// Distance over the horizon from the border of the near field at which bonds are as in its interior: a little more than three, so that
/// rounding leaves out no points of a regular mesh.
pub(crate) const REACH: f64 = 3.001;

/// Whether each cell belongs to the near field, shape (n_cells): all its corners lie in one of its places. `None` without a far field.
pub fn near_cells<const D: usize>(
    setup: &Setup,
    cloud: &PointCloud<D>,
) -> Result<Option<Vec<bool>>, SetupError> {
    let Some(far_field) = &setup.far_field else {
        return Ok(None);
    };
    let places = Places { setup, cloud };
    let cells = setup.body.corners();
    let mut is_near = vec![false; cells.len()];
    for (index, place) in far_field.near.iter().enumerate() {
        let field = Field::element("far_field.near", index);
        let points = places.points(field, place)?;
        if !mark(&mut is_near, &cells, &points, cloud.len()) {
            return Err(field.part("place").error(Fault::NoCellInside));
        }
    }
    if far_field.strength_share.is_some() {
        for corners in beginning(setup, cloud) {
            let points = cloud.points_in_box(narrowed(corners[0]), narrowed(corners[1]));
            mark(&mut is_near, &cells, &points, cloud.len());
        }
    }
    Ok(Some(is_near))
}

/// Marks the cells whose corners all are among some points; returns whether there is one.
fn mark(is_near: &mut [bool], cells: &[&[u32]], points: &[u32], n_points: usize) -> bool {
    let mut is_inside = vec![false; n_points];
    for &point in points {
        is_inside[point as usize] = true;
    }
    let mut any = false;
    for (is_near, corners) in is_near.iter_mut().zip(cells) {
        let is_one = corners.iter().all(|it| is_inside[*it as usize]);
        (*is_near, any) = (*is_near | is_one, any | is_one);
    }
    any
}

/// Boxes, by their lowest and highest corners, in which a near field that grows begins: around the pre-cracks, and without these and other places
/// around the first cell.
fn beginning<const D: usize>(setup: &Setup, cloud: &PointCloud<D>) -> Vec<[Position; 2]> {
    let horizons = setup.horizon.of_points(cloud).radius;
    let reach = |position: &[f64]| {
        let nearest = cloud.nearest_point(std::array::from_fn(|axis| position[axis]));
        REACH * horizons[nearest as usize]
    };
    let around = |positions: &[Vec<f64>]| {
        let reaches = positions.iter().map(|it| reach(it));
        let reach = reaches.fold(0.0, f64::max);
        let Extent { lower, upper } = Extent::around(positions.iter().map(Vec::as_slice), reach);
        [lower, upper]
    };
    let cracks = setup.precracks.iter().map(|it| it.positions(&*setup.body));
    let mut boxes: Vec<[Position; 2]> = cracks.map(|it| around(&it)).collect();
    let is_given = (setup.far_field.as_ref()).is_some_and(|it| !it.near.is_empty());
    if boxes.is_empty() && !is_given {
        let first = setup.body.corners()[0].iter();
        let corners: Vec<Vec<f64>> = first.map(|&it| setup.body.position(it)).collect();
        boxes.push(around(&corners));
    }
    boxes
}
