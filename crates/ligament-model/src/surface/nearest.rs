//! The point of a facet nearest to a position.

use super::Corners;
use crate::geometry::nearest_place;
use crate::tensor::{dot, minus};

/// Weights of the corners at the place of a facet nearest to a position, D of them; the others are zero.
pub(super) fn nearest_weights<const D: usize>(
    corners: &Corners<D>,
    position: [f64; D],
) -> [f64; 3] {
    if D == 2 {
        let place = nearest_place([corners[0], corners[1]], position);
        return [1.0 - place, place, 0.0];
    }
    on_triangle([corners[0], corners[1], corners[2]], position)
}

/// Weights of the corners of a triangle at its place nearest to a position (Ericson 2005, section 5.1.5).
fn on_triangle<const D: usize>([a, b, c]: [[f64; D]; 3], position: [f64; D]) -> [f64; 3] {
    let (ab, ac) = (minus(b, a), minus(c, a));
    let along = |corner: [f64; D]| {
        let way = minus(position, corner);
        [dot(ab, way), dot(ac, way)]
    };
    let [[a1, a2], [b1, b2], [c1, c2]] = [a, b, c].map(along);
    if a1 <= 0.0 && a2 <= 0.0 {
        return [1.0, 0.0, 0.0];
    }
    if b1 >= 0.0 && b2 <= b1 {
        return [0.0, 1.0, 0.0];
    }
    let at_c = a1 * b2 - b1 * a2;
    if at_c <= 0.0 && a1 >= 0.0 && b1 <= 0.0 {
        let place = a1 / (a1 - b1);
        return [1.0 - place, place, 0.0];
    }
    if c2 >= 0.0 && c1 <= c2 {
        return [0.0, 0.0, 1.0];
    }
    let at_b = c1 * a2 - a1 * c2;
    if at_b <= 0.0 && a2 >= 0.0 && c2 <= 0.0 {
        let place = a2 / (a2 - c2);
        return [1.0 - place, 0.0, place];
    }
    let at_a = b1 * c2 - c1 * b2;
    let (from_b, from_c) = (b2 - b1, c1 - c2);
    if at_a <= 0.0 && from_b >= 0.0 && from_c >= 0.0 {
        let place = from_b / (from_b + from_c);
        return [0.0, 1.0 - place, place];
    }
    let whole = at_a + at_b + at_c;
    [1.0 - (at_b + at_c) / whole, at_b / whole, at_c / whole]
}

#[cfg(test)]
mod tests {
    use super::super::weighted;
    use super::*;
    use crate::tensor::norm;

    /// The nearest of 20,000 places of a triangle, for positions all around it, is no nearer than the one found, and nearly as near.
    #[test]
    fn no_place_of_a_triangle_is_nearer() {
        let corners = [[0.0, 0.0, 0.0], [2.0, 0.3, 0.1], [0.4, 1.5, -0.2]];
        let distance = |weights: [f64; 3], position: [f64; 3]| {
            norm(minus(weighted(&corners, &weights), position))
        };
        for number in 0..400 {
            let share = |stride: f64| (f64::from(number) * stride).fract() * 4.0 - 1.5;
            let position = [share(0.618_034), share(0.414_214), share(0.732_051)];
            let found = nearest_weights(&corners, position);
            assert!(found.iter().all(|it| (0.0..=1.0).contains(it)), "{found:?}");
            assert!((found.iter().sum::<f64>() - 1.0).abs() < 1e-15);
            let places = (0..=200).flat_map(|one| {
                (0..=200 - one).map(move |other| {
                    let [one, other] = [one, other].map(|it| f64::from(it) / 200.0);
                    [1.0 - one - other, one, other]
                })
            });
            let best = places.map(|it| distance(it, position)).fold(9.0, f64::min);
            let least = distance(found, position);
            // Places are 0.01 apart.
            assert!(least <= best + 1e-14 && best < least + 0.01, "{position:?}");
        }
    }

    #[test]
    fn places_of_a_segment_end_at_its_ends() {
        let corners = [[0.0, 0.0], [2.0, 0.0]];
        assert_eq!(nearest_weights(&corners, [0.5, 3.0]), [0.75, 0.25, 0.0]);
        assert_eq!(nearest_weights(&corners, [-1.0, 3.0]), [1.0, 0.0, 0.0]);
        assert_eq!(nearest_weights(&corners, [7.0, -3.0]), [0.0, 1.0, 0.0]);
    }
}
