//! The body of a run: its points in the order of the page, and its cells.

use std::collections::HashMap;

use ligament_output::results::solid_body::is_solid;
use ligament_output::results::{location, sides_between_materials};
use ligament_output::vtu::Cell;
use ligament_output::vtu::read::VtuFile;
use ligament_output::{Error, FieldLocation};

/// Bits of the raster along a side for the order of the points.
const BITS: u32 = 16;

/// Number of corners of the cell of a point of a lattice in the plane.
const CORNERS: usize = 4;

/// A body for drawing, in the plane or a solid.
#[derive(Debug)]
pub(crate) struct Body {
    /// Number of dimensions, 2 or 3.
    pub(crate) dimension: usize,
    /// The noun that tags belong to: `node` or `cell`.
    pub(crate) tagged: &'static str,
    /// Location of the fields in the files, points or cells.
    pub(crate) location: FieldLocation,
    /// Tags of the points, in the order of the page.
    pub(crate) tags: Vec<i64>,
    /// Positions of the points, in the order of the page, m; z = 0 in the plane.
    pub(crate) positions: Vec<[f64; 3]>,
    /// Halves of the sides of the square or box around each point, m; empty where cells are between the points.
    pub(crate) halves: Vec<[f64; 3]>,
    /// Triangles between points of the page, tetrahedra of a solid, by their corners one after the other; empty where each point has a cell.
    pub(crate) simplices: Vec<u32>,
    /// Indices of the points in the files, in the order of the page.
    pub(crate) order: Vec<u32>,
    /// Ends of the sides between materials in the plane, two after each other: the points that they follow, and their places, m.
    pub(crate) interfaces: (Vec<u32>, Vec<[f64; 2]>),
}

impl Body {
    /// The body of an output.
    ///
    /// # Errors
    ///
    /// If the file cannot be used.
    pub(crate) fn read(file: &VtuFile) -> Result<Self, Error> {
        let dimension = if is_solid(file)? { 3 } else { 2 };
        let (corners, cells) = (file.points()?, file.cells()?);
        let location = location(file);
        let (tagged, tags) = file.tags(location)?;
        let (positions, halves): (Vec<[f64; 3]>, Vec<[f64; 3]>) = match location {
            FieldLocation::Point => (corners, Vec::new()),
            FieldLocation::Cell => cells
                .iter()
                .map(|it| middle_and_half_sides(it, &corners))
                .unzip(),
        };
        let order = order(&positions, dimension);
        let places = places(&order);
        let simplices = match location {
            FieldLocation::Point => simplices(&cells, &places),
            FieldLocation::Cell => Vec::new(),
        };
        let sides = sides_between_materials(file)?;
        let ends: Vec<u32> = sides.into_iter().flatten().collect();
        let point = |corner: &u32| match location {
            FieldLocation::Point => places[*corner as usize],
            FieldLocation::Cell => places[*corner as usize / CORNERS],
        };
        let grid = file.points()?;
        let place = |corner: &u32| {
            let [x, y, _] = grid[*corner as usize];
            [x, y]
        };
        let interfaces = (
            ends.iter().map(point).collect(),
            ends.iter().map(place).collect(),
        );
        let halves = match halves.is_empty() {
            true => halves,
            false => ordered(&halves, &order),
        };
        Ok(Self {
            dimension,
            tagged,
            location,
            tags: ordered(&tags, &order),
            positions: ordered(&positions, &order),
            halves,
            simplices,
            order,
            interfaces,
        })
    }

    /// Largest side of the box around the points, m.
    pub(crate) fn size(&self) -> f64 {
        let side = |axis: usize| {
            let [low, high] = range(&self.positions, axis);
            high - low
        };
        (0..3).map(side).fold(0.0, f64::max)
    }

    /// Indices of the simplices of N corners by these corners in the file.
    pub(crate) fn numbered<const N: usize>(&self) -> HashMap<[u32; N], u32> {
        let (all, _) = self.simplices.as_chunks::<N>();
        let in_file = |corners: &[u32; N]| corners.map(|it| self.order[it as usize]);
        all.iter().map(in_file).zip(0..).collect()
    }
}

/// Values, reordered to the order of the page.
pub(crate) fn ordered<T: Copy>(values: &[T], order: &[u32]) -> Vec<T> {
    order.iter().map(|it| values[*it as usize]).collect()
}

/// Place of each point of the files in the order of the page.
pub(crate) fn places(order: &[u32]) -> Vec<u32> {
    let mut places = vec![0_u32; order.len()];
    for (new, old) in (0..).zip(order) {
        places[*old as usize] = new;
    }
    places
}

/// Middle of a square or box, and halves of its sides.
fn middle_and_half_sides(cell: &Cell, corners: &[[f64; 3]]) -> ([f64; 3], [f64; 3]) {
    let corners: Vec<[f64; 3]> = (cell.points().iter())
        .map(|&it| corners[it as usize])
        .collect();
    let ranges = [0, 1, 2].map(|axis| range(&corners, axis));
    (
        ranges.map(|[low, high]| 0.5 * (low + high)),
        ranges.map(|[low, high]| 0.5 * (high - low)),
    )
}

/// Smallest and largest coordinate along an axis.
fn range(positions: &[[f64; 3]], axis: usize) -> [f64; 2] {
    let along = || positions.iter().map(|it| it[axis]);
    [
        along().fold(f64::INFINITY, f64::min),
        along().fold(f64::NEG_INFINITY, f64::max),
    ]
}

/// Indices of the points along a curve through the squares or cubes of a raster, one quadrant or octant after the other (Z-order), so that
/// neighbours are close in the order and predict each other's values.
fn order(positions: &[[f64; 3]], dimension: usize) -> Vec<u32> {
    let ranges = [0, 1, 2].map(|axis| range(positions, axis));
    let sides = ranges.map(|[low, high]| high - low);
    let size = sides.into_iter().fold(f64::MIN_POSITIVE, f64::max);
    let raster = f64::from((1_u32 << BITS) - 1);
    let code = |it: &u32| {
        let position = positions[*it as usize];
        let along = |axis: usize| ((position[axis] - ranges[axis][0]) / size * raster) as u32;
        let bits = (0..dimension).map(|axis| spread_bits(along(axis), dimension) << axis);
        (bits.fold(0, |all, it| all | it), *it)
    };
    let mut order: Vec<u32> = (0..positions.len() as u32).collect();
    order.sort_by_cached_key(code);
    order
}

/// The bits of a number, with a distance of `spacing` places from each bit to the next.
fn spread_bits(number: u32, spacing: usize) -> u64 {
    (0..BITS as usize).fold(0, |sum, bit| {
        sum | u64::from(number >> bit & 1) << (spacing * bit)
    })
}

/// Corners of the triangles or tetrahedra of cells, by their places in the page; the lowest ones first.
fn simplices(cells: &[Cell], places: &[u32]) -> Vec<u32> {
    let mut simplices: Vec<Vec<u32>> = Vec::new();
    let placed =
        |corners: &[u32]| -> Vec<u32> { corners.iter().map(|it| places[*it as usize]).collect() };
    for cell in cells {
        match cell {
            Cell::Solid(cell) => simplices.extend(cell.tetrahedra().map(|it| placed(&it))),
            _ => {
                let corners = placed(cell.points());
                let pairs = corners.get(1..).unwrap_or_default().windows(2);
                simplices.extend(pairs.map(|pair| vec![corners[0], pair[0], pair[1]]));
            }
        }
    }
    simplices.sort_unstable_by(|one, other| {
        let lowest = |it: &Vec<u32>| it.iter().min().copied();
        lowest(one).cmp(&lowest(other)).then_with(|| one.cmp(other))
    });
    simplices.concat()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_stand_side_by_side() {
        let place = |it: u32| [f64::from(it % 4), f64::from(it / 4), 0.0];
        let positions: Vec<[f64; 3]> = (0..16).map(place).collect();
        let found = order(&positions, 2);
        assert_eq!(found[..4], [0, 1, 4, 5]);
        let mut all = found.clone();
        all.sort_unstable();
        assert_eq!(all, (0..16).collect::<Vec<u32>>());
        assert_eq!(places(&found)[found[7] as usize], 7);
        let place = |it: u32| [it % 4, it / 4 % 4, it / 16].map(f64::from);
        let positions: Vec<[f64; 3]> = (0..64).map(place).collect();
        assert_eq!(order(&positions, 3)[..8], [0, 1, 4, 5, 16, 17, 20, 21]);
    }

    #[test]
    fn quadrangles_are_two_triangles() {
        let found = simplices(&[Cell::Quad([0, 1, 2, 3])], &[3, 2, 1, 0]);
        assert_eq!(found, [3, 1, 0, 3, 2, 1]);
    }
}
