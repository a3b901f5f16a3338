//! Bitwise comparison of the results of two runs of one case.

mod fields;
mod summaries;
mod tables;
mod values;

use std::collections::BTreeSet;
use std::fmt;
use std::fs;
use std::path::Path;

use anyhow::Context;
use ligament_output::folder::{Kind, RESOLVED_CASE, is_made_later};

use ligament_output::summary::SUMMARY;

pub(crate) use summaries::Ending;

/// Comparison of the result files of two runs.
#[derive(Debug)]
pub(crate) struct Comparison {
    /// Number of files.
    pub(crate) compared: usize,
    /// Files that differ, the most informative ones first.
    pub(crate) differing: Vec<Difference>,
}

/// A file that differs.
#[derive(Debug)]
pub(crate) struct Difference {
    file: String,
    /// Position and size of the first difference.
    words: String,
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.file, self.words)
    }
}

/// Files whose differences are most informative, in order; all others come between these and the summary.
const FIRST: [&str; 5] = [
    "history.csv",
    "breaks.csv",
    "modes.csv",
    "iterations.csv",
    "criteria.csv",
];

impl Comparison {
    /// Compares the results in two folders, `then` and `now`. Files of others and values that may differ between equal runs are left out.
    ///
    /// # Errors
    ///
    /// If a file cannot be read.
    pub(crate) fn new(then: &Path, now: &Path, ending: Ending) -> anyhow::Result<Self> {
        let mut names = results(then)?;
        names.extend(results(now)?);
        let mut names: Vec<String> = names.into_iter().collect();
        names.sort_by_key(|name| {
            let place = FIRST.iter().position(|it| it == name);
            (place.unwrap_or(FIRST.len()), name == SUMMARY)
        });
        let mut differing = Vec::new();
        for file in &names {
            if let Some(words) = difference(file, &then.join(file), &now.join(file), ending)? {
                let file = file.clone();
                differing.push(Difference { file, words });
            }
        }
        Ok(Self {
            compared: names.len(),
            differing,
        })
    }

    /// Whether no file differs.
    pub(crate) fn is_same(&self) -> bool {
        self.differing.is_empty()
    }
}

/// Names of the files in a folder that are equal in equal runs, without the case, which is an input, and without files of cracks, which are
/// derived later.
fn results(folder: &Path) -> anyhow::Result<BTreeSet<String>> {
    let listed = || format!("cannot list {}", folder.display());
    let mut names = BTreeSet::new();
    for entry in fs::read_dir(folder).with_context(listed)? {
        let name = entry.with_context(listed)?.file_name();
        let name = name.to_string_lossy().into_owned();
        let is_passing =
            [RESOLVED_CASE, "timings.csv"].contains(&&*name) || name.starts_with("checkpoint");
        if (Kind::RUN.owns)(&name) && !is_passing && !is_made_later(&name) {
            names.insert(name);
        }
    }
    Ok(names)
}

/// Description of the first difference of a file; `None` if both are equal.
fn difference(
    name: &str,
    then: &Path,
    now: &Path,
    ending: Ending,
) -> anyhow::Result<Option<String>> {
    for (path, words) in [
        (then, "only the repetition has it"),
        (now, "the repetition has none"),
    ] {
        if !path.is_file() {
            return Ok(Some(words.to_owned()));
        }
    }
    let read =
        |path: &Path| fs::read(path).with_context(|| format!("cannot read {}", path.display()));
    let (one, other) = (read(then)?, read(now)?);
    if one == other {
        return Ok(None);
    }
    if name == SUMMARY {
        return summaries::difference(&one, &other, ending);
    }
    let words = match name.rsplit_once('.') {
        Some((_, "csv")) => tables::difference(&one, &other),
        Some((_, "vtu")) => fields::difference(then, now),
        _ => None,
    };
    let place = || one.iter().zip(&other).take_while(|(a, b)| a == b).count();
    Ok(Some(words.unwrap_or_else(|| {
        format!("differs from byte {} on", place())
    })))
}
