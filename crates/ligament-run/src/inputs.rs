//! What decides about the results of a run: its resolved case and the content of the files that it reads.

use std::collections::HashMap;
use std::io;
use std::path::{Path, PathBuf};

use ligament_case::case::{CaseFile, Stop};
use ligament_case::input_file;
use ligament_output::summary::Identity;

/// All inputs of a run as text, which depends neither on where its files lie nor on the number of threads.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Inputs(String);

/// Keys that may be others when a run goes on: none of them changes what was computed before. Load steps that were done must
/// stay, which the driver sees to.
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

/// Contents of files by their path, each read once.
#[derive(Debug, Default)]
pub struct Contents(HashMap<PathBuf, Identity>);

impl Contents {
    /// The identity of the content of a file.
    ///
    /// # Errors
    ///
    /// If it cannot be read.
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
    /// The inputs of a case; `mesh` stands for the content of its mesh file where that is not there yet.
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
        // What cannot be written as TOML cannot be run either, and says so there.
        Ok(Self(plain.resolved_toml().unwrap_or_default()))
    }

    /// The inputs that decide about the course of a run as far as it came: all but those that [`MAY_CHANGE`].
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

    /// The text of the inputs, as a record keeps it.
    pub fn text(&self) -> &str {
        &self.0
    }

    /// The difference from the inputs of an earlier run, in a few words.
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

/// The files that a case names, with their keys.
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

/// The error of a file that cannot be read, in words for the user.
pub(crate) fn unread((path, error): (PathBuf, io::Error)) -> anyhow::Error {
    anyhow::Error::new(error).context(format!("cannot read {}", path.display()))
}

fn has(text: &str, line: &str) -> bool {
    text.lines().any(|other| other == line)
}
