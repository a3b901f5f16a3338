//! Cases.

use std::path::PathBuf;
use std::sync::OnceLock;

use ligament::body::AnyBody;
use ligament_case::case::CaseFile;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays::rows;
use crate::errors::{Failure, case_error, request_error};
use crate::{document, errors};

/// A checked case.
#[pyclass(frozen, module = "ligament._native")]
pub(crate) struct Case {
    pub(crate) file: CaseFile,
    body: OnceLock<AnyBody>,
}

#[pymethods]
impl Case {
    /// The case in a file, with overrides.
    #[staticmethod]
    fn load(py: Python<'_>, path: PathBuf, changes: &Bound<'_, PyDict>) -> PyResult<Self> {
        let overrides = document::overrides(changes)?;
        let file = CaseFile::load(&path, &overrides).map_err(|it| case_error(py, &it))?;
        Ok(Self::new(file))
    }

    /// The case in a text, with overrides; `path` is the path that its file would have.
    #[staticmethod]
    fn parse(
        py: Python<'_>,
        text: String,
        path: PathBuf,
        changes: &Bound<'_, PyDict>,
    ) -> PyResult<Self> {
        let overrides = document::overrides(changes)?;
        let file = CaseFile::parse(&path, text, &overrides).map_err(|it| case_error(py, &it))?;
        Ok(Self::new(file))
    }

    /// The case of sections in memory, with overrides; `path` is the path that its file would have.
    #[staticmethod]
    fn of_sections(
        py: Python<'_>,
        sections: &Bound<'_, PyDict>,
        path: PathBuf,
        changes: &Bound<'_, PyDict>,
    ) -> PyResult<Self> {
        let document = document::document(sections)?;
        let overrides = document::overrides(changes)?;
        let file = CaseFile::from_document(&path, document, &overrides);
        Ok(Self::new(file.map_err(|it| case_error(py, &it))?))
    }

    /// The case with further overrides.
    fn changed(&self, py: Python<'_>, changes: &Bound<'_, PyDict>) -> PyResult<Self> {
        let more = document::overrides(changes)?;
        let file = self.file.with_overrides(&more);
        Ok(Self::new(file.map_err(|it| case_error(py, &it))?))
    }

    /// Title of the case.
    #[getter]
    fn title(&self) -> &str {
        &self.file.case.title
    }

    /// Name of the case, by its file.
    #[getter]
    fn name(&self) -> String {
        self.file.name()
    }

    /// Path of the file of the case, or that it would have.
    #[getter]
    fn path(&self) -> PathBuf {
        self.file.source.path.clone()
    }

    /// Whether the case is an analysis of natural modes.
    #[getter]
    fn is_modal(&self) -> bool {
        self.file.case.modal.is_some()
    }

    /// Whether the case is a motion in time.
    #[getter]
    fn is_motion(&self) -> bool {
        self.file.case.motion.is_some()
    }

    /// The number at a key, as given or by default; `None` where there is none.
    fn number(&self, py: Python<'_>, key: &str) -> PyResult<Option<f64>> {
        let number = self.file.number(key);
        number.map_err(|error| request_error(py, &error.to_string()))
    }

    /// The case as TOML with all defaults.
    fn to_toml(&self, py: Python<'_>) -> PyResult<String> {
        let text = self.file.resolved_toml();
        text.map_err(|error| errors::request_error(py, &error.to_string()))
    }

    /// The given sections as TOML, with the changes to them.
    fn source(&self, py: Python<'_>) -> PyResult<String> {
        document::text(py, &self.file.source.document)
    }

    /// Number of points of the body.
    #[getter]
    fn n_points(&self, py: Python<'_>) -> PyResult<usize> {
        Ok(self.body(py)?.n_points())
    }

    /// Names of the groups of the body.
    #[getter]
    fn groups(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        Ok(self.body(py)?.group_names())
    }

    /// Whether the body is a solid.
    #[getter]
    fn is_solid(&self) -> bool {
        self.file.case.is_solid()
    }

    /// Positions of the points, in the order of the body's file: (n, 2) or (n, 3), m.
    fn positions<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let (body, in_space) = (self.body(py)?, self.is_solid());
        let positions: Vec<f64> = match body {
            AnyBody::Plane(body) => body
                .numbering()
                .to_file(body.positions().to_vec())
                .into_flattened(),
            AnyBody::Solid(body) => body
                .numbering()
                .to_file(body.positions().to_vec())
                .into_flattened(),
        };
        rows(py, positions, if in_space { 3 } else { 2 })
    }
}

impl Case {
    fn new(file: CaseFile) -> Self {
        Self {
            file,
            body: OnceLock::new(),
        }
    }

    /// The body of the case, which is read once.
    fn body(&self, py: Python<'_>) -> PyResult<&AnyBody> {
        if let Some(body) = self.body.get() {
            return Ok(body);
        }
        let read = py.detach(|| self.file.read_body(&mut ()));
        let body = read.map_err(|error| Failure::Other(error).exception(py))?;
        Ok(self.body.get_or_init(|| body))
    }
}
