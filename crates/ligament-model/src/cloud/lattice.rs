//! A regular lattice: points at the centres of the cells of a rectangle or a box, some of which may be removed.

use std::sync::Arc;

use ligament_mesh::{Numbering, along_hilbert_curve};

use super::PointCloud;
use super::points::whole_shares;
use crate::horizon::INCLUSION_TOLERANCE;
use crate::shape::{Region, Shape, SolidShape};
use crate::subdomain::Subdomain;

/// A rectangle of equal cells, or for D = 3 a box, without the cells removed by holes.
///
/// The remaining cells are numbered from the lowest corner, x fastest, then y.
#[derive(Debug, Clone, PartialEq)]
pub struct Lattice<const D: usize = 2, S = Shape> {
    /// Number of cells along each axis of the whole box.
    pub size: [u32; D],
    /// Sides of a cell, m.
    pub spacing: [f64; D],
    /// Corner of the lowest coordinates, m.
    pub corner: [f64; D],
    /// Holes: cells whose centre lies in one are removed, and no bond crosses one.
    pub holes: Vec<S>,
    /// Index along each axis (from 0) of each remaining cell, shape (n_points).
    pub cells: Vec<[u32; D]>,
}

/// A box of equal cells without the cells removed by holes.
pub type SolidLattice = Lattice<3, SolidShape>;

/// A side of a cell without a cell behind it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Face<const D: usize = 2> {
    /// The point at the centre of the cell.
    pub point: u32,
    /// Outward normal.
    pub normal: [i8; D],
    /// Whether the face lies on the outline of the box.
    pub is_on_box: bool,
    /// Number of the first hole in which the centre of the missing cell lies; cells are continued beyond the box.
    pub hole: Option<usize>,
}

impl<const D: usize, S: Region<D>> Lattice<D, S> {
    /// The box of `size` cells with its lowest corner at `corner`, without the cells whose centre lies in one of the holes (rim included, to
    /// 1e-5 of the spacing).
    pub fn new(size: [u32; D], spacing: [f64; D], corner: [f64; D], holes: Vec<S>) -> Self {
        let mut lattice = Self {
            size,
            spacing,
            corner,
            holes,
            cells: Vec::new(),
        };
        let local: Vec<S> = lattice.holes.iter().map(|it| lattice.local(it)).collect();
        let slack = lattice.slack();
        for place in 0..lattice.n_whole() {
            let mut rest = place;
            let cell = size.map(|count| {
                let along = rest % count as usize;
                rest /= count as usize;
                along as u32
            });
            let centre = lattice.offset(cell);
            if !local.iter().any(|hole| hole.contains(centre, slack)) {
                lattice.cells.push(cell);
            }
        }
        lattice
    }

    /// The lattice with the cells of some points (ascending) alone.
    pub fn part(&self, points: &[u32]) -> Self
    where
        S: Clone,
    {
        let cells = points.iter().map(|&point| self.cells[point as usize]);
        Self {
            cells: cells.collect(),
            holes: self.holes.clone(),
            ..*self
        }
    }

    /// Number of cells of the whole box.
    pub fn n_whole(&self) -> usize {
        self.size.iter().map(|&count| count as usize).product()
    }

    /// Index of a cell in the whole box, x fastest.
    fn place(&self, cell: [u32; D]) -> usize {
        let along = cell.into_iter().zip(self.size).rev();
        along.fold(0, |place, (along, count)| {
            place * count as usize + along as usize
        })
    }

    /// Middle of the box, m.
    pub fn middle(&self) -> [f64; D] {
        std::array::from_fn(|axis| {
            self.corner[axis] + 0.5 * f64::from(self.size[axis]) * self.spacing[axis]
        })
    }

    /// Centre of the cell of a point, m.
    pub fn position(&self, point: u32) -> [f64; D] {
        let (middle, offset) = (self.middle(), self.offset(self.cells[point as usize]));
        std::array::from_fn(|axis| middle[axis] + offset[axis])
    }

    /// Centre of a cell relative to the middle of the box, m: a whole number of half cells, so that opposite cells have opposite positions
    /// to the last bit and distances are rounded only once.
    pub fn offset(&self, cell: [u32; D]) -> [f64; D] {
        self.centre(cell.map(i64::from))
    }

    /// Centre of a cell that may lie beyond the box, relative to the middle of the box, m.
    fn centre(&self, cell: [i64; D]) -> [f64; D] {
        std::array::from_fn(|axis| {
            let half_cells = 2 * cell[axis] + 1 - i64::from(self.size[axis]);
            half_cells as f64 * (0.5 * self.spacing[axis])
        })
    }

    /// Number of the point in a cell that may lie beyond the box; `None` for a missing cell.
    pub fn point_in(&self, cell: [i64; D]) -> Option<u32> {
        let place = self.place(self.in_box(cell)?);
        if self.cells.len() == self.n_whole() {
            return Some(place as u32);
        }
        let found = self
            .cells
            .binary_search_by_key(&place, |it| self.place(*it));
        found.ok().map(|point| point as u32)
    }

    /// Index of a cell inside the box; `None` beyond it.
    fn in_box(&self, cell: [i64; D]) -> Option<[u32; D]> {
        let mut inside = [0; D];
        for axis in 0..D {
            let along = u32::try_from(cell[axis]).ok();
            inside[axis] = along.filter(|along| *along < self.size[axis])?;
        }
        Some(inside)
    }

    /// Points and weights (sum one) that interpolate a value at a position (m): linear along each axis between the centres of cells,
    /// constant beyond the outermost centres. `None` where one of the cells is missing.
    pub fn interpolation_weights(&self, position: [f64; D]) -> Option<Vec<(u32, f64)>> {
        let cells_along: [f64; D] = std::array::from_fn(|axis| {
            let along = (position[axis] - self.corner[axis]) / self.spacing[axis] - 0.5;
            let along = along.clamp(0.0, f64::from(self.size[axis] - 1));
            // At a centre its neighbours have no weight, regardless of rounding.
            let whole = along.round();
            if (along - whole).abs() < INCLUSION_TOLERANCE {
                whole
            } else {
                along
            }
        });
        let mut shares = Vec::new();
        for corner in 0..1 << D {
            let is_upper = |axis: usize| (corner >> axis) & 1 == 1;
            let share = (0..D).map(|axis| match is_upper(axis) {
                true => cells_along[axis].fract(),
                false => 1.0 - cells_along[axis].fract(),
            });
            let share: f64 = share.product();
            if share > 0.0 {
                let upper = |axis: usize| i64::from(is_upper(axis));
                let cell = std::array::from_fn(|axis| cells_along[axis] as i64 + upper(axis));
                shares.push((self.point_in(cell)?, share));
            }
        }
        Some(shares)
    }

    /// Faces between two cells: the point with the lower coordinate, the normal towards the other, and the other point.
    pub fn inner_faces(&self) -> Vec<(u32, [i8; D], u32)> {
        let of_cell = |(point, cell): (u32, &[u32; D])| {
            let cell = *cell;
            let upwards = sides().skip(1).step_by(2);
            upwards.filter_map(move |normal| {
                Some((point, normal, self.point_in(cell_behind(cell, normal))?))
            })
        };
        (0..).zip(&self.cells).flat_map(of_cell).collect()
    }

    /// Faces of cells without a cell behind them, by the numbers of the points, then below and above along x, y and z.
    pub fn outline(&self) -> Vec<Face<D>> {
        let slack = self.slack();
        let holes: Vec<S> = self.holes.iter().map(|hole| self.local(hole)).collect();
        let mut faces = Vec::new();
        for (point, &cell) in (0..).zip(&self.cells) {
            for normal in sides() {
                let next = cell_behind(cell, normal);
                if self.point_in(next).is_some() {
                    continue;
                }
                let centre = self.centre(next);
                let hole = holes.iter().position(|hole| hole.contains(centre, slack));
                let is_on_box = self.in_box(next).is_none();
                // A part of the lattice borders on its other cells.
                if is_on_box || hole.is_some() {
                    faces.push(Face {
                        point,
                        normal,
                        is_on_box,
                        hole,
                    });
                }
            }
        }
        faces
    }

    /// Size of the faces of cells across an axis: a length (m), in space an area (m^2).
    pub fn face_size(&self, normal: [i8; D]) -> f64 {
        let along = (0..D).filter(|&axis| normal[axis] == 0);
        along.map(|axis| self.spacing[axis]).product()
    }

    /// Numbers of the points whose centre lies in a shape (rim included, to 1e-5 of the spacing), ascending.
    pub fn points_in(&self, shape: &S) -> Vec<u32> {
        let (shape, slack) = (self.local(shape), self.slack());
        self.points_where(|cell| shape.contains(self.offset(cell), slack))
    }

    /// Numbers of the points in `layers` layers of cells at the side of the box with a given outward normal, ascending.
    pub fn points_at_side(&self, normal: [i8; D], layers: u32) -> Vec<u32> {
        self.points_where(|cell| {
            (0..D).any(|axis| match normal[axis] {
                0 => false,
                1.. => self.size[axis] - cell[axis] <= layers,
                _ => cell[axis] < layers,
            })
        })
    }

    fn points_where(&self, condition: impl Fn([u32; D]) -> bool) -> Vec<u32> {
        let numbered = (0..).zip(&self.cells);
        numbered
            .filter(|(_, cell)| condition(**cell))
            .map(|(point, _)| point)
            .collect()
    }

    /// A shape in coordinates relative to the middle.
    fn local(&self, shape: &S) -> S {
        shape.moved(self.middle().map(|coordinate| -coordinate))
    }

    fn slack(&self) -> f64 {
        INCLUSION_TOLERANCE * self.shortest_side()
    }

    fn shortest_side(&self) -> f64 {
        self.spacing.iter().copied().fold(f64::INFINITY, f64::min)
    }
}

impl Lattice {
    /// Squares between the centres of four cells around a corner, anticlockwise.
    pub fn squares(&self) -> Vec<[u32; 4]> {
        let around = |cell: &[u32; 2]| {
            let [column, row] = cell.map(i64::from);
            let at = |right: i64, above: i64| self.point_in([column + right, row + above]);
            Some([at(0, 0)?, at(1, 0)?, at(1, 1)?, at(0, 1)?])
        };
        self.cells.iter().filter_map(around).collect()
    }
}

/// Outward normals of the sides of a box, below and above along x, then along y, then along z.
fn sides<const D: usize>() -> impl Iterator<Item = [i8; D]> {
    let along = |axis: usize, sign: i8| std::array::from_fn(|it| if it == axis { sign } else { 0 });
    (0..D).flat_map(move |axis| [-1, 1].map(|sign| along(axis, sign)))
}

/// The cell behind a side of a cell.
fn cell_behind<const D: usize>(cell: [u32; D], normal: [i8; D]) -> [i64; D] {
    std::array::from_fn(|axis| i64::from(cell[axis]) + i64::from(normal[axis]))
}

impl<const D: usize> PointCloud<D> {
    /// A point at the centre of each cell of a lattice, with the volume of the cell times the thickness (1 in space).
    ///
    /// `material_of_cell` (n_points) has the index of each cell's material.
    pub fn from_lattice<S: Region<D>>(
        lattice: &Lattice<D, S>,
        thickness: f64,
        material_of_cell: &[u32],
        n_materials: usize,
    ) -> Self {
        Self::centres(lattice, thickness, n_materials).with_cells(material_of_cell)
    }

    /// A point at the centre of each cell of a lattice, not yet with volumes, materials and their order along a curve, which
    /// [`PointCloud::with_cells`] adds to all points or to a part.
    ///
    /// The nearest distance is the shortest side for every point, also where a hole removed its neighbours: horizons based on it are
    /// unified.
    pub fn centres<S: Region<D>>(
        lattice: &Lattice<D, S>,
        thickness: f64,
        n_materials: usize,
    ) -> Self {
        let positions: Vec<[f64; D]> = (lattice.cells.iter())
            .map(|&cell| lattice.offset(cell))
            .collect();
        let n_points = positions.len();
        Self {
            curve: Vec::new(),
            positions,
            precision: 0.0,
            origin: lattice.middle(),
            thickness,
            volumes: Arc::default(),
            spacing: vec![lattice.shortest_side(); n_points].into(),
            lattice_cell: Some(lattice.spacing),
            n_materials,
            material_shares: Vec::new(),
            numbering: Numbering::default(),
            subdomain: Subdomain::whole(n_points),
        }
    }

    /// Points of a lattice with the volumes of their cells, the index of each cell's material (n_points) and their order along a curve.
    pub fn with_cells(self, material_of_cell: &[u32]) -> Self {
        let sides = self.lattice_cell.unwrap_or([0.0; D]);
        let volume = sides.iter().product::<f64>() * self.thickness;
        Self {
            curve: along_hilbert_curve(&self.positions),
            volumes: vec![volume; self.len()].into(),
            material_shares: whole_shares(material_of_cell, self.n_materials),
            ..self
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bonds::hole::bonds_across;
    use crate::horizon::Horizons;
    use crate::{BondSet, PointCloud};

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
            let area = lattice.face_size(face.normal);
            sum = [0, 1, 2].map(|axis| sum[axis] + area * f64::from(face.normal[axis]));
        }
        assert_eq!(sum, [0.0; 3]);
        assert_eq!(outline.len() + 2 * lattice.inner_faces().len(), 6 * 54);
        let at_hole = outline.iter().filter(|face| face.hole.is_some());
        // Two cells side by side have six sides each layer; those beyond the box above and below are in the cylinder too.
        let inside = at_hole.clone().filter(|face| !face.is_on_box);
        assert_eq!((at_hole.count(), inside.count()), (18, 18));
        assert_eq!(lattice.face_size([0, 0, 1]), 1.0);
        assert_eq!(lattice.face_size([0, -1, 0]), 0.5);
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
        let cloud = PointCloud::from_lattice(&lattice, 1.0, &[0; 54], 1);
        assert_eq!(cloud.volumes.iter().sum::<f64>(), 27.0);
        assert!(cloud.spacing.iter().all(|it| *it == 0.5));
        let bonds = BondSet::search(&cloud, &Horizons::unified(2.0, 54));
        let across = bonds_across(&lattice.holes, &bonds, &cloud);
        let bond = |a: [i64; 3], b: [i64; 3]| {
            let ends = [a, b].map(|cell| lattice.point_in(cell).unwrap_or(u32::MAX));
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
