//! File of the surface in a solid on which a field equals a level.
//!
//! `iso.vtu` (`iso_NNNN.vtu` and `iso.pvd` of all stored steps) holds its triangles, counter-clockwise seen from where the field is larger,
//! in the undeformed body. Its vertices lie on edges of tetrahedra between the points; all fields of the points except integers are
//! interpolated linearly along these edges.

use std::path::Path;

use ligament_model::Canvas;
use ligament_post::surfaces::{LevelSet, Tetrahedra, level_set};

use super::solid_body::SolidBody;
use crate::Error;
use crate::atomic::remove_file;
use crate::vtu::read::VtuFile;
use crate::vtu::{self, Cell, Cells, Field, UnstructuredGrid};

/// A field interpolated to the vertices of a surface.
struct InterpolatedField {
    name: String,
    stride: usize,
    components: Vec<String>,
    values: Vec<f64>,
}

/// Writes the surface on which values of the points (n_points) equal a level, with the fields of a result file; returns its area (m^2) and
/// number of triangles. There is no file without triangles, since readers refuse empty grids.
///
/// # Errors
///
/// If a field cannot be read, or the file cannot be written.
pub fn write_level_set(
    path: &Path,
    (file, body): (&VtuFile, &SolidBody),
    values: &[f64],
    level: f64,
) -> Result<(f64, usize), Error> {
    let tetrahedra = Tetrahedra::new(&body.grid);
    let of_nodes: Vec<f64> = (tetrahedra.points.iter())
        .map(|it| values[*it as usize])
        .collect();
    let found = level_set(&tetrahedra.corners, &of_nodes, level);
    if found.triangles.is_empty() {
        remove_file(path)?;
        return Ok((0.0, 0));
    }
    let places = (found.places.iter()).map(|(ends, share)| {
        let [a, b] = ends.map(|it| tetrahedra.nodes[it as usize]);
        [0, 1, 2].map(|axis| a[axis] + share * (b[axis] - a[axis]))
    });
    let places: Vec<[f64; 3]> = places.collect();
    let fields = interpolated_fields(file, body, &tetrahedra, &found)?;
    let names: Vec<Vec<&str>> = (fields.iter())
        .map(|it| it.components.iter().map(String::as_str).collect())
        .collect();
    let point_fields = fields
        .iter()
        .zip(&names)
        .map(|(field, names)| Field::numbers(&field.name, field.stride, names, &field.values));
    let cells: Vec<Cell> = (found.triangles.iter().copied())
        .map(Cell::Triangle)
        .collect();
    let of: Vec<i64> = (found.tetrahedra.iter())
        .map(|it| i64::from(tetrahedra.cells[*it as usize]))
        .collect();
    let of_mesh = [Field::integer("cell_of_mesh", &of)];
    let is_mesh = matches!(body.grid.canvas, Canvas::Solid(_));
    vtu::write_vtu(
        path,
        &UnstructuredGrid {
            points: &places,
            cells: Cells::Mixed(&cells),
            point_fields: &point_fields.collect::<Vec<Field<'_>>>(),
            cell_fields: if is_mesh { &of_mesh } else { &[] },
            field_data: &file.field_data()?,
        },
    )?;
    Ok((area(&places, &found.triangles), found.triangles.len()))
}

/// The fields of the points, except integers, at the vertices of a surface.
fn interpolated_fields(
    file: &VtuFile,
    body: &SolidBody,
    tetrahedra: &Tetrahedra,
    found: &LevelSet,
) -> Result<Vec<InterpolatedField>, Error> {
    let mut fields = Vec::new();
    for name in file.fields(body.location) {
        if matches!(file.integers(body.location, name), Ok(Some(_))) {
            continue;
        }
        let (stride, components) = file.components(body.location, name).unwrap_or((1, &[]));
        if stride > 1 && stride != 3 && components.is_empty() {
            continue;
        }
        let of_points = file.required_numbers(body.location, name)?;
        if of_points.len() != stride * body.grid.positions.len() {
            return Err(file.malformed(format!("{name} is not of its points")));
        }
        let mut values = Vec::with_capacity(stride * found.places.len());
        for (ends, share) in &found.places {
            let [a, b] = ends.map(|it| stride * tetrahedra.points[it as usize] as usize);
            let along = |place: usize| {
                let (from, to) = (of_points[a + place], of_points[b + place]);
                from + share * (to - from)
            };
            values.extend((0..stride).map(along));
        }
        fields.push(InterpolatedField {
            name: name.to_owned(),
            stride,
            components: components.to_vec(),
            values,
        });
    }
    Ok(fields)
}

/// Total area of triangles, m^2.
fn area(places: &[[f64; 3]], triangles: &[[u32; 3]]) -> f64 {
    let of = |corners: &[u32; 3]| {
        let [a, b, c] = corners.map(|it| places[it as usize]);
        let [p, q] = [b, c].map(|it| [0, 1, 2].map(|axis| it[axis] - a[axis]));
        let [x, y, z] = [
            p[1] * q[2] - p[2] * q[1],
            p[2] * q[0] - p[0] * q[2],
            p[0] * q[1] - p[1] * q[0],
        ];
        0.5 * (x * x + y * y + z * z).sqrt()
    };
    triangles.iter().map(of).sum()
}
