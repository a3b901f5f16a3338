//! Closed forms of the interval of a line of deformations in which a bond stays within its limit.
//!
//! With d(t) = d_0 + t d_1 a measure is the largest of some linear functions of t, or the root of a quadratic one where the bond
//! is stretched. In space shear and relative rotation are vectors: |gamma_0 + t gamma_1|^2 is a quadratic function of t that is no square
//! of a linear one.

use super::hooke::StressAcross;
use super::measure::Measure;
use crate::deformation::{Deformation, SpaceDeformation};
use crate::element::BondDeformation;
use crate::tensor::dot;

/// Interval of t from the first bound to the second.
pub type Interval = [f64; 2];

/// The unbounded interval.
pub const EVERYWHERE: Interval = [f64::NEG_INFINITY, f64::INFINITY];

const NOWHERE: Interval = [f64::INFINITY, f64::NEG_INFINITY];

/// A deformation whose strains along a line d_0 + t d_1 are known.
pub(super) trait AlongLine: Deformation {
    /// Type of shear and relative rotation, whose size enters measures: a number in the plane, a vector in space.
    type Sized: Strain;

    /// The strains along the line.
    fn along(line: [&Self; 2]) -> Strains<Self::Sized>;
}

/// Strains of a bond along a line, each with its value and its slope.
pub(super) struct Strains<S> {
    stretch: Linear,
    shear: S,
    rotation: S,
}

/// The function c_0 + c_1 t.
type Linear = [f64; 2];

/// The function a t^2 + b t + c.
type Quadratic = [f64; 3];

/// A strain along a line whose size enters measures.
pub(super) trait Strain: Copy {
    /// The strain times a factor.
    fn times(self, factor: f64) -> Self;

    /// Square of its size times a factor q.
    fn square_times(self, q: f64) -> Quadratic;

    /// Interval in which the sum of its size and another strain is at most a limit; empty (first bound larger) if there is none.
    fn beside_at_most(self, other: Linear, limit: f64) -> Interval;
}

impl AlongLine for BondDeformation {
    type Sized = Linear;

    fn along(line: [&Self; 2]) -> Strains<Linear> {
        Strains {
            stretch: line.map(Self::stretch),
            shear: line.map(Self::shear),
            rotation: line.map(Self::rotation),
        }
    }
}

impl AlongLine for SpaceDeformation {
    type Sized = [[f64; 3]; 2];

    fn along(line: [&Self; 2]) -> Strains<Self::Sized> {
        Strains {
            stretch: line.map(|it| it.stretch),
            shear: line.map(|it| it.shear),
            rotation: line.map(|it| it.rotation),
        }
    }
}

impl Strain for Linear {
    fn times(self, factor: f64) -> Self {
        self.map(|it| factor * it)
    }

    fn square_times(self, q: f64) -> Quadratic {
        let [value, slope] = self;
        let times = q * value;
        [q * slope * slope, 2.0 * (times * slope), times * value]
    }

    fn beside_at_most(self, [value, slope]: Linear, limit: f64) -> Interval {
        let plus = at_most([value + self[0], slope + self[1]], limit);
        intersection(plus, at_most([value - self[0], slope - self[1]], limit))
    }
}

/// The vector v_0 + t v_1.
impl Strain for [[f64; 3]; 2] {
    fn times(self, factor: f64) -> Self {
        self.map(|vector| vector.map(|it| factor * it))
    }

    fn square_times(self, q: f64) -> Quadratic {
        let [value, slope] = self;
        let mixed = q * dot(value, slope);
        [q * dot(slope, slope), 2.0 * mixed, q * dot(value, value)]
    }

    /// Where |v|^2 is at most the square of what the other strain leaves of the limit, and that is not negative. Where the other one
    /// outruns the vector, the quadratic bends down, and is at most zero beyond its roots to both sides: to the one side because
    /// enough is left, to the other because the limit is far exceeded.
    fn beside_at_most(self, other: Linear, limit: f64) -> Interval {
        let (left, slope) = (limit - other[0], 0.0 - other[1]);
        let [a, b, c] = self.square_times(1.0);
        let beyond = [a - slope * slope, b - 2.0 * (left * slope), c - left * left];
        match roots(beyond).filter(|_| beyond[0] < 0.0) {
            Some([_, upper]) if slope > 0.0 => [upper, f64::INFINITY],
            Some([lower, _]) => [f64::NEG_INFINITY, lower],
            None => intersection(quadratic(beyond), at_most(other, limit)),
        }
    }
}

impl Measure {
    /// Whether [`Measure::interval_within`] has a closed form for the measure with these coefficients.
    pub(super) fn is_known_along_lines(self, coefficients: &[f64]) -> bool {
        match self {
            Self::Tension
            | Self::Compression
            | Self::Fibre
            | Self::Sliding
            | Self::Friction
            | Self::Energy
            | Self::StoredEnergy => true,
            Self::MixedModeX | Self::MixedModeY => coefficients.get(1).is_none_or(|&r| r == 1.0),
            Self::NormalStress | Self::CoulombStress => true,
            Self::PrintedOpening | Self::PrintedSliding | Self::PrintedMixed => false,
        }
    }

    /// The t for which the measure of the first deformation of a line + t the second is at most a limit; None where it is for no t. The
    /// stress across the bond goes along a line as well.
    ///
    /// # Panics
    ///
    /// Panics for measures that are not [known along lines](Measure::is_known_along_lines).
    pub(super) fn interval_within<B: AlongLine>(
        self,
        line: [&B; 2],
        coefficients: &[f64],
        stress: [StressAcross; 2],
        limit: f64,
    ) -> Option<Interval> {
        let of_ends = B::along(line);
        let (stretch, shear) = (of_ends.stretch, of_ends.shear);
        let q = coefficients.first().copied().unwrap_or(0.0);
        let mixed = |axis: usize| {
            let [start, slope] = line.map(|it| it.measured().strain());
            let [opening, sliding] = [axis, 2].map(|it| [start[it], slope[it]]);
            root(opening, sliding.square_times(q), limit)
        };
        let interval = match self {
            Self::Tension => at_most(stretch, limit),
            Self::Compression => at_most(stretch.times(-1.0), limit),
            Self::Fibre => of_ends.rotation.times(q).beside_at_most(stretch, limit),
            Self::Sliding => shear.beside_at_most([0.0; 2], limit),
            Self::Friction => shear.beside_at_most(stretch.times(q), limit),
            Self::Energy => root(stretch, shear.square_times(q), limit),
            Self::StoredEnergy => {
                let [a, b, c] = stretch.square_times(1.0);
                let [d, e, f] = shear.square_times(q);
                quadratic([a + d, b + e, c + f - limit * limit])
            }
            Self::MixedModeX => mixed(0),
            Self::MixedModeY => mixed(1),
            Self::NormalStress => at_most(stress.map(|it| it.normal), limit),
            Self::CoulombStress => {
                let slope = coefficients.last().copied().unwrap_or(0.0);
                let normal = stress.map(|it| it.normal).times(slope);
                stress.map(|it| it.shear).beside_at_most(normal, limit)
            }
            Self::PrintedOpening | Self::PrintedSliding | Self::PrintedMixed => {
                unreachable!("measures of the bonds that are left have no closed form")
            }
        };
        (interval[0] <= interval[1]).then_some(interval)
    }
}

/// Interval in which a strain is at most a limit; empty (first bound larger) if there is none.
fn at_most([value, slope]: Linear, limit: f64) -> Interval {
    let reached = (limit - value) / slope;
    match slope {
        slope if slope > 0.0 => [f64::NEG_INFINITY, reached],
        slope if slope < 0.0 => [reached, f64::INFINITY],
        _ if value <= limit => EVERYWHERE,
        _ => NOWHERE,
    }
}

/// Interval in which sqrt(max(s, 0)^2 + g), g = q |gamma|^2, is at most a limit: where the quadratic is while the bond is stretched, and g alone
/// elsewhere. Where q is negative and the quadratic bends down, up to its first root beyond s = 0.
fn root(s: Linear, g: Quadratic, limit: f64) -> Interval {
    let [a, b, c] = s.square_times(1.0);
    let sliding = quadratic([g[0], g[1], g[2] - limit * limit]);
    let stretched = quadratic([a + g[0], b + g[1], c + g[2] - limit * limit]);
    let (closed, open) = (at_most(s, 0.0), at_most(s.times(-1.0), 0.0));
    hull(intersection(sliding, closed), intersection(stretched, open))
}

/// Interval in which a t^2 + b t + c is at most zero; where the parabola bends down, the part on the side of t = 0.
fn quadratic([a, b, c]: Quadratic) -> Interval {
    if a == 0.0 {
        return at_most([c, b], 0.0);
    }
    match roots([a, b, c]) {
        None if a > 0.0 => NOWHERE,
        None => EVERYWHERE,
        Some(roots) if a > 0.0 => roots,
        Some([lower, _]) if lower >= 0.0 => [f64::NEG_INFINITY, lower],
        Some([_, upper]) => [upper, f64::INFINITY],
    }
}

/// The smaller and the larger root of a t^2 + b t + c with a nonzero; None without real roots.
fn roots([a, b, c]: Quadratic) -> Option<[f64; 2]> {
    let discriminant = b * b - 4.0 * a * c;
    if discriminant < 0.0 {
        return None;
    }
    // The root whose terms do not cancel, and the other one by their product c/a.
    let sum = -0.5 * (b + discriminant.sqrt().copysign(b));
    let (one, other) = (sum / a, if sum == 0.0 { 0.0 } else { c / sum });
    Some([one.min(other), one.max(other)])
}

fn intersection(one: Interval, other: Interval) -> Interval {
    [one[0].max(other[0]), one[1].min(other[1])]
}

/// The smallest interval that contains both intervals; an empty one adds nothing.
fn hull(one: Interval, other: Interval) -> Interval {
    let is_empty = |it: Interval| it[0] > it[1];
    match (is_empty(one), is_empty(other)) {
        (true, _) => other,
        (_, true) => one,
        _ => [one[0].min(other[0]), one[1].max(other[1])],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const OF_PAIRS: [Measure; 6] = [
        Measure::Tension,
        Measure::Compression,
        Measure::Fibre,
        Measure::Sliding,
        Measure::Friction,
        Measure::Energy,
    ];

    fn deformation(strains: [f64; 3]) -> BondDeformation {
        BondDeformation::new(strains)
    }

    /// Closed forms against a search along the line in fine steps.
    fn assert_as_searched<B: AlongLine>(line: [&B; 2], measures: &[Measure], q: f64) {
        let [start, slope] = line;
        for measure in measures {
            let value = |t: f64| {
                let at = start.less(&slope.scaled(-t)).measured();
                measure.value(&at, &[q], StressAcross::default)
            };
            let interval = measure.interval_within(line, &[q], [StressAcross::default(); 2], 0.8);
            // Where q is negative the measure may fall again: beyond the first place where it is at its limit nothing is asked.
            let steps = if q > 0.0 { -4000..=4000 } else { 0..=4000 };
            let mut passed = false;
            for place in steps {
                let t = f64::from(place) * 1e-3;
                let found = interval.is_some_and(|[from, to]| from <= t && t <= to);
                let near = (value(t) - 0.8).abs() < 1e-9;
                passed |= q < 0.0 && value(t) > 0.8;
                let expected = !passed && value(t) <= 0.8;
                assert!(near || found == expected, "{measure:?} at {t} with {q}");
            }
        }
    }

    /// Lines that open, close and slide.
    #[test]
    fn intervals_are_those_of_a_search() {
        let lines = [
            ([0.3, 0.1, 0.2], [1.0, -0.5, 0.3]),
            ([-0.5, 0.2, 0.0], [1.3, 0.8, -0.4]),
            ([0.2, -0.1, 0.1], [-1.1, 0.3, 0.9]),
            ([0.1, 0.0, 0.0], [0.0, 1.0, 0.2]),
            ([-0.2, 0.3, 0.0], [0.7, 0.0, 0.0]),
        ];
        for (start, slope) in lines.map(|(a, b)| (deformation(a), deformation(b))) {
            let line = [&start, &slope];
            assert_as_searched(line, &OF_PAIRS, 0.4);
            assert_as_searched(line, &[Measure::MixedModeX, Measure::MixedModeY], 0.4);
        }
    }

    /// Lines that open, close, slide and turn, of shears and rotations that change their direction. Of friction and fibres the stretch
    /// outruns the size of the vector or not, to either side.
    #[test]
    fn intervals_of_vectors_are_those_of_a_search() {
        let lines = [
            ([0.3, 0.1, 0.2, -0.3], [1.0, -0.5, 0.3, 0.7]),
            ([-0.5, 0.2, 0.0, 0.4], [1.3, 0.8, -0.4, 0.0]),
            ([0.2, -0.1, 0.1, 0.9], [-1.1, 0.3, 0.9, 0.2]),
            ([0.1, 0.0, 0.0, 0.3], [0.0, 1.0, 0.2, 0.0]),
            ([-0.2, 0.3, 0.0, 0.1], [0.7, 0.0, 0.0, 0.0]),
            ([0.1, 0.3, 0.2, 0.1], [1.5, 0.1, -0.2, 0.2]),
            ([0.1, 0.3, 0.2, 0.1], [-1.5, 0.1, -0.2, 0.2]),
        ];
        let deformation = |[stretch, x, y, z]: [f64; 4]| SpaceDeformation {
            stretch,
            shear: [x, y, z],
            rotation: [z, 0.5 * x, -y],
        };
        for (start, slope) in lines.map(|(a, b)| (deformation(a), deformation(b))) {
            let line = [&start, &slope];
            assert_as_searched(line, &OF_PAIRS, 0.4);
            assert_as_searched(line, &OF_PAIRS, 2.0);
            assert_as_searched(line, &[Measure::Energy], -0.2);
        }
    }

    /// Stresses whose shear turns, outruns the normal stress or is outrun by it, or lies in one line as in the plane, against a search.
    #[test]
    fn intervals_of_stresses_are_those_of_a_search() {
        let stresses = [
            ([0.3, 0.1, 0.2, -0.3], [1.0, -0.5, 0.3, 0.7]),
            ([-0.5, 0.2, 0.0, 0.4], [1.3, 0.8, -0.4, 0.0]),
            ([0.2, -0.1, 0.1, 0.1], [-2.1, 0.3, 0.9, 0.2]),
            ([0.1, 0.2, 0.1, 0.0], [0.5, -1.0, -0.5, 0.0]),
            ([-0.4, 0.6, 0.2, 0.0], [0.0, 0.0, 0.0, 0.0]),
        ];
        let line = [0.1, -0.2].map(|stretch| deformation([stretch, 0.4, 0.0]));
        for (start, slope) in stresses {
            let of_line = [start, slope].map(|[normal, x, y, z]| StressAcross {
                normal,
                shear: [x, y, z],
            });
            for measure in [Measure::NormalStress, Measure::CoulombStress] {
                let interval = measure.interval_within([&line[0], &line[1]], &[0.7], of_line, 0.8);
                for place in -4000..=4000 {
                    let t = f64::from(place) * 1e-3;
                    let at = || of_line[0].plus(&of_line[1], t);
                    let value = measure.value(&line[0], &[0.7], at);
                    let found = interval.is_some_and(|[from, to]| from <= t && t <= to);
                    let near = (value - 0.8).abs() < 1e-9;
                    assert!(near || found == (value <= 0.8), "{measure:?} at {t}");
                }
            }
        }
    }

    #[test]
    fn a_bond_that_slides_too_far_is_beyond_its_limit_wherever_it_closes() {
        let (start, slope) = (deformation([0.0, 3.0, 0.0]), deformation([1.0, 0.0, 0.0]));
        assert_eq!(
            Measure::Energy.interval_within(
                [&start, &slope],
                &[0.5],
                [StressAcross::default(); 2],
                1.0
            ),
            None
        );
        assert_eq!(
            Measure::Tension.interval_within(
                [&start, &slope],
                &[],
                [StressAcross::default(); 2],
                1.0
            ),
            Some([f64::NEG_INFINITY, 1.0])
        );
    }

    /// With q < 0 the quadratic bends down where shear grows faster than stretch: never beyond its limit here.
    #[test]
    fn a_negative_shear_stiffness_takes_from_the_measure() {
        let (start, slope) = (deformation([0.5, 0.0, 0.0]), deformation([0.1, 1.0, 0.0]));
        assert_eq!(
            Measure::Energy.interval_within(
                [&start, &slope],
                &[-0.5],
                [StressAcross::default(); 2],
                1.0
            ),
            Some(EVERYWHERE)
        );
        assert!(!Measure::PrintedMixed.is_known_along_lines(&[0.5]));
        assert!(!Measure::MixedModeX.is_known_along_lines(&[0.5, 3.0, 1.0]));
    }
}
