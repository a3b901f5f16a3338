//! Arrays over the points and the bonds of a stored run.

use std::collections::HashMap;
use std::path::Path;

use super::cracks::{columns_of_ends, tag_pair};
use super::location;
use super::model_file::{DISSIPATED_ENERGY, model_file};
use crate::csv::read::CsvTable;
use crate::vtu::Cell;
use crate::vtu::read::VtuFile;
use crate::{Error, FieldLocation};

/// The bonds of a stored run before the first load.
#[derive(Debug, Clone, PartialEq)]
pub struct BondArrays {
    /// Positions of the points, shape (n_points), m; z = 0 in the plane.
    pub positions: Vec<[f64; 3]>,
    /// Ends, indices of points, shape (n_bonds).
    pub ends: Vec<[u32; 2]>,
    /// Bond horizons, shape (n_bonds), m, in single precision.
    pub horizon: Vec<f64>,
    /// Factors on the bonds' volumes, alpha times Omega, shape (n_bonds), in single precision.
    pub weight: Vec<f64>,
    /// Step in which each bond broke, -1 for intact bonds, shape (n_bonds).
    pub step_of_breaking: Vec<i64>,
    /// Energy that each bond dissipated, shape (n_bonds), J; none where the run has not ended, or has no failure criterion.
    pub dissipated_energy: Option<Vec<f64>>,
}

impl BondArrays {
    /// Reads the bonds; `None` where the run wrote no model.
    ///
    /// # Errors
    ///
    /// If a file cannot be used.
    pub fn read(folder: &Path) -> Result<Option<Self>, Error> {
        let Some(path) = model_file(folder) else {
            return Ok(None);
        };
        let file = VtuFile::open(path)?;
        let location = FieldLocation::Cell;
        let absent = file.required_integers(location, "absent")?;
        let of_bonds = |values: Vec<f64>| -> Vec<f64> {
            let bonds = values.into_iter().zip(&absent);
            bonds.filter(|it| *it.1 == 0).map(|it| it.0).collect()
        };
        let numbers = |name| file.required_numbers(location, name).map(of_bonds);
        let ends = file.lines()?.into_iter().zip(&absent);
        let ends: Vec<[u32; 2]> = ends.filter(|it| *it.1 == 0).map(|it| it.0).collect();
        let (alpha, omega) = (numbers("length_factor")?, numbers("domain_factor")?);
        let dissipated = file.numbers(location, DISSIPATED_ENERGY)?;
        let (_, tags) = file.tags(FieldLocation::Point)?;
        let sheet = CsvTable::read(folder.join("breaks.csv"))?;
        let columns = columns_of_ends(&sheet);
        let broken = sheet.rows(|row| Ok((tag_pair(row, &columns)?, row.value("step")?)))?;
        let steps = steps_of(&tags, &ends, broken).into_iter();
        Ok(Some(Self {
            positions: file.points()?,
            horizon: numbers("horizon")?,
            weight: alpha
                .iter()
                .zip(omega)
                .map(|(alpha, omega)| alpha * omega)
                .collect(),
            step_of_breaking: steps.map(|it| it.map_or(-1, |step| step as i64)).collect(),
            dissipated_energy: dissipated.map(of_bonds),
            ends,
        }))
    }
}

/// The step of an event of each bond (n_bonds), given by its ends, from the tags of the ends and the steps of the bonds with the event.
pub(super) fn steps_of(
    tags: &[i64],
    ends: &[[u32; 2]],
    events: Vec<([i64; 2], usize)>,
) -> Vec<Option<usize>> {
    let steps: HashMap<[i64; 2], usize> = events.into_iter().collect();
    let step = |ends: &[u32; 2]| {
        let [a, b] = ends.map(|point| tags[point as usize]);
        let step = steps.get(&[a, b]).or_else(|| steps.get(&[b, a]));
        step.copied()
    };
    ends.iter().map(step).collect()
}

/// Positions of the points from a file of fields, shape (n_points), m; for cells around points, the middles of the cells.
///
/// # Errors
///
/// If the file cannot be used.
pub fn positions_of_fields(file: &VtuFile) -> Result<Vec<[f64; 3]>, Error> {
    let corners = file.points()?;
    if location(file) == FieldLocation::Point {
        return Ok(corners);
    }
    let middle = |cell: &Cell| {
        let points = cell.points();
        let sum = |axis: usize| {
            points
                .iter()
                .map(|it| corners[*it as usize][axis])
                .sum::<f64>()
        };
        [0, 1, 2].map(|axis| sum(axis) / points.len() as f64)
    };
    Ok(file.cells()?.iter().map(middle).collect())
}
