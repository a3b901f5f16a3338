//! The body of a run: its points in the order of the page, and its triangles.

use ligament_output::results::location;
use ligament_output::vtu::Cell;
use ligament_output::vtu::read::VtuFile;
use ligament_output::{Error, FieldLocation};

/// Number of squares along a side of the raster for the order of the points.
const RASTER: f64 = 65_535.0;

/// A body for drawing.
#[derive(Debug)]
pub(crate) struct Body {
    /// The noun that tags belong to: `node` or `cell`.
    pub(crate) tagged: &'static str,
    /// Location of the fields in the files, points or cells.
    pub(crate) location: FieldLocation,
    /// Tags of the points, in the order of the page.
    pub(crate) tags: Vec<i64>,
    /// Positions of the points, in the order of the page, m.
    pub(crate) positions: Vec<[f64; 2]>,
    /// Corners of the cells around the points, four per point, m; empty where cells are between the points.
    pub(crate) corners: Vec<[f64; 2]>,
    /// Triangles between points of the page; empty where each point has a cell.
    pub(crate) triangles: Vec<[u32; 3]>,
    /// Indices of the points in the files, in the order of the page.
    pub(crate) order: Vec<u32>,
}

impl Body {
    /// The body of an output.
    ///
    /// # Errors
    ///
    /// If the file cannot be used.
    pub(crate) fn read(file: &VtuFile) -> Result<Self, Error> {
        let (corners, cells) = (file.points_in_plane()?, file.cells()?);
        let location = location(file);
        let is_mesh = location == FieldLocation::Point;
        let (tagged, tags) = file.tags(location)?;
        let around = |cell: &Cell| {
            cell.points()
                .iter()
                .map(|&it| corners[it as usize])
                .collect()
        };
        let squares: Vec<Vec<[f64; 2]>> = match is_mesh {
            true => Vec::new(),
            false => cells.iter().map(around).collect(),
        };
        let positions = match is_mesh {
            true => corners.clone(),
            false => squares.iter().map(|it| middle(it)).collect(),
        };
        let order = order(&positions);
        let mut place = vec![0_u32; order.len()];
        for (new, old) in (0..).zip(&order) {
            place[*old as usize] = new;
        }
        let triangles = match is_mesh {
            true => triangles(&cells, &place),
            false => Vec::new(),
        };
        Ok(Self {
            tagged,
            location,
            tags: ordered(&tags, &order),
            positions: ordered(&positions, &order),
            corners: (order.iter())
                .filter_map(|it| squares.get(*it as usize))
                .flat_map(|square| (0..4).map(|it| square[it.min(square.len() - 1)]))
                .collect(),
            triangles,
            order,
        })
    }

    /// Larger side of the box around the points, m.
    pub(crate) fn size(&self) -> f64 {
        let side = |axis: usize| {
            let along = || self.positions.iter().map(|it| it[axis]);
            along().fold(f64::NEG_INFINITY, f64::max) - along().fold(f64::INFINITY, f64::min)
        };
        side(0).max(side(1)).max(0.0)
    }
}

/// Values, reordered to the order of the page.
pub(crate) fn ordered<T: Copy>(values: &[T], order: &[u32]) -> Vec<T> {
    order.iter().map(|it| values[*it as usize]).collect()
}

fn middle(corners: &[[f64; 2]]) -> [f64; 2] {
    [0, 1].map(|axis| corners.iter().map(|it| it[axis]).sum::<f64>() / corners.len() as f64)
}

/// Indices of the points along a curve through the squares of a raster, quadrant by quadrant (Z-order), so that neighbours are close in the
/// order and predict each other's values.
fn order(positions: &[[f64; 2]]) -> Vec<u32> {
    let bound = |axis: usize, start: f64, of: fn(f64, f64) -> f64| {
        positions.iter().map(|it| it[axis]).fold(start, of)
    };
    let low = [0, 1].map(|axis| bound(axis, f64::INFINITY, f64::min));
    let high = [0, 1].map(|axis| bound(axis, f64::NEG_INFINITY, f64::max));
    let size = (high[0] - low[0])
        .max(high[1] - low[1])
        .max(f64::MIN_POSITIVE);
    let code = |it: &u32| {
        let position = positions[*it as usize];
        let [x, y] = [0, 1].map(|k| spread(((position[k] - low[k]) / size * RASTER) as u32));
        (x | y << 1, *it)
    };
    let mut order: Vec<u32> = (0..positions.len() as u32).collect();
    order.sort_by_cached_key(code);
    order
}

/// The bits of a number, interleaved with zeros.
fn spread(number: u32) -> u64 {
    (0..16).fold(0, |sum, bit| {
        sum | u64::from(number >> bit & 1) << (2 * bit)
    })
}

fn triangles(cells: &[Cell], place: &[u32]) -> Vec<[u32; 3]> {
    let mut triangles = Vec::new();
    for cell in cells {
        let corners: Vec<u32> = (cell.points().iter())
            .map(|it| place[*it as usize])
            .collect();
        for pair in corners.get(1..).unwrap_or_default().windows(2) {
            triangles.push([corners[0], pair[0], pair[1]]);
        }
    }
    triangles.sort_unstable_by_key(|it| (it.iter().min().copied(), *it));
    triangles
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_stand_side_by_side() {
        let square = |it: u32| [f64::from(it % 4), f64::from(it / 4)];
        let positions: Vec<[f64; 2]> = (0..16).map(square).collect();
        let order = order(&positions);
        assert_eq!(order[..4], [0, 1, 4, 5]);
        let mut all = order.clone();
        all.sort_unstable();
        assert_eq!(all, (0..16).collect::<Vec<u32>>());
    }

    #[test]
    fn quadrangles_are_two_triangles() {
        let found = triangles(&[Cell::Quad([0, 1, 2, 3])], &[3, 2, 1, 0]);
        assert_eq!(found, [[3, 1, 0], [3, 2, 1]]);
    }
}
