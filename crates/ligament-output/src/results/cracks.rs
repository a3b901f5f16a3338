//! The cracks of a stored run, as lines.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use ligament_mesh::Cell;
use ligament_model::Canvas;
use ligament_model::crack::{CrackLine, Faces, Part, crack_lines};

use super::outputs::{OutputKind, Outputs, cut_pairs};
use crate::csv::read::Sheet;
use crate::vtu::read::VtuFile;
use crate::{Error, FieldLocation, vtu};

/// The faces of a body with the order in which a run opened them.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredCracks {
    /// Thickness of the body, its volume over its area, m.
    pub thickness: f64,
    faces: Faces,
    /// Horizons, shape (n_points), m.
    horizon: Vec<f64>,
    /// Faces that a pre-crack parts.
    cut: Vec<usize>,
    /// Faces that opened, in the order in which their bonds broke, with the place of the breakage in the order of all, from 1.
    opened: Vec<(usize, usize)>,
    /// Number of broken bonds at each row of the history, with the step.
    rows: Vec<(usize, usize)>,
}

impl StoredCracks {
    /// Reads them from the folder of a run.
    ///
    /// # Errors
    ///
    /// If the folder holds no results of a run under loads, or a file cannot be used.
    pub fn open(folder: &Path) -> Result<Self, Error> {
        let outputs = Outputs::list(folder)?;
        let first = outputs.files.first_key_value();
        let Some((_, path)) = first.filter(|_| outputs.kind == OutputKind::Steps) else {
            return Err(Error::NoResults {
                path: folder.to_path_buf(),
                reason: "it has natural modes, in which nothing breaks".to_owned(),
            });
        };
        let body = StoredBody::read(path)?;
        let faces = Faces::new(&body.positions, &body.canvas);
        let place = |tags: [i64; 2]| -> Option<usize> {
            let [a, b] = tags.map(|tag| body.places.get(&tag).copied());
            faces.between([a?, b?])
        };
        let cut = cut_pairs(folder)?.unwrap_or_default();
        let breaks = (1..).zip(broken_pairs(folder)?);
        let opened = breaks.filter_map(|(order, tags)| Some((place(tags)?, order)));
        let history = Sheet::read(folder.join("history.csv"))?;
        let rows = history.rows(|row| Ok((row.value("step")?, row.value("broken_bonds")?)))?;
        Ok(Self {
            thickness: body.thickness,
            cut: cut.into_iter().filter_map(place).collect(),
            opened: opened.collect(),
            horizon: body.horizon,
            rows,
            faces,
        })
    }

    /// The cracks in the state of a step: what pre-cracks parted is none, but cracks start there. Without such a step those of the
    /// last before it.
    pub fn lines(&self, step: usize) -> Vec<CrackLine> {
        self.lines_after(self.broken_until(step))
    }

    /// The cracks that the first so many breakages leave.
    pub fn lines_after(&self, broken: usize) -> Vec<CrackLine> {
        let mut parts = vec![Part::Whole; self.faces.len()];
        for &face in &self.cut {
            parts[face] = Part::PreCrack;
        }
        for (face, _) in self.opened.iter().take_while(|(_, order)| *order <= broken) {
            parts[*face] = Part::Open;
        }
        crack_lines(&self.faces, &parts, &self.horizon)
    }

    /// Number of broken bonds in the state of a step.
    fn broken_until(&self, step: usize) -> usize {
        let rows = self.rows.iter().take_while(|(at, _)| *at <= step);
        rows.last().map_or(0, |(_, broken)| *broken)
    }
}

/// Tags of the ends of the broken bonds, in the order of breaking.
fn broken_pairs(folder: &Path) -> Result<Vec<[i64; 2]>, Error> {
    let path: PathBuf = folder.join("breaks.csv");
    if !path.is_file() {
        return Ok(Vec::new());
    }
    let sheet = Sheet::read(path)?;
    let is_cell = sheet.columns().iter().any(|it| it == "cell_a");
    let [a, b] = if is_cell {
        ["cell_a", "cell_b"]
    } else {
        ["node_a", "node_b"]
    };
    sheet.rows(|row| Ok([row.value(a)?, row.value(b)?]))
}

/// A body as its fields are drawn on it.
struct StoredBody {
    positions: Vec<[f64; 2]>,
    canvas: Canvas,
    /// Horizons, shape (n_points), m.
    horizon: Vec<f64>,
    thickness: f64,
    /// Points by their tags.
    places: HashMap<i64, u32>,
}

impl StoredBody {
    fn read(path: &Path) -> Result<Self, Error> {
        let file = VtuFile::open(path)?;
        let corners = file.points()?;
        let cells: Option<Vec<Cell>> = file.cells()?.iter().map(planar).collect();
        let cells =
            cells.ok_or_else(|| file.strange("its cells are no triangles or quadrangles"))?;
        let area: f64 = cells.iter().map(|cell| cell.area(&corners).abs()).sum();
        let is_mesh = file.components(FieldLocation::Point, "horizon").is_some();
        let (location, positions, canvas) = if is_mesh {
            (FieldLocation::Point, corners, Canvas::Between(cells))
        } else {
            let (positions, squares) = squares(&cells, &corners);
            (FieldLocation::Cell, positions, Canvas::Around(squares))
        };
        let volumes = file.finite_numbers(location, "volume")?;
        let (_, tags) = file.tags(location)?;
        Ok(Self {
            positions,
            canvas,
            horizon: file.finite_numbers(location, "horizon")?,
            thickness: volumes.iter().sum::<f64>() / area,
            places: tags.into_iter().zip(0..).collect(),
        })
    }
}

fn planar(cell: &vtu::Cell) -> Option<Cell> {
    match *cell {
        vtu::Cell::Triangle(corners) => Some(Cell::Triangle(corners)),
        vtu::Cell::Quad(corners) => Some(Cell::Quadrangle(corners)),
        vtu::Cell::Vertex(_) | vtu::Cell::Line(_) => None,
    }
}

/// Middles and corners of the quadrangles of a lattice.
fn squares(cells: &[Cell], corners: &[[f64; 2]]) -> (Vec<[f64; 2]>, Vec<[[f64; 2]; 4]>) {
    let squares: Vec<[[f64; 2]; 4]> = (cells.iter())
        .filter_map(|cell| match cell {
            Cell::Quadrangle(numbers) => Some(numbers.map(|it| corners[it as usize])),
            Cell::Triangle(_) => None,
        })
        .collect();
    let middle = |square: &[[f64; 2]; 4]| {
        [0, 1].map(|axis| square.iter().map(|it| it[axis]).sum::<f64>() / 4.0)
    };
    (squares.iter().map(middle).collect(), squares)
}
