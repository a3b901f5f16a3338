//! Element types of Gmsh.

/// Shape of an element.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Shape {
    Point,
    Edge,
    Triangle,
    Quadrangle,
    Tetrahedron,
    Hexahedron,
    Prism,
    Pyramid,
}

impl Shape {
    pub(super) fn corners(self) -> usize {
        match self {
            Shape::Point => 1,
            Shape::Edge => 2,
            Shape::Triangle => 3,
            Shape::Quadrangle | Shape::Tetrahedron => 4,
            Shape::Pyramid => 5,
            Shape::Prism => 6,
            Shape::Hexahedron => 8,
        }
    }

    pub(super) fn dimension(self) -> u8 {
        match self {
            Shape::Point => 0,
            Shape::Edge => 1,
            Shape::Triangle | Shape::Quadrangle => 2,
            Shape::Tetrahedron | Shape::Hexahedron | Shape::Prism | Shape::Pyramid => 3,
        }
    }

    /// Shape and number of nodes of a type number (`elm-type` in the manual, `MSH_*` in its sources); the corners come first.
    /// `None` for unknown types, or if the nodes do not include the corners.
    pub(super) fn from_code(code: i32) -> Option<(Self, usize)> {
        Some(match code {
            15 => (Shape::Point, 1),
            1 => (Shape::Edge, 2),
            8 => (Shape::Edge, 3),
            26..=28 => (Shape::Edge, [4, 5, 6][(code - 26) as usize]),
            62..=66 => (Shape::Edge, [7, 8, 9, 10, 11][(code - 62) as usize]),
            2 | 9 | 20..=25 | 42..=46 | 52..=56 => (Shape::Triangle, nodes_of_triangle(code)?),
            3 | 10 | 16 | 36..=41 | 47..=51 | 57..=61 => {
                (Shape::Quadrangle, nodes_of_quadrangle(code)?)
            }
            4 | 11 | 29..=33 | 71..=75 | 79..=83 | 137 => {
                (Shape::Tetrahedron, nodes_of_tetrahedron(code)?)
            }
            5 | 12 | 17 | 92..=105 => (Shape::Hexahedron, nodes_of_hexahedron(code)?),
            6 | 13 | 18 | 90..=91 | 106..=117 => (Shape::Prism, nodes_of_prism(code)?),
            7 | 14 | 19 | 118..=131 => (Shape::Pyramid, nodes_of_pyramid(code)?),
            _ => return None,
        })
    }
}

fn nodes_of_triangle(code: i32) -> Option<usize> {
    Some(match code {
        2 => 3,
        9 => 6,
        20..=25 => [9, 10, 12, 15, 15, 21][(code - 20) as usize],
        42..=46 => [28, 36, 45, 55, 66][(code - 42) as usize],
        52..=56 => [18, 21, 24, 27, 30][(code - 52) as usize],
        _ => return None,
    })
}

fn nodes_of_quadrangle(code: i32) -> Option<usize> {
    Some(match code {
        3 => 4,
        10 => 9,
        16 => 8,
        36..=41 => [16, 25, 36, 12, 16, 20][(code - 36) as usize],
        47..=51 => [49, 64, 81, 100, 121][(code - 47) as usize],
        57..=61 => [24, 28, 32, 36, 40][(code - 57) as usize],
        _ => return None,
    })
}

fn nodes_of_tetrahedron(code: i32) -> Option<usize> {
    Some(match code {
        4 => 4,
        11 => 10,
        29..=33 => [20, 35, 56, 22, 28][(code - 29) as usize],
        71..=75 => [84, 120, 165, 220, 286][(code - 71) as usize],
        79..=83 => [34, 40, 46, 52, 58][(code - 79) as usize],
        137 => 16,
        _ => return None,
    })
}

fn nodes_of_hexahedron(code: i32) -> Option<usize> {
    Some(match code {
        5 => 8,
        12 => 27,
        17 => 20,
        92..=98 => [64, 125, 216, 343, 512, 729, 1000][(code - 92) as usize],
        99..=105 => [32, 44, 56, 68, 80, 92, 104][(code - 99) as usize],
        _ => return None,
    })
}

fn nodes_of_prism(code: i32) -> Option<usize> {
    Some(match code {
        6 => 6,
        13 => 18,
        18 => 15,
        90..=91 => [40, 75][(code - 90) as usize],
        106..=110 => [126, 196, 288, 405, 550][(code - 106) as usize],
        111..=117 => [24, 33, 42, 51, 60, 69, 78][(code - 111) as usize],
        _ => return None,
    })
}

fn nodes_of_pyramid(code: i32) -> Option<usize> {
    Some(match code {
        7 => 5,
        14 => 14,
        19 => 13,
        118..=124 => [30, 55, 91, 140, 204, 285, 385][(code - 118) as usize],
        125..=131 => [21, 29, 37, 45, 53, 61, 69][(code - 125) as usize],
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Codes of a family, in the order of their polynomial degree from `degree` on.
    fn check(shape: Shape, codes: &[i32], degree: usize, nodes: impl Fn(usize) -> usize) {
        for (degree, code) in (degree..).zip(codes) {
            let expected = (shape, nodes(degree));
            assert_eq!(Shape::from_code(*code), Some(expected), "code {code}");
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
        let tetrahedra = [4, 11, 29, 30, 31, 71, 72, 73, 74, 75];
        check(Shape::Tetrahedron, &tetrahedra, 1, |p| {
            (p + 1) * (p + 2) * (p + 3) / 6
        });
        let hexahedra = [5, 12, 92, 93, 94, 95, 96, 97, 98];
        check(Shape::Hexahedron, &hexahedra, 1, |p| (p + 1).pow(3));
        let prisms = [6, 13, 90, 91, 106, 107, 108, 109, 110];
        check(Shape::Prism, &prisms, 1, |p| {
            (p + 1) * (p + 1) * (p + 2) / 2
        });
        let pyramids = [7, 14, 118, 119, 120, 121, 122, 123, 124];
        check(Shape::Pyramid, &pyramids, 1, |p| {
            (p + 1) * (p + 2) * (2 * p + 3) / 6
        });
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
        let on_edges = |corners: usize, edges: usize| move |p| corners + edges * (p - 1);
        check(Shape::Tetrahedron, &[137, 32, 33], 3, on_edges(4, 6));
        check(Shape::Tetrahedron, &[79, 80, 81, 82, 83], 6, on_edges(4, 6));
        let hexahedra = [17, 99, 100, 101, 102, 103, 104, 105];
        check(Shape::Hexahedron, &hexahedra, 2, on_edges(8, 12));
        let prisms = [18, 111, 112, 113, 114, 115, 116, 117];
        check(Shape::Prism, &prisms, 2, on_edges(6, 9));
        let pyramids = [19, 125, 126, 127, 128, 129, 130, 131];
        check(Shape::Pyramid, &pyramids, 2, on_edges(5, 8));
    }

    /// Cells of degree zero have one node in their middle, polyhedra any number.
    #[test]
    fn what_has_no_corners_is_unknown() {
        for code in [34, 35, 67, 70, 84, 87, 88, 89, 132, 133, 136, 141] {
            assert_eq!(Shape::from_code(code), None, "code {code}");
        }
        for code in [i32::MIN, -1, 0, i32::MAX] {
            assert_eq!(Shape::from_code(code), None, "code {code}");
        }
    }
}
