//! What a computation needs to know of a body.

use std::fmt::Debug;
use std::sync::Arc;

use ligament_mesh::{Cell, Mesh, NodeField, Numbering, SolidMesh};
use ligament_model::cloud::lattice::SolidLattice;
use ligament_model::correction::patch::CellForces;
use ligament_model::material::Stiffness;
use ligament_model::{BodyGrid, BondSet, Lattice, PointCloud};
use thiserror::Error;

use crate::coordinates::coordinates;

/// An edge of a group, of a solid a face, that is none of the outline of the body, on which a pressure could act.
#[derive(Debug, Clone, PartialEq, Error)]
#[error(
    "a pressure acts on the outline of the body, but the {side} of this group {}, around ({}), {}",
    from_node_to_node(.nodes), coordinates(.middle),
    if *.cells == 0 { format!("is no {side} of a cell") } else { "has cells on both sides".to_owned() }
)]
pub struct OffOutline {
    /// What it is: `edge` or `face`.
    pub side: &'static str,
    /// Tags of its nodes.
    pub nodes: Vec<u64>,
    /// Middle, m.
    pub middle: Vec<f64>,
    /// Number of cells that have it.
    pub cells: usize,
}

fn from_node_to_node(nodes: &[u64]) -> String {
    let nodes: Vec<String> = nodes.iter().map(|node| format!("node {node}")).collect();
    format!("from {}", nodes.join(" to "))
}

/// Origin of a body's points.
#[derive(Debug, Clone, Copy)]
pub enum Origin<'a> {
    /// A mesh with a point at each node.
    Mesh(&'a Mesh),
    /// A lattice with a point at the centre of each cell.
    Lattice(&'a Lattice),
    /// A mesh of solid cells with a point at each node.
    SolidMesh(&'a SolidMesh),
    /// A lattice in space with a point at the centre of each cell.
    SolidLattice(&'a SolidLattice),
    /// Arrays of points.
    Points,
}

/// The outline of a meshed body, which bonds do not leave.
pub trait BodyOutline<const D: usize> {
    /// The nodes of an edge that passes through a side of the outline, the first of them all; none where cells do not overlap.
    fn first_crossing(&self) -> Option<[u32; 2]>;

    /// Distance of each node to the nearest other one that it sees within the outline, shape (n_points), m.
    fn spacing(&self, cloud: &PointCloud<D>) -> Vec<f64>;

    /// For each bond, whether its straight line leaves the outline, shape (n_bonds).
    fn is_crossed_by_bonds(&self, bonds: &BondSet<D>, cloud: &PointCloud<D>) -> Vec<bool>;
}

/// A body as a computation sees it: points and groups, whatever the points come from. Its [`Geometry`] has as many coordinates as the body
/// has dimensions.
pub trait Body: Debug + Send + Sync {
    /// Origin of the points.
    fn origin(&self) -> Origin<'_>;

    /// Number of points.
    fn n_points(&self) -> usize;

    /// Coordinates of a point, as many as the body has dimensions, m.
    fn position(&self, point: u32) -> &[f64];

    /// How the points are numbered: here, and in the file or the arrays that they come from.
    fn numbering(&self) -> Numbering {
        Numbering::default()
    }

    /// The noun that tags belong to: `node`, `cell` or `point`.
    fn tagged(&self) -> &'static str;

    /// The tag that a point goes by.
    fn tag(&self, point: u32) -> u64;

    /// Number of cells, each of which has one material.
    fn n_cells(&self) -> usize;

    /// Kind of the body's groups, for errors: "physical group in the mesh".
    fn group_kind(&self) -> &'static str;

    /// Names of the groups.
    fn group_names(&self) -> Vec<String>;

    /// Points of the group of this name, ascending; `None` where there is no such group.
    fn points_of(&self, group: &str) -> Option<Vec<u32>>;

    /// Cells of the group of this name, empty where it has only points; `None` where there is no such group.
    fn cells_of(&self, group: &str) -> Option<Vec<u32>>;

    /// Length that each point of a group stands for, m; empty where the group has no length.
    fn lengths_of(&self, group: &str) -> Vec<(u32, f64)>;

    /// Area of the surface of a solid that each point of a group stands for, m^2; empty where the group has no area.
    fn areas_of(&self, _group: &str) -> Vec<(u32, f64)> {
        Vec::new()
    }

    /// Faces of the surface groups of a name; none of bodies without a mesh.
    fn faces_of(&self, _group: &str) -> Option<Vec<Cell>> {
        None
    }

    /// The other points of the cells at a point; none where there are no cells between points.
    fn around(&self, _point: u32) -> Vec<u32> {
        Vec::new()
    }

    /// Corners of the cells of a meshed body, shape (n_cells, corners); empty for others.
    fn corners(&self) -> Vec<&[u32]> {
        Vec::new()
    }

    /// Edges of the cells of a meshed body; empty for others.
    fn edges(&self) -> Vec<[u32; 2]> {
        Vec::new()
    }

    /// Values at the points that the file of the body brings along.
    fn fields(&self) -> &[NodeField] {
        &[]
    }

    /// Marks of the points on the rim, at the edge of the body or of a hole (n_points).
    fn rim(&self) -> Vec<bool>;

    /// Remarks about the body that the user should know.
    fn remarks(&self) -> Vec<String> {
        Vec::new()
    }

    /// The body as result files show it.
    fn grid(&self) -> BodyGrid;

    /// A point in words: "node 12".
    fn label(&self, point: u32) -> String {
        format!("{} {}", self.tagged(), self.tag(point))
    }

    /// A point in words, and where it is.
    fn place(&self, point: u32) -> String {
        let position = coordinates(self.position(point));
        format!("{} at ({position})", self.label(point))
    }
}

/// The geometry of a body in D dimensions.
pub trait Geometry<const D: usize>: Body {
    /// Positions of the points, shape (n_points), m.
    fn positions(&self) -> &[[f64; D]];

    /// The material points; `material_of_cell` (n_cells) holds the index of each cell's material.
    fn cloud(&self, thickness: f64, material_of_cell: &[u32], n_materials: usize) -> PointCloud<D>;

    /// Points and their shares, which add up to one, in a value at a position (m), by the cell around it; None off the cells, and for a body
    /// without cells.
    fn interpolation_weights(&self, _position: [f64; D]) -> Option<Vec<(u32, f64)>> {
        None
    }

    /// Outward normals of the outline along a group times their lengths, m, in space times their areas, m^2, added up at its points: half
    /// of an edge of a mesh at each of its nodes, a face of a lattice at its cell. Empty where no part of the group is an edge or a face.
    ///
    /// # Errors
    ///
    /// If an edge of the group is none of the outline.
    fn outline_of(&self, group: &str) -> Result<Vec<(u32, [f64; D])>, OffOutline>;

    /// Corners of the sides that one cell of a meshed body has alone, in an order that tells inside from outside; empty for others.
    fn outer_sides(&self) -> Vec<[u32; D]> {
        Vec::new()
    }

    /// A body of some of the cells (ascending) of a meshed one, without its groups; none of others.
    fn part(&self, _cells: &[usize]) -> Option<Arc<dyn Geometry<D>>> {
        None
    }

    /// The outline of a meshed body with its nodes at the points of a cloud; none of others.
    fn outline(&self, _cloud: &PointCloud<D>) -> Option<Box<dyn BodyOutline<D> + '_>> {
        None
    }

    /// For each bond, whether a hole of a lattice is between its ends, shape (n_bonds); empty where there is no hole.
    fn crosses_holes(&self, _bonds: &BondSet<D>, _cloud: &PointCloud<D>) -> Vec<bool> {
        Vec::new()
    }

    /// Bonds followed through cells with the index of the material of each (n_cells); as they are where there are no cells.
    fn composed(
        &self,
        bonds: BondSet<D>,
        _cloud: &PointCloud<D>,
        _materials: &[u32],
    ) -> BondSet<D> {
        bonds
    }

    /// Forces of uniform strains on the points of a cloud, as the cells of the body know them, with the stiffness of each material
    /// (n_materials, Pa) and the index of that of each cell (n_cells).
    fn cell_forces(
        &self,
        cloud: &PointCloud<D>,
        material_of_cell: &[u32],
        stiffness: Vec<Stiffness>,
    ) -> CellForces<D>;
}
