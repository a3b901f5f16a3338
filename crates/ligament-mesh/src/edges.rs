//! Edges of planar cells and the cells on either side.

use crate::cell::{Cell, ascending};

/// Edges of planar cells by the node at which they begin, with the cell on their left.
pub(crate) struct Edges {
    /// First side of each node, shape (n_nodes + 1).
    offsets: Vec<usize>,
    /// Nodes at which the edges end, and cells; ascending for each node.
    sides: Vec<(u32, u32)>,
}

impl Edges {
    /// Edges of cells.
    pub(crate) fn new(cells: &[Cell]) -> Self {
        let corners = || cells.iter().flat_map(Cell::corners);
        let n_nodes = corners().max().map_or(0, |highest| *highest as usize + 1);
        let mut offsets = vec![0; n_nodes + 1];
        for &node in corners() {
            offsets[node as usize + 1] += 1;
        }
        for node in 0..n_nodes {
            offsets[node + 1] += offsets[node];
        }
        let mut next = offsets.clone();
        let mut sides = vec![(0, 0); offsets[n_nodes]];
        for (number, cell) in (0..).zip(cells) {
            let corners = cell.corners();
            let ends = corners.iter().cycle().skip(1);
            for (&begin, &end) in corners.iter().zip(ends) {
                let free = &mut next[begin as usize];
                sides[*free] = (end, number);
                *free += 1;
            }
        }
        for range in offsets.windows(2) {
            sides[range[0]..range[1]].sort_unstable();
        }
        Self { offsets, sides }
    }

    /// Ends and cells of the edges that begin at a node.
    fn at_node(&self, node: u32) -> &[(u32, u32)] {
        &self.sides[self.offsets[node as usize]..self.offsets[node as usize + 1]]
    }

    /// First two cells on the same side of a common edge, which overlap: neighbours that are counter-clockwise run along it in opposite
    /// directions.
    pub(crate) fn first_overlap(&self) -> Option<[u32; 2]> {
        let mut nodes = self.offsets.windows(2);
        nodes.find_map(|range| {
            let mut pairs = self.sides[range[0]..range[1]].windows(2);
            let pair = pairs.find(|pair| pair[0].0 == pair[1].0)?;
            Some([pair[0].1, pair[1].1])
        })
    }

    /// Edges that belong to one cell alone, on their left, with this cell; ascending by their nodes.
    pub(crate) fn outer(&self) -> Vec<([u32; 2], u32)> {
        let mut outer = Vec::new();
        for begin in 0..self.offsets.len() as u32 - 1 {
            for at_end in self.at_node(begin).chunk_by(|a, b| a.0 == b.0) {
                let &(end, cell) = &at_end[0];
                let mut opposite = self.at_node(end).iter();
                if at_end.len() == 1 && opposite.all(|it| it.0 != begin) {
                    outer.push(([begin, end], cell));
                }
            }
        }
        outer.sort_unstable_by_key(|(edge, _)| ascending(*edge));
        outer
    }
}

/// Edges that belong to one of the planar cells alone, with the cell on their left, ascending by their nodes.
pub fn outer_edges(cells: &[Cell]) -> Vec<[u32; 2]> {
    let outer = Edges::new(cells).outer().into_iter();
    outer.map(|(edge, _)| edge).collect()
}
