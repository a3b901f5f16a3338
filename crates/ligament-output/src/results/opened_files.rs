//! File of the cells of a solid, opened along its cracks.

use std::path::Path;

use ligament_analysis::result_fields::{DAMAGE, DISPLACEMENT, ResultField, STRAIN_ENERGY_DENSITY};
use ligament_model::Canvas;
use ligament_post::surfaces::opened_cells;

use super::solid_cracks::SolidCracks;
use crate::vtu::read::VtuFile;
use crate::vtu::{self, Cell, Field, UnstructuredGrid};
use crate::{Error, FieldLocation};

/// Fields of the points in the file, beside the displacement.
const FIELDS: [&ResultField; 2] = [&DAMAGE, &STRAIN_ENERGY_DENSITY];

/// Whether the body has cells between points, which can be opened; the box of a lattice moves with its point.
pub(super) fn has_cells(cracks: &SolidCracks) -> bool {
    matches!(cracks.body.grid.canvas, Canvas::Solid(_))
}

/// Writes the cells cut by the crack of a step, with stored fields: corners on the crack have the mean of the points on their side.
pub(super) fn write_opened(
    path: &Path,
    cracks: &SolidCracks,
    step: usize,
    fields: &VtuFile,
) -> Result<(), Error> {
    let grid = &cracks.body.grid;
    let Canvas::Solid(cells) = &grid.canvas else {
        return Ok(());
    };
    let links = cracks.links(step);
    let opened = opened_cells((&grid.positions, cells), &cracks.tetrahedra, &links);
    let mean = |points: &Vec<u32>, value: &dyn Fn(usize) -> f64| {
        let sum: f64 = points.iter().map(|it| value(*it as usize)).sum();
        sum / points.len() as f64
    };
    let displacement = cracks.body.vectors(fields, DISPLACEMENT.name)?;
    let follows = opened.follows.iter();
    let moved: Vec<[f64; 3]> = follows
        .map(|points| [0, 1, 2].map(|axis| mean(points, &|it| displacement[it][axis])))
        .collect();
    let mut named = Vec::new();
    for ResultField { name, .. } in FIELDS {
        if let Some(values) = fields.numbers(FieldLocation::Point, name)? {
            let follows = opened.follows.iter();
            let values: Vec<f64> = follows
                .map(|points| mean(points, &|it| values[it]))
                .collect();
            named.push((*name, values));
        }
    }
    let cells: Vec<Cell> = opened.cells.iter().copied().map(Cell::Solid).collect();
    let of: Vec<i64> = opened.of.iter().map(|it| i64::from(*it)).collect();
    let mut point_fields = vec![Field::vector(DISPLACEMENT.name, &moved)];
    point_fields.extend(
        named
            .iter()
            .map(|(name, values)| Field::scalar(name, values)),
    );
    let grid = UnstructuredGrid {
        points: &opened.positions,
        cells: &cells,
        point_fields: &point_fields,
        cell_fields: &[Field::integer("cell_of_mesh", &of)],
    };
    vtu::write_vtu(path, &grid)
}
