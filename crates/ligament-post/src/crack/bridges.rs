//! Bridges over the gaps between parts of a crack.

use std::collections::BTreeMap;

use rstar::RTree;
use rstar::primitives::GeomWithData;

use super::faces::distance;
use super::paths::{Corner, Graph};

impl Graph {
    /// The graph with straight edges over the gaps between its parts that are no wider than a horizon, the narrowest first, as long as they
    /// connect separate parts. Parts shorter than half a horizon without a pre-crack are left alone.
    pub(super) fn with_bridges(mut self) -> Self {
        let mut part = vec![None; self.corners.len()];
        for (number, component) in self.components().iter().enumerate() {
            if self.is_long(component, 0.5) {
                for &corner in component {
                    part[corner as usize] = Some(number);
                }
            }
        }
        for [a, b] in self.gaps(&part) {
            let [kept, joined] = [a, b].map(|it| part[it as usize]);
            if kept != joined {
                self.add_straight_edge([a, b]);
                let of_joined = part.iter_mut().filter(|it| **it == joined);
                of_joined.for_each(|it| *it = kept);
            }
        }
        self
    }

    /// Whether a connected part touches a pre-crack, or its faces are together longer than a number of horizons.
    pub(super) fn is_long(&self, component: &[u32], horizons: f64) -> bool {
        let corners = || component.iter().map(|&it| &self.corners[it as usize]);
        let horizon = corners().map(|it| it.horizon).sum::<f64>() / component.len() as f64;
        corners().any(|it| it.is_cut) || self.total_length(component) >= horizons * horizon
    }

    /// Pairs of a corner and the nearest corner of every other part within a horizon, unless a pre-crack ends at both, by increasing
    /// distance.
    fn gaps(&self, part: &[Option<usize>]) -> Vec<[u32; 2]> {
        let kept = (0..).zip(&self.corners).zip(part);
        let kept: Vec<_> = kept
            .filter_map(|((number, it), part)| {
                Some(GeomWithData::new(it.place, (number, (*part)?)))
            })
            .collect();
        let tree = RTree::bulk_load(kept.clone());
        let mut gaps = Vec::new();
        for entry in &kept {
            let (number, part) = entry.data;
            let corner: &Corner = &self.corners[number as usize];
            let mut nearest: BTreeMap<usize, (f64, u32)> = BTreeMap::new();
            for other in tree.locate_within_distance(corner.place, corner.horizon.powi(2)) {
                let (far, of) = other.data;
                let both_cut = corner.is_cut && self.corners[far as usize].is_cut;
                if of == part || both_cut {
                    continue;
                }
                let found = (distance(corner.place, *other.geom()), far);
                let best = nearest.entry(of).or_insert(found);
                if found < *best {
                    *best = found;
                }
            }
            gaps.extend(nearest.into_values().map(|(gap, far)| (gap, [number, far])));
        }
        gaps.sort_by(|(one, ends), (other, others)| one.total_cmp(other).then(ends.cmp(others)));
        gaps.into_iter().map(|(_, ends)| ends).collect()
    }
}
