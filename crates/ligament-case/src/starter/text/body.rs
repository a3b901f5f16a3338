//! The body of a starter case, and numbers and strings in the form of a case.

use ligament::setup::is_unseen;
use ligament_mesh::Group;
use ligament_mesh::gmsh::CoordinatePlane;
use toml_edit::Value;

/// Body of a starter case.
pub(in crate::starter) struct Body<const D: usize> {
    /// Name of the body, for the title.
    pub(in crate::starter) name: String,
    /// Origin of the body.
    pub(in crate::starter) section: Section<D>,
    /// Groups with a material each; empty where one material fills the body.
    pub(in crate::starter) parts: Vec<String>,
    /// Lowest and highest corner of the body's bounding box, m.
    pub(in crate::starter) extent: [[f64; D]; 2],
    /// Position in the middle of the body, m.
    pub(in crate::starter) middle: [f64; D],
    /// Two positions on the body whose distance along the load is an opening, m.
    pub(in crate::starter) opening: [[f64; D]; 2],
    /// Spacing of the points, m.
    pub(in crate::starter) spacing: f64,
}

/// Origin of a body.
pub(in crate::starter) enum Section<const D: usize> {
    /// Body from a mesh file.
    Mesh {
        file: (String, CoordinatePlane),
        groups: Vec<Group>,
    },
    /// Body from a lattice, with `rows` rows or layers fixed and as many moved.
    Lattice { cells: [u32; D], rows: u32 },
}

/// Side of the box around a body along an axis, m.
pub(super) fn size<const D: usize>(body: &Body<D>, axis: usize) -> f64 {
    body.extent[1][axis] - body.extent[0][axis]
}

/// A TOML string with invisible characters escaped.
pub(in crate::starter) fn quoted(text: &str) -> String {
    if !text.contains(is_unseen) {
        return Value::from(text).to_string().trim().to_owned();
    }
    let shown = text.chars().map(|letter| match letter {
        '"' | '\\' => format!("\\{letter}"),
        _ if is_unseen(letter) => format!("\\u{:04X}", u32::from(letter)),
        _ => letter.to_string(),
    });
    format!("\"{}\"", shown.collect::<String>())
}

/// Rounding step of coordinates: a power of ten, at most a tenth of the spacing of points.
#[derive(Clone, Copy)]
pub(super) struct Quantum {
    pub(super) step: f64,
    exponent: i32,
}

pub(super) fn quantum<const D: usize>(body: &Body<D>) -> Quantum {
    let exponent = body.spacing.log10().floor() as i32 - 1;
    Quantum {
        step: 10_f64.powi(exponent),
        exponent,
    }
}

impl Quantum {
    pub(super) fn round(self, value: f64) -> f64 {
        let rounded = (value / self.step).round();
        // Division by a power of ten gives the nearest decimal, multiplication by a rounded 0.0001 does not.
        let rounded = if self.exponent < 0 {
            rounded / 10_f64.powi(-self.exponent)
        } else {
            rounded * self.step
        };
        rounded + 0.0
    }
}

/// A number rounded to `count` significant digits.
pub(in crate::starter) fn digits(value: f64, count: usize) -> f64 {
    format!("{value:.*e}", count - 1).parse().unwrap_or(value)
}

/// Text of a number for a sentence.
pub(super) fn short(value: f64) -> String {
    exact(digits(value, 4))
}

/// Text of a number in TOML, with a point or an exponent.
pub(in crate::starter) fn exact(value: f64) -> String {
    let size = value.abs();
    if size != 0.0 && !(1e-3..1e5).contains(&size) {
        format!("{value:e}")
    } else {
        format!("{value:?}")
    }
}

/// Text of a list of coordinates, rounded to the quantum of the body.
pub(super) fn coordinates<const D: usize>(body: &Body<D>, position: [f64; D]) -> String {
    let quantum = quantum(body);
    let rounded: Vec<String> = position
        .iter()
        .map(|it| exact(quantum.round(*it)))
        .collect();
    format!("[{}]", rounded.join(", "))
}
