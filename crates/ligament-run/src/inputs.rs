//! Inputs that determine the results of a run: its resolved case and the contents of its files.

use std::collections::HashMap;
use std::io;
use std::path::{Path, PathBuf};

use anyhow::bail;
use ligament_analysis::driver::StopRules;
use ligament_analysis::motion::MotionStop;
use ligament_case::case::CaseFile;
use ligament_case::input_file;
use ligament_output::folder::{self, ResultFolder};
use ligament_output::summary::Identity;

/// All inputs of a run as text, independent of the paths of files and of the number of threads.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Inputs(String);

/// Keys that may change when a run is resumed, because they do not change earlier results. The driver checks that completed load steps
/// stay.
pub const CHANGEABLE_KEYS: [&str; 12] = [
    "fracture.stop.load_fraction",
    "fracture.stop.displacement",
    "fracture.stop.bonds",
    "fracture.stop.wall_time",
    "fracture.steps",
    "fracture.max_iterations",
    "motion.stop.bonds",
    "motion.stop.wall_time",
    "output.fields_every",
    "output.during_breakage",
    "output.checkpoint_every",
    "output.picture",
];

/// Key of the places of a refinement, which a result folder has in a copy.
const PLACES: &str = "refine.places";

/// Identities of the contents of files by path, each read once.
#[derive(Debug, Default)]
pub struct FileIdentities(HashMap<PathBuf, Identity>);

impl FileIdentities {
    /// The identity of the content of a file.
    ///
    /// # Errors
    ///
    /// If the file cannot be read.
    pub fn identity(&mut self, path: &Path) -> io::Result<Identity> {
        if let Some(known) = self.0.get(path) {
            return Ok(known.clone());
        }
        let content = Identity::new(&input_file::read(path)?);
        self.0.insert(path.to_owned(), content.clone());
        Ok(content)
    }
}

impl Inputs {
    /// The inputs of a case; `mesh`, if given, replaces the content of a mesh file that does not exist yet.
    ///
    /// # Errors
    ///
    /// If a file cannot be read, with its path.
    pub fn from_case(
        case: &CaseFile,
        mesh: Option<&str>,
        contents: &mut FileIdentities,
    ) -> Result<Self, (PathBuf, io::Error)> {
        let mut plain = case.clone();
        plain.case.solver.threads = None;
        for (key, file) in paths(&mut plain) {
            *file = match mesh.filter(|_| key == "mesh.file") {
                Some(content) => content.into(),
                None => {
                    let identity = contents.identity(file);
                    let identity = identity.map_err(|error| (file.clone(), error))?;
                    identity.to_string().into()
                }
            };
        }
        // A case that cannot be written as TOML fails when it is run.
        Ok(Self(plain.resolved_toml().unwrap_or_default()))
    }

    /// The inputs that determine the run up to its present state: all except [`CHANGEABLE_KEYS`].
    ///
    /// # Errors
    ///
    /// If a file cannot be read, with its path.
    pub fn determining_inputs(
        case: &CaseFile,
        contents: &mut FileIdentities,
    ) -> Result<Self, (PathBuf, io::Error)> {
        let mut plain = case.clone();
        plain.case.output.fields_every = None;
        plain.case.output.during_breakage = 0;
        plain.case.output.checkpoint_every = None;
        plain.case.output.picture = false;
        if let Some(fracture) = &mut plain.case.fracture {
            fracture.max_iterations = None;
            fracture.steps = None;
            fracture.stop = StopRules {
                negative_energy: fracture.stop.negative_energy,
                ..StopRules::NONE
            };
        }
        if let Some(motion) = &mut plain.case.motion {
            motion.stop = MotionStop::default();
        }
        Self::from_case(&plain, None, contents)
    }

    /// The text of the inputs for a record.
    pub fn text(&self) -> &str {
        &self.0
    }

    /// Short description of the difference from the inputs of an earlier run.
    pub fn difference(&self, earlier: &str) -> String {
        let added: Vec<&str> = self.0.lines().filter(|line| !has(earlier, line)).collect();
        let gone = earlier.lines().filter(|line| !has(&self.0, line)).count();
        match added.as_slice() {
            [] => format!("{gone} lines of the case are gone"),
            [one] => format!("now {one}"),
            [first, rest @ ..] => format!("now {first}, and {} more", rest.len()),
        }
    }
}

/// The files of a case, with their keys.
pub fn files(case: &CaseFile) -> Vec<(String, PathBuf)> {
    let mut case = case.clone();
    let paths = paths(&mut case).into_iter();
    paths.map(|(key, file)| (key, file.clone())).collect()
}

/// The paths of the files of a case, with their keys.
fn paths(case: &mut CaseFile) -> Vec<(String, &mut PathBuf)> {
    let case = &mut case.case;
    let mesh = case.mesh.iter_mut();
    let mut found: Vec<(String, &mut PathBuf)> = mesh
        .map(|section| ("mesh.file".to_owned(), &mut section.file))
        .collect();
    let places = (case.refine.iter_mut()).filter_map(|it| it.places.as_mut());
    found.extend(places.map(|file| (PLACES.to_owned(), file)));
    for (number, temperature) in case.temperatures.iter_mut().enumerate() {
        let file = temperature.file.iter_mut();
        found.extend(file.map(|file| (format!("temperature.{number}.file"), file)));
    }
    for (number, load) in case.loads.iter_mut().enumerate() {
        let file = (load.profile.iter_mut()).filter_map(|profile| profile.file.as_mut());
        found.extend(file.map(|file| (format!("load.{number}.profile.file"), file)));
        let file = (load.amplitude.iter_mut()).filter_map(|it| it.file.as_mut());
        found.extend(file.map(|file| (format!("load.{number}.amplitude.file"), file)));
    }
    found
}

/// Sets the place of the mesh of a case, if given.
///
/// # Errors
///
/// If the body is no mesh, or the place has no absolute path.
pub(crate) fn set_mesh(case: &mut CaseFile, mesh: Option<&Path>) -> anyhow::Result<()> {
    let Some(mesh) = mesh else {
        return Ok(());
    };
    let Some(section) = &mut case.case.mesh else {
        bail!("--mesh: the body of the run is no mesh");
    };
    section.file = std::path::absolute(mesh)?;
    Ok(())
}

/// Finds files of a case that are missing at their earlier paths because they were moved together with the results: an ending of the
/// earlier path leads to the file from the results or from a folder above them, and the content is one that the run read.
pub(crate) fn find_moved_files(
    case: &mut CaseFile,
    folder: &Path,
    was_read: &dyn Fn(&Identity) -> bool,
) {
    let Ok(folder) = folder.canonicalize() else {
        return;
    };
    for (_, file) in paths(case) {
        let names: Vec<_> = file.iter().collect();
        let ends = (0..names.len()).map(|from| names[from..].iter().collect::<PathBuf>());
        let ends: Vec<PathBuf> = ends.filter(|it| it.is_relative()).collect();
        let above = folder.ancestors();
        let mut places = above.flat_map(|above| ends.iter().map(|end| above.join(end)));
        let has_content = |place: &PathBuf| {
            let content = place.is_file().then(|| input_file::read(place));
            content.is_some_and(|it| it.is_ok_and(|bytes| was_read(&Identity::new(&bytes))))
        };
        if !file.exists()
            && let Some(place) = places.find(has_content)
        {
            *file = place;
        }
    }
}

/// Copies the files of a case into a result folder, all of them or the places of a refinement alone, which the next results replace; returns the case
/// with the copies.
///
/// # Errors
///
/// If a file cannot be read or written.
pub(crate) fn copy_files(
    case: &CaseFile,
    folder: &ResultFolder,
    all: bool,
) -> anyhow::Result<CaseFile> {
    let mut kept = case.clone();
    let copied = |it: &(String, &mut PathBuf)| all || it.0 == PLACES;
    for (key, file) in paths(&mut kept).into_iter().filter(copied) {
        let name = folder::input_name(&key, file);
        let bytes =
            input_file::read(file).map_err(|error| unreadable_file((file.clone(), error)))?;
        folder.write(&name, &bytes)?;
        *file = folder.file(&name);
    }
    Ok(kept)
}

/// The case as a result folder records it: files in the folder are named without their path, so that the folder can be moved.
pub(crate) fn recorded_case(case: &CaseFile, folder: &Path) -> CaseFile {
    let mut recorded = case.clone();
    let whole = folder.canonicalize();
    let is_here = |parent: &Path| {
        parent == folder || parent.canonicalize().ok().as_ref() == whole.as_ref().ok()
    };
    for (_, file) in paths(&mut recorded) {
        if file.parent().is_some_and(is_here)
            && let Some(name) = file.file_name()
        {
            *file = name.into();
        }
    }
    recorded
}

/// Whether a result folder has copies of the files that its case reads, beside the places of a refinement.
pub(crate) fn are_kept(case: &CaseFile, folder: &Path) -> bool {
    let files = files(&recorded_case(case, folder));
    let mut files = files.iter().filter(|(key, _)| key != PLACES);
    files.any(|(_, file)| file.is_relative())
}

/// The error of a file that cannot be read, with its path for the user.
pub fn unreadable_file((path, error): (PathBuf, io::Error)) -> anyhow::Error {
    anyhow::Error::new(error).context(format!("cannot read {}", path.display()))
}

fn has(text: &str, line: &str) -> bool {
    text.lines().any(|other| other == line)
}
