//! The outputs in a result folder, of a run that has ended or not.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use ligament_model::Absence;

use super::model_file::model_file;
use super::stored_state::StoredState;
use crate::atomic::remove_file;
use crate::folder::{Kind, RESOLVED_CASE, ResultFolder, refuse_links};
use crate::vtu;
use crate::vtu::read::VtuFile;
use crate::{Error, FieldLocation};

/// Kind of the outputs in a folder.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OutputKind {
    /// States of a body at load steps or events: `fields_NNNN.vtu`.
    Steps,
    /// Natural modes: `mode_NNNN.vtu`.
    Modes,
}

/// The outputs in a folder.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Outputs {
    /// Folder that holds the outputs.
    pub folder: PathBuf,
    /// The kind of all outputs in the folder.
    pub kind: OutputKind,
    /// Files of the outputs by the state of the run or the number of the mode; one or more.
    pub files: BTreeMap<StoredState, PathBuf>,
}

impl Outputs {
    /// Lists the outputs of a run.
    ///
    /// # Errors
    ///
    /// If the folder has no results, or no fields, or cannot be listed.
    pub fn list(folder: &Path) -> Result<Self, Error> {
        require_results(folder)?;
        let kind = kind_of(folder);
        let files = numbered_files(folder, kind.stem())?;
        if files.is_empty() {
            let stem = kind.stem();
            return Err(Error::NoResults {
                path: folder.to_path_buf(),
                reason: format!(
                    "it has no {stem}_NNNN.vtu: the run stopped before its first output, or the files were removed"
                ),
            });
        }
        Ok(Self {
            folder: folder.to_path_buf(),
            kind,
            files,
        })
    }

    /// The stored states, or modes, ascending.
    pub fn states(&self) -> Vec<StoredState> {
        self.files.keys().copied().collect()
    }
}

impl OutputKind {
    fn stem(self) -> &'static str {
        match self {
            Self::Steps => "fields",
            Self::Modes => "mode",
        }
    }
}

/// The kind of the results in a folder.
pub fn kind_of(folder: &Path) -> OutputKind {
    if folder.join("modes.csv").is_file() {
        OutputKind::Modes
    } else {
        OutputKind::Steps
    }
}

/// Refuses a folder without results of a run, or with links in the place of result files.
///
/// # Errors
///
/// If the folder has no results, or a link in the place of a result file.
pub fn require_results(folder: &Path) -> Result<(), Error> {
    let reason = if !folder.exists() {
        "there is no such folder".to_owned()
    } else if folder.is_file() {
        "it is a file; name the folder that `ligament run` wrote its results to".to_owned()
    } else if !folder.join(RESOLVED_CASE).is_file() {
        format!(
            "it has no {RESOLVED_CASE}; name the folder that `ligament run` wrote its results to"
        )
    } else {
        return refuse_links(folder, Kind::RUN);
    };
    Err(Error::NoResults {
        path: folder.to_path_buf(),
        reason,
    })
}

/// The pairs of points that a pre-crack separates, by the tags of their ends; `None` where the run wrote no model.
///
/// # Errors
///
/// If the model cannot be used.
pub fn cut_pairs(folder: &Path) -> Result<Option<Vec<[i64; 2]>>, Error> {
    let Some(path) = model_file(folder) else {
        return Ok(None);
    };
    let file = VtuFile::open(path)?;
    let absent = file.required_integers(FieldLocation::Cell, "absent")?;
    let is_cut = |number: &i64| Absence::from_number(*number) == Some(Absence::PreCrack);
    if !absent.iter().any(is_cut) {
        return Ok(Some(Vec::new()));
    }
    let (_, tags) = file.tags(FieldLocation::Point)?;
    let pairs = file.lines()?.into_iter().zip(&absent);
    let cut = pairs.filter(|(_, absent)| is_cut(absent));
    let tagged = cut.map(|(ends, _)| ends.map(|point| tags[point as usize]));
    Ok(Some(tagged.collect()))
}

/// The pairs of points with a bond before the first load, by the tags of their ends; `None` where the run wrote no model.
///
/// # Errors
///
/// If the model cannot be used.
pub fn bonded_pairs(folder: &Path) -> Result<Option<Vec<[i64; 2]>>, Error> {
    let Some(path) = model_file(folder) else {
        return Ok(None);
    };
    let file = VtuFile::open(path)?;
    let absent = file.required_integers(FieldLocation::Cell, "absent")?;
    let (_, tags) = file.tags(FieldLocation::Point)?;
    let pairs = file.lines()?.into_iter().zip(absent);
    let bonds = pairs.filter(|(_, absent)| *absent == 0);
    let tagged = bonds.map(|(ends, _)| ends.map(|point| tags[point as usize]));
    Ok(Some(tagged.collect()))
}

/// Removes the field files of a run that starts again in its folder.
///
/// # Errors
///
/// If the files cannot be removed.
pub fn clear(folder: &ResultFolder) -> Result<(), Error> {
    for stem in ["fields", "bonds"] {
        remove_others(folder, stem, &[])?;
        folder.remove(&format!("{stem}.pvd"))?;
    }
    Ok(())
}

/// Removes the grid files `STEM_NNNN`, including pieces, that are not among the outputs.
pub(super) fn remove_others(
    folder: &ResultFolder,
    stem: &str,
    outputs: &[(f64, String)],
) -> Result<(), Error> {
    let kept: Vec<&str> = outputs
        .iter()
        .filter_map(|(_, name)| vtu::stem(name))
        .collect();
    for (_, path) in grids(folder.path(), stem)? {
        let name = path.file_name().and_then(|name| name.to_str());
        if !name
            .and_then(vtu::stem)
            .is_some_and(|stem| kept.contains(&stem))
        {
            remove_file(&path)?;
        }
    }
    Ok(())
}

/// The files `STEM_NNNN.vtu`, or in pieces `STEM_NNNN.pvtu`, by their states.
pub(super) fn numbered_files(
    folder: &Path,
    stem: &str,
) -> Result<BTreeMap<StoredState, PathBuf>, Error> {
    let is_piece = |path: &Path| {
        path.file_stem()
            .is_some_and(|it| Path::new(it).extension().is_some())
    };
    let files = grids(folder, stem)?.into_iter();
    Ok(files.filter(|(_, path)| !is_piece(path)).collect())
}

/// The grid files `STEM_NNNN`, including pieces, with their states.
fn grids(folder: &Path, stem: &str) -> Result<Vec<(StoredState, PathBuf)>, Error> {
    let failed = Error::system("list", folder);
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).map_err(&failed)? {
        let path = entry.map_err(&failed)?.path();
        let name = path.file_name().and_then(|name| name.to_str());
        let state = name.and_then(|name| StoredState::of_file(name, stem));
        files.extend(state.map(|state| (state, path)));
    }
    Ok(files)
}
