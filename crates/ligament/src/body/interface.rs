//! Interface between a computation and its body.

use std::borrow::Cow;
use std::fmt::Debug;
use std::io::Read;
use std::sync::Arc;

use ligament_analysis::serial::{Damaged, Sink};
use ligament_analysis::user_message::PointNames;
use ligament_mesh::{Cell, Mesh, NodeField, Numbering, Portion, SolidMesh};
use ligament_model::cloud::lattice::SolidLattice;
use ligament_model::correction::patch::CellForces;
use ligament_model::material::Stiffness;
use ligament_model::surface::{CellFaces, Facet};
use ligament_model::volumetric::VolumetricCells;
use ligament_model::{BodyGrid, BondSet, BondSystem, Lattice, PointCloud, PointTags};
use thiserror::Error;

use crate::coordinates::coordinates;

/// Error of a group under pressure, or of a quiet edge, that has an edge (in a solid a face) not on the outline of the body.
#[derive(Debug, Clone, PartialEq, Error)]
#[error(
    "pressures and quiet edges are on the outline of the body, but the {side} of this group {}, around ({}), {}",
    from_node_to_node(.nodes), coordinates(.middle),
    if *.cells == 0 { format!("is no {side} of a cell") } else { "has cells on both sides".to_owned() }
)]
pub struct OffOutline {
    /// Kind of the side: `edge` or `face`.
    pub side: &'static str,
    /// Tags of the side's nodes.
    pub nodes: Vec<u64>,
    /// Midpoint of the side, m.
    pub middle: Vec<f64>,
    /// Number of cells with this side.
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

/// The outline of a meshed body, which bonds must not cross.
pub trait BodyOutline<const D: usize> {
    /// The nodes of the first edge that passes through a side of the outline; none where cells do not overlap.
    fn first_crossing(&self) -> Option<[u32; 2]>;

    /// Distance of each node to the nearest other node whose connecting line stays within the outline, shape (n_points), m.
    fn spacing(&self, cloud: &PointCloud<D>) -> Vec<f64>;

    /// Whether the straight line of each bond leaves the outline, shape (n_bonds).
    fn is_crossed_by_bonds(&self, bonds: &BondSet<D>, cloud: &PointCloud<D>) -> Vec<bool>;
}

/// A body of points and groups, independent of the origin of the points and of the dimension; [`Geometry`] adds the coordinates.
pub trait Body: Debug + Send + Sync {
    /// Origin of the points.
    fn origin(&self) -> Origin<'_>;

    /// Number of points.
    fn n_points(&self) -> usize;

    /// Coordinates of a point, as many as the body has dimensions, m.
    fn position(&self, point: u32) -> Vec<f64>;

    /// Numbering of the points, here and in the file or the arrays of their origin.
    fn numbering(&self) -> Numbering {
        Numbering::default()
    }

    /// The noun that tags belong to: `node`, `cell` or `point`.
    fn tagged(&self) -> &'static str;

    /// Tag of a point in messages and results.
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

    /// Portions of a group with the lengths (m) that their points represent: edges of a mesh, points of a lattice; empty where the group has no
    /// length.
    fn lengths_of(&self, group: &str) -> Vec<Portion<1>>;

    /// Portions of a group with the areas (m^2) of the solid's surface that their points represent: triangles of faces of a mesh, points of a
    /// lattice; empty where the group has no area.
    fn areas_of(&self, _group: &str) -> Vec<Portion<1>> {
        Vec::new()
    }

    /// Faces of the surface groups of a name; `None` for bodies without a mesh.
    fn faces_of(&self, _group: &str) -> Option<Vec<Cell>> {
        None
    }

    /// Edges of the curve groups of a name; empty for bodies without a mesh.
    fn curve_of(&self, _group: &str) -> Vec<[u32; 2]> {
        Vec::new()
    }

    /// The other points of the cells at a point; empty where the body has no cells between points.
    fn around(&self, _point: u32) -> Vec<u32> {
        Vec::new()
    }

    /// Corners of the cells of a meshed body, shape (n_cells, corners); empty for other bodies.
    fn corners(&self) -> Vec<&[u32]> {
        Vec::new()
    }

    /// Edges of the cells of a meshed body; empty for other bodies.
    fn edges(&self) -> Vec<[u32; 2]> {
        Vec::new()
    }

    /// Fields of values at the points from the file of the body.
    fn fields(&self) -> &[NodeField] {
        &[]
    }

    /// Whether each point lies at the edge of the body or of a hole, shape (n_points).
    fn rim(&self) -> Vec<bool>;

    /// Remarks about the body for the user.
    fn remarks(&self) -> Vec<String> {
        Vec::new()
    }

    /// Numbering and tags of the points.
    fn point_tags(&self) -> PointTags;

    /// Grid of the body for result files.
    fn grid(&self) -> BodyGrid;

    /// The points of the body without cells and groups, for their descriptions.
    fn names(self: Arc<Self>) -> Arc<dyn Body>;

    /// Description of a point for messages: "node 12".
    fn label(&self, point: u32) -> String {
        format!("{} {}", self.tagged(), self.tag(point))
    }

    /// Description of a point for messages, with its position.
    fn place(&self, point: u32) -> String {
        let position = coordinates(&self.position(point));
        format!("{} at ({position})", self.label(point))
    }
}

impl PointNames for &dyn Body {
    fn name(&self, point: u32) -> String {
        self.label(point)
    }

    fn name_and_position(&self, point: u32) -> String {
        self.place(point)
    }

    fn sorted(&self, points: &[u32]) -> Vec<u32> {
        self.numbering().sorted(points).into_owned()
    }
}

/// A meshed body; only rank 0 of several processes has all cells.
pub trait MeshedBody<const D: usize> {
    /// Corners of a cell.
    fn corners_of(&self, cell: u32) -> &[u32];

    /// The material points without volumes, materials and nearest distances, which follow from the cells.
    fn nodes(&self, thickness: f64, n_materials: usize) -> PointCloud<D>;

    /// Appends the bytes of the nodes without cells and groups.
    fn write_nodes(&self, out: &mut dyn Sink);

    /// Appends the bytes of the body.
    fn write(&self, out: &mut dyn Sink);

    /// Reads a body of the same kind of cells.
    ///
    /// # Errors
    ///
    /// If the bytes encode no such body.
    fn read(&self, from: &mut dyn Read) -> Result<Arc<dyn Geometry<D>>, Damaged>;
}

/// A body with some of its points.
pub struct Restricted<const D: usize> {
    /// The points, in the order of the whole body, and the cells that have no other corners.
    pub body: Arc<dyn Geometry<D>>,
    /// Numbers of these cells in the whole body, ascending.
    pub cells: Vec<u32>,
}

/// The geometry of a body in D dimensions.
pub trait Geometry<const D: usize>: Body {
    /// Positions of the points, shape (n_points), m.
    fn positions(&self) -> Cow<'_, [[f64; D]]>;

    /// The material points; `material_of_cell` (n_cells) has the index of each cell's material.
    fn cloud(&self, thickness: f64, material_of_cell: &[u32], n_materials: usize) -> PointCloud<D>;

    /// The material points with the data that determine their owners; [`Geometry::completed`] adds the rest to all or a part of them.
    fn undivided(
        &self,
        thickness: f64,
        material_of_cell: &[u32],
        n_materials: usize,
    ) -> PointCloud<D> {
        self.cloud(thickness, material_of_cell, n_materials)
    }

    /// Completes the material points of [`Geometry::undivided`] for this body.
    fn completed(&self, cloud: PointCloud<D>, _material_of_cell: &[u32]) -> PointCloud<D> {
        cloud
    }

    /// The body with some of its points (ascending), and with the `cells` (ascending) that have no other corners; groups keep their names
    /// where they lose all points. A body without cells between points has the cells of the points.
    fn restricted(&self, points: &[u32], cells: &[u32]) -> Restricted<D>;

    /// The body as a meshed one, whose cells rank 0 sends to the other ranks; `None` for bodies without cells between points, which
    /// each process makes by itself.
    fn meshed(&self) -> Option<&dyn MeshedBody<D>> {
        None
    }

    /// Points of the cell around a position (m) and their interpolation weights, which sum to one; `None` outside of all cells and for
    /// bodies without cells.
    fn interpolation_weights(&self, _position: [f64; D]) -> Option<Vec<(u32, f64)>> {
        None
    }

    /// Portions of the outline along a group with outward normals times lengths (m), in space times areas (m^2): half of an edge of a mesh for
    /// each of its nodes, the faces of a lattice's cell for its point. Empty where no part of the group is an edge or a face.
    ///
    /// # Errors
    ///
    /// If an edge of the group is not on the outline.
    fn outline_of(&self, group: &str) -> Result<Vec<Portion<D>>, OffOutline>;

    /// Corners of the outline's sides of a meshed body, each side of only one cell, ordered so that the outside is known; empty for other
    /// bodies.
    fn outer_sides(&self) -> Vec<[u32; D]> {
        Vec::new()
    }

    /// Facets of the outline between the points of a cloud; empty for bodies without cells.
    fn facets(&self, _cloud: &PointCloud<D>) -> Vec<Facet<D>> {
        Vec::new()
    }

    /// The cells around the points of a cloud by their faces, which cracks open; none for bodies without cells.
    fn cell_faces(&self, _cloud: &PointCloud<D>) -> Option<CellFaces<D>> {
        None
    }

    /// A body of some of the cells (ascending) of a meshed body, with their points in the order of this body and without groups; `None` for
    /// other bodies.
    fn part(&self, _cells: &[usize]) -> Option<Arc<dyn Geometry<D>>> {
        None
    }

    /// Bonds between the points of a meshed body with some of its cells (ascending) as linear finite elements; `material_of_cell` (n_cells)
    /// has the index of each cell's material. Unchanged for other bodies.
    fn with_far_field(
        &self,
        system: BondSystem<D>,
        _cells: &[usize],
        _material_of_cell: &[u32],
    ) -> BondSystem<D> {
        system
    }

    /// Cells between the points of a cloud that may carry a volumetric stiffness, with the moduli kappa of the materials (n_materials, Pa);
    /// `material_of_cell` (n_cells) has the index of each cell's material. None for a body without cells.
    fn volumetric_cells(
        &self,
        _cloud: &PointCloud<D>,
        _material_of_cell: &[u32],
        _moduli: &[f64],
    ) -> VolumetricCells<D> {
        VolumetricCells::default()
    }

    /// The outline of a meshed body with its nodes at the points of a cloud; `None` for other bodies.
    fn outline(&self, _cloud: &PointCloud<D>) -> Option<Box<dyn BodyOutline<D> + '_>> {
        None
    }

    /// Whether a hole of a lattice is between the ends of each bond, shape (n_bonds); empty where there is no hole.
    fn crosses_holes(&self, _bonds: &BondSet<D>, _cloud: &PointCloud<D>) -> Vec<bool> {
        Vec::new()
    }

    /// Bonds with their composition from the materials of the cells that they cross; `materials` (n_cells) has the index of each cell's
    /// material. Unchanged where the body has no cells.
    fn composed(
        &self,
        bonds: BondSet<D>,
        _cloud: &PointCloud<D>,
        _materials: &[u32],
    ) -> BondSet<D> {
        bonds
    }

    /// Forces of uniform strains on the points of a cloud, computed from the cells of the body; `material_of_cell` (n_cells) has the index
    /// of each cell's material, `stiffness` (n_materials) its stiffness, Pa.
    fn cell_forces(
        &self,
        cloud: &PointCloud<D>,
        material_of_cell: &[u32],
        stiffness: Vec<Stiffness>,
    ) -> CellForces<D>;
}
