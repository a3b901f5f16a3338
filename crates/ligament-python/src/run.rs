//! Results of a run, as arrays.

use ligament_analysis::driver::Outcome;
use ligament_mesh::Cell;
use ligament_model::{Absence, BodyGrid, Canvas, ConstantFields, box_corners};
use ligament_output::results::cracks::{SeparatedPairs, StoredCracks};
use ligament_output::results::fields::{
    FieldValues, HORIZON, NEAREST_DISTANCE, PATCH_RESIDUAL, PRECRACK_SHARE, ResultField, VOLUME,
};
use ligament_output::results::{Happened, PointFields, first_field};
use numpy::PyReadonlyArray1;
use numpy::PyReadonlyArray2;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays::{array, rows};
use crate::case::Case;
use crate::collector::Kept;
use crate::drawing::{self, Drawn, Picture};
use crate::errors;
use crate::in_file::in_order_of_file;
use crate::solution::{Solved, solve, watched};

/// Results of a run.
#[pyclass(frozen, module = "ligament._native")]
pub(crate) struct Run {
    /// Columns of the history.
    #[pyo3(get)]
    history: Py<PyDict>,
    /// Columns of the breakages, in the order of breaking.
    #[pyo3(get)]
    breaks: Py<PyDict>,
    /// Arrays over the points.
    #[pyo3(get)]
    points: Py<PyDict>,
    /// Arrays over the bonds.
    #[pyo3(get)]
    bonds: Py<PyDict>,
    /// Arrays over the points by step and name.
    #[pyo3(get)]
    fields: Py<PyDict>,
    /// Cells for drawing fields, by their kind.
    #[pyo3(get)]
    cells: Py<PyDict>,
    /// Summary of the run, as JSON.
    #[pyo3(get)]
    summary: String,
    /// Kind of the points' tags, `node`, `cell` or `point`.
    #[pyo3(get)]
    tagged: &'static str,
    /// Name of the field that shows best what happened.
    #[pyo3(get)]
    first_field: &'static str,
    grid: BodyGrid,
    /// Cracks; none for a solid.
    cracks: Option<StoredCracks>,
}

/// A line of a crack: vertices (n, 2), m, kinds of the ends, and length, m.
type Line<'py> = (Bound<'py, PyAny>, [&'static str; 2], f64);

/// Runs a case; calls `report` with step, load factor, displacement, force and number of broken bonds for each record. Returns the run, and
/// whether Ctrl-C stopped it.
#[pyfunction]
pub(crate) fn run(
    py: Python<'_>,
    case: &Bound<'_, Case>,
    report: Option<&Bound<'_, PyAny>>,
) -> PyResult<(Run, bool)> {
    let case = case.get();
    let (solved, stopped) = watched(py, report, |sender, stop| solve(case, sender, stop))?;
    let solved = solved.map_err(|failure| failure.exception(py))?;
    Ok((Run::new(py, in_order_of_file(solved))?, stopped))
}

/// Names of the components of a field in the plane or in space; none of other fields than tensors.
#[pyfunction]
pub(crate) fn component_names(field: &str, in_space: bool) -> Vec<&'static str> {
    ResultField::named(field).map_or_else(Vec::new, |it| it.components(in_space).names().to_vec())
}

#[pymethods]
impl Run {
    /// The cracks in the state of a step, as lines.
    fn cracks<'py>(&self, py: Python<'py>, step: usize) -> PyResult<Vec<Line<'py>>> {
        self.require_plane(py, "lines of cracks are")?;
        let lines = self.cracks.iter().flat_map(|it| it.lines(step));
        lines
            .map(|line| {
                let (length, ends) = (line.length(), line.ends.map(|end| end.word()));
                Ok((rows(py, line.places.into_flattened(), 2)?, ends, length))
            })
            .collect()
    }

    /// A picture of a field (n_points), given by a description of its quantity, its name and a title, on the body moved by a displacement
    /// (n_points, 3).
    fn draw(
        &self,
        py: Python<'_>,
        named: (String, String, String),
        values: PyReadonlyArray1<'_, f64>,
        displacement: PyReadonlyArray2<'_, f64>,
        width: f64,
    ) -> PyResult<Drawn> {
        self.require_plane(py, "pictures in memory are")?;
        let moved = displacement.as_array();
        let (quantity, field, title) = named;
        let picture = Picture {
            grid: &self.grid,
            quantity,
            field: &field,
            values: values.as_array().to_vec(),
            displacements: moved.rows().into_iter().map(|it| [it[0], it[1]]).collect(),
            title,
        };
        let drawn = drawing::drawn(picture, width);
        drawn.map_err(|error| errors::of_request(py, &error.to_string()))
    }
}

impl Run {
    fn new(py: Python<'_>, solved: Solved) -> PyResult<Self> {
        let (cracks, first_field) = (cracks(&solved), first_field_of(&solved));
        let Solved {
            fixed: of_points,
            arrays,
            grid,
            outcome,
            kept,
            summary,
            ..
        } = solved;
        let Kept {
            history,
            breaks,
            fields,
            step_of_breaking,
            ..
        } = kept;
        let by_step = PyDict::new(py);
        for (step, of_step) in fields {
            by_step.set_item(step, named(py, of_step, grid.canvas.is_solid())?)?;
        }
        let points = PyDict::new(py);
        points.set_item(grid.tagged, array(py, grid.tags.clone()))?;
        points.set_item("position", positions(py, &grid)?)?;
        fixed(&points, of_points)?;
        points.set_item(VOLUME.name, array(py, arrays.volumes))?;
        points.set_item(NEAREST_DISTANCE.name, array(py, arrays.spacing))?;
        let bonds = PyDict::new(py);
        bonds.set_item("step_of_breaking", array(py, step_of_breaking))?;
        of_outcome(&bonds, outcome)?;
        bonds.set_item("ends", rows(py, arrays.ends.into_flattened(), 2)?)?;
        bonds.set_item("length", array(py, arrays.length))?;
        bonds.set_item("horizon", array(py, arrays.horizon))?;
        bonds.set_item("weight", array(py, arrays.weight))?;
        Ok(Self {
            history: history.into_columns(py)?.unbind(),
            breaks: breaks.into_columns(py)?.unbind(),
            points: points.unbind(),
            bonds: bonds.unbind(),
            fields: by_step.unbind(),
            cells: cells(py, &grid)?.unbind(),
            summary,
            tagged: grid.tagged,
            first_field,
            grid,
            cracks,
        })
    }

    /// Refuses a solid, for which there are no lines and maps.
    fn require_plane(&self, py: Python<'_>, what: &str) -> PyResult<()> {
        if self.grid.canvas.is_solid() {
            let fault = format!(
                "{what} of a body in the plane, and this one is a solid; `to_pyvista` gives the whole body, and the command `ligament` \
                 draws stored results of solids (`plot`) and finds the surfaces of their cracks (`crack`)"
            );
            return Err(errors::of_request(py, &fault));
        }
        Ok(())
    }
}

/// Name of the field that shows best what happened in a run.
fn first_field_of(solved: &Solved) -> &'static str {
    let softened = &solved.outcome.state.softening.largest;
    let happened = if softened.iter().flatten().any(|it| *it > 1.0) {
        Happened::Softened
    } else if !solved.kept.broken.is_empty() {
        Happened::Broke
    } else {
        Happened::Nothing
    };
    let last = solved.kept.fields.last();
    let largest = |name: &str| {
        let field = last.and_then(|(_, fields)| fields.iter().find(|it| it.0.name == name));
        match field {
            Some((_, FieldValues::Numbers(values))) => values.iter().copied().fold(0.0, f64::max),
            _ => 0.0,
        }
    };
    first_field(happened, largest).name
}

/// The cracks of a body in the plane; `None` for a solid.
fn cracks(solved: &Solved) -> Option<StoredCracks> {
    let Solved {
        fixed,
        grid,
        outcome,
        kept,
        ..
    } = solved;
    if grid.canvas.is_solid() {
        return None;
    }
    let absent = fixed.absent.iter();
    let cut = absent.filter(|it| it.absence == Absence::PreCrack);
    let cut: Vec<[u32; 2]> = cut.map(|it| it.ends).collect();
    let parted = SeparatedPairs {
        cut: &cut,
        broken: &kept.broken,
        softened: &kept.opened,
    };
    let (horizon, thickness) = (fixed.horizon.clone(), solved.thickness);
    let history = &outcome.history;
    Some(StoredCracks::in_memory(
        grid, horizon, thickness, &parted, history,
    ))
}

/// Fields of the points by their names.
fn named(py: Python<'_>, fields: PointFields, in_space: bool) -> PyResult<Bound<'_, PyDict>> {
    let named = PyDict::new(py);
    for (field, values) in fields {
        let values = match (values, field.components(in_space).count()) {
            (FieldValues::Numbers(values), 1) => array(py, values),
            (FieldValues::Numbers(values), columns) => rows(py, values, columns)?,
            (FieldValues::Integers(values), _) => array(py, values),
        };
        named.set_item(field.name, values)?;
    }
    Ok(named)
}

/// Adds the fields of the points that do not change.
fn fixed(points: &Bound<'_, PyDict>, fixed: ConstantFields) -> PyResult<()> {
    let py = points.py();
    let ratios = fixed.energy_ratios.into_iter();
    let mut fields = vec![
        (HORIZON.name, fixed.horizon),
        (PRECRACK_SHARE.name, fixed.precrack_share),
    ];
    fields.extend(ratios.map(|it| (it.field, it.at_points)));
    fields.push((PATCH_RESIDUAL.name, fixed.patch_residual));
    for (name, values) in fields {
        if !values.is_empty() {
            points.set_item(name, array(py, values))?;
        }
    }
    if let Some(scatter) = fixed.scatter {
        points.set_item(scatter.of.field(), array(py, scatter.at_points))?;
    }
    Ok(())
}

/// Adds the arrays over the bonds in the last state.
fn of_outcome(bonds: &Bound<'_, PyDict>, outcome: Outcome) -> PyResult<()> {
    let py = bonds.py();
    bonds.set_item("intact", array(py, outcome.state.intact))?;
    bonds.set_item("dissipated_energy", array(py, outcome.state.dissipated))
}

/// Positions of the points, m: (n_points, 2) in the plane, (n_points, 3) in space.
pub(crate) fn positions<'py>(py: Python<'py>, grid: &BodyGrid) -> PyResult<Bound<'py, PyAny>> {
    match grid.canvas.is_solid() {
        true => rows(py, grid.positions.as_flattened().to_vec(), 3),
        false => rows(py, grid.positions_in_plane().into_flattened(), 2),
    }
}

/// Cells for drawing fields: `triangles` (n, 3) and `quadrangles` (n, 4) between the points, or `corners` (n_points, 4, 2) of the cell
/// around each point. In space `tetrahedra`, `pyramids`, `prisms` and `hexahedra`, or the `corners` (n_points, 8, 3) of boxes.
fn cells<'py>(py: Python<'py>, grid: &BodyGrid) -> PyResult<Bound<'py, PyDict>> {
    let cells = PyDict::new(py);
    match &grid.canvas {
        Canvas::Between(all) => {
            let (mut triangles, mut quadrangles) = (Vec::new(), Vec::new());
            for cell in all {
                match cell {
                    Cell::Triangle(corners) => triangles.extend(corners.map(i64::from)),
                    Cell::Quadrangle(corners) => quadrangles.extend(corners.map(i64::from)),
                }
            }
            cells.set_item("triangles", rows(py, triangles, 3)?)?;
            cells.set_item("quadrangles", rows(py, quadrangles, 4)?)?;
        }
        Canvas::Around(squares) => {
            let corners: Vec<f64> = squares.as_flattened().as_flattened().to_vec();
            cells.set_item("corners", rows(py, corners, 2)?)?;
        }
        Canvas::Solid(all) => {
            let of_kind = |n_corners: usize| -> Vec<i64> {
                let of_kind = all.iter().filter(|it| it.corners().len() == n_corners);
                of_kind
                    .flat_map(|it| it.corners())
                    .map(|&it| i64::from(it))
                    .collect()
            };
            let kinds = [
                ("tetrahedra", 4),
                ("pyramids", 5),
                ("prisms", 6),
                ("hexahedra", 8),
            ];
            for (name, n_corners) in kinds {
                cells.set_item(name, rows(py, of_kind(n_corners), n_corners)?)?;
            }
        }
        Canvas::Boxes(boxes) => {
            let corners = boxes.iter().flat_map(|it| box_corners(*it)).flatten();
            cells.set_item("corners", rows(py, corners.collect(), 3)?)?;
        }
    }
    Ok(cells)
}
