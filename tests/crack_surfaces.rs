//! Cracks of solids as surfaces: blocks of which a plane, a disk and a sphere are known.

#![allow(clippy::unwrap_used)]

use std::collections::HashSet;

use ligament_model::{BodyGrid, Canvas};
use ligament_post::surfaces::{CrackSurface, Link, Links, Tetrahedra, crack_surface, opened_cells};
use verification::solids::{block, boxes};

/// The surface where all edges that a function parts are cut; `pre` of them before the first load.
fn cut(
    body: &BodyGrid,
    parts: impl Fn([f64; 3], [f64; 3]) -> bool,
) -> (CrackSurface, Tetrahedra, Links) {
    let tetrahedra = Tetrahedra::new(body);
    let mut links = Links::default();
    let mut named = HashSet::new();
    for corners in &tetrahedra.corners {
        for (one, other) in [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)] {
            let [a, b] = [one, other].map(|it: usize| tetrahedra.points[corners[it] as usize]);
            let [p, q] = [a, b].map(|it| body.positions[it as usize]);
            if parts(p, q) {
                links.name([a, b], Link::Open);
                named.insert([a.min(b), a.max(b)]);
            }
        }
    }
    let near = tetrahedra.with_edges(|pair| named.contains(&pair));
    (crack_surface(&near, &links), near, links)
}

fn across(normal: [f64; 3], at: f64) -> impl Fn([f64; 3], [f64; 3]) -> bool {
    move |p, q| {
        let side = |it: [f64; 3]| (0..3).map(|axis| normal[axis] * it[axis]).sum::<f64>() > at;
        side(p) != side(q)
    }
}

/// Between layers of a lattice, and of cells: the area is that of the section to rounding, flat, and reaches the outside.
#[test]
fn a_plane_between_layers_has_the_area_of_the_section() {
    for body in [block([12, 10, 8], 0.0), boxes([12, 10, 8])] {
        for (normal, at, area) in [([0.0, 0.0, 1.0], 4.2, 120.0), ([1.0, 0.0, 0.0], 6.2, 80.0)] {
            let (surface, ..) = cut(&body, across(normal, at));
            let surface = surface.smoothed();
            assert!((surface.area() - area).abs() < 1e-12 * area);
            let parts = surface.parts();
            assert_eq!(parts.len(), 1);
            let plane = surface.best_plane().unwrap();
            let turned = (0..3).map(|axis| (plane.normal[axis] - normal[axis]).abs());
            assert!(plane.largest_distance < 1e-13 && turned.sum::<f64>() < 1e-12);
            let [low, high] = parts[0].extent;
            let full = (0..3)
                .filter(|axis| (high[*axis] - low[*axis] - [12.0, 10.0, 8.0][*axis]).abs() < 1e-12);
            assert_eq!(full.count(), 2);
        }
    }
}

/// Askew to the cells, in moved ones, and through a layer of points that lie on both sides of the plane at random: one part, whose
/// area is that of the section within 2.5 % and which lies within a cell of it. The sections of the box 12 x 10 x 8: 0.6 y + 0.8 z =
/// 6.9 from (y, z) = (0.833, 8) to (10, 1.125), 12 wide; x + y + z = 14.7 over the part of 12 x 10 where x + y is from 6.7 to 14.7.
#[test]
fn a_plane_through_cells_has_the_area_of_the_section() {
    let askew = 12.0 * (10.0_f64 - 5.0 / 6.0).hypot(8.0 - 1.125);
    let corner = 3.0_f64.sqrt() * (120.0 - 0.5 * 6.7 * 6.7 - 0.5 * 7.3 * 7.3);
    for body in [block([12, 10, 8], 0.0), block([12, 10, 8], 0.3)] {
        for (normal, at, area) in [
            ([0.0, 0.0, 1.0], 4.0, 120.0),
            ([0.0, 0.6, 0.8], 6.9, askew),
            ([1.0, 1.0, 1.0], 14.7, corner),
        ] {
            let (surface, ..) = cut(&body, across(normal, at));
            let surface = surface.smoothed();
            let ratio = surface.area() / area;
            assert!((ratio - 1.0).abs() < 0.025, "{normal:?}: {ratio}");
            assert_eq!(surface.parts().len(), 1, "{normal:?}");
            let away = surface.best_plane().unwrap().largest_distance;
            assert!(away < 1.0, "{normal:?}: {away}");
        }
    }
}

/// A disk inside the block: one part with a rim, of the area of the disk within the ring of a third of a cell.
#[test]
fn a_disk_inside_has_its_area() {
    let radius = 3.7;
    let body = block([14, 14, 8], 0.2);
    let (surface, ..) = cut(&body, |p, q| {
        let [above, below] = if p[2] > q[2] { [p, q] } else { [q, p] };
        if above[2] <= 4.5 || below[2] > 4.5 {
            return false;
        }
        let share = (4.5 - below[2]) / (above[2] - below[2]);
        let at = [0, 1].map(|axis| below[axis] + share * (above[axis] - below[axis]) - 7.0);
        at[0].hypot(at[1]) < radius
    });
    let surface = surface.smoothed();
    let found = (surface.area() / std::f64::consts::PI).sqrt();
    assert!((found - radius).abs() < 0.34, "{found}");
    assert_eq!(surface.parts().len(), 1);
}

/// A layer of points without any bond is no second surface, and one point without any is no surface at all.
#[test]
fn points_without_bonds_are_counted_to_a_side() {
    let body = block([6, 6, 6], 0.0);
    let (surface, ..) = cut(&body, |p, q| p[2] == 3.0 || q[2] == 3.0);
    assert_eq!(surface.parts().len(), 1);
    assert!((surface.area() - 36.0).abs() < 1e-12);
    let loose = [3.0; 3];
    let (surface, ..) = cut(&body, |p, q| p == loose || q == loose);
    assert!(surface.triangles.is_empty());
}

/// What a pre-crack cut is no area that grew, and is connected with what grew from it.
#[test]
fn a_precrack_is_told_apart() {
    let body = block([10, 4, 4], 0.0);
    let (_, near, open) = cut(&body, across([0.0, 0.0, 1.0], 2.5));
    let mut links = Links::default();
    for corners in &near.corners {
        for (one, other) in [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)] {
            let pair = [one, other].map(|it: usize| corners[it]);
            let middle =
                0.5 * (body.positions[pair[0] as usize][0] + body.positions[pair[1] as usize][0]);
            match open.between(pair) {
                Link::Open if middle < 4.25 => links.name(pair, Link::PreCrack),
                other => links.name(pair, other),
            }
        }
    }
    let surface = crack_surface(&near, &links);
    let parts = surface.parts();
    assert_eq!(parts.len(), 1);
    assert!((parts[0].area + parts[0].precrack - 40.0).abs() < 1e-12);
    assert!(
        (parts[0].precrack - 16.0).abs() < 2.01,
        "{}",
        parts[0].precrack
    );
}

/// The pieces of cut cells fill the body, and the crack parts their corners: above it they follow points above it alone.
#[test]
fn cells_open_along_the_surface() {
    let body = block([6, 5, 4], 0.3);
    let normal = [0.2, 0.1, 1.0];
    let above = |p: [f64; 3]| normal[0] * p[0] + normal[1] * p[1] + p[2] > 2.9;
    let (_, near, links) = cut(&body, |p, q| above(p) != above(q));
    let Canvas::Solid(cells) = &body.canvas else {
        panic!("cells")
    };
    let opened = opened_cells((&body.positions, cells), &near, &links);
    let volume: f64 = opened
        .cells
        .iter()
        .map(|it| it.volume(&opened.positions))
        .sum();
    assert!(
        (volume - 120.0).abs() < 0.02,
        "{volume}: faces of moved hexahedra are not flat"
    );
    let mut sides = [0, 0];
    for cell in &opened.cells {
        let points = cell
            .corners()
            .iter()
            .flat_map(|it| &opened.follows[*it as usize]);
        let of: HashSet<bool> = points
            .map(|it| above(body.positions[*it as usize]))
            .collect();
        assert_eq!(of.len(), 1);
        sides[usize::from(of.contains(&true))] += 1;
    }
    assert!(sides.iter().all(|it| *it > 100), "{sides:?}");
}
