//! A box of equal cells in space with named sets of cells.

use std::collections::BTreeMap;

use ligament_model::cloud::lattice::SolidLattice;
use ligament_model::shape::SolidShape;
use ligament_model::{BodyGrid, Canvas, PointCloud};

use super::cells::{self, CellSets, Cells, Hole, LatticeError, rim};
use super::interface::{Body, OffOutline, Origin};

/// A body with a point at the centre of each cell of a box, by named sets of cells.
#[derive(Debug)]
pub struct SolidLatticeBody {
    lattice: SolidLattice,
    /// Positions of the points, shape (n_points), m.
    positions: Vec<[f64; 3]>,
    sets: CellSets<3>,
}

/// A hole of a box.
pub type SolidHole = Hole<SolidShape>;

/// Cells that make a set of a box.
pub type SolidCellSet = Cells<3, SolidShape>;

impl SolidLatticeBody {
    /// A box with named sets of cells and the holes that took cells from it; named holes are groups too, unless a set has their name.
    ///
    /// # Errors
    ///
    /// If nothing is left of the box, or a set or the surface of a named hole has no cell.
    pub fn new(
        size: [u32; 3],
        spacing: [f64; 3],
        corner: [f64; 3],
        holes: &[SolidHole],
        named: &BTreeMap<String, SolidCellSet>,
    ) -> Result<Self, LatticeError> {
        let (lattice, positions) = cells::lattice(size, spacing, corner, holes)?;
        let named = named.iter().map(|(name, set)| (name.clone(), set.clone()));
        Ok(Self {
            sets: CellSets::new(&lattice, holes, named)?,
            positions,
            lattice,
        })
    }
}

impl Body<3> for SolidLatticeBody {
    fn origin(&self) -> Origin<'_> {
        Origin::SolidLattice(&self.lattice)
    }

    fn positions(&self) -> &[[f64; 3]] {
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

    fn cloud(&self, _: f64, material_of_cell: &[u32], n_materials: usize) -> PointCloud<3> {
        PointCloud::from_lattice(&self.lattice, 1.0, material_of_cell, n_materials)
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

    fn lengths_of(&self, _: &str) -> Vec<(u32, f64)> {
        Vec::new()
    }

    /// The side of a cell spread over the layers of the set.
    fn areas_of(&self, group: &str) -> Vec<(u32, f64)> {
        self.sets.parts_of_side(group)
    }

    fn shares_at(&self, position: [f64; 3]) -> Option<Vec<(u32, f64)>> {
        self.lattice.shares_at(position)
    }

    fn outline_of(&self, group: &str) -> Result<Vec<(u32, [f64; 3])>, OffOutline> {
        Ok(self.sets.outline(group, &self.lattice))
    }

    fn rim(&self) -> Vec<bool> {
        rim(&self.lattice)
    }

    fn grid(&self) -> BodyGrid {
        let half = self.lattice.spacing.map(|side| 0.5 * side);
        let corners = |p: &[f64; 3]| {
            [-1.0, 1.0].map(|sign| [0, 1, 2].map(|axis| p[axis] + sign * half[axis]))
        };
        BodyGrid {
            numbering: self.numbering(),
            positions: self.positions.clone(),
            tags: (1..=self.positions.len() as i64).collect(),
            tagged: self.tagged(),
            canvas: Canvas::Boxes(self.positions.iter().map(corners).collect()),
        }
    }
}
