//! Places around which the next pass of a refinement is fine: middles of bonds that broke or came near their limits, and tips of pre-cracks.

use std::f64::consts::TAU;

use ligament_analysis::State;
use ligament_analysis::largest_utilisation::LargestUtilisations;
use ligament_mesh::Cell;
use ligament_model::failure::{Criteria, Weakened};
use rstar::RTree;

use crate::body::{AnyBody, Body};
use crate::coordinates::narrowed;
use crate::model::Model;
use crate::setup::{CrackShape, FinePlace, Indicator, Position, PreCrack, Refine};

/// Share of the force at the limit below which a bond that softens has lost half of its force.
const HALF: f64 = 0.5;

/// Tolerance of a comparison of horizons, relative: they are multiples of distances with rounding errors.
const SAME: f64 = 1.0 + 1e-9;

/// Number of chords of the rim of a disk.
const CHORDS: usize = 64;

/// Bonds of a run that say where a crack is, by their indices, ascending.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct CrackBonds {
    /// Bonds that the indicator of the refinement counts.
    pub(super) open: Vec<usize>,
    /// Other bonds near their limits with an end outside of the fine part.
    pub(super) near_limit: Vec<usize>,
}

impl CrackBonds {
    /// The bonds of the last state of a run. Bonds that soften count by the indicator alone, unless there is none that it counts: what begins to soften
    /// and never opens needs no fine points.
    pub(super) fn new(
        model: &Model,
        refine: &Refine,
        fine_horizon: f64,
        state: &State,
        largest: &LargestUtilisations,
    ) -> Self {
        let criteria = &*model.criteria;
        let all = 0..state.intact.len();
        let open: Vec<usize> = all
            .clone()
            .filter(|&bond| is_open(criteria, state, refine.indicator, bond))
            .collect();
        let is_watched = !criteria.soften() || open.is_empty();
        let ends = &model.system.to_bonds().ends;
        let near_limit = all.filter(|&bond| {
            let share = largest.of_bonds.get(bond).map_or(0.0, |it| it.utilisation);
            is_watched
                && f64::from(share) >= refine.strength_share
                && open.binary_search(&bond).is_err()
                && !is_inside(&model.fixed.horizon, fine_horizon, ends[bond])
        });
        Self {
            near_limit: near_limit.collect(),
            open,
        }
    }

    /// Share of the open bonds between points of the fine part; none where no bond is open.
    pub(super) fn share_inside(&self, model: &Model, fine_horizon: f64) -> Option<f64> {
        let ends = &model.system.to_bonds().ends;
        let inside = self
            .open
            .iter()
            .filter(|bond| is_inside(&model.fixed.horizon, fine_horizon, ends[**bond]));
        (!self.open.is_empty()).then(|| inside.count() as f64 / self.open.len() as f64)
    }

    /// The places of the bonds.
    pub(super) fn places(&self, model: &Model, pass: u32) -> Vec<FinePlace> {
        let ends = &model.system.to_bonds().ends;
        let kinds = [(&self.open, true), (&self.near_limit, false)];
        let of_kind = |(bonds, is_open): (&Vec<usize>, bool)| {
            let places = bonds.iter().map(|&bond| FinePlace {
                position: in_space(&model.middle(ends[bond])),
                pass,
                is_open,
            });
            places.collect::<Vec<_>>()
        };
        kinds.into_iter().flat_map(of_kind).collect()
    }
}

/// Whether the horizons of both ends of a bond are no longer than those of the fine part.
fn is_inside(horizons: &[f64], fine_horizon: f64, ends: [u32; 2]) -> bool {
    let longest = fine_horizon * SAME;
    ends.iter().all(|&end| horizons[end as usize] <= longest)
}

/// Whether an indicator counts a bond.
fn is_open(criteria: &Criteria, state: &State, indicator: Indicator, bond: usize) -> bool {
    let softening = &state.softening;
    let mut largest = softening.largest.iter().enumerate();
    !state.intact[bond]
        || largest.any(|(place, largest)| {
            let weakened = criteria.list[place].measure.weakens();
            let opens = matches!(weakened, Weakened::Opening | Weakened::Whole);
            let has_begun = largest.get(bond).is_some_and(|it| *it > 1.0);
            has_begun
                && match indicator {
                    Indicator::Broken => false,
                    Indicator::Softening => true,
                    Indicator::Half => opens && softening.bond(criteria, place, bond).force < HALF,
                }
        })
}

/// Positions at most a `step` (m) apart along the fronts of pre-cracks within a body: the ends of lines, and the rims of surfaces.
pub(super) fn tips(precracks: &[PreCrack], body: &AnyBody, step: f64) -> Vec<FinePlace> {
    let rims = precracks.iter().flat_map(|it| rim(it, &**body));
    let mut found = Vec::new();
    for Rim { ends, inner } in rims {
        let length = distance(ends[0], ends[1]);
        let pieces = (length / step).ceil();
        for number in 0..=pieces as usize {
            let share = if pieces > 0.0 {
                number as f64 / pieces
            } else {
                0.0
            };
            let position = between(ends[0], ends[1], share);
            // A rim on the outline, such as the mouth of a crack, is no front.
            let beyond = between(inner, position, 1.0 + 1e-3);
            if is_within(body, beyond) {
                found.push(FinePlace {
                    position,
                    pass: 0,
                    is_open: false,
                });
            }
        }
    }
    found
}

/// A piece of the rim of a pre-crack: its ends, and a position on the crack inside of it.
struct Rim {
    ends: [Position; 2],
    inner: Position,
}

/// The rim of a pre-crack; the ends of a line are pieces without a length.
fn rim(crack: &PreCrack, body: &dyn Body) -> Vec<Rim> {
    match &crack.shape {
        CrackShape::Line(points) => {
            let [first, second] = [0, 1].map(|it| points.get(it).copied());
            let last = points.len().checked_sub(2);
            let ends = [
                first.zip(second),
                last.map(|it| (points[it + 1], points[it])),
            ];
            let piece = |(end, inner): ([f64; 2], [f64; 2])| Rim {
                ends: [in_space(&end); 2],
                inner: in_space(&inner),
            };
            ends.into_iter().flatten().map(piece).collect()
        }
        CrackShape::Disk {
            centre,
            normal,
            radius,
        } => {
            let [u, v] = across(*normal);
            let at = |number: usize| {
                let (sine, cosine) = (TAU * number as f64 / CHORDS as f64).sin_cos();
                std::array::from_fn(|axis| {
                    centre[axis] + radius * (cosine * u[axis] + sine * v[axis])
                })
            };
            let chord = |number| Rim {
                ends: [at(number), at(number + 1)],
                inner: *centre,
            };
            (0..CHORDS).map(chord).collect()
        }
        CrackShape::Polygon(corners) => {
            let mean = |axis: usize| corners.iter().map(|it| it[axis]).sum::<f64>();
            let inner = std::array::from_fn(|axis| mean(axis) / corners.len() as f64);
            let next = corners.iter().cycle().skip(1);
            let sides = corners.iter().zip(next);
            sides
                .map(|(&from, &to)| Rim {
                    ends: [from, to],
                    inner,
                })
                .collect()
        }
        CrackShape::Triangles { points, triangles } => {
            rim_of_triangles(triangles, |node| points[node as usize])
        }
        CrackShape::Group(group) => {
            let faces = body.faces_of(group).unwrap_or_default();
            let triangles: Vec<[u32; 3]> = faces.iter().flat_map(Cell::triangles).collect();
            rim_of_triangles(&triangles, |node| in_space(&body.position(node)))
        }
    }
}

/// The edges of triangles that belong to one triangle alone.
fn rim_of_triangles(triangles: &[[u32; 3]], at: impl Fn(u32) -> Position) -> Vec<Rim> {
    let sides = |&[a, b, c]: &[u32; 3]| [([a, b], c), ([b, c], a), ([c, a], b)];
    let sorted = |[a, b]: [u32; 2]| [a.min(b), a.max(b)];
    let mut all: Vec<([u32; 2], u32)> = triangles
        .iter()
        .flat_map(sides)
        .map(|(edge, opposite)| (sorted(edge), opposite))
        .collect();
    all.sort_unstable();
    let of_edge = all.chunk_by(|one, other| one.0 == other.0);
    of_edge
        .filter(|it| it.len() == 1)
        .map(|it| Rim {
            ends: it[0].0.map(&at),
            inner: at(it[0].1),
        })
        .collect()
}

/// Two directions across a normal and across each other, of length 1.
fn across(normal: [f64; 3]) -> [[f64; 3]; 2] {
    let unit = |it: [f64; 3]| {
        let length = it.iter().fold(0.0, |sum, it| f64::hypot(sum, *it));
        it.map(|it| it / length)
    };
    let cross =
        |[a, b, c]: [f64; 3], [p, q, r]: [f64; 3]| [b * r - c * q, c * p - a * r, a * q - b * p];
    let normal = unit(normal);
    let smallest = (0..3).min_by(|a, b| normal[*a].abs().total_cmp(&normal[*b].abs()));
    let mut axis = [0.0; 3];
    axis[smallest.unwrap_or(0)] = 1.0;
    let first = unit(cross(normal, axis));
    [first, cross(normal, first)]
}

/// Whether a position lies in a cell of the body.
fn is_within(body: &AnyBody, position: Position) -> bool {
    match body {
        AnyBody::Plane(body) => body.interpolation_weights(narrowed(position)),
        AnyBody::Solid(body) => body.interpolation_weights(narrowed(position)),
    }
    .is_some()
}

/// A position in space from the coordinates of a body.
fn in_space(coordinates: &[f64]) -> Position {
    std::array::from_fn(|axis| coordinates.get(axis).copied().unwrap_or(0.0))
}

/// The position from one to another at a share of the way.
fn between(from: Position, to: Position, share: f64) -> Position {
    std::array::from_fn(|axis| from[axis] + share * (to[axis] - from[axis]))
}

/// Distance of two positions, m.
pub(super) fn distance(from: Position, to: Position) -> f64 {
    let along = from.iter().zip(to).map(|(from, to)| to - from);
    along.fold(0.0, f64::hypot)
}

/// The largest distance of an open place of one of two passes from the nearest open place of the other, m; none where one of them has no open
/// place.
pub(super) fn apart(before: &[FinePlace], now: &[FinePlace]) -> Option<f64> {
    let open = |places: &[FinePlace]| {
        let open = places.iter().filter(|it| it.is_open);
        RTree::bulk_load(open.map(|it| it.position).collect())
    };
    let [before, now] = [open(before), open(now)];
    let farthest = |from: &RTree<Position>, to: &RTree<Position>| {
        let nearest = |it: &Position| Some(distance(*it, *to.nearest_neighbor(*it)?));
        let all: Option<Vec<f64>> = from.iter().map(nearest).collect();
        all.filter(|it| !it.is_empty())
            .map(|it| it.into_iter().fold(0.0, f64::max))
    };
    Some(farthest(&before, &now)?.max(farthest(&now, &before)?))
}
