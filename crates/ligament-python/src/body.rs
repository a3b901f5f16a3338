//! Bodies from arrays.

use ligament::body::{self, AnyBody, MeshBody, Points, SolidMeshBody};
use ligament_case::case::BodyKind;
use ligament_mesh::AnyMesh;
use ligament_mesh::gmsh::{self, Element};
use numpy::{PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;

use crate::errors;

/// Kind of a body.
pub(crate) fn kind(body: &AnyBody) -> BodyKind {
    match body {
        AnyBody::Plane(_) => BodyKind::Plane,
        AnyBody::Solid(_) => BodyKind::Solid,
    }
}

/// A body of a setup, of any origin.
#[pyclass(frozen, module = "ligament._native")]
pub(crate) struct Body {
    pub(crate) body: AnyBody,
}

/// Elements of a mesh: dimension, tags of the corners, shape (n, corners), and name of their group.
type Elements<'py> = (u8, PyReadonlyArray2<'py, u64>, Option<String>);

#[pymethods]
impl Body {
    /// A body of points at positions (n, 2) or (n, 3), m, with areas, m^2, or volumes, m^3, (n), and groups by indices.
    #[staticmethod]
    fn of_points(
        py: Python<'_>,
        positions: PyReadonlyArray2<'_, f64>,
        sizes: PyReadonlyArray1<'_, f64>,
        groups: Vec<(String, Vec<u32>)>,
    ) -> PyResult<Self> {
        let sizes = sizes.as_array().to_vec();
        let body = match positions.as_array().ncols() {
            3 => {
                let points: Points<3> = points(py, positions_of(py, &positions)?, sizes, groups)?;
                AnyBody::new(points)
            }
            _ => {
                let points: Points = points(py, positions_of(py, &positions)?, sizes, groups)?;
                AnyBody::new(points)
            }
        };
        Ok(Self { body })
    }

    /// A meshed body: tags of the nodes (n), their positions (n, 3), and elements with their groups.
    #[staticmethod]
    fn of_mesh(
        py: Python<'_>,
        tags: PyReadonlyArray1<'_, u64>,
        positions: PyReadonlyArray2<'_, f64>,
        elements: Vec<Elements<'_>>,
    ) -> PyResult<Self> {
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
        let mesh = gmsh::assemble(&nodes, &all);
        let mesh = mesh.map_err(|error| errors::of_body(py, &error.to_string()))?;
        let body = match mesh {
            AnyMesh::Plane(mesh) => AnyBody::new(MeshBody::from(mesh)),
            AnyMesh::Solid(mesh) => AnyBody::new(SolidMeshBody::from(mesh)),
        };
        Ok(Self { body })
    }

    /// Number of points.
    #[getter]
    fn n_points(&self) -> usize {
        self.body.n_points()
    }

    /// Names of the groups.
    #[getter]
    fn groups(&self) -> Vec<String> {
        self.body.group_names()
    }

    /// Whether the body is a solid.
    #[getter]
    fn is_solid(&self) -> bool {
        kind(&self.body) == BodyKind::Solid
    }
}

fn points<const D: usize>(
    py: Python<'_>,
    positions: Vec<[f64; D]>,
    sizes: Vec<f64>,
    groups: Vec<(String, Vec<u32>)>,
) -> PyResult<Points<D>> {
    let fault = |error: body::PointsError| errors::of_body(py, &error.to_string());
    let mut points = Points::new(positions, sizes).map_err(fault)?;
    for (name, indices) in groups {
        points = points.with_group(&name, indices).map_err(fault)?;
    }
    Ok(points)
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
        return Err(errors::of_body(py, &fault));
    }
    let rows = rows.rows().into_iter();
    Ok(rows
        .map(|row| std::array::from_fn(|axis| row[axis]))
        .collect())
}
