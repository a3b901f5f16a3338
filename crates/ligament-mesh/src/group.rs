//! Physical groups.

use serde::{Deserialize, Serialize};

use crate::cell::Cell;

/// A physical group of the mesh file: a named set of nodes, with its edges, faces or cells.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct Group {
    /// Name of the group; for an unnamed group its number in decimal.
    pub name: String,
    /// Dimension: 0 points, 1 curves, 2 surfaces, 3 volumes.
    pub dimension: u8,
    /// Number of the physical group in the file.
    pub number: i32,
    /// Nodes of the group, ascending, each once.
    pub nodes: Vec<u32>,
    /// Edges of a curve group, ascending by their nodes, each once (else empty).
    pub edges: Vec<[u32; 2]>,
    /// Faces of a surface group of a solid mesh, ascending by their nodes, each once, with either orientation (else empty).
    pub faces: Vec<Cell>,
    /// Cells, ascending: of a surface group of a planar mesh, or a volume group of a solid one (else empty).
    pub cells: Vec<u32>,
}
