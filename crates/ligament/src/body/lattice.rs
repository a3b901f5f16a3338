//! A body on a lattice: points at the centres of the cells, named sets.

use std::collections::BTreeMap;

use ligament_model::cloud::lattice::Face;
use ligament_model::{BodyGrid, Canvas, Lattice, PointCloud, Shape, raised};
use thiserror::Error;

use super::interface::{Body, OffOutline, Origin};

/// A body with a point at the centre of each cell of a lattice, and named sets of its cells.
#[derive(Debug)]
pub struct LatticeBody {
    lattice: Lattice,
    positions: Vec<[f64; 2]>,
    sets: BTreeMap<String, Set>,
}

/// A hole: cells whose centre lies in it are removed.
#[derive(Debug, Clone, PartialEq)]
pub struct Hole {
    /// Name of the group of the cells at the hole's rim; several holes may share it.
    pub name: Option<String>,
    /// Shape of the hole: cells whose centre lies in it are taken away.
    pub shape: Shape,
}

/// A set of cells.
#[derive(Debug, Clone, PartialEq)]
pub enum CellSet {
    /// So many rows from the bottom.
    Bottom(u32),
    /// So many rows from the top.
    Top(u32),
    /// So many columns from the left.
    Left(u32),
    /// So many columns from the right.
    Right(u32),
    /// Cells whose centre lies in a shape.
    Inside(Shape),
}

/// Why a lattice is no body.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum LatticeError {
    /// Holes take all cells.
    #[error("nothing is left of the {cells} cells")]
    NothingLeft {
        /// Number of cells of the whole rectangle.
        cells: usize,
    },
    /// A set without a cell.
    #[error("no cell has its centre in this set")]
    EmptySet {
        /// Name of the set.
        name: String,
    },
    /// A named hole without a cell at its rim.
    #[error("no cell that is left borders on this hole")]
    NoRim {
        /// Index of the hole.
        hole: usize,
    },
}

/// A named set of points.
#[derive(Debug)]
struct Set {
    /// Points of the set, ascending.
    points: Vec<u32>,
    /// Length of the side that each point stands for, m: none where the set is no part of a side.
    length: Option<f64>,
    /// Part of the outline that belongs to the set.
    faces: Faces,
}

/// The faces, with no cell behind them, that belong to a set.
#[derive(Debug)]
enum Faces {
    /// The faces of the cells of the set.
    OfCells,
    /// The faces on one side of the rectangle, with this outward normal.
    OfSide([i8; 2]),
    /// The faces at some of the holes, shape (n_holes).
    AtHoles(Vec<bool>),
}

impl LatticeBody {
    /// A lattice with named sets of cells and the holes that took cells from it, in the order of its own; named holes are groups
    /// too, unless a set has their name.
    ///
    /// # Errors
    ///
    /// If nothing is left of the lattice, or a set or the rim of a named hole has no cell.
    pub fn new(
        size: [u32; 2],
        spacing: [f64; 2],
        corner: [f64; 2],
        holes: &[Hole],
        named: &BTreeMap<String, CellSet>,
    ) -> Result<Self, LatticeError> {
        let shapes = holes.iter().map(|it| it.shape.clone()).collect();
        let lattice = Lattice::new(size, spacing, corner, shapes);
        if lattice.cells.is_empty() {
            let cells = lattice.n_whole();
            return Err(LatticeError::NothingLeft { cells });
        }
        let mut sets = BTreeMap::new();
        for (name, cells) in named {
            let set = Set::from_cells(cells, &lattice);
            if set.points.is_empty() {
                return Err(LatticeError::EmptySet { name: name.clone() });
            }
            sets.insert(name.clone(), set);
        }
        for (index, hole) in holes.iter().enumerate() {
            let Some(name) = hole.name.as_ref().filter(|&name| !sets.contains_key(name)) else {
                continue;
            };
            let shares_name = |it: &Hole| it.name.as_ref() == Some(name);
            let set = Set::at_holes(holes.iter().map(shares_name).collect(), &lattice);
            if set.points.is_empty() {
                return Err(LatticeError::NoRim { hole: index });
            }
            sets.insert(name.clone(), set);
        }
        let middle = lattice.middle();
        let positions = lattice.cells.iter().map(|&cell| {
            let [x, y] = lattice.offset(cell);
            [middle[0] + x, middle[1] + y]
        });
        Ok(Self {
            positions: positions.collect(),
            lattice,
            sets,
        })
    }
}

impl Set {
    /// The cells at the rim of some of the holes, marked in `holes` (n_holes).
    fn at_holes(holes: Vec<bool>, lattice: &Lattice) -> Self {
        let faces = lattice.outline().into_iter();
        let towards = faces.filter(|face| face.hole.is_some_and(|hole| holes[hole]));
        let mut points: Vec<u32> = towards.map(|face| face.point).collect();
        points.dedup();
        Self {
            points,
            length: None,
            faces: Faces::AtHoles(holes),
        }
    }

    fn from_cells(cells: &CellSet, lattice: &Lattice) -> Self {
        let ([columns, rows], [dx, dy]) = (lattice.size, lattice.spacing);
        let side = |is_in: &dyn Fn([u32; 2]) -> bool, count: u32, normal: [i8; 2]| {
            let length = if normal[0] == 0 { dx } else { dy };
            Self {
                points: lattice.points_where(is_in),
                length: Some(length / f64::from(count)),
                faces: Faces::OfSide(normal),
            }
        };
        let part = |shape: Shape| Self {
            points: lattice.points_in(&shape),
            length: None,
            faces: Faces::OfCells,
        };
        match cells {
            CellSet::Bottom(count) => side(&|[_, row]| row < *count, *count, [0, -1]),
            CellSet::Top(count) => side(&|[_, row]| rows - row <= *count, *count, [0, 1]),
            CellSet::Left(count) => side(&|[column, _]| column < *count, *count, [-1, 0]),
            CellSet::Right(count) => {
                side(&|[column, _]| columns - column <= *count, *count, [1, 0])
            }
            CellSet::Inside(shape) => part(shape.clone()),
        }
    }
}

impl Body for LatticeBody {
    fn origin(&self) -> Origin<'_> {
        Origin::Lattice(&self.lattice)
    }

    fn positions(&self) -> &[[f64; 2]] {
        &self.positions
    }

    fn tagged(&self) -> &'static str {
        "cell"
    }

    /// Cells that are left count from 1.
    fn tag(&self, point: u32) -> u64 {
        u64::from(point) + 1
    }

    fn n_cells(&self) -> usize {
        self.lattice.cells.len()
    }

    fn cloud(&self, thickness: f64, material_of_cell: &[u32], n_materials: usize) -> PointCloud {
        PointCloud::from_lattice(&self.lattice, thickness, material_of_cell, n_materials)
    }

    fn group_kind(&self) -> &'static str {
        "set of the lattice"
    }

    fn group_names(&self) -> Vec<String> {
        self.sets.keys().cloned().collect()
    }

    fn points_of(&self, group: &str) -> Option<Vec<u32>> {
        self.sets.get(group).map(|set| set.points.clone())
    }

    /// Cells of the group, which are its points.
    fn cells_of(&self, group: &str) -> Option<Vec<u32>> {
        self.points_of(group)
    }

    /// The side of a cell spread over the rows or columns of the set.
    fn lengths_of(&self, group: &str) -> Vec<(u32, f64)> {
        let set = self.sets.get(group);
        set.and_then(|set| {
            let length = set.length?;
            Some(set.points.iter().map(|&point| (point, length)).collect())
        })
        .unwrap_or_default()
    }

    /// The face of a cell at its point; on rows and columns of a side those on the rectangle, at the cells of a hole those towards
    /// it, else all faces of the cells behind which there is no cell.
    fn outline_of(&self, group: &str) -> Result<Vec<(u32, [f64; 2])>, OffOutline> {
        let Some(set) = self.sets.get(group) else {
            return Ok(Vec::new());
        };
        let belongs = |face: &Face| match set.faces {
            Faces::OfSide(normal) => face.is_on_rectangle && face.normal == normal,
            Faces::AtHoles(ref holes) => face.hole.is_some_and(|hole| holes[hole]),
            Faces::OfCells => set.points.binary_search(&face.point).is_ok(),
        };
        let [dx, dy] = self.lattice.spacing;
        let mut normals: BTreeMap<u32, [f64; 2]> = BTreeMap::new();
        for face in self.lattice.outline().iter().filter(|face| belongs(face)) {
            let [x, y] = face.normal.map(f64::from);
            let sum = normals.entry(face.point).or_default();
            *sum = [sum[0] + x * dy, sum[1] + y * dx];
        }
        Ok(normals.into_iter().collect())
    }

    fn holes(&self) -> &[Shape] {
        &self.lattice.holes
    }

    /// The cells that lack one of four neighbours.
    fn rim(&self) -> Vec<bool> {
        let mut marked = vec![false; self.positions.len()];
        for face in self.lattice.outline() {
            marked[face.point as usize] = true;
        }
        marked
    }

    fn grid(&self) -> BodyGrid {
        let half = self.lattice.spacing.map(|side| 0.5 * side);
        let corners = |[x, y]: &[f64; 2]| {
            [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]
                .map(|[right, up]| [x + right * half[0], y + up * half[1]])
        };
        BodyGrid {
            positions: raised(&self.positions),
            tags: (1..=self.positions.len() as i64).collect(),
            tagged: self.tagged(),
            canvas: Canvas::Around(self.positions.iter().map(corners).collect()),
        }
    }
}
