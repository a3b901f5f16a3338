//! Values of points from samples at positions.

use ligament_model::PointCloud;

use super::places::distance;
use crate::body::Body;
use crate::coordinates::narrowed;
use crate::error::Fault;
use crate::setup::Sample;

/// Largest distance of a sample from its point over the distance between nearest points: coordinates may be rounded, but samples of another
/// mesh are refused.
const NEARNESS: f64 = 0.1;

/// Reason why a point has no value.
pub(super) const MISSING: &str =
    "the table has no row within a tenth of the distance to the nearest other point";

/// The value at each point with a sample, shape (n_points); as the error the fault of the samples.
pub(super) fn at_points<const D: usize>(
    samples: &[Sample],
    body: &dyn Body,
    cloud: &PointCloud<D>,
) -> Result<Vec<Option<f64>>, Fault> {
    let positions: Vec<[f64; D]> = samples.iter().map(|it| narrowed(it.position)).collect();
    let nearest = cloud.nearest_points(&positions);
    let mut of_point: Vec<Option<usize>> = vec![None; cloud.len()];
    for (second, &point) in nearest.iter().enumerate() {
        let (there, here) = (
            cloud.local(positions[second]),
            cloud.positions[point as usize],
        );
        if distance(there, here) > NEARNESS * cloud.spacing[point as usize] {
            continue;
        }
        if let Some(first) = of_point[point as usize].replace(second) {
            return Err(Fault::SampledTwice {
                place: body.place(point),
                first,
                second,
            });
        }
    }
    let value = |sample: Option<usize>| sample.map(|it| samples[it].value);
    Ok(of_point.into_iter().map(value).collect())
}
