#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::fs;

use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;

use super::*;
use crate::vtu::{Cell, Cells, Field, UnstructuredGrid, write_vtu};
use ligament_mesh::SolidCell;
use proptest::prelude::*;

/// Numbers of arbitrary bits, including NaN.
fn floats(len: usize) -> impl Strategy<Value = Vec<f64>> {
    proptest::collection::vec(any::<u64>().prop_map(f64::from_bits), len)
}

fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|value| value.to_bits()).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// A block has 4096 numbers: lengths around one block and two blocks.
    #[test]
    fn what_was_written_is_read(
        (numbers, integers) in prop_oneof![1_usize..9, 4094_usize..4099, 8191_usize..8194]
            .prop_flat_map(|len| (floats(len), proptest::collection::vec(any::<i64>(), len))),
        name: String,
    ) {
        let n_points = numbers.len();
        let is_place = |x: f64| x.abs() < 1e100;
        let places = numbers.iter().map(|x| if is_place(*x) { *x } else { 0.5 });
        let points: Vec<[f64; 3]> = places.map(|x| [x, -x, 0.5 * x]).collect();
        let cells: Vec<Cell> = (0..n_points as u32 - 1)
            .map(|point| Cell::Line([point, point + 1]))
            .chain([Cell::Vertex([0])])
            .chain([
                SolidCell::Tetrahedron([0; 4]),
                SolidCell::Hexahedron([0; 8]),
                SolidCell::Prism([0; 6]),
                SolidCell::Pyramid([0; 5]),
            ].map(Cell::Solid))
            .collect();
        let of_cells = |values: &[f64]| -> Vec<f64> {
            (0..cells.len()).map(|it| values[it % n_points]).collect()
        };
        let single: Vec<f32> = (0..n_points).map(|point| point as f32 / 7.0).collect();
        let vectors: Vec<[f64; 3]> = of_cells(&numbers).iter().map(|x| [*x, 0.0, -*x]).collect();
        let integers: Vec<i64> = (0..cells.len()).map(|it| integers[it % n_points]).collect();
        let grid = UnstructuredGrid {
            points: &points,
            cells: Cells::Mixed(&cells),
            point_fields: &[Field::scalar(&name, &numbers), Field::single("f32", &single)],
            cell_fields: &[Field::integer(&name, &integers), Field::vector("v", &vectors)],
            field_data: &[],
        };
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.vtu");
        write_vtu(&path, &grid).unwrap();

        let file = VtuFile::open(&path).unwrap();
        let (on_points, on_cells) = (FieldLocation::Point, FieldLocation::Cell);
        let read = file.numbers(on_points, &name).unwrap().unwrap();
        prop_assert_eq!(bits(&read), bits(&numbers));
        let is_finite = numbers.iter().all(|it| is_place(*it));
        prop_assert_eq!(file.finite_numbers(on_points, &name).is_ok(), is_finite);
        let read = file.numbers(on_points, "f32").unwrap().unwrap();
        prop_assert!(read.iter().zip(&single).all(|(a, b)| *a == f64::from(*b)));
        prop_assert_eq!(read.len(), n_points);
        let whole: Vec<f64> = integers.iter().map(|it| *it as f64).collect();
        prop_assert_eq!(file.numbers(on_cells, &name).unwrap(), Some(whole));
        prop_assert_eq!(file.integers(on_cells, &name).unwrap(), Some(integers));
        let read = file.numbers(on_cells, "v").unwrap().unwrap();
        prop_assert_eq!(bits(&read), bits(vectors.as_flattened()));
        let read = file.points().unwrap();
        prop_assert_eq!(bits(read.as_flattened()), bits(points.as_flattened()));
        prop_assert_eq!(file.cells().unwrap(), cells);
        prop_assert_eq!(file.components(on_cells, "v"), Some((3, &[][..])));
        prop_assert_eq!(file.components(on_points, "v"), None);
        prop_assert_eq!(file.numbers(on_cells, "w").unwrap(), None);
        prop_assert!(file.lines().is_err(), "one cell is no line");
        prop_assert!(file.integers(on_points, &name).is_err(), "numbers are no integers");
    }
}

fn sample() -> (tempfile::TempDir, PathBuf, String) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.vtu");
    let grid = UnstructuredGrid {
        points: &[[0.0, 1.0, 4.0], [2.0, 3.0, 5.0]],
        cells: Cells::Mixed(&[Cell::Line([0, 1])]),
        point_fields: &[Field::scalar("damage", &[0.25, 0.5])],
        cell_fields: &[],
        field_data: &[],
    };
    write_vtu(&path, &grid).unwrap();
    let text = fs::read_to_string(&path).unwrap();
    (folder, path, text)
}

/// No damage of a file panics or gives numbers that were not written.
#[test]
fn damaged_files_are_refused_or_read_as_they_were() {
    let (_folder, path, text) = sample();
    for cut in 0..text.len() {
        fs::write(&path, &text[..cut]).unwrap();
        let whole_but_for_its_last_line_feed = cut + 1 == text.len();
        assert_eq!(
            VtuFile::open(&path).is_ok(),
            whole_but_for_its_last_line_feed,
            "{cut}"
        );
    }
    let mut refused = 0;
    for place in 0..text.len() {
        let mut bytes = text.clone().into_bytes();
        bytes[place] = if bytes[place] == b'A' { b'B' } else { b'A' };
        fs::write(&path, &bytes).unwrap();
        let read =
            VtuFile::open(&path).and_then(|file| file.numbers(FieldLocation::Point, "damage"));
        match read {
            Err(_) | Ok(None) => refused += 1,
            Ok(Some(values)) => assert_eq!(values, [0.25, 0.5], "{place}"),
        }
    }
    assert!(refused > 100, "{refused}");
}

#[test]
fn what_is_no_result_file_is_named() {
    let (_folder, path, text) = sample();
    let message = |text: &str| {
        fs::write(&path, text).unwrap();
        VtuFile::open(&path).unwrap_err().to_string()
    };
    assert!(message("mesh").ends_with("a.vtu: it is no VTU file of this program"));
    let other = text.replace("vtkZLibDataCompressor", "vtkLZ4DataCompressor");
    assert!(message(&other).ends_with("it is no VTU file of this program"));
    let unclosed = message(&text.replace("</Piece>", ""));
    assert!(
        unclosed.contains("a.vtu: it is damaged: expected 'Piece' tag"),
        "{unclosed}"
    );
    let open = VtuFile::open(path.with_file_name("b.vtu"));
    assert!(matches!(open, Err(Error::System { action: "read", .. })));
}

/// A small file whose zeros inflate far beyond its size: the sizes in the header of its array are not trusted.
#[test]
fn what_inflates_beyond_its_file_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bomb.vtu");
    let zeros = miniz_oxide::deflate::compress_to_vec_zlib(&vec![0; 1 << 20], 9);
    let n_blocks = 2000_usize;
    let mut header: Vec<u64> = vec![n_blocks as u64, 1 << 20, 0];
    header.extend(std::iter::repeat_n(zeros.len() as u64, n_blocks));
    let header: Vec<u8> = header.iter().flat_map(|it| it.to_le_bytes()).collect();
    let content = BASE64_STANDARD.encode(header) + &BASE64_STANDARD.encode(zeros.repeat(n_blocks));
    let file = |n_points: usize| {
        format!(
            "<VTKFile type=\"UnstructuredGrid\" byte_order=\"LittleEndian\" header_type=\"UInt64\" \
             compressor=\"vtkZLibDataCompressor\"><Piece NumberOfPoints=\"{n_points}\" NumberOfCells=\"1\"><PointData>\
             <DataArray type=\"Float64\" Name=\"damage\">{content}</DataArray></PointData></Piece></VTKFile>"
        )
    };
    std::fs::write(&path, file((n_blocks << 20) / 8)).unwrap();
    let message = VtuFile::open(&path).unwrap_err().to_string();
    assert!(
        message.ends_with("it is too short for its number of points and cells"),
        "{message}"
    );
    std::fs::write(&path, file(1000)).unwrap();
    let read = VtuFile::open(&path).unwrap();
    let message = read
        .numbers(FieldLocation::Point, "damage")
        .unwrap_err()
        .to_string();
    assert!(message.ends_with("array damage is damaged"), "{message}");
}
