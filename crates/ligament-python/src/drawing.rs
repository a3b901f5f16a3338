//! Pictures of results in memory.

use std::borrow::Cow;

use ligament_mesh::Cell;
use ligament_model::{BodyGrid, Canvas};
use ligament_output::results::fields::unit_of;
use ligament_output::vtu;
use ligament_plot::drawing::Drawing;
use ligament_plot::picture::PictureError;
use ligament_plot::picture::maps::{MappedBody, Maps};
use ligament_plot::picture::units::Shown;
use ligament_plot::plots::{Colour, Plot, Series};
use numpy::PyReadonlyArray1;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::errors;

/// A field on a body.
pub(crate) struct Picture<'a> {
    pub(crate) grid: &'a BodyGrid,
    /// Description of the quantity.
    pub(crate) quantity: String,
    /// Name of the field, which determines the unit.
    pub(crate) field: &'a str,
    /// Values, shape (n_points).
    pub(crate) values: Vec<f64>,
    /// Displacements of the points, shape (n_points), m.
    pub(crate) displacements: Vec<[f64; 2]>,
    pub(crate) title: String,
}

/// The picture with a width, mm.
pub(crate) fn drawn(picture: Picture<'_>, width: f64) -> Result<Drawn, PictureError> {
    let Picture {
        grid,
        values,
        displacements,
        ..
    } = picture;
    let body = match &grid.canvas {
        Canvas::Around(squares) => MappedBody::of_squares("", squares, &displacements, values),
        Canvas::Between(cells) => {
            let drawn = |cell: &Cell| match *cell {
                Cell::Triangle(corners) => vtu::Cell::Triangle(corners),
                Cell::Quadrangle(corners) => vtu::Cell::Quad(corners),
            };
            let cells = cells.iter().map(drawn).collect();
            MappedBody::of_mesh("", grid.positions_in_plane(), cells, displacements, values)
        }
        Canvas::Solid(_) | Canvas::Boxes(_) => {
            return Err(PictureError::Solid("a map from memory"));
        }
    };
    let maps = Maps {
        name: picture.field.to_owned(),
        title: picture.title,
        quantity: picture.quantity,
        unit: unit_of(picture.field),
        bodies: vec![body],
        columns: 1,
        are_modes: false,
    };
    maps.draw(width).map(Drawn)
}

/// A picture in memory, which becomes a file of any kind.
#[pyclass(frozen, name = "Drawing", module = "ligament._native")]
pub(crate) struct Drawn(Drawing);

#[pymethods]
impl Drawn {
    /// The picture of a text that [`Drawn::__getnewargs__`] gave, by which pictures are pickled and copied.
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
        bytes.map_err(|error| errors::of_request(py, &error.to_string()))
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
) -> PyResult<Drawn> {
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
    let shown = [Shown::new(&x.1, largest(0)), Shown::new(&y.1, largest(1))];
    let colours = [Colour::Black].into_iter().chain(Colour::CYCLE).cycle();
    let series = curves.iter().zip(colours).map(|((label, x, y), colour)| {
        let (x, y) = (x.as_array(), y.as_array());
        let points = x.iter().zip(y.iter());
        let points = points.map(|(x, y)| [x * shown[0].factor, y * shown[1].factor]);
        Series::curve(label.clone(), colour, points.collect())
    });
    let labels = [shown[0].label(&x.0), shown[1].label(&y.0)];
    let plot = Plot::new("curves", title, [&labels[0], &labels[1]], series.collect());
    let drawing = plot.for_paper(width).map(Drawn);
    drawing.map_err(|error| errors::of_request(py, &error.to_string()))
}
