//! Graphs with weights, their parts and components.

use std::ops::Range;

use crate::matrix::Pattern;

/// An undirected graph whose vertices and edges have weights. Each edge is stored at both of its ends.
#[derive(Default)]
pub(super) struct Graph {
    /// First edge of each vertex, then the number of all, shape (n + 1).
    starts: Vec<usize>,
    /// Neighbour and weight of each edge.
    edges: Vec<(u32, u32)>,
    /// Weight of each vertex, shape (n).
    weights: Vec<u32>,
}

impl Graph {
    /// A graph of unit weights from the neighbours of each vertex.
    pub(super) fn new<Neighbours: IntoIterator<Item = u32>>(
        vertices: impl IntoIterator<Item = Neighbours>,
    ) -> Self {
        let mut graph = Self::with_capacity(0);
        for neighbours in vertices {
            graph.push(1, neighbours.into_iter().map(|it| (it, 1)));
        }
        graph
    }

    /// The graph of a pattern, in which successive unknowns with the same rows are one vertex, and the first unknown of each vertex, then
    /// their number.
    pub(super) fn compressed(pattern: &Pattern) -> (Self, Vec<usize>) {
        let n = pattern.dimension();
        let has_rows_before = |column: usize| {
            let [before, rows] = [column - 1, column].map(|it| pattern.column(it));
            *before == rows[..rows.len() - 1]
        };
        let is_end = |column: usize| column == 0 || column == n;
        let first = |column: usize| is_end(column) || !has_rows_before(column);
        let mut is_first: Vec<bool> = (0..=n).map(first).collect();
        for column in 0..n {
            // One of two successive unknowns in a later column.
            for pair in pattern
                .column(column)
                .windows(2)
                .filter(|it| it[0] + 1 < it[1])
            {
                is_first[pair[0] + 1] = true;
                is_first[pair[1]] = true;
            }
            is_first[pattern.column(column)[0]] = true;
        }
        let firsts: Vec<usize> = (0..=n).filter(|&it| is_first[it]).collect();
        let mut neighbours = vec![Vec::new(); firsts.len() - 1];
        for (vertex, &column) in firsts[..firsts.len() - 1].iter().enumerate() {
            let mut number = 0;
            for &row in pattern
                .column(column)
                .iter()
                .filter(|&&row| row < column && is_first[row])
            {
                number += firsts[number..].partition_point(|&first| first < row);
                neighbours[vertex].push(number as u32);
                neighbours[number].push(vertex as u32);
            }
        }
        (Self::new(neighbours), firsts)
    }

    /// An empty graph with memory for a number of vertices.
    pub(super) fn with_capacity(n_vertices: usize) -> Self {
        let mut starts = Vec::with_capacity(n_vertices + 1);
        starts.push(0);
        Self {
            starts,
            ..Self::default()
        }
    }

    /// Adds a vertex with its edges.
    pub(super) fn push(&mut self, weight: u32, edges: impl IntoIterator<Item = (u32, u32)>) {
        self.edges.extend(edges);
        self.starts.push(self.edges.len());
        self.weights.push(weight);
    }

    /// Number of vertices.
    pub(super) fn len(&self) -> usize {
        self.weights.len()
    }

    /// Weight of a vertex.
    pub(super) fn weight(&self, vertex: u32) -> u32 {
        self.weights[vertex as usize]
    }

    /// Weight of all vertices.
    pub(super) fn total_weight(&self) -> u32 {
        self.weights.iter().sum()
    }

    /// Neighbours of a vertex, with the weights of the edges.
    pub(super) fn edges(&self, vertex: u32) -> &[(u32, u32)] {
        let Range { start, end } = self.starts[vertex as usize]..self.starts[vertex as usize + 1];
        &self.edges[start..end]
    }

    /// Neighbours of a vertex.
    pub(super) fn neighbours(&self, vertex: u32) -> impl Iterator<Item = u32> + use<'_> {
        self.edges(vertex).iter().map(|&(other, _)| other)
    }

    /// Subgraph of some vertices, ascending, with unit weights.
    pub(super) fn subgraph(&self, vertices: &[u32]) -> Self {
        let mut number = vec![u32::MAX; self.len()];
        for (place, &vertex) in (0..).zip(vertices) {
            number[vertex as usize] = place;
        }
        Self::new(vertices.iter().map(|&vertex| {
            let numbers = self.neighbours(vertex).map(|other| number[other as usize]);
            numbers.filter(|it| *it != u32::MAX)
        }))
    }

    /// Vertices of each connected component, ascending.
    pub(super) fn components(&self) -> Vec<Vec<u32>> {
        let mut is_found = vec![false; self.len()];
        let firsts = 0..self.len() as u32;
        let mut components: Vec<Vec<u32>> = firsts
            .map(|first| self.breadth_first(first, &mut is_found))
            .collect();
        components.retain(|it| !it.is_empty());
        components.iter_mut().for_each(|it| it.sort_unstable());
        components
    }

    /// Vertices that a breadth-first search finds, without those found before, in its order.
    pub(super) fn breadth_first(&self, start: u32, is_found: &mut [bool]) -> Vec<u32> {
        let mut found = Vec::new();
        let mut find = |vertex: u32, found: &mut Vec<u32>| {
            if !std::mem::replace(&mut is_found[vertex as usize], true) {
                found.push(vertex);
            }
        };
        find(start, &mut found);
        let mut next = 0;
        while let Some(&vertex) = found.get(next) {
            next += 1;
            for other in self.neighbours(vertex) {
                find(other, &mut found);
            }
        }
        found
    }
}
