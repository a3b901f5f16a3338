//! A plane through a solid.

use std::str::FromStr;

/// A plane by a point on it and its normal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Section {
    /// A point of the plane, m.
    pub point: [f64; 3],
    /// Unit normal.
    pub normal: [f64; 3],
}

impl Section {
    /// Distance of a place from the plane, positive on the side that the normal points to, m.
    pub(super) fn distance(&self, place: [f64; 3]) -> f64 {
        (0..3)
            .map(|axis| (place[axis] - self.point[axis]) * self.normal[axis])
            .sum()
    }
}

impl FromStr for Section {
    type Err = String;

    /// Reads `x=0.05`, or a point and a normal `PX,PY,PZ,NX,NY,NZ`.
    fn from_str(text: &str) -> Result<Self, String> {
        let wrong = || {
            "expected x=0.05, y=.. or z=.. in m, or a point and a normal PX,PY,PZ,NX,NY,NZ"
                .to_owned()
        };
        let number = |text: &str| text.trim().parse::<f64>().ok().filter(|it| it.is_finite());
        if let Some((axis, at)) = text.split_once('=') {
            let axis = ["x", "y", "z"]
                .iter()
                .position(|it| *it == axis.trim())
                .ok_or_else(wrong)?;
            let at = number(at).ok_or_else(wrong)?;
            let mut section = Self {
                point: [0.0; 3],
                normal: [0.0; 3],
            };
            (section.point[axis], section.normal[axis]) = (at, 1.0);
            return Ok(section);
        }
        let numbers: Option<Vec<f64>> = text.split(',').map(number).collect();
        match numbers.as_deref() {
            Some(&[x, y, z, a, b, c]) => {
                let length = (a * a + b * b + c * c).sqrt();
                let normal = [a, b, c].map(|it| it / length);
                let section = Self {
                    point: [x, y, z],
                    normal,
                };
                (length > 0.0).then_some(section).ok_or_else(wrong)
            }
            _ => Err(wrong()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sections_are_read() {
        let section: Section = "y=-0.5".parse().unwrap();
        assert_eq!(section.distance([7.0, 1.0, 9.0]), 1.5);
        let section: Section = "1,0,0, 0,3,4".parse().unwrap();
        assert_eq!(section.distance([1.0, 5.0, 0.0]), 3.0);
        assert!("w=1".parse::<Section>().is_err() && "0,0,0,0,0,0".parse::<Section>().is_err());
    }
}
