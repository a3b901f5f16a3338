//! Results of a solid made by hand: a block that a crack splits along z, ahead along x in four steps.

use std::fs;
use std::path::Path;

use ligament_mesh::SolidCell;
use ligament_model::{BodyGrid, Canvas, box_corners};
use ligament_output::csv::{Table, Value};
use ligament_output::vtu::{Cell, Cells, Field, UnstructuredGrid, write_vtu};

/// Horizon of every point, m.
pub const HORIZON: f64 = 2.2;

/// Height of the crack, m.
pub const CRACK: f64 = 3.6;

/// Opening at the mouth of the crack for each metre that the crack is long and each step.
pub const OPENING: f64 = 1e-3;

/// Steps with fields.
pub const STEPS: usize = 4;

/// How far the crack has come in a step, m: through the whole block of length 12 in the last one.
pub fn front(step: usize) -> f64 {
    4.0 * step as f64
}

fn opening(step: usize, x: f64) -> f64 {
    OPENING * step as f64 * (front(step) - x).max(0.0)
}

/// Writes the folder.
pub fn write_results(folder: &Path, body: &BodyGrid) {
    fs::create_dir_all(folder).unwrap();
    fs::write(folder.join("case.resolved.toml"), "title = \"block\"\n").unwrap();
    fs::write(
        folder.join("criteria.csv"),
        "criterion,measure,after\ntension,tension,brittle\n",
    )
    .unwrap();
    let bonds = bonds(&body.positions);
    let step_of: Vec<Option<usize>> = bonds.iter().map(|it| step_of(body, *it)).collect();
    write_model(folder, body, &bonds);
    write_tables(folder, body, &bonds, &step_of);
    for step in 0..STEPS {
        write_fields(
            &folder.join(format!("fields_{step:04}.vtu")),
            body,
            step,
            (&bonds, &step_of),
        );
    }
}

fn bonds(positions: &[[f64; 3]]) -> Vec<[u32; 2]> {
    let mut bonds = Vec::new();
    for (a, p) in (0..).zip(positions) {
        for (b, q) in (0..).zip(positions).skip(a as usize + 1) {
            let square: f64 = (0..3).map(|axis| (q[axis] - p[axis]).powi(2)).sum();
            if square <= HORIZON * HORIZON {
                bonds.push([a, b]);
            }
        }
    }
    bonds
}

/// The step in which the crack reaches a bond across it.
fn step_of(body: &BodyGrid, ends: [u32; 2]) -> Option<usize> {
    let [p, q] = ends.map(|it| body.positions[it as usize]);
    let crosses = (p[2] > CRACK) != (q[2] > CRACK);
    let middle = 0.5 * (p[0] + q[0]);
    (1..STEPS).find(|step| crosses && middle <= front(*step))
}

fn write_model(folder: &Path, body: &BodyGrid, bonds: &[[u32; 2]]) {
    let lines: Vec<Cell> = bonds.iter().copied().map(Cell::Line).collect();
    let ones = vec![1.0; body.positions.len()];
    let horizons = vec![HORIZON; body.positions.len()];
    let zeros = vec![0; body.positions.len()];
    let of_bonds = vec![1.0; bonds.len()];
    let (zero, reach) = (vec![0; bonds.len()], vec![HORIZON; bonds.len()]);
    let limit = vec![1e-3; bonds.len()];
    let grid = UnstructuredGrid {
        points: &body.positions,
        cells: Cells::Mixed(&lines),
        point_fields: &[
            Field::scalar("volume", &ones),
            Field::scalar("horizon", &horizons),
            Field::integer("no_fail", &zeros),
            Field::integer(body.tagged, &body.tags),
        ],
        cell_fields: &[
            Field::integer("absent", &zero),
            Field::scalar("horizon", &reach),
            Field::scalar("length_factor", &of_bonds),
            Field::scalar("domain_factor", &of_bonds),
            Field::scalar("limit.tension", &limit),
        ],
        field_data: &[],
    };
    write_vtu(folder.join("model.vtu"), &grid).unwrap();
}

fn write_tables(folder: &Path, body: &BodyGrid, bonds: &[[u32; 2]], step_of: &[Option<usize>]) {
    let history = [
        "step",
        "load_factor",
        "displacement",
        "reaction",
        "stored_energy",
        "released_energy",
        "broken_bonds",
        "broken_in_step",
        "at_rest",
        "dissipated_energy",
    ];
    let mut table = Table::create(folder.join("history.csv"), &history).unwrap();
    for step in 0..STEPS {
        let broken = step_of.iter().flatten().filter(|it| **it <= step).count();
        let now = step_of.iter().flatten().filter(|it| **it == step).count();
        let size = step as f64;
        let row: [Value<'_>; 10] = [
            step.into(),
            (0.25 * size).into(),
            (1e-3 * size).into(),
            (1e3 * size * (4.0 - size)).into(),
            size.into(),
            (0.5 * size).into(),
            broken.into(),
            now.into(),
            1_usize.into(),
            (0.25 * size).into(),
        ];
        table.append(&row).unwrap();
    }
    let ends = ["a", "b"].map(|end| format!("{}_{end}", body.tagged));
    let breaks = [
        "order",
        "step",
        "round",
        "load_factor",
        "displacement",
        "reaction",
        &ends[0],
        &ends[1],
        "utilisation",
        "criterion",
        "stretch",
        "shear",
    ];
    let mut table = Table::create(folder.join("breaks.csv"), &breaks).unwrap();
    let mut order = 0_usize;
    for step in 1..STEPS {
        for (ends, _) in bonds
            .iter()
            .zip(step_of)
            .filter(|(_, of)| **of == Some(step))
        {
            order += 1;
            let [a, b] = ends.map(|it| body.tags[it as usize]);
            let size = step as f64;
            let row: [Value<'_>; 12] = [
                order.into(),
                step.into(),
                1_usize.into(),
                (0.25 * size).into(),
                (1e-3 * size).into(),
                (1e3 * size).into(),
                a.into(),
                b.into(),
                1.1.into(),
                "tension".into(),
                1.1e-3.into(),
                0.0.into(),
            ];
            table.append(&row).unwrap();
        }
    }
}

fn write_fields(
    path: &Path,
    body: &BodyGrid,
    step: usize,
    (bonds, step_of): (&[[u32; 2]], &[Option<usize>]),
) {
    let moved = |[x, _, z]: &[f64; 3]| {
        let half = 0.5 * opening(step, *x);
        [0.0, 0.0, if *z > CRACK { half } else { -half }]
    };
    let displacement: Vec<[f64; 3]> = body.positions.iter().map(moved).collect();
    let n = body.positions.len();
    let (mut broken, mut all) = (vec![0.0; n], vec![0.0; n]);
    for (ends, of) in bonds.iter().zip(step_of) {
        for end in ends {
            all[*end as usize] += 1.0;
            broken[*end as usize] += f64::from(u8::from(of.is_some_and(|it| it <= step)));
        }
    }
    let damage: Vec<f64> = broken
        .iter()
        .zip(&all)
        .map(|(broken, all)| broken / all)
        .collect();
    let energy: Vec<f64> = body
        .positions
        .iter()
        .map(|p| 10.0 + p[0] + 0.1 * p[1] * p[2])
        .collect();
    let stress: Vec<f64> = body
        .positions
        .iter()
        .flat_map(|[x, y, z]| [*x, *y, x - y, 1e6 * z, 0.0, 1.0])
        .collect();
    let names = ["xx", "yy", "xy", "zz", "xz", "yz"];
    let (ones, horizons) = (vec![1.0; n], vec![HORIZON; n]);
    let fields = [
        Field::vector("displacement", &displacement),
        Field::vector("rotation", &displacement),
        Field::scalar("damage", &damage),
        Field::scalar("strain_energy_density", &energy),
        Field::components("stress_virial", &names, &stress),
        Field::integer(body.tagged, &body.tags),
        Field::scalar("volume", &ones),
        Field::scalar("horizon", &horizons),
    ];
    match &body.canvas {
        Canvas::Solid(cells) => {
            let cells: Vec<Cell> = cells.iter().copied().map(Cell::Solid).collect();
            let grid = UnstructuredGrid {
                points: &body.positions,
                cells: Cells::Mixed(&cells),
                point_fields: &fields,
                cell_fields: &[],
                field_data: &[],
            };
            write_vtu(path, &grid).unwrap();
        }
        Canvas::Boxes(boxes) => {
            let points: Vec<[f64; 3]> = boxes.iter().flat_map(|it| box_corners(*it)).collect();
            let cell = |it: u32| {
                Cell::Solid(SolidCell::Hexahedron(std::array::from_fn(|k| {
                    8 * it + k as u32
                })))
            };
            let cells: Vec<Cell> = (0..boxes.len() as u32).map(cell).collect();
            let corners: Vec<[f64; 3]> = displacement.iter().flat_map(|it| [*it; 8]).collect();
            let grid = UnstructuredGrid {
                points: &points,
                cells: Cells::Mixed(&cells),
                point_fields: &[Field::vector("displacement", &corners)],
                cell_fields: &fields,
                field_data: &[],
            };
            write_vtu(path, &grid).unwrap();
        }
        Canvas::Between(_) | Canvas::Around(_) => panic!("no solid"),
    }
}
