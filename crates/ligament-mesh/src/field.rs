//! Values at the nodes that a file brings along.

/// A view of a post-processing program at one time: a section `$NodeData`.
#[derive(Debug, Clone, PartialEq)]
pub struct NodeField {
    /// Name of the view.
    pub name: String,
    /// Number of the time step; several sections of one name differ by it.
    pub time_step: i32,
    /// Values a node: 1 for scalars, 3 for vectors, 9 for tensors.
    pub components: u64,
    /// Nodes with their values, ascending; nodes without one are left out. Empty for all but scalars, which are not kept.
    pub values: Vec<(u32, f64)>,
}

impl NodeField {
    /// The value at each node, shape (n_nodes); none where the section has none.
    pub fn at_nodes(&self, n_nodes: usize) -> Vec<Option<f64>> {
        let mut dense = vec![None; n_nodes];
        for &(node, value) in &self.values {
            dense[node as usize] = Some(value);
        }
        dense
    }
}
