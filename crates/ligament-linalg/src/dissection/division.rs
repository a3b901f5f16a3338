//! Divisions of a graph into two sides, improved by moves of single vertices (Fiduccia and Mattheyses 1982; for separators Ashcraft and Liu
//! 1997).

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::graph::Graph;

/// Number of the separator, after the sides 0 and 1.
pub(super) const SEPARATOR: u8 = 2;

/// Largest share, in percent, of the vertices' weight in a side that is to grow further.
const LARGEST_SIDE: u64 = 70;

/// Largest number of passes over a division.
const PASSES: usize = 10;

/// A division of a graph into two sides and a separator. As long as there is no separator, edges lead from one side to the other.
pub(super) struct Division<'a> {
    graph: &'a Graph,
    /// Side of each vertex, or the separator, shape (n).
    pub(super) sides: Vec<u8>,
    /// Weights of the sides and of the separator.
    weights: [u64; 3],
    /// Weight of the edges between the sides.
    cut: u64,
    /// Weight of the edges of each vertex into each side, shape (n, 2).
    edges: Vec<[u32; 2]>,
}

impl<'a> Division<'a> {
    /// Creates the division with the given side of each vertex, shape (n).
    pub(super) fn new(graph: &'a Graph, sides: Vec<u8>) -> Self {
        let mut division = Self {
            graph,
            weights: [0; 3],
            cut: 0,
            edges: vec![[0; 2]; sides.len()],
            sides,
        };
        for (vertex, &side) in (0..).zip(&division.sides) {
            division.weights[side as usize] += u64::from(graph.weight(vertex));
            let edges = &mut division.edges[vertex as usize];
            for &(other, weight) in graph.edges(vertex) {
                edges[division.sides[other as usize] as usize] += weight;
            }
            division.cut += u64::from(edges[1]) * u64::from(1 - side);
        }
        division
    }

    /// The side that grows from a vertex by the neighbours with the most edges into it, ended where the cost is least.
    pub(super) fn grown(graph: &'a Graph, start: u32) -> Self {
        let mut division = Self::new(graph, vec![1; graph.len()]);
        division.pass([start], usize::MAX);
        division
    }

    /// Weight of the separator and of the edges between the sides, over the product of the weights of the sides; infinite for an
    /// empty side.
    pub(super) fn cost(&self) -> f64 {
        match self.weights {
            [0, ..] | [_, 0, _] => f64::INFINITY,
            [lower, upper, separator] => {
                (separator + self.cut) as f64 / (lower as f64 * upper as f64)
            }
        }
    }

    /// Repeats passes as long as they reduce the cost.
    pub(super) fn refine(&mut self) {
        let n = self.graph.len();
        for _ in 0..PASSES {
            let before = self.cost();
            let border = (0..n as u32).filter(|&it| self.is_at_border(it));
            self.pass(border.collect::<Vec<_>>(), (n / 10).clamp(15, 100));
            if self.cost() >= before {
                break;
            }
        }
    }

    /// Makes a separator of the vertices of one side at the other: of the side with fewer of them.
    pub(super) fn separate(&mut self) {
        let all = 0..self.graph.len() as u32;
        let [lower, upper] = [0, 1].map(|side| -> Vec<u32> {
            let of_side = all.clone().filter(|&it| self.sides[it as usize] == side);
            of_side.filter(|&it| self.is_at_border(it)).collect()
        });
        for vertex in if lower.len() < upper.len() {
            lower
        } else {
            upper
        } {
            self.put(vertex, SEPARATOR);
        }
    }

    fn is_at_border(&self, vertex: u32) -> bool {
        match self.sides[vertex as usize] {
            SEPARATOR => true,
            side => self.edges[vertex as usize][1 - side as usize] > 0,
        }
    }

    /// Decrease of the weight of the separator and of the edges between the sides by a move of a vertex into a side.
    fn gain(&self, vertex: u32, side: u8) -> i64 {
        let edges = self.edges[vertex as usize].map(i64::from);
        let [inside, outside] = [edges[side as usize], edges[1 - side as usize]];
        match self.sides[vertex as usize] {
            SEPARATOR => i64::from(self.graph.weight(vertex)) - outside,
            _ => inside - outside,
        }
    }

    fn put(&mut self, vertex: u32, side: u8) {
        let before = std::mem::replace(&mut self.sides[vertex as usize], side);
        let weight = u64::from(self.graph.weight(vertex));
        self.weights[before as usize] -= weight;
        self.weights[side as usize] += weight;
        let edges = self.edges[vertex as usize];
        let across = |side: u8| match side {
            SEPARATOR => 0,
            _ => u64::from(edges[1 - side as usize]),
        };
        self.cut = self.cut + across(side) - across(before);
        for &(other, weight) in self.graph.edges(vertex) {
            let of_other = &mut self.edges[other as usize];
            if before != SEPARATOR {
                of_other[before as usize] -= weight;
            }
            if side != SEPARATOR {
                of_other[side as usize] += weight;
            }
        }
    }

    /// Moves vertices into sides, the largest gain first, each once, and returns to the least cost on the way. It ends after as many moves
    /// without a lower cost as `patience` says.
    fn pass(&mut self, first: impl IntoIterator<Item = u32>, patience: usize) {
        let mut candidates = Candidates::new(self);
        for vertex in first {
            candidates.enter(self, vertex, 0);
            candidates.enter(self, vertex, 1);
        }
        let (mut lowest, mut n_kept) = (self.cost(), 0);
        let mut moves: Vec<(u32, u8)> = Vec::new();
        let mut n_worse = 0;
        while n_worse < patience
            && let Some((vertex, side)) = candidates.next(self)
        {
            self.advance(vertex, side, &mut candidates, &mut moves);
            n_worse += 1;
            if self.cost() < lowest {
                (lowest, n_kept, n_worse) = (self.cost(), moves.len(), 0);
            }
        }
        for (vertex, side) in moves.drain(n_kept..).rev() {
            self.put(vertex, side);
        }
    }

    /// Moves a vertex into a side; out of a separator, the neighbours on the other side replace it. `moves` gets the vertices with their sides
    /// before.
    fn advance(
        &mut self,
        vertex: u32,
        side: u8,
        candidates: &mut Candidates,
        moves: &mut Vec<(u32, u8)>,
    ) {
        let graph = self.graph;
        let mut first = moves.len();
        moves.push((vertex, self.sides[vertex as usize]));
        self.put(vertex, side);
        if candidates.has_separator {
            first += 1;
            for other in graph.neighbours(vertex) {
                if self.sides[other as usize] == 1 - side {
                    moves.push((other, 1 - side));
                    self.put(other, SEPARATOR);
                }
            }
        }
        // Only moves after vertices that left the other side gain more than before.
        for &(gone, _) in &moves[first..] {
            candidates.enter(self, gone, 1 - side);
            for other in graph.neighbours(gone).chain([gone]) {
                candidates.enter(self, other, side);
            }
        }
    }
}

/// Vertices that may move: out of the separator if there is one, else to the other side.
struct Candidates {
    /// Gains of moves into each side with their vertices; the first vertex comes first among equals.
    heaps: [BinaryHeap<(i64, Reverse<u32>)>; 2],
    /// Gain by which each vertex is in the heaps, shape (n, 2); the least number for others, the largest for vertices that have moved.
    entered: Vec<[i64; 2]>,
    has_separator: bool,
}

impl Candidates {
    fn new(division: &Division<'_>) -> Self {
        Self {
            heaps: Default::default(),
            entered: vec![[i64::MIN; 2]; division.sides.len()],
            has_separator: division.weights[SEPARATOR as usize] > 0,
        }
    }

    fn may_move(&self, division: &Division<'_>, vertex: u32, side: u8) -> bool {
        let from = division.sides[vertex as usize];
        from != side && (from == SEPARATOR) == self.has_separator
    }

    /// Enters the move of a vertex into a side, if it is possible and gains more than before.
    fn enter(&mut self, division: &Division<'_>, vertex: u32, side: u8) {
        if self.may_move(division, vertex, side) {
            let gain = division.gain(vertex, side);
            let entered = &mut self.entered[vertex as usize][side as usize];
            if gain > *entered {
                *entered = gain;
                self.heaps[side as usize].push((gain, Reverse(vertex)));
            }
        }
    }

    /// The move with the largest gain, into the lighter side among equals; its vertex does not move again.
    fn next(&mut self, division: &Division<'_>) -> Option<(u32, u8)> {
        let total: u64 = division.weights.iter().sum();
        let best = [0, 1].map(|side: u8| {
            let weight = division.weights[side as usize];
            let (gain, Reverse(vertex)) = self.first(division, side)?;
            (100 * weight < LARGEST_SIDE * total).then_some((gain, Reverse(weight), vertex, side))
        });
        let best = best.into_iter().flatten();
        let (.., vertex, side) = best.max_by_key(|&(gain, weight, ..)| (gain, weight))?;
        self.entered[vertex as usize] = [i64::MAX; 2];
        Some((vertex, side))
    }

    /// The move into a side with the largest gain. Gains that fell since their entry are corrected here.
    fn first(&mut self, division: &Division<'_>, side: u8) -> Option<(i64, Reverse<u32>)> {
        while let Some(&(gain, Reverse(vertex))) = self.heaps[side as usize].peek() {
            if self.entered[vertex as usize][side as usize] == gain {
                if self.may_move(division, vertex, side) && division.gain(vertex, side) == gain {
                    return Some((gain, Reverse(vertex)));
                }
                self.entered[vertex as usize][side as usize] = i64::MIN;
                self.enter(division, vertex, side);
            }
            self.heaps[side as usize].pop();
        }
        None
    }
}
