//! Input decks of Abaqus and CalculiX (`.inp`): the mesh with its sets and surfaces as groups, and all other keywords as they are.
//!
//! - Nodes and elements are read, generated and copied as the keywords say: `*NODE` (also with `SYSTEM` and under `*SYSTEM`), `*NGEN`,
//!   `*NFILL`, `*NCOPY`, `*ELEMENT`, `*ELGEN`, `*ELCOPY`, `*PART`, `*ASSEMBLY` and `*INSTANCE`. What would change the mesh and is not
//!   carried out is refused with its line, such as `*NMAP` or `BIAS`.
//! - Keywords and names are read without regard to case. Lines go on behind a comma, `**` begins a comment, numbers may have the exponents
//!   of Fortran. `*INCLUDE`, and `INPUT` of `*NODE` and `*ELEMENT`, read further files by a function of the caller.
//! - Solid elements (C3D4, C3D5, C3D6, C3D8, C3D10, C3D15, C3D20, ...) give a solid mesh; otherwise plane ones (CPS, CPE) give a planar one,
//!   and [`Deck::plane`] tells which. Shells in a plane are cells only where there is nothing else. Elements of second order keep their
//!   corners; elements with repeated corners are the cells that these form.
//! - Axisymmetric elements are refused. Springs, masses, connectors, cohesive and rigid elements, beams and trusses are left out.
//! - A set of nodes and a surface of nodes are a group of points; a set of elements is a group of cells. Elements in a set that are edges
//!   or faces of cells (trusses, shells, plane elements on a solid) form a group of curves or surfaces. A `*SURFACE` of sides of elements
//!   is a group of curves in the plane, of surfaces in space; sides without a number are those on the outline of the body.
//! - Sets of an instance are called `instance.set`. Nodes of several instances get unique numbers.
//! - Sides on which a `*DLOAD` presses are a group as well ([`Keyword::pressed_sides`]).
//! - [`Remark`](crate::Remark)s tell, with lines, what was left out or changed.
//!
//! The rules are those of the Abaqus Analysis User's Guide, sections 1.2.1, 2.1.1, 2.2.1, 2.3 and 2.10.1, and of the CalculiX manual.
//!
//! ```
//! let text = b"*NODE\n1, 0, 0\n2, 2, 0\n3, 0, 1\n*ELEMENT, TYPE=CPS3, ELSET=Plate\n1, 1, 2, 3\n*ELASTIC\n2.1D11, .3\n";
//! let deck = ligament_mesh::inp::parse(text, &mut |name| std::fs::read(name))?;
//! assert_eq!(deck.plane, Some(ligament_mesh::inp::Plane::Stress));
//! assert_eq!(deck.groups_named("PLATE").map(|group| group.cells.len()).sum::<usize>(), 1);
//! assert_eq!(deck.keywords[0].data[0].fields(), ["2.1D11", ".3"]);
//! # Ok::<(), ligament_mesh::inp::InpError>(())
//! ```

mod assembly;
mod body;
mod element_type;
mod elements;
mod error;
mod fields;
mod geometry;
mod groups;
mod keyword;
mod model;
mod nodes;
mod part;
mod reader;
mod sets;
mod shape;
mod source;

use std::collections::BTreeMap;
use std::io;

use crate::coordinate_plane::CoordinatePlane;
use crate::mesh::{AnyMesh, Group};
use crate::remark::FileLine;

pub use element_type::Plane;
pub use error::InpError;
pub use keyword::{DataLine, Keyword, Parameter, Scope};

/// Content of an input deck.
#[derive(Debug, Clone, PartialEq)]
pub struct Deck {
    /// The mesh, with sets and surfaces as groups.
    pub mesh: AnyMesh,
    /// State of the plane of a planar mesh; `None` for elements that do not say it, and for a solid mesh.
    pub plane: Option<Plane>,
    /// Keywords that are no part of the mesh, in their order.
    pub keywords: Vec<Keyword>,
    /// Instances in their order.
    pub instances: Vec<Instance>,
    /// Numbers of the nodes that are no nodes of the mesh, of each set with such nodes: reference points, and nodes between corners.
    pub outside: BTreeMap<String, Vec<u64>>,
    /// Nodes in the middle of an edge of a cell of second order, with the numbers of the two corners.
    pub midpoints: BTreeMap<u64, [u64; 2]>,
}

/// An instance of a part.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Instance {
    /// Name of the instance.
    pub name: String,
    /// Name of its part.
    pub part: String,
    /// Number that was added to the numbers of its nodes in the mesh.
    pub shift: u64,
}

impl Deck {
    /// Groups of a given name without regard to case, as the deck finds its sets and surfaces.
    pub fn groups_named(&self, name: &str) -> impl Iterator<Item = &Group> {
        let name = name.trim().trim_matches('"').to_uppercase();
        let groups = self.mesh.groups().iter();
        groups.filter(move |group| group.name.to_uppercase() == name)
    }

    /// Names of the keywords that are no part of the mesh, each with the number of its uses and the line of the first one.
    pub fn other_keywords(&self) -> BTreeMap<&str, (usize, &FileLine)> {
        let mut kinds = BTreeMap::new();
        for keyword in &self.keywords {
            let kind = kinds.entry(keyword.name.as_str());
            kind.or_insert((0, &keyword.line)).0 += 1;
        }
        kinds
    }
}

/// Reads an input deck; `read` gives the content of a file that the deck includes, by its name.
///
/// # Errors
/// Returns an error if the deck cannot be read or describes no mesh, with the line and what to do about it.
pub fn parse(
    text: &[u8],
    read: &mut dyn FnMut(&str) -> io::Result<Vec<u8>>,
) -> Result<Deck, InpError> {
    parse_with(text, CoordinatePlane::Xy, read)
}

/// Reads an input deck like [`parse`]; a planar mesh lies in a given plane.
///
/// # Errors
/// Returns an error as [`parse`] does, and for a solid mesh with another plane than that of x and y.
pub fn parse_with(
    text: &[u8],
    plane: CoordinatePlane,
    read: &mut dyn FnMut(&str) -> io::Result<Vec<u8>>,
) -> Result<Deck, InpError> {
    let source = source::Source::read(text, read)?;
    let model = reader::read(&source)?;
    let assembly::Assembled {
        mesh,
        body,
        outside,
        midpoints,
    } = assembly::assemble(&source, &model, plane)?;
    let plane = body.plane;
    let instances = body.spaces.iter().filter_map(|space| {
        Some(Instance {
            name: space.name?.to_owned(),
            part: space.part.name.clone(),
            shift: space.shift,
        })
    });
    let instances = instances.collect();
    Ok(Deck {
        mesh,
        plane,
        keywords: model.keywords,
        instances,
        outside,
        midpoints,
    })
}

/// Value of a field with a number, also with an exponent as Fortran writes it (`1.5D-3`, `1.5-103`); `None` for anything else.
pub fn number(field: &str) -> Option<f64> {
    fields::real(field.trim().as_bytes())
}
