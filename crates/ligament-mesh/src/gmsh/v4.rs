//! Entities, nodes and elements of format 4.1.

use super::cursor::Cursor;
use super::error::GmshError;
use super::records::{ElementHeader, Node, Records, TypeRecord, reserve};

/// Reads the groups of the entities from `$Entities`, or `$PartitionedEntities`, after its first line.
///
/// Records of text may go on in the next line, as Gmsh reads them; a file in which they do not is read line by line, so that an error is
/// found in its line.
pub(super) fn read_entities(
    cursor: &mut Cursor<'_>,
    records: &mut Records,
    partitioned: bool,
) -> Result<(), GmshError> {
    let begin = cursor.offset();
    let by_lines = read_all_entities(cursor, records, partitioned);
    if by_lines.is_ok() || !cursor.is_ascii() {
        return by_lines;
    }
    cursor.rewind(begin);
    cursor
        .with_free_rows(|cursor| read_all_entities(cursor, records, partitioned))
        .or(by_lines)
}

fn read_all_entities(
    cursor: &mut Cursor<'_>,
    records: &mut Records,
    partitioned: bool,
) -> Result<(), GmshError> {
    if partitioned {
        skip_partitions(cursor)?;
    }
    cursor.begin_row();
    let mut counts = [0; 4];
    for count in &mut counts {
        *count = cursor.size("a number of entities")?;
    }
    for (dimension, count) in (0u8..).zip(counts) {
        for _ in 0..count {
            read_entity(cursor, records, dimension, partitioned)?;
        }
    }
    cursor.end_section()
}

/// Skips the head of `$PartitionedEntities`: the number of partitions and the ghost entities.
fn skip_partitions(cursor: &mut Cursor<'_>) -> Result<(), GmshError> {
    cursor.begin_row();
    cursor.size("the number of partitions")?;
    cursor.begin_row();
    let ghosts = cursor.size("the number of ghost entities")?;
    for _ in 0..ghosts {
        cursor.begin_row();
        skip_ints(cursor, 2, "a ghost entity")?;
    }
    Ok(())
}

fn read_entity(
    cursor: &mut Cursor<'_>,
    records: &mut Records,
    dimension: u8,
    partitioned: bool,
) -> Result<(), GmshError> {
    cursor.begin_row();
    let tag = cursor.int("an entity tag")?;
    if partitioned {
        skip_ints(cursor, 2, "a parent entity")?;
        let partitions = cursor.size("a number of partitions")?;
        skip_ints(cursor, partitions, "a partition")?;
    }
    // A point has its position, other entities have their bounding box.
    for _ in 0..if dimension == 0 { 3 } else { 6 } {
        cursor.real("a coordinate of an entity")?;
    }
    let count = cursor.size("a number of physical tags")?;
    let mut physicals = Vec::new();
    for _ in 0..count {
        // A negative tag is the group in reversed orientation.
        physicals.push(cursor.int("a physical tag")?.saturating_abs());
    }
    physicals.sort_unstable();
    physicals.dedup();
    records.physicals.insert((dimension, tag), physicals);
    if dimension > 0 {
        let bounds = cursor.size("a number of bounding entities")?;
        skip_ints(cursor, bounds, "a bounding entity")?;
    }
    cursor.end_row()
}

fn skip_ints(cursor: &mut Cursor<'_>, count: u64, expected: &'static str) -> Result<(), GmshError> {
    for _ in 0..count {
        cursor.int(expected)?;
    }
    Ok(())
}

/// First row of a section `$Nodes` or `$Elements`.
struct SectionHead {
    offset: usize,
    blocks: u64,
    total: u64,
}

impl SectionHead {
    fn read(cursor: &mut Cursor<'_>) -> Result<Self, GmshError> {
        cursor.begin_row();
        let offset = cursor.offset();
        let blocks = cursor.size("the number of entity blocks")?;
        let total = cursor.size("the total number")?;
        cursor.size("the smallest tag")?;
        cursor.size("the largest tag")?;
        cursor.end_row()?;
        Ok(Self {
            offset,
            blocks,
            total,
        })
    }

    /// Ends the section, which must contain as many items as its head announces.
    fn end(
        &self,
        cursor: &mut Cursor<'_>,
        items: &'static str,
        found: usize,
    ) -> Result<(), GmshError> {
        if found as u64 != self.total {
            return Err(GmshError::CountMismatch {
                place: cursor.place(self.offset),
                items,
                announced: self.total,
                found: found as u64,
            });
        }
        cursor.end_section()
    }
}

/// Dimension of an entity, 0 to 3.
fn dimension(cursor: &mut Cursor<'_>) -> Result<u8, GmshError> {
    const EXPECTED: &str = "an entity dimension from 0 to 3";
    let offset = cursor.offset();
    let dimension = cursor.int(EXPECTED)?;
    match u8::try_from(dimension) {
        Ok(dimension @ 0..=3) => Ok(dimension),
        _ => Err(cursor.unexpected_text_error(offset, EXPECTED, dimension.to_string())),
    }
}

/// Reads `$Nodes` after its first line.
pub(super) fn read_nodes(cursor: &mut Cursor<'_>, records: &mut Records) -> Result<(), GmshError> {
    let before = records.nodes.len();
    let head = SectionHead::read(cursor)?;
    let mut tags = Vec::new();
    for _ in 0..head.blocks {
        read_node_block(cursor, records, &mut tags)?;
    }
    head.end(cursor, "nodes", records.nodes.len() - before)
}

/// Reads the nodes of an entity; `tags` is a buffer to reuse.
fn read_node_block(
    cursor: &mut Cursor<'_>,
    records: &mut Records,
    tags: &mut Vec<(u64, usize)>,
) -> Result<(), GmshError> {
    cursor.begin_row();
    let dimension = dimension(cursor)?;
    cursor.int("an entity tag")?;
    let parametric = cursor.int("0 or 1 for parametric nodes")? != 0;
    let count_offset = cursor.offset();
    let count = cursor.size("a number of nodes")?;
    cursor.end_row()?;
    let smallest = if cursor.is_ascii() {
        "1\n0 0 0\n".len()
    } else {
        8 + 3 * 8
    };
    let count = cursor.check_count(count_offset, count, smallest, "nodes")?;

    tags.clear();
    reserve(tags, count)?;
    for _ in 0..count {
        cursor.begin_row();
        let offset = cursor.offset();
        tags.push((cursor.size("a node tag")?, offset));
        cursor.end_row()?;
    }
    reserve(&mut records.nodes, count)?;
    let parameters = if parametric { dimension } else { 0 };
    for &(tag, offset) in tags.iter() {
        let position = read_position(cursor, parameters)?;
        let node = Node {
            tag,
            position,
            offset,
        };
        records.push_node(cursor, node)?;
    }
    Ok(())
}

/// Reads a row of coordinates and skips the parametric ones after them.
fn read_position(cursor: &mut Cursor<'_>, parameters: u8) -> Result<[f64; 3], GmshError> {
    cursor.begin_row();
    let mut position = [0.0; 3];
    for coordinate in &mut position {
        *coordinate = cursor.real("a coordinate")?;
    }
    for _ in 0..parameters {
        cursor.real("a parametric coordinate")?;
    }
    cursor.end_row()?;
    Ok(position)
}

/// Reads `$Elements` after its first line.
pub(super) fn read_elements(
    cursor: &mut Cursor<'_>,
    records: &mut Records,
) -> Result<(), GmshError> {
    let before = records.elements.len();
    let head = SectionHead::read(cursor)?;
    for _ in 0..head.blocks {
        read_element_block(cursor, records)?;
    }
    head.end(cursor, "elements", records.elements.len() - before)
}

/// Reads the elements of an entity.
fn read_element_block(cursor: &mut Cursor<'_>, records: &mut Records) -> Result<(), GmshError> {
    cursor.begin_row();
    let dimension = dimension(cursor)?;
    let entity = cursor.int("an entity tag")?;
    let record = TypeRecord {
        offset: cursor.offset(),
        code: cursor.int("an element type")?,
    };
    let element_type = records.element_type(cursor, record)?;
    if element_type.0.dimension() != dimension {
        let expected = "an element type of the dimension of its entity";
        return Err(cursor.unexpected_text_error(record.offset, expected, record.code.to_string()));
    }
    let count_offset = cursor.offset();
    let count = cursor.size("a number of elements")?;
    cursor.end_row()?;
    let smallest = if cursor.is_ascii() { 2 } else { 8 } * (1 + element_type.1);
    let count = cursor.check_count(count_offset, count, smallest, "elements")?;
    reserve(&mut records.elements, count)?;
    for _ in 0..count {
        cursor.begin_row();
        let offset = cursor.offset();
        let tag = cursor.size("an element tag")?;
        let header = ElementHeader {
            tag,
            owner: entity,
            offset,
            element_type,
        };
        records.push_element(cursor, header, |cursor| cursor.size("a node tag"))?;
        cursor.end_row()?;
    }
    Ok(())
}
