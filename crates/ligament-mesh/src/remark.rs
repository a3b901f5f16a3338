//! Remarks on a mesh file, and positions in it.

use std::fmt;

use crate::parse_options::CoordinatePlane;

/// A position in a mesh file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FilePosition {
    /// Line of an ASCII file, counted from 1.
    Line(usize),
    /// Offset in a binary file, bytes from its beginning.
    Byte(usize),
}

impl fmt::Display for FilePosition {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            FilePosition::Line(line) => write!(f, "line {line}"),
            FilePosition::Byte(offset) => write!(f, "byte {offset}"),
        }
    }
}

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
    /// Sections that are not used.
    IgnoredSections {
        /// Names without the dollar sign, each once with its first position, in the order of the file.
        sections: Vec<(String, FilePosition)>,
        /// Number of other sections.
        others: usize,
    },
    /// Cells with a repeated corner, which were read as the cells with fewer corners that they are.
    CollapsedCells {
        /// Number of such cells.
        cells: usize,
    },
    /// A crack that is in the mesh, along which nodes are doubled.
    Crack {
        /// Number of pairs of edges (of faces in a solid) of the outline that are at one place.
        faces: usize,
    },
    /// A mesh that was turned into the plane of x and y.
    Turned {
        /// Plane in which the mesh lies in the file.
        plane: CoordinatePlane,
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
            Remark::IgnoredSections { sections, others } => {
                let named = sections.iter();
                let named = named.map(|(name, place)| format!("${name} ({place})"));
                let named = named.collect::<Vec<_>>().join(", ");
                match (sections.len(), others) {
                    (1, 0) => write!(f, "the section {named} was ignored: nothing in it is used"),
                    (_, 0) => write!(
                        f,
                        "the sections {named} were ignored: nothing in them is used"
                    ),
                    _ => write!(
                        f,
                        "the sections {named} and {others} others were ignored: nothing in them is used"
                    ),
                }
            }
            Remark::CollapsedCells { cells } => write!(
                f,
                "{cells} cells with a repeated corner were read as the cells with fewer corners that they are"
            ),
            Remark::Crack { faces } => write!(
                f,
                "nodes are doubled along a crack, or along a seam that is not joined: {faces} pairs of outer sides of cells coincide"
            ),
            Remark::Turned { plane } => write!(
                f,
                "the mesh was turned from the plane of {plane} into that of x and y"
            ),
        }
    }
}
