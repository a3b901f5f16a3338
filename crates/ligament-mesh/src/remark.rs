//! Remarks on a mesh file.

use std::fmt;

/// A remark on a part of the file that was changed or left out.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Remark {
    /// Cells of second or higher order; only their corner nodes were read.
    HigherOrderCells {
        /// Number of such cells.
        cells: usize,
        /// Number of nodes dropped with these cells: nodes on their sides and in their interior.
        nodes: usize,
    },
    /// Nodes that no cell uses, dropped from the mesh and from its groups.
    UnusedNodes {
        /// Number of nodes.
        nodes: usize,
    },
    /// A physical group that the file names or uses, but which has no node of a cell.
    EmptyGroup {
        /// Name of the group, or its number in decimal.
        name: String,
        /// Dimension: 0 points, 1 curves, 2 surfaces, 3 volumes.
        dimension: u8,
    },
    /// Elements of entities that `$Entities` does not describe (format 4.1), hence in no group.
    UndescribedEntities {
        /// Number of elements.
        elements: usize,
    },
}

impl fmt::Display for Remark {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Remark::HigherOrderCells { cells, nodes } => write!(
                f,
                "{cells} cells of higher order were read by their corner nodes; \
                 their {nodes} other nodes were dropped"
            ),
            Remark::UnusedNodes { nodes } => {
                write!(f, "{nodes} nodes that no cell uses were dropped")
            }
            Remark::EmptyGroup { name, dimension } => write!(
                f,
                "the physical group \"{name}\" of dimension {dimension} contains no node of a cell and was ignored"
            ),
            Remark::UndescribedEntities { elements } => write!(
                f,
                "{elements} elements belong to entities that $Entities does not describe, \
                 so to no physical group"
            ),
        }
    }
}
