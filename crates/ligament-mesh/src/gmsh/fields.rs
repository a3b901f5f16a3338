//! `$NodeData`: values at the nodes, equal in both formats.

use std::collections::BTreeMap;

use super::cursor::{Cursor, shortened_text};
use super::error::GmshError;
use super::records::{FieldRecord, Records, reserve};
use super::tags::NodeIndices;
use crate::mesh::NodeField;

/// Reads `$NodeData` after its first line: texts, real numbers and integers on a line each, also in a binary file, and a row (node, values)
/// for each node. The integers are the time step, the number of components and the number of rows.
pub(super) fn read_node_data(
    cursor: &mut Cursor<'_>,
    records: &mut Records,
) -> Result<(), GmshError> {
    let texts = tag_lines(cursor, "the number of string tags")?;
    let name = texts.first().copied().unwrap_or_default().1;
    let name = name.strip_prefix(b"\"").unwrap_or(name);
    let name = String::from_utf8_lossy(name.strip_suffix(b"\"").unwrap_or(name)).into_owned();
    tag_lines(cursor, "the number of real tags")?;
    let begin = cursor.offset();
    let integers = tag_lines(cursor, "the number of integer tags")?;
    let &[step, components, count, ..] = integers.as_slice() else {
        let expected = "the integer tags time step, number of components, number of nodes";
        return Err(cursor.unexpected_text_error(
            begin,
            expected,
            format!("{} of them", integers.len()),
        ));
    };
    let time_step = number(cursor, step, "a time step")?;
    let (components, count_offset): (u64, _) = (
        number(cursor, components, "a number of components")?,
        count.0,
    );
    let count = number(cursor, count, "a number of nodes")?;
    let smallest = if cursor.is_ascii() {
        components.saturating_mul(2).saturating_add(2)
    } else {
        components.saturating_mul(8).saturating_add(4)
    };
    let smallest = usize::try_from(smallest).unwrap_or(usize::MAX);
    cursor.check_count(count_offset, count, smallest, "values at nodes")?;
    let mut values = Vec::new();
    for _ in 0..count {
        cursor.begin_row();
        let tag = cursor.unsigned_int("a node number")?;
        for _ in 0..components {
            let value = cursor.real("a value at a node")?;
            if components == 1 {
                reserve(&mut values, 1)?;
                values.push((tag, value));
            }
        }
        cursor.end_row()?;
    }
    records.fields.push(FieldRecord {
        name,
        time_step,
        components,
        values,
    });
    cursor.end_section()
}

/// A count, and as many lines, each with its offset.
fn tag_lines<'a>(
    cursor: &mut Cursor<'a>,
    expected: &'static str,
) -> Result<Vec<(usize, &'a [u8])>, GmshError> {
    let (_, count) = cursor.count_line(expected)?;
    (0..count).map(|_| cursor.text_line()).collect()
}

fn number<T: std::str::FromStr>(
    cursor: &Cursor<'_>,
    (offset, line): (usize, &[u8]),
    expected: &'static str,
) -> Result<T, GmshError> {
    let text = std::str::from_utf8(line).ok();
    text.and_then(|text| text.parse().ok())
        .ok_or_else(|| cursor.unexpected_text_error(offset, expected, shortened_text(line)))
}

/// Fields on the nodes that are kept (`numbers`: new number of every node record); values at other nodes are left out, since a file may
/// contain only a part of the mesh of a view.
pub(super) fn on_nodes(
    records: &Records,
    by_tag: &NodeIndices,
    numbers: &[Option<u32>],
) -> Vec<NodeField> {
    let field = |record: &FieldRecord| {
        let on_node = |&(tag, value): &(u64, f64)| {
            let node = numbers[by_tag.get(tag)? as usize]?;
            Some((node, value))
        };
        let mut values: BTreeMap<u32, f64> = BTreeMap::new();
        // The last row of a node counts.
        values.extend(record.values.iter().filter_map(on_node));
        NodeField {
            name: record.name.clone(),
            time_step: record.time_step,
            components: record.components,
            values: values.into_iter().collect(),
        }
    };
    records.fields.iter().map(field).collect()
}
