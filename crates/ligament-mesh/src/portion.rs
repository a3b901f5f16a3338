//! Portions of curves and surfaces, over which loads are integrated.

use std::collections::BTreeMap;

/// An edge, a triangle, or the place of a single point, with the same share for each of its corners.
#[derive(Debug, Clone, PartialEq)]
pub struct Portion<const N: usize> {
    /// Corners: two of an edge, three of a triangle, one of a single point.
    pub corners: Vec<u32>,
    /// Integral of a corner's shape function: a length (m), an area (m^2), or one of these times the normal.
    pub share: [f64; N],
}

impl<const N: usize> Portion<N> {
    /// Mean of a factor over the share of one corner, for a factor that is linear between the corners.
    ///
    /// The integral of a product of shape functions over a simplex of n corners and size S is S (1 + delta_ab)/(n (n + 1)), and the share is
    /// S/n. The mean is the factor of the corner plus the sum of the factors of all corners, over n + 1 (Zienkiewicz 2013). It is exact, and
    /// one if all factors are one.
    pub fn mean(&self, corner: u32, factor: impl Fn(u32) -> f64) -> f64 {
        let all: f64 = self.corners.iter().map(|&it| factor(it)).sum();
        (factor(corner) + all) / (self.corners.len() as f64 + 1.0)
    }

    /// Sums of the shares at the points, ascending.
    pub fn at_points(portions: &[Self]) -> Vec<(u32, [f64; N])> {
        Self::sums(portions, |_, _| 1.0)
    }

    /// Sums at the points, ascending, of the shares times a factor of portion and corner.
    pub fn sums(portions: &[Self], factor: impl Fn(&Self, u32) -> f64) -> Vec<(u32, [f64; N])> {
        let mut sums: BTreeMap<u32, [f64; N]> = BTreeMap::new();
        for portion in portions {
            for &corner in &portion.corners {
                let factor = factor(portion, corner);
                let sum = sums.entry(corner).or_insert([0.0; N]);
                for (sum, share) in sum.iter_mut().zip(portion.share) {
                    *sum += factor * share;
                }
            }
        }
        sums.into_iter().collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A factor that is linear over a triangle with the corners (0, 0), (1, 0), (0, 1): the integral of N_a x is 1/24 at the corners with
    /// x = 0 and 1/12 at the one with x = 1, by hand.
    #[test]
    fn means_over_a_triangle_are_integrals() {
        let triangle = Portion {
            corners: vec![4, 7, 9],
            share: [1.0 / 6.0],
        };
        let x = |corner: u32| if corner == 7 { 1.0 } else { 0.0 };
        let integral = |corner: u32| triangle.share[0] * triangle.mean(corner, x);
        for (corner, exact) in [(4, 1.0 / 24.0), (7, 1.0 / 12.0), (9, 1.0 / 24.0)] {
            assert!((integral(corner) - exact).abs() < 1e-17);
        }
    }

    /// Three edges of a polyline: the force and the moment of a linear traction, which sums of values at the nodes do not have.
    #[test]
    fn a_linear_factor_over_edges_has_its_force_and_moment() {
        let places = [0.0, 0.1, 0.4, 1.0];
        let edges = [[0, 1], [2, 1], [2, 3]].map(|corners: [u32; 2]| {
            let [from, to] = corners.map(|it| places[it as usize]);
            Portion {
                corners: corners.to_vec(),
                share: [0.5 * f64::abs(to - from)],
            }
        });
        let factor = |corner: u32| 2.0 - 3.0 * places[corner as usize];
        let forces = Portion::sums(&edges, |edge, corner| edge.mean(corner, factor));
        let force: f64 = forces.iter().map(|(_, [it])| it).sum();
        let moments = forces
            .iter()
            .map(|(point, [it])| it * places[*point as usize]);
        let moment: f64 = moments.sum();
        // Integrals of 2 - 3 x and of 2 x - 3 x^2 from 0 to 1; a few roundings.
        assert!(
            (force - 0.5).abs() < 1e-15 && moment.abs() < 1e-15,
            "{force} {moment}"
        );
    }

    #[test]
    fn factors_of_one_change_no_bit_and_a_point_keeps_its_factor() {
        let edges = [[0.1], [0.7], [1.0 / 3.0]].map(|share| Portion {
            corners: vec![1, 0],
            share,
        });
        let ones = Portion::sums(&edges, |edge, corner| edge.mean(corner, |_| 1.0));
        assert_eq!(ones, Portion::at_points(&edges));
        let point = Portion {
            corners: vec![3],
            share: [2.0],
        };
        assert_eq!(point.mean(3, |_| 0.1), 0.1);
    }
}
