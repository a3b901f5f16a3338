//! Why a file was refused.

use std::fmt;

use thiserror::Error;

/// A place in a mesh file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// Line of an ASCII file, counted from 1.
    Line(usize),
    /// Offset in a binary file, bytes from its beginning.
    Byte(usize),
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Place::Line(line) => write!(f, "line {line}"),
            Place::Byte(offset) => write!(f, "byte {offset}"),
        }
    }
}

/// Why a file was not read as a mesh.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum GmshError {
    /// The file holds nothing.
    #[error("the mesh file is empty; mesh the geometry again")]
    Empty,
    /// The file does not begin as a Gmsh mesh does.
    #[error(
        "not a Gmsh mesh file: it does not begin with $MeshFormat \
         (a geometry is meshed by `gmsh -2 geometry.geo -o mesh.msh`)"
    )]
    NotGmsh,
    /// A version of the format other than 2.2 and 4.1.
    #[error(
        "{place}: format version {version} is not read, only 2.2 and 4.1; \
         convert the file by `gmsh mesh.msh -save -format msh41 -o new.msh`"
    )]
    UnsupportedVersion {
        /// Where the version stands.
        place: Place,
        /// The version found.
        version: String,
    },
    /// A binary file of another data size than 8.
    #[error(
        "{place}: a binary file with data of {bytes} bytes is not read, only of 8; \
         save the mesh as ASCII (`gmsh mesh.msh -save -format msh41 -o new.msh`)"
    )]
    UnsupportedDataSize {
        /// Where the size stands.
        place: Place,
        /// The size found.
        bytes: u64,
    },
    /// The integer that tells the byte order of a binary file is 1 in no byte order.
    #[error(
        "{place}: the byte order of this binary file is unknown; \
         was it copied as text? Copy it anew, or save the mesh as ASCII"
    )]
    UnknownByteOrder {
        /// Where the integer stands.
        place: Place,
    },
    /// A section that no mesh has.
    #[error("{place}: unknown section ${name}; save the mesh by Gmsh, without extra data")]
    UnknownSection {
        /// Where the section begins.
        place: Place,
        /// Name of the section, without the dollar sign.
        name: String,
    },
    /// The file ends within a section.
    #[error(
        "{place}: the section ${name} that begins here has no end: the file is cut off; save it again"
    )]
    TruncatedSection {
        /// Where the section begins.
        place: Place,
        /// Name of the section, without the dollar sign.
        name: String,
    },
    /// A section without which there is no mesh is not in the file.
    #[error(
        "the file has no section ${name}; was the geometry meshed (`gmsh -2`) before it was saved?"
    )]
    MissingSection {
        /// Name of the section, without the dollar sign.
        name: &'static str,
    },
    /// Something else stands where the format wants a certain value.
    #[error("{place}: expected {expected}, found {found}; the file is damaged, save it again")]
    Unexpected {
        /// Place of the value in the file.
        place: Place,
        /// The value that the format wants here, in words.
        expected: &'static str,
        /// The text that stands in the file instead.
        found: String,
    },
    /// More items are announced than the rest of the file has room for.
    #[error(
        "{place}: {count} {items} are announced, more than the rest of the file can hold: it is cut off or damaged"
    )]
    CountBeyondFile {
        /// Where the count stands.
        place: Place,
        /// What is counted.
        items: &'static str,
        /// The count.
        count: u64,
    },
    /// The system has no memory for the mesh.
    #[error(
        "there is no memory for this mesh: it takes at least {megabytes} MB more; mesh more coarsely, or give the program more (a limit as \
         of `ulimit -v`, or of the queue, may be set)"
    )]
    NoMemory {
        /// The least that is missing, MB.
        megabytes: usize,
    },
    /// The blocks of a section hold another number of items than its head announces.
    #[error(
        "{place}: {announced} {items} are announced, but the blocks hold {found}; save the mesh again"
    )]
    CountMismatch {
        /// Where the count stands.
        place: Place,
        /// What is counted.
        items: &'static str,
        /// The count in the head of the section.
        announced: u64,
        /// The count of the blocks.
        found: u64,
    },
    /// An element type that Gmsh does not have, or one that is no polynomial cell.
    #[error(
        "{place}: element type {code} is unknown or not supported; \
         mesh with triangles or quadrangles, a solid with tetrahedra, hexahedra, prisms or pyramids"
    )]
    UnknownElementType {
        /// Where the type stands.
        place: Place,
        /// Gmsh's number of the element type.
        code: i32,
    },
    /// A solid cell where a planar mesh was asked for.
    #[error(
        "{place}: element type {code} is a volume, but the mesh must be planar; \
         mesh with `gmsh -2` and save surfaces only"
    )]
    VolumeElement {
        /// Where the type stands.
        place: Place,
        /// Gmsh's number of the element type.
        code: i32,
    },
    /// A coordinate that is NaN, infinite or of absurd size.
    #[error(
        "{place}: node {tag} has the coordinate {value}, which is no position; mesh the geometry again"
    )]
    BadCoordinate {
        /// Where the node stands.
        place: Place,
        /// Tag of the node.
        tag: u64,
        /// The coordinate.
        value: f64,
    },
    /// Two nodes of the same tag.
    #[error("{place}: the node tag {tag} was already given at {first}; renumber the mesh")]
    DuplicateNodeTag {
        /// Place of the second of the two nodes.
        place: Place,
        /// The tag that both nodes have.
        tag: u64,
        /// Place of the first of the two nodes.
        first: Place,
    },
    /// An element names a node that the file does not have.
    #[error(
        "{place}: element {element} names node {node}, which the file does not have; save the mesh again"
    )]
    MissingNode {
        /// Where the element stands.
        place: Place,
        /// Tag of the element.
        element: u64,
        /// Tag of the node.
        node: u64,
    },
    /// The file has no triangle, no quadrangle and no solid cell.
    #[error(
        "the mesh has no cells: no triangle, no quadrangle and no solid cell; mesh the surface (`gmsh -2`) or the volume (`gmsh -3`) \
         and let a physical group hold it, or save all (Mesh.SaveAll = 1)"
    )]
    NoCells,
    /// More nodes or cells than can be numbered.
    #[error("the mesh has more than {} nodes or cells; coarsen it", u32::MAX)]
    TooLarge,
    /// There are no solid cells, and the others do not lie in one plane z = const.
    #[error(
        "{place}: node {tag} lies at z = {z}, others at z = {plane}: the mesh has no solid cells and is not planar; \
         put it into one plane z = const, or mesh the volume (`gmsh -3`) and let a physical volume hold it"
    )]
    NotPlanar {
        /// Where the node stands.
        place: Place,
        /// Tag of the node.
        tag: u64,
        /// Height z of the node, m.
        z: f64,
        /// Height z of the first node, m.
        plane: f64,
    },
    /// Two nodes at one place.
    #[error(
        "{place}: nodes {other} and {tag} are both at ({x}, {y}); merge them \
         (`Coherence Mesh;` in the geometry, or Geometry.AutoCoherence)"
    )]
    CoincidentNodes {
        /// Place of the second of the two nodes.
        place: Place,
        /// Tag of the second node.
        tag: u64,
        /// Tag of the first node.
        other: u64,
        /// Coordinate x of both nodes, m.
        x: f64,
        /// Coordinate y of both nodes, m.
        y: f64,
    },
    /// A cell that names a corner twice.
    #[error("{place}: cell {element} has node {node} at two corners; mesh the geometry again")]
    RepeatedCorner {
        /// Where the cell stands.
        place: Place,
        /// Tag of the cell.
        element: u64,
        /// Tag of the node.
        node: u64,
    },
    /// A cell whose corners lie on a line.
    #[error("{place}: cell {element} has no area; mesh the geometry again")]
    ZeroArea {
        /// Where the cell stands.
        place: Place,
        /// Tag of the cell.
        element: u64,
    },
    /// A quadrangle that is not convex or crosses itself.
    #[error(
        "{place}: quadrangle {element} is not convex; mesh again, with triangles (no Recombine) if need be"
    )]
    NotConvex {
        /// Where the cell stands.
        place: Place,
        /// Tag of the cell.
        element: u64,
    },
    /// Two cells on the same side of a common edge.
    #[error(
        "{place}: cell {element} overlaps cell {other}: both lie on the same side of their common edge; \
         mesh the geometry again, or check how its nodes were moved"
    )]
    OverlappingCells {
        /// Where the second stands.
        place: Place,
        /// Tag of the second cell.
        element: u64,
        /// Tag of the first cell.
        other: u64,
    },
    /// A cell that covers some of another one, with no edge or face in common.
    #[error(
        "{place}: cell {element} and cell {other} ({other_place}) lie over each other: \
         are there two meshes of one part, or do two parts of the geometry overlap? Remove one (`Coherence;`), and mesh again"
    )]
    CoveringCells {
        /// Where the second stands.
        place: Place,
        /// Tag of the second cell.
        element: u64,
        /// Tag of the first cell.
        other: u64,
        /// Where the first stands.
        other_place: Place,
    },
    /// Two nodes of a solid mesh at one place.
    #[error(
        "{place}: nodes {other} and {tag} are both at ({}, {}, {}); merge them \
         (`Coherence Mesh;` in the geometry, or Geometry.AutoCoherence)",
        .position[0], .position[1], .position[2]
    )]
    CoincidentNodesInSpace {
        /// Place of the second of the two nodes.
        place: Place,
        /// Tag of the second node.
        tag: u64,
        /// Tag of the first node.
        other: u64,
        /// Position of both nodes, m.
        position: [f64; 3],
    },
    /// A solid cell whose corners lie in a plane.
    #[error(
        "{place}: {shape} {element} is flat: its volume is {fraction:.1e} of the cube of its longest edge, less than {least:.0e}; \
         mesh again with `gmsh -3 -optimize`, or with smaller cells"
    )]
    FlatCell {
        /// Where the cell stands.
        place: Place,
        /// Tag of the cell.
        element: u64,
        /// Name of its shape.
        shape: &'static str,
        /// Volume over the cube of the longest edge.
        fraction: f64,
        /// The least fraction of a cell.
        least: f64,
    },
    /// A hexahedron, prism or pyramid that is not convex: its edges at a corner span no positive volume, or it is twisted.
    #[error(
        "{place}: {shape} {element} is not convex; are its corners in Gmsh's order? \
         Else mesh again, with tetrahedra (no Recombine) if need be"
    )]
    NotConvexSolid {
        /// Where the cell stands.
        place: Place,
        /// Tag of the cell.
        element: u64,
        /// Name of its shape.
        shape: &'static str,
    },
    /// Two solid cells on the same side of a common face.
    #[error(
        "{place}: cell {element} overlaps cell {other}: both lie on the same side of their common face; \
         mesh the geometry again, or check how its nodes were moved"
    )]
    OverlappingSolids {
        /// Where the second stands.
        place: Place,
        /// Tag of the second cell.
        element: u64,
        /// Tag of the first cell.
        other: u64,
    },
    /// A surface element in a group of a solid mesh that is a face of none of its cells.
    #[error(
        "{place}: element {element} of the surface \"{group}\" is a face of no solid cell; a mesh is of solid cells and their \
         faces, or of plane cells alone: leave the surface out of the physical groups, or mesh surface and volume together (`gmsh -3`)"
    )]
    LooseFace {
        /// Where the element stands.
        place: Place,
        /// Tag of the element.
        element: u64,
        /// Name of the group, or its number in decimal.
        group: String,
    },
    /// Two cells of the same corners.
    #[error(
        "{place}: cell {element} has the corners of cell {other}; \
         do two parts of the geometry overlap? Remove one (`Coherence;`)"
    )]
    DuplicateCell {
        /// Where the second stands.
        place: Place,
        /// Tag of the second cell.
        element: u64,
        /// Tag of the first cell.
        other: u64,
    },
}
