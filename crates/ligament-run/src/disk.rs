//! Estimated disk space of the results of a case, and free disk space.

use std::path::Path;

use ligament::Model;
use ligament::setup::Analysis;
use ligament_case::case::CaseFile;

/// Bytes of a point in a file of fields, compressed, rounded up from the largest measured value: a Brazilian disk of 846,
/// 1273, 2998 and 4808 points took 109 per point before its load and up to 163, 159, 160 and 157 after it. The file of a regular
/// lattice is smaller: up to 120.
const POINT: f64 = 165.0;

/// Bytes of a bond in a file of bonds, compressed, rounded up likewise: the bonds of these disks took 19 before their load and up
/// to 45.4 after it, the bonds of a cracked plate of 997 points up to 46.0.
const BOND: f64 = 46.0;

/// Disk space of the fields of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FieldsOnDisk {
    /// Bytes of the files of one state.
    pub of_one: f64,
    /// Largest number of states; None on the exact path, whose number of events is not known.
    pub most: Option<usize>,
    /// Steps or events between two states; 0 for the first and the last one alone.
    pub every: usize,
}

impl FieldsOnDisk {
    /// The disk space of the fields of a case.
    pub fn new(case: &CaseFile, model: &Model) -> Self {
        let output = &case.case.output;
        let every = output.fields_every.unwrap_or_default() as usize;
        let bonds = if output.bonds {
            BOND * model.system.ends.len() as f64
        } else {
            0.0
        };
        let most = match &model.setup.analysis {
            _ if every == 0 => Some(2),
            Analysis::Event(_) => None,
            Analysis::Stepped(settings) => {
                let steps = model.setup.n_steps().unwrap_or(0);
                let refined = steps + settings.refine_first_break;
                Some(refined / every + 2)
            }
            Analysis::Motion(settings) => Some(settings.rows / every + 2),
            Analysis::Elastic { .. } | Analysis::Modal(_) => Some(2),
        };
        Self {
            of_one: POINT * model.system.subdomain.n_all() as f64 + bonds,
            most,
            every,
        }
    }

    /// Bytes of all states, where their number is known.
    pub fn all(&self) -> Option<f64> {
        Some(self.of_one * self.most? as f64)
    }
}

/// Free bytes of the file system of a folder that a program without privileges may fill; None where the system does not say.
#[cfg(unix)]
pub fn free(folder: &Path) -> Option<f64> {
    let system = rustix::fs::statvfs(folder).ok()?;
    Some(system.f_bavail as f64 * system.f_frsize as f64)
}

/// Free bytes of the file system of a folder; unknown on this system.
#[cfg(not(unix))]
pub fn free(_: &Path) -> Option<f64> {
    None
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    #[test]
    fn a_folder_has_free_bytes_and_a_missing_one_has_none() {
        let folder = tempfile::tempdir().unwrap();
        assert!(free(folder.path()).is_some_and(|bytes| bytes >= 0.0));
        assert_eq!(free(&folder.path().join("missing")), None);
    }
}
