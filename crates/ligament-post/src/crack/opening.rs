//! Opening of a straight crack from the displacements of the points on both of its sides.

use nalgebra::{Matrix3, RowVector2, SMatrix, Vector3};

/// Distance from the line over the reach up to which a point lies on the line, and so on neither side.
const ON_LINE: f64 = 1e-9;

/// Jump of the displacement across a crack line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CrackOpening {
    /// Distance from the start of the line, m.
    pub along: f64,
    /// Place, m.
    pub place: [f64; 2],
    /// Displacement of the left side minus displacement of the right side, along the normal to the left and along the line, m; none where one side
    /// has too few points.
    pub jump: Option<[f64; 2]>,
}

/// Jumps of the displacements (n_points, m) of points (n_points, m) at evenly spread places of a line between two ends, m.
///
/// The displacement of a side is its linear fit to the points of the side within a `reach` (m) of the place, with the weights (1 - d/reach)^2 at
/// the distances d.
pub fn openings(
    [points, displacements]: [&[[f64; 2]]; 2],
    [from, to]: [[f64; 2]; 2],
    samples: usize,
    reach: f64,
) -> Vec<CrackOpening> {
    let along = [to[0] - from[0], to[1] - from[1]];
    let length = along[0].hypot(along[1]);
    let tangent = along.map(|it| it / length);
    let sample = |number: usize| {
        let share = number as f64 / (samples - 1) as f64;
        let place = [0, 1].map(|axis| from[axis] + share * along[axis]);
        let sides = [1.0, -1.0].map(|side| {
            let near = points.iter().zip(displacements).filter_map(|(point, u)| {
                let [x, y] = [point[0] - place[0], point[1] - place[1]];
                let off = side * (tangent[0] * y - tangent[1] * x);
                let weight = 1.0 - x.hypot(y) / reach;
                (off > ON_LINE * reach && weight > 0.0).then(|| {
                    let offset = [x * tangent[0] + y * tangent[1], off].map(|it| it / reach);
                    (weight * weight, offset, *u)
                })
            });
            fitted(near)
        });
        let jump = match sides {
            [Some(left), Some(right)] => {
                let [x, y] = [left[0] - right[0], left[1] - right[1]];
                Some([
                    tangent[0] * y - tangent[1] * x,
                    tangent[0] * x + tangent[1] * y,
                ])
            }
            _ => None,
        };
        CrackOpening {
            along: share * length,
            place,
            jump,
        }
    };
    (0..samples).map(sample).collect()
}

/// Value at offset zero of a weighted linear fit to values at offsets; None where the offsets do not determine it.
fn fitted(values: impl Iterator<Item = (f64, [f64; 2], [f64; 2])>) -> Option<[f64; 2]> {
    let (mut matrix, mut right) = (Matrix3::zeros(), SMatrix::<f64, 3, 2>::zeros());
    for (weight, [along, off], value) in values {
        let basis = Vector3::new(1.0, along, off);
        matrix += weight * basis * basis.transpose();
        right += weight * basis * RowVector2::from(value);
    }
    let inverse = matrix.try_inverse()?;
    let value = inverse.row(0) * right;
    let is_determined = value.iter().all(|it| it.is_finite());
    is_determined.then_some([value[0], value[1]])
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    /// Two halves of irregular points beside an inclined line, each with a linear motion: their jump is exact, positive where the left side moves to
    /// the left or along the line; there is none beyond the points.
    #[test]
    fn two_linear_motions_have_their_jump() {
        let tangent = [0.8, 0.6];
        let points: Vec<[f64; 2]> = (0..900)
            .map(|number| {
                let (column, row) = (f64::from(number % 30), f64::from(number / 30));
                [
                    column + 0.2 * (row * 1.7).sin() - 15.0,
                    row + 0.2 * column.cos() - 15.0,
                ]
            })
            .collect();
        let side = |[x, y]: [f64; 2]| (tangent[0] * y - tangent[1] * x).signum();
        let motion = |point: &[f64; 2]| {
            let [x, y] = *point;
            match side(*point) > 0.0 {
                true => [1e-3 * x + 0.02, 2e-3 * y - 1e-3 * x + 0.01],
                false => [-2e-3 * y, 1e-3 * x],
            }
        };
        let moved: Vec<[f64; 2]> = points.iter().map(motion).collect();
        let ends = [[-4.0, -3.0], [4.0, 3.0]];
        for it in openings([&points, &moved], ends, 5, 3.0) {
            let [x, y] = it.place;
            let across = [1e-3 * x + 0.02 + 2e-3 * y, 2e-3 * y - 2e-3 * x + 0.01];
            let expected = [
                0.8 * across[1] - 0.6 * across[0],
                0.8 * across[0] + 0.6 * across[1],
            ];
            let found = it.jump.unwrap();
            for axis in 0..2 {
                assert!((found[axis] - expected[axis]).abs() < 1e-12, "{it:?}");
            }
        }
        let beyond = openings([&points, &moved], [[100.0, 0.0], [101.0, 0.0]], 2, 3.0);
        assert!(beyond.iter().all(|it| it.jump.is_none()));
    }
}
