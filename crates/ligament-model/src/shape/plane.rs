//! Shapes in the plane.

use super::Region;
use crate::geometry::{bounding_box, distance_to, nearest_place, point_at};
use crate::predicates::{left, meet, orientation};
use crate::tensor::{dot, minus, norm};

/// A closed region of the plane.
#[derive(Debug, Clone, PartialEq)]
pub enum Shape {
    /// A disk.
    Circle {
        /// Centre, m.
        centre: [f64; 2],
        /// Radius, m.
        radius: f64,
    },
    /// Exterior of a disk.
    Outside {
        /// Centre of the disk, m.
        centre: [f64; 2],
        /// Radius of the disk, m.
        radius: f64,
    },
    /// Interior of a closed polygon that does not cross itself, with three corners or more, m.
    Polygon(Vec<[f64; 2]>),
}

impl Region<2> for Shape {
    fn moved(&self, by: [f64; 2]) -> Self {
        let move_point = |p: &[f64; 2]| [p[0] + by[0], p[1] + by[1]];
        match self {
            Self::Circle { centre, radius } => Self::Circle {
                centre: move_point(centre),
                radius: *radius,
            },
            Self::Outside { centre, radius } => Self::Outside {
                centre: move_point(centre),
                radius: *radius,
            },
            Self::Polygon(corners) => Self::Polygon(corners.iter().map(move_point).collect()),
        }
    }

    fn contains(&self, point: [f64; 2], slack: f64) -> bool {
        self.depth(point) >= -slack
    }

    fn is_crossed_by(&self, a: [f64; 2], b: [f64; 2], slack: f64) -> bool {
        match self {
            Self::Circle { centre, radius } => distance_to([a, b], *centre) < radius - slack,
            // A disk is convex: a line between two points in it stays in it.
            Self::Outside { .. } => self.depth(a).max(self.depth(b)) > slack,
            Self::Polygon(corners) => {
                let [lower, upper] = bounding_box(corners.iter().copied());
                let misses = (0..2).any(|axis| {
                    a[axis].max(b[axis]) <= lower[axis] || a[axis].min(b[axis]) >= upper[axis]
                });
                !misses && self.is_crossed_near(corners, a, b, slack)
            }
        }
    }
}

impl Shape {
    /// The rectangle between two opposite corners.
    pub fn rectangle([a, b]: [[f64; 2]; 2]) -> Self {
        Self::Polygon(vec![a, [b[0], a[1]], b, [a[0], b[1]]])
    }

    /// Whether a segment lies deeper than `slack` inside the shape at a place; between crossings of sides and corners the middle is at least half as
    /// deep as any other place.
    fn is_crossed_near(&self, corners: &[[f64; 2]], a: [f64; 2], b: [f64; 2], slack: f64) -> bool {
        let mut places = vec![0.0, 1.0];
        for [p, q] in sides(corners) {
            places.push(nearest_place([a, b], p));
            let (from, to) = (left(p, q, a), left(p, q, b));
            if (from < 0.0) != (to < 0.0) {
                places.push((from / (from - to)).clamp(0.0, 1.0));
            }
        }
        places.sort_by(f64::total_cmp);
        places
            .windows(2)
            .any(|piece| self.depth(point_at([a, b], 0.5 * (piece[0] + piece[1]))) > slack)
    }

    /// Distance of a point to the rim, m; negative outside.
    fn depth(&self, point: [f64; 2]) -> f64 {
        match self {
            Self::Circle { centre, radius } => radius - norm(minus(point, *centre)),
            Self::Outside { centre, radius } => norm(minus(point, *centre)) - radius,
            Self::Polygon(corners) => {
                let to_sides = sides(corners).map(|side| distance_to(side, point));
                let to_rim = to_sides.fold(f64::INFINITY, f64::min);
                if is_inside(corners, point) {
                    to_rim
                } else {
                    -to_rim
                }
            }
        }
    }
}

/// Whether two non-adjacent sides of a closed polygon intersect, or adjacent ones overlap; an exact test.
pub fn crosses_itself(corners: &[[f64; 2]]) -> bool {
    let sides: Vec<[[f64; 2]; 2]> = sides(corners).collect();
    let last = sides.len() - 1;
    (0..sides.len()).any(|first| {
        (first + 1..sides.len()).any(|second| {
            let ([p, q], [r, s]) = (sides[first], sides[second]);
            if second == first + 1 {
                turns_back(p, q, s)
            } else if first == 0 && second == last {
                turns_back(r, s, q)
            } else {
                meet([p, q], [r, s])
            }
        })
    })
}

/// Whether the path from p via q to r turns back on itself.
fn turns_back(p: [f64; 2], q: [f64; 2], r: [f64; 2]) -> bool {
    orientation(p, q, r) == 0.0 && dot(minus(q, p), minus(r, q)) <= 0.0
}

/// Whether a ray to the right crosses an odd number of sides.
fn is_inside(corners: &[[f64; 2]], point: [f64; 2]) -> bool {
    let crossed = sides(corners).filter(|&[p, q]| {
        let [lower, upper] = if p[1] <= q[1] { [p, q] } else { [q, p] };
        lower[1] <= point[1] && point[1] < upper[1] && left(lower, upper, point) > 0.0
    });
    crossed.count() % 2 == 1
}

fn sides(corners: &[[f64; 2]]) -> impl Iterator<Item = [[f64; 2]; 2]> {
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).map(|(&p, &q)| [p, q])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An L: the square of side 2 without its upper right quarter.
    fn corner() -> Shape {
        Shape::Polygon(vec![
            [0.0, 0.0],
            [2.0, 0.0],
            [2.0, 1.0],
            [1.0, 1.0],
            [1.0, 2.0],
            [0.0, 2.0],
        ])
    }

    #[test]
    fn the_rim_belongs_to_a_shape() {
        let circle = Shape::Circle {
            centre: [1.0, 0.0],
            radius: 2.0,
        };
        assert!(circle.contains([3.0, 0.0], 0.0) && !circle.contains([3.1, 0.0], 0.0));
        assert!(circle.contains([3.1, 0.0], 0.11), "within the slack");
        for (point, is_in) in [
            ([0.0, 0.0], true),
            ([1.0, 1.5], true),
            ([0.5, 2.0], true),
            ([1.5, 1.5], false),
            ([1.5, 1.0], true),
            ([-0.1, 1.0], false),
            ([2.5, 0.0], false),
        ] {
            assert_eq!(corner().contains(point, 0.0), is_in, "{point:?}");
        }
        assert!(corner().contains([1.0 + 1e-10, 1.5], 1e-9));
    }

    #[test]
    fn a_line_along_the_rim_does_not_cross() {
        let crosses = |a, b| corner().is_crossed_by(a, b, 1e-9);
        assert!(!crosses([-1.0, 0.0], [3.0, 0.0]), "along the lower side");
        assert!(!crosses([1.0, 1.0], [1.0, 3.0]), "along the inner side");
        assert!(crosses([1.0, -1.0], [1.0, 3.0]), "through the lower half");
        assert!(!crosses([1.0, 3.0], [3.0, 1.0]), "past the inner corner");
        assert!(!crosses([2.0, 2.0], [1.0, 1.0]), "up to the inner corner");
        assert!(crosses([2.0, 2.0], [0.9, 0.9]) && crosses([0.1, 0.1], [0.2, 0.3]));
        // From end to end of the L, through its inner corner.
        assert!(crosses([0.0, 2.0], [2.0, 0.0]));
        let circle = Shape::Circle {
            centre: [0.0, 0.0],
            radius: 1.0,
        };
        assert!(
            !circle.is_crossed_by([-2.0, 1.0], [2.0, 1.0], 1e-9),
            "a tangent"
        );
        assert!(circle.is_crossed_by([-2.0, 0.999], [2.0, 0.999], 1e-9));
        assert!(
            !circle.is_crossed_by([1.5, 0.0], [3.0, 0.0], 1e-9),
            "the line is not endless"
        );
    }

    /// A line crosses where one of many points along it lies inside. The points miss what is shorter than their distance:
    /// there the line comes close to the shape.
    #[test]
    fn crossings_agree_with_points_along_the_line() {
        let places: Vec<[f64; 2]> = (-2..=6)
            .flat_map(|i| (-2..=6).map(move |j| [f64::from(i) * 0.57 - 0.01, f64::from(j) * 0.51]))
            .collect();
        let mut crossed = 0;
        for &a in &places {
            for &b in &places {
                let depths =
                    (0..=400).map(|k| corner().depth(point_at([a, b], f64::from(k) / 400.0)));
                let deepest = depths.fold(f64::NEG_INFINITY, f64::max);
                let found = corner().is_crossed_by(a, b, 1e-9);
                let near = if found { -0.02 } else { 1e-9 };
                assert!(found == (deepest > near), "{a:?} {b:?} {deepest}");
                crossed += usize::from(found);
            }
        }
        assert!(crossed > 1000 && crossed < places.len().pow(2) - 1000);
    }

    #[test]
    fn polygons_that_cross_themselves_are_noticed() {
        assert!(!crosses_itself(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]));
        let Shape::Polygon(corners) = corner() else {
            unreachable!("the corner is a polygon")
        };
        assert!(!crosses_itself(&corners));
        let bow_tie = [[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]];
        assert!(crosses_itself(&bow_tie));
        assert!(
            crosses_itself(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]]),
            "flat"
        );
        let touching = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [1.0, 0.0], [0.0, 2.0]];
        assert!(crosses_itself(&touching));
    }
}
