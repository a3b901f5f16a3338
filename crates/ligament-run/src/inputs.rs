//! Inputs that determine the results of a run: its resolved case and the contents of its files.

use std::collections::HashMap;
use std::io;
use std::path::{Path, PathBuf};

use ligament_case::case::{CaseFile, Stop};
use ligament_case::input_file;
use ligament_output::summary::Identity;

/// All inputs of a run as text, independent of the paths of files and of the number of threads.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Inputs(String);

/// Keys that may change when a run is resumed, because they do not change earlier results. The driver checks that completed load steps
/// stay.
pub const MAY_CHANGE: [&str; 9] = [
    "fracture.stop.load_fraction",
    "fracture.stop.displacement",
    "fracture.stop.bonds",
    "fracture.stop.wall_time",
    "fracture.steps",
    "fracture.max_iterations",
    "output.fields_every",
    "output.checkpoint_every",
    "output.picture",
];

/// Identities of the contents of files by path, each read once.
#[derive(Debug, Default)]
pub struct Contents(HashMap<PathBuf, Identity>);

impl Contents {
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
        contents: &mut Contents,
    ) -> Result<Self, (PathBuf, io::Error)> {
        let mut plain = case.clone();
        plain.case.solver.threads = None;
        let mut content = |path: &PathBuf| {
            contents
                .identity(path)
                .map(|identity| identity.to_string())
                .map_err(|error| (path.clone(), error))
        };
        if let Some(section) = &mut plain.case.mesh {
            let content = match mesh {
                Some(content) => content.to_owned(),
                None => content(&section.file)?,
            };
            section.file = content.into();
        }
        for temperature in &mut plain.case.temperatures {
            if let Some(file) = &mut temperature.file {
                *file = content(file)?.into();
            }
        }
        // A case that cannot be written as TOML fails when it is run.
        Ok(Self(plain.resolved_toml().unwrap_or_default()))
    }

    /// The inputs that determine the run up to its present state: all except [`MAY_CHANGE`].
    ///
    /// # Errors
    ///
    /// If a file cannot be read, with its path.
    pub fn of_course(
        case: &CaseFile,
        contents: &mut Contents,
    ) -> Result<Self, (PathBuf, io::Error)> {
        let mut plain = case.clone();
        plain.case.output.fields_every = None;
        plain.case.output.checkpoint_every = None;
        plain.case.output.picture = false;
        if let Some(fracture) = &mut plain.case.fracture {
            fracture.max_iterations = None;
            fracture.steps = None;
            fracture.stop = Stop {
                negative_energy: fracture.stop.negative_energy,
                ..Stop::default()
            };
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
    let mesh = case.case.mesh.iter();
    let mut found: Vec<(String, PathBuf)> = mesh
        .map(|section| ("mesh.file".to_owned(), section.file.clone()))
        .collect();
    for (number, temperature) in case.case.temperatures.iter().enumerate() {
        let file = temperature.file.iter().cloned();
        found.extend(file.map(|file| (format!("temperature.{number}.file"), file)));
    }
    found
}

/// The error of a file that cannot be read, with its path for the user.
pub(crate) fn unread((path, error): (PathBuf, io::Error)) -> anyhow::Error {
    anyhow::Error::new(error).context(format!("cannot read {}", path.display()))
}

fn has(text: &str, line: &str) -> bool {
    text.lines().any(|other| other == line)
}
