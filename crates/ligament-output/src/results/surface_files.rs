//! Files of the cracks of a stored run of a solid.
//!
//! | file | holds |
//! |---|---|
//! | `crack.vtu`, `crack.stl` | the surface of a step as triangles |
//! | `opened.vtu` | the cells of a mesh, opened along the surface, with the displacement and the damage of the step |
//! | `crack_growth.csv` | parts and area of the surface in every record of the history in which it grew, and energies over the new area |
//! | `crack_NNNN.vtu`, `crack.pvd`, `opened_NNNN.vtu`, `opened.pvd` | surfaces and opened cells of all stored steps |
//!
//! Fields on the vertices of the surface: `opening` and `sliding`, jumps of the displacement normal and tangential to the surface (m,
//! averaged over the pairs separated there; positive openings separate), the `step` in which the last of these pairs separated (-1 before
//! the first load) and its `load_factor`. On the triangles: the connected `part`, from 1, the largest first, and `precrack`.

use std::path::Path;

use ligament_analysis::result_fields::{DISPLACEMENT, OPENING, SLIDING};
use ligament_post::surfaces::CrackSurface;

use super::crack_growth::{CrackSize, write_growth};
use super::opened_files::{OPENED, has_cells, write_opened_cells};
use super::outputs::Outputs;
use super::solid_cracks::SolidCracks;
use crate::Error;
use crate::atomic::remove_file;
use crate::pvd::Collection;
use crate::replace_file;
use crate::vtu::read::VtuFile;
use crate::vtu::{self, Cell, Cells, Field, UnstructuredGrid};

/// Names of the files of cracks beside the results of a run of a solid.
pub const SURFACE_FILES: [&str; 4] = ["crack.vtu", "crack.stl", OPENED, "crack_growth.csv"];

/// Writes the surface of a step, and its growth over all steps; returns the surface.
///
/// # Errors
///
/// If a file cannot be read or written.
pub fn write_surface(
    folder: &Path,
    cracks: &SolidCracks,
    step: usize,
) -> Result<CrackSurface, Error> {
    let surface = cracks.surface(step);
    let [grid, stl, opened, growth] = SURFACE_FILES.map(|name| folder.join(name));
    let fields = fields_until(folder, step)?;
    write_grid(&grid, cracks, &surface, fields.as_ref(), &[])?;
    match surface.triangles.is_empty() {
        true => remove_file(&stl)?,
        false => replace_file(&stl, &stl_of(&surface))?,
    }
    match fields.filter(|_| has_cells(cracks)) {
        Some(fields) => write_opened_cells(&opened, cracks, step, &fields)?,
        None => remove_file(&opened)?,
    }
    let least = cracks.mean_horizon().powi(2);
    write_growth(&growth, [true, cracks.in_time], &sizes(cracks), least)?;
    Ok(surface)
}

/// Writes the surfaces and the opened cells of all stored steps as series; returns the number of steps.
///
/// # Errors
///
/// If a file cannot be read or written.
pub fn write_series(folder: &Path, cracks: &SolidCracks) -> Result<usize, Error> {
    let outputs = Outputs::list(folder)?;
    let mut surfaces = Collection::new(folder.join("crack.pvd"));
    let mut bodies = Collection::new(folder.join("opened.pvd"));
    for (&step, path) in &outputs.files {
        let fields = VtuFile::open(path)?;
        let (surface, time) = (cracks.surface(step), fields.time()?);
        let time = time.unwrap_or(step as f64);
        if !surface.triangles.is_empty() {
            let name = format!("crack_{step:04}.vtu");
            let (path, field_data) = (folder.join(&name), fields.field_data()?);
            write_grid(&path, cracks, &surface, Some(&fields), &field_data)?;
            surfaces.append(time, name)?;
        }
        if has_cells(cracks) {
            let name = format!("opened_{step:04}.vtu");
            write_opened_cells(&folder.join(&name), cracks, step, &fields)?;
            bodies.append(time, name)?;
        }
    }
    Ok(outputs.files.len())
}

/// Opening and sliding (m) at each vertex of the surface of a step, from the stored displacements of this step or of the last stored step
/// before it; NaN where there are none.
///
/// # Errors
///
/// If a file cannot be read.
pub fn stored_jumps(
    folder: &Path,
    cracks: &SolidCracks,
    surface: &CrackSurface,
    step: usize,
) -> Result<Vec<[f64; 2]>, Error> {
    jumps(cracks, surface, fields_until(folder, step)?.as_ref())
}

fn jumps(
    cracks: &SolidCracks,
    surface: &CrackSurface,
    fields: Option<&VtuFile>,
) -> Result<Vec<[f64; 2]>, Error> {
    Ok(match fields {
        Some(file) => cracks.jumps(surface, &cracks.body.vectors(file, DISPLACEMENT.name)?),
        None => vec![[f64::NAN; 2]; surface.places.len()],
    })
}

/// The stored fields of a step, or of the last step before it with fields.
pub(super) fn fields_until(folder: &Path, step: usize) -> Result<Option<VtuFile>, Error> {
    let outputs = Outputs::list(folder)?;
    let path = outputs.files.range(..=step).next_back();
    path.map(|(_, path)| VtuFile::open(path)).transpose()
}

/// Writes the surface with its fields; no file without triangles, since readers refuse empty grids.
fn write_grid(
    path: &Path,
    cracks: &SolidCracks,
    surface: &CrackSurface,
    fields: Option<&VtuFile>,
    field_data: &[(&str, f64)],
) -> Result<(), Error> {
    if surface.triangles.is_empty() {
        return remove_file(path);
    }
    let jumps = jumps(cracks, surface, fields)?;
    let [opening, sliding]: [Vec<f64>; 2] =
        [0, 1].map(|place| jumps.iter().map(|it| it[place]).collect());
    let steps = cracks.steps_of_separation();
    let parted = surface.parted.iter();
    let last = |pairs: &Vec<[u32; 2]>| pairs.iter().filter_map(|it| steps.get(it)).max().copied();
    let step: Vec<Option<usize>> = parted.map(last).collect();
    let factor = |step: &Option<usize>| {
        let record = cracks.records.iter().find(|it| Some(it.step) == *step);
        record.map_or(f64::NAN, |it| it.load_factor)
    };
    let load_factor: Vec<f64> = step.iter().map(factor).collect();
    let step: Vec<i64> = step
        .iter()
        .map(|it| it.map_or(-1, |it| it as i64))
        .collect();
    let cells: Vec<Cell> = surface
        .triangles
        .iter()
        .copied()
        .map(Cell::Triangle)
        .collect();
    let part: Vec<i64> = surface.part.iter().map(|it| i64::from(*it) + 1).collect();
    let precrack: Vec<i64> = surface.is_precrack.iter().copied().map(i64::from).collect();
    let grid = UnstructuredGrid {
        points: &surface.places,
        cells: Cells::Mixed(&cells),
        point_fields: &[
            Field::scalar(OPENING.name, &opening),
            Field::scalar(SLIDING.name, &sliding),
            Field::scalar("load_factor", &load_factor),
            Field::integer("step", &step),
        ],
        cell_fields: &[
            Field::integer("part", &part),
            Field::integer("precrack", &precrack),
        ],
        field_data,
    };
    vtu::write_vtu(path, &grid)
}

/// The surface as binary STL: 80 bytes of text, the number of triangles, and for each triangle its normal and corners in single precision.
fn stl_of(surface: &CrackSurface) -> Vec<u8> {
    let mut bytes = vec![0; 80];
    let words = b"crack surface, m";
    bytes[..words.len()].copy_from_slice(words);
    bytes.extend((surface.triangles.len() as u32).to_le_bytes());
    for triangle in &surface.triangles {
        let corners = triangle.map(|it| surface.places[it as usize]);
        let normal = unit_normal(corners);
        for number in [normal].iter().chain(&corners).flatten() {
            bytes.extend((*number as f32).to_le_bytes());
        }
        bytes.extend([0; 2]);
    }
    bytes
}

fn unit_normal([a, b, c]: [[f64; 3]; 3]) -> [f64; 3] {
    let [p, q] = [b, c].map(|it| [0, 1, 2].map(|axis| it[axis] - a[axis]));
    let normal = [
        p[1] * q[2] - p[2] * q[1],
        p[2] * q[0] - p[0] * q[2],
        p[0] * q[1] - p[1] * q[0],
    ];
    let length = normal.iter().map(|it| it * it).sum::<f64>().sqrt();
    if length > 0.0 {
        normal.map(|it| it / length)
    } else {
        normal
    }
}

/// Sizes of the surface at the records of the history in which it grew.
fn sizes(cracks: &SolidCracks) -> Vec<CrackSize<'_>> {
    let surfaces = cracks.records_with_growth().into_iter();
    let surfaces = surfaces.map(|record| (record, cracks.surface(record.step)));
    surfaces
        .map(|(record, surface)| CrackSize {
            record,
            area: surface.area(),
            counts: vec![surface.parts().len().into()],
            length: None,
        })
        .collect()
}
