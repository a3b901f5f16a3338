//! Nodes and elements of format 2.2.

use super::cursor::Cursor;
use super::element_type::Shape;
use super::error::GmshError;
use super::records::{ElementHeader, Node, Records, TypeRecord, reserve};

/// Reads `$Nodes` after its first line.
pub(super) fn read_nodes(cursor: &mut Cursor<'_>, records: &mut Records) -> Result<(), GmshError> {
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
    // The first tag is the physical group: 0, or no tag, for none; negative for a reversed one.
    let mut physical = 0;
    for index in 0..tags {
        let value = cursor.int("a tag")?;
        if index == 0 {
            physical = value.saturating_abs();
        }
    }
    records
        .physicals
        .entry((element_type.0.dimension(), physical))
        .or_insert_with(|| vec![physical]);
    let header = ElementHeader {
        tag,
        owner: physical,
        offset,
        element_type,
    };
    records.push_element(cursor, header, |cursor| {
        cursor.unsigned_int("a node number")
    })
}
