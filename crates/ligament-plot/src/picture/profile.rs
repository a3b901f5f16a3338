//! Fields of stored steps along a straight line, as a table.

use std::path::PathBuf;

use ligament_output::FieldLocation;
use ligament_output::csv::{Value, line};
use ligament_output::results::outputs::Outputs;
use ligament_output::results::solid_body::is_solid;
use ligament_output::results::steps::StepChoice;
use ligament_output::vtu::read::VtuFile;

use super::PictureError;
use super::field::Field;

/// Columns of the table before the columns of the fields.
pub const PROFILE_COLUMNS: [&str; 4] = ["step", "along", "x", "y"];

/// Distance outside of a cell, over the size of the cell, up to which a place counts as in it: places on the outline.
const SLACK: f64 = 1e-9;

/// Request for a profile.
#[derive(Debug, Clone, PartialEq)]
pub struct ProfileRequest {
    /// The folder of the results.
    pub folder: PathBuf,
    /// Fields, named as in pictures, each a column.
    pub fields: Vec<String>,
    /// Steps of the profile.
    pub step: StepChoice,
    /// Both ends of the line, in the coordinates of the case and of the body without load, m.
    pub ends: [[f64; 2]; 2],
    /// Number of places on the line, two or more, evenly spread.
    pub samples: usize,
}

/// The table of fields along a line: one row for each step and place, empty where the place lies outside of the body.
///
/// Between the nodes of a mesh values are linear in a triangle, or in each half of a quadrangle; the cell of a lattice has one
/// value.
///
/// # Errors
///
/// If there is no such step or field, or a file cannot be used.
pub fn profile(request: &ProfileRequest) -> Result<String, PictureError> {
    let outputs = Outputs::list(&request.folder)?;
    let steps = request.step.steps(&request.folder, &outputs.states())?;
    let fields = request.fields.iter().map(String::as_str);
    let header: Vec<Value<'_>> = PROFILE_COLUMNS
        .into_iter()
        .chain(fields)
        .map(Value::from)
        .collect();
    let mut text = line(&header);
    for state in steps.iter().map(|it| it.state) {
        let name = state.to_string();
        let Some(path) = outputs.files.get(&state) else {
            continue;
        };
        let sampled = SampledField::read(&VtuFile::open(path)?, request)?;
        for (along, [x, y], values) in sampled.rows {
            let place: [Value<'_>; 4] = [Value::Text(&name), along.into(), x.into(), y.into()];
            let values = values
                .into_iter()
                .map(|it| it.map_or(Value::Missing, Value::from));
            text += &line(&place.into_iter().chain(values).collect::<Vec<_>>());
        }
    }
    Ok(text)
}

/// Length along the line, place and values of the fields.
type Row = (f64, [f64; 2], Vec<Option<f64>>);

struct SampledField {
    rows: Vec<Row>,
}

impl SampledField {
    fn read(file: &VtuFile, request: &ProfileRequest) -> Result<Self, PictureError> {
        if is_solid(file)? {
            return Err(PictureError::Solid("a profile"));
        }
        let fields: Result<Vec<Field>, PictureError> = request
            .fields
            .iter()
            .map(|name| Field::read(file, name))
            .collect();
        let fields = fields?;
        let positions = file.points_in_plane()?;
        let triangles: Vec<Triangle> = (file.cells()?.iter().enumerate())
            .flat_map(|(cell, corners)| Triangle::from_cell(cell, corners.points(), &positions))
            .collect();
        let [from, to] = request.ends;
        let length = (to[0] - from[0]).hypot(to[1] - from[1]);
        let row = |sample: usize| {
            let share = sample as f64 / (request.samples - 1) as f64;
            let place = [0, 1].map(|axis| from[axis] + share * (to[axis] - from[axis]));
            let found = triangles
                .iter()
                .find_map(|it| Some((it, it.weights(place)?)));
            let value = |field: &Field| {
                let (triangle, weights) = found.as_ref()?;
                Some(match field.location {
                    FieldLocation::Cell => field.values[triangle.cell],
                    FieldLocation::Point => triangle.mean(weights, &field.values),
                })
            };
            (share * length, place, fields.iter().map(value).collect())
        };
        Ok(Self {
            rows: (0..request.samples).map(row).collect(),
        })
    }
}

/// A triangle of a cell, or of a half of one.
struct Triangle {
    cell: usize,
    corners: [usize; 3],
    places: [[f64; 2]; 3],
}

impl Triangle {
    fn from_cell(cell: usize, corners: &[u32], positions: &[[f64; 2]]) -> Vec<Self> {
        let Some((first, others)) = corners.split_first() else {
            return Vec::new();
        };
        let of_pair = |pair: &[u32]| {
            let corners = [*first, pair[0], pair[1]].map(|it| it as usize);
            Self {
                cell,
                corners,
                places: corners.map(|it| positions[it]),
            }
        };
        others.windows(2).map(of_pair).collect()
    }

    /// Barycentric coordinates of a place; `None` where the place lies outside.
    fn weights(&self, place: [f64; 2]) -> Option<[f64; 3]> {
        let [a, b, c] = self.places;
        let twice = |p: [f64; 2], q: [f64; 2], r: [f64; 2]| {
            (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
        };
        let whole = twice(a, b, c);
        let weights = [twice(place, b, c), twice(a, place, c), twice(a, b, place)];
        let weights = weights.map(|it| it / whole);
        weights.iter().all(|it| *it >= -SLACK).then_some(weights)
    }

    fn mean(&self, weights: &[f64; 3], values: &[f64]) -> f64 {
        let shares = self.corners.iter().zip(weights);
        shares
            .map(|(&corner, weight)| weight * values[corner])
            .sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A linear field is interpolated exactly in both halves of a quadrangle, and on its rim.
    #[test]
    fn values_are_linear_in_a_cell_and_none_outside() {
        let positions = [[0.0, 0.0], [2.0, 0.0], [3.0, 1.0], [0.0, 1.0]];
        let linear = |[x, y]: [f64; 2]| 1.0 + 2.0 * x - 3.0 * y;
        let values = positions.map(linear);
        let halves = Triangle::from_cell(7, &[0, 1, 2, 3], &positions);
        assert_eq!((halves.len(), halves[1].cell), (2, 7));
        let value = |place| {
            let mut found = halves
                .iter()
                .filter_map(|it| Some(it.mean(&it.weights(place)?, &values)));
            found.next()
        };
        for place in [
            [0.5, 0.25],
            [0.5, 0.75],
            [2.0, 0.5],
            [0.0, 0.0],
            [2.5, 0.5],
            [1.5, 1.0],
        ] {
            assert!((value(place).unwrap() - linear(place)).abs() < 1e-12);
        }
        for outside in [[-1e-6, 0.5], [2.5, 0.4], [1.0, 1.001]] {
            assert_eq!(value(outside), None);
        }
    }
}
