//! Openings of a straight crack of a stored run.

use std::path::Path;

use ligament_analysis::result_fields::DISPLACEMENT;
use ligament_post::crack::{CrackOpening, openings};

use super::cracks::StoredCracks;
use super::outputs::Outputs;
use super::point_fields::location;
use crate::Error;
use crate::vtu::read::VtuFile;

/// Openings at evenly spread places of a line between two ends (m) in a step with fields, from the points within a mean horizon on both
/// sides.
///
/// # Errors
///
/// If the folder has no results of a body in the plane, or none of the step.
pub fn stored_openings(
    folder: &Path,
    step: usize,
    ends: [[f64; 2]; 2],
    samples: usize,
) -> Result<Vec<CrackOpening>, Error> {
    let cracks = StoredCracks::open(folder)?;
    let outputs = Outputs::list(folder)?;
    let Some(path) = outputs.files.get(&step) else {
        return Err(Error::NoResults {
            path: folder.to_path_buf(),
            reason: format!("it has no fields of step {step}"),
        });
    };
    let file = VtuFile::open(path)?;
    let values = file.finite_numbers(location(&file), DISPLACEMENT.name)?;
    // Files have three components in the plane too.
    let displacements: Vec<[f64; 2]> = values.chunks_exact(3).map(|it| [it[0], it[1]]).collect();
    let points = [cracks.positions(), &displacements];
    Ok(openings(points, ends, samples, cracks.mean_horizon()))
}
