//! The smallest ligament of a body: the section that a crack has to run through, in horizons.

use std::f64::consts::TAU;

use ligament_model::PointCloud;

use super::facets::{self, Facet, dot, mean, minus, size};
use super::thinnest::{Section, path_to_side, thinnest_section};
use crate::coordinates::narrowed;
use crate::model::Model;
use crate::patch_test::Untested;
use crate::setup::{CrackShape, Position};
use crate::system::over_dimension;
use ligament_model::in_space;

/// Ratio of the horizon to the smallest ligament above which peaks of bodies that soften are more than some 3 % too high: the stress of a
/// criterion is a mean over a horizon, so that the tip of a crack is blunter than it should be.
pub const WIDE: f64 = 0.15;

/// Number of positions along the rim of a disk from which ligaments are measured.
const AROUND: usize = 16;

/// A position at the tip of a pre-crack, and the direction in which it would run on, of length one.
type Tip = (Position, Position);

/// The section ahead of the tip of a pre-crack, straight on up to the outline, that is the smallest in horizons; without a tip within the
/// body its thinnest section.
///
/// Pre-cracks by triangles or by a group of the mesh have no tips here.
///
/// # Errors
///
/// As for [`thinnest_section`].
pub fn smallest_ligament(model: &Model, most_sides: usize) -> Result<Section, Untested> {
    let ahead = over_dimension!(&model.system, system => ahead_of_tips(model, &system.cloud));
    match ahead {
        Some(section) => Ok(section),
        None => thinnest_section(model, most_sides),
    }
}

fn ahead_of_tips<const D: usize>(model: &Model, cloud: &PointCloud<D>) -> Option<Section> {
    let facets = facets::of_body::<D>(&model.setup);
    let shapes = model.setup.precracks.iter().map(|it| &it.shape);
    let sections = shapes.flat_map(tips).filter_map(|(tip, direction)| {
        let (tip, direction) = (narrowed(tip), narrowed(direction));
        let length = ligament_ahead(&facets, tip, direction)?;
        let nearest = nearest(cloud, tip);
        Some(Section {
            place: in_space(std::array::from_fn::<f64, D, _>(|axis| {
                tip[axis] + 0.5 * length * direction[axis]
            })),
            across: in_space(direction),
            thickness: length,
            spacing: cloud.spacing[nearest],
            horizon: model.fixed.horizon[nearest],
        })
    });
    sections.min_by(|one, other| one.horizons().total_cmp(&other.horizons()))
}

/// Distance from a tip within the body to its outline, m; none outside the body, where the way begins with an entry.
fn ligament_ahead<const D: usize>(
    facets: &[Facet<D>],
    tip: [f64; D],
    direction: [f64; D],
) -> Option<f64> {
    let [exit, entry] = [true, false].map(|outwards| {
        let found = path_to_side(facets, tip, direction, outwards);
        found.map(|(length, _)| length)
    });
    exit.filter(|exit| entry.is_none_or(|entry| *exit < entry))
}

/// Index of the point nearest to a position.
fn nearest<const D: usize>(cloud: &PointCloud<D>, place: [f64; D]) -> usize {
    let away = |point: &usize| size(minus(cloud.positions[*point], place));
    let points = 0..cloud.positions.len();
    points
        .min_by(|one, other| away(one).total_cmp(&away(other)))
        .unwrap_or(0)
}

/// Tips of a pre-crack: the ends of a line, positions along the rim of a disk, the middles of the edges of a polygon.
fn tips(shape: &CrackShape) -> Vec<Tip> {
    match shape {
        CrackShape::Line(points) => {
            let points: Vec<Position> = points.iter().map(|&it| in_space(it)).collect();
            let [first, next] = [points[0], points[1]];
            let [before, last] = [points[points.len() - 2], points[points.len() - 1]];
            vec![from_to(next, first), from_to(before, last)]
        }
        CrackShape::Disk {
            centre,
            normal,
            radius,
        } => {
            let [one, other] = axes_across(*normal);
            let around = (0..AROUND).map(|it| TAU * it as f64 / AROUND as f64);
            let rim = around.map(|angle| {
                let (sin, cos) = angle.sin_cos();
                let outward = [0, 1, 2].map(|axis| cos * one[axis] + sin * other[axis]);
                let tip = [0, 1, 2].map(|axis| centre[axis] + radius * outward[axis]);
                (tip, outward)
            });
            rim.collect()
        }
        CrackShape::Polygon(corners) => {
            let middle = mean(corners);
            let next = corners.iter().cycle().skip(1);
            let edges = corners.iter().zip(next);
            edges
                .map(|(one, other)| from_to(middle, mean(&[*one, *other])))
                .collect()
        }
        CrackShape::Triangles { .. } | CrackShape::Group(_) => Vec::new(),
    }
}

/// The tip at the end of a way, with its direction.
fn from_to(from: Position, tip: Position) -> Tip {
    let along = minus(tip, from);
    (tip, along.map(|it| it / size(along)))
}

/// Two directions at right angles to each other and to a normal, of length one.
fn axes_across(normal: Position) -> [Position; 2] {
    let smallest = (0..3).min_by(|&one, &other| normal[one].abs().total_cmp(&normal[other].abs()));
    let mut axis = [0.0; 3];
    axis[smallest.unwrap_or(0)] = 1.0;
    let share = dot(axis, normal) / dot(normal, normal);
    let across: Position = std::array::from_fn(|k| axis[k] - share * normal[k]);
    let one = across.map(|it| it / size(across));
    let other: Position = std::array::from_fn(|k| {
        let [next, last] = [(k + 1) % 3, (k + 2) % 3];
        (normal[next] * one[last] - normal[last] * one[next]) / size(normal)
    });
    [one, other]
}
