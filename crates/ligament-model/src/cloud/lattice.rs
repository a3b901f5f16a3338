//! A regular lattice: points at the centres of the cells of a rectangle, some of which may be removed.

use super::PointCloud;
use crate::curve::along_hilbert_curve;
use crate::horizon::INCLUSION_TOLERANCE;
use crate::shape::Shape;

/// A rectangle of equal cells without those that holes take away.
///
/// The cells that are left are numbered row by row from the lower left corner, x fastest.
#[derive(Debug, Clone, PartialEq)]
pub struct Lattice {
    /// Cells nx, ny of the whole rectangle.
    pub size: [u32; 2],
    /// Sides dx, dy of a cell, m.
    pub spacing: [f64; 2],
    /// Lower left corner of the rectangle, m.
    pub corner: [f64; 2],
    /// Holes: cells whose centre lies in one are removed, and bonds across one are no bonds.
    pub holes: Vec<Shape>,
    /// Column and row (from 0) of each cell that is left, shape (n_points).
    pub cells: Vec<[u32; 2]>,
}

/// A side of a cell behind which there is no cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Face {
    /// The point at the centre of the cell.
    pub point: u32,
    /// Outward normal.
    pub normal: [i8; 2],
    /// Whether the face lies on the outline of the rectangle.
    pub is_on_rectangle: bool,
    /// Number of the first hole in which the centre of the missing cell lies; the cells go on beyond the rectangle.
    pub hole: Option<usize>,
}

impl Lattice {
    /// The rectangle of nx by ny cells with its lower left corner at `corner`, without the cells whose centre lies in one
    /// of the holes (rim included, to 1e-9 of the spacing).
    pub fn new(size: [u32; 2], spacing: [f64; 2], corner: [f64; 2], holes: Vec<Shape>) -> Self {
        let whole = (0..size[1]).flat_map(|row| (0..size[0]).map(move |column| [column, row]));
        let mut lattice = Self {
            size,
            spacing,
            corner,
            holes,
            cells: Vec::new(),
        };
        let local: Vec<Shape> = lattice
            .holes
            .iter()
            .map(|hole| lattice.local(hole))
            .collect();
        let slack = lattice.slack();
        lattice.cells = whole
            .filter(|&cell| {
                let centre = lattice.offset(cell);
                !local.iter().any(|hole| hole.contains(centre, slack))
            })
            .collect();
        lattice
    }

    /// Number of cells of the whole rectangle.
    pub fn n_whole(&self) -> usize {
        self.size[0] as usize * self.size[1] as usize
    }

    /// Middle of the rectangle, m.
    pub fn middle(&self) -> [f64; 2] {
        [0, 1].map(|axis| self.corner[axis] + 0.5 * f64::from(self.size[axis]) * self.spacing[axis])
    }

    /// Centre of a cell relative to the middle of the rectangle, m: a whole number of half cells, so that opposite cells
    /// have opposite positions to the last bit and distances are rounded but once.
    pub fn offset(&self, cell: [u32; 2]) -> [f64; 2] {
        self.centre(cell.map(i64::from))
    }

    /// Centre of a cell that may lie beyond the rectangle, relative to the middle of the rectangle, m.
    fn centre(&self, cell: [i64; 2]) -> [f64; 2] {
        [0, 1].map(|axis| {
            let half_cells = 2 * cell[axis] + 1 - i64::from(self.size[axis]);
            half_cells as f64 * (0.5 * self.spacing[axis])
        })
    }

    /// The number of the point in a cell that may lie beyond the rectangle; None where there is none.
    fn point_in(&self, [column, row]: [i64; 2]) -> Option<u32> {
        let place = |&[column, row]: &[u32; 2]| [i64::from(row), i64::from(column)];
        let found = self.cells.binary_search_by_key(&[row, column], place);
        found.ok().map(|point| point as u32)
    }

    /// The faces between two cells: the point on the left or below, the normal towards the other and the other point.
    pub fn inner_faces(&self) -> Vec<(u32, [i8; 2], u32)> {
        let of_cell = |(point, cell): (u32, &[u32; 2])| {
            let [column, row] = cell.map(i64::from);
            let right = self.point_in([column + 1, row]);
            let above = self.point_in([column, row + 1]);
            [([1, 0], right), ([0, 1], above)]
                .into_iter()
                .filter_map(move |(normal, next)| Some((point, normal, next?)))
        };
        (0..).zip(&self.cells).flat_map(of_cell).collect()
    }

    /// The squares between the centres of four cells around a corner, anticlockwise.
    pub fn squares(&self) -> Vec<[u32; 4]> {
        let around = |cell: &[u32; 2]| {
            let [column, row] = cell.map(i64::from);
            let at = |right: i64, above: i64| self.point_in([column + right, row + above]);
            Some([at(0, 0)?, at(1, 0)?, at(1, 1)?, at(0, 1)?])
        };
        self.cells.iter().filter_map(around).collect()
    }

    /// The faces of cells behind which there is no cell, by the numbers of the points, then left, right, below, above.
    pub fn outline(&self) -> Vec<Face> {
        let (slack, size) = (self.slack(), self.size.map(i64::from));
        let holes: Vec<Shape> = self.holes.iter().map(|hole| self.local(hole)).collect();
        let mut faces = Vec::new();
        for (point, cell) in (0..).zip(&self.cells) {
            for normal in [[-1, 0], [1, 0], [0, -1], [0, 1]] {
                let next = [0, 1].map(|axis| i64::from(cell[axis]) + i64::from(normal[axis]));
                if self.point_in(next).is_some() {
                    continue;
                }
                let centre = self.centre(next);
                faces.push(Face {
                    point,
                    normal,
                    is_on_rectangle: (0..2).any(|axis| next[axis] < 0 || next[axis] >= size[axis]),
                    hole: holes.iter().position(|hole| hole.contains(centre, slack)),
                });
            }
        }
        faces
    }

    /// Numbers of the points whose centre lies in a shape (rim included, to 1e-9 of the spacing), ascending.
    pub fn points_in(&self, shape: &Shape) -> Vec<u32> {
        let (shape, slack) = (self.local(shape), self.slack());
        self.points_where(|cell| shape.contains(self.offset(cell), slack))
    }

    /// Numbers of the points whose column and row fulfil a condition, ascending.
    pub fn points_where(&self, condition: impl Fn([u32; 2]) -> bool) -> Vec<u32> {
        let numbered = (0..).zip(&self.cells);
        numbered
            .filter(|(_, cell)| condition(**cell))
            .map(|(point, _)| point)
            .collect()
    }

    /// A shape in coordinates relative to the middle.
    fn local(&self, shape: &Shape) -> Shape {
        shape.moved(self.middle().map(|coordinate| -coordinate))
    }

    fn slack(&self) -> f64 {
        INCLUSION_TOLERANCE * self.spacing[0].min(self.spacing[1])
    }
}

impl PointCloud {
    /// A point at the centre of each cell of a lattice, with the volume V = dx dy t.
    ///
    /// The nearest distance is min(dx, dy) for every point, also where a hole took its neighbours: horizons that go by it
    /// are unified. `material_of_cell` (n_points) holds the index of each cell's material.
    pub fn from_lattice(
        lattice: &Lattice,
        thickness: f64,
        material_of_cell: &[u32],
        n_materials: usize,
    ) -> Self {
        let positions: Vec<[f64; 2]> = (lattice.cells.iter())
            .map(|&cell| lattice.offset(cell))
            .collect();
        let [dx, dy] = lattice.spacing;
        let n_points = positions.len();
        let mut material_shares = vec![0.0; n_points * n_materials];
        for (point, &material) in material_of_cell.iter().enumerate() {
            material_shares[point * n_materials + material as usize] = 1.0;
        }
        Self {
            curve: along_hilbert_curve(&positions),
            positions,
            origin: lattice.middle(),
            thickness,
            volumes: vec![dx * dy * thickness; n_points],
            spacing: vec![dx.min(dy); n_points],
            lattice_cell: Some(lattice.spacing),
            n_materials,
            material_shares,
        }
    }
}
