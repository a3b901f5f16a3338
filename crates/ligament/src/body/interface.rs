//! What a computation needs to know of a body.

use std::fmt::Debug;

use ligament_mesh::{Cell, Mesh, NodeField, Numbering, SolidMesh};
use ligament_model::cloud::lattice::SolidLattice;
use ligament_model::{BodyGrid, Lattice, PointCloud, Shape};
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

/// A body as a computation sees it: points, groups and outline, whatever the points come from.
pub trait Body<const D: usize = 2>: Debug + Send + Sync {
    /// Origin of the points.
    fn origin(&self) -> Origin<'_>;

    /// Positions of the points, shape (n_points), m.
    fn positions(&self) -> &[[f64; D]];

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

    /// The material points; `material_of_cell` (n_cells) holds the index of each cell's material.
    fn cloud(&self, thickness: f64, material_of_cell: &[u32], n_materials: usize) -> PointCloud<D>;

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

    /// The other points of the cells at a point; none where there are no cells between points.
    fn around(&self, _point: u32) -> Vec<u32> {
        Vec::new()
    }

    /// Points and their shares, which add up to one, in a value at a position (m), by the cell around it; None off the cells, and for a body
    /// without cells.
    fn shares_at(&self, _position: [f64; D]) -> Option<Vec<(u32, f64)>> {
        None
    }

    /// Outward normals of the outline along a group times their lengths, m, in space times their areas, m^2, added up at its points: half
    /// of an edge of a mesh at each of its nodes, a face of a lattice at its cell. Empty where no part of the group is an edge or a face.
    ///
    /// # Errors
    ///
    /// If an edge of the group is none of the outline.
    fn outline_of(&self, group: &str) -> Result<Vec<(u32, [f64; D])>, OffOutline>;

    /// Cells of a meshed body, whose points are their corners; empty for others.
    fn cells(&self) -> &[Cell] {
        &[]
    }

    /// Holes across which there is no bond.
    fn holes(&self) -> &[Shape] {
        &[]
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
        let position = &self.positions()[point as usize];
        format!("{} at ({})", self.label(point), coordinates(position))
    }
}
