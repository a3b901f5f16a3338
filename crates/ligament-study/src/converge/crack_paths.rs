//! Distances of the crack paths of runs at two sizes.

use std::path::Path;

use ligament_output::results::cracks::StoredCracks;
use ligament_post::crack::CrackLine;
use serde::Serialize;

use super::evaluation::{Runs, SizedRun};

/// Distances of the crack paths of bodies in the plane.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub(super) struct PathDistances {
    /// Half of the mean horizon at h, the uncertainty of a path on any mesh, m.
    half_horizon: f64,
    /// Mean distance of the paths of the two bodies of h, m; none with one body.
    at_h: Option<f64>,
    /// Mean distance of the paths of 2h from the paths of h, m.
    from_2h: f64,
}

impl PathDistances {
    /// The distances of the longest cracks at the end of the runs; none for a solid, or where a run has no crack.
    pub(super) fn between_runs(runs: &Runs<'_>) -> Option<Self> {
        let lines = |run: &SizedRun<'_>| longest_crack(Path::new(&run.folder));
        let of_size = |is_fine: bool| runs.by_size(is_fine).map(lines).collect::<Option<Vec<_>>>();
        let (fine, coarse) = (of_size(true)?, of_size(false)?);
        let horizons = runs
            .by_size(true)
            .filter_map(|run| run.results.number("horizon.mean").ok());
        let apart = coarse
            .iter()
            .flat_map(|coarse| fine.iter().map(move |fine| distance(coarse, fine)));
        Some(Self {
            half_horizon: 0.5 * mean(horizons)?,
            at_h: match &fine[..] {
                [one, other] => Some(distance(one, other)),
                _ => None,
            },
            from_2h: mean(apart)?,
        })
    }

    /// The distances in words.
    pub(super) fn words(&self) -> String {
        let length = |value: f64| ligament_output::quantity::quantity(value, "m");
        let at_h = self.at_h.map_or_else(String::new, |it| {
            format!("those of h are {} apart in the mean, ", length(it))
        });
        format!(
            "known to half a horizon, {}; {at_h}those of h and 2h {}",
            length(self.half_horizon),
            length(self.from_2h)
        )
    }
}

/// The longest crack at the end of a run.
fn longest_crack(folder: &Path) -> Option<CrackLine> {
    // Results of a solid, or without bonds that can break, have no lines.
    let lines = StoredCracks::open(folder).ok()?.lines(usize::MAX);
    lines
        .into_iter()
        .max_by(|a, b| a.length().total_cmp(&b.length()))
}

/// Mean distance of a path from another one, m: of the middles of its pieces, by their lengths.
fn distance(path: &CrackLine, other: &CrackLine) -> f64 {
    let (mut sum, mut length) = (0.0, 0.0);
    for piece in path.places.windows(2) {
        let [[xa, ya], [xb, yb]] = [piece[0], piece[1]];
        let middle = [0.5 * (xa + xb), 0.5 * (ya + yb)];
        let along = (xb - xa).hypot(yb - ya);
        let pieces = other.places.windows(2);
        let nearest = pieces.map(|it| from_segment(middle, [it[0], it[1]]));
        sum += along * nearest.fold(f64::INFINITY, f64::min);
        length += along;
    }
    sum / length
}

/// Distance of a point from a segment, m.
fn from_segment([x, y]: [f64; 2], [[xa, ya], [xb, yb]]: [[f64; 2]; 2]) -> f64 {
    let along = [xb - xa, yb - ya];
    let squared = along[0] * along[0] + along[1] * along[1];
    let projected = (x - xa) * along[0] + (y - ya) * along[1];
    let share = if squared > 0.0 {
        (projected / squared).clamp(0.0, 1.0)
    } else {
        0.0
    };
    (x - xa - share * along[0]).hypot(y - ya - share * along[1])
}

fn mean(values: impl Iterator<Item = f64>) -> Option<f64> {
    let values: Vec<f64> = values.collect();
    (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
}

#[cfg(test)]
mod tests {
    use super::*;
    use ligament_post::crack::CrackEnd;

    /// Pieces of lengths 1 and 2 above a path of length 1: their middles are 1 and sqrt 2 from it.
    #[test]
    fn paths_are_apart_by_the_mean_of_their_pieces() {
        let line = |places: &[[f64; 2]]| CrackLine {
            places: places.to_vec(),
            ends: [CrackEnd::Outline, CrackEnd::Tip],
        };
        let (path, other) = (
            line(&[[0.0, 1.0], [1.0, 1.0], [3.0, 1.0]]),
            line(&[[0.0, 0.0], [1.0, 0.0]]),
        );
        let expected = (1.0 + 2.0 * 2.0_f64.sqrt()) / 3.0;
        assert!((distance(&path, &other) - expected).abs() < 1e-15);
        assert_eq!(distance(&other, &path), 1.0);
    }
}
