//! Origin of results, for repeating a run, and the times of its stages.

use std::fmt;
use std::path::PathBuf;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::values::Text;

/// A build of the program; unknown properties are left out.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Build {
    /// Digest of the commit.
    pub commit: Option<Text>,
    /// Whether the sources differed from the commit.
    pub uncommitted_changes: Option<bool>,
    /// `release` or `debug`.
    pub profile: Option<Text>,
    /// Target system and processor of the build.
    pub target: Option<Text>,
    /// Name and version of the compiler.
    pub compiler: Option<Text>,
}

/// Record of the origin of results.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Provenance {
    /// Build of the program.
    #[serde(flatten)]
    pub build: Build,
    /// Name of the processor, where known (Linux).
    pub processor: Option<String>,
    /// Widest vector instructions of the processor by which kernels are chosen at start.
    #[serde(default)]
    pub vector_instructions: Option<Text>,
    /// Whether the run was resumed; its earlier part may be from another build or processor.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub resumed: bool,
    /// The case with all defaults, and its input files.
    pub inputs: Vec<Input>,
}

/// A file that a run read.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Input {
    /// Key of the case that names the file; none for the case itself.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub key: Option<String>,
    /// Path of the file; the case is in the result folder.
    pub file: PathBuf,
    /// Identity of the file's content.
    #[serde(flatten)]
    pub content: Identity,
}

/// The identity of the content of a file.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
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
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Stage {
    /// Name of the stage.
    pub name: Text,
    /// Wall time, s.
    pub seconds: f64,
    /// Peak memory of the process up to the end of the stage, bytes; none where unknown.
    pub peak_bytes: Option<u64>,
}
