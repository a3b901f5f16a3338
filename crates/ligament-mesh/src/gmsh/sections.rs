//! Reading the sections of a file in order.

use std::collections::BTreeSet;

use super::cursor::{Cursor, shortened_text};
use super::error::GmshError;
use super::neper::{self, NeperSets};
use super::records::Records;
use super::{fields, v2, v4};

/// Versions of the format that are read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Version {
    /// 2.0, 2.1 and 2.2, which differ in the tags of elements behind the first two, and in the names of groups.
    V2,
    V4,
}

/// Sections without nodes, cells, groups or values: those of Gmsh, and those of the program Neper on how it made the mesh.
const WITHOUT_EFFECT: [&str; 8] = [
    "Comments",
    "Domain",
    "GhostElements",
    "InterpolationScheme",
    "MeshVersion",
    "NodePartitions",
    "Parametrizations",
    "Topology",
];

/// Reads all sections of a file.
pub(super) fn read(cursor: &mut Cursor<'_>) -> Result<Records, GmshError> {
    let version = read_format(cursor)?;
    let mut records = Records {
        repeats_cells: version == Version::V2,
        ..Records::default()
    };
    let mut sets = NeperSets::default();
    let (mut nodes, mut elements) = (false, false);
    while let Some(name) = cursor.begin_section()? {
        read_section(cursor, (&mut records, &mut sets), name, version)?;
        nodes |= name == "Nodes" || (name == "ParametricNodes" && version == Version::V2);
        elements |= name == "Elements";
    }
    match (nodes, elements) {
        (true, true) => {}
        (false, _) => return Err(GmshError::MissingSection { name: "Nodes" }),
        (true, false) => return Err(GmshError::MissingSection { name: "Elements" }),
    }
    name_in_dimensions(&mut records);
    neper::add_groups(cursor, &mut records, sets)?;
    Ok(records)
}

/// Reads a section of a given name after its first line.
fn read_section(
    cursor: &mut Cursor<'_>,
    (records, sets): (&mut Records, &mut NeperSets),
    name: &str,
    version: Version,
) -> Result<(), GmshError> {
    match (name, version) {
        ("PhysicalNames", _) => read_physical_names(cursor, records),
        ("Entities", Version::V2) => read_or_skip(cursor, records, v2::read_entities),
        ("Entities", Version::V4) => v4::read_entities(cursor, records, false),
        ("PartitionedEntities", Version::V4) => v4::read_entities(cursor, records, true),
        ("Nodes", Version::V2) => v2::read_nodes(cursor, records, false),
        ("ParametricNodes", Version::V2) => v2::read_nodes(cursor, records, true),
        ("Nodes", Version::V4) => v4::read_nodes(cursor, records),
        ("Elements", Version::V2) => v2::read_elements(cursor, records),
        ("Elements", Version::V4) => v4::read_elements(cursor, records),
        ("NodeData", _) => fields::read_node_data(cursor, records),
        ("NSets", _) => read_or_skip(cursor, records, |cursor, _| sets.read_nodes(cursor)),
        ("Fasets", _) => read_or_skip(cursor, records, |cursor, _| sets.read_faces(cursor)),
        ("Groups", _) => read_or_skip(cursor, records, |cursor, _| sets.read_groups(cursor)),
        _ => skip(cursor, records),
    }
}

/// Skips the current section, which is not used.
fn skip(cursor: &mut Cursor<'_>, records: &mut Records) -> Result<(), GmshError> {
    let (name, offset) = cursor.section();
    if !WITHOUT_EFFECT.contains(&name) {
        records.ignored.push((name, offset));
    }
    cursor.skip_section()
}

/// Reads the current section, or skips it where it does not have the expected form: another program may use its name otherwise.
fn read_or_skip(
    cursor: &mut Cursor<'_>,
    records: &mut Records,
    read: impl FnOnce(&mut Cursor<'_>, &mut Records) -> Result<(), GmshError>,
) -> Result<(), GmshError> {
    let begin = cursor.offset();
    if read(cursor, records).is_err() {
        cursor.rewind(begin);
        return skip(cursor, records);
    }
    Ok(())
}

/// Gives the names of groups without a dimension to the groups of all dimensions with their numbers; a group without elements has the
/// dimension of the body.
fn name_in_dimensions(records: &mut Records) {
    let numbers = records.physicals.iter();
    let used = numbers.flat_map(|((dimension, _), it)| it.iter().map(|it| (*dimension, *it)));
    let used: BTreeSet<(u8, i32)> = used.collect();
    let of_body = if records.first_solid.is_some() { 3 } else { 2 };
    for (number, name) in std::mem::take(&mut records.names_of_any) {
        let mut dimensions: Vec<u8> = (0..=3).filter(|it| used.contains(&(*it, number))).collect();
        if dimensions.is_empty() {
            dimensions.push(of_body);
        }
        for dimension in dimensions {
            records.names.insert((dimension, number), name.clone());
        }
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
    let version = if [2.0, 2.1, 2.2].contains(&number) {
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
    cursor.check_count(begin, count, "1 \"\"\n".len(), "physical names")?;
    for _ in 0..count {
        let (begin, line) = cursor.text_line()?;
        let named = physical_name(line).ok_or_else(|| {
            cursor.unexpected_text_error(
                begin,
                "a dimension, a number and a name in quotes",
                shortened_text(line),
            )
        })?;
        match named {
            (_, _, name) if name.is_empty() => {}
            (Some(dimension), number, name) => {
                records.names.insert((dimension, number), name);
            }
            (None, number, name) => records.names_of_any.push((number, name)),
        }
    }
    cursor.end_section()
}

/// Dimension, number and name from a line of `$PhysicalNames`. Format 2.0 has no dimension, and the program Neper no quotes.
fn physical_name(line: &[u8]) -> Option<(Option<u8>, i32, String)> {
    let text = String::from_utf8_lossy(line);
    let (numbers, name) = match text.split_once('"') {
        Some((numbers, quoted)) => (numbers.trim_ascii_end(), quoted.strip_suffix('"')?),
        None => text.rsplit_once(|it: char| it.is_ascii_whitespace())?,
    };
    let is_quoted = text.contains('"');
    let numbers: Vec<&str> = numbers.split_ascii_whitespace().collect();
    let (dimension, number) = match *numbers.as_slice() {
        [number] if is_quoted => (None, number),
        [dimension, number] => (Some(dimension.parse().ok().filter(|it| *it <= 3)?), number),
        _ => return None,
    };
    let number = number.parse::<i32>().ok()?.saturating_abs();
    Some((dimension, number, name.to_owned()))
}
