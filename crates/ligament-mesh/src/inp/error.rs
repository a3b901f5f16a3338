//! Reasons why an input deck is refused.

use std::sync::Arc;

use thiserror::Error;

use super::element_type::{Plane, Refusal};
use crate::coordinate_plane::CoordinatePlane;
use crate::remark::FileLine;

/// Reasons why an input deck was not read as a mesh.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum InpError {
    /// A file that is no text.
    #[error(
        "{} is no text: it contains zero bytes; save it as a text file, in ASCII or UTF-8",
        .file.as_deref().unwrap_or("the file")
    )]
    NotText {
        /// Name of the file if it is an included one.
        file: Option<Arc<str>>,
    },
    /// Data before the first keyword.
    #[error(
        "{line}: data before the first keyword; an input file of Abaqus or CalculiX begins with a keyword such as *HEADING or *NODE"
    )]
    DataWithoutKeyword {
        /// Line of the data.
        line: FileLine,
    },
    /// A file that is included and cannot be read.
    #[error("{line}: cannot read the included file {file}: {reason}")]
    UnreadableInclude {
        /// Line that includes the file.
        line: FileLine,
        /// Name of the file, as it is written there.
        file: String,
        /// Reason why it cannot be read.
        reason: String,
    },
    /// A keyword without a parameter that it needs.
    #[error("{line}: *{keyword} has no {parameter}=; add it")]
    MissingParameter {
        /// Line of the keyword.
        line: FileLine,
        /// Name of the keyword.
        keyword: String,
        /// Name of the parameter.
        parameter: &'static str,
    },
    /// A parameter of a keyword of the mesh that has no meaning here.
    #[error(
        "{line}: the parameter {parameter} of *{keyword} is not read: remove it if the mesh does not depend on it, else write the nodes, \
         elements or sets out (in Abaqus/CAE: Job, Write Input)"
    )]
    UnknownParameter {
        /// Line of the keyword.
        line: FileLine,
        /// Name of the keyword.
        keyword: String,
        /// Name of the parameter.
        parameter: String,
    },
    /// A keyword of the mesh that is abbreviated.
    #[error("{line}: *{found} is short for *{keyword}; write it out")]
    Abbreviated {
        /// Line of the keyword.
        line: FileLine,
        /// The keyword as written.
        found: String,
        /// The keyword that it begins.
        keyword: &'static str,
    },
    /// Something that would change the mesh and is not carried out.
    #[error("{line}: {what} is not carried out; {remedy}")]
    NotCarriedOut {
        /// Line of the keyword or the data.
        line: FileLine,
        /// The keyword with the parameter, or the data.
        what: String,
        /// Description of what the user can do.
        remedy: &'static str,
    },
    /// An unexpected value.
    #[error("{line}: expected {expected}, found {found}; correct the line")]
    Unexpected {
        /// Line of the value.
        line: FileLine,
        /// Description of the expected value.
        expected: &'static str,
        /// The text found instead.
        found: String,
    },
    /// A value that is given by an expression.
    #[error(
        "{line}: {expression} is a value of *PARAMETER, which is not evaluated; write the number"
    )]
    Expression {
        /// Line of the value.
        line: FileLine,
        /// The expression.
        expression: String,
    },
    /// A keyword at a level where it cannot be.
    #[error("{line}: *{keyword} cannot be here: {reason}")]
    Misplaced {
        /// Line of the keyword.
        line: FileLine,
        /// Name of the keyword.
        keyword: String,
        /// Description of what is open or missing.
        reason: &'static str,
    },
    /// A name that nothing above the line has.
    #[error(
        "{line}: there is no {what} {name} above this line; correct the name, or define it before it is used"
    )]
    UnknownName {
        /// Line that uses the name.
        line: FileLine,
        /// What is named: a node set, an element set, a part, an instance.
        what: &'static str,
        /// The name.
        name: String,
    },
    /// A node or element that a keyword generates others from, and that is not defined above.
    #[error(
        "{line}: there is no {what} {label} above this line; define it before others are generated from it"
    )]
    UnknownLabel {
        /// Line that uses the number.
        line: FileLine,
        /// What is numbered: a node or an element.
        what: &'static str,
        /// The number.
        label: u32,
    },
    /// Two parts or two instances of one name.
    #[error("{line}: the {what} {name} was already defined at {first}; rename one of them")]
    RepeatedName {
        /// Line of the second definition.
        line: FileLine,
        /// What is named: a part or an instance.
        what: &'static str,
        /// The name.
        name: String,
        /// Line of the first definition.
        first: FileLine,
    },
    /// Several parts, of which none has an instance.
    #[error(
        "{line}: no part has an instance; add *ASSEMBLY with an *INSTANCE of each part that the body consists of"
    )]
    NoInstance {
        /// Line of the first part.
        line: FileLine,
    },
    /// An element type that is not known.
    #[error(
        "{line}: the element type {kind} is not known; use plane elements (CPS4, CPE3, ...) or solid ones (C3D4, C3D8, ...)"
    )]
    UnknownElementType {
        /// Line of the keyword.
        line: FileLine,
        /// The type.
        kind: String,
    },
    /// An element type of another kind of body.
    #[error("{line}: the element type {kind} is not read: {reason}")]
    UnfitElementType {
        /// Line of the keyword.
        line: FileLine,
        /// The type.
        kind: String,
        /// Reason why it is not read, and what to do.
        reason: &'static str,
    },
    /// An element with another number of nodes than its type has.
    #[error(
        "{line}: element {element} of type {kind} has {found} nodes for {expected}; correct the line"
    )]
    WrongNumberOfNodes {
        /// Line of the element.
        line: FileLine,
        /// Number of the element.
        element: u32,
        /// Element type.
        kind: String,
        /// Number of nodes that the type has.
        expected: usize,
        /// Number of nodes found.
        found: usize,
    },
    /// A side that a type of elements does not have.
    #[error("{line}: there is no side {side} of an element of type {kind}; correct the line")]
    UnknownSide {
        /// Line of the side.
        line: FileLine,
        /// Name of the side.
        side: String,
        /// Element type.
        kind: String,
    },
    /// Elements of plane stress and of plane strain in one body.
    #[error(
        "{line}: the elements of type {kind} are of plane {}, those of type {other} ({other_line}) of plane {}; use one of them for the whole body",
        word(*.plane), word(*.other_plane)
    )]
    PlaneConflict {
        /// Line of the first elements of one kind.
        line: FileLine,
        /// Type of these elements.
        kind: String,
        /// State of the plane of these elements.
        plane: Plane,
        /// Line of the first elements of the other kind.
        other_line: FileLine,
        /// Type of the other elements.
        other: String,
        /// State of the plane of the other elements.
        other_plane: Plane,
    },
    /// An element names a node that the deck does not define.
    #[error(
        "{line}: element {element} names node {node}, which the file does not define; define the node, or correct the element"
    )]
    MissingNode {
        /// Line of the element.
        line: FileLine,
        /// Number of the element, with the name of its instance.
        element: String,
        /// Number of the node.
        node: u32,
    },
    /// A plane element in a deck with solid ones that is no face of these.
    #[error(
        "{line}: element {element} of type {kind} is a plane element beside solid ones, and is the face of none of them; a body consists of \
         solid elements or of plane ones: remove the others"
    )]
    LoosePlaneElement {
        /// Line of the element.
        line: FileLine,
        /// Number of the element, with the name of its instance.
        element: String,
        /// Element type.
        kind: String,
    },
    /// The deck has no element that is a cell.
    #[error(
        "the file has no plane or solid elements, of which the body could consist; write the mesh with elements such as CPS4, CPE3, C3D4 or C3D8"
    )]
    NoCells,
    /// More nodes or cells than can be numbered.
    #[error("the mesh has more than {} nodes or cells; coarsen it", u32::MAX)]
    TooLarge,
    /// The memory does not suffice for the mesh.
    #[error(
        "there is no memory for this mesh: it takes at least {megabytes} MB more; mesh more coarsely, or give the program more (a limit as \
         of `ulimit -v`, or of the queue, may be set)"
    )]
    NoMemory {
        /// Missing memory at least, MB.
        megabytes: usize,
    },
    /// A node of a planar mesh off the plane of the others.
    #[error(
        "{line}: node {node} lies at z = {z}, others at z = {plane}: the mesh has no solid elements and is not planar; put it into one plane \
         z = const"
    )]
    NotPlanar {
        /// Line of the node.
        line: FileLine,
        /// Number of the node, with the name of its instance.
        node: String,
        /// Height z of the node, m.
        z: f64,
        /// Height z of the first node, m.
        plane: f64,
    },
    /// The mesh lies in a plane, but not in that of x and y.
    #[error(
        "the mesh lies in the plane of {plane}, not in that of x and y; exchange the coordinates, or turn the part"
    )]
    OtherPlane {
        /// Plane in which the mesh lies.
        plane: CoordinatePlane,
    },
    /// Two nodes at one position: parts that are not joined, or a crack in the mesh.
    #[error(
        "{line}: nodes {other} ({other_line}) and {node} are at one place{}; merge them (in Abaqus/CAE: Edit Mesh, Merge nodes, or merge the \
         instances): cells are joined by the nodes that they share, and a crack is given as a pre-crack",
        faces_at_one_place(*.faces)
    )]
    CoincidentNodes {
        /// Line of the second node.
        line: FileLine,
        /// Number of the second node, with the name of its instance.
        node: String,
        /// Number of the first node, with the name of its instance.
        other: String,
        /// Line of the first node.
        other_line: FileLine,
        /// Number of pairs of outer sides of cells at one place, where all coincident nodes are on such sides.
        faces: usize,
    },
    /// An element whose shape is no cell: flat, or not convex.
    #[error("{line}: element {element} of type {kind} {fault}; mesh the part again")]
    UnfitElement {
        /// Line of the element.
        line: FileLine,
        /// Number of the element, with the name of its instance.
        element: String,
        /// Element type.
        kind: String,
        /// Description of the fault.
        fault: &'static str,
    },
    /// Two elements in one place.
    #[error(
        "{line}: element {element} {fault} element {other} ({other_line}); is one part there twice? Remove one of the two"
    )]
    OverlappingElements {
        /// Line of the second element.
        line: FileLine,
        /// Number of the second element, with the name of its instance.
        element: String,
        /// Description of how they overlap.
        fault: &'static str,
        /// Number of the first element, with the name of its instance.
        other: String,
        /// Line of the first element.
        other_line: FileLine,
    },
    /// Any other fault of the mesh.
    #[error("{reason}")]
    Unfit {
        /// Description of the fault.
        reason: String,
    },
}

fn faces_at_one_place(faces: usize) -> String {
    match faces {
        0 => String::new(),
        faces => format!(", as {faces} pairs of outer sides of cells are"),
    }
}

fn word(plane: Plane) -> &'static str {
    match plane {
        Plane::Stress => "stress",
        Plane::Strain => "strain",
    }
}

impl InpError {
    /// An unexpected value; a value in angle brackets is an expression.
    pub(super) fn unexpected(line: FileLine, expected: &'static str, found: &[u8]) -> Self {
        let text = String::from_utf8_lossy(found).into_owned();
        if text.starts_with('<') {
            return Self::Expression {
                line,
                expression: text,
            };
        }
        let found = match text.as_str() {
            "" => "nothing".to_owned(),
            text => format!("\"{}\"", text.escape_debug()),
        };
        Self::Unexpected {
            line,
            expected,
            found,
        }
    }

    pub(super) fn refused_type(line: FileLine, kind: String, refusal: Refusal) -> Self {
        let reason = match refusal {
            Refusal::Unknown => return Self::UnknownElementType { line, kind },
            Refusal::Axisymmetric => {
                "a body of revolution is no plane one; model it in space, or a slice of it in the plane"
            }
            Refusal::GeneralisedPlaneStrain => {
                "in generalised plane strain the body may stretch across the plane; use elements of plane strain (CPE)"
            }
        };
        Self::UnfitElementType { line, kind, reason }
    }
}
