//! The element types of Gmsh.

/// Shape of an element of a planar mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Shape {
    Point,
    Edge,
    Triangle,
    Quadrangle,
}

impl Shape {
    pub(super) fn corners(self) -> usize {
        match self {
            Shape::Point => 1,
            Shape::Edge => 2,
            Shape::Triangle => 3,
            Shape::Quadrangle => 4,
        }
    }

    pub(super) fn dimension(self) -> u8 {
        match self {
            Shape::Point => 0,
            Shape::Edge => 1,
            Shape::Triangle | Shape::Quadrangle => 2,
        }
    }
}

/// What a type number stands for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ElementType {
    /// An element of a shape, with this number of nodes: its corners come first.
    Planar(Shape, usize),
    /// An element of dimension 3.
    Volume,
}

impl ElementType {
    /// The type of a number (`elm-type` in the manual, `MSH_*` in its sources); none if unknown.
    pub(super) fn from_code(code: i32) -> Option<Self> {
        let (shape, nodes) = match code {
            15 => (Shape::Point, 1),
            1 => (Shape::Edge, 2),
            8 => (Shape::Edge, 3),
            26..=28 => (Shape::Edge, [4, 5, 6][(code - 26) as usize]),
            62..=66 => (Shape::Edge, [7, 8, 9, 10, 11][(code - 62) as usize]),
            2 => (Shape::Triangle, 3),
            9 => (Shape::Triangle, 6),
            20..=25 => (
                Shape::Triangle,
                [9, 10, 12, 15, 15, 21][(code - 20) as usize],
            ),
            42..=46 => (Shape::Triangle, [28, 36, 45, 55, 66][(code - 42) as usize]),
            52..=56 => (Shape::Triangle, [18, 21, 24, 27, 30][(code - 52) as usize]),
            3 => (Shape::Quadrangle, 4),
            10 => (Shape::Quadrangle, 9),
            16 => (Shape::Quadrangle, 8),
            36..=41 => (
                Shape::Quadrangle,
                [16, 25, 36, 12, 16, 20][(code - 36) as usize],
            ),
            47..=51 => (
                Shape::Quadrangle,
                [49, 64, 81, 100, 121][(code - 47) as usize],
            ),
            57..=61 => (
                Shape::Quadrangle,
                [24, 28, 32, 36, 40][(code - 57) as usize],
            ),
            4..=7 | 11..=14 | 17..=19 | 29..=33 | 35 | 71..=75 | 79..=83 | 87..=132 | 137 => {
                return Some(Self::Volume);
            }
            _ => return None,
        };
        Some(Self::Planar(shape, nodes))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Codes of a family, in the order of their polynomial degree from `degree` on.
    fn check(shape: Shape, codes: &[i32], degree: usize, nodes: impl Fn(usize) -> usize) {
        for (degree, code) in (degree..).zip(codes) {
            let expected = ElementType::Planar(shape, nodes(degree));
            assert_eq!(ElementType::from_code(*code), Some(expected), "code {code}");
        }
    }

    #[test]
    fn complete_elements_have_the_nodes_of_their_degree() {
        check(
            Shape::Edge,
            &[1, 8, 26, 27, 28, 62, 63, 64, 65, 66],
            1,
            |p| p + 1,
        );
        let triangles = [2, 9, 21, 23, 25, 42, 43, 44, 45, 46];
        check(Shape::Triangle, &triangles, 1, |p| (p + 1) * (p + 2) / 2);
        let quadrangles = [3, 10, 36, 37, 38, 47, 48, 49, 50, 51];
        check(Shape::Quadrangle, &quadrangles, 1, |p| (p + 1) * (p + 1));
    }

    #[test]
    fn incomplete_elements_have_nodes_on_their_sides_only() {
        check(Shape::Triangle, &[20, 22, 24, 52, 53, 54, 55, 56], 3, |p| {
            3 * p
        });
        check(
            Shape::Quadrangle,
            &[16, 39, 40, 41, 57, 58, 59, 60, 61],
            2,
            |p| 4 * p,
        );
    }

    #[test]
    fn volumes_and_unknown_types_are_told_apart() {
        for code in [4, 5, 6, 7, 11, 17, 29, 71, 92, 137] {
            assert_eq!(
                ElementType::from_code(code),
                Some(ElementType::Volume),
                "code {code}"
            );
        }
        for code in [i32::MIN, -1, 0, 34, 67, 70, 84, 133, 141, i32::MAX] {
            assert_eq!(ElementType::from_code(code), None, "code {code}");
        }
    }
}
