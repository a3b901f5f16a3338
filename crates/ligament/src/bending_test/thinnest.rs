//! The thinnest section of a body: the shortest path through it, in horizons, between opposite sides.

use ligament_model::{PointCloud, parallel};

use super::facets::{self, Facet, dot, mean, minus, size};
use crate::model::Model;
use crate::patch_test::Untested;
use crate::setup::Position;
use crate::system::over_dimension;
use ligament_model::in_space;

/// Largest number of sides of an outline for which the quadratic search takes one or two seconds.
pub const MOST_SIDES: usize = 20_000;

/// Smallest cosine of the angle between the path and the normal of the side where it ends: at larger angles than 26 degrees the path ends
/// in a corner.
const OPPOSITE: f64 = 0.9;

/// Largest ratio of a path to the shortest one that counts as equally short: horizons on irregular meshes vary as much.
const AS_THIN: f64 = 1.2;

/// Tolerance of the intersection of a path with a side, over the size of the side.
const SLACK: f64 = 1e-9;

/// A section of a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Section {
    /// Centre of the section, m.
    pub place: Position,
    /// Direction through the body, of length one.
    pub across: Position,
    /// Length of the path through the body, m.
    pub thickness: f64,
    /// Mean distance of the points at the sides to their nearest points, m.
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

/// The thinnest section of the body of a model, whose outline has at most `most_sides` sides.
///
/// From the middle of each side of the outline a path goes straight inwards until it leaves the body. Of the paths about as long in
/// horizons as the shortest, the one nearest to the mean of their positions is taken: the middle of a strip, not its end.
///
/// # Errors
///
/// If the outline has more sides, the body has no mesh, or no sides are opposite to each other.
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
        let (thickness, to) = path_to_side(&facets, middle, inward, true)?;
        let is_opposite = dot(inward, to.area) >= OPPOSITE * size(to.area);
        is_opposite.then(|| Section {
            place: in_space(std::array::from_fn::<f64, D, _>(|axis| {
                middle[axis] + 0.5 * thickness * inward[axis]
            })),
            across: in_space(inward),
            thickness,
            spacing: around(&cloud.spacing, [from, to]),
            horizon: around(&model.fixed.horizon, [from, to]),
        })
    };
    let mut sections = parallel::flat_map(facets.len(), |place| section(&facets[place]));
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

/// Length of the path from a position to the first side through which it leaves the body, or else enters it, m, and the side.
pub(super) fn path_to_side<const D: usize>(
    facets: &[Facet<D>],
    from: [f64; D],
    direction: [f64; D],
    outwards: bool,
) -> Option<(f64, &Facet<D>)> {
    let mut found: Option<(f64, &Facet<D>)> = None;
    for facet in facets {
        let rate = dot(direction, facet.area);
        if rate == 0.0 || (rate > 0.0) != outwards {
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

/// Whether a position in the plane of a side lies on it: replacing a corner by the position never reverses the orientation.
fn is_on<const D: usize>(facet: &Facet<D>, place: [f64; D]) -> bool {
    let slack = -SLACK * dot(facet.area, facet.area);
    (0..D).all(|corner| {
        let mut places = facet.places;
        places[corner] = place;
        dot(facets::area(places), facet.area) >= slack
    })
}
