//! Small bodies of every kind, and what their fields are drawn on.

use std::path::Path;

use ligament::Body;
use ligament_mesh::{Cell, Group, Mesh};
use ligament_model::Canvas as Drawn;
use ligament_run::model::Model;
use verification::meshes;

use super::expected::{Expected, Place};

/// What the squares of a small plate are made of.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Squares {
    Triangles,
    Quadrangles,
    /// Quadrangles on the left, triangles on the right.
    Both,
}

const COLUMNS: u32 = 12;
const ROWS: u32 = 8;

/// A plate of 12 by 8 uneven squares of about 0.01 m whose nodes have tags with gaps, falling and rising: no two points are alike.
/// Curves `left`, `right` and `bottom`, surfaces `soft` (the upper half) and `hard`.
pub(crate) fn plate(squares: Squares) -> Mesh {
    let row = COLUMNS + 1;
    let node = |i: u32, j: u32| j * row + i;
    // The fractional parts of multiples of irrational numbers: uneven, without a generator.
    let uneven = |k: u32, of: f64| 0.2 * ((f64::from(k) * of).fract() - 0.5);
    let position = |k: u32| {
        let (i, j) = (f64::from(k % row), f64::from(k / row));
        [
            0.01 * (i + uneven(k, 2_f64.sqrt())),
            0.01 * (j + uneven(k, 3_f64.sqrt())),
        ]
    };
    let n_nodes = row * (ROWS + 1);
    let mut cells = Vec::new();
    let mut surfaces = [Vec::new(), Vec::new()];
    for j in 0..ROWS {
        for i in 0..COLUMNS {
            let [a, b, c, d] = [
                node(i, j),
                node(i + 1, j),
                node(i + 1, j + 1),
                node(i, j + 1),
            ];
            let surface = &mut surfaces[usize::from(2 * j < ROWS)];
            let first = cells.len() as u32;
            match squares {
                Squares::Both if 2 * i < COLUMNS => cells.push(Cell::Quadrangle([a, b, c, d])),
                Squares::Quadrangles => cells.push(Cell::Quadrangle([a, b, c, d])),
                _ => cells.extend([Cell::Triangle([a, b, c]), Cell::Triangle([a, c, d])]),
            }
            surface.extend(first..cells.len() as u32);
        }
    }
    let curve = |name: &str, number, nodes: Vec<u32>| Group {
        name: name.to_owned(),
        dimension: 1,
        number,
        edges: nodes.windows(2).map(|pair| [pair[0], pair[1]]).collect(),
        nodes,
        ..Group::default()
    };
    let [soft, hard] = surfaces;
    let surface = |name: &str, number, cells: Vec<u32>| Group {
        name: name.to_owned(),
        dimension: 2,
        number,
        cells,
        ..Group::default()
    };
    Mesh {
        node_tags: (0..u64::from(n_nodes))
            .map(|k| if k % 2 == 0 { 900 - 7 * k } else { 901 + 5 * k })
            .collect(),
        positions: (0..n_nodes).map(position).collect(),
        cells,
        groups: vec![
            curve("left", 1, (0..=ROWS).map(|j| node(0, j)).collect()),
            curve("right", 2, (0..=ROWS).map(|j| node(COLUMNS, j)).collect()),
            curve("bottom", 3, (0..=COLUMNS).map(|i| node(i, 0)).collect()),
            surface("soft", 4, soft),
            surface("hard", 5, hard),
        ],
        fields: Vec::new(),
        remarks: Vec::new(),
    }
}

/// What the fields of the points are drawn on.
pub(crate) enum Canvas {
    /// Between the points.
    Mesh {
        positions: Vec<[f64; 2]>,
        cells: Vec<Vec<u32>>,
    },
    /// A square of its own for each point, by its corners.
    Lattice(Vec<[[f64; 2]; 4]>),
}

/// The fields of the points in a file.
pub(crate) struct PointFields<'a> {
    file: &'a str,
    part: &'a str,
    expected: &'a mut Expected,
}

impl Canvas {
    /// Of the mesh file of a case, or of its lattice.
    pub(crate) fn new(mesh: Option<&Path>, body: &dyn Body) -> Self {
        match mesh {
            Some(file) => {
                let mesh = meshes::read(file);
                let cells = mesh.cells.iter().map(|cell| cell.corners().to_vec());
                Self::Mesh {
                    cells: cells.collect(),
                    positions: mesh.positions,
                }
            }
            None => match body.grid().canvas {
                Drawn::Around(corners) => Self::Lattice(corners),
                _ => panic!("a lattice has squares of its own for its points"),
            },
        }
    }

    /// Points and cells.
    pub(crate) fn grid(&self, file: &str, expected: &mut Expected) {
        match self {
            Self::Mesh { positions, cells } => {
                let cells = cells.iter().map(Vec::as_slice);
                expected.grid(file, positions.iter().copied(), cells);
            }
            Self::Lattice(corners) => {
                let count = 4 * corners.len() as u32;
                let numbers: Vec<u32> = (0..count).collect();
                expected.grid(file, corners.iter().flatten().copied(), numbers.chunks(4));
            }
        }
    }

    /// The displacement of the points, which corners of their own share.
    pub(crate) fn displacement(&self, file: &str, values: &[[f64; 3]], expected: &mut Expected) {
        let name = "displacement";
        let place = |part| Place { file, part, name };
        let none = ["", "", ""];
        if let Self::Lattice(_) = self {
            expected.components(place("cell"), none, values.iter().copied());
            let corners = values.iter().flat_map(|it| [*it; 4]);
            expected.components(place("point"), none, corners);
        } else {
            expected.components(place("point"), none, values.iter().copied());
        }
    }

    pub(crate) fn on<'a>(&self, file: &'a str, expected: &'a mut Expected) -> PointFields<'a> {
        let part = match self {
            Self::Mesh { .. } => "point",
            Self::Lattice(_) => "cell",
        };
        PointFields {
            file,
            part,
            expected,
        }
    }
}

impl<'a> PointFields<'a> {
    fn place<'b>(&self, name: &'b str) -> Place<'b>
    where
        'a: 'b,
    {
        Place {
            file: self.file,
            part: self.part,
            name,
        }
    }

    pub(crate) fn reals(&mut self, name: &str, values: impl IntoIterator<Item = f64>) {
        let place = self.place(name);
        self.expected.reals(place, values);
    }

    pub(crate) fn integers(&mut self, name: &str, values: impl IntoIterator<Item = i64>) {
        let place = self.place(name);
        self.expected.integers(place, values);
    }

    pub(crate) fn components<const N: usize>(
        &mut self,
        name: &str,
        names: [&str; N],
        values: impl IntoIterator<Item = [f64; N]>,
    ) {
        let place = self.place(name);
        self.expected.components(place, names, values);
    }

    /// The tag of every point.
    pub(crate) fn tags(&mut self, model: &Model) {
        let points = 0..model.plane().cloud.len() as u32;
        let tags = points.map(|it| model.body().tag(it) as i64);
        self.integers(model.body().tagged(), tags);
    }

    /// The fields that a run does not change.
    pub(crate) fn fixed(&mut self, model: &Model) {
        let (cloud, fixed) = (&model.plane().cloud, &model.fixed);
        self.tags(model);
        self.reals("volume", cloud.volumes.iter().copied());
        self.reals("horizon", fixed.horizon.iter().copied());
        self.reals("nearest_distance", cloud.spacing.iter().copied());
        self.reals("precrack_share", fixed.precrack_share.iter().copied());
        let names = ["x", "y", "biaxial", "shear"].map(|it| format!("energy_ratio_{it}"));
        for (name, ratio) in names.iter().zip(&fixed.energy_ratios) {
            self.reals(name, ratio.at_points.iter().copied());
        }
        if !fixed.material_of_cell.is_empty() {
            let place = Place {
                part: "cell",
                ..self.place("material")
            };
            let materials = fixed.material_of_cell.iter().copied();
            self.expected.integers(place, materials);
        }
        for scatter in &fixed.scatter {
            self.reals("strength_factor", scatter.at_points.iter().copied());
        }
    }
}
