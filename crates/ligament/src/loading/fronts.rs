//! Fronts of the pre-cracks of solids.

use std::f64::consts::PI;

use ligament_model::geometry::{distance_to, nearest_place, point_at};
use ligament_model::stress::crack_front::CrackFront;
use ligament_model::tensor::{cross, dot, minus, norm};

use crate::setup::{CrackShape, PreCrack, Tip};

/// Number of the pre-crack at whose rim a place is, and its front there.
pub(super) fn front_of_solid(
    given: &Tip,
    radii: [f64; 2],
    precracks: &[PreCrack],
    spacing: f64,
) -> Result<(usize, CrackFront), String> {
    let numbered = precracks.iter().enumerate();
    let fronts = numbered.filter_map(|(number, crack)| {
        let front = match &crack.shape {
            CrackShape::Disk {
                centre,
                normal,
                radius,
            } => front_of_disk(given, radii, (*centre, *normal, *radius)),
            CrackShape::Polygon(corners) => front_of_polygon(given, radii, corners),
            CrackShape::Line(_) | CrackShape::Triangles { .. } | CrackShape::Group(_) => None,
        };
        Some((number, front?))
    });
    let away = |it: &(usize, CrackFront)| norm(minus(it.1.place, given.position));
    let Some((own, front)) = fronts.min_by(|a, b| away(a).total_cmp(&away(b))) else {
        let reason = "`tip` is a place on the rim of a [[precrack]] that is a disk or a plane polygon, and the case has none";
        return Err(reason.into());
    };
    let place = front.place;
    if away(&(own, front)) > spacing {
        return Err(format!(
            "no pre-crack has a front at {:?}; the nearest place is {place:?}",
            given.position
        ));
    }
    let outer = radii[1];
    if front.radius <= outer {
        return Err(format!(
            "the radius of the pre-crack is smaller than the outer radius {outer:e} m of the ring: give smaller `radii`"
        ));
    }
    let CrackShape::Polygon(corners) = &precracks[own].shape else {
        return Ok((own, front));
    };
    let tangent = front.axes[2];
    let window = [-1.0, 1.0].map(|sign| moved(place, sign * front.reach, tangent));
    let is_near = |side: [[f64; 3]; 2]| distance_between(side, window) < outer;
    let is_own = |side: [[f64; 3]; 2]| distance_to(side, place) <= 1e-9 * front.reach;
    let mut others = sides(corners).filter(|side| !is_own(*side));
    if others.any(is_near) {
        return Err(format!(
            "the front of the pre-crack is not straight, or the pre-crack ends, within {outer:e} m from the {:e} m of the front about {place:?}: \
             give smaller `radii` or a smaller `front_length`",
            2.0 * front.reach
        ));
    }
    Ok((own, front))
}

/// The front of a disk at the place nearest to a position.
fn front_of_disk(
    given: &Tip,
    radii: [f64; 2],
    (centre, normal, radius): ([f64; 3], [f64; 3], f64),
) -> Option<CrackFront> {
    let normal = unit(normal)?;
    let from_centre = minus(given.position, centre);
    let outwards = unit(moved(from_centre, -dot(normal, from_centre), normal))?;
    let half = 0.5 * given.front_length.unwrap_or(2.0 * radii[1]);
    let is_whole = half >= PI * radius;
    Some(CrackFront {
        place: moved(centre, radius, outwards),
        axes: [outwards, normal, cross(outwards, normal)],
        radius,
        side: 1.0,
        radii,
        reach: if is_whole { f64::INFINITY } else { half },
        length: if is_whole { 2.0 * PI * radius } else { half },
    })
}

/// The front of a plane polygon at the place nearest to a position.
fn front_of_polygon(given: &Tip, radii: [f64; 2], corners: &[[f64; 3]]) -> Option<CrackFront> {
    let doubled = sides(corners).fold([0.0; 3], |sum, [a, b]| {
        let from_first = [a, b].map(|it| minus(it, corners[0]));
        moved(sum, 1.0, cross(from_first[0], from_first[1]))
    });
    let normal = unit(doubled)?;
    let away = |side: &[[f64; 3]; 2]| distance_to(*side, given.position);
    let side = sides(corners).min_by(|a, b| away(a).total_cmp(&away(b)))?;
    // Corners are counter-clockwise about the normal.
    let outwards = cross(unit(minus(side[1], side[0]))?, normal);
    let half = 0.5 * given.front_length.unwrap_or(2.0 * radii[1]);
    Some(CrackFront {
        place: point_at(side, nearest_place(side, given.position)),
        axes: [outwards, normal, cross(outwards, normal)],
        radius: f64::INFINITY,
        side: 1.0,
        radii,
        reach: half,
        length: half,
    })
}

/// Sides of a polygon from corner to corner.
fn sides(corners: &[[f64; 3]]) -> impl Iterator<Item = [[f64; 3]; 2]> {
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).map(|(a, b)| [*a, *b])
}

/// A position moved along a vector.
fn moved(position: [f64; 3], by: f64, along: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|axis| position[axis] + by * along[axis])
}

/// The unit vector along a vector; None without a length.
fn unit(vector: [f64; 3]) -> Option<[f64; 3]> {
    let length = norm(vector);
    (length > 0.0).then(|| vector.map(|it| it / length))
}

/// Distance of two sides in a plane that do not cross, m.
fn distance_between(one: [[f64; 3]; 2], other: [[f64; 3]; 2]) -> f64 {
    let of_one = one.map(|it| distance_to(other, it));
    let of_other = other.map(|it| distance_to(one, it));
    of_one
        .into_iter()
        .chain(of_other)
        .fold(f64::INFINITY, f64::min)
}
