//! The thinnest section of a body: the shortest way through it, counted in horizons, between sides that lie opposite to each other.

use ligament_model::PointCloud;
use rayon::prelude::*;

use super::facets::{self, Facet, dot, mean, minus, size};
use crate::coordinates::widened;
use crate::model::Model;
use crate::patch_test::Untested;
use crate::setup::Position;
use crate::system::over_dimension;

/// Sides of an outline up to which its thinnest section is found in a second or two: each is asked where the ways from all others end.
pub const MOST_SIDES: usize = 20_000;

/// Cosine of the largest angle between the way through the body and the normal of the side where it ends: beyond it, at 26 degrees, the way
/// goes into a corner and not through a section.
const OPPOSITE: f64 = 0.9;

/// Ways longer by this factor than the shortest are as thin as it: horizons on irregular meshes differ as much.
const AS_THIN: f64 = 1.2;

/// Room around a side within which a way meets it, over the size of the side.
const SLACK: f64 = 1e-9;

/// A section of a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Section {
    /// Middle of the section, m.
    pub place: Position,
    /// Direction through the body, of length one.
    pub across: Position,
    /// Length of the way through the body, m.
    pub thickness: f64,
    /// Mean distance of the points at the sides to their nearest ones, m.
    pub spacing: f64,
    /// Mean horizon of the points at the sides, m.
    pub horizon: f64,
}

impl Section {
    /// Thickness over the horizon.
    pub fn horizons(&self) -> f64 {
        self.thickness / self.horizon
    }
}

/// The thinnest section of the body of a model, whose outline has up to so many sides.
///
/// From the middle of each side of the outline a way goes straight inwards until it leaves the body. Of the ways that are about as many
/// horizons long as the shortest, the one nearest to the middle of all of these is taken: the middle of a strip, not its end.
///
/// # Errors
///
/// If the outline has more sides; if the body has no mesh, or no sides that lie opposite to each other.
pub fn thinnest_section(model: &Model, most_sides: usize) -> Result<Section, Untested> {
    over_dimension!(&model.system, system => thinnest(model, &system.cloud, most_sides))
}

fn thinnest<const D: usize>(
    model: &Model,
    cloud: &PointCloud<D>,
    most_sides: usize,
) -> Result<Section, Untested> {
    let facets = facets::of_body::<D>(&model.setup);
    let sides = facets.len();
    if sides > most_sides {
        return Err(Untested::ManySides { sides });
    }
    let around = |values: &[f64], [one, other]: [&Facet<D>; 2]| {
        let corners = one.corners.iter().chain(&other.corners);
        corners.map(|&corner| values[corner as usize]).sum::<f64>() / (2 * D) as f64
    };
    let section = |from: &Facet<D>| {
        let inward = from.area.map(|it| -it / size(from.area));
        let middle = from.middle();
        let (thickness, to) = path_through_body(&facets, middle, inward)?;
        let is_opposite = dot(inward, to.area) >= OPPOSITE * size(to.area);
        is_opposite.then(|| Section {
            place: widened(std::array::from_fn::<f64, D, _>(|axis| {
                middle[axis] + 0.5 * thickness * inward[axis]
            })),
            across: widened(inward),
            thickness,
            spacing: around(&cloud.spacing, [from, to]),
            horizon: around(&model.fixed.horizon, [from, to]),
        })
    };
    let mut sections: Vec<Section> = facets.par_iter().filter_map(section).collect();
    let shortest = sections
        .iter()
        .map(Section::horizons)
        .fold(f64::INFINITY, f64::min);
    sections.retain(|it| it.horizons() <= AS_THIN * shortest);
    let places: Vec<_> = sections.iter().map(|it| it.place).collect();
    let middle = mean(&places);
    let away = |it: &Section| size(minus(it.place, middle));
    sections
        .into_iter()
        .min_by(|one, other| away(one).total_cmp(&away(other)))
        .ok_or(Untested::NoSection)
}

/// Length of the way from a place on the outline to where it leaves the body, and the side there.
fn path_through_body<const D: usize>(
    facets: &[Facet<D>],
    from: [f64; D],
    direction: [f64; D],
) -> Option<(f64, &Facet<D>)> {
    let mut found: Option<(f64, &Facet<D>)> = None;
    for facet in facets {
        let rate = dot(direction, facet.area);
        if rate <= 0.0 {
            continue;
        }
        let length = dot(minus(facet.places[0], from), facet.area) / rate;
        if length <= 0.0 || found.is_some_and(|(shortest, _)| length >= shortest) {
            continue;
        }
        let place = std::array::from_fn(|axis| from[axis] + length * direction[axis]);
        if is_on(facet, place) {
            found = Some((length, facet));
        }
    }
    found
}

/// Whether a place in the plane of a side lies on it: none of the sides with the place for a corner is turned round.
fn is_on<const D: usize>(facet: &Facet<D>, place: [f64; D]) -> bool {
    let slack = -SLACK * dot(facet.area, facet.area);
    (0..D).all(|corner| {
        let mut places = facet.places;
        places[corner] = place;
        dot(facets::area(places), facet.area) >= slack
    })
}
