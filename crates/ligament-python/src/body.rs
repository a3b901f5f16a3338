//! Bodies from arrays.

use std::sync::Arc;

use ligament::body::{self, MeshBody, Points};
use ligament_mesh::gmsh::{self, Element};
use numpy::{PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;

use crate::errors;

/// A body that a setup stands on, whatever it was made of.
#[pyclass(frozen, module = "ligament._native")]
pub(crate) struct Body {
    pub(crate) body: Arc<dyn body::Body>,
}

/// Elements of a mesh: tags of the corners of each, shape (n, corners), and the group that they make.
type Elements<'py> = (PyReadonlyArray2<'py, u64>, Option<String>);

#[pymethods]
impl Body {
    /// A body of points at positions (n, 2), each with the area that it stands for (n), and groups by their indices.
    #[staticmethod]
    fn of_points(
        py: Python<'_>,
        positions: PyReadonlyArray2<'_, f64>,
        areas: PyReadonlyArray1<'_, f64>,
        groups: Vec<(String, Vec<u32>)>,
    ) -> PyResult<Self> {
        let positions = pairs(py, &positions)?;
        let areas = areas.as_array().to_vec();
        let fault = |error: body::PointsError| errors::of_body(py, &error.to_string());
        let mut points = Points::new(positions, areas).map_err(fault)?;
        for (name, indices) in groups {
            points = points.with_group(&name, indices).map_err(fault)?;
        }
        Ok(Self {
            body: Arc::new(points),
        })
    }

    /// A meshed body: tags of the nodes (n), their positions (n, 2), and elements with their groups.
    #[staticmethod]
    fn of_mesh(
        py: Python<'_>,
        tags: PyReadonlyArray1<'_, u64>,
        positions: PyReadonlyArray2<'_, f64>,
        elements: Vec<Elements<'_>>,
    ) -> PyResult<Self> {
        let positions = pairs(py, &positions)?;
        let nodes: Vec<(u64, [f64; 2])> = tags.as_array().iter().copied().zip(positions).collect();
        let mut all = Vec::new();
        for (corners, group) in &elements {
            let rows = corners.as_array();
            let rows = rows.rows().into_iter();
            all.extend(rows.map(|row| Element {
                corners: row.to_vec(),
                group: group.as_deref(),
            }));
        }
        let mesh = gmsh::assemble(&nodes, &all);
        let mesh = mesh.map_err(|error| errors::of_body(py, &error.to_string()))?;
        Ok(Self {
            body: Arc::new(MeshBody::from(mesh)),
        })
    }

    /// Number of points.
    #[getter]
    fn n_points(&self) -> usize {
        self.body.positions().len()
    }

    /// Names of the groups.
    #[getter]
    fn groups(&self) -> Vec<String> {
        self.body.group_names()
    }
}

fn pairs(py: Python<'_>, rows: &PyReadonlyArray2<'_, f64>) -> PyResult<Vec<[f64; 2]>> {
    let rows = rows.as_array();
    if rows.ncols() != 2 {
        let fault = format!("positions have the shape (n, 2), found {:?}", rows.shape());
        return Err(errors::of_body(py, &fault));
    }
    Ok(rows
        .rows()
        .into_iter()
        .map(|row| [row[0], row[1]])
        .collect())
}
