//! Message about the edge of a platen, where bonds of a wide family fail by stress too early.

use std::collections::BTreeMap;

use ligament_analysis::Message;
use ligament_model::correction::patch::Reference;
use ligament_model::material::Space;

use crate::body::Geometry;
use crate::setup::{Place, Setup, Surface};

/// Horizon factor from which single bonds beside a platen carry too much.
///
/// Measured on seven meshes of the Brazilian disk, Delaunay and frontal, of 4 to 1.5 mm, under platens of 6 mm that prescribe a displacement:
/// the load at the first breakage is .64 to 1.00 of the closed form at 4 with the reference `body`, and .66 to .97 at 5 with `families`; below,
/// at 3 and 3.5 with `body` and at 4 with `families`, it is .98 to 1.02. Under forces and pressures it is right at 4 with either.
fn wide_factor(reference: Reference) -> f64 {
    match reference {
        Reference::Body => 4.0,
        Reference::Families => 5.0,
    }
}

/// Cosine of the turn of an outline, 45 degrees, above which a place is inside a side and not its corner.
const SMOOTH: f64 = 0.707;

/// Message about brittle bonds that fail by stress beside a platen, for the smallest horizon of a point over the distance to its nearest
/// point; for bodies in the plane.
pub(super) fn early_at_platen(setup: &Setup, factor: f64) -> Option<Message> {
    let Surface::Patch(settings) = &setup.correction.surface else {
        return None;
    };
    if factor < wide_factor(settings.reference) || !matches!(setup.space(), Space::Plane(_)) {
        return None;
    }
    let by_stress = setup.criteria.iter().find(|it| {
        let mut measures = it.kind.measures.iter();
        !it.after.softens && measures.any(|it| it.takes_stress())
    })?;
    let body = &**setup.body.geometry::<2>();
    let end = |(name, place): (String, &Place)| {
        let ends = ends_inside_sides(body, place);
        Some((name, *ends.first()?))
    };
    let (name, point) = moved_places(setup).into_iter().find_map(end)?;
    let text = format!(
        "criterion \"{}\" with a horizon of {factor:.4} distances of points: at the edge of `{name}` ({}) single bonds carry too much, so that the \
         first breaks too early (a disk at .6 to 1.0 of its load) and finer meshes have no limit; the largest load is right",
        by_stress.kind.word,
        setup.body.place(point)
    );
    let advice = match settings.reference {
        Reference::Body => "take reference = \"families\" or model.horizon_factor = 3",
        Reference::Families => "take model.horizon_factor = 3",
    };
    Some(Message::new("early-at-platen", text).with_advice(advice))
}

/// Places whose points are held or moved, with the names of their supports and loads.
fn moved_places(setup: &Setup) -> Vec<(String, &Place)> {
    let supports = setup.supports.iter().enumerate();
    let held = supports.filter(|(_, it)| !it.held.is_empty());
    let held = held.map(|(index, it)| (it.name(index), &it.place));
    let moved = setup.loads.iter().filter(|it| it.action.motion().is_some());
    held.chain(moved.map(|it| (it.name.clone(), &it.place)))
        .collect()
}

/// Points at which a curve along the outline of a meshed body ends while the outline goes on without a corner, ascending.
fn ends_inside_sides(body: &dyn Geometry<2>, place: &Place) -> Vec<u32> {
    let Place::Group(group) = place else {
        return Vec::new();
    };
    let edges = body.outline_of(group).unwrap_or_default();
    let mut at_point: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    for edge in &edges {
        if let [one, other] = edge.corners[..] {
            at_point.entry(one).or_default().push(other);
            at_point.entry(other).or_default().push(one);
        }
    }
    let sides = match edges.is_empty() {
        true => Vec::new(),
        false => body.outer_sides(),
    };
    let goes_on = |point: u32, from: u32| {
        let at = sides.iter().filter(|it| it.contains(&point));
        let mut next = at.flatten().filter(|&&it| it != point && it != from);
        next.any(|&to| turn_cosine([from, point, to].map(|it| body.position(it))) > SMOOTH)
    };
    let ends = at_point
        .into_iter()
        .filter_map(|(point, others)| match others[..] {
            [from] if goes_on(point, from) => Some(point),
            _ => None,
        });
    ends.collect()
}

/// Cosine of the turn of a path through three positions, m.
fn turn_cosine([from, at, to]: [Vec<f64>; 3]) -> f64 {
    let step = |from: &[f64], to: &[f64]| [to[0] - from[0], to[1] - from[1]];
    let ([ax, ay], [bx, by]) = (step(&from, &at), step(&at, &to));
    (ax * bx + ay * by) / (ax.hypot(ay) * bx.hypot(by))
}
