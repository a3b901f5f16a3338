//! Bisected meshes with groups and fields.

use std::collections::BTreeSet;

use super::Bisection;
use super::face::MarkedFace;
use super::marked_cell::{Bisectable, MarkedCell};
use crate::cell::{Cell, ascending};
use crate::mesh::{Group, Mesh, NodeField};

impl<const D: usize, C: Bisectable<D>> Bisection<D, C> {
    /// The mesh. Groups have the parts of their original edges, faces and cells. A new node has the mean of the values at the
    /// ends of its edge, if both have one, and a tag above all tags of original nodes.
    pub fn mesh(&self) -> Mesh<D, C> {
        let original = &self.original;
        let cells: Vec<C> = self.cells().collect();
        let first = 1 + original.node_tags.iter().max().copied().unwrap_or(0);
        let added = first..first + self.middles.len() as u64;
        let groups = original.groups.iter();
        let ends = self.ends_of_middles();
        let fields = original.fields.iter();
        Mesh {
            node_tags: original.node_tags.iter().copied().chain(added).collect(),
            positions: self.positions.clone(),
            groups: groups.map(|group| self.group(group, &cells)).collect(),
            fields: fields.map(|field| self.field(field, &ends)).collect(),
            remarks: original.remarks.clone(),
            cells,
        }
    }

    fn group(&self, group: &Group, cells: &[C]) -> Group {
        let mut edges = Vec::new();
        for &edge in &group.edges {
            self.add_parts(edge, &mut edges);
        }
        edges.sort_unstable();
        let mut faces = Vec::new();
        for &face in &group.faces {
            let marked = MarkedFace::new(face, &self.original.positions);
            self.add_parts_of_face(marked, &mut faces);
        }
        faces.sort_by_key(Cell::sorted_corners);
        let leaves = (0..).zip(&self.leaves);
        let of_group = leaves.filter(|(_, leaf)| group.cells.binary_search(&leaf.root).is_ok());
        let of_group: Vec<u32> = of_group.map(|(cell, _)| cell).collect();
        let mut nodes: BTreeSet<u32> = group.nodes.iter().copied().collect();
        nodes.extend(edges.as_flattened());
        nodes.extend(faces.iter().flat_map(Cell::corners));
        nodes.extend(of_group.iter().flat_map(|&it| cells[it as usize].corners()));
        Group {
            nodes: nodes.into_iter().collect(),
            edges,
            faces,
            cells: of_group,
            ..group.clone()
        }
    }

    /// Parts of an edge between neighbouring nodes.
    fn add_parts(&self, edge: [u32; 2], parts: &mut Vec<[u32; 2]>) {
        match self.middles.get(&ascending(edge)) {
            Some(&middle) => edge
                .into_iter()
                .for_each(|end| self.add_parts([end, middle], parts)),
            None => parts.push(edge),
        }
    }

    /// Faces of the cells into which a face was divided: faces of tetrahedra are bisected as triangles are.
    fn add_parts_of_face(&self, face: MarkedFace, parts: &mut Vec<Cell>) {
        match self.middles.get(&face.refinement_edge()) {
            Some(&middle) => face
                .children(middle)
                .for_each(|child| self.add_parts_of_face(child, parts)),
            None => parts.push(face.cell()),
        }
    }

    /// Ends of the edge at whose middle each new node is.
    fn ends_of_middles(&self) -> Vec<[u32; 2]> {
        let mut ends = vec![[0; 2]; self.middles.len()];
        for (&edge, &middle) in &self.middles {
            ends[middle as usize - self.original.positions.len()] = edge;
        }
        ends
    }

    fn field(&self, field: &NodeField, ends_of_middles: &[[u32; 2]]) -> NodeField {
        let mut values = field.at_nodes(self.original.positions.len());
        for edge in ends_of_middles {
            let mean = match edge.map(|end| values[end as usize]) {
                [Some(a), Some(b)] => Some(0.5 * (a + b)),
                _ => None,
            };
            values.push(mean);
        }
        let values = (0..).zip(values);
        NodeField {
            values: values
                .filter_map(|(node, value)| Some((node, value?)))
                .collect(),
            ..field.clone()
        }
    }
}
