//! Cases.

use std::path::PathBuf;

use ligament::Setup;
use ligament::body::AnyBody;
use ligament_case::case::CaseFile;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::body::{Body, kind};
use crate::errors::{Failure, of_case, of_request};
use crate::{document, errors};

/// A checked case, with its body if that is in memory.
#[pyclass(frozen, module = "ligament._native")]
pub(crate) struct Case {
    pub(crate) file: CaseFile,
    pub(crate) body: Option<AnyBody>,
}

#[pymethods]
impl Case {
    /// The case in a file, with overrides.
    #[staticmethod]
    fn load(py: Python<'_>, path: PathBuf, changes: &Bound<'_, PyDict>) -> PyResult<Self> {
        let overrides = document::overrides(changes)?;
        let file = CaseFile::load(&path, &overrides).map_err(|it| of_case(py, &it))?;
        Ok(Self { file, body: None })
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
        let file = CaseFile::parse(&path, text, &overrides).map_err(|it| of_case(py, &it))?;
        Ok(Self { file, body: None })
    }

    /// The case of sections in memory, with overrides, on a body in memory or the body of its sections; `path` is the path that its file
    /// would have.
    #[staticmethod]
    fn of_sections(
        py: Python<'_>,
        sections: &Bound<'_, PyDict>,
        path: PathBuf,
        changes: &Bound<'_, PyDict>,
        body: Option<&Bound<'_, Body>>,
    ) -> PyResult<Self> {
        let document = document::document(sections)?;
        let overrides = document::overrides(changes)?;
        let body = body.map(|it| it.get().body.clone());
        let file = match &body {
            Some(body) => CaseFile::on_body(&path, document, &overrides, kind(body)),
            None => CaseFile::of_document(&path, document, &overrides),
        };
        Ok(Self {
            file: file.map_err(|it| of_case(py, &it))?,
            body,
        })
    }

    /// The case with further overrides.
    fn changed(&self, py: Python<'_>, changes: &Bound<'_, PyDict>) -> PyResult<Self> {
        let more = document::overrides(changes)?;
        let file = self
            .file
            .with_overrides(&more)
            .map_err(|it| of_case(py, &it))?;
        Ok(Self {
            file,
            body: self.body.clone(),
        })
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

    /// Whether the case is an analysis of natural modes.
    #[getter]
    fn is_modal(&self) -> bool {
        self.file.case.modal.is_some()
    }

    /// The number at a key, as given or by default; `None` where there is none.
    fn number(&self, py: Python<'_>, key: &str) -> PyResult<Option<f64>> {
        let number = self.file.number(key);
        number.map_err(|error| of_request(py, &error.to_string()))
    }

    /// The case as TOML with all defaults.
    fn to_toml(&self, py: Python<'_>) -> PyResult<String> {
        let text = self.file.resolved_toml();
        text.map_err(|error| errors::of_request(py, &error.to_string()))
    }
}

impl Case {
    /// The setup of the case on its body.
    pub(crate) fn setup(&self) -> Result<Setup, Failure> {
        Ok(match &self.body {
            Some(body) => self.file.setup_on(body.clone())?,
            None => self.file.setup(&mut ())?,
        })
    }
}
