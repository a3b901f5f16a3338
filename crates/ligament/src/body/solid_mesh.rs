//! A body meshed with solid cells: points at the nodes, physical groups.

use std::collections::{BTreeMap, BTreeSet};

use ligament_mesh::{Cell, Faces, Group, NodeField, SolidMesh};
use ligament_model::{BodyGrid, Canvas, PointCloud};

use super::interface::{Body, OffOutline, Origin};

/// A body with a point at each node of a mesh of solid cells, by the names of its physical groups.
#[derive(Debug)]
pub struct SolidMeshBody(SolidMesh);

impl From<SolidMesh> for SolidMeshBody {
    fn from(mesh: SolidMesh) -> Self {
        Self(mesh)
    }
}

impl SolidMeshBody {
    /// Union of what the groups of a name hold, whatever their dimension, ascending; `None` where there is no such group.
    fn union<T: Copy + Ord>(&self, name: &str, held: fn(&Group) -> &[T]) -> Option<Vec<T>> {
        let mut groups = self.0.groups_named(name).peekable();
        groups.peek()?;
        let mut all: Vec<T> = groups.flat_map(held).copied().collect();
        all.sort_unstable();
        all.dedup();
        Some(all)
    }

    /// Faces of the surface groups of a name, each once.
    fn faces_of(&self, group: &str) -> Vec<Cell> {
        let faces = self.0.groups_named(group).flat_map(|it| &it.faces);
        let sorted = |face: &Cell| {
            let mut corners = face.corners().to_vec();
            corners.sort_unstable();
            corners
        };
        let once: BTreeMap<Vec<u32>, Cell> = faces.map(|it| (sorted(it), *it)).collect();
        once.into_values().collect()
    }

    /// Parts of the area vector of a face at its corners, m^2: of a triangle a third each, of a quadrangle what its shape functions make of
    /// the two triangles on either side of each diagonal in the mean.
    fn areas_at_corners(&self, face: &Cell) -> Vec<(u32, [f64; 3])> {
        let place = |node: u32| self.0.positions[node as usize];
        let of_triangle = |[a, b, c]: [u32; 3]| {
            let cross = cross(less(place(b), place(a)), less(place(c), place(a)));
            cross.map(|it| it / 6.0)
        };
        match *face {
            Cell::Triangle(corners) => {
                let third = of_triangle(corners);
                corners.map(|node| (node, third)).to_vec()
            }
            Cell::Quadrangle([a, b, c, d]) => {
                let mut areas = BTreeMap::new();
                for triangle in [[a, b, c], [a, c, d], [a, b, d], [b, c, d]] {
                    let third = of_triangle(triangle);
                    for node in triangle {
                        let sum = areas.entry(node).or_insert([0.0; 3]);
                        *sum = [0, 1, 2].map(|axis| sum[axis] + 0.5 * third[axis]);
                    }
                }
                areas.into_iter().collect()
            }
        }
    }
}

impl Body<3> for SolidMeshBody {
    fn origin(&self) -> Origin<'_> {
        Origin::SolidMesh(&self.0)
    }

    fn positions(&self) -> &[[f64; 3]] {
        &self.0.positions
    }

    fn tagged(&self) -> &'static str {
        "node"
    }

    fn tag(&self, point: u32) -> u64 {
        self.0.node_tags[point as usize]
    }

    fn n_cells(&self) -> usize {
        self.0.cells.len()
    }

    fn cloud(&self, _: f64, material_of_cell: &[u32], n_materials: usize) -> PointCloud<3> {
        PointCloud::from_solid_mesh(&self.0, material_of_cell, n_materials)
    }

    fn group_kind(&self) -> &'static str {
        "physical group in the mesh"
    }

    fn group_names(&self) -> Vec<String> {
        let groups = self.0.groups.iter();
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
        for edge in self.0.groups_named(group).flat_map(|group| &group.edges) {
            let [p, q] = edge.map(|node| self.0.positions[node as usize]);
            for &node in edge {
                *lengths.entry(node).or_insert(0.0) += 0.5 * norm(less(q, p));
            }
        }
        lengths.into_iter().collect()
    }

    /// Parts of the faces of a surface group at each of their nodes.
    fn areas_of(&self, group: &str) -> Vec<(u32, f64)> {
        let mut areas = BTreeMap::new();
        for face in self.faces_of(group) {
            for (node, area) in self.areas_at_corners(&face) {
                *areas.entry(node).or_insert(0.0) += norm(area);
            }
        }
        areas.into_iter().collect()
    }

    fn around(&self, point: u32) -> Vec<u32> {
        let corners = self.0.cells.iter().map(|cell| cell.corners());
        let around = corners.filter(|it| it.contains(&point));
        around.flatten().copied().collect()
    }

    /// Parts of the area vector of each face, away from its one cell, at each of its nodes.
    fn outline_of(&self, group: &str) -> Result<Vec<(u32, [f64; 3])>, OffOutline> {
        let faces = self.faces_of(group);
        if faces.is_empty() {
            return Ok(Vec::new());
        }
        let of_cells = Faces::new(&self.0.cells, self.0.positions.len());
        let mut normals = BTreeMap::new();
        for face in faces {
            let sides = of_cells.sides_at(&face);
            let [side] = sides.as_slice() else {
                return Err(self.off_outline(&face, sides.len()));
            };
            for (node, area) in self.areas_at_corners(&side.face) {
                let sum = normals.entry(node).or_insert([0.0; 3]);
                *sum = [0, 1, 2].map(|axis| sum[axis] + area[axis]);
            }
        }
        Ok(normals.into_iter().collect())
    }

    fn fields(&self) -> &[NodeField] {
        &self.0.fields
    }

    /// The nodes of faces that one cell has alone.
    fn rim(&self) -> Vec<bool> {
        let mut marked = vec![false; self.0.positions.len()];
        let outer = Faces::new(&self.0.cells, marked.len()).outer();
        let nodes: BTreeSet<u32> = outer
            .iter()
            .flat_map(|it| it.face.corners().to_vec())
            .collect();
        nodes.iter().for_each(|&node| marked[node as usize] = true);
        marked
    }

    fn remarks(&self) -> Vec<String> {
        let remarks = self.0.remarks.iter();
        remarks.map(|remark| format!("mesh: {remark}")).collect()
    }

    fn grid(&self) -> BodyGrid {
        BodyGrid {
            positions: self.0.positions.clone(),
            tags: self.0.node_tags.iter().map(|&tag| tag as i64).collect(),
            tagged: self.tagged(),
            canvas: Canvas::Solid(self.0.cells.clone()),
        }
    }
}

impl SolidMeshBody {
    fn off_outline(&self, face: &Cell, cells: usize) -> OffOutline {
        let corners = face.corners();
        let positions = corners.iter().map(|&node| self.0.positions[node as usize]);
        let mean =
            |axis: usize| positions.clone().map(|it| it[axis]).sum::<f64>() / corners.len() as f64;
        OffOutline {
            side: "face",
            nodes: corners.iter().map(|&node| self.tag(node)).collect(),
            middle: (0..3).map(mean).collect(),
            cells,
        }
    }
}

fn less(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

fn norm(vector: [f64; 3]) -> f64 {
    vector.iter().map(|it| it * it).sum::<f64>().sqrt()
}
