//! Sides of a crack on which the corners of a tetrahedron lie.

use std::collections::HashMap;

use super::tetrahedra::{EDGES, Tetrahedra};

/// Connection of two neighbouring points.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Link {
    /// An unbroken bond.
    Whole,
    /// No bond: the points are farther apart than their horizons.
    Unbonded,
    /// Bond cut by a pre-crack.
    PreCrack,
    /// Broken bond.
    Open,
}

/// Connections of pairs of points; an unbroken bond for all others.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Links {
    named: HashMap<[u32; 2], Link>,
}

impl Link {
    /// Whether a crack or a pre-crack separates the points.
    pub fn is_cut(self) -> bool {
        matches!(self, Self::PreCrack | Self::Open)
    }
}

impl Links {
    /// Sets the connection of two points.
    pub fn name(&mut self, [a, b]: [u32; 2], link: Link) {
        self.named.insert([a.min(b), a.max(b)], link);
    }

    /// Connection of two points; whole for a point with itself.
    pub fn between(&self, [a, b]: [u32; 2]) -> Link {
        let named = self.named.get(&[a.min(b), a.max(b)]);
        named.copied().unwrap_or(Link::Whole)
    }
}

/// Side of each corner of a tetrahedron, numbered from 0 in the order of the corners.
pub(super) fn sides(tetrahedra: &Tetrahedra, links: &Links, corners: &[u32; 4]) -> [u8; 4] {
    let links = EDGES.map(|ends| links.between(tetrahedra.pair(corners, ends)));
    if links.iter().all(|link| !link.is_cut()) {
        return [0; 4];
    }
    let bonded = connected_groups(|edge| links[edge] != Link::Unbonded);
    connected_groups(|edge| match links[edge] {
        Link::Whole => true,
        Link::Unbonded => bonded[EDGES[edge][0]] != bonded[EDGES[edge][1]],
        Link::PreCrack | Link::Open => false,
    })
}

/// Groups of corners connected by edges, numbered from 0 in the order of the corners.
fn connected_groups(connects: impl Fn(usize) -> bool) -> [u8; 4] {
    let mut lowest = [0, 1, 2, 3];
    // Paths have at most three edges.
    for _ in 0..3 {
        for (edge, [a, b]) in EDGES.into_iter().enumerate() {
            if connects(edge) {
                let low = lowest[a].min(lowest[b]);
                (lowest[a], lowest[b]) = (low, low);
            }
        }
    }
    let mut numbers = [0; 4];
    let mut count = 0;
    for corner in 0..4 {
        if lowest[corner] == corner {
            numbers[corner] = count;
            count += 1;
        } else {
            numbers[corner] = numbers[lowest[corner]];
        }
    }
    numbers
}

#[cfg(test)]
mod tests {
    use super::*;

    fn single() -> Tetrahedra {
        Tetrahedra {
            nodes: vec![[0.0; 3]; 4],
            points: vec![0, 1, 2, 3],
            corners: vec![[0, 1, 2, 3]],
            cells: vec![0],
            held: vec![false; 4],
        }
    }

    fn sides_with(named: &[([u32; 2], Link)]) -> [u8; 4] {
        let mut links = Links::default();
        for (pair, link) in named {
            links.name(*pair, *link);
        }
        sides(&single(), &links, &[0, 1, 2, 3])
    }

    #[test]
    fn corners_are_on_one_side_where_edges_connect_them() {
        use Link::{Open, PreCrack, Unbonded};
        assert_eq!(sides_with(&[]), [0; 4]);
        assert_eq!(sides_with(&[([0, 1], Open)]), [0; 4], "round about over 2");
        let around_two = [([2, 0], Open), ([1, 2], PreCrack), ([2, 3], Open)];
        assert_eq!(sides_with(&around_two), [0, 0, 1, 0]);
        let all: Vec<_> = EDGES.map(|[a, b]| ([a as u32, b as u32], Open)).to_vec();
        assert_eq!(sides_with(&all), [0, 1, 2, 3]);
        // The edge between 2 and 3 has no bond: it reconnects no corners that bonds connected, but connects 3 to 2 where bonds never did.
        assert_eq!(
            sides_with(&[([0, 2], Open), ([1, 2], Open), ([2, 3], Unbonded)]),
            [0, 0, 1, 0]
        );
        let far = [([0, 3], Unbonded), ([1, 3], Unbonded), ([2, 3], Unbonded)];
        let cut = [([0, 1], Open), ([0, 2], Open)];
        assert_eq!(sides_with(&[&far[..], &cut[..]].concat()), [0; 4]);
    }
}
