//! Meshes with randomly displaced inner nodes, where no mesher makes a second mesh.

use ligament_mesh::{Cell, Mesh};
use ligament_model::scatter::uniform;

/// Largest displacement of a node in each direction, relative to its shortest edge: results scatter by it as those of meshes of Gmsh do,
/// within a factor of two.
const LARGEST: f64 = 0.15;

/// The mesh with its free nodes displaced at random; `draw` is the seed. Nodes stay on the outline, in groups of points and curves, and
/// between surfaces with different groups, and where a cell would turn over.
pub(super) fn with_displaced_nodes(mesh: &Mesh, draw: u64) -> Mesh {
    let mut stays = fixed_nodes(mesh);
    let mut shortest = vec![f64::INFINITY; mesh.positions.len()];
    for edge in mesh.edges() {
        let [[xa, ya], [xb, yb]] = edge.map(|node| mesh.positions[node as usize]);
        for node in edge {
            let least = &mut shortest[node as usize];
            *least = least.min((xb - xa).hypot(yb - ya));
        }
    }
    let displaced = |node: usize| {
        let along = |axis: usize| {
            let number = uniform(draw, (2 * node + axis) as u64);
            mesh.positions[node][axis] + LARGEST * shortest[node] * (2.0 * number - 1.0)
        };
        [along(0), along(1)]
    };
    loop {
        let position = |node: usize| {
            if stays[node] {
                mesh.positions[node]
            } else {
                displaced(node)
            }
        };
        let positions: Vec<[f64; 2]> = (0..mesh.positions.len()).map(position).collect();
        let turned = mesh
            .cells
            .iter()
            .filter(|cell| !is_convex(cell, &positions));
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

/// Whether a cell has a positive angle at each corner.
fn is_convex(cell: &Cell, positions: &[[f64; 2]]) -> bool {
    let corners = cell.corners();
    let n = corners.len();
    let at = |place: usize| positions[corners[place % n] as usize];
    (0..n).all(|place| {
        let [[xa, ya], [xb, yb], [xc, yc]] = [at(place), at(place + 1), at(place + 2)];
        (xb - xa) * (yc - yb) - (yb - ya) * (xc - xb) > 0.0
    })
}

/// Whether each node must keep its position, shape (n_nodes).
fn fixed_nodes(mesh: &Mesh) -> Vec<bool> {
    let mut is_fixed = vec![false; mesh.positions.len()];
    let lines = mesh.groups.iter().filter(|group| group.dimension < 2);
    let lines = lines.flat_map(|group| group.nodes.iter().copied());
    for node in lines.chain(mesh.outline().into_iter().flatten()) {
        is_fixed[node as usize] = true;
    }
    // The surfaces with a group that each cell belongs to.
    let mut surfaces = vec![Vec::new(); mesh.cells.len()];
    for (index, group) in mesh.groups.iter().enumerate() {
        for &cell in &group.cells {
            surfaces[cell as usize].push(index);
        }
    }
    let mut surfaces_at: Vec<Option<&[usize]>> = vec![None; mesh.positions.len()];
    for (cell, own) in mesh.cells.iter().zip(&surfaces) {
        for &node in cell.corners() {
            let first = surfaces_at[node as usize].get_or_insert(own);
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
        let (mesh, first) = (square(), with_displaced_nodes(&square(), 1));
        let moved = |other: &Mesh| -> Vec<usize> {
            (0..25)
                .filter(|&node| other.positions[node] != mesh.positions[node])
                .collect()
        };
        // Inside, but for the border of both surfaces at x = 2.
        assert_eq!(moved(&first), [6, 8, 11, 13, 16, 18]);
        assert_ne!(first, with_displaced_nodes(&mesh, 2));
        assert_eq!(first.area(), mesh.area());
        let reach = |node: usize| {
            let [[xa, ya], [xb, yb]] = [first.positions[node], mesh.positions[node]];
            (xb - xa).abs().max((yb - ya).abs())
        };
        assert!((0..25).all(|node| reach(node) <= LARGEST));
    }
}
