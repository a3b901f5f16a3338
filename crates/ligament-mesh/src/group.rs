//! Physical groups.

use crate::cell::Cell;

/// A physical group of the mesh file: a named set of nodes, with the edges, faces or cells that made it.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Group {
    /// Name of the group; where the file gives none, the number of the group in decimal.
    pub name: String,
    /// Dimension: 0 points, 1 curves, 2 surfaces, 3 volumes.
    pub dimension: u8,
    /// Number of the physical group in the file.
    pub number: i32,
    /// Nodes of the group, ascending, each once.
    pub nodes: Vec<u32>,
    /// Edges of a curve group, ascending by their nodes, each once (empty otherwise).
    pub edges: Vec<[u32; 2]>,
    /// Faces of a surface group of a solid mesh, ascending by their nodes, each once; they may look to either side (empty
    /// otherwise).
    pub faces: Vec<Cell>,
    /// Cells, ascending: of a surface group of a planar mesh, of a volume group of a solid one (empty otherwise).
    pub cells: Vec<u32>,
}
