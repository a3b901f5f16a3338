//! Curved outlines of planar meshes.

use std::f64::consts::{FRAC_PI_2, TAU};

use super::{bisect_to, planar};
use crate::bisection::Bisection;
use crate::cell::Cell;
use crate::mesh::Mesh;

fn on_circle(radius: f64, angle: f64) -> [f64; 2] {
    [radius * angle.cos(), radius * angle.sin()]
}

/// A ring between two polygons of an even number n of sides, every second node nearer to the next one by a share of a regular side.
fn ring(n: u32, [inner, outer]: [f64; 2], share: f64) -> Mesh {
    let angles = (0..n).map(|it| TAU * (f64::from(it) + share * f64::from(it % 2)) / f64::from(n));
    let circle = |radius| angles.clone().map(move |angle| on_circle(radius, angle));
    let positions = circle(inner).chain(circle(outer)).collect();
    let cell = |a: u32| {
        let b = (a + 1) % n;
        Cell::Quadrangle([b, a, n + a, n + b])
    };
    planar(positions, (0..n).map(cell).collect())
}

/// Triangles between the centre of a body and its outline.
fn fan(mut outline: Vec<[f64; 2]>, centre: [f64; 2]) -> Mesh {
    let n = outline.len() as u32;
    outline.push(centre);
    let cell = |a: u32| Cell::Triangle([a, (a + 1) % n, n]);
    planar(outline, (0..n).map(cell).collect())
}

/// Largest distance between the nodes of the outline of a ring and its circles, relative to their radii.
fn error(mesh: &Mesh, [inner, outer]: [f64; 2]) -> f64 {
    let nodes = mesh.outline().into_iter().map(|[node, _]| node);
    let radii = nodes.map(|node| {
        let [x, y] = mesh.positions[node as usize];
        x.hypot(y)
    });
    let off = |radius: f64| {
        (radius / inner - 1.0)
            .abs()
            .min((radius / outer - 1.0).abs())
    };
    radii.map(off).fold(0.0, f64::max)
}

/// Circles of 12 and 24 edges, whose chords are off by 1 - cos(pi/n), 3.4e-2 and 8.6e-3: exact at the middles, then as measured,
/// with an order of four in the angle. Bounds are the measured errors, rounded up.
#[test]
fn nodes_on_circles_stay_on_circles() {
    let radii = [1.0, 3.0];
    for (n, second, third) in [(12, 1.1e-4, 1.5e-4), (24, 6.9e-6, 9.1e-6)] {
        let mesh = ring(n, radii, 0.0);
        let mut bisection = Bisection::new(&mesh).unwrap();
        for (generation, bound) in [(2, 4e-16), (4, second), (6, third)] {
            bisect_to(&mut bisection, generation);
            let refined = bisection.mesh();
            let error = error(&refined, radii);
            assert!(error < bound, "{n} {generation} {error:e}");
            let outline = refined.groups[1].edges.len() as u32;
            assert_eq!(outline, (2 * n) << (generation / 2));
        }
        let area = 0.5 * TAU * (radii[1].powi(2) - radii[0].powi(2));
        // Polygons of 8 n sides with their nodes on the circles, but for the largest error.
        let sides = f64::from(8 * n);
        let expected = area * (TAU / sides).sin() / (TAU / sides);
        assert!((bisection.mesh().area() / expected - 1.0).abs() < 2.0 * third);
    }
}

/// Sides of 1.2 and 0.8 in turn: the circle through three nodes has a tangent that is nearer to the shorter side.
#[test]
fn middles_are_exact_on_an_uneven_circle() {
    let mesh = ring(16, [1.0, 3.0], 0.2);
    let mut bisection = Bisection::new(&mesh).unwrap();
    bisect_to(&mut bisection, 2);
    assert!(error(&bisection.mesh(), [1.0, 3.0]) < 1e-15);
}

/// Sides in three and seven edges whose nodes are off by 1e-7 to the outside, as in a file with seven digits.
#[test]
fn straight_sides_stay_straight() {
    let corners = [[0.0, 0.0], [0.9, 0.3], [0.7, 1.1], [-0.2, 0.8]];
    let centre = [0.35, 0.55];
    for n in [3, 7] {
        let mut outline = Vec::new();
        for (place, from) in corners.into_iter().enumerate() {
            let to = corners[(place + 1) % 4];
            outline.extend((0..n).map(|step| {
                let u = f64::from(step) / f64::from(n);
                let off = if step == 0 { 0.0 } else { 1e-7 };
                [0, 1].map(|axis| {
                    let on_side = from[axis] + u * (to[axis] - from[axis]);
                    on_side + off * (on_side - centre[axis])
                })
            }));
        }
        let bisection = Bisection::new(&fan(outline, centre)).unwrap();
        assert!(bisection.curves.is_empty());
    }
}

/// A hexagon, whose corners turn by 60 degrees: nodes at the means of neighbours, to the bit.
#[test]
fn corners_stay_corners() {
    let hexagon = (0..6).map(|it| on_circle(1.0, TAU * f64::from(it) / 6.0));
    let mut bisection = Bisection::new(&fan(hexagon.collect(), [0.0; 2])).unwrap();
    bisect_to(&mut bisection, 4);
    for (&edge, &middle) in &bisection.middles {
        let [p, q] = edge.map(|node| bisection.positions()[node as usize]);
        let mean = [0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1])];
        assert_eq!(bisection.positions()[middle as usize], mean);
    }
}

/// A square of side 4 whose corners are rounded by arcs of radius 1 in six edges: the four inner edges of each arc are curved, the first
/// and the last one beside the straight sides are not, and neither are the sides.
#[test]
fn fillets_are_curved_between_straight_sides() {
    let mut outline = Vec::new();
    for (quarter, [x, y]) in (0..4).zip([[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]]) {
        for step in 0..=6 {
            let angle = FRAC_PI_2 * (f64::from(quarter) + f64::from(step) / 6.0);
            let [dx, dy] = on_circle(1.0, angle);
            outline.push([x + dx, y + dy]);
        }
        // Two more nodes on the side that follows.
        let [xa, ya] = outline[outline.len() - 1];
        let turn = FRAC_PI_2 * f64::from(quarter + 2);
        for step in [0.7, 1.4] {
            let [dx, dy] = on_circle(step, turn);
            outline.push([xa + dx, ya + dy]);
        }
    }
    let bisection = Bisection::new(&fan(outline, [0.0; 2])).unwrap();
    let curved: Vec<[u32; 2]> = bisection.curves.keys().copied().collect();
    let expected =
        (0..4).flat_map(|quarter| (1..5).map(move |it| [9 * quarter + it, 9 * quarter + it + 1]));
    assert_eq!(curved, expected.collect::<Vec<_>>());
}

/// A square of side 4 with one corner rounded. With straight sides of one edge each, the angles at their ends tell: 7.5 and 15 degrees. With
/// uneven angles along the arc, at first 10 and 17.5 degrees, the straight side before it tells.
#[test]
fn the_first_edge_of_an_arc_is_straight() {
    for (sides, angles) in [
        (vec![], [0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 90.0]),
        (vec![-1.0, 0.0], [0.0, 20.0, 35.0, 45.0, 55.0, 70.0, 90.0]),
    ] {
        let mut outline = vec![[-2.0, -2.0], [2.0, -2.0]];
        outline.extend(sides.iter().map(|&y| [2.0, y]));
        let first = outline.len() as u32;
        outline.extend(angles.iter().map(|angle: &f64| {
            let [x, y] = on_circle(1.0, angle.to_radians());
            [1.0 + x, 1.0 + y]
        }));
        outline.extend(sides.iter().rev().map(|&x| [x, 2.0]));
        outline.push([-2.0, 2.0]);
        let bisection = Bisection::new(&fan(outline, [0.0; 2])).unwrap();
        let curved: Vec<[u32; 2]> = bisection.curves.keys().copied().collect();
        let expected = (first + 1..first + 5).map(|it| [it, it + 1]);
        assert_eq!(curved, expected.collect::<Vec<_>>());
    }
}

/// A ring thinner than the arc over an edge of the inner polygon: the middle would leave its cell there, so it stays on the straight edge.
#[test]
fn a_middle_stays_straight_where_its_cells_would_turn_over() {
    let arc = 1.0 - (TAU / 24.0).cos();
    let radii = [1.0, 1.0 + 0.5 * arc];
    let mesh = ring(12, radii, 0.0);
    let mut bisection = Bisection::new(&mesh).unwrap();
    bisect_to(&mut bisection, 4);
    let refined = bisection.mesh();
    assert!(
        refined
            .cells
            .iter()
            .all(|cell| cell.area(&refined.positions) > 0.0)
    );
    let middle = bisection.positions()[bisection.middles[&[0, 1]] as usize];
    assert!((middle[0].hypot(middle[1]) - 1.0 + arc).abs() < 1e-15);
    let middle = bisection.positions()[bisection.middles[&[12, 13]] as usize];
    assert!((middle[0].hypot(middle[1]) / radii[1] - 1.0).abs() < 1e-15);
}
