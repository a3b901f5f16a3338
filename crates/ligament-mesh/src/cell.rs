//! Planar cells.

/// A planar cell given by its corner nodes (indices into the mesh's nodes), counter-clockwise.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cell {
    /// Three corners.
    Triangle([u32; 3]),
    /// Four corners of a convex quadrangle.
    Quadrangle([u32; 4]),
}

impl Cell {
    /// The corner nodes of the cell, in order around it.
    pub fn corners(&self) -> &[u32] {
        match self {
            Cell::Triangle(corners) => corners,
            Cell::Quadrangle(corners) => corners,
        }
    }

    /// The corner nodes of the cell, to be renumbered or turned around.
    pub(crate) fn corners_mut(&mut self) -> &mut [u32] {
        match self {
            Cell::Triangle(corners) => corners,
            Cell::Quadrangle(corners) => corners,
        }
    }

    /// The area of the cell with the nodes at `positions`, m²; negative where the corners stand clockwise.
    ///
    /// # Panics
    /// If a corner is no index into `positions`.
    pub fn area(&self, positions: &[[f64; 2]]) -> f64 {
        let corners = self.corners();
        let [x0, y0] = positions[corners[0] as usize];
        // Triangles fanned from the first corner: differences keep the digits of a cell far from the origin.
        let twice: f64 = corners[1..]
            .windows(2)
            .map(|pair| {
                let [xa, ya] = positions[pair[0] as usize];
                let [xb, yb] = positions[pair[1] as usize];
                (xa - x0) * (yb - y0) - (xb - x0) * (ya - y0)
            })
            .sum();
        0.5 * twice
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn area_of_a_triangle_changes_sign_with_its_orientation() {
        let positions = [[1.0, 1.0], [4.0, 1.0], [1.0, 3.0]];
        assert_eq!(Cell::Triangle([0, 1, 2]).area(&positions), 3.0);
        assert_eq!(Cell::Triangle([0, 2, 1]).area(&positions), -3.0);
    }

    #[test]
    fn area_of_a_trapezium_is_mean_width_times_height() {
        let positions = [[0.0, 0.0], [4.0, 0.0], [3.0, 2.0], [1.0, 2.0]];
        assert_eq!(Cell::Quadrangle([0, 1, 2, 3]).area(&positions), 6.0);
    }

    #[test]
    fn area_keeps_its_digits_far_from_the_origin() {
        let positions = [[1e6, 1e6], [1e6 + 0.5, 1e6], [1e6, 1e6 + 0.5]];
        assert_eq!(Cell::Triangle([0, 1, 2]).area(&positions), 0.125);
    }
}
