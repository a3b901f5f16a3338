//! Where a bond in space stays within its limit while its deformation goes along a line, in closed form.
//!
//! The stretch is linear in t as in the plane. Shear is a vector: |gamma_0 + t gamma_1|^2 is a quadratic function of t that is no square of a
//! linear one.

use super::along_line::{Interval, Linear, Quadratic, quadratic, root};
use super::measure::Measure;
use crate::deformation::SpaceDeformation;

impl Measure {
    /// Whether [`Measure::within_in_space`] knows the measure.
    pub fn is_known_along_lines_in_space(self) -> bool {
        matches!(
            self,
            Self::Tension | Self::Compression | Self::Sliding | Self::Energy
        )
    }

    /// The t for which the measure of `here` + t `slope` is at most a limit; None where it is for no t.
    ///
    /// # Panics
    ///
    /// Panics for measures that are not [known along lines](Measure::is_known_along_lines_in_space).
    pub fn within_in_space(
        self,
        [here, slope]: [&SpaceDeformation; 2],
        coefficients: &[f64],
        limit: f64,
    ) -> Option<Interval> {
        let stretch = Linear {
            value: here.stretch,
            slope: slope.stretch,
        };
        let interval = match self {
            Self::Tension => stretch.at_most(limit),
            Self::Compression => stretch.negative().at_most(limit),
            Self::Sliding => {
                let square = square_of_shear([here, slope], 1.0);
                quadratic([square.a, 2.0 * square.half_b, square.c - limit * limit])
            }
            Self::Energy => {
                let q = coefficients.first().copied().unwrap_or(0.0);
                root(stretch, square_of_shear([here, slope], q), limit)
            }
            _ => unreachable!("bonds in space have no such measure along lines"),
        };
        (interval[0] <= interval[1]).then_some(interval)
    }
}

/// q |gamma|^2 along a line.
fn square_of_shear([here, slope]: [&SpaceDeformation; 2], q: f64) -> Quadratic {
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    Quadratic {
        a: q * dot(slope.shear, slope.shear),
        half_b: q * dot(here.shear, slope.shear),
        c: q * dot(here.shear, here.shear),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::deformation::Deformation;

    /// Closed forms against a search along the line in fine steps, for lines that open, close, slide and turn.
    #[test]
    fn intervals_are_those_of_a_search() {
        let lines = [
            ([0.3, 0.1, 0.2, -0.3], [1.0, -0.5, 0.3, 0.7]),
            ([-0.5, 0.2, 0.0, 0.4], [1.3, 0.8, -0.4, 0.0]),
            ([0.2, -0.1, 0.1, 0.9], [-1.1, 0.3, 0.9, 0.2]),
            ([0.1, 0.0, 0.0, 0.3], [0.0, 1.0, 0.2, 0.0]),
            ([-0.2, 0.3, 0.0, 0.1], [0.7, 0.0, 0.0, 0.0]),
        ];
        let deformation = |[stretch, x, y, z]: [f64; 4]| SpaceDeformation {
            stretch,
            shear: [x, y, z],
            rotation: [0.0; 3],
        };
        let measures = [
            Measure::Tension,
            Measure::Compression,
            Measure::Sliding,
            Measure::Energy,
        ];
        for (here, slope) in lines.map(|(a, b)| (deformation(a), deformation(b))) {
            for measure in measures {
                for q in [0.4, -0.2] {
                    let value = |t: f64| {
                        let at = here.less(&slope.scaled(-t)).measured();
                        measure.value(&at, &[q])
                    };
                    let interval = measure.within_in_space([&here, &slope], &[q], 0.8);
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
        }
    }
}
