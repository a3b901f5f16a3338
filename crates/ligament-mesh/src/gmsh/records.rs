//! Records of a file, before they form a mesh.

use std::collections::HashMap;
use std::num::NonZero;
use std::thread::available_parallelism;

use super::cursor::Cursor;
use super::element_type::Shape;
use super::error::GmshError;
use super::ignored::IgnoredSections;

/// Bytes of the stack of a thread.
const STACK: usize = 1 << 21;

/// Largest coordinate whose products do not overflow.
const LARGEST_COORDINATE: f64 = 1e100;

/// A node record.
#[derive(Debug, Clone, Copy)]
pub(super) struct Node {
    pub(super) tag: u64,
    pub(super) position: [f64; 3],
    /// Offset of the node in the file, bytes.
    pub(super) offset: usize,
}

/// An element record.
#[derive(Debug, Clone, Copy)]
pub(super) struct Element {
    pub(super) tag: u64,
    pub(super) shape: Shape,
    /// Whether the element has nodes in addition to its corners.
    pub(super) higher_order: bool,
    /// Number of the physical group (2.2) or of the entity (4.1), which determines the groups of the element; in 2.2, an element without
    /// a physical group may have the negative number of its entity.
    pub(super) owner: i32,
    /// Index of the first corner among the corners of all elements.
    pub(super) first_corner: usize,
    /// Offset of the element in the file, bytes.
    pub(super) offset: usize,
}

impl Element {
    /// Indices of its corners among the corners of all elements.
    pub(super) fn corners(&self) -> std::ops::Range<usize> {
        self.first_corner..self.first_corner + self.shape.corners()
    }
}

/// Offset of an element type in the file, and its number.
#[derive(Debug, Clone, Copy)]
pub(super) struct TypeRecord {
    pub(super) offset: usize,
    pub(super) code: i32,
}

/// The records of a section `$NodeData`.
#[derive(Debug)]
pub(super) struct FieldRecord {
    pub(super) name: String,
    pub(super) time_step: i32,
    pub(super) components: u64,
    /// Tags of nodes with their values; empty for all but scalars.
    pub(super) values: Vec<(u64, f64)>,
}

/// All records of a file that form a mesh.
#[derive(Debug, Default)]
pub(super) struct Records {
    pub(super) nodes: Vec<Node>,
    pub(super) elements: Vec<Element>,
    /// Tags of the corners of all elements, one after the other.
    pub(super) corners: Vec<u64>,
    /// Nodes of planar and solid cells that are not corners, each with the index of its element.
    pub(super) inner_nodes: Vec<(u64, u32)>,
    /// Type of the first solid element.
    pub(super) first_solid: Option<TypeRecord>,
    /// Names of physical groups by dimension and number.
    pub(super) names: HashMap<(u8, i32), String>,
    /// Numbers of physical groups with their names, which are given for all dimensions (2.0).
    pub(super) names_of_any: Vec<(i32, String)>,
    /// Numbers of the physical groups, by the dimension and the owner of their elements.
    pub(super) physicals: HashMap<(u8, i32), Vec<i32>>,
    /// Values at the nodes.
    pub(super) fields: Vec<FieldRecord>,
    /// Whether a cell in several groups has a record for each group, as in format 2.2, and not a single one, as in format 4.1.
    pub(super) repeats_cells: bool,
    /// Whether the groups of entities are known in a file of 2.2.
    pub(super) has_entities: bool,
    /// Sections that are not used.
    pub(super) ignored: IgnoredSections,
}

/// Properties of an element before its nodes.
#[derive(Debug, Clone, Copy)]
pub(super) struct ElementHeader {
    pub(super) tag: u64,
    /// Physical group, or entity, of the element.
    pub(super) owner: i32,
    /// Offset in the file, bytes.
    pub(super) offset: usize,
    /// Shape and number of nodes.
    pub(super) element_type: (Shape, usize),
}

impl Records {
    pub(super) fn push_node(&mut self, cursor: &Cursor<'_>, node: Node) -> Result<(), GmshError> {
        match node
            .position
            .iter()
            .find(|value| !(-LARGEST_COORDINATE..=LARGEST_COORDINATE).contains(*value))
        {
            Some(value) => Err(GmshError::BadCoordinate {
                place: cursor.place(node.offset),
                tag: node.tag,
                value: *value,
            }),
            None => {
                reserve(&mut self.nodes, 1)?;
                self.nodes.push(node);
                Ok(())
            }
        }
    }

    /// Shape and number of nodes of an element type.
    pub(super) fn element_type(
        &mut self,
        cursor: &Cursor<'_>,
        record: TypeRecord,
    ) -> Result<(Shape, usize), GmshError> {
        // The position costs a pass over the file: only errors compute it.
        let (shape, nodes) =
            Shape::from_code(record.code).ok_or_else(|| GmshError::UnknownElementType {
                place: cursor.place(record.offset),
                code: record.code,
            })?;
        if shape.dimension() == 3 {
            self.first_solid.get_or_insert(record);
        }
        Ok((shape, nodes))
    }

    /// Reads the node tags of an element with `tag`, and stores the element.
    pub(super) fn push_element<'a>(
        &mut self,
        cursor: &mut Cursor<'a>,
        header: ElementHeader,
        node_tag: impl Fn(&mut Cursor<'a>) -> Result<u64, GmshError>,
    ) -> Result<(), GmshError> {
        let ElementHeader {
            tag,
            owner,
            offset,
            element_type: (shape, nodes),
        } = header;
        let n_corners = shape.corners();
        let element = Element {
            tag,
            shape,
            higher_order: nodes > n_corners,
            owner,
            first_corner: self.corners.len(),
            offset,
        };
        reserve(&mut self.corners, n_corners)?;
        for _ in 0..n_corners {
            self.corners.push(node_tag(cursor)?);
        }
        let index = u32::try_from(self.elements.len()).map_err(|_| GmshError::TooLarge)?;
        for _ in n_corners..nodes {
            let inner = node_tag(cursor)?;
            if shape.dimension() > 1 {
                reserve(&mut self.inner_nodes, 1)?;
                self.inner_nodes.push((inner, index));
            }
        }
        reserve(&mut self.elements, 1)?;
        self.elements.push(element);
        Ok(())
    }

    /// Fails if the system does not have the memory to make a mesh of these records.
    ///
    /// The mesh is allocated in many parts, each of which would abort the program if it failed. Measured bytes besides the records were 172
    /// per node with its quadrangle (a million of them), 121 per triangle with its half of a node, 95 per tetrahedron with its sixth of a
    /// node and 186 per node with its hexahedron; the allocator reserves more address space, for growing lists and for each thread.
    pub(super) fn require_memory(&self) -> Result<(), GmshError> {
        // Threads that search for overlapping cells may start later.
        let threads = available_parallelism().map_or(1, NonZero::get);
        let parts = [
            self.nodes.len().saturating_mul(200),
            self.elements.len().saturating_mul(140),
            threads.saturating_mul(STACK),
        ];
        let sum = parts.into_iter().fold(0, usize::saturating_add);
        reserve(&mut Vec::<u8>::new(), sum)
    }
}

/// Reserves memory for more elements of a list, whose number is read from a file.
///
/// # Errors
///
/// Returns an error if the memory does not suffice.
pub(super) fn reserve<T>(list: &mut Vec<T>, more: usize) -> Result<(), GmshError> {
    list.try_reserve(more).map_err(|_| GmshError::NoMemory {
        megabytes: (list.len().saturating_add(more)).saturating_mul(size_of::<T>()) / 1_000_000,
    })
}
