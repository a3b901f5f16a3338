//! Level sets of fields at the nodes of tetrahedra.

use std::collections::HashMap;

use super::tetrahedra::EDGES;

/// A surface on which a field has one value.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct LevelSet {
    /// Positions on edges between nodes, shape (n_places): the nodes, the lower one first, and the fraction of the way to the second.
    pub places: Vec<([u32; 2], f64)>,
    /// Corners of the triangles, counter-clockwise seen from the larger values of the field, shape (n_triangles).
    pub triangles: Vec<[u32; 3]>,
    /// Tetrahedron of each triangle, shape (n_triangles), ascending.
    pub tetrahedra: Vec<u32>,
}

/// The surface on which a field, linear between the `values` (n_nodes) at the corners of tetrahedra, has a value, by marching tetrahedra (A.
/// Doi and A. Koide, IEICE Transactions E74, 1991). Values at the level count as above it, NaN as below.
pub fn level_set(corners: &[[u32; 4]], values: &[f64], level: f64) -> LevelSet {
    let mut found: HashMap<[u32; 2], u32> = HashMap::new();
    let mut surface = LevelSet::default();
    for (number, nodes) in (0..).zip(corners) {
        let is_above = nodes.map(|node| values[node as usize] >= level);
        let mut place = |one: usize, other: usize| {
            let ends = [nodes[one].min(nodes[other]), nodes[one].max(nodes[other])];
            *found.entry(ends).or_insert_with(|| {
                let [a, b] = ends.map(|node| values[node as usize]);
                let share = (level - a) / (b - a);
                let share = if share.is_finite() {
                    share.clamp(0.0, 1.0)
                } else {
                    0.5
                };
                surface.places.push((ends, share));
                surface.places.len() as u32 - 1
            })
        };
        let [above, below]: [Vec<usize>; 2] =
            [true, false].map(|side| (0..4).filter(|it| is_above[*it] == side).collect());
        let triangles = match (above.as_slice(), below.as_slice()) {
            (&[a], &[b, c, d]) => vec![[place(a, b), place(a, c), place(a, d)]],
            (&[a, b, c], &[d]) => vec![[place(a, d), place(b, d), place(c, d)]],
            (&[a, b], &[c, d]) => {
                let [p, q, r, s] = [place(a, c), place(a, d), place(b, d), place(b, c)];
                vec![[p, q, r], [p, r, s]]
            }
            _ => continue,
        };
        let turned = is_reversed(&above, &below);
        for [a, b, c] in triangles {
            surface
                .triangles
                .push(if turned { [a, c, b] } else { [a, b, c] });
            surface.tetrahedra.push(number);
        }
    }
    surface
}

/// Whether the triangles between corners, in the given order, are clockwise seen from above the level, in a tetrahedron of positive volume:
/// where the corners above and then those below are an even permutation of all.
fn is_reversed(above: &[usize], below: &[usize]) -> bool {
    let order: Vec<usize> = above.iter().chain(below).copied().collect();
    let swaps = EDGES.iter().filter(|[a, b]| order[*a] > order[*b]);
    swaps.count().is_multiple_of(2)
}

#[cfg(test)]
mod tests {
    use ligament_model::tensor::{cross, dot, minus};

    use super::*;

    /// The triangles of every case face the larger values.
    #[test]
    fn triangles_are_turned_to_the_larger_values() {
        let nodes = [
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [0.0, 0.0, 1.0],
        ];
        for case in 1..15_u32 {
            let values = [0, 1, 2, 3].map(|node| f64::from(case >> node & 1));
            let found = level_set(&[[0, 1, 2, 3]], &values, 0.5);
            let at = |place: u32| {
                let ([a, b], share) = found.places[place as usize];
                let [a, b] = [a, b].map(|it| nodes[it as usize]);
                [0, 1, 2].map(|axis| a[axis] + share * (b[axis] - a[axis]))
            };
            // The gradient of the linear field.
            let gradient = [1, 2, 3].map(|node| values[node] - values[0]);
            for triangle in &found.triangles {
                let [a, b, c] = triangle.map(at);
                let normal = cross(minus(b, a), minus(c, a));
                assert!(dot(normal, gradient) > 0.0, "{case:04b}");
            }
        }
    }
}
