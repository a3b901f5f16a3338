//! The near field of a body: its cells with bonds, where the others are linear finite elements.
//!
//! The near field is a body of its own, whose bonds are found and corrected as in any other body: up to the border its points have only the
//! volumes and forces of the near cells. Elements of the far cells contribute the rest.

use std::sync::Arc;

use ligament_model::{AbsentBond, BondSystem, ConstantFields, EnergyRatio, Incidence, PointCloud};

use crate::body::{AnyBody, Geometry};
use crate::error::{Fault, Field, SetupError};
use crate::loading;
use crate::setup::Setup;

/// Near field of a body with the numbers of its points and of the far cells in the whole body.
pub(crate) struct NearField<const D: usize> {
    /// Setup of the near field as a body of its own.
    pub(crate) setup: Setup,
    /// Index of the material of each near cell.
    pub(crate) material_of_cell: Vec<u32>,
    /// Cells of the far field.
    far_cells: Vec<usize>,
    /// Points of the whole body at the points of the near field, ascending.
    points: Vec<u32>,
    /// Points of the whole body.
    cloud: PointCloud<D>,
}

impl<const D: usize> NearField<D> {
    /// The near field that a setup demands; none where all cells have bonds. `material_of_cell` has shape (n_cells).
    ///
    /// # Errors
    ///
    /// If a place of the near field is wrong, or no cell is in one.
    pub(crate) fn new(
        setup: &Setup,
        body: &dyn Geometry<D>,
        cloud: PointCloud<D>,
        material_of_cell: &[u32],
    ) -> Result<Option<Self>, SetupError> {
        let Some(mut is_near) = loading::near_cells(setup, &cloud)? else {
            return Ok(None);
        };
        smooth::<D>(&mut is_near, &body.corners(), cloud.len());
        let cells = |near: bool| {
            let numbered = is_near.iter().enumerate();
            let such = numbered.filter(move |(_, is_near)| **is_near == near);
            such.map(|(cell, _)| cell).collect::<Vec<_>>()
        };
        let (near, far_cells) = (cells(true), cells(false));
        if near.is_empty() {
            return Err(Field::whole("far_field").error(Fault::NoNearCells));
        }
        let Some(part) = body.part(&near).filter(|_| !far_cells.is_empty()) else {
            return Ok(None);
        };
        let corners = body.corners();
        let mut points: Vec<u32> = (near.iter())
            .flat_map(|&cell| corners[cell].iter().copied())
            .collect();
        points.sort_unstable();
        points.dedup();
        Ok(Some(Self {
            setup: Setup {
                body: AnyBody::shared(part),
                ..setup.clone()
            },
            material_of_cell: near.iter().map(|&cell| material_of_cell[cell]).collect(),
            far_cells,
            points,
            cloud,
        }))
    }

    /// The near field as a body.
    pub(crate) fn body(&self) -> Arc<dyn Geometry<D>> {
        self.setup.body.geometry::<D>().clone()
    }

    /// The bonds of the near field in the whole body, with the elements of the far field; `material_of_cell` (n_cells) is of the whole body.
    pub(crate) fn in_whole_body(
        self,
        body: &dyn Geometry<D>,
        system: BondSystem<D>,
        material_of_cell: &[u32],
    ) -> BondSystem<D> {
        let system = system.in_whole_body(self.cloud, &self.points);
        body.with_far_field(system, &self.far_cells, material_of_cell)
    }

    /// Fields of the near field at the points of the whole body. Elements represent uniform strains exactly: their points have no residual,
    /// and the energy of the continuum.
    pub(crate) fn fields(&self, fixed: ConstantFields) -> ConstantFields {
        let at_points = |values: Vec<f64>, elsewhere: f64| match values.is_empty() {
            true => values,
            false => self.at_points(values, vec![elsewhere; self.cloud.len()]),
        };
        let absent = fixed.absent.into_iter().map(|it| AbsentBond {
            ends: it.ends.map(|end| self.points[end as usize]),
            ..it
        });
        let ratios = fixed.energy_ratios.into_iter();
        ConstantFields {
            horizon: self.at_points(
                fixed.horizon,
                self.setup.horizon.of_points(&self.cloud).radius,
            ),
            precrack_share: at_points(fixed.precrack_share, 0.0),
            patch_residual: at_points(fixed.patch_residual, 0.0),
            energy_ratios: ratios
                .map(|it| EnergyRatio {
                    at_points: at_points(it.at_points, 1.0),
                    ..it
                })
                .collect(),
            absent: absent.collect(),
            ..fixed
        }
    }

    /// Values at the points of the near field, and others at the remaining points of the whole body.
    fn at_points(&self, near: Vec<f64>, mut all: Vec<f64>) -> Vec<f64> {
        for (&point, value) in self.points.iter().zip(near) {
            all[point as usize] = value;
        }
        all
    }
}

/// Largest number of passes along the border.
const PASSES: usize = 8;

/// Smooths the border of the near cells: a cell with most of its neighbours on the other side changes sides. At sharp corners bonds are too few
/// for a uniform strain.
fn smooth<const D: usize>(is_near: &mut [bool], cells: &[&[u32]], n_points: usize) {
    let numbered = (0..).zip(cells);
    let pairs = numbered.flat_map(|(cell, corners)| corners.iter().map(move |&it| (it, cell)));
    let at_points = Incidence::from_pairs(pairs, n_points);
    let is_border = |point: u32, is_near: &[bool]| {
        let mut around = at_points
            .at(point)
            .iter()
            .map(|&cell| is_near[cell as usize]);
        let first = around.next();
        around.any(|it| Some(it) != first)
    };
    for _ in 0..PASSES {
        let before = is_near.to_vec();
        for (cell, corners) in cells.iter().enumerate() {
            if corners.iter().any(|it| is_border(*it, &before)) {
                let [mut of_all, mut alike] = [0, 0];
                for other in neighbours::<D>(cell, cells, &at_points) {
                    of_all += 1;
                    alike += usize::from(before[other] == before[cell]);
                }
                is_near[cell] = before[cell] ^ (2 * alike < of_all);
            }
        }
        if before == *is_near {
            break;
        }
    }
}

/// Cells that have a side in common with a cell: at least D corners.
fn neighbours<const D: usize>(
    cell: usize,
    cells: &[&[u32]],
    at_points: &Incidence,
) -> impl Iterator<Item = usize> {
    let mut others: Vec<u32> = (cells[cell].iter())
        .flat_map(|&corner| at_points.at(corner).iter().copied())
        .filter(|&other| other as usize != cell)
        .collect();
    others.sort_unstable();
    let of_each: Vec<usize> = (others.chunk_by(|one, other| one == other))
        .filter(|same| same.len() >= D)
        .map(|same| same[0] as usize)
        .collect();
    of_each.into_iter()
}
