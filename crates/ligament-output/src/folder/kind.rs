//! Kinds of result folders: the file that shows what a folder holds, and the files that are the program's own.

use crate::vtu;

/// The file that every run writes first; it shows that a folder holds the results of a run.
pub const RESOLVED_CASE: &str = "case.resolved.toml";

/// The page for a browser in a folder of results, which a run leaves where it is.
pub const REPORT: &str = "report.html";

/// The file that is locked while something writes to a folder.
pub(super) const LOCK: &str = ".lock";

/// The file that shows that a folder was moved aside to be replaced, and may be removed.
pub(super) const REPLACED: &str = ".replaced";

/// Files of a run whose names do not vary.
const OF_A_RUN: [&str; 12] = [
    RESOLVED_CASE,
    "breaks.csv",
    "criteria.csv",
    "history.csv",
    "iterations.csv",
    "modes.csv",
    "softening.csv",
    "summary.json",
    "timings.csv",
    "fields.pvd",
    "bonds.pvd",
    "modes.pvd",
];

/// The grid of a run whose name does not vary, without its ending.
const MODEL_STEM: &str = "model";

/// Files of a run that have a number, by what stands before it.
const NUMBERED: [&str; 3] = ["fields_", "bonds_", "mode_"];

/// Files of cracks and other surfaces, which are made of the results of a run afterwards, and those of them that have a number.
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
    /// The file by which the folder is recognised; what writes a folder writes this file first.
    pub marker: &'static str,
    /// Whether a file of this name is the program's own, so that it goes when the folder is replaced. Files that the new
    /// results have too need not be told.
    pub owns: fn(&str) -> bool,
    /// Whether a folder of this name in the folder holds a run of its own.
    pub holds_run: fn(&str) -> bool,
}

impl Kind {
    /// The kind of the results of a run.
    pub const RUN: Self = Self {
        marker: RESOLVED_CASE,
        owns: is_of_a_run,
        holds_run: |_| false,
    };

    /// A kind without files that vary from one time to the next.
    pub const fn marked(marker: &'static str) -> Self {
        Self {
            marker,
            owns: |_| false,
            holds_run: |_| false,
        }
    }

    /// Whether a file of this name may be removed with the results.
    pub(super) fn may_remove(self, name: &str) -> bool {
        name == self.marker || name == LOCK || name == REPLACED || {
            let whole = unfinished(name).unwrap_or(name);
            (self.owns)(whole) || self.is_unfinished(name)
        }
    }

    /// Whether a file of this name was to become one of the program's own, and did not.
    pub(super) fn is_unfinished(self, name: &str) -> bool {
        let is_own = |whole| whole == self.marker || whole == REPORT || (self.owns)(whole);
        unfinished(name).is_some_and(is_own)
    }
}

/// The name of the file that a temporary file `.NAME.PROCESS.partial` was to become.
pub(super) fn unfinished(name: &str) -> Option<&str> {
    let inner = name.strip_prefix('.')?.strip_suffix(".partial")?;
    let (whole, process) = inner.rsplit_once('.')?;
    is_number(process).then_some(whole)
}

fn is_of_a_run(name: &str) -> bool {
    let is_model = vtu::stem(name) == Some(MODEL_STEM);
    OF_A_RUN.contains(&name)
        || is_model
        || is_numbered(name, &NUMBERED)
        || is_made_later(name)
        || name.starts_with("checkpoint")
}

/// Whether a file of this name is made of the results of a run afterwards: of its cracks, or of another surface.
pub fn is_made_later(name: &str) -> bool {
    OF_SURFACES.contains(&name) || is_numbered(name, &NUMBERED_SURFACES)
}

/// Whether a grid has a number behind one of these beginnings.
fn is_numbered(name: &str, beginnings: &[&str]) -> bool {
    let stem = vtu::stem(name).unwrap_or_default();
    let numbers = beginnings.iter().filter_map(|it| stem.strip_prefix(it));
    numbers.into_iter().any(is_number)
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
                .all(|name| is_made_later(name) && Kind::RUN.may_remove(name))
        );
        let of_the_run = ["fields_0007.vtu", "history.csv", "crack_a.vtu", "iso.stl"];
        assert!(!of_the_run.iter().any(|name| is_made_later(name)));
    }

    #[test]
    fn files_of_a_run_are_told_from_others() {
        let own = [
            "fields_0000.vtu",
            "bonds_12345.vtu",
            "fields_0001.pvtu",
            "fields_0001.piece_12.vtu",
            "model.pvtu",
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
            "fields_0001.piece_a.vtu",
            "my-history.csv",
            ".thesis.tex.1.partial",
        ];
        assert!(!foreign.iter().any(|name| Kind::RUN.may_remove(name)));
    }
}
