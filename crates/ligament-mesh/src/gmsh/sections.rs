//! Reading the sections of a file in order.

use super::cursor::{Cursor, shortened_text};
use super::error::GmshError;
use super::records::Records;
use super::{fields, v2, v4};

/// Versions of the format that are read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Version {
    V2,
    V4,
}

/// Sections without nodes, cells, groups or values at nodes.
const SKIPPED: [&str; 7] = [
    "Comments",
    "ElementData",
    "ElementNodeData",
    "GhostElements",
    "InterpolationScheme",
    "Parametrizations",
    "Periodic",
];

/// Reads all sections of a file.
pub(super) fn read(cursor: &mut Cursor<'_>) -> Result<Records, GmshError> {
    let version = read_format(cursor)?;
    let mut records = Records {
        repeats_cells: version == Version::V2,
        ..Records::default()
    };
    let (mut nodes, mut elements) = (false, false);
    while let Some(name) = cursor.begin_section()? {
        match (name, version) {
            ("PhysicalNames", _) => read_physical_names(cursor, &mut records)?,
            ("Entities", Version::V4) => v4::read_entities(cursor, &mut records, false)?,
            ("PartitionedEntities", Version::V4) => v4::read_entities(cursor, &mut records, true)?,
            ("Nodes", Version::V2) => v2::read_nodes(cursor, &mut records)?,
            ("Nodes", Version::V4) => v4::read_nodes(cursor, &mut records)?,
            ("Elements", Version::V2) => v2::read_elements(cursor, &mut records)?,
            ("Elements", Version::V4) => v4::read_elements(cursor, &mut records)?,
            ("NodeData", _) => fields::read_node_data(cursor, &mut records)?,
            _ if SKIPPED.contains(&name) => cursor.skip_section()?,
            _ => return Err(cursor.unknown_section()),
        }
        nodes |= name == "Nodes";
        elements |= name == "Elements";
    }
    match (nodes, elements) {
        (true, true) => Ok(records),
        (false, _) => Err(GmshError::MissingSection { name: "Nodes" }),
        (true, false) => Err(GmshError::MissingSection { name: "Elements" }),
    }
}

/// Reads `$MeshFormat`: the version, and the encoding of numbers.
pub(super) fn read_format(cursor: &mut Cursor<'_>) -> Result<Version, GmshError> {
    loop {
        match cursor.begin_section() {
            Ok(Some("MeshFormat")) => break,
            Ok(Some("Comments")) => cursor.skip_section()?,
            // Format 1 has no section for the format.
            Ok(Some("NOD")) => {
                let place = cursor.place(0);
                return Err(GmshError::UnsupportedVersion {
                    place,
                    version: "1".to_owned(),
                });
            }
            Ok(None) => return Err(GmshError::Empty),
            _ => return Err(GmshError::NotGmsh),
        }
    }
    cursor.begin_row();
    let begin = cursor.offset();
    let number = cursor.real("a format version")?;
    let version = if number == 2.2 {
        Version::V2
    } else if number == 4.1 {
        Version::V4
    } else {
        let place = cursor.place(begin);
        return Err(GmshError::UnsupportedVersion {
            place,
            version: number.to_string(),
        });
    };
    read_encoding(cursor)?;
    cursor.end_section()?;
    Ok(version)
}

/// Reads whether the file is binary, and its byte order.
fn read_encoding(cursor: &mut Cursor<'_>) -> Result<(), GmshError> {
    const FILE_TYPE: &str = "the file type 0 (ASCII) or 1 (binary)";
    let begin = cursor.offset();
    let file_type = cursor.int(FILE_TYPE)?;
    let size_offset = cursor.offset();
    let data_size = cursor.size("a data size")?;
    cursor.end_row()?;
    match file_type {
        0 => return Ok(()),
        1 => {}
        _ => return Err(cursor.unexpected_text_error(begin, FILE_TYPE, file_type.to_string())),
    }
    if data_size != 8 {
        let place = cursor.place(size_offset);
        return Err(GmshError::UnsupportedDataSize {
            place,
            bytes: data_size,
        });
    }
    cursor.begin_binary()
}

/// Reads `$PhysicalNames` after its first line: text in every file.
fn read_physical_names(cursor: &mut Cursor<'_>, records: &mut Records) -> Result<(), GmshError> {
    let (begin, count) = cursor.count_line("the number of physical names")?;
    cursor.check_count(begin, count, "0 1 \"\"\n".len(), "physical names")?;
    for _ in 0..count {
        let (begin, line) = cursor.text_line()?;
        let (key, name) = physical_name(line).ok_or_else(|| {
            cursor.unexpected_text_error(
                begin,
                "a dimension, a number and a name in quotes",
                shortened_text(line),
            )
        })?;
        if !name.is_empty() {
            records.names.insert(key, name);
        }
    }
    cursor.end_section()
}

/// Dimension, number and name from a line of `$PhysicalNames`.
fn physical_name(line: &[u8]) -> Option<((u8, i32), String)> {
    let text = String::from_utf8_lossy(line);
    let (numbers, quoted) = text.split_once('"')?;
    let name = quoted.strip_suffix('"')?;
    let mut numbers = numbers.split_ascii_whitespace();
    let dimension = numbers
        .next()?
        .parse()
        .ok()
        .filter(|dimension| *dimension <= 3)?;
    let number = numbers.next()?.parse::<i32>().ok()?.saturating_abs();
    numbers
        .next()
        .is_none()
        .then(|| ((dimension, number), name.to_owned()))
}
