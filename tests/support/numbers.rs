//! Small mathematics.

use ligament_analysis::{Bonds, Component, Layout, State, fields};
use ligament_model::failure::{Criteria, Weakened};

/// |value / expected - 1|.
pub fn relative_error(value: f64, expected: f64) -> f64 {
    (value / expected - 1.0).abs()
}

/// Largest |value|; NaN where one is NaN.
pub fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().fold(0.0, |largest: f64, value| {
        if value.is_nan() || value.abs() > largest {
            value.abs()
        } else {
            largest
        }
    })
}

/// Damage of every point by each way in which some criterion lets bonds fail, with its name in results.
pub fn damages(
    system: &dyn Bonds,
    criteria: &Criteria,
    state: &State,
) -> Vec<(&'static str, Vec<f64>)> {
    let ways = [
        ("damage_tension", Weakened::Opening),
        ("damage_compression", Weakened::Crushing),
        ("damage_sliding", Weakened::Sliding),
    ];
    let occurs = |way: Weakened| criteria.list.iter().any(|it| it.measure.weakens() == way);
    ways.into_iter()
        .filter(|&(_, way)| occurs(way))
        .map(|(name, way)| (name, fields::damage_by(system, criteria, state, way)))
        .collect()
}

/// Largest |one - other| over the largest |other|.
pub fn deviation(one: &[f64], other: &[f64]) -> f64 {
    assert_eq!(one.len(), other.len());
    let difference = largest(one.iter().zip(other).map(|(a, b)| a - b));
    difference / largest(other.iter().copied())
}

/// Numbers in short, for a test's report.
pub fn short(values: &[f64]) -> String {
    let words: Vec<String> = values.iter().map(|value| format!("{value:.1e}")).collect();
    words.join(" ")
}

/// Values of all degrees of freedom by point: along x, along y and of rotation, zero where points do not turn.
pub fn by_point(layout: Layout, of_all: &[f64]) -> Vec<[f64; 3]> {
    assert_eq!(of_all.len(), layout.n_degrees_of_freedom());
    (0..layout.n_points as u32)
        .map(|point| Component::ALL.map(|component| layout.value(point, component, of_all)))
        .collect()
}

/// Values of all degrees of freedom: those of x, y and rotation that points have.
pub fn of_all(layout: Layout, by_point: impl IntoIterator<Item = [f64; 3]>) -> Vec<f64> {
    let plane = Layout {
        components: &Component::ALL,
        ..layout
    };
    plane.reduced(layout, by_point.into_iter().flatten().collect())
}

/// Components `c` of an array over the degrees of freedom of points that turn (3 a point).
pub fn component(values: &[f64], c: usize) -> Vec<f64> {
    values.iter().skip(c).step_by(3).copied().collect()
}

/// Pseudo-random numbers in [-1, 1), the same on every machine (splitmix64).
pub struct Random(pub u64);

impl Random {
    /// The next number, uniformly distributed.
    pub fn uniform(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    /// A permutation of 0..n.
    pub fn permutation(&mut self, n: usize) -> Vec<usize> {
        let mut order: Vec<usize> = (0..n).collect();
        for last in (1..n).rev() {
            order.swap(last, (self.bits() % (last as u64 + 1)) as usize);
        }
        order
    }

    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }
}

/// Least-squares fit value = c0 + c1 x + c2 y; returns (c1, c2).
pub fn gradient(positions: &[[f64; 2]], values: &[f64]) -> [f64; 2] {
    assert_eq!(positions.len(), values.len());
    assert!(positions.len() > 3, "too few points to fit a plane");
    let n = positions.len() as f64;
    let mean = |of: &dyn Fn(usize) -> f64| (0..positions.len()).map(of).sum::<f64>() / n;
    let [x, y] = [0, 1].map(|axis| mean(&|i| positions[i][axis]));
    let v = mean(&|i| values[i]);
    let moment = |f: &dyn Fn(f64, f64, f64) -> f64| {
        mean(&|i| f(positions[i][0] - x, positions[i][1] - y, values[i] - v))
    };
    let [xx, xy, yy] = [
        moment(&|x, _, _| x * x),
        moment(&|x, y, _| x * y),
        moment(&|_, y, _| y * y),
    ];
    let [xv, yv] = [moment(&|x, _, v| x * v), moment(&|_, y, v| y * v)];
    let determinant = xx * yy - xy * xy;
    [
        (xv * yy - yv * xy) / determinant,
        (yv * xx - xv * xy) / determinant,
    ]
}
