//! The side from which a solid is seen.

use std::str::FromStr;

/// The side from which a distant eye looks: lengths are seen the same everywhere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    /// Angle of the eye about z from the x axis, degrees.
    pub azimuth: f64,
    /// Angle of the eye above the plane of x and y, degrees.
    pub elevation: f64,
    /// Axis that points up. With y the angles are about y from z, and above the plane of z and x.
    pub up: Upward,
}

/// Axis that points up in a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Upward {
    /// The y axis, as in many models of finite elements.
    Y,
    /// The z axis.
    #[default]
    Z,
}

impl View {
    /// View from the front, the right and above.
    pub const OBLIQUE: Self = Self {
        azimuth: -60.0,
        elevation: 28.0,
        up: Upward::Z,
    };

    /// Unit vectors to the right, up and to the eye.
    pub(super) fn axes(self) -> [[f64; 3]; 3] {
        let (sin_a, cos_a) = sin_cos(self.azimuth);
        let (sin_e, cos_e) = sin_cos(self.elevation);
        let axes = [
            [-sin_a, cos_a, 0.0],
            [-sin_e * cos_a, -sin_e * sin_a, cos_e],
            [cos_e * cos_a, cos_e * sin_a, sin_e],
        ];
        match self.up {
            Upward::Z => axes,
            Upward::Y => axes.map(|[of_z, of_x, of_y]| [of_x, of_y, of_z]),
        }
    }

    /// The view with an axis upwards: along an axis from the same side, otherwise with its angles about this axis.
    pub(in crate::picture) fn with_up(self, up: Upward) -> Self {
        let [_, _, to_eye] = self.axes();
        match to_eye.iter().any(|it| it.abs() == 1.0) {
            true => Self::along_with(to_eye, up),
            false => Self { up, ..self },
        }
    }

    /// A place in the axes of the view: to the right, up and towards the eye, m.
    pub(super) fn projected_places(self, place: [f64; 3]) -> [f64; 3] {
        let along = |axis: [f64; 3]| (0..3).map(|k| axis[k] * place[k]).sum();
        self.axes().map(along)
    }

    /// The view against a normal, from the side to which it points; with z upwards, or y if the normal is along z.
    pub(in crate::picture) fn along(normal: [f64; 3]) -> Self {
        Self::along_with(normal, Upward::Z)
    }

    fn along_with([x, y, z]: [f64; 3], up: Upward) -> Self {
        let [x, y, z] = match up {
            Upward::Z => [x, y, z],
            Upward::Y => [z, x, y],
        };
        let flat = libm::hypot(x, y);
        let is_upright = flat < 1e-9 * z.abs();
        Self {
            azimuth: if is_upright {
                -90.0
            } else {
                libm::atan2(y, x).to_degrees()
            },
            elevation: libm::atan2(z, flat).to_degrees(),
            up,
        }
    }
}

/// Sine and cosine of degrees, the same on every machine, and exact along the axes.
fn sin_cos(degrees: f64) -> (f64, f64) {
    match degrees.rem_euclid(360.0) {
        0.0 => (0.0, 1.0),
        90.0 => (1.0, 0.0),
        180.0 => (0.0, -1.0),
        270.0 => (-1.0, 0.0),
        angle => libm::sincos(angle.to_radians()),
    }
}

impl FromStr for View {
    type Err = String;

    /// Reads `x`, `y`, `z`, `iso` or an azimuth and an elevation.
    fn from_str(text: &str) -> Result<Self, String> {
        let of = |azimuth, elevation| {
            Ok(Self {
                azimuth,
                elevation,
                up: Upward::Z,
            })
        };
        match text.trim() {
            "x" => return of(0.0, 0.0),
            "y" => return of(-90.0, 0.0),
            "z" => return of(-90.0, 90.0),
            "iso" => return Ok(Self::OBLIQUE),
            _ => {}
        }
        let numbers: Option<Vec<f64>> = text.split(',').map(|it| it.trim().parse().ok()).collect();
        match numbers.as_deref() {
            Some(&[azimuth, elevation]) if azimuth.is_finite() && elevation.abs() <= 90.0 => {
                of(azimuth, elevation)
            }
            _ => Err("expected x, y, z, iso, or AZIMUTH,ELEVATION in degrees with an elevation from -90 to 90".to_owned()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn views_along_the_axes_show_two_of_them() {
        let seen = |view: &str| {
            view.parse::<View>()
                .unwrap()
                .projected_places([1.0, 2.0, 3.0])
        };
        assert_eq!(seen("x"), [2.0, 3.0, 1.0]);
        assert_eq!(seen("y"), [1.0, 3.0, -2.0]);
        assert_eq!(seen("z"), [1.0, 2.0, 3.0]);
        assert_eq!(
            "10, -20".parse(),
            Ok(View {
                azimuth: 10.0,
                elevation: -20.0,
                up: Upward::Z
            })
        );
        assert!("1,91".parse::<View>().is_err() && "top".parse::<View>().is_err());
        assert_eq!(View::along([0.0, -2.0, 0.0]), "y".parse().unwrap());
        assert_eq!(View::along([0.0, 0.0, 1.0]), "z".parse().unwrap());
    }

    /// With y upwards a body is seen from z with x to the right, from x with z to the left, and obliquely with y up.
    #[test]
    fn y_can_point_upwards() {
        let seen = |view: &str| {
            let view = view.parse::<View>().unwrap().with_up(Upward::Y);
            view.projected_places([1.0, 2.0, 3.0])
        };
        assert_eq!(seen("z"), [1.0, 2.0, 3.0]);
        assert_eq!(seen("x"), [-3.0, 2.0, 1.0]);
        let up = View::OBLIQUE.with_up(Upward::Y).axes()[1];
        assert!(up[1] > 0.8 && (up[1] - View::OBLIQUE.axes()[1][2]).abs() < 1e-15);
    }
}
