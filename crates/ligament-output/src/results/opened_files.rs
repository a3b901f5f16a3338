//! File of the cells of a body, opened along its cracks.

use std::path::Path;

use ligament_analysis::result_fields::{DAMAGE, DISPLACEMENT, ResultField, STRAIN_ENERGY_DENSITY};
use ligament_model::Canvas;
use ligament_post::OpenedCells;
use ligament_post::surfaces::opened_cells;

use super::cracks::StoredCracks;
use super::solid_cracks::SolidCracks;
use crate::vtu::read::VtuFile;
use crate::vtu::{self, Cell, Cells, Field, UnstructuredGrid};
use crate::{Error, FieldLocation};

/// Name of the file of a step.
pub(super) const OPENED: &str = "opened.vtu";

/// Fields of the points in the file, beside the displacement.
const FIELDS: [&ResultField; 2] = [&DAMAGE, &STRAIN_ENERGY_DENSITY];

/// Whether the body has cells between points, which can be opened; each cell of a lattice belongs to one point and moves with it.
pub(super) fn has_cells(cracks: &SolidCracks) -> bool {
    matches!(cracks.body.grid.canvas, Canvas::Solid(_))
}

/// Writes the cells of a solid, cut by the crack of a step, with stored fields.
pub(super) fn write_opened_cells(
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
    write(path, opened, fields)
}

/// Writes the cells of a body in the plane, cut by the cracks of a step, with stored fields; returns whether it has cells between points.
pub(super) fn write_opened_plane_cells(
    path: &Path,
    cracks: &StoredCracks,
    step: usize,
    fields: &VtuFile,
) -> Result<bool, Error> {
    let has_cells = !cracks.cells().is_empty();
    if has_cells {
        write(path, cracks.opened_cells(step), fields)?;
    }
    Ok(has_cells)
}

/// Writes opened cells: corners on the crack have the mean of the points on their side.
fn write<C: Into<Cell>>(
    path: &Path,
    opened: OpenedCells<C>,
    fields: &VtuFile,
) -> Result<(), Error> {
    let displacement = fields.finite_numbers(FieldLocation::Point, DISPLACEMENT.name)?;
    let along = [0, 1, 2].map(|axis| opened.means(|point| displacement[3 * point + axis]));
    let moved: Vec<[f64; 3]> = (0..opened.positions.len())
        .map(|corner| [0, 1, 2].map(|axis| along[axis][corner]))
        .collect();
    let mut named = Vec::new();
    for ResultField { name, .. } in FIELDS {
        if let Some(values) = fields.numbers(FieldLocation::Point, name)? {
            named.push((*name, opened.means(|point| values[point])));
        }
    }
    let cells: Vec<Cell> = opened.cells.into_iter().map(Into::into).collect();
    let of: Vec<i64> = opened.of.iter().map(|it| i64::from(*it)).collect();
    let mut point_fields = vec![Field::vector(DISPLACEMENT.name, &moved)];
    point_fields.extend(
        named
            .iter()
            .map(|(name, values)| Field::scalar(name, values)),
    );
    let grid = UnstructuredGrid {
        points: &opened.positions,
        cells: Cells::Mixed(&cells),
        point_fields: &point_fields,
        cell_fields: &[Field::integer("cell_of_mesh", &of)],
        field_data: &fields.field_data()?,
    };
    vtu::write_vtu(path, &grid)
}
