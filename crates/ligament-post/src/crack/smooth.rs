//! Smoothing of jagged lines.

use super::faces::distance;

/// Replaces each position of a line by the mean of the line within `reach` (m) on both sides, less near its ends, which are fixed.
///
/// With p(s) the line by its arc length s from 0 to L: p'(s) = 1/(2 w) integral of p from s - w to s + w, w = min(reach, s, L - s).
pub(super) fn smooth(line: &[[f64; 2]], reach: f64) -> Vec<[f64; 2]> {
    let mut arc = vec![0.0; line.len()];
    for place in 1..line.len() {
        arc[place] = arc[place - 1] + distance(line[place - 1], line[place]);
    }
    let Some(&whole) = arc.last() else {
        return Vec::new();
    };
    let mean = |place: usize| {
        let half = reach.min(arc[place]).min(whole - arc[place]);
        if half <= 0.0 {
            return line[place];
        }
        let [from, to] = [arc[place] - half, arc[place] + half];
        let first = arc.partition_point(|it| *it <= from).max(1);
        let mut sum = [0.0; 2];
        for next in (first..line.len()).take_while(|&next| arc[next - 1] < to) {
            let [start, end] = [arc[next - 1].max(from), arc[next].min(to)];
            let at = |s: f64| on_segment(line, &arc, next, s);
            let (a, b) = (at(start), at(end));
            for axis in 0..2 {
                sum[axis] += 0.5 * (end - start) * (a[axis] + b[axis]);
            }
        }
        sum.map(|it| it / (2.0 * half))
    };
    (0..line.len()).map(mean).collect()
}

/// Position at arc length `s` on the segment that ends at `next`.
fn on_segment(line: &[[f64; 2]], arc: &[f64], next: usize, s: f64) -> [f64; 2] {
    let length = arc[next] - arc[next - 1];
    let share = if length > 0.0 {
        (s - arc[next - 1]) / length
    } else {
        0.0
    };
    let [a, b] = [line[next - 1], line[next]];
    [a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_straight_line_stays_and_a_jagged_one_becomes_nearly_straight() {
        let line = |height: f64| -> Vec<[f64; 2]> {
            let place = |k: i32| [f64::from(k), if k % 2 == 0 { height } else { -height }];
            (0..=20).map(place).collect()
        };
        let straight = line(0.0);
        for (before, after) in straight.iter().zip(smooth(&straight, 3.0)) {
            assert!(distance(*before, after) < 1e-12);
        }
        let jagged = line(0.5);
        let smoothed = smooth(&jagged, 3.0);
        assert_eq!([smoothed[0], smoothed[20]], [jagged[0], jagged[20]]);
        let inside = smoothed[4..17].iter().map(|it| it[1].abs());
        assert!(inside.fold(0.0, f64::max) < 0.1);
    }
}
