//! Origin of results, for repeating a run: program, processor and input files.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use ligament_case::case::CaseFile;
use ligament_output::folder::RESOLVED_CASE;
use ligament_output::summary::{Build, Identity, Input, Provenance};

use crate::inputs::{FileIdentities, files, recorded_case};
use crate::origin::recorded_text;

/// The provenance of a run of a case into a folder, by a build on this computer.
///
/// # Errors
///
/// If a file cannot be read, with its path.
pub fn provenance(
    build: Build,
    case: &CaseFile,
    folder: &Path,
    contents: &mut FileIdentities,
) -> Result<Provenance, (PathBuf, io::Error)> {
    let recorded = recorded_case(case, folder);
    // A case that cannot be written as TOML fails when it is run.
    let resolved = recorded_text(case, folder).unwrap_or_default();
    let mut inputs = vec![Input {
        key: None,
        file: RESOLVED_CASE.into(),
        content: Identity::new(resolved.as_bytes()),
    }];
    for ((key, path), (_, file)) in files(case).into_iter().zip(files(&recorded)) {
        let content = contents.identity(&path);
        let content = content.map_err(|error| (path, error))?;
        let key = Some(key);
        inputs.push(Input { key, file, content });
    }
    Ok(Provenance {
        build,
        processor: processor(),
        vector_instructions: Some(vector_instructions().into()),
        resumed: false,
        inputs,
    })
}

/// Name of the processor, where known (Linux).
fn processor() -> Option<String> {
    let cpu_info = fs::read_to_string("/proc/cpuinfo").ok()?;
    let line = cpu_info
        .lines()
        .find(|line| line.starts_with("model name"))?;
    Some(line.split_once(':')?.1.trim().to_owned())
}

/// Name of the widest vector instructions by which the solver's dense kernels are chosen.
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

/// Name of the architecture: kernels for other processors are chosen when the program is built.
#[cfg(not(target_arch = "x86_64"))]
fn vector_instructions() -> &'static str {
    std::env::consts::ARCH
}
