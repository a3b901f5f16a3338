//! Finer meshes by splitting cells.

use std::collections::{BTreeMap, BTreeSet};

use crate::bisection::{Bisection, Unbisectable};
use crate::cell::{Cell, ascending};
use crate::mesh::{Group, Mesh, SolidMesh};

impl Mesh {
    /// The mesh with each cell split in four at the middles of its sides, a quadrangle also at the mean of its corners. Groups keep their
    /// names and numbers. The outline stays the same polygon.
    pub fn split_in_four(&self) -> Self {
        let mut nodes = NewNodes::after(self);
        let cells = self.cells.iter().flat_map(|cell| nodes.children(cell));
        let cells: Vec<Cell> = cells.collect();
        let children = |cell: &u32| (4 * cell..4 * cell + 4).collect::<Vec<_>>();
        let groups = self.groups.iter().map(|group| {
            let edges = group.edges.iter().flat_map(|&edge| nodes.halves(edge));
            let mut edges: Vec<[u32; 2]> = edges.collect();
            edges.sort_unstable();
            let cells_of_group: Vec<u32> = group.cells.iter().flat_map(children).collect();
            let corners = cells_of_group
                .iter()
                .flat_map(|&it| cells[it as usize].corners());
            let all = group
                .nodes
                .iter()
                .chain(edges.iter().flatten())
                .chain(corners);
            let nodes: BTreeSet<u32> = all.copied().collect();
            Group {
                nodes: nodes.into_iter().collect(),
                edges,
                cells: cells_of_group,
                ..group.clone()
            }
        });
        let groups = groups.collect();
        let first = 1 + self.node_tags.iter().max().copied().unwrap_or(0);
        let added = nodes.positions.len() - self.positions.len();
        let tags = self.node_tags.iter().copied();
        Self {
            node_tags: tags.chain(first..first + added as u64).collect(),
            positions: nodes.positions,
            cells,
            groups,
            fields: Vec::new(),
            remarks: Vec::new(),
        }
    }
}

impl SolidMesh {
    /// The mesh with each tetrahedron split in eight at the middles of its edges, by three bisections. Groups keep their names and numbers.
    /// The outline stays the same polyhedron.
    ///
    /// # Errors
    /// Returns an error if the mesh has other cells than tetrahedra.
    pub fn split_in_eight(&self) -> Result<Self, Unbisectable> {
        let mut bisection = Bisection::new(self)?;
        for _ in 0..3 {
            let all = vec![true; bisection.cells().len()];
            bisection.bisect(&all);
        }
        Ok(bisection.mesh())
    }
}

/// Nodes of a mesh, and those that are added at the middles of edges and of quadrangles.
struct NewNodes {
    positions: Vec<[f64; 2]>,
    middles: BTreeMap<[u32; 2], u32>,
}

impl NewNodes {
    /// Nodes of a mesh with the middles of all of its edges.
    fn after(mesh: &Mesh) -> Self {
        let mut nodes = Self {
            positions: mesh.positions.clone(),
            middles: BTreeMap::new(),
        };
        for edge in mesh.edges() {
            let middle = nodes.mean(&edge);
            nodes.middles.insert(edge, middle);
        }
        nodes
    }

    /// Adds a node at the mean of others.
    fn mean(&mut self, of: &[u32]) -> u32 {
        let coordinate = |axis: usize| {
            let sum: f64 = of
                .iter()
                .map(|&node| self.positions[node as usize][axis])
                .sum();
            sum / of.len() as f64
        };
        self.positions.push([coordinate(0), coordinate(1)]);
        self.positions.len() as u32 - 1
    }

    fn middle(&self, edge: [u32; 2]) -> u32 {
        self.middles[&ascending(edge)]
    }

    /// Halves of an edge. The edge of a group that no cell has stays as it is.
    fn halves(&self, [a, b]: [u32; 2]) -> Vec<[u32; 2]> {
        match self.middles.get(&ascending([a, b])) {
            Some(&middle) => vec![
                [a.min(middle), a.max(middle)],
                [b.min(middle), b.max(middle)],
            ],
            None => vec![[a, b]],
        }
    }

    /// The four cells of a cell, in its orientation.
    fn children(&mut self, cell: &Cell) -> [Cell; 4] {
        match *cell {
            Cell::Triangle([a, b, c]) => {
                let [ab, bc, ca] = [[a, b], [b, c], [c, a]].map(|edge| self.middle(edge));
                [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]].map(Cell::Triangle)
            }
            Cell::Quadrangle([a, b, c, d]) => {
                let sides = [[a, b], [b, c], [c, d], [d, a]];
                let [ab, bc, cd, da] = sides.map(|edge| self.middle(edge));
                let middle = self.mean(&[a, b, c, d]);
                let children = [
                    [a, ab, middle, da],
                    [ab, b, bc, middle],
                    [middle, bc, c, cd],
                    [da, middle, cd, d],
                ];
                children.map(Cell::Quadrangle)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gmsh;
    use crate::mesh::AnyMesh;

    /// A triangle beside a square, with a curve and a surface as groups.
    const TRIANGLE_AND_SQUARE: &[u8] = b"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n\
        $PhysicalNames\n3\n0 4 \"corner\"\n1 5 \"left\"\n2 6 \"tip\"\n$EndPhysicalNames\n\
        $Nodes\n5\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 2 0 0\n$EndNodes\n\
        $Elements\n4\n1 15 2 4 4 1\n2 1 2 5 5 4 1\n3 3 2 7 7 1 2 3 4\n4 2 2 6 6 2 5 3\n$EndElements\n";

    #[test]
    fn each_cell_becomes_four_and_groups_stay() {
        let mesh = gmsh::parse(TRIANGLE_AND_SQUARE).unwrap();
        let split = mesh.split_in_four();
        // 5 nodes, 6 edges and the middle of the square.
        assert_eq!((split.positions.len(), split.cells.len()), (12, 8));
        assert_eq!(split.area(), mesh.area());
        assert!(split.cells.iter().all(|cell| cell.area(&split.positions)
            == 0.25
                * if matches!(cell, Cell::Triangle(_)) {
                    0.5
                } else {
                    1.0
                }));
        let left = split.group("left").unwrap();
        assert_eq!((left.edges.len(), left.nodes.len()), (2, 3));
        assert!(
            left.nodes
                .iter()
                .all(|&node| split.positions[node as usize][0] == 0.0)
        );
        let tip = split.group("tip").unwrap();
        assert_eq!((tip.cells.len(), tip.nodes.len()), (4, 6));
        assert_eq!(
            split.group("corner").unwrap().nodes,
            mesh.group("corner").unwrap().nodes
        );
        // A file of it holds the same mesh.
        let file = gmsh::write(&split);
        assert_eq!(gmsh::parse(file.as_bytes()).unwrap(), split);
    }

    /// Two tetrahedra on a common face, with this face and one of them as groups.
    #[test]
    fn each_tetrahedron_becomes_eight_and_groups_stay() {
        let file = b"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n\
            $PhysicalNames\n2\n2 4 \"between\"\n3 5 \"upper\"\n$EndPhysicalNames\n\
            $Nodes\n5\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 0 0 -1\n$EndNodes\n\
            $Elements\n3\n1 2 2 4 4 1 2 3\n2 4 2 5 5 1 2 3 4\n3 4 2 6 6 1 2 3 5\n$EndElements\n";
        let AnyMesh::Solid(mesh) = gmsh::parse_any(file).unwrap() else {
            panic!("a solid");
        };
        let split = mesh.split_in_eight().unwrap();
        // 5 nodes and 9 edges.
        assert_eq!((split.positions.len(), split.cells.len()), (14, 16));
        for cell in &split.cells {
            assert!((cell.volume(&split.positions) - 1.0 / 48.0).abs() < 1e-16);
        }
        let between = split.group("between").unwrap();
        assert_eq!((between.faces.len(), between.nodes.len()), (4, 6));
        let upper = split.group("upper").unwrap();
        assert_eq!((upper.cells.len(), upper.nodes.len()), (8, 10));
        let file = gmsh::write(&split);
        let read = gmsh::parse_any(file.as_bytes()).unwrap();
        assert_eq!(read, AnyMesh::Solid(split));
    }
}
