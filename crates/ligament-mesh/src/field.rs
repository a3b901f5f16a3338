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
    /// Value at each node, shape (n_nodes); none where the section has none. Empty for all but scalars, which are not kept.
    pub values: Vec<Option<f64>>,
}
