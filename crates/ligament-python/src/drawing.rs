//! Pictures in memory.

use std::borrow::Cow;
use std::path::PathBuf;

use ligament_plot::drawing::Drawing;
use ligament_plot::picture::select::Choice;
use ligament_plot::picture::units::AxisUnit;
use ligament_plot::picture::{
    CrackDrawing, FieldRequest, Magnification, SolidRequest, Target, picture_of_fields,
};
use ligament_plot::plots::{Colour, Plot, Series};
use numpy::PyReadonlyArray1;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::errors;

/// Contents and style of a picture of a field.
#[derive(Debug, FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Wanted {
    /// Name of the result.
    label: String,
    /// Field with its component; `none` draws none.
    field: Option<String>,
    /// Factor on the displacement.
    scale: Option<f64>,
    /// `bonds` or `lines`.
    crack: Option<String>,
    /// Side from which a solid is seen.
    view: Option<String>,
    /// Plane of a section of a solid.
    section: Option<String>,
    /// Value of the field on a surface in a solid.
    level: Option<f64>,
    /// Width, mm.
    width: f64,
}

/// The picture of a step of the results in a folder, with its title.
#[pyfunction]
pub(crate) fn draw_fields(
    py: Python<'_>,
    folder: PathBuf,
    step: &str,
    wanted: Wanted,
) -> PyResult<(PythonDrawing, String)> {
    let request = request(folder, step, wanted).map_err(|it| errors::request_error(py, &it))?;
    let drawing = py.detach(|| picture_of_fields(&request));
    let (drawing, title) = drawing.map_err(|error| errors::program_error(py, &error))?;
    Ok((PythonDrawing(drawing), title))
}

fn request(folder: PathBuf, step: &str, wanted: Wanted) -> Result<FieldRequest, String> {
    let crack = match wanted.crack.as_deref() {
        None => None,
        Some("bonds") => Some(CrackDrawing::Bonds),
        Some("lines") => Some(CrackDrawing::Lines),
        Some(other) => return Err(format!("crack `{other}`: expected `bonds` or `lines`")),
    };
    Ok(FieldRequest {
        labels: vec![wanted.label],
        field: wanted.field,
        choice: Choice::Steps(vec![step.parse()?]),
        magnification: wanted
            .scale
            .map_or(Magnification::Auto, Magnification::Times),
        crack,
        solid: SolidRequest {
            view: wanted.view.map(|it| it.parse()).transpose()?,
            up: None,
            section: wanted.section.map(|it| it.parse()).transpose()?,
            level: wanted.level,
        },
        target: Target {
            width: Some(wanted.width),
            ..Target::default()
        },
        ..FieldRequest::default_for(folder)
    })
}

/// A picture in memory, which becomes a file of any kind.
#[pyclass(frozen, name = "Drawing", module = "ligament._native")]
pub(crate) struct PythonDrawing(Drawing);

#[pymethods]
impl PythonDrawing {
    /// The picture of a text that [`PythonDrawing::__getnewargs__`] gave, by which pictures are pickled and copied.
    #[new]
    fn new(text: &str) -> PyResult<Self> {
        let drawing = serde_json::from_str(text);
        (drawing.map(Self)).map_err(|error| PyValueError::new_err(error.to_string()))
    }

    fn __getnewargs__(&self) -> PyResult<(String,)> {
        let text = serde_json::to_string(&self.0);
        (text.map(|it| (it,))).map_err(|error| PyValueError::new_err(error.to_string()))
    }

    /// The text of the picture as SVG with a title.
    fn svg(&self, title: &str) -> String {
        self.0.to_svg(title)
    }

    /// The bytes of the picture as PNG with so many dots per inch.
    fn png(&self, py: Python<'_>, dpi: f64) -> PyResult<Cow<'static, [u8]>> {
        let bytes = self.0.to_png(dpi).map(Cow::Owned);
        bytes.map_err(|error| errors::request_error(py, &error.to_string()))
    }

    /// The bytes of the picture as PDF with a title.
    fn pdf(&self, title: &str) -> Cow<'static, [u8]> {
        Cow::Owned(self.0.to_pdf(title))
    }
}

/// A curve: its label, and its values along x and y.
type Curve<'py> = (
    String,
    PyReadonlyArray1<'py, f64>,
    PyReadonlyArray1<'py, f64>,
);

/// Curves of one quantity over another in a picture of a width (mm); each axis has a label and an SI unit.
#[pyfunction]
pub(crate) fn draw_curves(
    py: Python<'_>,
    curves: Vec<Curve<'_>>,
    x: (String, String),
    y: (String, String),
    title: String,
    width: f64,
) -> PyResult<PythonDrawing> {
    let values = |axis: usize| {
        let of = curves
            .iter()
            .map(move |it| if axis == 0 { &it.1 } else { &it.2 });
        of.flat_map(|it| it.as_array().to_vec())
    };
    let largest = |axis| {
        let sizes = values(axis).filter(|it| it.is_finite());
        sizes.fold(0.0, |largest, it| f64::max(largest, it.abs()))
    };
    let shown = [
        AxisUnit::new(&x.1, largest(0)),
        AxisUnit::new(&y.1, largest(1)),
    ];
    let colours = [Colour::Black].into_iter().chain(Colour::CYCLE).cycle();
    let series = curves.iter().zip(colours).map(|((label, x, y), colour)| {
        let (x, y) = (x.as_array(), y.as_array());
        let points = x.iter().zip(y.iter());
        let points = points.map(|(x, y)| [x * shown[0].factor, y * shown[1].factor]);
        Series::curve(label.clone(), colour, points.collect())
    });
    let labels = [shown[0].label(&x.0), shown[1].label(&y.0)];
    let plot = Plot::new("curves", title, [&labels[0], &labels[1]], series.collect());
    let drawing = plot.for_paper(width).map(PythonDrawing);
    drawing.map_err(|error| errors::request_error(py, &error.to_string()))
}
