//! The points in the order of a space-filling curve.
//!
//! Mesh generators number nodes in an order in which neighbours lie far apart. Loops that visit points and their
//! neighbours wait for memory then; along a Hilbert curve they find them where they have just been.

use rayon::prelude::*;

/// Steps of the curve, which separates places that differ by 2^-STEPS of the box around the points.
const STEPS: u32 = 31;

/// All points, each once, in the order in which a Hilbert curve through the square around them meets them, shape
/// (n_points). Points at one place of the curve keep their order.
pub(crate) fn along_hilbert_curve(positions: &[[f64; 2]]) -> Vec<u32> {
    let corner = |pick: fn(f64, f64) -> f64, start: f64| {
        let fold = |c: [f64; 2], p: &[f64; 2]| [pick(c[0], p[0]), pick(c[1], p[1])];
        positions.iter().fold([start; 2], fold)
    };
    let lower = corner(f64::min, f64::INFINITY);
    let upper = corner(f64::max, f64::NEG_INFINITY);
    let side = (upper[0] - lower[0]).max(upper[1] - lower[1]);
    let scale = ((1_u64 << STEPS) - 1) as f64 / side.max(f64::MIN_POSITIVE);
    let mut keys: Vec<(u64, u32)> = positions
        .par_iter()
        .enumerate()
        .map(|(point, p)| {
            let [x, y] = [0, 1].map(|axis| ((p[axis] - lower[axis]) * scale) as u64);
            (hilbert_index(x, y), point as u32)
        })
        .collect();
    keys.par_sort_unstable();
    keys.into_par_iter().map(|(_, point)| point).collect()
}

/// Place of the cell (x, y) of a grid of 2^STEPS times 2^STEPS on the Hilbert curve.
///
/// At each step the curve goes through four quarters; in the first it is mirrored at the rising diagonal, in the last at
/// the falling one.
fn hilbert_index(mut x: u64, mut y: u64) -> u64 {
    let mut index = 0;
    for step in (0..STEPS).rev() {
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

    /// A Hilbert curve meets every cell of a grid, and each beside the last one.
    #[test]
    fn the_curve_goes_from_cell_to_neighbouring_cell() {
        const SIDE: usize = 16;
        let positions: Vec<[f64; 2]> = (0..SIDE * SIDE)
            .map(|cell| [(cell % SIDE) as f64, (cell / SIDE) as f64])
            .collect();
        let order = along_hilbert_curve(&positions);
        let mut met = order.clone();
        met.sort_unstable();
        assert!(met.iter().copied().eq(0..(SIDE * SIDE) as u32));
        for pair in order.windows(2) {
            let [a, b] = [0, 1].map(|k| positions[pair[k] as usize]);
            assert_eq!(
                (a[0] - b[0]).abs() + (a[1] - b[1]).abs(),
                1.0,
                "{a:?} {b:?}"
            );
        }
    }

    #[test]
    fn points_at_one_place_keep_their_order() {
        assert_eq!(along_hilbert_curve(&[[2.0, 3.0]; 3]), [0, 1, 2]);
        assert!(along_hilbert_curve(&[]).is_empty());
    }
}
