//! Nested dissection of a graph, an order of elimination that leaves little fill (George 1973).
//!
//! A separator divides the graph into two sides, which are dissected in the same way and eliminated before it. It comes from a bisection with
//! few edges between the sides, found on coarser graphs first, and is improved by moves of single vertices. Every choice has a rule for
//! ties, so that the order depends on the graph alone.

mod bisection;
mod division;
mod graph;

use graph::Graph;

use crate::matrix::Pattern;

/// Largest number of vertices that are not divided any further: minimum degree among them was measured to save 0.3 % of the fill.
const SMALLEST_PART: usize = 16;

/// Least number of vertices whose two sides are parallel tasks.
const TASK: usize = 1024;

/// Largest number of nested divisions. Sides of at most 70 % end earlier; only a graph that has no such sides, as one with a dense core, is
/// not dissected to its end.
const DEEPEST: usize = 100;

/// Elimination order of the unknowns of a pattern by nested dissection. Unknowns with the same rows, such as the unknowns of a point, stay
/// together.
pub(crate) fn nested_dissection(pattern: &Pattern) -> Vec<usize> {
    let (graph, firsts) = Graph::compressed(pattern);
    let all = (0..graph.len() as u32).collect();
    let unknowns = |vertex: u32| firsts[vertex as usize]..firsts[vertex as usize + 1];
    order(&graph, all, 0)
        .into_iter()
        .flat_map(unknowns)
        .collect()
}

/// Vertices of a graph in the order of elimination, by their numbers in the whole graph.
fn order(graph: &Graph, numbers: Vec<u32>, depth: usize) -> Vec<u32> {
    if graph.len() <= SMALLEST_PART || depth == DEEPEST {
        return numbers;
    }
    let of_part = |vertices: Vec<u32>| {
        let numbers = vertices.iter().map(|&it| numbers[it as usize]).collect();
        order(&graph.subgraph(&vertices), numbers, depth + 1)
    };
    let components = graph.components();
    if components.len() > 1 {
        return components.into_iter().flat_map(of_part).collect();
    }
    let mut parts = [const { Vec::new() }; 3];
    for (vertex, side) in (0..).zip(graph.partition()) {
        parts[side as usize].push(vertex);
    }
    let [lower, upper, separator] = parts;
    let (mut in_order, of_upper) = if graph.len() < TASK {
        (of_part(lower), of_part(upper))
    } else {
        rayon::join(|| of_part(lower), || of_part(upper))
    };
    in_order.extend(of_upper);
    in_order.extend(separator.into_iter().map(|it| numbers[it as usize]));
    in_order
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::division::SEPARATOR;
    use super::*;

    /// A graph of some vertices from its edges.
    fn graph(n: u32, edges: impl IntoIterator<Item = (u32, u32)>) -> Graph {
        let mut neighbours = vec![Vec::new(); n as usize];
        for (one, other) in edges {
            neighbours[one as usize].push(other);
            neighbours[other as usize].push(one);
        }
        Graph::new(neighbours)
    }

    /// A grid of square cells.
    fn grid(side: u32) -> Graph {
        let vertices = (0..side * side).filter(move |it| (it + 1) % side > 0);
        let rows = vertices.map(|it| (it, it + 1));
        let columns = (side..side * side).map(|it| (it - side, it));
        graph(side * side, rows.chain(columns))
    }

    /// Chain, star, wheel, complete graph, complete graph with a leaf at each vertex, and two grids joined by a vertex, all of them
    /// connected: no edge leads from side to side, and neither side is empty unless all vertices are neighbours.
    #[test]
    fn separators_separate() {
        let complete = |n: u32| (0..n).flat_map(move |b| (0..b).map(move |a| (a, b)));
        let spokes = (1..300).map(|it| (0, it));
        let rim = (1..300).map(|it| (it, it % 299 + 1));
        let joined = |it: u32| {
            let of_grid = grid(20);
            let edges = (0..400).flat_map(move |a| {
                of_grid
                    .neighbours(a)
                    .collect::<Vec<_>>()
                    .into_iter()
                    .map(move |b| (a, b))
            });
            edges
                .filter(|(a, b)| a < b)
                .map(move |(a, b)| (a + it, b + it))
                .collect::<Vec<_>>()
        };
        for (name, graph, most) in [
            ("chain", graph(1000, (1..1000).map(|it| (it - 1, it))), 1),
            ("star", graph(300, spokes.clone()), 1),
            ("wheel", graph(300, spokes.chain(rim)), 3),
            ("complete", graph(70, complete(70)), 70),
            (
                "leaves",
                graph(140, complete(70).chain((0..70).map(|it| (it, it + 70)))),
                70,
            ),
            ("grid", grid(40), 40),
            (
                "joined",
                graph(
                    801,
                    joined(0)
                        .into_iter()
                        .chain(joined(400))
                        .chain([(0, 800), (400, 800)]),
                ),
                1,
            ),
        ] {
            let sides = graph.partition();
            let side = |it: u32| sides[it as usize];
            let count = |of: u8| sides.iter().filter(|it| **it == of).count();
            for vertex in 0..graph.len() as u32 {
                assert!(
                    graph
                        .neighbours(vertex)
                        .all(|other| side(vertex) + side(other) != 1),
                    "{name}"
                );
            }
            assert!(count(SEPARATOR) <= most, "{name}: {}", count(SEPARATOR));
            assert!(name == "complete" || count(0) * count(1) > 0, "{name}");
        }
    }

    /// Unknowns with the same rows are one vertex; those with other neighbours before or after them are not.
    #[test]
    fn unknowns_with_the_same_rows_are_one_vertex() {
        // Points {0, 1}, {2, 3}, {4}: the first and the last are neighbours of the second.
        let starts = vec![0, 1, 3, 6, 10, 13];
        let rows = vec![0, 0, 1, 0, 1, 2, 0, 1, 2, 3, 2, 3, 4];
        let pattern = Pattern::new(starts, rows).unwrap();
        let (graph, firsts) = Graph::compressed(&pattern);
        assert_eq!(firsts, [0, 2, 4, 5]);
        let neighbours = [0, 1, 2].map(|it| graph.neighbours(it).collect::<Vec<_>>());
        assert_eq!(neighbours, [vec![1], vec![0, 2], vec![1]]);
        // Unknowns 0 to 3 are neighbours of each other, and 4 is one of 3 alone.
        let pattern = Pattern::new(
            vec![0, 1, 3, 6, 10, 12],
            vec![0, 0, 1, 0, 1, 2, 0, 1, 2, 3, 3, 4],
        );
        assert_eq!(Graph::compressed(&pattern.unwrap()).1, [0, 3, 4, 5]);
    }
}
