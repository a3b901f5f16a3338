//! Order of the points along a space-filling curve.
//!
//! Mesh generators number nodes in an order in which neighbours are far apart in memory. Loops over points and their neighbours then wait
//! for memory; along a Hilbert curve neighbours are still in the cache.

use crate::parallel;
use rayon::prelude::*;

/// Number of bits of the position of a point on the curve.
const BITS: u32 = 63;

/// Number of steps of the curve in D dimensions, which separates positions that differ by 2^-steps of the box around the points.
const fn steps<const D: usize>() -> u32 {
    BITS / D as u32
}

/// All points, each once, in the order of a Hilbert curve through the square or cube around them, shape (n_points). Points at one position
/// of the curve keep their order.
pub fn along_hilbert_curve<const D: usize>(positions: &[[f64; D]]) -> Vec<u32> {
    let corner = |pick: fn(f64, f64) -> f64, start: f64| {
        let fold = |c: [f64; D], p: &[f64; D]| std::array::from_fn(|axis| pick(c[axis], p[axis]));
        positions.iter().fold([start; D], fold)
    };
    let lower = corner(f64::min, f64::INFINITY);
    let upper = corner(f64::max, f64::NEG_INFINITY);
    let sides = lower.iter().zip(&upper).map(|(low, high)| high - low);
    let side = sides.fold(0.0, f64::max);
    let scale = ((1_u64 << steps::<D>()) - 1) as f64 / side.max(f64::MIN_POSITIVE);
    let mut keys = parallel::values(positions.len(), (0, 0), |point| {
        let place = |axis| (positions[point][axis] - lower[axis]) * scale;
        let cell = std::array::from_fn(|axis| place(axis) as u64);
        (hilbert_index::<D>(cell), point as u32)
    });
    keys.par_sort_unstable();
    keys.into_iter().map(|(_, point)| point).collect()
}

/// Index on the Hilbert curve of a cell of a grid of 2^steps cells along each axis.
fn hilbert_index<const D: usize>(cell: [u64; D]) -> u64 {
    match cell.as_slice() {
        &[x, y] => index_in_square(x, y),
        _ => index_in_cube(cell),
    }
}

/// Index on the Hilbert curve of a cell of a grid in D dimensions (J. Skilling, Programming the Hilbert curve, AIP Conf. Proc. 707, 2004):
/// its coordinates, turned and mirrored from the coarsest step to the finest and as a Gray code, bit by bit.
fn index_in_cube<const D: usize>(mut cell: [u64; D]) -> u64 {
    let highest = 1 << (steps::<D>() - 1);
    let descending = || std::iter::successors(Some(highest), |bit: &u64| Some(bit >> 1));
    for bit in descending().take_while(|bit| *bit > 1) {
        let below = bit - 1;
        for axis in 0..D {
            if cell[axis] & bit != 0 {
                cell[0] ^= below;
            } else {
                let swapped = (cell[0] ^ cell[axis]) & below;
                cell[0] ^= swapped;
                cell[axis] ^= swapped;
            }
        }
    }
    for axis in 1..D {
        cell[axis] ^= cell[axis - 1];
    }
    let set = descending().take_while(|bit| *bit > 1);
    let set = set.filter(|bit| cell[D - 1] & bit != 0);
    let mirrored = set.fold(0, |mirrored, bit| mirrored ^ (bit - 1));
    let bits = descending().take_while(|bit| *bit > 0);
    bits.flat_map(|bit| cell.map(|it| u64::from((it ^ mirrored) & bit != 0)))
        .fold(0, |index, bit| 2 * index + bit)
}

/// Index on the Hilbert curve of the cell (x, y) of a grid of squares.
///
/// At each step the curve passes through four quarters; in the first it is mirrored at the rising diagonal, in the last at the falling one.
fn index_in_square(mut x: u64, mut y: u64) -> u64 {
    let mut index = 0;
    for step in (0..steps::<2>()).rev() {
        let half = 1 << step;
        let (right, upper) = (x & half != 0, y & half != 0);
        let quarter = match (right, upper) {
            (false, false) => 0,
            (false, true) => 1,
            (true, true) => 2,
            (true, false) => 3,
        };
        index = 4 * index + quarter;
        (x, y) = (x & (half - 1), y & (half - 1));
        (x, y) = match quarter {
            0 => (y, x),
            3 => (half - 1 - y, half - 1 - x),
            _ => (x, y),
        };
    }
    index
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A Hilbert curve visits every cell of a grid, each next to the one before.
    fn goes_from_cell_to_neighbouring_cell<const D: usize>(side: usize) {
        let positions: Vec<[f64; D]> = (0..side.pow(D as u32))
            .map(|cell| std::array::from_fn(|axis| (cell / side.pow(axis as u32) % side) as f64))
            .collect();
        let order = along_hilbert_curve(&positions);
        let mut met = order.clone();
        met.sort_unstable();
        assert!(met.iter().copied().eq(0..positions.len() as u32));
        for pair in order.windows(2) {
            let [a, b] = [0, 1].map(|k| positions[pair[k] as usize]);
            let steps = a.iter().zip(&b).map(|(a, b)| (a - b).abs());
            assert_eq!(steps.sum::<f64>(), 1.0, "{a:?} {b:?}");
        }
    }

    #[test]
    fn the_curve_goes_from_cell_to_neighbouring_cell() {
        goes_from_cell_to_neighbouring_cell::<2>(16);
        goes_from_cell_to_neighbouring_cell::<3>(8);
    }

    #[test]
    fn points_at_one_place_keep_their_order() {
        assert_eq!(along_hilbert_curve(&[[2.0, 3.0]; 3]), [0, 1, 2]);
        assert!(along_hilbert_curve::<2>(&[]).is_empty());
    }
}
