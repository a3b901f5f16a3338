//! Interval of a line of deformations in which no criterion breaks a bond.

use super::along_line::{AlongLine, EVERYWHERE, Interval};
use super::criterion::{Criteria, Criterion};
use super::state_variables::CriteriaInState;
use crate::deformation::{Deformation, Deformations, SpaceDeformation};
use crate::element::BondDeformation;
use crate::parallel;

/// Least number of bonds for a parallel task.
const TASK: usize = 4096;

impl Criteria {
    /// The first criterion whose measure has no closed form along lines, for some bond.
    pub fn unknown_along_lines(&self) -> Option<&Criterion> {
        let is_unknown = |it: &&Criterion| {
            let mut bonds = 0..it.limit.len();
            let is_known = |bond| it.measure.is_known_along_lines(it.coefficients(bond));
            it.limits_follow_bonds() || !bonds.all(is_known)
        };
        self.list.iter().find(is_unknown)
    }
}

impl CriteriaInState<'_> {
    /// The t, within `reach`, for which no criterion breaks an intact bond with the deformation `start` + t `slopes`; None where some
    /// does for every t. `self` has the criteria at t = 0, `rates` their rates along the slopes.
    pub fn admissible(
        &self,
        rates: &Self,
        intact: &[bool],
        [start, slopes]: [&Deformations; 2],
        reach: Interval,
    ) -> Option<Interval> {
        let line = [start, slopes];
        if SpaceDeformation::of_bonds(start).is_empty() {
            self.admissible_along(rates, intact, line.map(BondDeformation::of_bonds), reach)
        } else {
            self.admissible_along(rates, intact, line.map(SpaceDeformation::of_bonds), reach)
        }
    }

    fn admissible_along<B: AlongLine>(
        &self,
        rates: &Self,
        intact: &[bool],
        [start, slopes]: [&[B]; 2],
        reach: Interval,
    ) -> Option<Interval> {
        let of_task = |(task, (start, slopes)): (usize, (&[B], &[B]))| {
            let bonds = (task * TASK..).zip(start.iter().zip(slopes));
            let mut of_intact = bonds.filter(|(bond, _)| intact[*bond]);
            of_intact.try_fold(reach, |interval, (bond, (start, slope))| {
                intersection(interval, self.interval(rates, bond, [start, slope])?)
            })
        };
        let tasks = start.chunks(TASK).zip(slopes.chunks(TASK));
        let mut of_tasks = parallel::map(tasks.enumerate(), of_task).into_iter();
        of_tasks.try_fold(reach, |interval, of_task| intersection(interval, of_task?))
    }

    /// The t for which no criterion breaks a bond with the deformation `start` + t `slope`; None where some does for every t.
    fn interval<B: AlongLine>(&self, rates: &Self, bond: usize, line: [&B; 2]) -> Option<Interval> {
        let of = |interval: Interval, (place, it): (usize, &Criterion)| {
            let limit = self.break_limit(place, bond);
            let of_criterion = if limit.is_finite() {
                let stress = [self, rates].map(|it| it.stress(place, bond));
                it.measure
                    .interval_within(line, it.coefficients(bond), stress, limit)?
            } else {
                EVERYWHERE
            };
            intersection(interval, of_criterion)
        };
        let mut list = self.criteria().list.iter().enumerate();
        list.try_fold(EVERYWHERE, of)
    }
}

fn intersection(one: Interval, other: Interval) -> Option<Interval> {
    let both = [one[0].max(other[0]), one[1].min(other[1])];
    (both[0] <= both[1]).then_some(both)
}
