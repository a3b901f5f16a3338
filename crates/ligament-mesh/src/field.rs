//! Values at the nodes from a mesh file.

use serde::{Deserialize, Serialize};

/// A view of a post-processing program at one time: a section `$NodeData`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct NodeField {
    /// Name of the view.
    pub name: String,
    /// Number of the time step, by which several sections of one name differ.
    pub time_step: i32,
    /// Number of values per node: 1 for scalars, 3 for vectors, 9 for tensors.
    pub components: u64,
    /// Nodes with their values, ascending; nodes without a value are left out. Empty for vectors and tensors: only scalars are stored.
    pub values: Vec<(u32, f64)>,
}

impl NodeField {
    /// Value at each node, shape (n_nodes); `None` where the section has no value.
    pub fn at_nodes(&self, n_nodes: usize) -> Vec<Option<f64>> {
        let mut dense = vec![None; n_nodes];
        for &(node, value) in &self.values {
            dense[node as usize] = Some(value);
        }
        dense
    }
}
