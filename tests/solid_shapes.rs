//! Shapes of the holes and sets of a solid: what lies in them, and which lines cross them.

use ligament_model::shape::{Region, SolidShape};

fn shapes() -> [SolidShape; 5] {
    let axis = [[0.2, -0.4, 0.1], [0.5, 0.6, 0.9]];
    [
        SolidShape::Sphere {
            centre: [0.1, 0.2, -0.1],
            radius: 0.8,
        },
        SolidShape::OutsideSphere {
            centre: [0.1, 0.2, -0.1],
            radius: 1.1,
        },
        SolidShape::Cylinder {
            ends: axis,
            radius: 0.5,
        },
        SolidShape::OutsideCylinder { axis, radius: 0.9 },
        SolidShape::between([[0.5, -0.7, 0.4], [-0.6, 0.3, -0.2]]),
    ]
}

/// A line crosses a shape where one of many points along it lies in it: sampled, without any root.
#[test]
fn crossings_agree_with_points_along_the_line() {
    let coordinates = [-1.13, -0.52, 0.03, 0.61, 1.2];
    let places: Vec<[f64; 3]> = (0..125)
        .map(|k: usize| {
            [
                coordinates[k % 5],
                coordinates[k / 5 % 5],
                coordinates[k / 25],
            ]
        })
        .collect();
    for shape in shapes() {
        let (mut crossed, mut unclear) = (0, 0);
        for &a in &places {
            for &b in &places {
                let point = |k: u32| {
                    let t = f64::from(k) / 200.0;
                    [0, 1, 2].map(|axis| a[axis] + t * (b[axis] - a[axis]))
                };
                // Points up to 0.014 apart may miss a piece inside, but come nearer to it than half of that.
                let depth = |slack: f64| (0..=200).any(|k| shape.contains(point(k), slack));
                let found = shape.is_crossed_by(a, b, 1e-9);
                if depth(-1e-3) {
                    assert!(found, "{shape:?} {a:?} {b:?}");
                } else if !depth(1e-2) {
                    assert!(!found, "{shape:?} {a:?} {b:?}");
                } else {
                    unclear += 1;
                }
                crossed += usize::from(found);
            }
        }
        let all = places.len().pow(2);
        assert!(
            crossed > 500 && crossed < all - 500 && unclear < 1500,
            "{shape:?} {crossed} {unclear}"
        );
    }
}

#[test]
fn a_line_along_the_surface_does_not_cross() {
    let brick = SolidShape::between([[0.0; 3], [1.0; 3]]);
    assert!(
        !brick.is_crossed_by([-1.0, 1.0, 0.5], [2.0, 1.0, 0.5], 1e-9),
        "along a face"
    );
    assert!(
        !brick.is_crossed_by([-1.0, 2.0, 0.5], [2.0, -1.0, 0.5 + 3.0], 1e-9),
        "past it"
    );
    assert!(brick.is_crossed_by([-1.0, 0.5, 0.5], [0.5, 0.5, 0.5], 1e-9));
    let tube = SolidShape::Cylinder {
        ends: [[0.0; 3], [0.0, 0.0, 2.0]],
        radius: 1.0,
    };
    assert!(
        !tube.is_crossed_by([1.0, -3.0, 1.0], [1.0, 3.0, 1.0], 1e-9),
        "a tangent"
    );
    assert!(
        !tube.is_crossed_by([0.5, 0.0, 2.0], [0.0, 0.5, 2.0], 1e-9),
        "along its end"
    );
    assert!(
        !tube.is_crossed_by([1.0, 0.0, -1.0], [1.0, 0.0, 3.0], 1e-9),
        "along its side"
    );
    assert!(tube.is_crossed_by([0.3, 0.0, -1.0], [0.3, 0.0, 3.0], 1e-9));
    assert!(
        !tube.is_crossed_by([0.3, 0.0, 2.5], [0.3, 0.0, 3.0], 1e-9),
        "the line is not endless"
    );
}

#[test]
fn surfaces_belong_to_shapes_and_move_with_them() {
    for shape in shapes() {
        let moved = shape.moved([3.0, -1.0, 2.0]);
        for k in 0..1000 {
            let p = [k % 10, k / 10 % 10, k / 100].map(|it: u32| -1.3 + 0.28 * f64::from(it));
            let q = [p[0] + 3.0, p[1] - 1.0, p[2] + 2.0];
            assert_eq!(shape.contains(p, 1e-9), moved.contains(q, 1e-9));
        }
    }
    let ball = SolidShape::Sphere {
        centre: [0.0; 3],
        radius: 2.0,
    };
    let rest = SolidShape::OutsideSphere {
        centre: [0.0; 3],
        radius: 2.0,
    };
    for shape in [ball, rest] {
        assert!(shape.contains([0.0, 2.0, 0.0], 0.0), "{shape:?}");
    }
}
