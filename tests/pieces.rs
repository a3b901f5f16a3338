//! Grids that several processes write in pieces read as one process would have written them. The processes are threads here.
#![allow(clippy::unwrap_used)]

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::sync::Arc;

use ligament_analysis::distributed_matrix::{MatrixCommunicator, SingleProcess};
use ligament_case::case::CaseFile;
use ligament_cli::explain::{Position, Request, Subject, explain};
use ligament_model::PointCloud;
use ligament_model::subdomain::Subdomain;
use ligament_output::FieldLocation::{self, Cell as OnCells, Point as OnPoints};
use ligament_output::results::stored::StoredRun;
use ligament_output::summary::Build;
use ligament_output::vtu::read::VtuFile;
use ligament_output::vtu::{
    Cell, Cells, Field, GlobalIndices, SharedCells, TIME_VALUE, UnstructuredGrid, write_shared,
    write_vtu,
};
use ligament_run::progress::ProgressMode;
use ligament_run::run;
use verification::problems::SQUARE;
use verification::threads_as_ranks::on_ranks;

const COLUMNS: usize = 7;
const ROWS: usize = 5;

/// A body of rows and columns of points.
struct Body {
    cloud: PointCloud,
    positions: Vec<[f64; 3]>,
    cells: Vec<Cell>,
    stress: Vec<f64>,
    damage: Vec<f64>,
    area: Vec<f64>,
    tags: Vec<i64>,
}

impl Body {
    fn new() -> Self {
        let n = COLUMNS * ROWS;
        let places = (0..n).map(|it| [(it % COLUMNS) as f64, (it / COLUMNS) as f64]);
        let places: Vec<[f64; 2]> = places.collect();
        let corner = |it: usize| (it % (COLUMNS - 1) + it / (COLUMNS - 1) * COLUMNS) as u32;
        let right = COLUMNS as u32;
        let quads = (0..(COLUMNS - 1) * (ROWS - 1)).map(|it| {
            let first = corner(it);
            Cell::Quad([first, first + 1, first + right + 1, first + right])
        });
        Self {
            positions: places.iter().map(|&[x, y]| [x, y, 0.0]).collect(),
            cells: quads.collect(),
            stress: (0..3 * n).map(|it| it as f64 - 7.5).collect(),
            damage: (0..n).map(|it| 1.0 / (1.0 + it as f64)).collect(),
            area: (0..(COLUMNS - 1) * (ROWS - 1))
                .map(|it| it as f64)
                .collect(),
            tags: (0..n as i64).map(|it| 100 - it).collect(),
            cloud: PointCloud {
                positions: places,
                precision: 0.0,
                origin: [0.0; 2],
                thickness: 1.0,
                volumes: vec![1.0; n].into(),
                spacing: vec![1.0; n].into(),
                lattice_cell: None,
                n_materials: 1,
                material_shares: vec![1.0; n],
                curve: (0..n as u32).collect(),
                numbering: Default::default(),
                subdomain: Subdomain::whole(n),
            },
        }
    }

    /// Does something with the grid of some cells, a field of numbers a cell and the fields of the points.
    fn grid<T>(
        &self,
        cells: &[Cell],
        area: &[f64],
        then: impl Fn(&UnstructuredGrid<'_>) -> T,
    ) -> T {
        then(&UnstructuredGrid {
            points: &self.positions,
            cells: Cells::Mixed(cells),
            point_fields: &[
                Field::scalar("damage", &self.damage),
                Field::components("stress", &["xx", "yy", "xy"], &self.stress),
                Field::integer("node", &self.tags),
            ],
            cell_fields: &[Field::scalar("area", area)],
            field_data: &[(TIME_VALUE, 3.0), ("load_factor", 0.1 + 0.2)],
        })
    }

    /// The first point of each cell.
    fn points(cells: &[Cell]) -> Vec<u32> {
        cells.iter().map(|it| it.points()[0]).collect()
    }
}

/// Indices of all points or cells: each process knows the whole body.
fn all(count: usize) -> Vec<u32> {
    (0..count as u32).collect()
}

fn numbers(file: &VtuFile, location: FieldLocation, name: &str) -> Vec<f64> {
    file.required_numbers(location, name).unwrap()
}

#[test]
fn pieces_read_as_the_whole() {
    let (body, folder) = (Body::new(), tempfile::tempdir().unwrap());
    let [single, shared] = ["fields.vtu", "fields.pvtu"].map(|it| folder.path().join(it));
    body.grid(&body.cells, &body.area, |grid| write_vtu(&single, grid))
        .unwrap();
    on_ranks(3, |ranks| {
        let subdomain = body.cloud.divided(ranks);
        let cells = SharedCells {
            subdomain: &subdomain,
            points: &Body::points(&body.cells),
            global: GlobalIndices {
                points: &all(body.positions.len()),
                cells: Some(&all(body.cells.len())),
            },
        };
        let write = |grid: &UnstructuredGrid<'_>| write_shared(&shared, grid, cells);
        body.grid(&body.cells, &body.area, write).unwrap();
    });
    let [whole, joined] = [single, shared].map(|it| VtuFile::open(it).unwrap());
    assert_eq!(joined.points().unwrap(), whole.points().unwrap());
    assert_eq!(joined.cells().unwrap(), whole.cells().unwrap());
    assert_eq!(joined.field_data().unwrap(), whole.field_data().unwrap());
    assert_eq!(joined.time().unwrap(), Some(3.0));
    let fields =
        |file: &VtuFile, location| file.fields(location).map(str::to_owned).collect::<Vec<_>>();
    for location in [OnPoints, OnCells] {
        assert_eq!(fields(&joined, location), fields(&whole, location));
        for name in fields(&whole, location) {
            assert_eq!(
                joined.components(location, &name),
                whole.components(location, &name)
            );
            let [found, expected] = [&joined, &whole].map(|it| numbers(it, location, &name));
            assert_eq!(found, expected, "{name}");
        }
    }
    assert_eq!(
        joined.tags(OnPoints).unwrap(),
        whole.tags(OnPoints).unwrap()
    );
    // Each process wrote some of the cells, and a point where their parts meet is in several pieces.
    let piece = |rank: usize| {
        VtuFile::open(folder.path().join(format!("fields.piece_{rank}.vtu"))).unwrap()
    };
    let pieces: Vec<VtuFile> = (0..3).map(piece).collect();
    let n_cells: Vec<usize> = pieces.iter().map(|it| it.cells().unwrap().len()).collect();
    assert_eq!(n_cells.iter().sum::<usize>(), body.cells.len());
    assert!(n_cells.iter().all(|it| *it > 0 && *it < body.cells.len()));
    let n_points: usize = pieces.iter().map(|it| it.points().unwrap().len()).sum();
    assert!(n_points > COLUMNS * ROWS);
}

/// Lines between points of two processes are known to both, each with a number of its own, and written by the process of the first end.
#[test]
fn lines_that_two_processes_know_are_written_once() {
    let (body, folder) = (Body::new(), tempfile::tempdir().unwrap());
    let path = folder.path().join("model.pvtu");
    let all: Vec<[u32; 2]> = (0..(COLUMNS * ROWS - 2) as u32)
        .map(|it| [it, it + 2])
        .collect();
    on_ranks(3, |ranks| {
        let subdomain = body.cloud.divided(ranks);
        let known: Vec<[u32; 2]> = all
            .iter()
            .copied()
            .filter(|it| subdomain.contains_bond(*it))
            .collect();
        let points = self::all(body.positions.len());
        let lines: Vec<Cell> = known.iter().copied().map(Cell::Line).collect();
        let first: Vec<f64> = known.iter().map(|it| f64::from(it[0])).collect();
        let cells = SharedCells {
            subdomain: &subdomain,
            points: &Body::points(&lines),
            global: GlobalIndices {
                points: &points,
                cells: None,
            },
        };
        body.grid(&lines, &first, |grid| write_shared(&path, grid, cells))
            .unwrap();
    });
    let read = VtuFile::open(&path).unwrap();
    let (lines, first) = (read.lines().unwrap(), numbers(&read, OnCells, "area"));
    assert!(
        lines
            .iter()
            .zip(&first)
            .all(|(ends, first)| f64::from(ends[0]) == *first)
    );
    let mut sorted = lines.clone();
    sorted.sort_unstable();
    assert_eq!(sorted, all);
    assert_eq!(numbers(&read, OnPoints, "damage"), body.damage);
}

fn error(path: &Path) -> String {
    VtuFile::open(path).unwrap_err().to_string()
}

#[test]
fn what_is_missing_of_a_grid_in_pieces_is_told() {
    let (body, folder) = (Body::new(), tempfile::tempdir().unwrap());
    let path = folder.path().join("fields.pvtu");
    let write = |path: &Path| {
        on_ranks(2, |ranks| {
            let subdomain = body.cloud.divided(ranks);
            let cells = SharedCells {
                subdomain: &subdomain,
                points: &Body::points(&body.cells),
                global: GlobalIndices {
                    points: &all(body.positions.len()),
                    cells: Some(&all(body.cells.len())),
                },
            };
            let write = |grid: &UnstructuredGrid<'_>| write_shared(path, grid, cells);
            body.grid(&body.cells, &body.area, write)
                .map_err(|it| it.to_string())
        })
    };
    assert!(write(&path).iter().all(Result::is_ok));
    let text = fs::read_to_string(&path).unwrap();
    fs::write(
        &path,
        text.replace("<Piece Source=\"fields.piece_1.vtu\"/>", ""),
    )
    .unwrap();
    assert!(error(&path).ends_with("its pieces do not make a whole"));
    fs::write(&path, &text[..text.len() / 2]).unwrap();
    assert!(error(&path).ends_with("it is no PVTU file of this program"));
    fs::write(&path, text).unwrap();
    fs::remove_file(folder.path().join("fields.piece_1.vtu")).unwrap();
    assert!(error(&path).contains("fields.piece_1.vtu"));
    // A process that cannot write ends all of them.
    fs::create_dir(folder.path().join("other.piece_1.vtu")).unwrap();
    let ended = write(&folder.path().join("other.pvtu"));
    assert!(
        ended[0]
            .as_ref()
            .unwrap_err()
            .ends_with("process 1 could not write it")
    );
    assert!(ended[1].is_err());
}

/// Limits of the last criterion, by which bonds soften, at the end of a run and at its start, by the tags of the ends of the bonds.
fn limits(folder: &Path) -> BTreeMap<[i64; 2], [f64; 2]> {
    let model = StoredRun::open(folder).unwrap().model;
    let criterion = model.criteria.last().unwrap();
    let tags = model
        .bonds
        .ends
        .iter()
        .map(|ends| ends.map(|end| model.tags[end as usize]));
    let limits = criterion.limit.iter().zip(&criterion.limit_at_start);
    tags.zip(limits.map(|(end, start)| [*end, *start]))
        .collect()
}

/// Limits of bonds that began to soften are stored by two processes, each for its own bonds, as one process stores them: to 1e-6, because
/// solutions of one and of two processes differ by rounding.
#[test]
fn limits_of_begun_bonds_are_stored_in_pieces() {
    let folder = tempfile::tempdir().unwrap();
    let softens =
        "fracture = { steps = 12, criterion = [{ kind = \"rankine\", after = \"linear\" }] }";
    let (body, _) = SQUARE.split_once("fracture = ").unwrap();
    let body = body.replace(
        "tensile_strength",
        "fracture_energy = 60.0, tensile_strength",
    );
    let mesh = verification::repository().join("tests/reference/square.msh");
    let body = body.replace("reference/square.msh", mesh.to_str().unwrap());
    let path = folder.path().join("case.toml");
    fs::write(&path, format!("{body}{softens}\n")).unwrap();
    let run = |name: &str, communicator: Arc<dyn MatrixCommunicator>| {
        let case = CaseFile::load(&path, &[]).unwrap();
        let out = folder.path().join(name);
        let request = run::Request {
            communicator,
            ..run::Request::new(&case, &out, Build::default())
        };
        request.run(ProgressMode::Quiet).unwrap();
        out
    };
    let alone = limits(&run("alone", Arc::new(SingleProcess)));
    let together = on_ranks(2, |ranks| run("together", ranks));
    assert!(together[0].join("model.pvtu").is_file());
    let request = Request {
        folder: together[0].clone(),
        subject: Subject::At(Position::InPlane([0.05, 0.05])),
        csv: None,
        json: None,
        force: false,
    };
    let mut said = Vec::new();
    explain(&request, &mut said).unwrap();
    let said = String::from_utf8(said).unwrap();
    assert!(
        said.contains("note: several processes ran the case"),
        "{said}"
    );
    let together = limits(&together[0]);
    assert_eq!(alone.len(), together.len());
    let begun = alone.values().filter(|it| it[0].is_finite());
    assert!(begun.count() > 20);
    for (ends, [end, start]) in alone {
        assert_eq!(start, f64::INFINITY);
        let [found, start] = together[&ends];
        assert_eq!(start, f64::INFINITY);
        assert!(
            found == end || (found / end - 1.0).abs() < 1e-6,
            "{ends:?}: {found} {end}"
        );
    }
}
