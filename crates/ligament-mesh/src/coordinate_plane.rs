//! Plane in which a mesh without solid cells lies: from another one than that of x and y it is turned into it.

use std::fmt;

/// A plane of two coordinates.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum CoordinatePlane {
    /// The plane of x and y.
    #[default]
    Xy,
    /// The plane of x and z, seen with x to the right and z upwards.
    Xz,
    /// The plane of y and z, seen with y to the right and z upwards.
    Yz,
}

impl CoordinatePlane {
    /// All planes.
    pub const ALL: [Self; 3] = [Self::Xy, Self::Xz, Self::Yz];

    /// Name of the plane: its two coordinates.
    pub fn word(self) -> &'static str {
        match self {
            Self::Xy => "xy",
            Self::Xz => "xz",
            Self::Yz => "yz",
        }
    }

    /// A position turned together with this plane into the plane of x and y: the coordinates to the right, upwards and towards the viewer.
    pub(crate) fn turned(self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        match self {
            Self::Xy => [x, y, z],
            Self::Xz => [x, z, -y],
            Self::Yz => [y, z, x],
        }
    }

    /// A position in the file whose turned position is given.
    pub(crate) fn turned_back(self, [right, upwards, towards]: [f64; 3]) -> [f64; 3] {
        match self {
            Self::Xy => [right, upwards, towards],
            Self::Xz => [right, -towards, upwards],
            Self::Yz => [towards, right, upwards],
        }
    }

    /// Name of the coordinate that is constant in the plane, and its index.
    pub(crate) fn normal(self) -> (&'static str, usize) {
        match self {
            Self::Xy => ("z", 2),
            Self::Xz => ("y", 1),
            Self::Yz => ("x", 0),
        }
    }

    /// How a mesh in this plane comes into a wanted one.
    pub(crate) fn remedy(self, wanted: Self) -> String {
        let rotation = match (self, wanted) {
            (Self::Xz, Self::Xy) => "{1, 0, 0}, {0, 0, 0}, -Pi/2",
            (Self::Yz, Self::Xy) => "{1, 1, 1}, {0, 0, 0}, -2*Pi/3",
            _ => return format!("read it in the plane of {self}"),
        };
        format!("turn it (`Rotate {{{rotation}}} {{ Surface{{:}}; }}` in the geometry)")
    }
}

impl fmt::Display for CoordinatePlane {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Xy => "x and y",
            Self::Xz => "x and z",
            Self::Yz => "y and z",
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rotations have the determinant 1: right, upwards and towards the viewer stay a right-handed system.
    #[test]
    fn planes_are_turned_and_not_mirrored() {
        for plane in CoordinatePlane::ALL {
            let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
            let [a, b, c] = axes.map(|it| plane.turned(it));
            let determinant: f64 = (0..3)
                .map(|k| {
                    let [l, m] = [(k + 1) % 3, (k + 2) % 3];
                    a[k] * (b[l] * c[m] - b[m] * c[l])
                })
                .sum();
            assert_eq!(determinant, 1.0, "{plane}");
            let position = [2.0, 3.0, 5.0];
            let turned = plane.turned(position);
            assert_eq!(plane.turned_back(turned), position);
            assert_eq!(turned[2].abs(), position[plane.normal().1]);
        }
    }
}
