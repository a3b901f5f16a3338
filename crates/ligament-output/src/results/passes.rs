//! `passes.csv`: one row for each pass of a refinement.

use std::fs;
use std::path::Path;

use ligament_analysis::refinement_pass::{LastPass, PassRecord};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::Error;
use crate::folder::ResultFolder;
use crate::quantity::quantity;

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

/// Passes of a refinement, from the first one to the one of the results.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default)]
pub struct RefinementSummary {
    /// Records of the passes.
    pub passes: Vec<PassRecord>,
    /// Reason why no other pass follows; none where one follows, or where the pass was stopped.
    pub last: Option<LastPass>,
}

impl RefinementSummary {
    /// Names and texts of the passes and of the end, for the user; `force` is the unit of the peak.
    pub fn rows(&self, force: &str) -> Vec<(String, String)> {
        let passes = self
            .passes
            .iter()
            .map(|pass| (format!("pass {}", pass.pass), words(pass, force)));
        let last = self
            .last
            .map(|it| ("no other pass".to_owned(), it.words().to_owned()));
        passes.chain(last).collect()
    }
}

/// Size, numbers and results of a pass, with their changes since the pass before.
fn words(pass: &PassRecord, force: &str) -> String {
    let with_change = |value: String, change: Option<f64>| match change {
        Some(change) => format!("{value} ({:+.2} %)", 100.0 * change),
        None => value,
    };
    let peak = with_change(quantity(pass.peak, force), pass.peak_change);
    let work = with_change(quantity(pass.work, "J"), pass.work_change);
    let mut words = format!(
        "size {}, {} points, {} bonds; peak {peak}, work {work}",
        quantity(pass.size, "m"),
        pass.points,
        pass.bonds
    );
    if let Some(path) = pass.path_change {
        words += &format!(", path within {}", quantity(path, "m"));
    }
    if let Some(inside) = pass.inside {
        words += &format!(
            ", {:.0} % of the open bonds in the fine part",
            100.0 * inside
        );
    }
    words + &format!(", energy ratio {:.3}", pass.energy_ratio)
}
