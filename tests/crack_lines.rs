//! Cracks as lines, against curves along which bodies were cut.
//!
//! ```text
//!  curve  ─────────╮        faces between points on its two sides are open;
//!                  │        the line found follows the curve to a cell, its length to some per cent
//! ```
//!
//! Bodies: the irregular mesh of the Brazilian disk (diameter 0.1 m, elements of about 2 mm) and a square lattice of 2 mm. The
//! horizon is 6 mm.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

use std::f64::consts::PI;

use ligament_model::Canvas;
use ligament_post::crack::{CrackEnd, CrackLine, FaceState, Faces, crack_lines};
use verification::{meshes, repository};

const SPACING: f64 = 2e-3;
const HORIZON: f64 = 3.0 * SPACING;

type Curve = Vec<[f64; 2]>;

/// Points with the faces between their cells.
struct Body {
    positions: Vec<[f64; 2]>,
    faces: Faces,
}

fn disk() -> Body {
    let mesh = meshes::read(repository().join("meshes/disk-2mm.msh"));
    let faces = Faces::new(&mesh.positions, &Canvas::Between(mesh.cells));
    let positions = mesh.positions;
    Body { positions, faces }
}

fn lattice() -> Body {
    let half = 0.5 * SPACING;
    // No row lies on an axis, so that curves through the middle run between rows.
    let at = |k: i32| SPACING * (f64::from(k) - 24.5);
    let positions: Vec<[f64; 2]> = (0..50 * 50).map(|k| [at(k % 50), at(k / 50)]).collect();
    let square = |[x, y]: &[f64; 2]| {
        [[-half, -half], [half, -half], [half, half], [-half, half]]
            .map(|[dx, dy]| [x + dx, y + dy])
    };
    let squares = positions.iter().map(square).collect();
    let faces = Faces::new(&positions, &Canvas::Around(squares));
    Body { positions, faces }
}

fn side([a, b]: [[f64; 2]; 2], c: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

fn cross(one: [[f64; 2]; 2], other: [[f64; 2]; 2]) -> bool {
    side(one, other[0]) * side(one, other[1]) < 0.0
        && side(other, one[0]) * side(other, one[1]) < 0.0
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

/// Distance of a place from a curve.
fn off(at: [f64; 2], curve: &Curve) -> f64 {
    let pieces = curve.windows(2).map(|pair| {
        let along = [pair[1][0] - pair[0][0], pair[1][1] - pair[0][1]];
        let from = [at[0] - pair[0][0], at[1] - pair[0][1]];
        let squared = along[0] * along[0] + along[1] * along[1];
        let share = ((from[0] * along[0] + from[1] * along[1]) / squared).clamp(0.0, 1.0);
        distance(
            at,
            [pair[0][0] + share * along[0], pair[0][1] + share * along[1]],
        )
    });
    pieces.fold(f64::INFINITY, f64::min)
}

fn length(curve: &Curve) -> f64 {
    curve
        .windows(2)
        .map(|pair| distance(pair[0], pair[1]))
        .sum()
}

impl Body {
    /// The states of the faces of a body cut along curves.
    fn cut(&self, curves: &[Curve], part: FaceState) -> Vec<FaceState> {
        let state = |points: &[u32; 2]| {
            let pair = points.map(|it| self.positions[it as usize]);
            let mut pieces = curves.iter().flat_map(|curve| curve.windows(2));
            let is_cut = pieces.any(|piece| cross([piece[0], piece[1]], pair));
            if is_cut { part } else { FaceState::Whole }
        };
        self.faces.points().iter().map(state).collect()
    }

    fn lines(&self, parts: &[FaceState]) -> Vec<CrackLine> {
        crack_lines(&self.faces, parts, &vec![HORIZON; self.positions.len()])
    }
}

fn line(from: [f64; 2], to: [f64; 2]) -> Curve {
    vec![from, to]
}

fn arc(radius: f64, from: f64, to: f64) -> Curve {
    let angle = |k: i32| (from + (to - from) * f64::from(k) / 90.0).to_radians();
    let place = |k: i32| [radius * angle(k).cos(), radius * angle(k).sin()];
    (0..=90).map(place).collect()
}

/// The curves of one crack each, with their names.
fn curves() -> Vec<(&'static str, Curve)> {
    vec![
        ("along x", line([-0.02, 0.0], [0.021, 0.0])),
        ("along y", line([1e-4, -0.025], [1e-4, 0.012])),
        ("at 17 degrees", line([-0.02, -0.01], [0.02, 0.00223])),
        ("at 45 degrees", line([-0.02, -0.0201], [0.02, 0.0199])),
        ("an arc", arc(0.025, -40.0, 100.0)),
    ]
}

/// A crack that follows a curve: its tips lie within a spacing of the ends of the curve, its places within a spacing of the curve, and its length
/// is right to 5 % and a spacing at each end.
#[test]
fn a_crack_follows_the_curve_of_the_cut() {
    for body in [disk(), lattice()] {
        for (name, curve) in curves() {
            let found = body.lines(&body.cut(std::slice::from_ref(&curve), FaceState::Open));
            assert_eq!(found.len(), 1, "{name}");
            let found = &found[0];
            assert_eq!(found.ends, [CrackEnd::Tip; 2], "{name}");
            for end in [curve[0], curve[curve.len() - 1]] {
                let nearest = found
                    .tips()
                    .map(|tip| distance(tip, end))
                    .fold(f64::INFINITY, f64::min);
                assert!(nearest < SPACING, "{name}: tip off by {nearest}");
            }
            let farthest = found
                .places
                .iter()
                .map(|&it| off(it, &curve))
                .fold(0.0, f64::max);
            assert!(farthest < SPACING, "{name}: {farthest} off");
            let (found, exact) = (found.length(), length(&curve));
            let error = (found - exact).abs();
            println!("{name}: {found:.5} for {exact:.5}, at most {farthest:.2e} off");
            assert!(
                error < 0.05 * exact + SPACING,
                "{name}: {found} for {exact}"
            );
        }
    }
}

/// A crack whose two sides are crushed: all points within 0.75 spacings of the curve have lost all their bonds. One line, as before.
#[test]
fn loose_points_along_a_crack_make_no_second_one() {
    for body in [disk(), lattice()] {
        for (name, curve) in curves() {
            let mut parts = body.cut(std::slice::from_ref(&curve), FaceState::Open);
            for (part, points) in parts.iter_mut().zip(body.faces.points()) {
                let is_crushed =
                    |it: u32| off(body.positions[it as usize], &curve) < 0.75 * SPACING;
                if points.iter().any(|&it| is_crushed(it)) {
                    *part = FaceState::Open;
                }
            }
            let found = body.lines(&parts);
            assert_eq!(found.len(), 1, "{name}");
            let farthest = (found[0].places.iter())
                .map(|&it| off(it, &curve))
                .fold(0.0, f64::max);
            assert!(farthest < 2.0 * SPACING, "{name}: {farthest} off");
            let (found, exact) = (found[0].length(), length(&curve));
            println!("{name}: {found:.5} for {exact:.5}, at most {farthest:.2e} off");
            // The crushed zone reaches beyond the ends of the curve, by two spacings at most.
            assert!(
                found > 0.95 * exact && found < 1.05 * exact + 4.0 * SPACING,
                "{name}: {found} for {exact}"
            );
        }
    }
}

/// A Y of three arms of 20 mm, 120 degrees apart: a line with one branch, three tips, 60 mm in all.
#[test]
fn a_crack_branches_where_it_branches() {
    let centre = [3e-4, 2e-4];
    let arm = |degrees: f64| {
        let angle = (degrees + 7.0).to_radians();
        let end = [
            centre[0] + 0.02 * angle.cos(),
            centre[1] + 0.02 * angle.sin(),
        ];
        line(centre, end)
    };
    let arms = [0.0, 120.0, 240.0].map(arm);
    for body in [disk(), lattice()] {
        let found = body.lines(&body.cut(&arms, FaceState::Open));
        assert_eq!(found.len(), 2);
        assert_eq!(found[1].ends, [CrackEnd::Junction, CrackEnd::Tip]);
        let fork = distance(found[1].places[0], centre);
        assert!(fork < HORIZON, "{fork}");
        for arm in &arms {
            let tips = found.iter().flat_map(CrackLine::tips);
            let nearest = tips
                .map(|tip| distance(tip, arm[1]))
                .fold(f64::INFINITY, f64::min);
            assert!(nearest < SPACING, "{nearest}");
        }
        let whole: f64 = found.iter().map(CrackLine::length).sum();
        assert!(
            (whole - 0.06).abs() < 0.05 * 0.06 + 3.0 * SPACING,
            "{whole}"
        );
    }
}

/// A straight pre-crack of 20 mm with a wing at either end, the left one up to the outline of the disk: the pre-crack is none of
/// their length.
#[test]
fn cracks_start_at_pre_cracks_and_end_at_the_outline() {
    let body = disk();
    let slot = line([-0.01, 0.0], [0.01, 0.0]);
    let wings = [
        line([-0.06, 0.0], [-0.01, 0.0]),
        line([0.01, 0.0], [0.03, 0.01]),
    ];
    let mut parts = body.cut(&wings, FaceState::Open);
    for (part, cut) in parts.iter_mut().zip(body.cut(&[slot], FaceState::PreCrack)) {
        if cut == FaceState::PreCrack {
            *part = cut;
        }
    }
    let mut found = body.lines(&parts);
    found.sort_by(|a, b| b.length().total_cmp(&a.length()));
    let ends: Vec<[CrackEnd; 2]> = found.iter().map(|it| it.ends).collect();
    let from_slot = |end| [CrackEnd::PreCrack, end];
    assert_eq!(
        ends,
        [from_slot(CrackEnd::Outline), from_slot(CrackEnd::Tip)]
    );
    for (found, exact) in found.iter().zip([0.04, 0.02_f64.hypot(0.01)]) {
        let error = (found.length() - exact).abs();
        assert!(
            error < 0.05 * exact + SPACING,
            "{} for {exact}",
            found.length()
        );
    }
}

/// A gap of a spacing in a crack is no end of it; cracks two horizons apart are two; a single parted pair is none.
#[test]
fn a_horizon_decides_what_is_one_crack() {
    for body in [disk(), lattice()] {
        let halves = [
            line([-0.02, 0.0], [-0.001, 0.0]),
            line([0.001, 0.0], [0.02, 0.0]),
        ];
        let found = body.lines(&body.cut(&halves, FaceState::Open));
        assert_eq!(found.len(), 1);
        assert!((found[0].length() - 0.04).abs() < 0.05 * 0.04 + SPACING);
        let parallel = [0.0, 2.0 * HORIZON].map(|y| line([-0.02, y], [0.02, y]));
        assert_eq!(body.lines(&body.cut(&parallel, FaceState::Open)).len(), 2);
        let mut single = vec![FaceState::Whole; body.faces.len()];
        single[body.faces.len() / 2] = FaceState::Open;
        assert_eq!(body.lines(&single), []);
    }
}

/// A closed crack around a part of 40 mm: lines go all the way round, but for a horizon.
#[test]
fn a_closed_crack_is_followed_round() {
    let curve = arc(0.02, 0.0, 360.0);
    for body in [disk(), lattice()] {
        let found = body.lines(&body.cut(std::slice::from_ref(&curve), FaceState::Open));
        let whole: f64 = found.iter().map(CrackLine::length).sum();
        assert!(
            (whole - 2.0 * PI * 0.02).abs() < HORIZON + 0.05 * whole,
            "{whole}"
        );
    }
}
