//! Grids of the body for fields, and the fields that do not change. Points and bonds are written in the order of the body's file.

use std::iter::repeat_n;
use std::path::Path;

use ligament_analysis::result_fields::{DISPLACEMENT, MATERIAL, ModelPoints};
use ligament_mesh::SolidCell;
use ligament_model::subdomain::Subdomain;
use ligament_model::{BodyGrid, Canvas, box_corners, raised};

use crate::Error;
use crate::vtu::{
    self, Cells, Field, GlobalIndices, SelectedValues, SharedCells, UnstructuredGrid,
};

/// Fields of a model that do not change in a run.
pub(super) fn fixed_fields(model: ModelPoints<'_>) -> impl Iterator<Item = Field<'_>> {
    let fields = model.fields().into_iter();
    fields.map(|(name, values)| Field::scalar(name, values))
}

/// Writes only the fields of a model, for `check`.
pub fn point_grid(path: &Path, grid: &BodyGrid, model: ModelPoints<'_>) -> Result<(), Error> {
    let tags = Field::integer(grid.tagged, &grid.tags);
    let fields: Vec<Field<'_>> = fixed_fields(model).chain([tags]).collect();
    let subdomain = Subdomain::whole(grid.positions.len());
    let of_cells = material_of_cells(model);
    write_grid(path, grid, [&fields, &of_cells], (&subdomain, &[]))
}

/// Field of the cells with the numbers of their materials, where there are several.
pub(super) fn material_of_cells(model: ModelPoints<'_>) -> Vec<Field<'_>> {
    let numbers = &model.fixed.material_of_cell;
    let field = (!numbers.is_empty()).then(|| Field::integer(MATERIAL.name, numbers));
    field.into_iter().collect()
}

/// Writes fields of the points (n_points) of an unloaded body, with the tags of the points.
pub fn write_points(path: &Path, grid: &BodyGrid, fields: &[Field<'_>]) -> Result<(), Error> {
    let tags = Field::integer(grid.tagged, &grid.tags);
    let all: Vec<Field<'_>> = fields.iter().copied().chain([tags]).collect();
    let subdomain = Subdomain::whole(grid.positions.len());
    write_grid(path, grid, [&all, &[]], (&subdomain, &[]))
}

/// Bonds as lines between the points of a body, in the order of the file.
pub(super) struct BondLines {
    lines: Vec<[u32; 2]>,
    /// First end of each bond; the owner of this point owns the bond.
    first_ends: Vec<u32>,
    /// Order of the bonds in the file; none where it is the present one.
    order: Option<Vec<u32>>,
}

impl BondLines {
    /// The lines of bonds, given by their ends (n_bonds), then the lines of absent bonds.
    pub(super) fn new(body: &BodyGrid, bonds: &[[u32; 2]], absent: &[[u32; 2]]) -> Self {
        let numbering = &body.numbering;
        let n_bonds = bonds.len() as u32;
        let order = numbering.bonds_in_file(bonds).map(|mut order| {
            let absent = numbering.bonds_in_file(absent).unwrap_or_default();
            order.extend(absent.into_iter().map(|pair| n_bonds + pair));
            order
        });
        let ends: Vec<[u32; 2]> = bonds.iter().chain(absent).copied().collect();
        let ends = match &order {
            None => ends,
            Some(order) => order.iter().map(|&bond| ends[bond as usize]).collect(),
        };
        let places = numbering.places();
        let place = |end: u32| places.as_ref().map_or(end, |it| it[end as usize]);
        let lines = ends.iter().map(|it| numbering.ordered(*it).map(place));
        Self {
            lines: lines.collect(),
            first_ends: ends.iter().map(|it| it[0]).collect(),
            order,
        }
    }

    /// Writes the lines with fields of the points and of the bonds, and field data; in pieces where the body is divided between processes.
    pub(super) fn write(
        &self,
        path: &Path,
        body: &BodyGrid,
        [point_fields, cell_fields]: [&[Field<'_>]; 2],
        of_file: (&Subdomain, &[(&str, f64)]),
    ) -> Result<(), Error> {
        let (subdomain, field_data) = of_file;
        let of_points = body.numbering.order_of_file();
        let point_fields: Vec<Field<'_>> = point_fields
            .iter()
            .map(|it| it.ordered(of_points))
            .collect();
        let of_bonds = self.order.as_deref();
        let cell_fields: Vec<Field<'_>> =
            cell_fields.iter().map(|it| it.ordered(of_bonds)).collect();
        let grid = UnstructuredGrid {
            points: &body.numbering.to_file(body.positions.clone()),
            cells: Cells::Lines(&self.lines),
            point_fields: &point_fields,
            cell_fields: &cell_fields,
            field_data,
        };
        let shared = SharedCells {
            subdomain,
            points: &self.first_ends,
            global: GlobalIndices {
                points: &numbers_in_order(body),
                cells: None,
            },
        };
        vtu::write_shared(path, &grid, shared)
    }
}

/// Writes fields of the points and of the cells of a body, and field data; in pieces where the body is divided between processes. Readers
/// warp the grid by its first vector, the displacement.
pub(super) fn write_grid(
    path: &Path,
    body: &BodyGrid,
    [fields, of_cells]: [&[Field<'_>]; 2],
    (subdomain, field_data): (&Subdomain, &[(&str, f64)]),
) -> Result<(), Error> {
    if matches!(body.canvas, Canvas::Around(_) | Canvas::Boxes(_)) {
        // Each cell has one point.
        let fields = [fields, of_cells].concat();
        return write_point_cells(path, body, &fields, (subdomain, field_data));
    }
    let order = body.numbering.order_of_file();
    let (numbering, numbers) = (&body.numbering, numbers_in_order(body));
    let body = &body.in_order_of_file();
    let all: Vec<Field<'_>> = fields.iter().map(|it| it.ordered(order)).collect();
    let cells = cells(&body.canvas);
    let in_file = cells.iter().map(|it| it.points()[0]);
    let points_of_cells: Vec<u32> = in_file.map(|it| numbering.point(it)).collect();
    let shared = SharedCells {
        subdomain,
        points: &points_of_cells,
        global: GlobalIndices {
            points: &numbers,
            cells: Some(&body.cell_numbers),
        },
    };
    let grid = UnstructuredGrid {
        points: &body.positions,
        cells: Cells::Mixed(&cells),
        point_fields: &all,
        cell_fields: of_cells,
        field_data,
    };
    vtu::write_shared(path, &grid, shared)
}

/// Writes fields on cells around the points, in the order of the file; where the body is divided, each process writes the cells of its
/// owned points. Corners of cells move with their points.
fn write_point_cells(
    path: &Path,
    body: &BodyGrid,
    fields: &[Field<'_>],
    (subdomain, field_data): (&Subdomain, &[(&str, f64)]),
) -> Result<(), Error> {
    let numbering = &body.numbering;
    let points: Vec<u32> = subdomain.owned().collect();
    let points = numbering.sorted(&points);
    let canvas = cells_around(&body.canvas, &points);
    let chosen: Vec<SelectedValues> = fields.iter().map(|it| it.at(&points)).collect();
    let in_order = fields.iter().zip(&chosen).map(|(field, it)| field.with(it));
    let in_order: Vec<Field<'_>> = in_order.collect();
    let (corners, n_corners) = match &canvas {
        Canvas::Around(corners) => (raised(corners.as_flattened()), 4),
        Canvas::Boxes(boxes) => (boxes.iter().copied().flat_map(box_corners).collect(), 8),
        Canvas::Between(_) | Canvas::Solid(_) => (Vec::new(), 0),
    };
    let moved = fields.iter().find(|it| it.is(DISPLACEMENT.name));
    let points_of_corners = points.iter().flat_map(|it| repeat_n(*it, n_corners));
    let of_corners = moved.map(|it| (it, it.at(&points_of_corners.collect::<Vec<u32>>())));
    let of_corners: Vec<Field<'_>> = (of_corners.iter().map(|(it, at)| it.with(at))).collect();
    let grid = UnstructuredGrid {
        points: &corners,
        cells: Cells::Mixed(&cells(&canvas)),
        point_fields: &of_corners,
        cell_fields: &in_order,
        field_data,
    };
    let in_file: Vec<u32> = points.iter().map(|&it| numbering.in_file(it)).collect();
    let of_cell = |&cell: &u32| (0..n_corners as u32).map(move |it| n_corners as u32 * cell + it);
    let corners_in_file: Vec<u32> = in_file.iter().flat_map(of_cell).collect();
    let shared = SharedCells {
        subdomain,
        points: &points,
        global: GlobalIndices {
            points: &corners_in_file,
            cells: Some(&in_file),
        },
    };
    vtu::write_shared(path, &grid, shared)
}

/// Numbers in the file of the points in its order, shape (n_points).
fn numbers_in_order(body: &BodyGrid) -> Vec<u32> {
    let points: Vec<u32> = (0..body.positions.len() as u32).collect();
    let in_order = body.numbering.sorted(&points);
    let numbers = in_order.iter().map(|&point| body.numbering.in_file(point));
    numbers.collect()
}

/// The cells around some points.
fn cells_around(canvas: &Canvas, points: &[u32]) -> Canvas {
    match canvas {
        Canvas::Around(corners) => Canvas::Around(values_at(corners, points)),
        Canvas::Boxes(boxes) => Canvas::Boxes(values_at(boxes, points)),
        Canvas::Between(_) | Canvas::Solid(_) => canvas.clone(),
    }
}

/// The values of some points.
fn values_at<T: Copy>(values: &[T], points: &[u32]) -> Vec<T> {
    points.iter().map(|&point| values[point as usize]).collect()
}

/// The cells of a canvas; cells around points have corners of their own, in the order of the points.
fn cells(canvas: &Canvas) -> Vec<vtu::Cell> {
    match canvas {
        Canvas::Between(cells) => cells.iter().copied().map(vtu::Cell::from).collect(),
        Canvas::Solid(cells) => cells.iter().copied().map(vtu::Cell::from).collect(),
        Canvas::Around(squares) => (0..squares.len() as u32)
            .map(|cell| vtu::Cell::Quad(std::array::from_fn(|it| 4 * cell + it as u32)))
            .collect(),
        Canvas::Boxes(boxes) => (0..boxes.len() as u32)
            .map(|cell| std::array::from_fn(|it| 8 * cell + it as u32))
            .map(|corners| vtu::Cell::Solid(SolidCell::Hexahedron(corners)))
            .collect(),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use ligament_model::Numbering;
    use vtkio::model::{Attribute, DataSet, Piece, Vtk};

    fn names(attributes: &[Attribute]) -> Vec<&str> {
        attributes.iter().map(Attribute::name).collect()
    }

    /// Two cells of a lattice: each has four corners of its own, which move with it; all else is cell data.
    #[test]
    fn cells_around_points_have_their_own_corners() {
        let square = |x: f64| [[x, 0.0], [x + 1.0, 0.0], [x + 1.0, 1.0], [x, 1.0]];
        let grid = BodyGrid {
            positions: vec![[0.5, 0.5, 0.0], [1.5, 0.5, 0.0]],
            numbering: Numbering::default(),
            tags: vec![1, 2],
            tagged: "cell",
            cell_numbers: Vec::new(),
            of_body: None,
            canvas: Canvas::Around(vec![square(0.0), square(1.0)]),
        };
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("fields.vtu");
        let (moved, damage) = ([[0.0, 0.0, 0.0], [0.25, -0.5, 0.0]], [0.0, 0.75]);
        let fields = [
            Field::vector("displacement", &moved),
            Field::scalar("damage", &damage),
            Field::integer(grid.tagged, &grid.tags),
        ];
        let whole = Subdomain::whole(grid.positions.len());
        write_grid(&path, &grid, [&fields, &[]], (&whole, &[])).unwrap();
        let DataSet::UnstructuredGrid { pieces, .. } = Vtk::import(&path).unwrap().data else {
            panic!("not an unstructured grid");
        };
        let Piece::Inline(piece) = pieces.into_iter().next().unwrap() else {
            panic!("not inline");
        };
        assert_eq!((piece.num_points(), piece.cells.num_cells()), (8, 2));
        let (_, vertices) = piece.cells.cell_verts.clone().into_legacy();
        assert_eq!(vertices, [4, 0, 1, 2, 3, 4, 4, 5, 6, 7]);
        assert_eq!(names(&piece.data.point), ["displacement"]);
        assert_eq!(names(&piece.data.cell), ["displacement", "damage", "cell"]);
        let Attribute::DataArray(array) = &piece.data.point[0] else {
            panic!("no array");
        };
        let expected: Vec<f64> = (moved.iter())
            .flat_map(|corner| [*corner; 4].concat())
            .collect();
        assert_eq!(array.data.clone().into_vec::<f64>().unwrap(), expected);
    }
}
