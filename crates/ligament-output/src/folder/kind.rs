//! Kinds of result folders: the marker file of each kind, and the files that are the program's.

use std::path::Path;

use crate::atomic::UNSYNCED_MARKER;
use crate::vtu;

/// File that every run writes first; the marker of a folder with the results of a run.
pub const RESOLVED_CASE: &str = "case.resolved.toml";

/// Report page for a browser in a result folder, which a run does not remove.
pub const REPORT: &str = "report.html";

/// File that is locked while a process writes to a folder.
pub(super) const LOCK: &str = ".lock";

/// File that marks a renamed folder, which is being replaced and may be removed.
pub(super) const REPLACED: &str = ".replaced";

/// Files of a run with fixed names.
const OF_A_RUN: [&str; 16] = [
    RESOLVED_CASE,
    "breaks.csv",
    "criteria.csv",
    "history.csv",
    "iterations.csv",
    "mesh.msh",
    "modes.csv",
    "passes.csv",
    "places.csv",
    "softening.csv",
    "summary.json",
    "timings.csv",
    "fields.pvd",
    "bonds.pvd",
    "modes.pvd",
    "rigid.pvd",
];

/// Beginning of the names of copies of inputs.
const OF_INPUTS: &str = "input-";

/// Sections whose files are copied.
const SECTIONS_WITH_FILES: [&str; 4] = ["mesh", "temperature", "load", "refine"];

/// Stem of the grid file of a run with a fixed name.
const MODEL_STEM: &str = "model";

/// Prefixes of the numbered files of a run.
const NUMBERED: [&str; 4] = ["fields_", "bonds_", "mode_", "rigid_"];

/// Files of cracks and other surfaces, which are derived from the results of a run later, and prefixes of the numbered ones.
const OF_SURFACES: [&str; 10] = [
    "crack.csv",
    "crack.pvd",
    "crack.stl",
    "crack.vtu",
    "crack_growth.csv",
    "crack_tips.csv",
    "iso.pvd",
    "iso.vtu",
    "opened.pvd",
    "opened.vtu",
];
const NUMBERED_SURFACES: [&str; 3] = ["crack_", "opened_", "iso_"];

/// A kind of result folder.
#[derive(Debug, Clone, Copy)]
pub struct Kind {
    /// Name of the file by which the folder is recognised; it is written first.
    pub marker: &'static str,
    /// Whether a file of this name is the program's, so that it is removed when the folder is replaced. Files that the new results also
    /// have need not be included.
    pub owns: fn(&str) -> bool,
    /// Whether a subfolder of this name has a run of its own.
    pub holds_run: fn(&str) -> bool,
}

impl Kind {
    /// The kind of the results of a run.
    pub const RUN: Self = Self {
        marker: RESOLVED_CASE,
        owns: is_run_file,
        holds_run: |_| false,
    };

    /// A kind whose results always have the same files.
    pub const fn with_marker(marker: &'static str) -> Self {
        Self {
            marker,
            owns: |_| false,
            holds_run: |_| false,
        }
    }

    /// Whether a file of this name may be removed with the results.
    pub(super) fn may_remove(self, name: &str) -> bool {
        name == self.marker || [LOCK, REPLACED, UNSYNCED_MARKER].contains(&name) || {
            let whole = final_name(name).unwrap_or(name);
            (self.owns)(whole) || self.is_unfinished(name)
        }
    }

    /// Whether a file of this name is an unfinished file of the program.
    pub(super) fn is_unfinished(self, name: &str) -> bool {
        let is_own = |whole| whole == self.marker || whole == REPORT || (self.owns)(whole);
        final_name(name).is_some_and(is_own)
    }
}

/// Final name `NAME` of a temporary file `.NAME.PROCESS.partial`; `None` for other files.
pub(super) fn final_name(name: &str) -> Option<&str> {
    let inner = name.strip_prefix('.')?.strip_suffix(".partial")?;
    let (whole, process) = inner.rsplit_once('.')?;
    is_number(process).then_some(whole)
}

/// Whether a file of this name is a lock or another mark, or an unfinished file of the program.
pub(super) fn is_lock_or_temporary(name: &str) -> bool {
    [LOCK, UNSYNCED_MARKER].contains(&name) || Kind::RUN.is_unfinished(name)
}

fn is_run_file(name: &str) -> bool {
    let is_model = vtu::stem(name) == Some(MODEL_STEM);
    OF_A_RUN.contains(&name)
        || is_model
        || is_numbered(name, &NUMBERED)
        || is_derived_file(name)
        || name.starts_with("checkpoint")
        || is_input(name)
}

/// Whether a file of this name is a copy of an input.
fn is_input(name: &str) -> bool {
    let section = name.strip_prefix(OF_INPUTS).unwrap_or_default();
    let section = section.split(['-', '.']).next().unwrap_or_default();
    SECTIONS_WITH_FILES.contains(&section)
}

/// Name of the copy of an input in a result folder, by its key in the case: `input-mesh.msh`, `input-temperature-0.csv`.
pub fn input_name(key: &str, file: &Path) -> String {
    let stem = key.trim_end_matches(".file").replace('.', "-");
    let ending = file.extension().unwrap_or_default().to_string_lossy();
    format!("{OF_INPUTS}{stem}.{ending}")
}

/// Whether a file of this name is derived from the results of a run later: of its cracks, or of another surface.
pub fn is_derived_file(name: &str) -> bool {
    OF_SURFACES.contains(&name) || is_numbered(name, &NUMBERED_SURFACES)
}

/// Whether the name of a grid file is one of these prefixes with a number, and that of a state between breakages with another one.
fn is_numbered(name: &str, beginnings: &[&str]) -> bool {
    let stem = vtu::stem(name).unwrap_or_default();
    let numbers = beginnings.iter().filter_map(|it| stem.strip_prefix(it));
    numbers.into_iter().any(|it| match it.split_once('_') {
        Some((step, breakages)) => is_number(step) && is_number(breakages),
        None => is_number(it),
    })
}

fn is_number(text: &str) -> bool {
    !text.is_empty() && text.bytes().all(|letter| letter.is_ascii_digit())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn surfaces_are_made_later_and_fields_are_not() {
        let later = ["crack.stl", "opened.vtu", "crack_0007.vtu", "iso_0001.vtu"];
        assert!(
            later
                .iter()
                .all(|name| is_derived_file(name) && Kind::RUN.may_remove(name))
        );
        let of_the_run = ["fields_0007.vtu", "history.csv", "crack_a.vtu", "iso.stl"];
        assert!(!of_the_run.iter().any(|name| is_derived_file(name)));
    }

    #[test]
    fn files_of_a_run_are_told_from_others() {
        let own = [
            "fields_0000.vtu",
            "bonds_12345.vtu",
            "fields_0001.pvtu",
            "fields_0045_0120.vtu",
            "bonds_0045_0120.vtu",
            "fields_0001.piece_12.vtu",
            "model.pvtu",
            "input-mesh.msh",
            "input-temperature-0.csv",
            ".summary.json.4711.partial",
            ".report.html.4711.partial",
            ".lock",
        ];
        assert!(own.iter().all(|name| Kind::RUN.may_remove(name)));
        let foreign = [
            "thesis.tex",
            "report.html",
            "fields_0000.png",
            "fields_a.vtu",
            "fields_0045_.vtu",
            "fields_0045_0120_1.vtu",
            "fields_0001.piece_a.vtu",
            "my-history.csv",
            "input-data.csv",
            ".thesis.tex.1.partial",
        ];
        assert!(!foreign.iter().any(|name| Kind::RUN.may_remove(name)));
    }
}
