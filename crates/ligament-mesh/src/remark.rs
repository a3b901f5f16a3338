//! Remarks on a mesh file, and positions in it.

use std::fmt;
use std::sync::Arc;

use crate::coordinate_plane::CoordinatePlane;

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
    /// Something in an input deck.
    Deck {
        /// Line of the deck, the first of several.
        line: FileLine,
        /// What was changed or left out.
        remark: DeckRemark,
    },
}

/// A line of a file, or of one that it includes.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct FileLine {
    /// Name of an included file, as the including one gives it.
    pub file: Option<Arc<str>>,
    /// Number of the line, counted from 1.
    pub number: usize,
}

/// A remark on a part of an input deck that was changed or left out.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum DeckRemark {
    /// Elements that are no part of the body: springs, beams, shells beside a solid and others.
    LeftOutElements {
        /// Element type.
        kind: String,
        /// Number of elements of this type.
        elements: usize,
        /// Number of these elements that are edges or faces of the body, and as such are in groups.
        in_groups: usize,
    },
    /// Shells and membranes in a deck without plane or solid elements, which were read as plane cells.
    ShellsAsCells {
        /// Number of elements.
        elements: usize,
    },
    /// Nodes or elements that the deck defines again, differently; the last definition counts.
    Redefined {
        /// What is defined: nodes or elements.
        items: &'static str,
        /// Number of replaced definitions.
        count: usize,
    },
    /// Members of a set that were left out.
    LeftOutMembers {
        /// Name of the set.
        set: String,
        /// Number of members that the deck does not define.
        undefined: usize,
        /// Number of nodes of no cell, or of elements that are neither cells nor edges or faces of cells.
        beside: usize,
        /// Whether the set has other members, which form a group.
        is_group: bool,
    },
    /// Sides of elements in a surface that were left out, as edges or faces of no cell.
    LeftOutSides {
        /// Name of the surface.
        surface: String,
        /// Number of sides.
        sides: usize,
        /// Whether the surface has other sides, which form a group.
        is_group: bool,
    },
    /// A surface without sides of elements or nodes, such as an analytical one.
    LeftOutSurface {
        /// Name of the surface.
        surface: String,
        /// Type of the surface.
        kind: String,
    },
    /// An instance of a part whose nodes got other numbers, because those in the deck are not unique.
    ShiftedNumbers {
        /// Name of the instance.
        instance: String,
        /// Number added to the numbers of the nodes.
        shift: u64,
    },
    /// A part without an instance, which was left out.
    PartWithoutInstance {
        /// Name of the part.
        part: String,
        /// Number of elements of the part.
        elements: usize,
    },
}

impl fmt::Display for FileLine {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.file {
            Some(file) => write!(f, "line {} of {file}", self.number),
            None => write!(f, "line {}", self.number),
        }
    }
}

impl fmt::Display for Remark {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Remark::HigherOrderCells { cells, nodes } => {
                let cells = counted(*cells, "cell", "cells");
                let nodes = counted(*nodes, "other node", "other nodes");
                write!(
                    f,
                    "{cells} of higher order read by corner nodes alone; {nodes} dropped"
                )
            }
            Remark::UnusedNodes { nodes } => {
                write!(f, "{} of no cell dropped", counted(*nodes, "node", "nodes"))
            }
            Remark::EmptyGroup { name, dimension } => write!(
                f,
                "the physical group \"{name}\" of dimension {dimension} contains no node of a cell and was ignored"
            ),
            Remark::UndescribedEntities { elements } => {
                let elements = counted(*elements, "element", "elements");
                write!(
                    f,
                    "{elements} of entities that $Entities does not describe, so of no physical group"
                )
            }
            Remark::IgnoredSections { sections, others } => {
                f.write_str(&ignored(sections, *others))
            }
            Remark::CollapsedCells { cells } => {
                let cells = counted(*cells, "cell", "cells");
                write!(
                    f,
                    "{cells} with a repeated corner read as what remains without it"
                )
            }
            Remark::Crack { faces } => write!(
                f,
                "a crack is in the mesh: {faces} pairs of outer sides of cells with nodes of their own are at one place, and no bond crosses them; cells that should hold together there are joined by `Coherence Mesh;` in the geometry"
            ),
            Remark::Turned { plane } => write!(
                f,
                "the mesh was turned from the plane of {plane} into that of x and y"
            ),
            Remark::Deck { line, remark } => write!(f, "{line}: {remark}"),
        }
    }
}

impl fmt::Display for DeckRemark {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            DeckRemark::LeftOutElements {
                kind,
                elements,
                in_groups,
            } => {
                let elements = counted(*elements, "element", "elements");
                write!(f, "{elements} of type {kind} left out: no part of the body")?;
                match in_groups {
                    0 => Ok(()),
                    _ => write!(
                        f,
                        "; {in_groups} of them stay in groups, by their edges or faces"
                    ),
                }
            }
            DeckRemark::ShellsAsCells { elements } => {
                let shells = counted(*elements, "shell", "shells");
                write!(
                    f,
                    "without plane or solid elements, {shells} or membranes read as plane cells, which do not bend"
                )
            }
            DeckRemark::Redefined { items, count } => write!(
                f,
                "{count} {items} are defined again, differently; the last definition counts"
            ),
            DeckRemark::LeftOutMembers { .. } => self.fmt_members(f),
            DeckRemark::LeftOutSides {
                surface,
                sides,
                is_group,
            } => {
                let sides = counted(*sides, "side", "sides");
                write!(
                    f,
                    "{sides} of the surface {surface} left out: edges or faces of no cell{}",
                    end(*is_group)
                )
            }
            DeckRemark::LeftOutSurface { surface, kind } => write!(
                f,
                "the surface {surface} of type {kind} has no sides of elements and was left out"
            ),
            DeckRemark::ShiftedNumbers { instance, shift } => write!(
                f,
                "node n of the instance {instance} has the number {shift} + n in the mesh"
            ),
            DeckRemark::PartWithoutInstance { part, elements } => {
                let elements = counted(*elements, "element", "elements");
                write!(
                    f,
                    "the part {part} with {elements} has no instance and was left out"
                )
            }
        }
    }
}

impl DeckRemark {
    fn fmt_members(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let DeckRemark::LeftOutMembers {
            set,
            undefined,
            beside,
            is_group,
        } = self
        else {
            return Ok(());
        };
        let kinds = [
            (undefined, "that the file does not define"),
            (beside, "on no cell"),
        ];
        let counts = kinds.iter().filter(|(count, _)| **count > 0);
        let counts: Vec<String> = counts.map(|(n, which)| format!("{n} {which}")).collect();
        let counts = counts.join(" and ");
        let end = end(*is_group);
        write!(f, "members of the set {set} were left out: {counts}{end}")
    }
}

/// Names and places of sections that were ignored, and the number of others.
fn ignored(sections: &[(String, FilePosition)], others: usize) -> String {
    let named = sections.iter();
    let named = named.map(|(name, place)| format!("${name} ({place})"));
    let named = named.collect::<Vec<_>>().join(", ");
    match (sections.len(), others) {
        (1, 0) => format!("the section {named} was ignored: nothing in it is used"),
        (_, 0) => format!("the sections {named} were ignored: nothing in them is used"),
        _ => format!(
            "the sections {named} and {others} others were ignored: nothing in them is used"
        ),
    }
}

/// A count before its noun, in the singular or plural.
fn counted(count: usize, one: &str, several: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { several })
}

/// What becomes of a group from which something was left out.
fn end(is_group: bool) -> &'static str {
    match is_group {
        true => "",
        false => "; it would be an empty group, and is none",
    }
}
