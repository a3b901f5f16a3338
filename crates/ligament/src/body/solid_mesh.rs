//! A body meshed with solid cells: points at the nodes, physical groups.

use ligament_mesh::{Cell, Group, NodeField, Numbering, SolidMesh};
use ligament_model::{BodyGrid, Canvas, PointCloud};

use super::interface::{Body, OffOutline, Origin};

/// A body with a point at each node of a mesh of solid cells, by the names of its physical groups.
#[derive(Debug)]
pub struct SolidMeshBody {
    /// The mesh, its nodes numbered along a curve.
    mesh: SolidMesh,
    numbering: Numbering,
}

impl From<SolidMesh> for SolidMeshBody {
    fn from(mesh: SolidMesh) -> Self {
        let (mesh, numbering) = mesh.along_curve();
        Self { mesh, numbering }
    }
}

impl SolidMeshBody {
    /// Union of what the groups of a name hold, whatever their dimension, ascending; `None` where there is no such group.
    fn union<T: Copy + Ord>(&self, name: &str, held: fn(&Group) -> &[T]) -> Option<Vec<T>> {
        let mut groups = self.mesh.groups_named(name).peekable();
        groups.peek()?;
        let mut all: Vec<T> = groups.flat_map(held).copied().collect();
        all.sort_unstable();
        all.dedup();
        Some(all)
    }

    /// Faces of the surface groups of a name.
    fn faces_of(&self, group: &str) -> Vec<Cell> {
        let groups = self.mesh.groups_named(group);
        groups.flat_map(|it| &it.faces).copied().collect()
    }
}

impl Body<3> for SolidMeshBody {
    fn origin(&self) -> Origin<'_> {
        Origin::SolidMesh(&self.mesh)
    }

    fn positions(&self) -> &[[f64; 3]] {
        &self.mesh.positions
    }

    fn numbering(&self) -> Numbering {
        self.numbering.clone()
    }

    fn tagged(&self) -> &'static str {
        "node"
    }

    fn tag(&self, point: u32) -> u64 {
        self.mesh.node_tags[point as usize]
    }

    fn n_cells(&self) -> usize {
        self.mesh.cells.len()
    }

    fn cloud(&self, _: f64, material_of_cell: &[u32], n_materials: usize) -> PointCloud<3> {
        PointCloud {
            numbering: self.numbering(),
            ..PointCloud::from_mesh(&self.mesh, 1.0, material_of_cell, n_materials)
        }
    }

    fn group_kind(&self) -> &'static str {
        "physical group in the mesh"
    }

    fn group_names(&self) -> Vec<String> {
        let groups = self.mesh.groups.iter();
        groups.map(|group| group.name.clone()).collect()
    }

    fn points_of(&self, group: &str) -> Option<Vec<u32>> {
        self.union(group, |group| &group.nodes)
    }

    fn cells_of(&self, group: &str) -> Option<Vec<u32>> {
        self.union(group, |group| &group.cells)
    }

    /// Half of the edges of a curve group at each of its nodes.
    fn lengths_of(&self, group: &str) -> Vec<(u32, f64)> {
        let groups = self.mesh.groups_named(group);
        let edges: Vec<[u32; 2]> = groups.flat_map(|it| &it.edges).copied().collect();
        self.mesh.lengths_at_nodes(&edges)
    }

    /// Parts of the faces of a surface group at each of their nodes.
    fn areas_of(&self, group: &str) -> Vec<(u32, f64)> {
        self.mesh.areas_at_nodes(&self.faces_of(group))
    }

    fn around(&self, point: u32) -> Vec<u32> {
        let corners = self.mesh.cells.iter().map(|cell| cell.corners());
        let around = corners.filter(|it| it.contains(&point));
        around.flatten().copied().collect()
    }

    fn shares_at(&self, position: [f64; 3]) -> Option<Vec<(u32, f64)>> {
        self.mesh.shares_at(position)
    }

    /// Parts of the area vector of each face, away from its one cell, at each of its nodes.
    fn outline_of(&self, group: &str) -> Result<Vec<(u32, [f64; 3])>, OffOutline> {
        let areas = self.mesh.outward_areas(&self.faces_of(group));
        areas.map_err(|it| OffOutline {
            side: "face",
            nodes: it.nodes,
            middle: it.middle.to_vec(),
            cells: it.cells,
        })
    }

    fn fields(&self) -> &[NodeField] {
        &self.mesh.fields
    }

    /// The nodes of faces that one cell has alone.
    fn rim(&self) -> Vec<bool> {
        self.mesh.is_on_outline()
    }

    fn remarks(&self) -> Vec<String> {
        let remarks = self.mesh.remarks.iter();
        remarks.map(|remark| format!("mesh: {remark}")).collect()
    }

    fn grid(&self) -> BodyGrid {
        BodyGrid {
            numbering: self.numbering(),
            positions: self.mesh.positions.clone(),
            tags: self.mesh.node_tags.iter().map(|&tag| tag as i64).collect(),
            tagged: self.tagged(),
            canvas: Canvas::Solid(self.mesh.cells.clone()),
        }
    }
}
