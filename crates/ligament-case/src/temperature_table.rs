//! Temperatures from a table of comma-separated values.

use std::path::Path;

use ligament_model::PointCloud;

use crate::body::Body;

/// A row belongs to a point if it is nearer than this part of the distance to the nearest other point: coordinates may be
/// written with a few digits, but those of another mesh are refused.
const NEARNESS: f64 = 0.1;

/// A row: its line in the file, position in the coordinates of the case (m) and change (K).
struct Row {
    line: usize,
    position: [f64; 2],
    change: f64,
}

/// The change at each point (n_points) that a row belongs to, K; else what is wrong with the file.
pub(super) fn at_points(
    path: &Path,
    body: &dyn Body,
    cloud: &PointCloud,
) -> Result<Vec<Option<f64>>, String> {
    let text = std::fs::read_to_string(path)
        .map_err(|source| format!("cannot read {}: {source}", path.display()))?;
    let rows =
        rows(&text).map_err(|(line, reason)| format!("{}:{line}: {reason}", path.display()))?;
    let positions: Vec<[f64; 2]> = rows.iter().map(|row| row.position).collect();
    let nearest = cloud.nearest_points(&positions);
    let mut row_of_point: Vec<Option<&Row>> = vec![None; cloud.len()];
    for (row, &point) in rows.iter().zip(&nearest) {
        let (there, here) = (cloud.local(row.position), cloud.positions[point as usize]);
        let distance = (there[0] - here[0]).hypot(there[1] - here[1]);
        if distance > NEARNESS * cloud.spacing[point as usize] {
            continue;
        }
        if let Some(first) = row_of_point[point as usize].replace(row) {
            return Err(format!(
                "{}:{}: {} has a row already, in line {}",
                path.display(),
                row.line,
                body.place(point),
                first.line
            ));
        }
    }
    let change = |row: Option<&Row>| row.map(|row| row.change);
    Ok(row_of_point.into_iter().map(change).collect())
}

/// The rows below the header; blank lines and those that begin with # say nothing.
fn rows(text: &str) -> Result<Vec<Row>, (usize, String)> {
    // Spreadsheets begin their files with a byte order mark.
    let lines = text.trim_start_matches('\u{feff}').lines();
    let mut lines = (1..)
        .zip(lines.map(str::trim))
        .filter(|(_, text)| !text.is_empty() && !text.starts_with('#'));
    let expected = "the first row must name the columns `x`, `y` (m) and `change` (K)";
    let Some((line, header)) = lines.next() else {
        return Err((1, format!("the file is empty: {expected}")));
    };
    let names: Vec<&str> = header.split(',').map(name_of).collect();
    let column = |wanted: &str| {
        let place = names.iter().position(|&name| name == wanted);
        place.ok_or_else(|| (line, format!("there is no column `{wanted}`: {expected}")))
    };
    let columns = [column("x")?, column("y")?, column("change")?];
    let row = |(line, text): (usize, &str)| {
        let values: Vec<&str> = text.split(',').map(str::trim).collect();
        if values.len() != names.len() {
            let reason = format!(
                "{} values, but the header names {} columns",
                values.len(),
                names.len()
            );
            return Err((line, reason));
        }
        let value = |column: usize| {
            let number = values[column].parse::<f64>().ok();
            number
                .filter(|number| number.is_finite())
                .ok_or_else(|| (line, format!("`{}` is no number", values[column])))
        };
        let [x, y, change] = columns;
        Ok(Row {
            line,
            position: [value(x)?, value(y)?],
            change: value(change)?,
        })
    };
    lines.map(row).collect()
}

fn name_of(text: &str) -> &str {
    text.trim().trim_matches('"')
}
