//! Crack lines along the open faces.

use std::collections::HashMap;

use super::faces::{FaceState, Faces, distance};
use super::paths::{Corner, CrackPath, Graph, ShortestPaths};
use super::smooth::smooth;

/// A crack, or a branch of one, as a line.
#[derive(Debug, Clone, PartialEq)]
pub struct CrackLine {
    /// Positions along the line, two or more, m.
    pub places: Vec<[f64; 2]>,
    /// Kinds of the first and the last end of the line.
    pub ends: [CrackEnd; 2],
}

/// Kind of the end of a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CrackEnd {
    /// Tip in the body, from which the crack can grow.
    Tip,
    /// End at the outline of the body or of a hole.
    Outline,
    /// End at a pre-crack.
    PreCrack,
    /// Junction with another line, from which this one branches off.
    Junction,
}

impl CrackEnd {
    /// Keyword of the kind in files.
    pub fn word(self) -> &'static str {
        match self {
            Self::Tip => "tip",
            Self::Outline => "outline",
            Self::PreCrack => "pre-crack",
            Self::Junction => "junction",
        }
    }
}

impl CrackLine {
    /// Length, m.
    pub fn length(&self) -> f64 {
        let pairs = self.places.windows(2);
        pairs.map(|pair| distance(pair[0], pair[1])).sum()
    }

    /// Arc length at each position of the line, m.
    pub fn along(&self) -> Vec<f64> {
        let pairs = self.places.windows(2);
        let steps = pairs.map(|pair| distance(pair[0], pair[1]));
        let sums = steps.scan(0.0, |sum, step| {
            *sum += step;
            Some(*sum)
        });
        std::iter::once(0.0).chain(sums).collect()
    }

    /// Heights y at which the line passes an abscissa x, from its first end to its last, m.
    pub fn heights_at(&self, x: f64) -> impl Iterator<Item = f64> {
        self.places.windows(2).filter_map(move |piece| {
            let [[from, low], [to, high]] = [piece[0], piece[1]];
            let share = (x - from) / (to - from);
            (0.0..=1.0)
                .contains(&share)
                .then_some(low + share * (high - low))
        })
    }

    /// Mean height y of the line over a range of x, m; None where it does not lead from one end of the range to the other. Where the line
    /// turns back, every passage counts by its extent along x.
    pub fn mean_height(&self, [from, to]: [f64; 2]) -> Option<f64> {
        let reaches = |x: f64| self.heights_at(x).next().is_some();
        if !(reaches(from) && reaches(to)) {
            return None;
        }
        if from == to {
            let heights: Vec<f64> = self.heights_at(from).collect();
            return Some(heights.iter().sum::<f64>() / heights.len() as f64);
        }
        let (mut area, mut extent) = (0.0, 0.0);
        for piece in self.places.windows(2) {
            let [a, b] = [piece[0], piece[1]];
            let [left, right] = [a[0].min(b[0]).max(from), a[0].max(b[0]).min(to)];
            if left < right {
                let slope = (b[1] - a[1]) / (b[0] - a[0]);
                area += (right - left) * (a[1] + slope * (0.5 * (left + right) - a[0]));
                extent += right - left;
            }
        }
        Some(area / extent)
    }

    /// Positions of the tips, m: none, one or two.
    pub fn tips(&self) -> impl Iterator<Item = [f64; 2]> {
        let places = [self.places.first(), self.places.last()];
        let ends = places.into_iter().flatten().zip(self.ends);
        ends.filter(|(_, end)| *end == CrackEnd::Tip)
            .map(|(place, _)| *place)
    }
}

/// Cracks of a body, from the states of its faces (n_faces) and the horizons of its points (n_points), m: the longest line of each connected
/// part before its branches, in the order of the faces.
pub fn crack_lines(faces: &Faces, states: &[FaceState], horizon: &[f64]) -> Vec<CrackLine> {
    let graph = Graph::new(faces, states, horizon).with_bridges();
    let lines_of = |component: Vec<u32>| {
        let tracer = Tracer {
            graph: &graph,
            component,
        };
        tracer.lines()
    };
    graph.components().into_iter().flat_map(lines_of).collect()
}

/// Traces the lines of a connected part of the open faces.
struct Tracer<'a> {
    graph: &'a Graph,
    component: Vec<u32>,
}

impl Tracer<'_> {
    /// Lines of the part; none where it is no crack.
    fn lines(&self) -> Vec<CrackLine> {
        if !self.graph.is_long(&self.component, 1.0) {
            return Vec::new();
        }
        let paths = self.paths();
        let lines = self.smooth_lines(&paths);
        let longest_path = &paths[0];
        let is_crack = self.kind_of_end(longest_path.corners[0]) == CrackEnd::PreCrack
            || lines[0].length() >= self.corner(longest_path.corners[0]).horizon;
        if is_crack { lines } else { Vec::new() }
    }

    /// Paths of the lines, one or more.
    fn paths(&self) -> Vec<CrackPath> {
        let longest_path = self.longest_path();
        let mut remaining = self.component.clone();
        self.remove_near(&mut remaining, &longest_path);
        let mut paths = vec![longest_path];
        while !remaining.is_empty() {
            let starts: Vec<u32> = paths.iter().flat_map(|it| &it.corners).copied().collect();
            let from_lines = self.graph.shortest_paths_from(&starts);
            let end = farthest(&remaining, |it| from_lines.length[it as usize]);
            let branch = self.graph.path_to(&from_lines, end);
            remaining.retain(|it| *it != end);
            self.remove_near(&mut remaining, &branch);
            let root = branch.corners[0];
            let is_tip = self.kind_of_end(root) == CrackEnd::Tip;
            let longer = paths
                .iter_mut()
                .find(|path| is_tip && path.ends().contains(&root));
            match longer {
                Some(path) => path.append(branch),
                None => paths.push(branch),
            }
        }
        paths
    }

    /// The shortest path between two corners far from each other, with its ends moved to a pre-crack or the outline nearby; from a pre-crack
    /// where there is one.
    fn longest_path(&self) -> CrackPath {
        let is_cut = |&&it: &&u32| self.corner(it).is_cut;
        let mut starts: Vec<u32> = self.component.iter().filter(is_cut).copied().collect();
        if starts.is_empty() {
            starts.clone_from(&self.component);
        }
        let from_any = self.graph.shortest_paths_from(&starts[..1]);
        let end = farthest(&self.component, |it| self.distance_between(starts[0], it));
        let end = self.line_end(end, starts[0], &from_any);
        let from_end = self.graph.shortest_paths_from(&[end]);
        let start = farthest(&starts, |it| self.distance_between(end, it));
        let start = self.line_end(start, end, &from_end);
        self.graph.path_to(&from_end, start).reversed()
    }

    /// End corner of a line near a corner: at a pre-crack within the horizon, if there are several on the shortest path from the `other` end;
    /// or else at the outline, nearest to the corner; or else the corner itself. Corners within a horizon of the other end are left out.
    fn line_end(&self, corner: u32, other: u32, from_other: &ShortestPaths) -> u32 {
        let reach = self.corner(corner).horizon;
        let from_here = self.graph.shortest_paths_from(&[corner]);
        let is_near = |it: u32| {
            from_here.length[it as usize] <= reach && self.distance_between(other, it) > reach
        };
        let near: Vec<u32> = (self.component.iter().copied())
            .filter(|&it| is_near(it))
            .collect();
        let nearest = |paths: &ShortestPaths, holds: &dyn Fn(&Corner) -> bool| {
            let candidates = near.iter().copied().filter(|&it| holds(self.corner(it)));
            candidates
                .min_by(|&a, &b| paths.length[a as usize].total_cmp(&paths.length[b as usize]))
        };
        let at_cut = nearest(from_other, &|it| it.is_cut);
        let at_outline = || nearest(&from_here, &|it| it.is_outside);
        at_cut.or_else(at_outline).unwrap_or(corner)
    }

    /// Removes from some corners those within a horizon of a path.
    fn remove_near(&self, remaining: &mut Vec<u32>, path: &CrackPath) {
        let is_near = |it: u32| {
            let reach = self.corner(it).horizon;
            path.corners
                .iter()
                .any(|&on| self.distance_between(on, it) <= reach)
        };
        remaining.retain(|&it| !is_near(it));
    }

    /// Smooth lines along the paths: a branch begins on the smooth line that it branches off from.
    fn smooth_lines(&self, paths: &[CrackPath]) -> Vec<CrackLine> {
        let mut places_of: HashMap<u32, [f64; 2]> = HashMap::new();
        let mut lines = Vec::new();
        for path in paths {
            let horizons = path.corners.iter().map(|&it| self.corner(it).horizon);
            let reach = horizons.sum::<f64>() / path.corners.len() as f64;
            let mut places = smooth(&path.places, reach);
            let mut ends = path.ends().map(|it| self.kind_of_end(it));
            if let (Some(root), Some(first)) = (places_of.get(&path.corners[0]), places.first_mut())
            {
                *first = *root;
                ends[0] = CrackEnd::Junction;
            }
            for (&corner, &place) in path.corners.iter().zip(places.iter().step_by(2)) {
                places_of.entry(corner).or_insert(place);
            }
            lines.push(CrackLine { places, ends });
        }
        lines
    }

    fn kind_of_end(&self, corner: u32) -> CrackEnd {
        let corner = self.corner(corner);
        match (corner.is_cut, corner.is_outside) {
            (true, _) => CrackEnd::PreCrack,
            (false, true) => CrackEnd::Outline,
            (false, false) => CrackEnd::Tip,
        }
    }

    fn corner(&self, number: u32) -> &Corner {
        &self.graph.corners[number as usize]
    }

    /// Distance between two corners, m.
    fn distance_between(&self, a: u32, b: u32) -> f64 {
        distance(self.corner(a).place, self.corner(b).place)
    }
}

/// The corner with the largest value among one or more, the first of several.
fn farthest(corners: &[u32], value: impl Fn(u32) -> f64) -> u32 {
    let farther = |best: u32, corner: u32| {
        if value(corner) > value(best) {
            corner
        } else {
            best
        }
    };
    corners.iter().copied().fold(corners[0], farther)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(places: &[[f64; 2]]) -> CrackLine {
        CrackLine {
            places: places.to_vec(),
            ends: [CrackEnd::Outline, CrackEnd::Tip],
        }
    }

    /// A path that rises by 0.2 over 2 and stays: means by hand; binary fractions, so that rounding is some units of the last place.
    #[test]
    fn the_height_of_a_path_is_its_mean_over_the_range() {
        let path = line(&[[0.0, 1.0], [2.0, 1.5], [4.0, 1.5]]);
        assert_eq!(path.mean_height([0.0, 2.0]), Some(1.25));
        assert_eq!(path.mean_height([1.0, 3.0]), Some(0.5 * (1.375 + 1.5)));
        assert_eq!(path.mean_height([1.0, 1.0]), Some(1.25));
        assert_eq!(path.mean_height([3.0, 4.5]), None, "it ends before");
        let backwards = line(&[[4.0, 1.5], [2.0, 1.5], [0.0, 1.0]]);
        assert_eq!(
            backwards.mean_height([0.0, 4.0]),
            path.mean_height([0.0, 4.0])
        );
    }

    /// A path that turns back at x = 3 passes the range from 2 to 3 twice, at 0 and at 1.
    #[test]
    fn a_path_that_turns_back_counts_every_passage() {
        let path = line(&[[0.0, 0.0], [3.0, 0.0], [3.0, 1.0], [2.0, 1.0]]);
        assert_eq!(path.mean_height([2.0, 3.0]), Some(0.5));
        assert_eq!(path.heights_at(2.5).collect::<Vec<_>>(), [0.0, 1.0]);
    }
}
