//! Sides of elements as Abaqus numbers them, and the cells that elements with repeated corners are.

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

    /// Nodes of a side of an element, without those that follow themselves; `None` for a number that the shape does not have.
    pub(super) fn side<T: Copy + PartialEq>(self, corners: &[T], number: usize) -> Option<Vec<T>> {
        let places = self.sides().get(number.checked_sub(1)?)?;
        Some(without_repetition(places.iter().map(|it| corners[*it])))
    }
}

/// Corners around a face without those that repeat the one before.
fn without_repetition<T: Copy + PartialEq>(corners: impl Iterator<Item = T>) -> Vec<T> {
    let mut distinct: Vec<T> = corners.collect();
    distinct.dedup();
    if distinct.len() > 1 && distinct.first() == distinct.last() {
        distinct.pop();
    }
    distinct
}

/// Whether two of the corners are the same.
pub(super) fn is_collapsed<T: PartialEq>(corners: &[T]) -> bool {
    let mut places = 1..corners.len();
    places.any(|place| corners[..place].contains(&corners[place]))
}

/// Corners of the cell that an element with repeated corners is; `None` where it is none.
pub(super) fn collapsed<T: Copy + PartialEq>(shape: Shape, corners: &[T]) -> Option<Vec<T>> {
    if matches!(shape, Shape::Triangle | Shape::Quadrangle) {
        let distinct = without_repetition(corners.iter().copied());
        return (distinct.len() > 2 && !is_collapsed(&distinct)).then_some(distinct);
    }
    let sides = 1..=shape.sides().len();
    let mut faces: Vec<Vec<T>> = sides.filter_map(|it| shape.side(corners, it)).collect();
    faces.retain(|face| face.len() > 2);
    if faces.iter().any(|face| is_collapsed(face)) {
        return None;
    }
    let (triangles, quadrangles): (Vec<_>, Vec<_>) =
        faces.into_iter().partition(|face| face.len() == 3);
    match (triangles.as_slice(), quadrangles.as_slice()) {
        ([base, other, _, _], []) => with_apex(base, other),
        ([side, _, _, _], [base]) => with_apex(base, side),
        ([base, top], [_, _, _]) => prism(base, top, &quadrangles),
        _ => None,
    }
}

/// A tetrahedron or pyramid: its base, and the corner of another face that is not in the base.
fn with_apex<T: Copy + PartialEq>(base: &[T], other: &[T]) -> Option<Vec<T>> {
    let apex = other.iter().find(|corner| !base.contains(corner))?;
    let mut cell = base.to_vec();
    cell.push(*apex);
    Some(cell)
}

/// A prism: its base, and for each corner the one of the top that a quadrangle joins to it.
fn prism<T: Copy + PartialEq>(base: &[T], top: &[T], quadrangles: &[Vec<T>]) -> Option<Vec<T>> {
    let joined = |corner: T| {
        quadrangles.iter().find_map(|face| {
            let place = face.iter().position(|it| *it == corner)?;
            let beside = [1, 3].map(|step| face[(place + step) % 4]);
            beside.into_iter().find(|it| top.contains(it))
        })
    };
    let over: Option<Vec<T>> = base.iter().map(|corner| joined(*corner)).collect();
    let cell = [base.to_vec(), over?].concat();
    (!is_collapsed(&cell)).then_some(cell)
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
            assert!(!is_collapsed(&edges), "{shape:?}");
        }
    }

    #[test]
    fn elements_with_repeated_corners_are_the_cells_they_are() {
        let hexahedron = |corners: [u32; 8]| collapsed(Shape::Hexahedron, &corners);
        assert_eq!(
            hexahedron([1, 2, 3, 3, 5, 6, 7, 7]),
            Some(vec![1, 2, 3, 5, 6, 7])
        );
        assert_eq!(
            hexahedron([1, 2, 3, 4, 5, 5, 5, 5]),
            Some(vec![1, 2, 3, 4, 5])
        );
        assert_eq!(hexahedron([1, 2, 3, 3, 5, 5, 5, 5]), Some(vec![1, 2, 3, 5]));
        // An edge between the base and the top: the triangles are two of the sides.
        assert_eq!(
            hexahedron([1, 2, 3, 4, 1, 2, 7, 8]),
            Some(vec![2, 7, 3, 1, 8, 4])
        );
        assert_eq!(hexahedron([1, 2, 3, 4, 5, 6, 7, 7]), None);
        assert_eq!(hexahedron([1, 2, 3, 4, 1, 6, 3, 8]), None);
        let prism = |corners: [u32; 6]| collapsed(Shape::Prism, &corners);
        assert_eq!(prism([1, 2, 3, 4, 4, 4]), Some(vec![1, 2, 3, 4]));
        assert_eq!(prism([1, 2, 3, 1, 5, 6]), Some(vec![2, 5, 6, 3, 1]));
        assert_eq!(
            collapsed(Shape::Quadrangle, &[1, 2, 3, 3]),
            Some(vec![1, 2, 3])
        );
        assert_eq!(collapsed(Shape::Quadrangle, &[1, 2, 1, 4]), None);
        assert_eq!(collapsed(Shape::Triangle, &[1, 2, 2]), None);
        assert_eq!(collapsed(Shape::Tetrahedron, &[1, 2, 3, 3]), None);
    }
}
