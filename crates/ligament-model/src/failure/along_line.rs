//! Where a bond stays within its limit while its deformation goes along a line, in closed form.
//!
//! With d(t) = d_0 + t d_1 a measure is the largest of some linear functions of t, or the root of a quadratic one where the bond
//! is stretched.

use super::measure::Measure;
use crate::element::BondDeformation;

/// All t from the first to the second.
pub type Interval = [f64; 2];

/// All t, to both sides without an end.
pub const EVERYWHERE: Interval = [f64::NEG_INFINITY, f64::INFINITY];

/// A strain along the line: value + t slope.
#[derive(Debug, Clone, Copy)]
pub(super) struct Linear {
    pub(super) value: f64,
    pub(super) slope: f64,
}

impl Linear {
    fn plus(self, factor: f64, other: Self) -> Self {
        Self {
            value: self.value + factor * other.value,
            slope: self.slope + factor * other.slope,
        }
    }

    pub(super) fn negative(self) -> Self {
        Self {
            value: -self.value,
            slope: -self.slope,
        }
    }

    /// Square times a factor q.
    fn square_times(self, q: f64) -> Quadratic {
        Quadratic {
            a: q * self.slope * self.slope,
            half_b: q * self.value * self.slope,
            c: q * self.value * self.value,
        }
    }

    /// Where it is at most a limit; empty (the first is larger) where it nowhere is.
    pub(super) fn at_most(self, limit: f64) -> Interval {
        let reached = (limit - self.value) / self.slope;
        match self.slope {
            slope if slope > 0.0 => [f64::NEG_INFINITY, reached],
            slope if slope < 0.0 => [reached, f64::INFINITY],
            _ if self.value <= limit => EVERYWHERE,
            _ => [f64::INFINITY, f64::NEG_INFINITY],
        }
    }
}

impl Measure {
    /// Whether [`Measure::within`] knows the measure with these coefficients.
    pub fn is_known_along_lines(self, coefficients: &[f64]) -> bool {
        match self {
            Self::Tension
            | Self::Compression
            | Self::Fibre
            | Self::Sliding
            | Self::Friction
            | Self::Energy => true,
            Self::MixedModeX | Self::MixedModeY => coefficients.get(1).is_none_or(|&r| r == 1.0),
            Self::PrintedOpening | Self::PrintedSliding | Self::PrintedMixed => false,
        }
    }

    /// The t for which the measure of `here` + t `slope` is at most a limit; None where it is for no t.
    ///
    /// # Panics
    ///
    /// Panics for measures that are not [known along lines](Measure::is_known_along_lines).
    pub fn within(
        self,
        [here, slope]: [&BondDeformation; 2],
        coefficients: &[f64],
        limit: f64,
    ) -> Option<Interval> {
        let strain = |of: fn(&BondDeformation) -> f64| Linear {
            value: of(here),
            slope: of(slope),
        };
        let stretch = strain(BondDeformation::stretch);
        let shear = strain(BondDeformation::shear);
        let rotation = strain(BondDeformation::rotation);
        let q = coefficients.first().copied().unwrap_or(0.0);
        let either = |one: Linear, other: Linear| both(one.at_most(limit), other.at_most(limit));
        let interval = match self {
            Self::Tension => stretch.at_most(limit),
            Self::Compression => stretch.negative().at_most(limit),
            Self::Fibre => either(stretch.plus(q, rotation), stretch.plus(-q, rotation)),
            Self::Sliding => either(shear, shear.negative()),
            Self::Friction => either(shear.plus(q, stretch), shear.negative().plus(q, stretch)),
            Self::Energy => root(stretch, shear.square_times(q), limit),
            Self::MixedModeX => {
                let [opening, sliding] = [0, 2].map(|place| Linear {
                    value: here.strain()[place],
                    slope: slope.strain()[place],
                });
                root(opening, sliding.square_times(q), limit)
            }
            Self::MixedModeY => {
                let [opening, sliding] = [1, 2].map(|place| Linear {
                    value: here.strain()[place],
                    slope: slope.strain()[place],
                });
                root(opening, sliding.square_times(q), limit)
            }
            Self::PrintedOpening | Self::PrintedSliding | Self::PrintedMixed => {
                unreachable!("printed measures have no closed form")
            }
        };
        (interval[0] <= interval[1]).then_some(interval)
    }
}

/// The function a t^2 + 2 b t + c.
#[derive(Debug, Clone, Copy)]
pub(super) struct Quadratic {
    pub(super) a: f64,
    pub(super) half_b: f64,
    pub(super) c: f64,
}

/// Where sqrt(max(s, 0)^2 + g), g = q gamma^2, is at most a limit: where the quadratic is while the bond is stretched, and g alone
/// elsewhere. Where q is negative and the quadratic bends down, up to its first root beyond s = 0.
pub(super) fn root(s: Linear, g: Quadratic, limit: f64) -> Interval {
    let sliding = quadratic([g.a, 2.0 * g.half_b, g.c - limit * limit]);
    let stretched = quadratic([
        s.slope * s.slope + g.a,
        2.0 * (s.value * s.slope + g.half_b),
        s.value * s.value + g.c - limit * limit,
    ]);
    let closed = s.at_most(0.0);
    let open = s.negative().at_most(0.0);
    hull(both(sliding, closed), both(stretched, open))
}

/// Where a t^2 + b t + c is at most zero; one that bends down is taken at the side of its roots on which t = 0 lies.
pub(super) fn quadratic([a, b, c]: [f64; 3]) -> Interval {
    if a == 0.0 {
        return Linear { value: c, slope: b }.at_most(0.0);
    }
    let discriminant = b * b - 4.0 * a * c;
    if discriminant < 0.0 {
        return if a > 0.0 {
            [f64::INFINITY, f64::NEG_INFINITY]
        } else {
            EVERYWHERE
        };
    }
    // The root whose terms do not cancel, and the other one by their product c/a.
    let sum = -0.5 * (b + discriminant.sqrt().copysign(b));
    let (one, other) = (sum / a, if sum == 0.0 { 0.0 } else { c / sum });
    let [lower, upper] = [one.min(other), one.max(other)];
    match a > 0.0 {
        true => [lower, upper],
        false if lower >= 0.0 => [f64::NEG_INFINITY, lower],
        false => [upper, f64::INFINITY],
    }
}

pub(super) fn both(one: Interval, other: Interval) -> Interval {
    [one[0].max(other[0]), one[1].min(other[1])]
}

/// The interval that spans both; an empty one adds nothing.
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

    fn deformation(strains: [f64; 3]) -> BondDeformation {
        BondDeformation::new(strains)
    }

    /// Closed forms against a search along the line in fine steps, for lines that open, close and slide.
    #[test]
    fn intervals_are_those_of_a_search() {
        let lines = [
            ([0.3, 0.1, 0.2], [1.0, -0.5, 0.3]),
            ([-0.5, 0.2, 0.0], [1.3, 0.8, -0.4]),
            ([0.2, -0.1, 0.1], [-1.1, 0.3, 0.9]),
            ([0.1, 0.0, 0.0], [0.0, 1.0, 0.2]),
            ([-0.2, 0.3, 0.0], [0.7, 0.0, 0.0]),
        ];
        let measures = [
            Measure::Tension,
            Measure::Compression,
            Measure::Fibre,
            Measure::Sliding,
            Measure::Friction,
            Measure::Energy,
            Measure::MixedModeX,
            Measure::MixedModeY,
        ];
        for (here, slope) in lines.map(|(a, b)| (deformation(a), deformation(b))) {
            for measure in measures {
                let value = |t: f64| {
                    let at = here.less(&slope.scaled(-t));
                    measure.value(&at, &[0.4])
                };
                let interval = measure.within([&here, &slope], &[0.4], 0.8);
                for place in -4000..=4000 {
                    let t = f64::from(place) * 1e-3;
                    let found = interval.is_some_and(|[from, to]| from <= t && t <= to);
                    let near = (value(t) - 0.8).abs() < 1e-9;
                    assert!(near || found == (value(t) <= 0.8), "{measure:?} at {t}");
                }
            }
        }
    }

    #[test]
    fn a_bond_that_slides_too_far_is_beyond_its_limit_wherever_it_closes() {
        let (here, slope) = (deformation([0.0, 3.0, 0.0]), deformation([1.0, 0.0, 0.0]));
        assert_eq!(Measure::Energy.within([&here, &slope], &[0.5], 1.0), None);
        assert_eq!(
            Measure::Tension.within([&here, &slope], &[], 1.0),
            Some([f64::NEG_INFINITY, 1.0])
        );
    }

    /// With q < 0 the quadratic bends down where shear grows faster than stretch: never beyond its limit here.
    #[test]
    fn a_negative_shear_stiffness_takes_from_the_measure() {
        let (here, slope) = (deformation([0.5, 0.0, 0.0]), deformation([0.1, 1.0, 0.0]));
        assert_eq!(
            Measure::Energy.within([&here, &slope], &[-0.5], 1.0),
            Some(EVERYWHERE)
        );
        assert!(!Measure::PrintedMixed.is_known_along_lines(&[0.5]));
        assert!(!Measure::MixedModeX.is_known_along_lines(&[0.5, 3.0, 1.0]));
    }
}
