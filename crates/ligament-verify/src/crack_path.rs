//! Start, extent and path of a crack, from the broken bonds and the resulting damage.
//!
//! Apart from the height of its line independent of the lines of [`ligament_post::crack`]: published tables and the page of the papers were measured
//! by points of large damage, which also show cracks that branch, crush or are shorter than a horizon, while lines omit such parts.

use std::collections::BTreeMap;

use ligament::Model;
use ligament::run::Solution;
use ligament_analysis::Observer;
use ligament_analysis::fields::{damage, point_damage};
use ligament_analysis::history::{BreakRecord, ObserverError, StepRecord, View};
use ligament_post::crack::{CrackLine, FaceState, Faces, crack_lines};

/// Damage (NHPD eq. 17) above which a point belongs to a crack: a straight cut beside a point gives up to one half.
pub(super) const CRACKED_DAMAGE: f64 = 0.3;

/// An observer that collects all breakages in their order.
#[derive(Debug, Default)]
pub(super) struct Breakages {
    /// Records of the breakages.
    pub(super) records: Vec<BreakRecord>,
}

impl Observer for Breakages {
    fn broke(&mut self, records: &[BreakRecord]) -> Result<(), ObserverError> {
        self.records.extend_from_slice(records);
        Ok(())
    }

    fn step(&mut self, _: &StepRecord, _: &View<'_>) -> Result<(), ObserverError> {
        Ok(())
    }
}

/// A position with its horizon.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct CrackPoint {
    /// Coordinates, m.
    pub(super) at: [f64; 2],
    /// Horizon, m.
    pub(super) horizon: f64,
}

/// A straight line between two positions, m.
pub(super) type Segment = [[f64; 2]; 2];

/// The cracked points of a body.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Crack {
    /// Points with a damage above [`CRACKED_DAMAGE`].
    pub(super) points: Vec<CrackPoint>,
}

/// Distances of a crack from its image after half a turn about the origin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct HalfTurn {
    /// Mean distance of a turned point from the nearest point of the crack, m.
    pub(super) mean: f64,
    /// Largest distance of a turned point from the nearest point of the crack, m.
    pub(super) largest: f64,
}

/// Midpoint of a bond, with its horizon.
pub(super) fn middle(model: &Model, bond: usize) -> CrackPoint {
    let [a, b] = ends(model, bond);
    CrackPoint {
        at: [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])],
        horizon: model.plane().bonds.horizon[bond],
    }
}

/// Positions of the ends of a bond, m.
pub(super) fn ends(model: &Model, bond: usize) -> Segment {
    model.plane().bonds.ends[bond].map(|end| place(model, end as usize))
}

fn place(model: &Model, point: usize) -> [f64; 2] {
    let cloud = &model.plane().cloud;
    let [x, y] = cloud.positions[point];
    [x + cloud.origin[0], y + cloud.origin[1]]
}

/// Distance of a position from a segment, m.
pub(super) fn distance([x, y]: [f64; 2], [from, to]: Segment) -> f64 {
    let along = [to[0] - from[0], to[1] - from[1]];
    let offset = [x - from[0], y - from[1]];
    let squared = along[0] * along[0] + along[1] * along[1];
    let share = match squared {
        0.0 => 0.0,
        _ => ((offset[0] * along[0] + offset[1] * along[1]) / squared).clamp(0.0, 1.0),
    };
    (offset[0] - share * along[0]).hypot(offset[1] - share * along[1])
}

impl Crack {
    /// The crack after these breakages.
    pub(super) fn from_breakages(model: &Model, records: &[BreakRecord]) -> Self {
        let mut intact = vec![true; model.plane().bonds.len()];
        for record in records {
            intact[record.bond as usize] = false;
        }
        let damage = damage(&**model.plane(), &intact);
        let cracked = (0..damage.len()).filter(|&point| damage[point] > CRACKED_DAMAGE);
        let points = cracked.map(|point| CrackPoint {
            at: place(model, point),
            horizon: model.fixed.horizon[point],
        });
        Self {
            points: points.collect(),
        }
    }

    /// The first cracked point: the first point whose damage exceeds [`CRACKED_DAMAGE`].
    pub(super) fn first_point(model: &Model, records: &[BreakRecord]) -> Option<CrackPoint> {
        let count = |until: usize| Self::from_breakages(model, &records[..until]).points.len();
        // Damage only grows, so that the breakage that cracks the first point is found by bisection.
        let (mut none, mut some) = (0, records.len());
        if count(some) == 0 {
            return None;
        }
        while some - none > 1 {
            let half = usize::midpoint(none, some);
            if count(half) == 0 {
                none = half;
            } else {
                some = half;
            }
        }
        Self::from_breakages(model, &records[..some])
            .points
            .first()
            .copied()
    }

    /// The part of the crack whose points satisfy a condition.
    pub(super) fn part(&self, belongs: impl Fn([f64; 2]) -> bool) -> Self {
        let points = self.points.iter().copied();
        Self {
            points: points.filter(|point| belongs(point.at)).collect(),
        }
    }

    /// The part of the crack that starts at a segment: points connected to it by a chain in which each point lies in the horizon of the
    /// previous one; the segment lies in the horizon of the first.
    pub(super) fn part_from(&self, segment: Segment) -> Self {
        let is_at = |point: &CrackPoint| distance(point.at, segment) <= point.horizon;
        let mut reached: Vec<bool> = self.points.iter().map(is_at).collect();
        let mut front: Vec<usize> = (0..reached.len()).filter(|&it| reached[it]).collect();
        while let Some(last) = front.pop() {
            let current = self.points[last];
            for (next, point) in self.points.iter().enumerate() {
                let reach = current.horizon.max(point.horizon);
                if !reached[next] && distance(point.at, [current.at; 2]) <= reach {
                    reached[next] = true;
                    front.push(next);
                }
            }
        }
        let points = self.points.iter().zip(reached);
        Self {
            points: points
                .filter(|(_, is_part)| *is_part)
                .map(|(point, _)| *point)
                .collect(),
        }
    }

    /// Whether the crack joins two segments: a point of the part that starts at one segment has the other in its horizon.
    pub(super) fn connects(&self, from: Segment, to: Segment) -> bool {
        let part = self.part_from(from);
        part.points
            .iter()
            .any(|point| distance(point.at, to) <= point.horizon)
    }

    /// Distance of the nearest point of the crack from a segment, m; infinite without points.
    pub(super) fn gap_to(&self, segment: Segment) -> f64 {
        let distances = self.points.iter().map(|point| distance(point.at, segment));
        distances.fold(f64::INFINITY, f64::min)
    }

    /// Distance between the nearest points of two cracks, m; infinite where one has no points.
    pub(super) fn gap_between(&self, other: &Self) -> f64 {
        let gaps = self.points.iter().map(|point| other.gap_to([point.at; 2]));
        gaps.fold(f64::INFINITY, f64::min)
    }

    /// Mean horizon of the cracked points, m.
    pub(super) fn mean_horizon(&self) -> f64 {
        self.points.iter().map(|point| point.horizon).sum::<f64>() / self.points.len() as f64
    }

    /// Mean position of the cracked points, m; `None` without points.
    pub(super) fn centre(&self) -> Option<[f64; 2]> {
        let mean = |axis: usize| {
            self.points.iter().map(|point| point.at[axis]).sum::<f64>() / self.points.len() as f64
        };
        (!self.points.is_empty()).then(|| [mean(0), mean(1)])
    }

    /// The points of the crack up to the smaller of the distances from the origin that its parts on both sides reach, where the line through the
    /// origin across `along` divides it. `None` where one part is missing.
    pub(super) fn common_part(&self, along: [f64; 2]) -> Option<Self> {
        let reach = |sign: f64| {
            let side = self.part(|[x, y]| sign * (x * along[0] + y * along[1]) > 0.0);
            side.tip().map(|tip| radius(tip.at))
        };
        let common = reach(1.0)?.min(reach(-1.0)?);
        Some(self.part(|at| radius(at) <= common))
    }

    /// The point of the crack farthest from the origin.
    pub(super) fn tip(&self) -> Option<CrackPoint> {
        let points = self.points.iter().copied();
        points.max_by(|a, b| radius(a.at).total_cmp(&radius(b.at)))
    }

    /// Distances of the points of the [common part](Self::common_part), after half a turn about the origin, from the nearest point of the
    /// crack.
    pub(super) fn half_turn(&self, along: [f64; 2]) -> Option<HalfTurn> {
        let compared = self.common_part(along)?;
        let nearest = |at: [f64; 2]| self.gap_to([at; 2]);
        let turned = compared.points.iter().map(|point| point.at.map(|x| -x));
        let distances: Vec<f64> = turned.map(nearest).collect();
        Some(HalfTurn {
            mean: distances.iter().sum::<f64>() / distances.len() as f64,
            largest: distances.iter().copied().fold(0.0, f64::max),
        })
    }
}

fn radius([x, y]: [f64; 2]) -> f64 {
    x.hypot(y)
}

/// The lines of the cracks after these breakages, which begin where a pre-crack ends.
pub(super) fn lines(model: &Model, records: &[BreakRecord]) -> Vec<CrackLine> {
    let (bonds, n_points) = (&model.plane().bonds, model.plane().cloud.len());
    let positions: Vec<[f64; 2]> = (0..n_points).map(|point| place(model, point)).collect();
    let faces = Faces::new(&positions, &model.body().grid().canvas);
    let mut states = vec![FaceState::Whole; faces.len()];
    let broken = records.iter().map(|it| bonds.ends[it.bond as usize]);
    for face in broken.filter_map(|pair| faces.between(pair)) {
        states[face] = FaceState::Open;
    }
    crack_lines(&faces, &states, &model.fixed.horizon)
}

/// Mean height y of lines between two places along x, m; `None` where no line passes.
pub(super) fn mean_height(lines: &[CrackLine], [from, to]: [f64; 2]) -> Option<f64> {
    let pieces = lines.iter().flat_map(|line| line.places.windows(2));
    let (mut area, mut width) = (0.0, 0.0);
    for piece in pieces {
        let [[a, low], [b, high]] = [piece[0], piece[1]];
        let ends = [a.min(b).clamp(from, to), a.max(b).clamp(from, to)];
        let middle = 0.5 * (ends[0] + ends[1]);
        if ends[1] > ends[0] {
            area += (ends[1] - ends[0]) * (low + (high - low) * (middle - a) / (b - a));
            width += ends[1] - ends[0];
        }
    }
    (width > 0.0).then(|| area / width)
}

/// Share of the broken bonds that cross none of two horizontal lines, given by their heights, m.
pub(super) fn share_off_lines(solution: &Solution, lines: [f64; 2]) -> f64 {
    let (system, intact) = (solution.model.plane(), &solution.outcome.state.intact);
    let height = |point: u32| system.cloud.positions[point as usize][1];
    let crosses = |ends: &[u32; 2]| {
        let [a, b] = ends.map(height);
        lines.iter().any(|line| (a - line) * (b - line) < 0.0)
    };
    let bonds = system.bonds.ends.iter().zip(intact);
    let broken: Vec<bool> = bonds
        .filter(|(_, is_intact)| !**is_intact)
        .map(|(ends, _)| crosses(ends))
        .collect();
    let off = broken.iter().filter(|crosses| !**crosses).count();
    off as f64 / broken.len() as f64
}

/// Largest difference of the damage between a point and its mirror images about both axes.
pub(super) fn asymmetry(solution: &Solution) -> f64 {
    let (system, intact) = (solution.model.plane(), &solution.outcome.state.intact);
    let half = 0.5 * system.cloud.cell_size(0)[0];
    let places = system.cloud.positions.iter();
    let damages: BTreeMap<[i64; 2], f64> = (0..)
        .zip(places)
        .map(|(point, at)| {
            let place = at.map(|coordinate| (coordinate / half).round() as i64);
            (place, point_damage(&**system, intact, point))
        })
        .collect();
    let differences = damages.iter().flat_map(|(&[x, y], damage)| {
        let images = [[-x, y], [x, -y]].map(|image| damages.get(&image));
        images.map(|image| image.map_or(f64::NAN, |image| (damage - image).abs()))
    });
    differences.fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use ligament_post::crack::CrackEnd;

    use super::*;

    fn crack(places: &[[f64; 2]]) -> Crack {
        let points = places.iter().map(|&at| CrackPoint { at, horizon: 1.5 });
        Crack {
            points: points.collect(),
        }
    }

    #[test]
    fn a_chain_joins_what_lies_within_a_horizon_of_its_ends() {
        let row = crack(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [4.0, 0.0]]);
        let at = |x: f64| [[x, -1.0], [x, 1.0]];
        assert!(row.connects(at(-1.0), at(3.0)));
        assert!(!row.connects(at(-1.0), at(4.0)), "there is a gap of 2");
        assert!(!row.connects(at(-2.0), at(2.0)));
        let left = row.part_from(at(-1.0));
        assert_eq!([left.gap_to(at(5.0)), left.points.len() as f64], [3.0, 3.0]);
        assert_eq!(left.gap_between(&row.part_from(at(5.0))), 2.0);
        assert_eq!(left.centre(), Some([1.0, 0.0]));
        assert_eq!(distance([3.0, 4.0], [[0.0, 0.0]; 2]), 5.0);
        assert_eq!(
            distance([3.0, 4.0], [[-1.0, 0.0], [1.0, 0.0]]),
            20f64.sqrt()
        );
    }

    #[test]
    fn the_mean_height_of_a_line_is_taken_over_its_width() {
        let line = CrackLine {
            places: vec![[0.0, 0.0], [2.0, 2.0], [6.0, 2.0]],
            ends: [CrackEnd::Tip; 2],
        };
        let mean = |from: f64, to: f64| mean_height(std::slice::from_ref(&line), [from, to]);
        assert_eq!(mean(1.0, 5.0), Some((1.5 + 3.0 * 2.0) / 4.0));
        assert_eq!(mean(-9.0, 2.0), Some(1.0));
        assert_eq!(mean(7.0, 8.0), None);
    }

    #[test]
    fn a_crack_is_compared_with_its_image_as_far_as_both_sides_reach() {
        let even = crack(&[[1.0, 1.0], [2.0, 1.0], [-1.0, -1.0], [-2.0, -1.0]]);
        let found = even.half_turn([1.0, 0.0]).unwrap();
        assert_eq!([found.mean, found.largest], [0.0, 0.0]);
        let longer = crack(&[[1.0, 0.0], [2.0, 0.0], [5.0, 0.0], [-1.0, 0.5], [-2.0, 0.0]]);
        let found = longer.half_turn([1.0, 0.0]).unwrap();
        assert_eq!(
            [found.mean, found.largest],
            [0.25, 0.5],
            "5.0 is farther than -2.0"
        );
        assert_eq!(longer.tip().unwrap().at, [5.0, 0.0]);
        assert_eq!(crack(&[[1.0, 0.0]]).half_turn([1.0, 0.0]), None);
    }
}
