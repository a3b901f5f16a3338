//! A body on a lattice: points at the centres of the cells, named sets.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::sync::Arc;

use ligament_mesh::Portion;
use ligament_model::bonds::hole::bonds_across;
use ligament_model::bonds::parts::LatticeCells;
use ligament_model::cloud::lattice::Lattice;
use ligament_model::correction::patch::{self, CellForces};
use ligament_model::material::Stiffness;
use ligament_model::shape::{Shape, SolidShape};
use ligament_model::surface::{CellFaces, Facet};
use ligament_model::volumetric::VolumetricCells;
use ligament_model::{BodyGrid, BondSet, Numbering, PointCloud, PointTags, Tags, raised};

use super::cells::{self, CellSets, Cells, Hole, LatticeError, rim};
use super::interface::{Body, Geometry, OffOutline, Origin, Restricted};
use super::lattice_cells::LatticeShape;

/// A body with a point at the centre of each cell of a lattice, and named sets of its cells.
#[derive(Debug)]
pub struct BodyOnLattice<const D: usize, S> {
    /// Cells of the points; names of a divided body share them.
    lattice: Arc<Lattice<D, S>>,
    numbering: Numbering,
    sets: CellSets<D>,
}

/// A lattice in the plane.
pub type LatticeBody = BodyOnLattice<2, Shape>;

/// A box of equal cells in space.
pub type SolidLatticeBody = BodyOnLattice<3, SolidShape>;

impl<const D: usize, S: LatticeShape<D>> BodyOnLattice<D, S> {
    /// A lattice with named sets of cells and with holes; named holes are groups too, unless a set has the hole's name.
    ///
    /// # Errors
    ///
    /// If the holes remove all cells, or a set or the rim of a named hole has no cell.
    pub fn new(
        size: [u32; D],
        spacing: [f64; D],
        corner: [f64; D],
        holes: &[Hole<S>],
        named: &BTreeMap<String, Cells<D, S>>,
    ) -> Result<Self, LatticeError> {
        let lattice = cells::lattice(size, spacing, corner, holes)?;
        let named = named.iter().map(|(name, set)| (name.clone(), set.clone()));
        Ok(Self {
            sets: CellSets::new(&lattice, holes, named)?,
            numbering: Numbering::default(),
            lattice: Arc::new(lattice),
        })
    }
}

impl<const D: usize, S: LatticeShape<D>> Body for BodyOnLattice<D, S> {
    fn origin(&self) -> Origin<'_> {
        S::origin(&self.lattice)
    }

    fn n_points(&self) -> usize {
        self.lattice.cells.len()
    }

    fn position(&self, point: u32) -> Vec<f64> {
        self.lattice.position(point).to_vec()
    }

    fn numbering(&self) -> Numbering {
        self.numbering.clone()
    }

    fn tagged(&self) -> &'static str {
        "cell"
    }

    /// Number of the remaining cell, from 1.
    fn tag(&self, point: u32) -> u64 {
        u64::from(self.numbering.in_file(point)) + 1
    }

    fn n_cells(&self) -> usize {
        self.lattice.cells.len()
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

    /// Length of a cell's side divided by the number of rows or columns of the set, at each point; empty in space.
    fn lengths_of(&self, group: &str) -> Vec<Portion<1>> {
        match D {
            2 => self.sets.parts_of_side(group),
            _ => Vec::new(),
        }
    }

    /// Area of a cell's side divided by the number of layers of the set, at each point; empty in the plane.
    fn areas_of(&self, group: &str) -> Vec<Portion<1>> {
        match D {
            2 => Vec::new(),
            _ => self.sets.parts_of_side(group),
        }
    }

    fn point_tags(&self) -> PointTags {
        PointTags {
            numbering: self.numbering(),
            tags: Tags::Counted(1),
        }
    }

    fn names(self: Arc<Self>) -> Arc<dyn Body> {
        Arc::new(Self {
            lattice: self.lattice.clone(),
            numbering: self.numbering.clone(),
            sets: self.sets.part(&[]),
        })
    }

    fn rim(&self) -> Vec<bool> {
        rim(&self.lattice)
    }

    fn grid(&self) -> BodyGrid {
        let positions = self.positions();
        BodyGrid {
            numbering: self.numbering(),
            positions: raised(&positions),
            tags: (0..positions.len() as u32)
                .map(|point| i64::from(self.numbering.in_file(point)) + 1)
                .collect(),
            cell_numbers: Vec::new(),
            of_body: None,
            tagged: self.tagged(),
            canvas: S::canvas(&positions, self.lattice.spacing.map(|side| 0.5 * side)),
        }
    }
}

impl<const D: usize, S: LatticeShape<D>> Geometry<D> for BodyOnLattice<D, S> {
    fn positions(&self) -> Cow<'_, [[f64; D]]> {
        let points = 0..self.lattice.cells.len() as u32;
        points.map(|point| self.lattice.position(point)).collect()
    }

    fn cloud(&self, thickness: f64, material_of_cell: &[u32], n_materials: usize) -> PointCloud<D> {
        PointCloud::from_lattice(&self.lattice, thickness, material_of_cell, n_materials)
    }

    fn undivided(&self, thickness: f64, _: &[u32], n_materials: usize) -> PointCloud<D> {
        PointCloud::centres(&self.lattice, thickness, n_materials)
    }

    fn completed(&self, cloud: PointCloud<D>, material_of_cell: &[u32]) -> PointCloud<D> {
        cloud.with_cells(material_of_cell)
    }

    fn restricted(&self, points: &[u32], _: &[u32]) -> Restricted<D> {
        Restricted {
            body: Arc::new(Self {
                lattice: Arc::new(self.lattice.part(points)),
                numbering: self.numbering.part(points),
                sets: self.sets.part(points),
            }),
            cells: points.to_vec(),
        }
    }

    fn interpolation_weights(&self, position: [f64; D]) -> Option<Vec<(u32, f64)>> {
        self.lattice.interpolation_weights(position)
    }

    fn outline_of(&self, group: &str) -> Result<Vec<Portion<D>>, OffOutline> {
        Ok(self.sets.outline(group, &self.lattice))
    }

    fn facets(&self, cloud: &PointCloud<D>) -> Vec<Facet<D>> {
        Facet::outline(&self.lattice, cloud)
    }

    fn cell_faces(&self, cloud: &PointCloud<D>) -> Option<CellFaces<D>> {
        Some(CellFaces::from_lattice(&self.lattice, cloud))
    }

    fn crosses_holes(&self, bonds: &BondSet<D>, cloud: &PointCloud<D>) -> Vec<bool> {
        match self.lattice.holes.is_empty() {
            true => Vec::new(),
            false => bonds_across(&self.lattice.holes, bonds, cloud),
        }
    }

    fn volumetric_cells(
        &self,
        cloud: &PointCloud<D>,
        material_of_cell: &[u32],
        moduli: &[f64],
    ) -> VolumetricCells<D> {
        VolumetricCells::from_lattice(&self.lattice, cloud, material_of_cell, moduli)
    }

    fn composed(&self, bonds: BondSet<D>, cloud: &PointCloud<D>, materials: &[u32]) -> BondSet<D> {
        let cells = LatticeCells {
            cloud,
            size: self.lattice.spacing,
            materials,
        };
        bonds.through(&cells, cloud)
    }

    fn cell_forces(
        &self,
        cloud: &PointCloud<D>,
        material_of_cell: &[u32],
        stiffness: Vec<Stiffness>,
    ) -> CellForces<D> {
        patch::forces_of_lattice(&self.lattice, cloud, material_of_cell, &stiffness)
    }
}
