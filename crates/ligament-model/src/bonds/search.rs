//! Search for the pairs of points that are bonded.

use std::borrow::Cow;

use rayon::prelude::*;

use super::{BondSet, Composition, Incidence};
use crate::cloud::{PointCloud, distance, search_tree};
use crate::geometry::bounding_box;
use crate::horizon::Horizons;
use crate::parallel;
use crate::tensor::minus;

/// Number of points whose pairs one thread finds at a time.
const BLOCK: usize = 1024;

impl<const D: usize> BondSet<D> {
    /// Bonds between all pairs with l <= max(h_A, h_B), found with an R*-tree: one query a point, O(N log N) in all.
    ///
    /// The bond horizon (NHPD eq. 1) is the mean of both horizons where each contains the other point, and the larger one where only that
    /// contains the other point.
    pub fn search(cloud: &PointCloud<D>, horizons: &Horizons) -> Self {
        let tree = search_tree(&cloud.positions);
        let subdomain = &cloud.subdomain;
        let is_held = |pair: &[u32; 2]| subdomain.is_whole() || subdomain.contains_bond(*pair);
        let found = parallel::map(reaching(cloud, horizons).chunks(BLOCK), |points| {
            let mut pairs = Vec::new();
            for &point in points {
                let position = cloud.positions[point as usize];
                // The tree compares squared distances: its radius is slightly larger, and `contains` decides.
                let tolerance = cloud.tolerance(point);
                let reach = horizons.radius[point as usize] * (1.0 + 2.0 * tolerance);
                pairs.extend(
                    tree.locate_within_distance(position, reach * reach)
                        .map(|neighbour| neighbour.data)
                        .filter(|&other| is_recorded_by(point, other, cloud, horizons))
                        .map(|other| [point.min(other), point.max(other)])
                        .filter(is_held),
                );
            }
            pairs
        });
        drop(tree);
        Self::from_ends(in_order(found, cloud.len()), cloud, horizons)
    }

    /// Bonds between the given pairs of points (A < B, ascending, each once), whatever their distance.
    fn from_ends(ends: Vec<[u32; 2]>, cloud: &PointCloud<D>, horizons: &Horizons) -> Self {
        let positions = |bond: usize| ends[bond].map(|end| cloud.positions[end as usize]);
        let length = parallel::values(ends.len(), 0.0, |bond| {
            let [a, b] = positions(bond);
            distance(a, b)
        });
        let direction = parallel::values(ends.len(), [0.0; D], |bond| {
            let [a, b] = positions(bond);
            minus(b, a).map(|it| it / length[bond])
        });
        let horizon = parallel::values(ends.len(), 0.0, |bond| {
            bond_horizon(ends[bond], length[bond], cloud, horizons)
        });
        let incidence = Incidence::new(&ends, cloud.len());
        Self {
            ends: ends.into(),
            length,
            direction,
            horizon: horizon.into(),
            incidence: incidence.into(),
            composition: Composition::default(),
        }
    }
}

/// Points along the curve whose horizons may reach owned points, including these.
fn reaching<'a, const D: usize>(cloud: &'a PointCloud<D>, horizons: &Horizons) -> Cow<'a, [u32]> {
    let subdomain = &cloud.subdomain;
    if subdomain.is_whole() {
        return Cow::Borrowed(&cloud.curve);
    }
    let owned = subdomain.owned();
    let [lower, upper] = bounding_box(owned.map(|it| cloud.positions[it as usize]));
    let reaches = |point: u32| {
        let position = cloud.positions[point as usize];
        let nearest = std::array::from_fn(|axis| position[axis].max(lower[axis]).min(upper[axis]));
        contains(point, distance(position, nearest), cloud, horizons)
    };
    let points = cloud.curve.iter().copied();
    points
        .filter(|&it| subdomain.owns(it) || reaches(it))
        .collect()
}

/// Pairs in ascending order of their first, then of their second point.
fn in_order(found: Vec<Vec<[u32; 2]>>, n_points: usize) -> Vec<[u32; 2]> {
    let mut next = vec![0; n_points + 1];
    for [first, _] in found.iter().flatten() {
        next[*first as usize + 1] += 1;
    }
    for point in 0..n_points {
        next[point + 1] += next[point];
    }
    let mut ends = vec![[0; 2]; next[n_points]];
    for pair in found.into_iter().flatten() {
        let place = &mut next[pair[0] as usize];
        ends[*place] = pair;
        *place += 1;
    }
    ends.par_chunk_by_mut(|one, other| one[0] == other[0])
        .for_each(<[_]>::sort_unstable);
    ends
}

/// Whether the query around `point` records the pair: the query of the lower point does where its horizon contains the other, else the query of the
/// upper point.
fn is_recorded_by<const D: usize>(
    point: u32,
    neighbour: u32,
    cloud: &PointCloud<D>,
    horizons: &Horizons,
) -> bool {
    let l = distance(
        cloud.positions[point as usize],
        cloud.positions[neighbour as usize],
    );
    neighbour != point
        && contains(point, l, cloud, horizons)
        && (point < neighbour || !contains(neighbour, l, cloud, horizons))
}

/// Whether the horizon of a point reaches to a given distance (m) from it, within the precision of the coordinates.
fn contains<const D: usize>(
    point: u32,
    distance: f64,
    cloud: &PointCloud<D>,
    horizons: &Horizons,
) -> bool {
    distance <= horizons.radius[point as usize] * (1.0 + cloud.tolerance(point))
}

fn bond_horizon<const D: usize>(
    [a, b]: [u32; 2],
    length: f64,
    cloud: &PointCloud<D>,
    horizons: &Horizons,
) -> f64 {
    let (h_a, h_b) = (horizons.radius[a as usize], horizons.radius[b as usize]);
    if contains(a, length, cloud, horizons) && contains(b, length, cloud, horizons) {
        0.5 * (h_a + h_b)
    } else {
        h_a.max(h_b)
    }
}
