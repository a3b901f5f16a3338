//! A solid, read from a file of fields.

use std::collections::HashMap;
use std::path::Path;

use ligament_mesh::SolidCell;
use ligament_model::{BodyGrid, Canvas, Numbering};

use super::point_fields::location;
use crate::vtu::read::VtuFile;
use crate::{Error, FieldLocation, vtu};

/// A solid of a run, with the location of its fields in a file.
#[derive(Debug, Clone, PartialEq)]
pub struct SolidBody {
    /// Points, their tags, and the cells of the body.
    pub grid: BodyGrid,
    /// Location of fields: on points with cells between them, or on cells, one for each point.
    pub location: FieldLocation,
    /// Indices of the points by their tags.
    places: HashMap<i64, u32>,
}

/// Whether the body of a file of fields is a solid.
///
/// # Errors
///
/// If its cells cannot be read.
pub fn is_solid(file: &VtuFile) -> Result<bool, Error> {
    let cells = file.cells()?;
    Ok(matches!(cells.first(), Some(vtu::Cell::Solid(_))))
}

impl SolidBody {
    /// Reads the body from a file of fields.
    ///
    /// # Errors
    ///
    /// If the file cannot be used, or has cells that are not of a solid.
    pub fn read(file: &VtuFile) -> Result<Self, Error> {
        let corners = file.points()?;
        let solid = |cell: vtu::Cell| match cell {
            vtu::Cell::Solid(cell) => Some(cell),
            _ => None,
        };
        let cells: Option<Vec<SolidCell>> = file.cells()?.into_iter().map(solid).collect();
        let cells = cells.ok_or_else(|| file.malformed("its cells are not those of a solid"))?;
        let location = location(file);
        let is_mesh = location == FieldLocation::Point;
        let (tagged, tags) = file.tags(location)?;
        let (positions, canvas) = match is_mesh {
            true => (corners, Canvas::Solid(cells)),
            false => {
                let boxes: Vec<[[f64; 3]; 2]> = cells.iter().map(|it| hull(it, &corners)).collect();
                let middle = |[low, high]: &[[f64; 3]; 2]| {
                    [0, 1, 2].map(|axis| 0.5 * (low[axis] + high[axis]))
                };
                (boxes.iter().map(middle).collect(), Canvas::Boxes(boxes))
            }
        };
        Ok(Self {
            places: tags.iter().copied().zip(0..).collect(),
            grid: BodyGrid {
                positions,
                numbering: Numbering::default(),
                cell_numbers: Vec::new(),
                of_body: None,
                tags,
                tagged,
                canvas,
            },
            location,
        })
    }

    /// Reads the body from the file of fields at a path.
    ///
    /// # Errors
    ///
    /// As for [`SolidBody::read`].
    pub fn open(path: &Path) -> Result<Self, Error> {
        Self::read(&VtuFile::open(path)?)
    }

    /// Indices of the points with these tags; `None` where a tag has no point.
    pub fn points(&self, tags: [i64; 2]) -> Option<[u32; 2]> {
        let [a, b] = tags.map(|tag| self.places.get(&tag).copied());
        Some([a?, b?])
    }

    /// Vectors at the points from a file, such as the displacement, shape (n_points).
    ///
    /// # Errors
    ///
    /// If the file has no such field, or the number of points differs.
    pub fn vectors(&self, file: &VtuFile, name: &str) -> Result<Vec<[f64; 3]>, Error> {
        let values = file.finite_numbers(self.location, name)?;
        let (vectors, rest) = values.as_chunks::<3>();
        match rest.is_empty() && vectors.len() == self.grid.positions.len() {
            true => Ok(vectors.to_vec()),
            false => Err(file.malformed(format!("{name} has no vector a point"))),
        }
    }
}

/// Lowest and highest coordinates of the corners of a cell.
fn hull(cell: &SolidCell, corners: &[[f64; 3]]) -> [[f64; 3]; 2] {
    let mut hull = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
    for &corner in cell.corners() {
        for (axis, x) in corners[corner as usize].into_iter().enumerate() {
            hull[0][axis] = hull[0][axis].min(x);
            hull[1][axis] = hull[1][axis].max(x);
        }
    }
    hull
}
