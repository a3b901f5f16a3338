//! A regular lattice in space: points at the centres of the cells of a box, some of which may be removed.

use super::shape::SolidShape;
use crate::cloud::PointCloud;
use crate::curve::along_hilbert_curve;
use crate::horizon::INCLUSION_TOLERANCE;

/// No cell is left at a place.
const NONE: u32 = u32::MAX;

/// A box of equal cells without those that holes take away.
///
/// The cells that are left are numbered layer by layer and row by row from the lowest corner, x fastest.
#[derive(Debug, Clone, PartialEq)]
pub struct SolidLattice {
    /// Cells nx, ny, nz of the whole box.
    pub size: [u32; 3],
    /// Sides dx, dy, dz of a cell, m.
    pub spacing: [f64; 3],
    /// Corner of the lowest coordinates of the box, m.
    pub corner: [f64; 3],
    /// Holes: cells whose centre lies in one are removed, and bonds across one are no bonds.
    pub holes: Vec<SolidShape>,
    /// Place along each axis (from 0) of each cell that is left, shape (n_points).
    pub cells: Vec<[u32; 3]>,
    /// Number of the cell at each place of the whole box, x fastest.
    numbers: Vec<u32>,
}

/// A side of a cell behind which there is no cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SolidFace {
    /// The point at the centre of the cell.
    pub point: u32,
    /// Outward normal.
    pub normal: [i8; 3],
    /// Whether the face lies on the surface of the box.
    pub is_on_box: bool,
    /// Number of the first hole in which the centre of the missing cell lies; the cells go on beyond the box.
    pub hole: Option<usize>,
}

/// Outward normals of the six sides of a box.
pub const SIDES: [[i8; 3]; 6] = [
    [-1, 0, 0],
    [1, 0, 0],
    [0, -1, 0],
    [0, 1, 0],
    [0, 0, -1],
    [0, 0, 1],
];

impl SolidLattice {
    /// The box of nx by ny by nz cells with its lowest corner at `corner`, without the cells whose centre lies in one of the holes
    /// (surface included, to 1e-9 of the spacing).
    pub fn new(
        size: [u32; 3],
        spacing: [f64; 3],
        corner: [f64; 3],
        holes: Vec<SolidShape>,
    ) -> Self {
        let mut lattice = Self {
            size,
            spacing,
            corner,
            holes,
            cells: Vec::new(),
            numbers: Vec::new(),
        };
        let local: Vec<SolidShape> = lattice.holes.iter().map(|it| lattice.local(it)).collect();
        let slack = lattice.slack();
        let [nx, ny, nz] = size;
        let rows = (0..nz).flat_map(|z| (0..ny).map(move |y| (y, z)));
        for cell in rows.flat_map(|(y, z)| (0..nx).map(move |x| [x, y, z])) {
            let centre = lattice.offset(cell);
            let is_taken = local.iter().any(|hole| hole.contains(centre, slack));
            let number = lattice.cells.len() as u32;
            lattice.numbers.push(if is_taken { NONE } else { number });
            if !is_taken {
                lattice.cells.push(cell);
            }
        }
        lattice
    }

    /// Number of cells of the whole box.
    pub fn n_whole(&self) -> usize {
        self.numbers.len()
    }

    /// Middle of the box, m.
    pub fn middle(&self) -> [f64; 3] {
        let half = |axis: usize| 0.5 * f64::from(self.size[axis]) * self.spacing[axis];
        [0, 1, 2].map(|axis| self.corner[axis] + half(axis))
    }

    /// Centre of a cell relative to the middle of the box, m: a whole number of half cells, so that opposite cells have opposite
    /// positions to the last bit and distances are rounded but once.
    pub fn offset(&self, cell: [u32; 3]) -> [f64; 3] {
        self.centre(cell.map(i64::from))
    }

    /// Centre of a cell that may lie beyond the box, relative to the middle of the box, m.
    fn centre(&self, cell: [i64; 3]) -> [f64; 3] {
        [0, 1, 2].map(|axis| {
            let half_cells = 2 * cell[axis] + 1 - i64::from(self.size[axis]);
            half_cells as f64 * (0.5 * self.spacing[axis])
        })
    }

    /// The number of the point in a cell that may lie beyond the box; none where there is none.
    pub fn point_in(&self, cell: [i64; 3]) -> Option<u32> {
        let [nx, ny, nz] = self.size.map(i64::from);
        let [x, y, z] = cell;
        let is_in = (0..nx).contains(&x) && (0..ny).contains(&y) && (0..nz).contains(&z);
        let place = is_in.then_some((z * ny + y) * nx + x)?;
        let number = self.numbers[place as usize];
        (number != NONE).then_some(number)
    }

    /// The faces between two cells: the point with the lower coordinate, the normal towards the other and the other point.
    pub fn inner_faces(&self) -> Vec<(u32, [i8; 3], u32)> {
        let of_cell = |(point, cell): (u32, &[u32; 3])| {
            let cell = *cell;
            let upwards = SIDES.into_iter().skip(1).step_by(2);
            upwards.filter_map(move |normal| {
                Some((point, normal, self.point_in(beside(cell, normal))?))
            })
        };
        (0..).zip(&self.cells).flat_map(of_cell).collect()
    }

    /// The faces of cells behind which there is no cell, by the numbers of the points, then in the order of [`SIDES`].
    pub fn outline(&self) -> Vec<SolidFace> {
        let (slack, size) = (self.slack(), self.size.map(i64::from));
        let holes: Vec<SolidShape> = self.holes.iter().map(|hole| self.local(hole)).collect();
        let mut faces = Vec::new();
        for (point, &cell) in (0..).zip(&self.cells) {
            for normal in SIDES {
                let next = beside(cell, normal);
                if self.point_in(next).is_some() {
                    continue;
                }
                let centre = self.centre(next);
                faces.push(SolidFace {
                    point,
                    normal,
                    is_on_box: (0..3).any(|axis| next[axis] < 0 || next[axis] >= size[axis]),
                    hole: holes.iter().position(|hole| hole.contains(centre, slack)),
                });
            }
        }
        faces
    }

    /// Area of the faces of cells across an axis, m².
    pub fn face_area(&self, normal: [i8; 3]) -> f64 {
        let along = (0..3).filter(|&axis| normal[axis] == 0);
        along.map(|axis| self.spacing[axis]).product()
    }

    /// Numbers of the points whose centre lies in a shape (surface included, to 1e-9 of the spacing), ascending.
    pub fn points_in(&self, shape: &SolidShape) -> Vec<u32> {
        let (shape, slack) = (self.local(shape), self.slack());
        self.points_where(|cell| shape.contains(self.offset(cell), slack))
    }

    /// Numbers of the points in so many layers at the side of the box with this outward normal, ascending.
    pub fn points_at_side(&self, normal: [i8; 3], layers: u32) -> Vec<u32> {
        self.points_where(|cell| {
            (0..3).any(|axis| match normal[axis] {
                0 => false,
                1.. => self.size[axis] - cell[axis] <= layers,
                _ => cell[axis] < layers,
            })
        })
    }

    /// Numbers of the points whose place along the axes fulfils a condition, ascending.
    pub fn points_where(&self, condition: impl Fn([u32; 3]) -> bool) -> Vec<u32> {
        let numbered = (0..).zip(&self.cells);
        numbered
            .filter(|(_, cell)| condition(**cell))
            .map(|(point, _)| point)
            .collect()
    }

    /// A shape in coordinates relative to the middle.
    fn local(&self, shape: &SolidShape) -> SolidShape {
        shape.moved(self.middle().map(|coordinate| -coordinate))
    }

    fn slack(&self) -> f64 {
        INCLUSION_TOLERANCE * self.shortest_side()
    }

    fn shortest_side(&self) -> f64 {
        self.spacing.iter().copied().fold(f64::INFINITY, f64::min)
    }
}

/// The cell behind a side of a cell.
fn beside(cell: [u32; 3], normal: [i8; 3]) -> [i64; 3] {
    [0, 1, 2].map(|axis| i64::from(cell[axis]) + i64::from(normal[axis]))
}

impl PointCloud<3> {
    /// A point at the centre of each cell of a lattice in space, with the volume V = dx dy dz.
    ///
    /// The nearest distance is min(dx, dy, dz) for every point, also where a hole took its neighbours: horizons that go by it are
    /// unified. `material_of_cell` (n_points) holds the index of each cell's material.
    pub fn from_solid_lattice(
        lattice: &SolidLattice,
        material_of_cell: &[u32],
        n_materials: usize,
    ) -> Self {
        let cells = lattice.cells.iter();
        let positions: Vec<[f64; 3]> = cells.map(|&cell| lattice.offset(cell)).collect();
        let [dx, dy, dz] = lattice.spacing;
        let n_points = positions.len();
        let mut material_shares = vec![0.0; n_points * n_materials];
        for (point, &material) in material_of_cell.iter().enumerate() {
            material_shares[point * n_materials + material as usize] = 1.0;
        }
        Self {
            curve: along_hilbert_curve(&positions),
            positions,
            origin: lattice.middle(),
            thickness: 1.0,
            volumes: vec![dx * dy * dz; n_points],
            spacing: vec![lattice.shortest_side(); n_points],
            lattice_cell: Some(lattice.spacing),
            n_materials,
            material_shares,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::horizon::Horizons;
    use crate::{BondSet, space::hole::bonds_across};

    fn drilled() -> SolidLattice {
        let hole = SolidShape::Cylinder {
            ends: [[2.5, 2.0, 0.0], [2.5, 2.0, 3.0]],
            radius: 0.6,
        };
        SolidLattice::new([5, 4, 3], [1.0, 1.0, 0.5], [0.0; 3], vec![hole])
    }

    #[test]
    fn cells_in_holes_are_none() {
        let lattice = drilled();
        // The centres at (2.5, 1.5) and (2.5, 2.5) of three layers.
        assert_eq!((lattice.n_whole(), lattice.cells.len()), (60, 54));
        assert_eq!(lattice.point_in([2, 1, 0]), None);
        assert_eq!(lattice.point_in([-1, 0, 0]), None);
        for (number, cell) in (0..).zip(&lattice.cells) {
            assert_eq!(lattice.point_in(cell.map(i64::from)), Some(number));
        }
        assert_eq!(lattice.middle(), [2.5, 2.0, 0.75]);
        assert_eq!(lattice.offset([4, 0, 2]), [2.0, -1.5, 0.5]);
    }

    /// The vector areas of a closed surface cancel; those of the box are its own, and a cell has six sides.
    #[test]
    fn the_outline_is_closed() {
        let lattice = drilled();
        let outline = lattice.outline();
        let mut sum = [0.0; 3];
        for face in &outline {
            let area = lattice.face_area(face.normal);
            sum = [0, 1, 2].map(|axis| sum[axis] + area * f64::from(face.normal[axis]));
        }
        assert_eq!(sum, [0.0; 3]);
        assert_eq!(outline.len() + 2 * lattice.inner_faces().len(), 6 * 54);
        let at_hole = outline.iter().filter(|face| face.hole.is_some());
        // Two cells side by side have six sides each layer; those beyond the box above and below are in the cylinder too.
        let inside = at_hole.clone().filter(|face| !face.is_on_box);
        assert_eq!((at_hole.count(), inside.count()), (18, 18));
        assert_eq!(lattice.face_area([0, 0, 1]), 1.0);
        assert_eq!(lattice.face_area([0, -1, 0]), 0.5);
    }

    #[test]
    fn sets_are_layers_and_shapes() {
        let lattice = drilled();
        assert_eq!(lattice.points_at_side([-1, 0, 0], 1).len(), 12);
        assert_eq!(lattice.points_at_side([0, 0, 1], 2).len(), 36);
        let ball = SolidShape::Sphere {
            centre: [0.5, 0.5, 0.25],
            radius: 1.0,
        };
        let found = lattice.points_in(&ball);
        // Itself, the two beside it, and two layers up: 0.5 and 1.
        let expected: Vec<u32> = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [0, 0, 2]]
            .iter()
            .filter_map(|cell| lattice.point_in(*cell))
            .collect();
        let mut found_cells = expected.clone();
        found_cells.sort_unstable();
        assert_eq!(found, found_cells);
    }

    #[test]
    fn bonds_across_a_hole_are_none() {
        let lattice = drilled();
        let cloud = PointCloud::from_solid_lattice(&lattice, &[0; 54], 1);
        assert_eq!(cloud.volumes.iter().sum::<f64>(), 27.0);
        assert!(cloud.spacing.iter().all(|it| *it == 0.5));
        let bonds = BondSet::search(&cloud, &Horizons::unified(2.0, 54));
        let across = bonds_across(&lattice.holes, &bonds, &cloud);
        let bond = |a: [i64; 3], b: [i64; 3]| {
            let ends = [a, b].map(|cell| lattice.point_in(cell).unwrap_or(NONE));
            bonds
                .ends
                .iter()
                .position(|it| *it == ends)
                .map(|it| across[it])
        };
        assert_eq!(bond([1, 1, 0], [3, 1, 0]), Some(true), "through the hole");
        assert_eq!(bond([2, 0, 0], [2, 0, 2]), Some(false), "beside it");
        assert_eq!(bond([1, 0, 0], [3, 0, 0]), Some(false), "beside it");
    }
}
