//! What results came from: the program, the processor and the files that it read, so that a run can be repeated.

use std::fs;
use std::io;
use std::path::PathBuf;

use ligament_case::case::CaseFile;
use ligament_output::folder::RESOLVED_CASE;
use serde::{Deserialize, Serialize};

use crate::inputs::{Contents, Identity, files};

/// A build of the program; what is not known of it is left out.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
pub struct Build {
    /// The commit that it was built from, by its digest.
    pub commit: Option<&'static str>,
    /// Whether sources differed from the commit.
    pub uncommitted_changes: Option<bool>,
    /// `release` or `debug`.
    pub profile: Option<&'static str>,
    /// The kind of system and processor that it was built for.
    pub target: Option<&'static str>,
    /// Name and version of the compiler.
    pub compiler: Option<&'static str>,
}

/// The record of what results came from.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Provenance {
    /// The program.
    #[serde(flatten)]
    pub build: Build,
    /// Name of the processor, where the system tells (Linux).
    pub processor: Option<String>,
    /// The widest vector instructions that the processor has of those that kernels are chosen by when the program starts.
    pub vector_instructions: &'static str,
    /// Whether the run was stopped in between; what came before may be from another build or processor.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub resumed: bool,
    /// The case with all defaults, and the files that it names.
    pub inputs: Vec<Input>,
}

/// A file that a run read.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Input {
    /// The key of the case that names it; none for the case itself.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub key: Option<String>,
    /// The path; the case lies in the folder of the results.
    pub file: PathBuf,
    /// What the file held.
    #[serde(flatten)]
    pub content: Identity,
}

impl Provenance {
    /// The provenance of a run of a case that a build does now.
    ///
    /// # Errors
    ///
    /// If a file cannot be read, with its path.
    pub fn new(
        build: Build,
        case: &CaseFile,
        contents: &mut Contents,
    ) -> Result<Self, (PathBuf, io::Error)> {
        // What cannot be written as TOML cannot be run either, and says so there.
        let resolved = case.resolved_toml().unwrap_or_default();
        let mut inputs = vec![Input {
            key: None,
            file: RESOLVED_CASE.into(),
            content: Identity::new(resolved.as_bytes()),
        }];
        for (key, file) in files(case) {
            let content = contents.identity(&file);
            let content = content.map_err(|error| (file.clone(), error))?;
            let key = Some(key);
            inputs.push(Input { key, file, content });
        }
        Ok(Self::of_inputs(build, inputs))
    }

    /// The provenance of a run that read no files, or whose files are not looked at again.
    pub fn of_inputs(build: Build, inputs: Vec<Input>) -> Self {
        Self {
            build,
            processor: processor(),
            vector_instructions: vector_instructions(),
            resumed: false,
            inputs,
        }
    }
}

/// Name of the processor, where the system tells (Linux).
fn processor() -> Option<String> {
    let told = fs::read_to_string("/proc/cpuinfo").ok()?;
    let line = told.lines().find(|line| line.starts_with("model name"))?;
    Some(line.split_once(':')?.1.trim().to_owned())
}

/// The widest vector instructions that matter here: the dense kernels of the solver ask for these.
#[cfg(target_arch = "x86_64")]
fn vector_instructions() -> &'static str {
    if std::is_x86_feature_detected!("avx512f") {
        "avx512f"
    } else if std::is_x86_feature_detected!("avx2") && std::is_x86_feature_detected!("fma") {
        "avx2"
    } else {
        "sse2"
    }
}

/// Kernels for other processors are chosen when the program is built.
#[cfg(not(target_arch = "x86_64"))]
fn vector_instructions() -> &'static str {
    std::env::consts::ARCH
}
