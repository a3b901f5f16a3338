//! The peridynamic traction: the force through a small plane at a point.
//!
//! Lehoucq and Silling, "Force flux and the peridynamic stress tensor"; in discrete form Diana and Casolo, "A bond-based
//! micropolar peridynamic model with shear deformability", eqs A.1 to A.5: the forces of all bonds from points behind a plane
//! to points before it, in a column as wide as the point, over the area of the column.

use ligament_model::element::BondDeformation;
use ligament_model::{BondSystem, PointCloud};

use super::force_on_first;

/// Stresses of the planes with normal x (xx, yx) and with normal y (yy, xy), Pa; the first letter is the force's direction.
pub type Tractions = [f64; 4];

/// An end of a bond nearer to a plane than this part of the bond's length lies in it: rounding of the points of a lattice.
const IN_PLANE: f64 = 1e-9;

/// Traction at every point on the planes with normal x and with normal y through it, shape (n_points).
///
/// The plane of a point is a segment of width w_i = sqrt(V_i/t) with the point in its middle, and the thickness. A bond
/// stands for a band of matter of the mean width of its two points along the straight line between them. What of a band
/// crosses the segment gives its part of the bond's force: planes side by side share each force, and lose none of it. On a
/// square lattice this is eq. A.4 with the column's neighbours weighted by how far they reach into it.
///
/// A plane through points has bonds that end in it. Their forces count half, which is the mean of the planes on either side,
/// and what lies within the plane does not count. So on the outline of a body, where nothing is on the other side, and
/// wherever a part of the segment lies outside, the traction is that of a part of the width or of half the bonds: read it a
/// horizon away from the outline.
pub fn stress(
    system: &BondSystem,
    intact: &[bool],
    deformations: &[BondDeformation],
) -> Vec<Tractions> {
    let grid = Grid::of(&system.cloud);
    let on_planes = |normal: usize| through_planes(system, intact, deformations, &grid, normal);
    let ([with_x, with_y], n_points) = (
        <[_; 2]>::from(rayon::join(|| on_planes(0), || on_planes(1))),
        system.cloud.len(),
    );
    (0..n_points)
        .map(|point| {
            let ([xx, yx], [xy, yy]) = (with_x[point], with_y[point]);
            [xx, yx, yy, xy]
        })
        .collect()
}

/// Traction along x and y on the plane of each point with the given normal (0: x, 1: y), Pa.
fn through_planes(
    system: &BondSystem,
    intact: &[bool],
    deformations: &[BondDeformation],
    grid: &Grid,
    normal: usize,
) -> Vec<[f64; 2]> {
    let positions = &system.cloud.positions;
    let mut sums = vec![[0.0; 2]; positions.len()];
    let is_intact = |bond: &usize| intact[*bond];
    for bond in (0..system.bonds.len()).filter(is_intact) {
        let [a, b] = system.bonds.ends[bond].map(|end| end as usize);
        let band = Band {
            ends: [positions[a], positions[b]],
            width: 0.5 * (grid.width[a] + grid.width[b]),
            in_plane: IN_PLANE * system.bonds.length[bond],
            normal,
        };
        if band.lies_in_a_plane() {
            continue;
        }
        let [x, y] = force_on_first(system, bond, &deformations[bond]);
        // The part before the plane pulls at the part behind it.
        let sign = if band.points_forward() { 1.0 } else { -1.0 };
        grid.visit(band.reach(grid.largest_width), |point| {
            let share = sign * band.share(positions[point], grid.width[point]);
            sums[point][0] += share * x;
            sums[point][1] += share * y;
        });
    }
    let area = grid
        .width
        .iter()
        .map(|width| width * system.cloud.thickness);
    let over_area = |(sum, area): (&[f64; 2], f64)| sum.map(|force| force / area);
    sums.iter().zip(area).map(over_area).collect()
}

/// The matter of a bond on its way through planes of one normal.
struct Band {
    ends: [[f64; 2]; 2],
    width: f64,
    in_plane: f64,
    normal: usize,
}

impl Band {
    fn lies_in_a_plane(&self) -> bool {
        let [a, b] = self.ends.map(|end| end[self.normal]);
        (b - a).abs() <= self.in_plane
    }

    fn points_forward(&self) -> bool {
        let [a, b] = self.ends.map(|end| end[self.normal]);
        b > a
    }

    /// The box of the points whose planes it may cross, for planes up to a width.
    fn reach(&self, largest_width: f64) -> [[f64; 2]; 2] {
        let margin = |axis: usize| {
            if axis == self.normal {
                self.in_plane
            } else {
                0.5 * (self.width + largest_width)
            }
        };
        let [a, b] = self.ends;
        [
            [0, 1].map(|axis| a[axis].min(b[axis]) - margin(axis)),
            [0, 1].map(|axis| a[axis].max(b[axis]) + margin(axis)),
        ]
    }

    /// Part of the band that crosses the plane of a point: 0 to 1, half of it for a band that ends in the plane.
    fn share(&self, point: [f64; 2], width: f64) -> f64 {
        let along = 1 - self.normal;
        let [before_a, before_b] = self.ends.map(|end| {
            let distance = end[self.normal] - point[self.normal];
            if distance.abs() <= self.in_plane {
                0.0
            } else {
                distance
            }
        });
        let crossing = if before_a * before_b < 0.0 {
            1.0
        } else if (before_a == 0.0) != (before_b == 0.0) {
            0.5
        } else {
            return 0.0;
        };
        let [a, b] = self.ends.map(|end| end[along]);
        let middle = a + (b - a) * before_a / (before_a - before_b) - point[along];
        let overlap = (middle + 0.5 * self.width).min(0.5 * width)
            - (middle - 0.5 * self.width).max(-0.5 * width);
        crossing * overlap.max(0.0) / self.width
    }
}

/// The points in the cells of a grid, to find those near a bond.
struct Grid {
    /// Width sqrt(V/t) of each point's planes, shape (n_points), m.
    width: Vec<f64>,
    largest_width: f64,
    lower: [f64; 2],
    cell: f64,
    n_cells: [usize; 2],
    /// Where the points of each cell start, row by row.
    starts: Vec<usize>,
    points: Vec<u32>,
}

impl Grid {
    fn of(cloud: &PointCloud) -> Self {
        let width: Vec<f64> = cloud
            .volumes
            .iter()
            .map(|volume| (volume / cloud.thickness).sqrt())
            .collect();
        let bound = |pick: fn(f64, f64) -> f64, start: f64| {
            let least = |axis: usize| cloud.positions.iter().map(|p| p[axis]).fold(start, pick);
            [least(0), least(1)]
        };
        let (lower, upper) = (
            bound(f64::min, f64::INFINITY),
            bound(f64::max, f64::NEG_INFINITY),
        );
        // A cell has a point or two in the mean.
        let area: f64 = width.iter().map(|width| width * width).sum();
        let cell = (2.0 * area / width.len() as f64).sqrt();
        let mut grid = Self {
            largest_width: width.iter().copied().fold(0.0, f64::max),
            width,
            lower,
            cell,
            n_cells: [0, 1].map(|axis| ((upper[axis] - lower[axis]) / cell) as usize + 1),
            starts: Vec::new(),
            points: vec![0; cloud.len()],
        };
        let cells: Vec<usize> = cloud
            .positions
            .iter()
            .map(|&p| grid.number(grid.place(p)))
            .collect();
        let mut next = vec![0; grid.n_cells[0] * grid.n_cells[1] + 1];
        for cell in &cells {
            next[cell + 1] += 1;
        }
        for cell in 1..next.len() {
            next[cell] += next[cell - 1];
        }
        grid.starts.clone_from(&next);
        for (point, cell) in cells.into_iter().enumerate() {
            grid.points[next[cell]] = point as u32;
            next[cell] += 1;
        }
        grid
    }

    /// Column and row of a position; outside of the grid the nearest ones.
    fn place(&self, position: [f64; 2]) -> [usize; 2] {
        [0, 1].map(|axis| {
            let cells = (position[axis] - self.lower[axis]) / self.cell;
            (cells as usize).min(self.n_cells[axis] - 1)
        })
    }

    fn number(&self, [column, row]: [usize; 2]) -> usize {
        row * self.n_cells[0] + column
    }

    /// Calls for all points of the cells that a box touches.
    fn visit(&self, [lower, upper]: [[f64; 2]; 2], mut visit: impl FnMut(usize)) {
        let (first, last) = (self.place(lower), self.place(upper));
        for row in first[1]..=last[1] {
            let (from, to) = (self.number([first[0], row]), self.number([last[0], row]));
            for &point in &self.points[self.starts[from]..self.starts[to + 1]] {
                visit(point as usize);
            }
        }
    }
}
