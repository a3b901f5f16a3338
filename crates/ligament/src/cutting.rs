//! Cutting of a whole body into the parts of processes.

use std::io::Read;
use std::sync::Arc;

use ligament_analysis::serial::{Damaged, Serial, Sink};
use ligament_model::PointCloud;
use ligament_model::boxes::Boxes;

use crate::body::{Geometry, MeshedBody, Restricted};
use crate::error::SetupError;
use crate::loading::{material_of_cell, no_fail, points_known_to_all};
use crate::local::points;
use crate::setup::Setup;

/// Lowest and highest corner of a box, m.
pub(crate) type Corners<const D: usize> = [[f64; D]; 2];

/// A whole body with the data that its parts take from it.
pub(crate) struct Whole<const D: usize> {
    body: Arc<dyn Geometry<D>>,
    /// All points; not yet [completed](Geometry::completed).
    pub(crate) cloud: PointCloud<D>,
    /// Index of the material of each cell, shape (n_cells).
    material_of_cell: Vec<u32>,
    /// Whether the bonds of each point never break, shape (n_points).
    no_fail: Vec<bool>,
    /// Whether all processes know each point, shape (n_points).
    is_known: Vec<bool>,
}

/// The part of a body that a process keeps.
pub(crate) struct Part<const D: usize> {
    /// The part as a body of its own.
    pub(crate) body: Arc<dyn Geometry<D>>,
    /// Numbers of its points in the whole body, ascending.
    pub(crate) points: Vec<u32>,
    /// Index of the material of each of its cells, shape (n_cells).
    pub(crate) material_of_cell: Vec<u32>,
    /// Whether the bonds of each of its points never break, shape (n_points).
    pub(crate) no_fail: Vec<bool>,
    /// Volumes of its points, shape (n_points), m^3; empty where they follow from the part.
    pub(crate) volumes: Vec<f64>,
    /// Fractions of the materials in these, shape (n_points, n_materials).
    pub(crate) material_shares: Vec<f64>,
}

impl<const D: usize> Whole<D> {
    /// The body of a setup with its points.
    ///
    /// # Errors
    ///
    /// If its cells are wrong, or a place of a material, a support, a load or a probe is wrong.
    pub(crate) fn new(setup: &Setup) -> Result<Self, SetupError> {
        let body = setup.body.geometry::<D>().clone();
        let material_of_cell = material_of_cell(setup)?;
        let (cloud, _) = points(setup, &*body, &material_of_cell)?;
        let no_fail = no_fail(setup, &cloud)?;
        let mut is_known = vec![false; cloud.len()];
        for point in points_known_to_all(setup, &cloud)? {
            is_known[point as usize] = true;
        }
        Ok(Self {
            body,
            cloud,
            material_of_cell,
            no_fail,
            is_known,
        })
    }

    /// The whole body ready to be cut into parts of processes, whose near points are in the given boxes.
    pub(crate) fn cutter(self, boxes: Vec<Corners<D>>) -> Cutter<D> {
        let cells = match self.body.meshed() {
            None => NearCells::without_cells(&self.is_known, boxes.len()),
            Some(meshed) => NearCells::new(&self, meshed, &boxes),
        };
        Cutter {
            whole: self,
            boxes,
            cells,
        }
    }
}

/// Points that all parts have, and cells that parts may have.
struct NearCells {
    /// Points that all processes know and the other corners of their cells, ascending.
    points_of_all: Vec<u32>,
    /// Cells that have only these points as corners, ascending.
    cells_of_all: Vec<u32>,
    /// Other cells near the points of each process, ascending.
    cells: Vec<Vec<u32>>,
}

impl NearCells {
    fn without_cells(is_known: &[bool], n_parts: usize) -> Self {
        Self {
            points_of_all: marked(is_known),
            cells_of_all: Vec::new(),
            cells: vec![Vec::new(); n_parts],
        }
    }

    /// Goes over all cells three times, and searches for the boxes that each cell meets: a part has the corners of the cells that meet its
    /// box, and the cells between its points, which meet the box around all these corners.
    fn new<const D: usize>(
        whole: &Whole<D>,
        meshed: &dyn MeshedBody<D>,
        boxes: &[Corners<D>],
    ) -> Self {
        let all_cells = || 0..whole.material_of_cell.len() as u32;
        let mut is_of_all = whole.is_known.clone();
        for corners in all_cells().map(|it| meshed.corners_of(it)) {
            if corners.iter().any(|&it| whole.is_known[it as usize]) {
                corners.iter().for_each(|&it| is_of_all[it as usize] = true);
            }
        }
        let around = |cell: u32| {
            let corners = meshed.corners_of(cell).iter().copied();
            whole.cloud.box_around(corners)
        };
        let (near, mut grown) = (Boxes::new(boxes), boxes.to_vec());
        for around in all_cells().map(around) {
            for part in near.meeting(around) {
                grown[part] = joined(grown[part], around);
            }
        }
        let near = Boxes::new(&grown);
        let (mut cells_of_all, mut cells) = (Vec::new(), vec![Vec::new(); boxes.len()]);
        for cell in all_cells() {
            let mut corners = meshed.corners_of(cell).iter();
            match corners.all(|&it| is_of_all[it as usize]) {
                true => cells_of_all.push(cell),
                false => near
                    .meeting(around(cell))
                    .for_each(|part| cells[part].push(cell)),
            }
        }
        Self {
            points_of_all: marked(&is_of_all),
            cells_of_all,
            cells,
        }
    }
}

/// A whole body that is cut into parts.
pub(crate) struct Cutter<const D: usize> {
    whole: Whole<D>,
    /// Box around the near points of each process.
    boxes: Vec<Corners<D>>,
    cells: NearCells,
}

impl<const D: usize> Cutter<D> {
    /// The part with the points near a process (ascending), the points known to all processes, and all corners of cells that bonds between
    /// them may cross; `index` is the index of the box around the near points.
    pub(crate) fn part(&self, index: usize, near: &[u32]) -> Part<D> {
        let (whole, cells) = (&self.whole, &self.cells);
        let mut points = [near, &cells.points_of_all].concat();
        if let Some(meshed) = whole.body.meshed() {
            let [lowest, highest] = self.boxes[index];
            for corners in cells.cells[index].iter().map(|&it| meshed.corners_of(it)) {
                let [low, high] = whole.cloud.box_around(corners.iter().copied());
                let meets = |axis: usize| low[axis] <= highest[axis] && lowest[axis] <= high[axis];
                if (0..D).all(meets) {
                    points.extend(corners);
                }
            }
        }
        points.sort_unstable();
        points.dedup();
        let mut near_cells = [&*cells.cells_of_all, &cells.cells[index]].concat();
        near_cells.sort();
        let Restricted { body, cells } = whole.body.restricted(&points, &near_cells);
        let of_cell = |&cell: &u32| whole.material_of_cell[cell as usize];
        let of_point = |&point: &u32| whole.no_fail[point as usize];
        let [volumes, material_shares] = whole.cloud.volumes_at(&points);
        Part {
            body,
            material_of_cell: cells.iter().map(of_cell).collect(),
            no_fail: points.iter().map(of_point).collect(),
            volumes,
            material_shares,
            points,
        }
    }

    /// All points of the body.
    pub(crate) fn into_cloud(self) -> PointCloud<D> {
        self.whole.cloud
    }
}

impl<const D: usize> Part<D> {
    /// Appends the bytes of a part of a meshed body.
    pub(crate) fn write(&self, out: &mut dyn Sink) {
        let Self {
            body,
            points,
            material_of_cell,
            no_fail,
            volumes,
            material_shares,
        } = self;
        if let Some(meshed) = body.meshed() {
            meshed.write(out);
        }
        points.write(out);
        material_of_cell.write(out);
        no_fail.write(out);
        volumes.write(out);
        material_shares.write(out);
    }

    /// Reads a part of a body that has the kind of cells of `meshed`.
    pub(crate) fn read(meshed: &dyn MeshedBody<D>, from: &mut dyn Read) -> Result<Self, Damaged> {
        Ok(Self {
            body: meshed.read(from)?,
            points: Serial::read(from)?,
            material_of_cell: Serial::read(from)?,
            no_fail: Serial::read(from)?,
            volumes: Serial::read(from)?,
            material_shares: Serial::read(from)?,
        })
    }
}

/// Numbers of the marked points, ascending.
fn marked(is_marked: &[bool]) -> Vec<u32> {
    let numbered = (0..).zip(is_marked).filter(|(_, is_marked)| **is_marked);
    numbered.map(|(point, _)| point).collect()
}

/// The box around two boxes.
fn joined<const D: usize>([low, high]: Corners<D>, [lower, upper]: Corners<D>) -> Corners<D> {
    [
        std::array::from_fn(|axis| low[axis].min(lower[axis])),
        std::array::from_fn(|axis| high[axis].max(upper[axis])),
    ]
}
