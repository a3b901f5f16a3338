//! Bodies from arrays, written as files that a case reads.

use std::path::PathBuf;

use ligament::body::Points;
use ligament_case::point_table;
use ligament_mesh::gmsh::{self, CoordinatePlane, Element};
use ligament_output::replace_file;
use numpy::{PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;

use crate::errors;

/// Elements of a mesh: dimension, tags of the corners, shape (n, corners), and name of their group.
type Elements<'py> = (u8, PyReadonlyArray2<'py, u64>, Option<String>);

/// Groups of points by their indices.
type Groups = Vec<(String, Vec<u32>)>;

/// Writes a body of points at positions (n, 2) or (n, 3), m, with areas, m^2, or volumes, m^3, (n), and groups by indices.
#[pyfunction]
pub(crate) fn write_points(
    py: Python<'_>,
    path: PathBuf,
    positions: PyReadonlyArray2<'_, f64>,
    sizes: PyReadonlyArray1<'_, f64>,
    groups: Groups,
) -> PyResult<()> {
    let sizes = sizes.as_array().to_vec();
    let text = match positions.as_array().ncols() {
        3 => points_text::<3>(py, &positions, sizes, &groups)?,
        _ => points_text::<2>(py, &positions, sizes, &groups)?,
    };
    written(py, &path, &text)
}

/// Writes a meshed body: tags of the nodes (n), their positions (n, 3), and elements with their groups.
#[pyfunction]
pub(crate) fn write_mesh(
    py: Python<'_>,
    path: PathBuf,
    tags: PyReadonlyArray1<'_, u64>,
    positions: PyReadonlyArray2<'_, f64>,
    elements: Vec<Elements<'_>>,
) -> PyResult<()> {
    let positions = positions_of(py, &positions)?;
    let nodes: Vec<(u64, [f64; 3])> = tags.as_array().iter().copied().zip(positions).collect();
    let mut all = Vec::new();
    for (dimension, corners, group) in &elements {
        let rows = corners.as_array();
        let rows = rows.rows().into_iter();
        all.extend(rows.map(|row| Element {
            dimension: *dimension,
            corners: row.to_vec(),
            group: group.as_deref(),
        }));
    }
    let mesh = gmsh::assemble(&nodes, &all, CoordinatePlane::Xy);
    let mesh = mesh.map_err(|error| errors::body_error(py, &error.to_string()))?;
    written(py, &path, &gmsh::write_any(&mesh))
}

/// Writes a table of values (n) at positions (n, 2) or (n, 3), m.
#[pyfunction]
pub(crate) fn write_samples(
    py: Python<'_>,
    path: PathBuf,
    column: &str,
    positions: PyReadonlyArray2<'_, f64>,
    values: PyReadonlyArray1<'_, f64>,
) -> PyResult<()> {
    let values = values.as_array().to_vec();
    let text = match positions.as_array().ncols() {
        3 => point_table::text_of_samples::<3>(column, &positions_of(py, &positions)?, &values),
        _ => point_table::text_of_samples::<2>(column, &positions_of(py, &positions)?, &values),
    };
    written(py, &path, &text)
}

fn written(py: Python<'_>, path: &std::path::Path, text: &str) -> PyResult<()> {
    let written = replace_file(path, text.as_bytes());
    written.map_err(|error| errors::request_error(py, &error.to_string()))
}

/// The table of points that are a body.
fn points_text<const D: usize>(
    py: Python<'_>,
    positions: &PyReadonlyArray2<'_, f64>,
    sizes: Vec<f64>,
    groups: &Groups,
) -> PyResult<String> {
    let fault = |error: String| errors::body_error(py, &error);
    let positions: Vec<[f64; D]> = positions_of(py, positions)?;
    let text = point_table::table_text(&positions, &sizes, groups).map_err(fault)?;
    let mut points = Points::new(positions, sizes).map_err(|it| fault(it.to_string()))?;
    for (name, indices) in groups {
        let with = points.with_group(name, indices.iter().copied());
        points = with.map_err(|it| fault(it.to_string()))?;
    }
    Ok(text)
}

fn positions_of<const D: usize>(
    py: Python<'_>,
    rows: &PyReadonlyArray2<'_, f64>,
) -> PyResult<Vec<[f64; D]>> {
    let rows = rows.as_array();
    if rows.ncols() != D {
        let fault = format!(
            "positions have the shape (n, {D}), found {:?}",
            rows.shape()
        );
        return Err(errors::body_error(py, &fault));
    }
    let rows = rows.rows().into_iter();
    Ok(rows
        .map(|row| std::array::from_fn(|axis| row[axis]))
        .collect())
}
