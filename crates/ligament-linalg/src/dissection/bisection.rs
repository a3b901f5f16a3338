//! Multilevel bisection (Hendrickson and Leland 1995; Karypis and Kumar 1998): a graph is coarsen by matchings, the coarsest graph is
//! bisected, and the bisection is improved on each graph on the way back.
//!
//! Edges between the sides measure the length of a cut on every level. A separator of coarse vertices does not, because they may be wider than
//! the neighbourhood of a vertex; so the separator is made on the finest graph: refined from the coarsest graph on, it left 20 % more
//! multiplications.

use super::division::Division;
use super::graph::Graph;

/// Largest number of vertices that are not merged any more.
const COARSEST: usize = 50;

/// Weight of the heaviest merged vertices over the mean weight in the coarsest graph.
const HEAVIEST: u32 = 3;

/// Number of vertices from which the first side grows; the bisection with the least cost is taken.
const STARTS: usize = 4;

impl Graph {
    /// Side of each vertex, or the separator between them, shape (n).
    pub(super) fn partition(&self) -> Vec<u8> {
        let mut division = self.bisect(HEAVIEST * self.total_weight() / COARSEST as u32);
        division.separate();
        division.refine();
        division.sides
    }

    /// A bisection; merged vertices weigh `heaviest` at most.
    fn bisect(&self, heaviest: u32) -> Division<'_> {
        if self.len() > COARSEST {
            let (coarse, coarse_of) = self.coarsen(heaviest);
            // A hub leaves most vertices unmatched.
            if 10 * coarse.len() < 9 * self.len() {
                let sides = coarse.bisect(heaviest).sides;
                let sides = coarse_of.iter().map(|&it| sides[it as usize]);
                let mut division = Division::new(self, sides.collect());
                division.refine();
                return division;
            }
        }
        let grown = |k: usize| {
            let reached = self.breadth_first(
                (k * self.len() / STARTS) as u32,
                &mut vec![false; self.len()],
            );
            let mut division = Division::grown(self, reached[reached.len() - 1]);
            division.refine();
            division
        };
        (1..STARTS).map(grown).fold(grown(0), |best, other| {
            if other.cost() < best.cost() {
                other
            } else {
                best
            }
        })
    }

    /// A graph with merged vertices, and the coarse vertex of each vertex, shape (n).
    ///
    /// In the order of their numbers, vertices are merged with the unmatched neighbour of the largest ratio of the edge's squared weight to the
    /// neighbour's weight (Holtgrewe, Sanders and Schulz 2010), the first one among equals.
    fn coarsen(&self, heaviest: u32) -> (Self, Vec<u32>) {
        const UNMATCHED: u32 = u32::MAX;
        let mut coarse_of = vec![UNMATCHED; self.len()];
        let mut pairs: Vec<[u32; 2]> = Vec::with_capacity(self.len());
        for vertex in 0..self.len() as u32 {
            if coarse_of[vertex as usize] != UNMATCHED {
                continue;
            }
            let (mut mate, mut highest) = (vertex, 0.0);
            for &(other, edge) in self.edges(vertex) {
                let rating = f64::from(edge).powi(2) / f64::from(self.weight(other));
                if rating > highest
                    && other != vertex
                    && coarse_of[other as usize] == UNMATCHED
                    && self.weight(vertex) + self.weight(other) <= heaviest
                {
                    (mate, highest) = (other, rating);
                }
            }
            for member in [vertex, mate] {
                coarse_of[member as usize] = pairs.len() as u32;
            }
            pairs.push([vertex, mate]);
        }
        (self.merged(&pairs, &coarse_of), coarse_of)
    }

    /// The coarse graph, with a vertex for each pair of vertices; an unmatched vertex is paired with itself.
    fn merged(&self, pairs: &[[u32; 2]], coarse_of: &[u32]) -> Self {
        let mut coarse = Self::with_capacity(pairs.len());
        // Place of each coarse vertex among the edges of the latest one that reached it.
        let mut places = vec![u32::MAX; pairs.len()];
        let mut edges: Vec<(u32, u32)> = Vec::new();
        for (number, &[one, other]) in (0..).zip(pairs) {
            edges.clear();
            let members = [one, other]
                .into_iter()
                .take(if one == other { 1 } else { 2 });
            for &(neighbour, weight) in members.clone().flat_map(|it| self.edges(it)) {
                let reached = coarse_of[neighbour as usize];
                let place = &mut places[reached as usize];
                match edges.get_mut(*place as usize) {
                    Some((vertex, sum)) if *vertex == reached => *sum += weight,
                    _ if reached != number => {
                        *place = edges.len() as u32;
                        edges.push((reached, weight));
                    }
                    _ => {}
                }
            }
            coarse.push(
                members.map(|it| self.weight(it)).sum(),
                edges.iter().copied(),
            );
        }
        coarse
    }
}
