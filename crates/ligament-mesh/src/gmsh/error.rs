//! Reasons why a mesh file is refused.

use thiserror::Error;

use crate::coordinate_plane::CoordinatePlane;
use crate::remark::FilePosition;

/// Reasons why a file was not read as a mesh.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum GmshError {
    /// The file is empty.
    #[error("the mesh file is empty; mesh the geometry again")]
    Empty,
    /// The file does not begin like a Gmsh mesh file.
    #[error(
        "not a Gmsh mesh file: it does not begin with $MeshFormat \
         (a geometry is meshed by `gmsh -2 geometry.geo -o mesh.msh`)"
    )]
    NotGmsh,
    /// A version of the format other than 2.0 to 2.2 and 4.1.
    #[error(
        "{place}: format version {version} is not read, only 2.2 (2.0, 2.1) and 4.1; \
         convert the file by `gmsh mesh.msh -save -format msh41 -o new.msh`"
    )]
    UnsupportedVersion {
        /// Position of the version.
        place: FilePosition,
        /// The version found.
        version: String,
    },
    /// A binary file of another data size than 8.
    #[error(
        "{place}: a binary file with data of {bytes} bytes is not read, only of 8; \
         save the mesh as ASCII (`gmsh mesh.msh -save -format msh41 -o new.msh`)"
    )]
    UnsupportedDataSize {
        /// Position of the data size.
        place: FilePosition,
        /// The data size found.
        bytes: u64,
    },
    /// The integer that indicates the byte order of a binary file is 1 in no byte order.
    #[error(
        "{place}: the byte order of this binary file is unknown; \
         was it copied as text? Copy it anew, or save the mesh as ASCII"
    )]
    UnknownByteOrder {
        /// Position of the integer.
        place: FilePosition,
    },
    /// The file ends within a section.
    #[error(
        "{place}: the section ${name} that begins here has no end: the file is cut off; save it again"
    )]
    TruncatedSection {
        /// Position of the beginning of the section.
        place: FilePosition,
        /// Name of the section, without the dollar sign.
        name: String,
    },
    /// A section required for a mesh is missing.
    #[error(
        "the file has no section ${name}; was the geometry meshed (`gmsh -2`) before it was saved?"
    )]
    MissingSection {
        /// Name of the section, without the dollar sign.
        name: &'static str,
    },
    /// An unexpected value.
    #[error("{place}: expected {expected}, found {found}; the file is damaged, save it again")]
    Unexpected {
        /// Position of the value.
        place: FilePosition,
        /// Description of the expected value.
        expected: &'static str,
        /// The text found instead.
        found: String,
    },
    /// A count is larger than the rest of the file has room for.
    #[error(
        "{place}: {count} {items} are announced, more than the rest of the file can hold: it is cut off or damaged"
    )]
    CountBeyondFile {
        /// Position of the count.
        place: FilePosition,
        /// Kind of the counted items.
        items: &'static str,
        /// Number that the file gives.
        count: u64,
    },
    /// The memory does not suffice for the mesh.
    #[error(
        "there is no memory for this mesh: it takes at least {megabytes} MB more; mesh more coarsely, or give the program more (a limit as \
         of `ulimit -v`, or of the queue, may be set)"
    )]
    NoMemory {
        /// Missing memory at least, MB.
        megabytes: usize,
    },
    /// The blocks of a section contain another number of items than its head announces.
    #[error(
        "{place}: {announced} {items} are announced, but the blocks hold {found}; save the mesh again"
    )]
    CountMismatch {
        /// Position of the count.
        place: FilePosition,
        /// Kind of the counted items.
        items: &'static str,
        /// The count in the head of the section.
        announced: u64,
        /// The count of the items in the blocks.
        found: u64,
    },
    /// An element type that Gmsh does not have, or one that is no polynomial cell.
    #[error(
        "{place}: element type {code} is unknown or not supported; \
         mesh with triangles or quadrangles, a solid with tetrahedra, hexahedra, prisms or pyramids"
    )]
    UnknownElementType {
        /// Position of the type.
        place: FilePosition,
        /// Gmsh's number of the element type.
        code: i32,
    },
    /// A solid cell where a planar mesh is required.
    #[error(
        "{place}: element type {code} is a volume, but the mesh must be planar; \
         mesh with `gmsh -2` and save surfaces only"
    )]
    VolumeElement {
        /// Position of the type.
        place: FilePosition,
        /// Gmsh's number of the element type.
        code: i32,
    },
    /// A coordinate that is NaN, infinite or too large.
    #[error(
        "{place}: node {tag} has the coordinate {value}, which is no position; mesh the geometry again"
    )]
    BadCoordinate {
        /// Position of the node.
        place: FilePosition,
        /// Tag of the node.
        tag: u64,
        /// Coordinate that is not a finite number.
        value: f64,
    },
    /// Two nodes of the same tag.
    #[error("{place}: the node tag {tag} was already given at {first}; renumber the mesh")]
    DuplicateNodeTag {
        /// Position of the second of the two nodes.
        place: FilePosition,
        /// The tag that both nodes have.
        tag: u64,
        /// Position of the first of the two nodes.
        first: FilePosition,
    },
    /// An element refers to a node that the file does not have.
    #[error(
        "{place}: {} names node {node}, which the file does not have; save the mesh again",
        if *.element == 0 { "a set".to_owned() } else { format!("element {}", .element) }
    )]
    MissingNode {
        /// Position of the element.
        place: FilePosition,
        /// Tag of the element; 0 for a set of nodes.
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
    /// The mesh has no solid cells, and its nodes do not lie in one plane z = const.
    #[error(
        "{place}: node {tag} lies at z = {z}, others at z = {plane}: the mesh has no solid cells and is not planar; \
         put it into one plane z = const, or mesh the volume (`gmsh -3`) and let a physical volume hold it"
    )]
    NotPlanar {
        /// Position of the node.
        place: FilePosition,
        /// Tag of the node.
        tag: u64,
        /// Height z of the node, m.
        z: f64,
        /// Height z of the first node, m.
        plane: f64,
    },
    /// The mesh lies in another coordinate plane than the one in which it is expected.
    #[error(
        "{place}: the mesh lies in the plane of {plane} ({} = {height}), not in that of {wanted}; {}",
        .plane.normal().0, .plane.remedy(*.wanted)
    )]
    OtherPlane {
        /// Position of the first node off the expected plane.
        place: FilePosition,
        /// Plane in which the mesh lies.
        plane: CoordinatePlane,
        /// Coordinate of all nodes across this plane, m.
        height: f64,
        /// Plane in which the mesh is expected.
        wanted: CoordinatePlane,
    },
    /// A mesh that is expected in another plane than that of x and y does not lie in a plane of two coordinates.
    #[error(
        "{place}: node {tag} lies at {} = {height}, others at {common}: \
         the mesh does not lie in the plane of {wanted}",
        .wanted.normal().0
    )]
    NotInPlane {
        /// Position of the node.
        place: FilePosition,
        /// Tag of the node.
        tag: u64,
        /// Plane in which the mesh is expected.
        wanted: CoordinatePlane,
        /// Coordinate of the node across this plane, m.
        height: f64,
        /// Coordinate of the first node across this plane, m.
        common: f64,
    },
    /// A plane is given for a mesh with solid cells.
    #[error(
        "{place}: a solid cell: only a mesh without solid cells is turned from the plane of {plane}"
    )]
    SolidInPlane {
        /// Position of the type of the first solid cell.
        place: FilePosition,
        /// Plane that was given.
        plane: CoordinatePlane,
    },
    /// Doubled nodes along a seam between parts that are not joined, or along a crack that parts the body.
    #[error(
        "{place}: nodes {other} and {tag} are at one place, as {faces} pairs of outer sides of cells are, and part the mesh into pieces: are \
         parts not joined? `Coherence Mesh;` in the geometry joins them; a crack through the whole body is given as a pre-crack"
    )]
    Seam {
        /// Position in the file of the second of two coincident nodes.
        place: FilePosition,
        /// Tag of the second node.
        tag: u64,
        /// Tag of the first node.
        other: u64,
        /// Number of pairs of outer sides at one place.
        faces: usize,
    },
    /// Two nodes at one position.
    #[error(
        "{place}: nodes {other} and {tag} are both at ({x}, {y}); merge them \
         (`Coherence Mesh;` in the geometry, or Geometry.AutoCoherence)"
    )]
    CoincidentNodes {
        /// Position in the file of the second of the two nodes.
        place: FilePosition,
        /// Tag of the second node.
        tag: u64,
        /// Tag of the first node.
        other: u64,
        /// Coordinate x of both nodes, m.
        x: f64,
        /// Coordinate y of both nodes, m.
        y: f64,
    },
    /// A cell with a repeated corner that is no cell with fewer corners.
    #[error(
        "{place}: cell {element} has node {node} at two corners, and is no cell with fewer corners; mesh the geometry again"
    )]
    RepeatedCorner {
        /// Position of the cell.
        place: FilePosition,
        /// Tag of the cell.
        element: u64,
        /// Tag of the node.
        node: u64,
    },
    /// A cell whose corners lie on a line.
    #[error("{place}: cell {element} has no area; mesh the geometry again")]
    ZeroArea {
        /// Position of the cell.
        place: FilePosition,
        /// Tag of the cell.
        element: u64,
    },
    /// A quadrangle that is not convex or crosses itself.
    #[error(
        "{place}: quadrangle {element} is not convex; are its corners in Gmsh's order (pixels of VTK have the last two exchanged)? \
         Else mesh again, with triangles (no Recombine) if need be"
    )]
    NotConvex {
        /// Position of the cell.
        place: FilePosition,
        /// Tag of the cell.
        element: u64,
    },
    /// Two cells on the same side of a common edge.
    #[error(
        "{place}: cell {element} overlaps cell {other}: both lie on the same side of their common edge; \
         mesh the geometry again, or check how its nodes were moved"
    )]
    OverlappingCells {
        /// Position of the second cell.
        place: FilePosition,
        /// Tag of the second cell.
        element: u64,
        /// Tag of the first cell.
        other: u64,
    },
    /// Two cells that overlap without a common edge or face.
    #[error(
        "{place}: cell {element} and cell {other} ({other_place}) lie over each other: \
         are there two meshes of one part, or do two parts of the geometry overlap? Remove one (`Coherence;`), and mesh again"
    )]
    CoveringCells {
        /// Position of the second cell.
        place: FilePosition,
        /// Tag of the second cell.
        element: u64,
        /// Tag of the first cell.
        other: u64,
        /// Position of the first cell.
        other_place: FilePosition,
    },
    /// Two nodes of a solid mesh at one position.
    #[error(
        "{place}: nodes {other} and {tag} are both at ({}, {}, {}); merge them \
         (`Coherence Mesh;` in the geometry, or Geometry.AutoCoherence)",
        .position[0], .position[1], .position[2]
    )]
    CoincidentNodesInSpace {
        /// Position in the file of the second of the two nodes.
        place: FilePosition,
        /// Tag of the second node.
        tag: u64,
        /// Tag of the first node.
        other: u64,
        /// Position of both nodes, m.
        position: [f64; 3],
    },
    /// A solid cell whose corners lie nearly in a plane.
    #[error(
        "{place}: {shape} {element} is flat: its volume is {fraction:.1e} of the cube of its longest edge, less than {least:.0e}; \
         mesh again with `gmsh -3 -optimize`, or with smaller cells"
    )]
    FlatCell {
        /// Position of the cell.
        place: FilePosition,
        /// Tag of the cell.
        element: u64,
        /// Name of the shape.
        shape: &'static str,
        /// Ratio of the volume to the cube of the longest edge.
        fraction: f64,
        /// Smallest ratio admitted.
        least: f64,
    },
    /// A hexahedron, prism or pyramid that is not convex: its edges at a corner span no positive volume, or it is twisted.
    #[error(
        "{place}: {shape} {element} is not convex; are its corners in Gmsh's order (voxels of VTK have the last two of base and top \
         exchanged)? \
         Else mesh again, with tetrahedra (no Recombine) if need be"
    )]
    NotConvexSolid {
        /// Position of the cell.
        place: FilePosition,
        /// Tag of the cell.
        element: u64,
        /// Name of the shape.
        shape: &'static str,
    },
    /// Two solid cells on the same side of a common face.
    #[error(
        "{place}: cell {element} overlaps cell {other}: both lie on the same side of their common face; \
         mesh the geometry again, or check how its nodes were moved"
    )]
    OverlappingSolids {
        /// Position of the second cell.
        place: FilePosition,
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
        /// Position of the element.
        place: FilePosition,
        /// Tag of the element.
        element: u64,
        /// Name of the group, or its number in decimal.
        group: String,
    },
    /// Two cells with the same corners.
    #[error(
        "{place}: cell {element} has the corners of cell {other}; \
         do two parts of the geometry overlap? Remove one (`Coherence;`)"
    )]
    DuplicateCell {
        /// Position of the second cell.
        place: FilePosition,
        /// Tag of the second cell.
        element: u64,
        /// Tag of the first cell.
        other: u64,
    },
}
