//! Meshes with randomly displaced inner nodes, where no mesher makes a second mesh.

use ligament_mesh::{AnyMesh, Cell, Faces, Mesh, MeshCell, SolidCell};
use ligament_model::scatter::uniform;

/// Largest displacement of a node in each direction, relative to its shortest edge: results scatter by it as those of meshes of Gmsh do,
/// within a factor of two.
const LARGEST: f64 = 0.15;

/// Cells whose nodes can be displaced.
trait DisplaceableCell<const D: usize>: MeshCell<D> {
    /// Nodes on the outline of a mesh.
    fn outer_nodes(mesh: &Mesh<D, Self>) -> Vec<u32>;

    /// Whether the cell has no corner that is turned inwards.
    fn is_convex(&self, positions: &[[f64; D]]) -> bool;
}

impl DisplaceableCell<2> for Cell {
    fn outer_nodes(mesh: &Mesh) -> Vec<u32> {
        mesh.outline().into_iter().flatten().collect()
    }

    fn is_convex(&self, positions: &[[f64; 2]]) -> bool {
        let corners = self.corners();
        let n = corners.len();
        let at = |place: usize| positions[corners[place % n] as usize];
        (0..n).all(|place| {
            let [[xa, ya], [xb, yb], [xc, yc]] = [at(place), at(place + 1), at(place + 2)];
            (xb - xa) * (yc - yb) - (yb - ya) * (xc - xb) > 0.0
        })
    }
}

impl DisplaceableCell<3> for SolidCell {
    fn outer_nodes(mesh: &Mesh<3, SolidCell>) -> Vec<u32> {
        let sides = Faces::new(&mesh.cells, mesh.positions.len()).outer();
        let corners = sides.iter().flat_map(|side| side.face.corners());
        corners.copied().collect()
    }

    fn is_convex(&self, positions: &[[f64; 3]]) -> bool {
        let mut volumes = self
            .tetrahedra()
            .map(|it| SolidCell::Tetrahedron(it).volume(positions));
        volumes.all(|it| it > 0.0)
    }
}

/// The mesh with its free nodes displaced at random; `draw` is the seed. Nodes stay on the outline, in groups of a lower dimension than the
/// cells, and between cells with different groups, and where a cell would turn over.
pub(super) fn with_displaced_nodes(mesh: &AnyMesh, draw: u64) -> AnyMesh {
    match mesh {
        AnyMesh::Plane(mesh) => AnyMesh::Plane(displaced(mesh, draw)),
        AnyMesh::Solid(mesh) => AnyMesh::Solid(displaced(mesh, draw)),
    }
}

fn displaced<const D: usize, C: DisplaceableCell<D>>(mesh: &Mesh<D, C>, draw: u64) -> Mesh<D, C> {
    let mut stays = fixed_nodes(mesh);
    let mut shortest = vec![f64::INFINITY; mesh.positions.len()];
    for edge in mesh.edges() {
        let [p, q] = edge.map(|node| mesh.positions[node as usize]);
        let along = p.iter().zip(&q).map(|(from, to)| to - from);
        let length = along.fold(0.0, f64::hypot);
        for node in edge {
            let least = &mut shortest[node as usize];
            *least = least.min(length);
        }
    }
    let displaced = |node: usize| -> [f64; D] {
        std::array::from_fn(|axis| {
            let number = uniform(draw, (D * node + axis) as u64);
            mesh.positions[node][axis] + LARGEST * shortest[node] * (2.0 * number - 1.0)
        })
    };
    loop {
        let position = |node: usize| {
            if stays[node] {
                mesh.positions[node]
            } else {
                displaced(node)
            }
        };
        let positions: Vec<[f64; D]> = (0..mesh.positions.len()).map(position).collect();
        let turned = mesh.cells.iter().filter(|cell| !cell.is_convex(&positions));
        let held: Vec<u32> = turned.flat_map(|cell| cell.corners().to_vec()).collect();
        if held.iter().all(|&node| stays[node as usize]) {
            return Mesh {
                positions,
                fields: Vec::new(),
                ..mesh.clone()
            };
        }
        for node in held {
            stays[node as usize] = true;
        }
    }
}

/// Whether each node must keep its position, shape (n_nodes).
fn fixed_nodes<const D: usize, C: DisplaceableCell<D>>(mesh: &Mesh<D, C>) -> Vec<bool> {
    let mut is_fixed = vec![false; mesh.positions.len()];
    let lower = (mesh.groups.iter()).filter(|group| usize::from(group.dimension) < D);
    let lower = lower.flat_map(|group| group.nodes.iter().copied());
    for node in lower.chain(C::outer_nodes(mesh)) {
        is_fixed[node as usize] = true;
    }
    // The groups that each cell belongs to.
    let mut groups = vec![Vec::new(); mesh.cells.len()];
    for (index, group) in mesh.groups.iter().enumerate() {
        for &cell in &group.cells {
            groups[cell as usize].push(index);
        }
    }
    let mut groups_at: Vec<Option<&[usize]>> = vec![None; mesh.positions.len()];
    for (cell, own) in mesh.cells.iter().zip(&groups) {
        for &node in cell.corners() {
            let first = groups_at[node as usize].get_or_insert(own);
            is_fixed[node as usize] |= *first != own.as_slice();
        }
    }
    is_fixed
}

#[cfg(test)]
mod tests {
    use super::*;
    use ligament_mesh::gmsh;

    /// A square of 4 x 4 cells, the left half a surface of its own.
    fn square() -> Mesh {
        let mut text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n25\n".to_owned();
        for node in 0..25 {
            text += &format!("{} {} {} 0\n", node + 1, node % 5, node / 5);
        }
        text += "$EndNodes\n$Elements\n16\n";
        for cell in 0..16 {
            let first = cell % 4 + 5 * (cell / 4) + 1;
            let surface = 1 + cell % 4 / 2;
            let corners = [first, first + 1, first + 6, first + 5].map(|it| it.to_string());
            text += &format!(
                "{} 3 2 {surface} {surface} {}\n",
                cell + 1,
                corners.join(" ")
            );
        }
        gmsh::parse((text + "$EndElements\n").as_bytes()).unwrap()
    }

    #[test]
    fn only_inner_nodes_move() {
        let (mesh, first) = (square(), displaced(&square(), 1));
        let moved = |other: &Mesh| -> Vec<usize> {
            (0..25)
                .filter(|&node| other.positions[node] != mesh.positions[node])
                .collect()
        };
        // Inside, but for the border of both surfaces at x = 2.
        assert_eq!(moved(&first), [6, 8, 11, 13, 16, 18]);
        assert_ne!(first, displaced(&mesh, 2));
        assert_eq!(first.area(), mesh.area());
        let reach = |node: usize| {
            let [[xa, ya], [xb, yb]] = [first.positions[node], mesh.positions[node]];
            (xb - xa).abs().max((yb - ya).abs())
        };
        assert!((0..25).all(|node| reach(node) <= LARGEST));
    }

    /// Eight tetrahedra between the middle of an octahedron and its faces: only the middle moves.
    #[test]
    fn only_inner_nodes_of_a_solid_move() {
        let mut positions = vec![[0.0; 3]];
        for axis in 0..3 {
            for sign in [-1.0, 1.0] {
                positions.push(std::array::from_fn(
                    |it| if it == axis { sign } else { 0.0 },
                ));
            }
        }
        let corners = (0..8_u32).map(|it| [1, 3, 5].map(|first| first + (it >> (first / 2) & 1)));
        let cells = (0..8_u32)
            .zip(corners)
            .map(|(it, [a, b, c])| match it.count_ones() % 2 {
                0 => SolidCell::Tetrahedron([0, a, c, b]),
                _ => SolidCell::Tetrahedron([0, a, b, c]),
            });
        let mesh = Mesh {
            cells: cells.collect(),
            node_tags: (1..8).collect(),
            positions,
            ..Mesh::default()
        };
        assert!(mesh.cells.iter().all(|it| it.is_convex(&mesh.positions)));
        let moved = displaced(&mesh, 1);
        assert_ne!(moved.positions[0], mesh.positions[0]);
        assert_eq!(moved.positions[1..], mesh.positions[1..]);
        assert!((moved.volume() - mesh.volume()).abs() < 1e-15);
    }
}
