//! Search for neighbouring facets, repeated when surfaces have moved by more than a skin.

use std::collections::BTreeMap;

use super::Corners;
use crate::geometry::bounding_box;
use crate::parallel;
use crate::tensor::{dot, minus};

/// Number of a box of space along each axis.
type Place = [i64; 3];

/// Size of the box around a facet over the distance within which facets are near, beyond which it is not one of small strains any more and has
/// none near it.
const TORN: f64 = 4.0;

/// Present facets of a surface with their neighbours at the last search. The neighbours contain at least all facets within reach, so that the time of
/// a search does not change results.
#[derive(Debug, Clone, Default)]
pub struct Search {
    /// Numbers of the facets, in the order in which they joined the surface.
    facets: Vec<u32>,
    /// Positions of the corners of the facets when they were found, m; shorter than the facets before a search.
    since: Vec<f64>,
    /// For each facet those near it, as places in `facets`, by their numbers.
    near: Vec<Vec<u32>>,
    /// The facets in boxes of space, as places in `facets`, each in as many as a facet that is not [torn](TORN) reaches into.
    boxes: BTreeMap<Place, Vec<u32>>,
}

/// Input of a search.
pub(super) struct Sought<'a, const D: usize> {
    /// Present corners of the facets, by their places, m.
    pub(super) corners: &'a [Corners<D>],
    /// Distance between the boxes around facets that count as near, m.
    pub(super) within: f64,
    /// Whether contact between two facets is possible, by their numbers.
    pub(super) may_meet: &'a (dyn Fn(u32, u32) -> bool + Sync),
}

impl Search {
    /// Adds facets to the surface.
    pub(super) fn join(&mut self, facets: impl IntoIterator<Item = u32>) {
        self.facets.extend(facets);
    }

    /// Numbers of the facets of the surface so far, by their places.
    pub(super) fn facets(&self) -> &[u32] {
        &self.facets
    }

    /// Facets near that at a place, as places, by their numbers.
    pub(super) fn neighbours(&self, place: usize) -> &[u32] {
        &self.near[place]
    }

    /// Updates the neighbours: of all facets if a corner has moved by half of the skin (m) since the last search, otherwise of added facets.
    pub(super) fn update<const D: usize>(&mut self, sought: &Sought<'_, D>, skin: f64) {
        if self.is_old(sought.corners, skin) {
            self.since.clear();
            self.near.clear();
            self.boxes.clear();
        }
        let first = self.near.len();
        if first == self.facets.len() {
            return;
        }
        for (place, corners) in (0..).zip(sought.corners).skip(first) {
            let at = sought.is_whole(corners).then(|| bounding_box(*corners));
            for at in at.into_iter().flat_map(|it| places(it, sought.within)) {
                self.boxes.entry(at).or_default().push(place);
            }
        }
        let found = parallel::values(self.facets.len() - first, Vec::new(), |number| {
            self.find_neighbours(first + number, sought)
        });
        for (place, others) in (first as u32..).zip(&found) {
            for &other in others.iter().filter(|it| (**it as usize) < first) {
                let facets = &self.facets;
                let near = &mut self.near[other as usize];
                let number = |it: u32| facets[it as usize];
                let at = near.partition_point(|&it| number(it) < number(place));
                near.insert(at, place);
            }
        }
        self.near.extend(found);
        let added = &sought.corners[first..];
        self.since.extend(added.as_flattened().as_flattened());
    }

    /// Whether a corner has moved so far since the last search that facets within reach may be missing: by half of the skin (m), or to or from a
    /// position that is not a number.
    fn is_old<const D: usize>(&self, corners: &[Corners<D>], skin: f64) -> bool {
        let (before, _) = self.since.as_chunks::<D>();
        let moved = |(now, before): (&[f64; D], &[f64; D])| {
            let way = minus(*now, *before);
            let square = dot(way, way);
            square.is_nan() || square > 0.25 * skin * skin
        };
        let now = &corners.as_flattened()[..before.len()];
        now.iter().zip(before).any(moved)
    }

    /// Facets whose box is near the box of the facet at a place, by their numbers.
    fn find_neighbours<const D: usize>(&self, place: usize, sought: &Sought<'_, D>) -> Vec<u32> {
        if !sought.is_whole(&sought.corners[place]) {
            return Vec::new();
        }
        let [lower, upper] = bounding_box(sought.corners[place]);
        let within = sought.within;
        let wide = [lower.map(|x| x - within), upper.map(|x| x + within)];
        let is_near = |other: u32| {
            let [low, high] = bounding_box(sought.corners[other as usize]);
            (0..D).all(|axis| low[axis] <= wide[1][axis] && wide[0][axis] <= high[axis])
        };
        let own = self.facets[place];
        let boxes = places(wide, within).filter_map(|at| self.boxes.get(&at));
        let mut others: Vec<u32> = boxes.flatten().copied().collect();
        others.sort_unstable_by_key(|&it| self.facets[it as usize]);
        others.dedup();
        let meets = |it: u32| (sought.may_meet)(own, self.facets[it as usize]);
        others.retain(|&it| it as usize != place && is_near(it) && meets(it));
        others
    }
}

impl<const D: usize> Sought<'_, D> {
    /// Whether a facet with these corners can be near others.
    fn is_whole(&self, corners: &Corners<D>) -> bool {
        let [lower, upper] = bounding_box(*corners);
        (0..D).all(|axis| upper[axis] - lower[axis] <= TORN * self.within)
    }
}

/// Cells of a grid of a width (m) that a box intersects.
fn places<const D: usize>([lower, upper]: [[f64; D]; 2], size: f64) -> impl Iterator<Item = Place> {
    let along = |axis: usize| {
        let at = |corner: &[f64; D]| corner.get(axis).map_or(0, |x| (x / size).floor() as i64);
        at(&lower)..=at(&upper)
    };
    let [x, y, z] = [0, 1, 2].map(along);
    x.flat_map(move |x| {
        let z = z.clone();
        y.clone()
            .flat_map(move |y| z.clone().map(move |z| [x, y, z]))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A row of 60 segments of 1 m, of which each third has flown away, torn or whole, as far as numbers go or beyond: those that are whole find the
    /// same neighbours as a comparison of all boxes, and the grid has no more entries than a segment of four times the distance reaches into.
    #[test]
    fn what_flies_away_takes_no_memory() {
        let ways = [0.0, 3.0, 1e3, 1e9, 1e300, f64::INFINITY, f64::NAN];
        for (one, other) in ways.iter().flat_map(|one| ways.map(|other| (*one, other))) {
            let segment = |place: usize| {
                let x = place as f64;
                let [start, end] = match place % 3 {
                    0 => [one, other],
                    _ => [0.0; 2],
                };
                [[x + start, -start], [x + 1.0 + end, 0.0]]
            };
            let corners: Vec<Corners<2>> = (0..60).map(segment).collect();
            let sought = Sought {
                corners: &corners,
                within: 1.5,
                may_meet: &|_, _| true,
            };
            let mut search = Search::default();
            search.join(0..60);
            search.update(&sought, 0.5);
            let entries: usize = search.boxes.values().map(Vec::len).sum();
            assert!(entries <= 60 * 25, "{entries} boxes");
            let is_near = |place: usize, other: &usize| {
                let [one, another] = [place, *other].map(|it| bounding_box(corners[it]));
                let wide = [one[0].map(|x| x - 1.5), one[1].map(|x| x + 1.5)];
                place != *other && crate::geometry::boxes_meet(wide, another)
            };
            for place in (0..60).filter(|place| place % 3 != 0) {
                let still = (0..60).filter(|it| it % 3 != 0);
                let expected: Vec<u32> = still
                    .filter(|it| is_near(place, it))
                    .map(|it| it as u32)
                    .collect();
                let found = search.neighbours(place).iter().filter(|it| **it % 3 != 0);
                assert!(found.copied().eq(expected), "{place}");
            }
        }
    }

    /// A search in which a position was no number is made anew when it is one again.
    #[test]
    fn a_lost_position_is_searched_anew() {
        let row = |x: f64| [[[0.0, 0.0], [1.0, 0.0]], [[x, 0.1], [1.0, 0.1]]];
        let mut search = Search::default();
        search.join(0..2);
        for (x, near) in [(f64::NAN, 0), (0.0, 1)] {
            let corners = row(x).map(|it| if x.is_nan() { [[x; 2]; 2] } else { it });
            let sought = Sought {
                corners: &corners,
                within: 1.5,
                may_meet: &|_, _| true,
            };
            search.update(&sought, 0.5);
            assert_eq!(search.neighbours(0).len(), near);
        }
    }
}
