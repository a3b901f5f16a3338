//! Origin of results, so that a run can be repeated, and the time that they took.

use std::fmt;
use std::path::PathBuf;

use serde::{Deserialize, Serialize};

use super::Text;

/// A build of the program; what is not known of it is left out.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Build {
    /// The commit that it was built from, by its digest.
    pub commit: Option<Text>,
    /// Whether sources differed from the commit.
    pub uncommitted_changes: Option<bool>,
    /// `release` or `debug`.
    pub profile: Option<Text>,
    /// The kind of system and processor that it was built for.
    pub target: Option<Text>,
    /// Name and version of the compiler.
    pub compiler: Option<Text>,
}

/// The record of what results came from.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Provenance {
    /// The program.
    #[serde(flatten)]
    pub build: Build,
    /// Name of the processor, where the system tells (Linux).
    pub processor: Option<String>,
    /// The widest vector instructions that the processor has of those that kernels are chosen by when the program starts.
    #[serde(default)]
    pub vector_instructions: Option<Text>,
    /// Whether the run was stopped in between; what came before may be from another build or processor.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
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

/// The identity of the content of a file.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Identity {
    /// Size, bytes.
    pub bytes: u64,
    /// XXH64 digest of all bytes, 16 hexadecimal digits.
    pub xxh64: String,
}

impl Identity {
    /// The identity of some bytes.
    pub fn new(bytes: &[u8]) -> Self {
        Self {
            bytes: bytes.len() as u64,
            xxh64: format!("{:016x}", twox_hash::XxHash64::oneshot(0, bytes)),
        }
    }
}

impl fmt::Display for Identity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} bytes, xxh64 {}", self.bytes, self.xxh64)
    }
}

/// A stage of a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Stage {
    /// Name of the stage.
    pub name: Text,
    /// Wall time, s.
    pub seconds: f64,
    /// Peak memory of the process up to its end, bytes; not known on every system.
    pub peak_bytes: Option<u64>,
}
