//! Kind of mesh in a file, without reading the whole file.

use super::cursor::Cursor;
use super::error::GmshError;
use super::records::Records;
use super::sections::{Version, read_format};
use super::{v2, v4};

/// Whether a Gmsh mesh file that begins with these bytes contains volumes, i.e. a solid mesh; files of 4.1 are judged by their entities.
/// `None` where the bytes end before this is known, or cannot be read.
pub fn holds_solid(bytes: &[u8]) -> Option<bool> {
    of_sections(&mut Cursor::new(bytes)).ok().flatten()
}

fn of_sections(cursor: &mut Cursor<'_>) -> Result<Option<bool>, GmshError> {
    let version = read_format(cursor)?;
    let mut records = Records::default();
    while let Some(name) = cursor.begin_section()? {
        match (name, version) {
            ("Entities", Version::V4) => {
                cursor.begin_row();
                let mut count = || cursor.size("a number of entities");
                let [_, _, _, volumes] = [count()?, count()?, count()?, count()?];
                return Ok(Some(volumes > 0));
            }
            ("Elements", Version::V2) => v2::read_elements(cursor, &mut records)?,
            ("Elements", Version::V4) => v4::read_elements(cursor, &mut records)?,
            _ => {
                cursor.skip_section()?;
                continue;
            }
        }
        return Ok(Some(records.first_solid.is_some()));
    }
    Ok(None)
}
