//! Physical groups.

/// A physical group of the mesh file: a named set of nodes, with the edges or cells that made it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Group {
    /// Name of the group; where the file gives none, the number of the group in decimal.
    pub name: String,
    /// Dimension: 0 points, 1 curves, 2 surfaces.
    pub dimension: u8,
    /// Number of the physical group in the file.
    pub number: i32,
    /// Nodes of the group, ascending, each once.
    pub nodes: Vec<u32>,
    /// Edges of a curve group, ascending by their nodes, each once (empty otherwise).
    pub edges: Vec<[u32; 2]>,
    /// Cells of a surface group, ascending (empty otherwise).
    pub cells: Vec<u32>,
}
