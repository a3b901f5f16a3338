//! Sides of elements as Abaqus numbers them.

use super::element_type::Shape;

/// Corners of each side as indices of the corners of the element, in the order of the numbers S1, S2, ...
type Sides = &'static [&'static [usize]];

const TRIANGLE: Sides = &[&[0, 1], &[1, 2], &[2, 0]];
const QUADRANGLE: Sides = &[&[0, 1], &[1, 2], &[2, 3], &[3, 0]];
const TETRAHEDRON: Sides = &[&[0, 1, 2], &[0, 3, 1], &[1, 3, 2], &[2, 3, 0]];
const PYRAMID: Sides = &[
    &[0, 1, 2, 3],
    &[0, 4, 1],
    &[1, 4, 2],
    &[2, 4, 3],
    &[3, 4, 0],
];
const PRISM: Sides = &[
    &[0, 1, 2],
    &[3, 5, 4],
    &[0, 3, 4, 1],
    &[1, 4, 5, 2],
    &[2, 5, 3, 0],
];
const HEXAHEDRON: Sides = &[
    &[0, 1, 2, 3],
    &[4, 7, 6, 5],
    &[0, 4, 5, 1],
    &[1, 5, 6, 2],
    &[2, 6, 7, 3],
    &[3, 7, 4, 0],
];

impl Shape {
    /// Corners of each side, edges of planar shapes and faces of solid ones.
    pub(super) fn sides(self) -> Sides {
        match self {
            Shape::Edge => &[],
            Shape::Triangle => TRIANGLE,
            Shape::Quadrangle => QUADRANGLE,
            Shape::Tetrahedron => TETRAHEDRON,
            Shape::Pyramid => PYRAMID,
            Shape::Prism => PRISM,
            Shape::Hexahedron => HEXAHEDRON,
        }
    }

    /// Corners at the ends of the edge in whose middle the node at a place of an element of second order is; `None` for other places.
    pub(super) fn edge(self, place: usize) -> Option<[usize; 2]> {
        let around = match self {
            Shape::Edge => 1,
            Shape::Triangle | Shape::Tetrahedron | Shape::Prism => 3,
            Shape::Quadrangle | Shape::Pyramid | Shape::Hexahedron => 4,
        };
        let number = place.checked_sub(self.corners())?;
        let (ring, k) = (number / around, number % around);
        let is_apex = matches!(self, Shape::Tetrahedron | Shape::Pyramid);
        match (ring, self.corners() - around) {
            (0, _) => Some([k, (k + 1) % around.max(2)]),
            (1, 1) if is_apex => Some([k, around]),
            (1, above) if above == around => Some([around + k, around + (k + 1) % around]),
            (2, above) if above == around => Some([k, around + k]),
            _ => None,
        }
    }

    /// Nodes of a side of an element, without those that follow themselves; `None` for a number that the shape does not have.
    pub(super) fn side<T: Copy + PartialEq>(self, corners: &[T], number: usize) -> Option<Vec<T>> {
        let places = self.sides().get(number.checked_sub(1)?)?;
        Some(without_repetition(places.iter().map(|it| corners[*it])))
    }
}

/// Corners around a side without those that repeat the one before.
pub(super) fn without_repetition<T: Copy + PartialEq>(corners: impl Iterator<Item = T>) -> Vec<T> {
    let mut distinct: Vec<T> = corners.collect();
    distinct.dedup();
    if distinct.len() > 1 && distinct.first() == distinct.last() {
        distinct.pop();
    }
    distinct
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every edge of a closed surface belongs to two faces, which run along it in opposite directions.
    #[test]
    fn sides_close_the_shape() {
        for shape in [
            Shape::Tetrahedron,
            Shape::Pyramid,
            Shape::Prism,
            Shape::Hexahedron,
        ] {
            let mut edges = Vec::new();
            for side in shape.sides() {
                edges.extend((0..side.len()).map(|k| [side[k], side[(k + 1) % side.len()]]));
            }
            assert!(edges.iter().all(|&[a, b]| edges.contains(&[b, a])));
        }
    }

    #[test]
    fn sides_are_without_repeated_corners() {
        let pyramid = [1, 2, 3, 4, 5, 5, 5, 5];
        let side = |number| Shape::Hexahedron.side(&pyramid, number);
        assert_eq!(side(1), Some(vec![1, 2, 3, 4]));
        assert_eq!(side(2), Some(vec![5]));
        assert_eq!(side(3), Some(vec![1, 5, 2]));
        assert_eq!(side(6), Some(vec![4, 5, 1]));
        assert_eq!((side(0), side(7)), (None, None));
    }
}
