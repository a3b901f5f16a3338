//! `passes.csv`: one row for each pass of a refinement.

use std::fs;
use std::path::Path;

use ligament_analysis::refinement_pass::PassRecord;

use crate::Error;
use crate::folder::ResultFolder;

/// Name of the file.
pub const PASSES_FILE: &str = "passes.csv";

/// Name of the file of the places that the passes found, around which the next pass is fine.
pub const PLACES_FILE: &str = "places.csv";

/// Name of the file of the refined mesh.
pub const MESH_FILE: &str = "mesh.msh";

/// Writes the records of the passes into a folder.
///
/// # Errors
///
/// If the file cannot be written.
pub fn write_passes(folder: &ResultFolder, passes: &[PassRecord]) -> Result<(), Error> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let path = folder.file(PASSES_FILE);
    for pass in passes {
        let written = writer.serialize(pass);
        written.map_err(|it| Error::system("write", &path)(it.into()))?;
    }
    let bytes = writer.into_inner().map_err(|it| it.into_error());
    folder.write(PASSES_FILE, bytes.map_err(Error::system("write", &path))?)
}

/// Reads the records of the passes before a pass from a folder; none where it has no such file.
///
/// # Errors
///
/// If the file cannot be read, or is no table of passes.
pub fn read_passes(folder: &Path, before: u32) -> Result<Vec<PassRecord>, Error> {
    let path = folder.join(PASSES_FILE);
    if !path.is_file() {
        return Ok(Vec::new());
    }
    let text = fs::read(&path).map_err(Error::system("read", &path))?;
    let mut reader = csv::Reader::from_reader(text.as_slice());
    let all: Result<Vec<PassRecord>, csv::Error> = reader.deserialize().collect();
    let mut all = all.map_err(|it| Error::system("read", &path)(it.into()))?;
    all.retain(|it| it.pass < before);
    Ok(all)
}
