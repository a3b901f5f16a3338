//! Shape quality of tetrahedra.

use super::cell::SolidCell;

impl SolidCell {
    /// Radius ratio of a tetrahedron, 3 r/R with the radii of its inscribed and circumscribed spheres: 1 for a regular one, towards 0 for
    /// slivers, needles and caps; Gmsh's gamma. `None` for other shapes.
    ///
    /// With V the volume, A the area of the surface and a, b, c the products of the lengths of opposite edges, r = 3 V/A and
    /// R = sqrt((a + b + c)(a + b - c)(a - b + c)(b + c - a))/(24 V).
    ///
    /// # Panics
    /// Panics if a corner is no index into `positions`.
    pub fn radius_ratio(&self, positions: &[[f64; 3]]) -> Option<f64> {
        let SolidCell::Tetrahedron(corners) = self else {
            return None;
        };
        let length = |from: usize, to: usize| {
            let [p, q] = [from, to].map(|place| positions[corners[place] as usize]);
            let squares = (0..3).map(|axis| (q[axis] - p[axis]).powi(2));
            squares.sum::<f64>().sqrt()
        };
        let [a, b, c] = [
            length(0, 1) * length(2, 3),
            length(0, 2) * length(1, 3),
            length(0, 3) * length(1, 2),
        ];
        let area = |[x, y, z]: [f64; 3]| (x * x + y * y + z * z).sqrt();
        let surface: f64 = self.faces().map(|it| area(it.area_vector(positions))).sum();
        let volume = self.volume(positions).abs();
        // Rounding may make the product of a flat cell slightly negative.
        let product = ((a + b + c) * (a + b - c) * (a - b + c) * (b + c - a)).max(0.0);
        let denominator = surface * product.sqrt();
        let ratio = 216.0 * volume * volume / denominator;
        Some(if denominator > 0.0 {
            ratio.min(1.0)
        } else {
            0.0
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ratio(positions: [[f64; 3]; 4]) -> f64 {
        let cell = SolidCell::Tetrahedron([0, 1, 2, 3]);
        cell.radius_ratio(&positions).expect("a tetrahedron")
    }

    /// By hand: the corner of a cube of side 1 has r = (3 - sqrt(3))/6 and R = sqrt(3)/2. A sliver of four corners of a square, one
    /// pair lifted by h, has V = h/3, A about 2 and R about half the diagonal: 3 r/R is about 3 sqrt(2)/2 h for a small h.
    #[test]
    fn ratios_are_those_of_elementary_geometry() {
        let regular = [
            [1.0, 1.0, 1.0],
            [1.0, -1.0, -1.0],
            [-1.0, 1.0, -1.0],
            [-1.0, -1.0, 1.0],
        ];
        assert!((ratio(regular) - 1.0).abs() < 1e-14);
        let corner = [
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [0.0, 0.0, 1.0],
        ];
        let expected = 3.0 * (3.0 - 3.0_f64.sqrt()) / 6.0 / (0.5 * 3.0_f64.sqrt());
        assert!((ratio(corner) - expected).abs() < 1e-14);
        let height = 1e-4;
        let sliver = [
            [0.0, 0.0, 0.0],
            [1.0, 0.0, height],
            [1.0, 1.0, 0.0],
            [0.0, 1.0, height],
        ];
        let expected = 1.5 * 2.0_f64.sqrt() * height;
        assert!((ratio(sliver) / expected - 1.0).abs() < 1e-6);
        assert_eq!(ratio([[0.0; 3]; 4]), 0.0);
        let pyramid = SolidCell::Pyramid([0, 1, 2, 3, 0]);
        assert_eq!(pyramid.radius_ratio(&regular), None);
    }
}
