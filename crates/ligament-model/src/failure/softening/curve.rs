//! A fall of the force by any curve of stress over the opening of a crack.

use std::fmt;
use std::sync::Arc;

use super::softened::Softened;

/// Stress y, over the strength, in straight lines over the opening x of a crack, over the opening w_c at which the stress is gone.
///
/// A bond that opens by w beside its elastic deformation has kappa = e/e_0 = y + r x with r = w_c/w_0, the law's parameter: the deformation at
/// the end over that at the limit. The force over that at the limit is y. With the area A(x) under the stress up to x, the energy that
/// is gone is r (2 A - x y) over that at the limit, and the whole life takes 2 r A(1).
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    corners: Arc<[Corner]>,
    /// The last opening in the given unit.
    last_opening: f64,
    /// The first stress in the given unit.
    strength: f64,
}

/// A corner of a curve.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Corner {
    opening: f64,
    stress: f64,
    /// Area under the stress from the opening zero to the corner.
    area: f64,
}

/// Reason why points are no curve of a softening law.
#[derive(Debug, Clone, PartialEq)]
pub enum CurveError {
    /// Fewer than two points.
    TooFew,
    /// The first opening is not zero.
    Start(f64),
    /// The first stress is not positive.
    Strength(f64),
    /// An opening is not larger than the one before.
    Opening {
        /// Number of the point, from 1.
        point: usize,
        /// Opening of the point.
        opening: f64,
        /// Opening of the previous point.
        before: f64,
    },
    /// A stress is larger than the one before, or negative.
    Stress {
        /// Number of the point, from 1.
        point: usize,
        /// Stress of the point.
        stress: f64,
        /// Stress of the previous point.
        before: f64,
    },
    /// The last stress is not zero.
    End(f64),
}

impl fmt::Display for CurveError {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooFew => formatter.write_str("a curve has two points or more"),
            Self::Start(found) => write!(
                formatter,
                "the first opening must be 0, where the stress is the strength; it is {found:?}"
            ),
            Self::Strength(found) => write!(
                formatter,
                "the first stress is the strength and must be greater than 0; it is {found:?}"
            ),
            Self::Opening {
                point,
                opening,
                before,
            } => write!(
                formatter,
                "openings must rise from point to point; point {point} has {opening:?} after {before:?}"
            ),
            Self::Stress {
                point,
                stress,
                before,
            } => write!(
                formatter,
                "stresses must fall or stay, down to 0; point {point} has {stress:?} after {before:?}"
            ),
            Self::End(found) => write!(
                formatter,
                "the last stress must be 0, at the opening where the crack bears nothing; it is {found:?}"
            ),
        }
    }
}

impl std::error::Error for CurveError {}

impl Curve {
    /// The curve through points (opening, stress), shape (n, 2). Their units do not matter: openings count over the last one, stresses over the
    /// first one.
    ///
    /// # Errors
    ///
    /// If openings do not begin at 0 and rise, or stresses do not fall to 0.
    pub fn new(points: &[[f64; 2]]) -> Result<Self, CurveError> {
        let (&[start, strength], &[last, end]) = match points {
            [first, .., last] => (first, last),
            _ => return Err(CurveError::TooFew),
        };
        if start != 0.0 {
            return Err(CurveError::Start(start));
        }
        if !(strength > 0.0 && strength.is_finite()) {
            return Err(CurveError::Strength(strength));
        }
        for (place, pair) in points.windows(2).enumerate() {
            let [[before, higher], [opening, stress]] = [pair[0], pair[1]];
            let point = place + 2;
            if !(opening > before && opening.is_finite()) {
                return Err(CurveError::Opening {
                    point,
                    opening,
                    before,
                });
            }
            if !(0.0..=higher).contains(&stress) {
                return Err(CurveError::Stress {
                    point,
                    stress,
                    before: higher,
                });
            }
        }
        if end != 0.0 {
            return Err(CurveError::End(end));
        }
        let mut area = 0.0;
        let mut before = [0.0, 1.0];
        let corner = |point: &[f64; 2]| {
            let [opening, stress] = [point[0] / last, point[1] / strength];
            area += 0.5 * (before[1] + stress) * (opening - before[0]);
            before = [opening, stress];
            Corner {
                opening,
                stress,
                area,
            }
        };
        Ok(Self {
            corners: points.iter().map(corner).collect(),
            last_opening: last,
            strength,
        })
    }

    /// Two straight lines that meet at a share of the last opening and of the strength.
    ///
    /// # Errors
    ///
    /// If one of the shares is not between 0 and 1.
    pub fn kinked(at: [f64; 2]) -> Result<Self, CurveError> {
        Self::new(&[[0.0, 1.0], at, [1.0, 0.0]])
    }

    /// The corners as given, (opening, stress), shape (n, 2).
    pub fn points(&self) -> impl Iterator<Item = [f64; 2]> {
        let corners = self.corners.iter();
        corners.map(|it| [it.opening * self.last_opening, it.stress * self.strength])
    }

    /// The first stress as given: the strength, Pa, or 1 where stresses are given over the strength.
    pub fn strength(&self) -> f64 {
        self.strength
    }

    /// Area under the curve as given: of openings in m and stresses in Pa the fracture energy, J/m^2.
    pub fn area(&self) -> f64 {
        0.5 * self.total(1.0) * self.last_opening * self.strength
    }

    /// Largest slope -dy/dx. A bond softens without a jump where r exceeds it.
    pub fn steepest(&self) -> f64 {
        let slope = |pair: &[Corner]| {
            (pair[0].stress - pair[1].stress) / (pair[1].opening - pair[0].opening)
        };
        self.corners.windows(2).map(slope).fold(0.0, f64::max)
    }

    /// State of a bond past its limit at the largest kappa so far, with kappa = `end` at the end of the curve.
    pub fn at(&self, end: f64, kappa: f64) -> Softened {
        let deformation = |corner: &Corner| corner.stress + end * corner.opening;
        let next = self.corners.partition_point(|it| deformation(it) <= kappa);
        let next = next.clamp(1, self.corners.len() - 1);
        let [one, other] = [self.corners[next - 1], self.corners[next]];
        let share = (kappa - deformation(&one)) / (deformation(&other) - deformation(&one));
        let share = share.clamp(0.0, 1.0);
        let opening = one.opening + share * (other.opening - one.opening);
        let force = one.stress + share * (other.stress - one.stress);
        let area = one.area + 0.5 * (one.stress + force) * (opening - one.opening);
        Softened {
            force,
            secant: force / kappa,
            dissipated: end * (2.0 * area - opening * force),
        }
    }

    /// Dissipated energy of a bond over the energy at its limit, with kappa = `end` at the end of the curve.
    pub fn total(&self, end: f64) -> f64 {
        let area = self.corners.last().map_or(0.0, |it| it.area);
        2.0 * end * area
    }
}
