//! Facets near integration points, searched anew when surfaces have moved by more than a skin.

use rayon::prelude::*;
use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};

use super::Corners;
use crate::geometry::bounding_box;
use crate::tensor::{dot, minus};

/// Integration points with facets near them, as found at the last search. What is found does not change results: it contains at least all
/// facets within reach.
#[derive(Debug, Clone, Default)]
pub struct Search {
    /// Positions of all corners at the last search, m.
    since: Vec<f64>,
    /// Integration points with their ranges of `facets`.
    places: Vec<(u32, [u32; 2])>,
    facets: Vec<u32>,
}

impl Search {
    /// Whether a corner has moved so far since the last search that facets within reach may be missing: by half of the skin (m).
    pub(super) fn is_old<const D: usize>(&self, corners: &[Corners<D>], skin: f64) -> bool {
        let now = corners.as_flattened();
        if self.since.len() != D * now.len() {
            return true;
        }
        let (before, _) = self.since.as_chunks::<D>();
        let moved = |(now, before): (&[f64; D], &[f64; D])| {
            let way = minus(*now, *before);
            dot(way, way) > 0.25 * skin * skin
        };
        now.par_iter().zip(before).any(moved)
    }

    /// Searches the facets whose box is within a distance (m) of each integration point; of the facet with an integration point,
    /// `may_meet` says whether the other facet counts.
    pub(super) fn renew<const D: usize>(
        &mut self,
        corners: &[Corners<D>],
        positions: &(impl Fn(u32) -> [f64; D] + Sync),
        within: f64,
        may_meet: &(impl Fn(u32, u32) -> bool + Sync),
    ) {
        let boxed = |(facet, corners): (u32, &Corners<D>)| {
            let [lower, upper] = bounding_box(*corners);
            GeomWithData::new(Rectangle::from_corners(lower, upper), facet)
        };
        let tree = RTree::bulk_load((0..).zip(corners).map(boxed).collect());
        let near = |place: u32| {
            let position = positions(place);
            let [lower, upper] = [-within, within].map(|by| position.map(|x| x + by));
            let found = tree.locate_in_envelope_intersecting(AABB::from_corners(lower, upper));
            let own = place / D as u32;
            let others = found.map(|it| it.data);
            let mut others: Vec<u32> = others.filter(|&it| may_meet(own, it)).collect();
            others.sort_unstable();
            (!others.is_empty()).then_some((place, others))
        };
        let n_places = (D * corners.len()) as u32;
        let found: Vec<(u32, Vec<u32>)> = (0..n_places).into_par_iter().filter_map(near).collect();
        self.places.clear();
        self.facets.clear();
        for (place, facets) in found {
            let first = self.facets.len() as u32;
            self.facets.extend(facets);
            self.places.push((place, [first, self.facets.len() as u32]));
        }
        self.since.clear();
        self.since.extend(corners.as_flattened().as_flattened());
    }

    /// Integration points with facets near them, ascending.
    pub(super) fn places(&self) -> &[(u32, [u32; 2])] {
        &self.places
    }

    /// Facets in a range of one of the [`places`](Self::places), ascending.
    pub(super) fn facets(&self, [first, end]: [u32; 2]) -> &[u32] {
        &self.facets[first as usize..end as usize]
    }
}
