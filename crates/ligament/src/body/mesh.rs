//! A meshed body: points at the nodes, physical groups.

use std::collections::{BTreeMap, BTreeSet};

use ligament_mesh::{Cell, Group, Mesh, NodeField, Numbering};
use ligament_model::{BodyGrid, Canvas, PointCloud, raised};

use super::interface::{Body, OffOutline, Origin};

/// A body with a point at each node of a mesh, by the names of its physical groups.
#[derive(Debug)]
pub struct MeshBody {
    /// The mesh, its nodes numbered along a curve.
    mesh: Mesh,
    numbering: Numbering,
}

impl From<Mesh> for MeshBody {
    fn from(mesh: Mesh) -> Self {
        let (mesh, numbering) = mesh.along_curve();
        Self { mesh, numbering }
    }
}

impl MeshBody {
    /// For each edge of a cell, by its nodes in ascending order, how many cells have it, and the nodes in the order in which the
    /// last of these cells, on their left, goes along it.
    fn edges_of_cells(&self) -> BTreeMap<[u32; 2], (usize, [u32; 2])> {
        let mut edges = BTreeMap::new();
        for cell in &self.mesh.cells {
            let corners = cell.corners();
            let next = corners.iter().cycle().skip(1);
            for (&from, &to) in corners.iter().zip(next) {
                let edge = edges.entry(ascending([from, to])).or_insert((0, [0; 2]));
                *edge = (edge.0 + 1, [from, to]);
            }
        }
        edges
    }

    /// Union of what the groups of a name hold, whatever their dimension, ascending; `None` where there is no such group.
    fn union<T: Copy + Ord>(&self, name: &str, held: fn(&Group) -> &[T]) -> Option<Vec<T>> {
        let mut groups = self.mesh.groups_named(name).peekable();
        groups.peek()?;
        let mut all: Vec<T> = groups.flat_map(held).copied().collect();
        all.sort_unstable();
        all.dedup();
        Some(all)
    }
}

impl Body for MeshBody {
    fn origin(&self) -> Origin<'_> {
        Origin::Mesh(&self.mesh)
    }

    fn positions(&self) -> &[[f64; 2]] {
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

    fn cloud(&self, thickness: f64, material_of_cell: &[u32], n_materials: usize) -> PointCloud {
        PointCloud {
            numbering: self.numbering(),
            ..PointCloud::from_mesh(&self.mesh, thickness, material_of_cell, n_materials)
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
        let mut lengths = BTreeMap::new();
        for edge in self.mesh.groups_named(group).flat_map(|group| &group.edges) {
            let [p, q] = edge.map(|node| self.mesh.positions[node as usize]);
            for &node in edge {
                *lengths.entry(node).or_insert(0.0) += 0.5 * (q[0] - p[0]).hypot(q[1] - p[1]);
            }
        }
        lengths.into_iter().collect()
    }

    fn around(&self, point: u32) -> Vec<u32> {
        let corners = self.mesh.cells.iter().map(Cell::corners);
        let around = corners.filter(|it| it.contains(&point));
        around.flatten().copied().collect()
    }

    fn cells(&self) -> &[Cell] {
        &self.mesh.cells
    }

    fn fields(&self) -> &[NodeField] {
        &self.mesh.fields
    }

    fn shares_at(&self, position: [f64; 2]) -> Option<Vec<(u32, f64)>> {
        self.mesh.shares_at(position)
    }

    /// Half of the normal of each edge, away from its one cell, at each of its nodes.
    fn outline_of(&self, group: &str) -> Result<Vec<(u32, [f64; 2])>, OffOutline> {
        let groups = self.mesh.groups_named(group);
        let edges: BTreeSet<[u32; 2]> = groups
            .flat_map(|group| &group.edges)
            .map(|&edge| ascending(edge))
            .collect();
        if edges.is_empty() {
            return Ok(Vec::new());
        }
        let of_cells = self.edges_of_cells();
        let mut normals = BTreeMap::new();
        for edge in edges {
            let (cells, along) = of_cells.get(&edge).copied().unwrap_or((0, edge));
            let [p, q] = along.map(|node| self.mesh.positions[node as usize]);
            if cells != 1 {
                return Err(OffOutline {
                    side: "edge",
                    nodes: edge.map(|node| self.tag(node)).to_vec(),
                    middle: (0..2).map(|axis| 0.5 * (p[axis] + q[axis])).collect(),
                    cells,
                });
            }
            // Corners stand counter-clockwise: the outside is on the right.
            let half = [0.5 * (q[1] - p[1]), 0.5 * (p[0] - q[0])];
            for node in edge {
                let sum = normals.entry(node).or_insert([0.0; 2]);
                *sum = [0, 1].map(|axis| sum[axis] + half[axis]);
            }
        }
        Ok(normals.into_iter().collect())
    }

    /// The nodes of edges that one cell has alone.
    fn rim(&self) -> Vec<bool> {
        let mut marked = vec![false; self.mesh.positions.len()];
        let edges = self.edges_of_cells();
        let outer = edges.iter().filter(|(_, (cells, _))| *cells == 1);
        for node in outer.flat_map(|(edge, _)| edge) {
            marked[*node as usize] = true;
        }
        marked
    }

    fn remarks(&self) -> Vec<String> {
        let remarks = self.mesh.remarks.iter();
        remarks.map(|remark| format!("mesh: {remark}")).collect()
    }

    fn grid(&self) -> BodyGrid {
        BodyGrid {
            numbering: self.numbering(),
            positions: raised(&self.mesh.positions),
            tags: self.mesh.node_tags.iter().map(|&tag| tag as i64).collect(),
            tagged: self.tagged(),
            canvas: Canvas::Between(self.mesh.cells.clone()),
        }
    }
}

fn ascending([a, b]: [u32; 2]) -> [u32; 2] {
    [a.min(b), a.max(b)]
}
