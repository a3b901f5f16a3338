//! Grids in pieces, one for each of several processes: a PVTU file that names VTU files.
//!
//! | file | holds |
//! |---|---|
//! | `NAME.pvtu` | names and kinds of the fields, and the pieces |
//! | `NAME.piece_R.vtu` | the cells of rank R with their points, and the fields there |
//!
//! Points of cells of several pieces are in all of these. The fields [`POINT_NUMBER`] and [`CELL_NUMBER`] are the indices of points and
//! cells in the whole grid, from 0, so that a reader restores the grid as written by one process.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use ligament_model::subdomain::Subdomain;

use super::field::SelectedValues;
use super::{Cell, Cells, Field, UnstructuredGrid, opening, write_field_data, write_vtu};
use crate::Error;
use crate::single_file::replace_file_with;
use crate::xml::escape_attribute;

/// Field of the indices of the points in the whole grid.
pub(super) const POINT_NUMBER: &str = "point_number";

/// Field of the indices of the cells in the whole grid.
pub(super) const CELL_NUMBER: &str = "cell_number";

/// File extension of a grid in one file.
pub const FILE_EXTENSION: &str = "vtu";

/// File extension of a grid in pieces.
pub const PIECES_EXTENSION: &str = "pvtu";

/// Name of the file of a grid, in pieces where the body is divided between processes.
pub fn file_name(stem: &str, subdomain: &Subdomain) -> String {
    let ending = match subdomain.is_whole() {
        true => FILE_EXTENSION,
        false => PIECES_EXTENSION,
    };
    format!("{stem}.{ending}")
}

/// The stem `NAME` of a grid file `NAME.vtu`, `NAME.pvtu` or a piece `NAME.piece_R.vtu`; `None` for other files.
pub fn stem(name: &str) -> Option<&str> {
    let (rest, ending) = name.rsplit_once('.')?;
    let of_piece = || {
        let (stem, rank) = rest.rsplit_once(".piece_")?;
        rank.parse::<usize>().is_ok().then_some(stem)
    };
    match ending {
        FILE_EXTENSION => Some(of_piece().unwrap_or(rest)),
        PIECES_EXTENSION => Some(rest),
        _ => None,
    }
}

/// Path of a piece of a file.
fn piece(path: &Path, rank: usize) -> PathBuf {
    path.with_extension(format!("piece_{rank}.vtu"))
}

/// Cells of a grid with their owners.
#[derive(Clone, Copy)]
pub struct SharedCells<'a> {
    /// Subdomain of this process.
    pub subdomain: &'a Subdomain,
    /// For each cell, the point of the body whose owner owns the cell, shape (n_cells).
    pub points: &'a [u32],
    /// Indices of the points and cells in the whole grid.
    pub global: GlobalIndices<'a>,
}

/// Indices in the whole grid of the points and cells of one of several processes; empty on one process.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct GlobalIndices<'a> {
    /// Indices of the points, shape (n_points).
    pub points: &'a [u32],
    /// Indices of the cells, shape (n_cells); none where they have no order in the whole grid.
    pub cells: Option<&'a [u32]>,
}

/// The indices at some places.
fn indices_at(indices: &[u32], places: &[u32]) -> Vec<i64> {
    let chosen = places.iter().map(|&place| indices[place as usize]);
    chosen.map(i64::from).collect()
}

/// Writes a grid to `path`, in pieces where the body is divided. The call is then collective: each process has right values at its cells,
/// and it returns when all pieces are written.
///
/// # Errors
///
/// If the grid is invalid, or a file cannot be written, by this process or another one.
pub fn write_shared(
    path: impl AsRef<Path>,
    grid: &UnstructuredGrid<'_>,
    shared: SharedCells<'_>,
) -> Result<(), Error> {
    let path = path.as_ref();
    if shared.subdomain.is_whole() {
        return write_vtu(path, grid);
    }
    let communicator = shared.subdomain.communicator();
    let own: Vec<u32> = (0..)
        .zip(shared.points)
        .filter(|(_, point)| shared.subdomain.owns(**point))
        .map(|(cell, _)| cell)
        .collect();
    let written = if own.is_empty() {
        Ok(())
    } else {
        write_piece(&piece(path, communicator.rank()), grid, &own, shared.global)
    };
    let counts = shared.subdomain.all_gather_list(vec![[
        own.len() as f64,
        f64::from(u8::from(written.is_err())),
    ]]);
    written?;
    if let Some(rank) = counts.iter().position(|[_, failed]| *failed > 0.0) {
        return Err(Error::Refused {
            path: piece(path, rank),
            reason: format!("process {rank} could not write it"),
        });
    }
    if communicator.rank() > 0 {
        return Ok(());
    }
    let ranks = counts.iter().enumerate();
    let with_cells = ranks.filter(|(_, [count, _])| *count > 0.0);
    let pieces: Vec<PathBuf> = with_cells.map(|(rank, _)| piece(path, rank)).collect();
    replace_file_with(path, |out| write_outline(grid, &pieces, shared.global, out))
}

/// Writes some cells of a grid with their points.
fn write_piece(
    path: &Path,
    grid: &UnstructuredGrid<'_>,
    own: &[u32],
    global: GlobalIndices<'_>,
) -> Result<(), Error> {
    grid.check(path)?;
    let corners = |&cell: &u32| grid.cells.points(cell as usize);
    let mut points: Vec<u32> = own.iter().flat_map(corners).copied().collect();
    points.sort_unstable();
    points.dedup();
    let place = |point: u32| points.partition_point(|it| *it < point) as u32;
    let cells = own
        .iter()
        .map(|&cell| grid.cells.get(cell as usize).renumbered(place));
    let cells: Vec<Cell> = cells.collect();
    let positions: Vec<[f64; 3]> = points
        .iter()
        .map(|&point| grid.points[point as usize])
        .collect();
    let point_numbers = indices_at(global.points, &points);
    let cell_numbers = global.cells.map(|it| indices_at(it, own));
    let [of_points, of_cells] = [(grid.point_fields, &points[..]), (grid.cell_fields, own)]
        .map(|(fields, rows)| fields.iter().map(|it| it.at(rows)).collect());
    let of_points: Vec<SelectedValues> = of_points;
    let of_cells: Vec<SelectedValues> = of_cells;
    let mut point_fields: Vec<Field<'_>> = selected_fields(grid.point_fields, &of_points);
    point_fields.push(Field::integer(POINT_NUMBER, &point_numbers));
    let mut cell_fields: Vec<Field<'_>> = selected_fields(grid.cell_fields, &of_cells);
    if let Some(numbers) = &cell_numbers {
        cell_fields.push(Field::integer(CELL_NUMBER, numbers));
    }
    let piece = UnstructuredGrid {
        points: &positions,
        cells: Cells::Mixed(&cells),
        point_fields: &point_fields,
        cell_fields: &cell_fields,
        field_data: grid.field_data,
    };
    write_vtu(path, &piece)
}

fn selected_fields<'a>(fields: &'a [Field<'a>], numbers: &'a [SelectedValues]) -> Vec<Field<'a>> {
    let pairs = fields.iter().zip(numbers);
    pairs.map(|(field, numbers)| field.with(numbers)).collect()
}

/// Appends the document that names the pieces.
fn write_outline(
    grid: &UnstructuredGrid<'_>,
    pieces: &[PathBuf],
    global: GlobalIndices<'_>,
    out: &mut dyn Write,
) -> io::Result<()> {
    write!(
        out,
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
         <VTKFile type=\"PUnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\" \
         compressor=\"vtkZLibDataCompressor\">\n<PUnstructuredGrid GhostLevel=\"0\">\n"
    )?;
    write_field_data(grid.field_data, out)?;
    let mut point_fields = grid.point_fields.to_vec();
    point_fields.push(Field::integer(POINT_NUMBER, &[]));
    let mut cell_fields = grid.cell_fields.to_vec();
    if global.cells.is_some() {
        cell_fields.push(Field::integer(CELL_NUMBER, &[]));
    }
    for (element, fields) in [("PPointData", point_fields), ("PCellData", cell_fields)] {
        out.write_all(opening(element, &fields).as_bytes())?;
        for field in &fields {
            out.write_all(field.outline().as_bytes())?;
        }
        writeln!(out, "</{element}>")?;
    }
    let points = Field::vector("Points", &[]).outline();
    write!(out, "<PPoints>\n{points}</PPoints>\n")?;
    for piece in pieces {
        let name = piece.file_name().unwrap_or_default().to_string_lossy();
        writeln!(out, "<Piece Source=\"{}\"/>", escape_attribute(&name))?;
    }
    out.write_all(b"</PUnstructuredGrid>\n</VTKFile>\n")
}
