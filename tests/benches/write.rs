//! Writing of fields and rows.
#![allow(clippy::unwrap_used, missing_docs)]

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use ligament_output::csv::{Table, Value};
use ligament_output::vtu::{Cell, Cells, Field, UnstructuredGrid, write_vtu};

/// Fields of a load step: 14 of numbers and 2 of vectors on triangles.
fn fields(criterion: &mut Criterion) {
    let folder = tempfile::tempdir().unwrap();
    let mut group = criterion.benchmark_group("fields");
    for n_row in [100_u32, 200, 325] {
        let points: Vec<[f64; 3]> = (0..n_row * n_row)
            .map(|i| [f64::from(i % n_row) / 7.0, f64::from(i / n_row) / 3.0, 0.0])
            .collect();
        let corner = |row: u32, column: u32| row * n_row + column;
        let cells: Vec<Cell> = (0..n_row - 1)
            .flat_map(|row| (0..n_row - 1).map(move |column| (row, column)))
            .flat_map(|(row, column)| {
                let [a, b] = [corner(row, column), corner(row, column + 1)];
                let [c, d] = [corner(row + 1, column + 1), corner(row + 1, column)];
                [Cell::Triangle([a, b, c]), Cell::Triangle([a, c, d])]
            })
            .collect();
        let numbers: Vec<f64> = points.iter().map(|[x, y, _]| (x * y).sin()).collect();
        let vectors: Vec<[f64; 3]> = points
            .iter()
            .map(|[x, y, _]| [x.sin(), y.cos(), 0.0])
            .collect();
        let names: Vec<String> = (0..14).map(|i| format!("scalar {i}")).collect();
        let mut point_fields = vec![
            Field::vector("displacement", &vectors),
            Field::vector("reaction", &vectors),
        ];
        point_fields.extend(names.iter().map(|name| Field::scalar(name, &numbers)));
        let grid = UnstructuredGrid {
            points: &points,
            cells: Cells::Mixed(&cells),
            point_fields: &point_fields,
            cell_fields: &[],
            field_data: &[],
        };
        let path = folder.path().join("fields.vtu");
        group.throughput(Throughput::Elements(points.len() as u64));
        group.bench_function(BenchmarkId::from_parameter(points.len()), |bencher| {
            bencher.iter(|| write_vtu(&path, &grid).unwrap());
        });
    }
    group.finish();
}

/// A row of `history.csv` with five groups.
fn row(criterion: &mut Criterion) {
    let folder = tempfile::tempdir().unwrap();
    let columns: Vec<String> = (0..31).map(|column| format!("column {column}")).collect();
    let columns: Vec<&str> = columns.iter().map(String::as_str).collect();
    let mut table = Table::create(folder.path().join("history.csv"), &columns).unwrap();
    let row: Vec<Value<'_>> = (0..31_u32)
        .map(|column| match column % 4 {
            0 => Value::from(37 * column),
            _ => Value::from(f64::from(column).sqrt() * 1e-7),
        })
        .collect();
    criterion.bench_function("history row", |bencher| {
        bencher.iter(|| table.append(&row).unwrap());
    });
}

criterion_group!(benches, fields, row);
criterion_main!(benches);
