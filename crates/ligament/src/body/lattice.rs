//! A body on a lattice: points at the centres of the cells, named sets.

use std::collections::BTreeMap;

use ligament_model::{BodyGrid, Canvas, Lattice, PointCloud, Shape, raised};

use super::cells::{self, CellSets, Cells, Hole, LatticeError, rim};
use super::interface::{Body, OffOutline, Origin};

/// A body with a point at the centre of each cell of a lattice, and named sets of its cells.
#[derive(Debug)]
pub struct LatticeBody {
    lattice: Lattice,
    positions: Vec<[f64; 2]>,
    sets: CellSets<2>,
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

impl CellSet {
    fn cells(&self) -> Cells<2, Shape> {
        match self {
            Self::Bottom(rows) => Cells::AtSide([0, -1], *rows),
            Self::Top(rows) => Cells::AtSide([0, 1], *rows),
            Self::Left(columns) => Cells::AtSide([-1, 0], *columns),
            Self::Right(columns) => Cells::AtSide([1, 0], *columns),
            Self::Inside(shape) => Cells::Inside(shape.clone()),
        }
    }
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
        let (lattice, positions) = cells::lattice(size, spacing, corner, holes)?;
        let named = named.iter().map(|(name, set)| (name.clone(), set.cells()));
        Ok(Self {
            sets: CellSets::new(&lattice, holes, named)?,
            positions,
            lattice,
        })
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
        self.sets.names()
    }

    fn points_of(&self, group: &str) -> Option<Vec<u32>> {
        self.sets.points(group)
    }

    /// Cells of the group, which are its points.
    fn cells_of(&self, group: &str) -> Option<Vec<u32>> {
        self.points_of(group)
    }

    /// The side of a cell spread over the rows or columns of the set.
    fn lengths_of(&self, group: &str) -> Vec<(u32, f64)> {
        self.sets.parts_of_side(group)
    }

    fn shares_at(&self, position: [f64; 2]) -> Option<Vec<(u32, f64)>> {
        self.lattice.shares_at(position)
    }

    fn outline_of(&self, group: &str) -> Result<Vec<(u32, [f64; 2])>, OffOutline> {
        Ok(self.sets.outline(group, &self.lattice))
    }

    fn holes(&self) -> &[Shape] {
        &self.lattice.holes
    }

    fn rim(&self) -> Vec<bool> {
        rim(&self.lattice)
    }

    fn grid(&self) -> BodyGrid {
        let half = self.lattice.spacing.map(|side| 0.5 * side);
        let corners = |[x, y]: &[f64; 2]| {
            [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]
                .map(|[right, up]| [x + right * half[0], y + up * half[1]])
        };
        BodyGrid {
            numbering: self.numbering(),
            positions: raised(&self.positions),
            tags: (1..=self.positions.len() as i64).collect(),
            tagged: self.tagged(),
            canvas: Canvas::Around(self.positions.iter().map(corners).collect()),
        }
    }
}
