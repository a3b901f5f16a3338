//! Nodes, elements and entities of format 2.2, and of 2.0 and 2.1.

use super::cursor::Cursor;
use super::element_type::Shape;
use super::error::GmshError;
use super::records::{ElementHeader, Node, Records, TypeRecord, reserve};

/// Reads `$Nodes` after its first line, or `$ParametricNodes`, whose nodes also have the dimension and the number of their entity, and a
/// parametric coordinate for each dimension of a curve or a surface.
pub(super) fn read_nodes(
    cursor: &mut Cursor<'_>,
    records: &mut Records,
    parametric: bool,
) -> Result<(), GmshError> {
    let (begin, count) = cursor.count_line("the number of nodes")?;
    let smallest = if cursor.is_ascii() {
        "1 0 0 0\n".len()
    } else {
        4 + 3 * 8
    };
    let count = cursor.check_count(begin, count, smallest, "nodes")?;
    reserve(&mut records.nodes, count)?;
    for _ in 0..count {
        cursor.begin_row();
        let offset = cursor.offset();
        let tag = cursor.unsigned_int("a node number")?;
        let mut position = [0.0; 3];
        for coordinate in &mut position {
            *coordinate = cursor.real("a coordinate")?;
        }
        if parametric {
            let dimension = cursor.int("the dimension of an entity")?;
            cursor.int("an entity tag")?;
            for _ in 0..if matches!(dimension, 1 | 2) {
                dimension
            } else {
                0
            } {
                cursor.real("a parametric coordinate")?;
            }
        }
        cursor.end_row()?;
        records.push_node(
            cursor,
            Node {
                tag,
                position,
                offset,
            },
        )?;
    }
    cursor.end_section()
}

/// Reads `$Entities` after its first line, which Gmsh writes with `Mesh.SaveTopology`, as text also in a binary file: the numbers of points,
/// curves, surfaces and volumes, and a row for each with its number, its boundary (not for a point) and its physical groups.
pub(super) fn read_entities(
    cursor: &mut Cursor<'_>,
    records: &mut Records,
) -> Result<(), GmshError> {
    let entities = cursor.as_text(entities)?;
    cursor.end_section()?;
    for ((dimension, tag), physicals) in entities {
        records.physicals.insert((dimension, -tag), physicals);
    }
    records.has_entities = true;
    Ok(())
}

/// Dimension and number of an entity, and the numbers of its groups.
type Entity = ((u8, i32), Vec<i32>);

fn entities(cursor: &mut Cursor<'_>) -> Result<Vec<Entity>, GmshError> {
    cursor.begin_row();
    let mut counts = [0; 4];
    for count in &mut counts {
        *count = cursor.size("a number of entities")?;
    }
    cursor.end_row()?;
    let mut entities = Vec::new();
    for (dimension, count) in (0u8..).zip(counts) {
        for _ in 0..count {
            cursor.begin_row();
            let tag = cursor.int("an entity tag")?.saturating_abs();
            if dimension > 0 {
                for _ in 0..cursor.size("a number of bounding entities")? {
                    cursor.int("a bounding entity")?;
                }
            }
            let mut physicals = Vec::new();
            for _ in 0..cursor.size("a number of physical tags")? {
                physicals.push(cursor.int("a physical tag")?.saturating_abs());
            }
            cursor.end_row()?;
            reserve(&mut entities, 1)?;
            entities.push(((dimension, tag), physicals));
        }
    }
    Ok(entities)
}

/// Reads `$Elements` after its first line.
pub(super) fn read_elements(
    cursor: &mut Cursor<'_>,
    records: &mut Records,
) -> Result<(), GmshError> {
    let (begin, count) = cursor.count_line("the number of elements")?;
    let smallest = if cursor.is_ascii() {
        "1 15 0 1\n".len()
    } else {
        2 * 4
    };
    cursor.check_count(begin, count, smallest, "elements")?;
    if cursor.is_ascii() {
        for _ in 0..count {
            read_row(cursor, records)?;
        }
    } else {
        let mut found = 0;
        while found < count {
            found += read_block(cursor, records)?;
        }
        if found != count {
            let place = cursor.place(begin);
            return Err(GmshError::CountMismatch {
                place,
                items: "elements",
                announced: count,
                found,
            });
        }
    }
    cursor.end_section()
}

/// Reads an element of an ASCII file.
fn read_row(cursor: &mut Cursor<'_>, records: &mut Records) -> Result<(), GmshError> {
    cursor.begin_row();
    let offset = cursor.offset();
    let tag = cursor.unsigned_int("an element number")?;
    let record = TypeRecord {
        offset: cursor.offset(),
        code: cursor.int("an element type")?,
    };
    let element_type = records.element_type(cursor, record)?;
    let tags = cursor.unsigned_int("a number of tags")?;
    read_tags_and_nodes(cursor, records, (tag, offset), element_type, tags)?;
    cursor.end_row()
}

/// Reads elements of one type from a binary file and returns their number.
fn read_block(cursor: &mut Cursor<'_>, records: &mut Records) -> Result<u64, GmshError> {
    let record = TypeRecord {
        offset: cursor.offset(),
        code: cursor.int("an element type")?,
    };
    let element_type = records.element_type(cursor, record)?;
    let count_offset = cursor.offset();
    let count = cursor.unsigned_int("a number of elements")?;
    let tags = cursor.unsigned_int("a number of tags")?;
    cursor.check_count(count_offset, count, 4 * (1 + element_type.1), "elements")?;
    for _ in 0..count {
        let offset = cursor.offset();
        let tag = cursor.unsigned_int("an element number")?;
        read_tags_and_nodes(cursor, records, (tag, offset), element_type, tags)?;
    }
    Ok(count)
}

fn read_tags_and_nodes(
    cursor: &mut Cursor<'_>,
    records: &mut Records,
    (tag, offset): (u64, usize),
    element_type: (Shape, usize),
    tags: u64,
) -> Result<(), GmshError> {
    // The first tag is the physical group: 0, or no tag, for none; negative for a reversed one. The second one is the entity.
    let (mut physical, mut entity) = (0, 0);
    for index in 0..tags {
        let value = cursor.int("a tag")?.saturating_abs();
        match index {
            0 => physical = value,
            1 => entity = value,
            _ => {}
        }
    }
    let owner = match physical {
        0 if records.has_entities => -entity,
        _ => physical,
    };
    records
        .physicals
        .entry((element_type.0.dimension(), owner))
        .or_insert_with(|| vec![physical]);
    let header = ElementHeader {
        tag,
        owner,
        offset,
        element_type,
    };
    records.push_element(cursor, header, |cursor| {
        cursor.unsigned_int("a node number")
    })
}
