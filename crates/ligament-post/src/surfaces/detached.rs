//! Points whose edges are all cut, which lie in a crack.

use std::collections::{BTreeMap, BTreeSet, VecDeque};

use ligament_model::tensor::{minus, norm};

use super::sides::{Link, Links, sides};
use super::tetrahedra::{EDGES, Tetrahedra};

/// Neighbours of a detached point (all edges cut) on one side of it.
#[derive(Debug, Default)]
struct AdjacentSide {
    points: Vec<u32>,
    /// Number of these neighbours that were detached and are already assigned to a side.
    counted: usize,
    /// Distance of the nearest of these neighbours, m.
    nearest: f64,
}

/// Side of each corner of the tetrahedra, numbered from 0 in the order of the corners, shape (n_tetrahedra); all 0 where no crack passes.
pub fn sides_of_tetrahedra(tetrahedra: &Tetrahedra, links: &Links) -> Vec<[u8; 4]> {
    let links = with_detached_points_assigned(tetrahedra, links);
    let all = tetrahedra.corners.iter();
    all.map(|corners| sides(tetrahedra, &links, corners))
        .collect()
}

/// The links after every detached point, whose edges are all cut, is assigned to one of its sides, where it has one.
///
/// Points are processed in the order of their numbers, each followed by its detached neighbours. The chosen side has the most points
/// assigned before; among equal sides the nearest point, then the lowest point decides.
pub(super) fn with_detached_points_assigned(tetrahedra: &Tetrahedra, links: &Links) -> Links {
    let mut links = links.clone();
    let mut loose = detached_points(tetrahedra, &links);
    if loose.is_empty() {
        return links;
    }
    let mut around: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
    for (number, corners) in tetrahedra.corners.iter().enumerate() {
        for point in corners.map(|node| tetrahedra.points[node as usize]) {
            if loose.contains(&point) {
                around.entry(point).or_default().push(number);
            }
        }
    }
    let mut counted = BTreeSet::new();
    loop {
        let before = loose.len();
        for start in loose.clone() {
            let mut queue = VecDeque::from([start]);
            while let Some(point) = queue.pop_front() {
                if !loose.contains(&point) {
                    continue;
                }
                let near = &around[&point];
                let Some(side) = side_of(tetrahedra, &links, (point, near), (&loose, &counted))
                else {
                    continue;
                };
                side.points
                    .iter()
                    .for_each(|other| links.name([point, *other], Link::Whole));
                loose.remove(&point);
                counted.insert(point);
                let corners = near.iter().flat_map(|it| tetrahedra.corners[*it]);
                queue.extend(corners.map(|node| tetrahedra.points[node as usize]));
            }
        }
        // Points with only detached neighbours have no side.
        if loose.is_empty() || loose.len() == before {
            return links;
        }
    }
}

/// Points with cut edges and without whole edges.
fn detached_points(tetrahedra: &Tetrahedra, links: &Links) -> BTreeSet<u32> {
    let mut has_whole = tetrahedra.held.clone();
    let mut cut = BTreeSet::new();
    for corners in &tetrahedra.corners {
        for pair in EDGES.map(|ends| tetrahedra.pair(corners, ends)) {
            match links.between(pair) {
                Link::Whole if pair[0] != pair[1] => {
                    pair.iter()
                        .for_each(|point| has_whole[*point as usize] = true);
                }
                Link::PreCrack | Link::Open => cut.extend(pair),
                Link::Whole | Link::Unbonded => {}
            }
        }
    }
    cut.retain(|point| !has_whole[*point as usize]);
    cut
}

/// The side to which a detached point is assigned, from the tetrahedra around it.
fn side_of(
    tetrahedra: &Tetrahedra,
    links: &Links,
    (point, near): (u32, &[usize]),
    (loose, counted): (&BTreeSet<u32>, &BTreeSet<u32>),
) -> Option<AdjacentSide> {
    let mut side: BTreeMap<u32, u32> = BTreeMap::new();
    let mut distance: BTreeMap<u32, f64> = BTreeMap::new();
    let places = |number: &usize| {
        tetrahedra.corners[*number].map(|node| (tetrahedra.points[node as usize], node))
    };
    let own = near.iter().flat_map(places).find(|it| it.0 == point)?.1;
    let position = tetrahedra.nodes[own as usize];
    for (other, node) in near.iter().flat_map(places) {
        if other != point && !loose.contains(&other) {
            let length = norm(minus(tetrahedra.nodes[node as usize], position));
            side.entry(other).or_insert(other);
            distance
                .entry(other)
                .and_modify(|it| *it = it.min(length))
                .or_insert(length);
        }
    }
    for number in near {
        for [a, b] in EDGES.map(|ends| tetrahedra.pair(&tetrahedra.corners[*number], ends)) {
            let (Some(&of_a), Some(&of_b)) = (side.get(&a), side.get(&b)) else {
                continue;
            };
            if of_a != of_b && links.between([a, b]) == Link::Whole {
                let (low, high) = (of_a.min(of_b), of_a.max(of_b));
                side.values_mut()
                    .filter(|it| **it == high)
                    .for_each(|it| *it = low);
            }
        }
    }
    let mut sides: BTreeMap<u32, AdjacentSide> = BTreeMap::new();
    for (other, of) in &side {
        let first = AdjacentSide {
            nearest: f64::INFINITY,
            ..AdjacentSide::default()
        };
        let of = sides.entry(*of).or_insert(first);
        of.points.push(*other);
        of.counted += usize::from(counted.contains(other));
        of.nearest = of.nearest.min(distance[other]);
    }
    // The first of equal sides, which has the lowest point.
    sides.into_values().reduce(|best, it| {
        let order = (it.counted.cmp(&best.counted)).then(best.nearest.total_cmp(&it.nearest));
        if order.is_gt() { it } else { best }
    })
}
