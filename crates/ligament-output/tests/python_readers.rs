//! Results read back by the Python readers of VTK, PyVista and meshio, and by Python's csv module.

#![allow(clippy::unwrap_used)]

use std::path::Path;
use std::process::Command;

use ligament_mesh::SolidCell;
use ligament_output::csv::Table;
use ligament_output::pvd::Collection;
use ligament_output::vtu::{Cell, Cells, Field, UnstructuredGrid, write_vtu};

/// 64 x 64 points: each scalar array fills one compression block exactly.
const N_ROW: u32 = 64;

fn sample_cells() -> Vec<Cell> {
    let corners = |row, column| {
        let first = row * N_ROW + column;
        [first, first + 1, first + N_ROW + 1, first + N_ROW]
    };
    let mut cells: Vec<Cell> = (0..N_ROW - 1)
        .flat_map(|row| (0..N_ROW - 1).map(move |column| Cell::Quad(corners(row, column))))
        .collect();
    cells.extend([
        Cell::Triangle([0, 1, 64]),
        Cell::Line([0, 4095]),
        Cell::Vertex([7]),
    ]);
    let solids = [
        SolidCell::Tetrahedron([0, 1, 64, 4095]),
        SolidCell::Hexahedron([0, 1, 65, 64, 128, 129, 193, 192]),
        SolidCell::Prism([0, 1, 64, 128, 129, 192]),
        SolidCell::Pyramid([0, 1, 65, 64, 4095]),
    ];
    cells.extend(solids.map(Cell::Solid));
    cells
}

/// What `read_sample.py` expects, formula for formula.
fn write_sample(folder: &Path) {
    let point = |i: u32| {
        let [x, y] = [f64::from(i % N_ROW) * 0.1, f64::from(i / N_ROW) / 3.0];
        [x, y, x * y - 1.0]
    };
    let points: Vec<[f64; 3]> = (0..N_ROW * N_ROW).map(point).collect();
    let cells = sample_cells();
    let displacement: Vec<[f64; 3]> = points.iter().map(|&[x, y, _]| [x * y, -x, 0.0]).collect();
    let mut damage: Vec<f64> = points.iter().map(|&[x, y, _]| x / (1.0 + y)).collect();
    damage[1..4].copy_from_slice(&[f64::NAN, f64::NEG_INFINITY, -0.0]);
    let single: Vec<f32> = damage.iter().map(|&it| it as f32).collect();
    let stress: Vec<f64> = points.iter().flat_map(|&[x, y, _]| [x, y, x - y]).collect();
    let n_bonds: Vec<i64> = (0..i64::from(N_ROW * N_ROW)).map(|i| i - 5).collect();
    let mut material: Vec<i64> = (0..cells.len() as i64).collect();
    material[..2].copy_from_slice(&[i64::MAX, i64::MIN]);
    let grid = UnstructuredGrid {
        points: &points,
        cells: Cells::Mixed(&cells),
        point_fields: &[
            Field::scalar("damage", &damage),
            Field::vector("displacement", &displacement),
            Field::integer("n_bonds <&>", &n_bonds),
            Field::single("single", &single),
            Field::components("stress", &["xx", "yy", "xy"], &stress),
        ],
        cell_fields: &[Field::integer("material", &material)],
        field_data: &[],
    };
    let mut collection = Collection::new(folder.join("fields.pvd"));
    for (step, time) in [0.0, 1e-7, 0.1 + 0.2].into_iter().enumerate() {
        let file = format!("fields & {step:04}.vtu");
        write_vtu(folder.join(&file), &grid).unwrap();
        collection.append(time, file).unwrap();
    }
    write_history(folder, &damage);
}

fn write_history(folder: &Path, reactions: &[f64]) {
    let columns = ["step", "reaction, kN", "status"];
    let mut table = Table::create(folder.join("history.csv"), &columns).unwrap();
    let status = "a \"quoted\", text\nin two lines";
    for (step, &reaction) in reactions.iter().enumerate() {
        let row = [step.into(), reaction.into(), status.into()];
        table.append(&row).unwrap();
    }
}

#[test]
#[ignore = "needs LIGAMENT_PYTHON; run by tools/test"]
fn python_reads_back_what_was_written() {
    let python = std::env::var_os("LIGAMENT_PYTHON")
        .expect("set LIGAMENT_PYTHON to a Python with tools/requirements.txt installed");
    let folder = tempfile::tempdir().unwrap();
    write_sample(folder.path());
    let output = Command::new(python)
        .arg(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/read_sample.py"))
        .arg(folder.path())
        .output()
        .unwrap();
    let text = String::from_utf8_lossy(&output.stdout);
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{text}{errors}");
    assert!(text.ends_with("all readers agree\n"), "{text}{errors}");
}
