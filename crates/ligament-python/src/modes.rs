//! Natural modes, as arrays.

use ligament::run::on_threads;
use ligament::setup::Analysis;
use ligament::{Fault, Field, Model, Setup, SetupError, Vibration};
use ligament_analysis::Layout;
use ligament_analysis::modal::{ModalAnalysis, ModalOutcome, Mode};
use ligament_case::case::CaseFile;
use ligament_model::BodyGrid;
use ligament_output::results::fields::{DISPLACEMENT, STRAIN_ENERGY_DENSITY, vectors};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays::{array, rows};
use crate::case::Case;
use crate::errors::Failure;
use crate::solution::watched;

/// Finds the natural modes of a case: arrays over the modes, and for each mode a shape over the points.
#[pyfunction]
pub(crate) fn modes<'py>(py: Python<'py>, case: &Bound<'py, Case>) -> PyResult<Bound<'py, PyDict>> {
    let case = case.get();
    let (found, stopped) = watched(py, None, |_, _| find(case))?;
    if stopped {
        return Err(Failure::Stopped.exception(py));
    }
    let Found {
        outcome,
        warnings,
        layout,
        grid,
    } = found.map_err(|failure| failure.exception(py))?;
    let named = PyDict::new(py);
    let of = |value: fn(&Mode) -> f64| -> Vec<f64> { outcome.modes.iter().map(value).collect() };
    named.set_item("frequency", array(py, of(Mode::frequency)))?;
    named.set_item("eigenvalue", array(py, of(|it| it.eigenvalue)))?;
    named.set_item("residual", array(py, of(|it| it.residual)))?;
    let kinds: Vec<&str> = outcome.modes.iter().map(|it| it.kind.name()).collect();
    named.set_item("kind", kinds)?;
    let participation = outcome.modes.iter().flat_map(|it| it.participation.clone());
    let n = outcome.modes.first().map_or(3, |it| it.participation.len());
    named.set_item("participation", rows(py, participation.collect(), n)?)?;
    named.set_item("mass", outcome.moving.total)?;
    named.set_item("complete", outcome.complete)?;
    named.set_item("warnings", warnings)?;
    named.set_item("position", positions(py, &grid.in_order_of_file())?)?;
    let numbering = &grid.numbering;
    let mut shapes = Vec::new();
    for mode in outcome.modes {
        let of_mode = PyDict::new(py);
        let displacement = numbering.to_file(vectors(layout, &mode.shape));
        of_mode.set_item(DISPLACEMENT.name, rows(py, displacement, 3)?)?;
        of_mode.set_item(
            STRAIN_ENERGY_DENSITY.name,
            array(py, numbering.to_file(mode.strain_energy_density)),
        )?;
        shapes.push(of_mode);
    }
    named.set_item("shapes", shapes)?;
    Ok(named)
}

/// Natural modes of a model.
struct Found {
    outcome: ModalOutcome,
    /// Warnings about the model and the modes.
    warnings: Vec<String>,
    /// Layout of the shapes.
    layout: Layout,
    /// Grid of the body.
    grid: BodyGrid,
}

fn find(case: &Case) -> Result<Found, Failure> {
    let setup = case.setup()?;
    let found = on_threads(setup.threads, || find_here(&case.file, setup));
    found.map_err(|error| Failure::Other(error.into()))?
}

fn find_here(case: &CaseFile, setup: Setup) -> Result<Found, Failure> {
    let Analysis::Modal(settings) = setup.analysis else {
        let fault = Fault::OtherAnalysis {
            found: setup.analysis.name(),
            wanted: "natural modes",
        };
        let error = SetupError {
            field: Field {
                name: "analysis",
                index: None,
                part: None,
            },
            fault: Box::new(fault),
        };
        return Err(Failure::setup(case, error));
    };
    let located = |error| Failure::setup(case, error);
    let other = |error: ligament::Error| Failure::computing(case, error);
    let model = Model::build(setup, &mut ()).map_err(located)?;
    let vibration = Vibration::new(&model).map_err(located)?;
    let problem = vibration.problem(&model);
    let analysis = ModalAnalysis::new(&problem, settings).map_err(|it| other(it.into()))?;
    let outcome = analysis.find().map_err(|it| other(it.into()))?;
    let warnings = model.warnings.iter().map(ToString::to_string);
    let notices = outcome.notices.iter().map(ToString::to_string);
    Ok(Found {
        warnings: warnings.chain(notices).collect(),
        layout: model.system.layout(),
        grid: model.body().grid(),
        outcome,
    })
}

/// Positions of the points, m: (n_points, 2) in the plane, (n_points, 3) in space.
fn positions<'py>(py: Python<'py>, grid: &BodyGrid) -> PyResult<Bound<'py, PyAny>> {
    match grid.canvas.is_solid() {
        true => rows(py, grid.positions.as_flattened().to_vec(), 3),
        false => rows(py, grid.positions_in_plane().into_flattened(), 2),
    }
}
