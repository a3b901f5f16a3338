//! VTU files as vtkio reads them back, and grids that are refused because readers would.

#![allow(clippy::unwrap_used)]

use std::fs;
use std::path::Path;

use ligament_mesh::SolidCell;
use ligament_output::Error;
use ligament_output::vtu::{Cell, Cells, Field, UnstructuredGrid, write_vtu};
use vtkio::IOBuffer;
use vtkio::model::{
    Attribute, CellType, DataSet, Piece, UnstructuredGridPiece, VertexNumbers, Vtk,
};

const POINTS: [[f64; 3]; 5] = [
    [0.0, 0.0, 0.0],
    [1.0, 0.0, 0.5],
    [1.0, 1.0, -0.25],
    [0.0, 0.1 + 0.2, 0.0],
    [2.0, 0.5, 1.0],
];
const CELLS: [Cell; 4] = [
    Cell::Quad([0, 1, 2, 3]),
    Cell::Triangle([1, 4, 2]),
    Cell::Line([0, 4]),
    Cell::Vertex([3]),
];

fn grid<'a>(point_fields: &'a [Field<'a>], cell_fields: &'a [Field<'a>]) -> UnstructuredGrid<'a> {
    UnstructuredGrid {
        points: &POINTS,
        cells: Cells::Mixed(&CELLS),
        point_fields,
        cell_fields,
        field_data: &[],
    }
}

/// The text of the file of a grid.
fn text(grid: &UnstructuredGrid<'_>) -> String {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.vtu");
    write_vtu(&path, grid).unwrap();
    fs::read_to_string(path).unwrap()
}

fn read(path: &Path) -> UnstructuredGridPiece {
    let DataSet::UnstructuredGrid { pieces, .. } = Vtk::import(path).unwrap().data else {
        panic!("not an unstructured grid");
    };
    let Piece::Inline(piece) = pieces.into_iter().next().unwrap() else {
        panic!("not inline");
    };
    *piece
}

/// The one array of this name and its number of components.
fn array<'a>(attributes: &'a [Attribute], name: &str) -> (&'a IOBuffer, u32) {
    let mut found = attributes
        .iter()
        .filter(|attribute| attribute.name() == name);
    let Some(Attribute::DataArray(array)) = found.next() else {
        panic!("no array {name}");
    };
    assert!(found.next().is_none());
    (&array.data, array.elem.num_comp())
}

#[test]
fn points_cells_and_fields_read_back() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("fields_0000.vtu");
    let damage = [0.0, -0.0, f64::MIN_POSITIVE / 4.0, f64::INFINITY, 0.1 + 0.2];
    let displacement = [1.0, 2.0, 3.0, 4.0, 5.0].map(|x: f64| [x / 3.0, -x / 7.0, 0.0]);
    let material = [1, -2, i64::MAX, i64::MIN];
    let stress: Vec<f64> = (0..20).map(|k| f64::from(k) / 3.0).collect();
    let point_fields = [
        Field::scalar("damage <&\"'>", &damage),
        Field::components("stress", &["xx", "yx", "yy", "xy"], &stress),
        Field::vector("displacement", &displacement),
    ];
    write_vtu(
        &path,
        &grid(&point_fields, &[Field::integer("material", &material)]),
    )
    .unwrap();

    let piece = read(&path);
    let expected = POINTS.as_flattened().to_vec();
    assert_eq!(piece.points, IOBuffer::F64(expected));
    assert_eq!(
        piece.cells.cell_verts,
        VertexNumbers::XML {
            connectivity: vec![0, 1, 2, 3, 1, 4, 2, 0, 4, 3],
            offsets: vec![4, 7, 9, 10],
        }
    );
    let types = [
        CellType::Quad,
        CellType::Triangle,
        CellType::Line,
        CellType::Vertex,
    ];
    assert_eq!(piece.cells.types, types);
    let (values, n_components) = array(&piece.data.point, "damage <&\"'>");
    let bits: Vec<u64> = values.iter::<f64>().unwrap().map(|x| x.to_bits()).collect();
    assert_eq!((bits, n_components), (damage.map(f64::to_bits).to_vec(), 1));
    let (values, n_components) = array(&piece.data.point, "displacement");
    assert_eq!(*values, IOBuffer::F64(displacement.as_flattened().to_vec()));
    assert_eq!(n_components, 3);
    let (values, n_components) = array(&piece.data.point, "stress");
    assert_eq!((values, n_components), (&IOBuffer::F64(stress), 4));
    let text = fs::read_to_string(&path).unwrap();
    assert!(
        text.contains(" Scalars=\"damage &lt;&amp;&quot;&apos;&gt;\" Vectors=\"displacement\">"),
        "{text}"
    );
    let (values, n_components) = array(&piece.data.cell, "material");
    assert_eq!(
        (values, n_components),
        (&IOBuffer::I64(material.to_vec()), 1)
    );
}

/// Solid cells have VTK's numbers: 10, 12, 13 and 14 of vtkCellType.h, with their corners as they stand.
#[test]
fn solid_cells_read_back() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("fields_0000.vtu");
    let points: Vec<[f64; 3]> = (0..9_u32)
        .map(|it| [it & 1, it >> 1 & 1, it >> 2].map(f64::from))
        .collect();
    let cells = [
        SolidCell::Tetrahedron([0, 1, 2, 4]),
        SolidCell::Hexahedron([0, 1, 3, 2, 4, 5, 7, 6]),
        SolidCell::Prism([0, 1, 2, 4, 5, 6]),
        SolidCell::Pyramid([4, 5, 7, 6, 8]),
    ]
    .map(Cell::Solid);
    let grid = UnstructuredGrid {
        points: &points,
        cells: Cells::Mixed(&cells),
        point_fields: &[],
        cell_fields: &[],
        field_data: &[],
    };
    write_vtu(&path, &grid).unwrap();
    let piece = read(&path);
    let types = [
        CellType::Tetra,
        CellType::Hexahedron,
        CellType::Wedge,
        CellType::Pyramid,
    ];
    assert_eq!(piece.cells.types, types);
    let connectivity = cells.iter().flat_map(|cell| cell.points());
    let expected = VertexNumbers::XML {
        connectivity: connectivity.map(|&it| u64::from(it)).collect(),
        offsets: vec![4, 12, 18, 23],
    };
    assert_eq!(piece.cells.cell_verts, expected);
    assert_eq!(piece.points, IOBuffer::F64(points.into_flattened()));
}

#[test]
fn arrays_of_whole_compression_blocks_read_back() {
    // A block has 32768 bytes, 4096 numbers.
    for n_points in [4095, 4096, 4097, 8192] {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("fields_0000.vtu");
        let points: Vec<_> = (0..n_points).map(|i| [f64::from(i), 0.0, 0.0]).collect();
        let cells: Vec<_> = (0..n_points as u32).map(|i| Cell::Vertex([i])).collect();
        let volume: Vec<_> = (0..n_points).map(|i| f64::from(i).sqrt()).collect();
        let grid = UnstructuredGrid {
            points: &points,
            cells: Cells::Mixed(&cells),
            point_fields: &[Field::scalar("volume", &volume)],
            cell_fields: &[],
            field_data: &[],
        };
        write_vtu(&path, &grid).unwrap();
        let piece = read(&path);
        assert_eq!(array(&piece.data.point, "volume").0, &IOBuffer::F64(volume));
        assert_eq!(piece.cells.types.len(), cells.len());
    }
}

#[test]
fn is_compressed_and_leaves_no_other_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("fields_0000.vtu");
    write_vtu(&path, &grid(&[], &[])).unwrap();
    write_vtu(&path, &grid(&[], &[])).unwrap();
    let text = fs::read_to_string(&path).unwrap();
    assert!(text.contains("compressor=\"vtkZLibDataCompressor\""));
    assert!(text.ends_with("</VTKFile>\n"));
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
}

#[test]
fn the_first_scalar_and_the_first_vector_are_shown_first() {
    let numbers = [0.5; 5];
    let point_fields = [
        Field::integer("node", &[7; 5]),
        Field::scalar("damage & more", &numbers),
        Field::scalar("volume", &numbers),
        Field::vector("displacement", &[[0.0; 3]; 5]),
        Field::vector("reaction", &[[0.0; 3]; 5]),
    ];
    let xml = text(&grid(&point_fields, &[Field::integer("intact", &[1; 4])]));
    assert!(
        xml.contains("<PointData Scalars=\"damage &amp; more\" Vectors=\"displacement\">"),
        "{xml}"
    );
    assert!(xml.contains("<CellData>"), "{xml}");
}

#[test]
fn the_number_of_threads_changes_no_byte() {
    // Some ten blocks an array, so that threads finish them out of order.
    let points: Vec<_> = (0..40_000)
        .map(|i| [f64::from(i).sqrt(), 0.0, 0.0])
        .collect();
    let cells: Vec<_> = (0..40_000).map(|i| Cell::Vertex([i])).collect();
    let volume: Vec<_> = points.iter().map(|[x, ..]| x.sin()).collect();
    let damage: Vec<_> = points.iter().map(|[x, ..]| x.cos()).collect();
    let grid = UnstructuredGrid {
        points: &points,
        cells: Cells::Mixed(&cells),
        point_fields: &[
            Field::scalar("volume", &volume),
            Field::scalar("damage", &damage),
        ],
        cell_fields: &[],
        field_data: &[],
    };
    let with_threads = |n_threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(n_threads);
        pool.build().unwrap().install(|| text(&grid))
    };
    let one = with_threads(1);
    for n_threads in [2, 3, 8] {
        // Not assert_eq, which would print megabytes.
        assert!(with_threads(n_threads) == one, "{n_threads} threads");
    }
}

/// The error of writing `grid`, after checking that no file was written.
fn refusal(grid: &UnstructuredGrid<'_>) -> Error {
    let folder = tempfile::tempdir().unwrap();
    let error = write_vtu(folder.path().join("a.vtu"), grid).unwrap_err();
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
    error
}

#[test]
fn refuses_fields_of_the_wrong_length() {
    let error = refusal(&grid(&[Field::scalar("damage", &[0.0; 4])], &[]));
    let message = error.to_string();
    assert!(
        message.ends_with("point field 'damage' has 4 values, expected 5, one per point"),
        "{message}"
    );
    let error = refusal(&grid(&[], &[Field::integer("material", &[0; 5])]));
    let message = error.to_string();
    assert!(
        message.ends_with("cell field 'material' has 5 values, expected 4, one per cell"),
        "{message}"
    );
}

#[test]
fn refuses_two_fields_of_one_name() {
    let field = Field::scalar("damage", &[0.0; 5]);
    let error = refusal(&grid(&[field, field], &[]));
    assert!(
        error
            .to_string()
            .contains("two point fields are named 'damage'")
    );
}

#[test]
fn refuses_a_cell_on_a_missing_point() {
    let cells = [Cell::Line([0, 1]), Cell::Line([1, 5])];
    let error = refusal(&UnstructuredGrid {
        cells: Cells::Mixed(&cells),
        ..grid(&[], &[])
    });
    let expected = "cell 1 names point 5, but there are only 5 points (counted from 0)";
    assert!(error.to_string().ends_with(expected));
}

#[test]
fn refuses_a_grid_that_readers_reject() {
    let no_points = UnstructuredGrid {
        points: &[],
        ..grid(&[], &[])
    };
    let no_cells = UnstructuredGrid {
        cells: Cells::Mixed(&[]),
        ..grid(&[], &[])
    };
    for grid in [no_points, no_cells] {
        let message = refusal(&grid).to_string();
        assert!(message.contains("needs points and cells"), "{message}");
    }
}
