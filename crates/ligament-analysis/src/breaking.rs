//! Selection of the bonds that break next (NHPD section 2.4, Fig. 5), with an explicit rule for ties.
//!
//! The criterion with the largest ratio of measure to limit, s/s_0 for most, decides for a bond.

use std::collections::BTreeMap;

use ligament_model::communicator::Wire;
use ligament_model::element::BondDeformation;
use ligament_model::failure::{CriteriaInState, Verdict};
use ligament_model::parallel;

use crate::bond_numbers::BondNumbers;

/// Bonds closer than this (relative) to the worst one break together with it.
pub const TIE_TOLERANCE: f64 = 1e-8;

/// Rounding of a measure that is computed from its ratio to the limit, relative.
const ROUNDING: f64 = 1e-12;

/// Number of bonds of a parallel task.
const TASK: usize = 4096;

ligament_model::case_type! {
    /// Quantity that orders the bonds beyond their limits: s - s_0, or s/s_0, the order in which proportional loading reaches the limits.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
    pub enum BreakingOrder {
        /// Bonds with the largest excess of stretch over critical stretch (the paper's).
        #[default]
        Excess,
        /// Bonds with the largest ratio of stretch to critical stretch.
        Ratio,
    }
}

impl BreakingOrder {
    /// Rank of a bond by its measure and limit, and the scale of its ties.
    fn rank(self, measure: f64, limit: f64) -> (f64, f64) {
        match self {
            Self::Excess => (measure - limit, measure),
            Self::Ratio => (measure / limit, measure / limit),
        }
    }
}

/// Rule that selects the bonds to break.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BreakingRule {
    /// Quantity that orders the bonds.
    pub order: BreakingOrder,
    /// Number o of bonds that break before the next equilibrium (NHPD recommends 10 at most).
    pub bonds_per_iteration: usize,
    /// Relative distance in measure (order by excess) or ratio from the leading bond within which bonds are tied with it.
    pub tie_tolerance: f64,
}

impl Default for BreakingRule {
    /// At most five bonds break between two solutions.
    fn default() -> Self {
        Self {
            order: BreakingOrder::default(),
            bonds_per_iteration: 5,
            tie_tolerance: TIE_TOLERANCE,
        }
    }
}

/// Bonds to break now, in order; empty where no intact bond is at its limit.
///
/// The leading bond breaks together with all bonds tied with it, including bonds just below their limits, so that symmetric
/// problems stay symmetric; such a group is in the order of the end numbers by `in_file`, and never split. Groups are added until
/// `bonds_per_iteration` is reached or exceeded.
///
/// Bonds are given by their global numbers. Collective.
pub fn next_to_break(
    numbers: &BondNumbers,
    rule: &BreakingRule,
    deformations: &[BondDeformation],
    criteria: &CriteriaInState<'_>,
    intact: &[bool],
    in_file: impl Fn(u32) -> [u32; 2],
) -> Vec<u32> {
    let mut near = near_limit(rule, deformations, criteria, &numbers.owned_of(intact));
    for it in &mut near {
        (it.in_file, it.bond) = (in_file(it.bond), numbers.number(it.bond));
    }
    chosen(rule, numbers.subdomain().all_gather_list(near))
}

/// Bonds to break now, as [`next_to_break`] chooses them, from some intact bonds of a whole body that are near their limits.
pub(crate) fn next_of_near(
    rule: &BreakingRule,
    near: &[(u32, BondDeformation)],
    criteria: &CriteriaInState<'_>,
    in_file: impl Fn(u32) -> [u32; 2],
) -> Vec<u32> {
    let candidate = |(bond, deformation): &(u32, BondDeformation)| {
        let verdict = criteria.breaking(*bond as usize, deformation)?;
        Some(Candidate {
            in_file: in_file(*bond),
            ..Candidate::new(rule.order, *bond, &verdict)
        })
    };
    chosen(rule, near.iter().filter_map(candidate).collect())
}

impl BreakingRule {
    /// Factor that raises the measure of a bond to its limit if the bond may be tied with one beyond its limit.
    pub(crate) fn near(&self) -> f64 {
        1.0 + 2.0 * self.tie_tolerance
    }
}

/// Intact bonds beyond their limits, or so close to their limits that they may be tied with one beyond its limit.
fn near_limit(
    rule: &BreakingRule,
    deformations: &[BondDeformation],
    criteria: &CriteriaInState<'_>,
    intact: &[bool],
) -> Vec<Candidate> {
    let near = rule.near();
    let of_tasks = judge(
        deformations,
        criteria,
        intact,
        Vec::new,
        |near_limit, bond, verdict| {
            if verdict.measure * near >= verdict.limit {
                near_limit.push(Candidate::new(rule.order, bond, &verdict));
            }
        },
    );
    of_tasks.concat()
}

fn chosen(rule: &BreakingRule, mut ranked: Vec<Candidate>) -> Vec<u32> {
    ranked.sort_unstable_by(|one, other| {
        other
            .rank
            .total_cmp(&one.rank)
            .then(one.in_file.cmp(&other.in_file))
    });
    let mut chosen = Vec::new();
    let mut rest = ranked.as_slice();
    while chosen.len() < rule.bonds_per_iteration {
        let Some(first) = rest.iter().position(|candidate| candidate.exceeds) else {
            break;
        };
        let leader = &rest[first];
        let lowest_tied = leader.rank - rule.tie_tolerance * leader.tie_scale;
        // Bonds below the limit precede the leader only where they are tied with it by rounding.
        let end = rest
            .iter()
            .position(|candidate| candidate.rank < lowest_tied)
            .unwrap_or(rest.len());
        let mut group = rest[..end].to_vec();
        group.sort_unstable_by_key(|candidate| candidate.in_file);
        chosen.extend(group.iter().map(|candidate| candidate.bond));
        rest = &rest[end..];
    }
    chosen
}

/// Bonds that break first under proportional loading.
#[derive(Debug, Clone, PartialEq)]
pub struct FirstToBreak {
    /// Largest ratio of measure to limit; 0 where no measure of an intact bond is positive.
    pub ratio: f64,
    /// Bonds with this ratio or tied with it, in the order of their numbers.
    pub bonds: Vec<u32>,
}

impl FirstToBreak {
    /// Sorts the bonds by the numbers of their ends in the file.
    pub(crate) fn sorted(mut self, in_file: impl Fn(u32) -> [u32; 2]) -> Self {
        self.bonds.sort_unstable_by_key(|bond| in_file(*bond));
        self
    }
}

/// Intact bonds nearest to breakage, with those within the relative `tie_tolerance` below the largest ratio.
pub fn first_to_break(
    tie_tolerance: f64,
    deformations: &[BondDeformation],
    criteria: &CriteriaInState<'_>,
    intact: &[bool],
) -> FirstToBreak {
    leaders(tie_tolerance, deformations, criteria, intact).first_to_break()
}

/// Bonds of the whole body nearest to breakage, as global numbers in the order of their end numbers in the file. Collective.
pub(crate) fn first_of_all(
    numbers: &BondNumbers,
    tie_tolerance: f64,
    deformations: &[BondDeformation],
    criteria: &CriteriaInState<'_>,
    intact: &[bool],
    in_file: impl Fn(u32) -> [u32; 2],
) -> FirstToBreak {
    let owned = numbers.owned_of(intact);
    let here = leaders(tie_tolerance, deformations, criteria, &owned);
    let here = here.bonds().map(|(bond, ratio)| {
        let [a, b] = in_file(bond).map(f64::from);
        [f64::from(numbers.number(bond)), ratio, a, b]
    });
    let mut leaders = Leaders::new(Leading::Tied(tie_tolerance));
    let mut ends = BTreeMap::new();
    for [number, ratio, a, b] in numbers.subdomain().all_gather_list(here.collect()) {
        leaders.add(number as u32, ratio, || 0.0);
        ends.insert(number as u32, [a as u32, b as u32]);
    }
    leaders.first_to_break().sorted(|bond| ends[&bond])
}

fn leaders(
    tie_tolerance: f64,
    deformations: &[BondDeformation],
    criteria: &CriteriaInState<'_>,
    intact: &[bool],
) -> Leaders {
    let start = || Leaders::new(Leading::Tied(tie_tolerance));
    let of_tasks = judge(
        deformations,
        criteria,
        intact,
        start,
        |leaders, bond, verdict| {
            leaders.add(bond, verdict.ratio(), || verdict.limit);
        },
    );
    let mut leaders = start();
    of_tasks.into_iter().for_each(|it| leaders.merge(it));
    leaders
}

/// Results gathered by tasks from the verdicts on their intact bonds, in the order of the bonds.
fn judge<T: Send>(
    deformations: &[BondDeformation],
    criteria: &CriteriaInState<'_>,
    intact: &[bool],
    start: impl Fn() -> T + Sync,
    gather: impl Fn(&mut T, u32, Verdict) + Sync,
) -> Vec<T> {
    let tasks = deformations.chunks(TASK).zip(intact.chunks(TASK));
    parallel::map(tasks.enumerate(), |(task, (deformations, intact))| {
        let mut gathered = start();
        for ((bond, deformation), intact) in (task * TASK..).zip(deformations).zip(intact) {
            if *intact && let Some(verdict) = criteria.breaking(bond, deformation) {
                gather(&mut gathered, bond as u32, verdict);
            }
        }
        gathered
    })
}

/// Bonds that are sought before a breakage, by their ratios of measure to limit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Leading {
    /// Bonds with the largest ratio, or tied with it within this relative tolerance.
    Tied(f64),
    /// Bonds that break next by a rule.
    Next(BreakingRule),
}

/// A bond that may lead.
#[derive(Debug, Clone, Copy)]
struct PossibleLeader {
    bond: u32,
    ratio: f64,
    limit: f64,
}

/// Bonds that may lead, of those added so far; no others can lead in the end.
pub(crate) struct Leaders {
    leading: Leading,
    ratio: f64,
    /// Smallest ratio of a leading bond so far.
    pub(crate) lowest: f64,
    /// The largest ranks of bonds beyond their limits so far, as many as break next, the largest first, and the largest scale of a tie of them.
    ranks: (Vec<f64>, f64),
    /// In the order in which they were added.
    candidates: Vec<PossibleLeader>,
}

impl Leaders {
    pub(crate) fn new(leading: Leading) -> Self {
        Self {
            leading,
            ratio: 0.0,
            lowest: match leading {
                Leading::Tied(_) => 0.0,
                Leading::Next(rule) => rule.near().recip(),
            },
            ranks: (Vec::new(), 0.0),
            candidates: Vec::new(),
        }
    }

    #[inline]
    pub(crate) fn add(&mut self, bond: u32, ratio: f64, limit: impl FnOnce() -> f64) {
        if ratio > 0.0 && ratio >= self.lowest {
            let limit = limit();
            match self.leading {
                Leading::Tied(tolerance) if ratio > self.ratio => {
                    self.lowest = ratio - tolerance * ratio;
                }
                Leading::Next(rule) if ratio >= 1.0 => self.rank(&rule, ratio, limit),
                _ => {}
            }
            self.ratio = self.ratio.max(ratio);
            self.candidates.push(PossibleLeader { bond, ratio, limit });
        }
    }

    fn rank(&mut self, rule: &BreakingRule, ratio: f64, limit: f64) {
        let (rank, scale) = rule.order.rank(ratio * limit, limit);
        let (ranks, largest_scale) = &mut self.ranks;
        let place = ranks.partition_point(|it| *it >= rank);
        if place < rule.bonds_per_iteration {
            ranks.truncate(rule.bonds_per_iteration - 1);
            ranks.insert(place, rank);
        }
        *largest_scale = largest_scale.max(scale);
    }

    /// Whether a bond may lead whose ratio and limit are at most these.
    pub(crate) fn may_include(&self, ratio: f64, limit: f64) -> bool {
        if ratio < self.lowest {
            return false;
        }
        let Leading::Next(rule) = self.leading else {
            return true;
        };
        let (ranks, scale) = &self.ranks;
        // The bonds that break next are tied with one of these ranks, or have a larger one.
        let last = ranks
            .last()
            .filter(|_| ranks.len() == rule.bonds_per_iteration);
        let lowest = last.map(|it| it - (rule.tie_tolerance + ROUNDING) * scale);
        // Of bonds below their limits, those with the smallest limit have the largest rank, which is below zero.
        let most = rule.order.rank(ratio.max(1.0) * limit, limit).0;
        lowest.is_none_or(|lowest| most >= lowest)
    }

    /// Adds the bonds of another list.
    pub(crate) fn merge(&mut self, others: Self) {
        for PossibleLeader { bond, ratio, limit } in others.candidates {
            self.add(bond, ratio, || limit);
        }
    }

    /// Leading bonds and their ratios, in the order in which they were added.
    pub(crate) fn bonds(&self) -> impl Iterator<Item = (u32, f64)> + '_ {
        let leading = self.candidates.iter().filter(|it| it.ratio >= self.lowest);
        leading.map(|it| (it.bond, it.ratio))
    }

    /// Largest ratio and the leading bonds.
    pub(crate) fn first_to_break(self) -> FirstToBreak {
        let mut bonds: Vec<u32> = self.bonds().map(|it| it.0).collect();
        bonds.sort_unstable();
        FirstToBreak {
            bonds,
            ratio: self.ratio,
        }
    }
}

#[derive(Clone)]
struct Candidate {
    bond: u32,
    /// Numbers of the ends of the bond in the file.
    in_file: [u32; 2],
    rank: f64,
    tie_scale: f64,
    exceeds: bool,
}

impl Wire<6> for Candidate {
    fn numbers(&self) -> [f64; 6] {
        let [number, a, b] = [self.bond, self.in_file[0], self.in_file[1]].map(f64::from);
        let exceeds = f64::from(u8::from(self.exceeds));
        [number, self.rank, self.tie_scale, exceeds, a, b]
    }

    fn from_numbers([number, rank, tie_scale, exceeds, a, b]: [f64; 6]) -> Self {
        Self {
            bond: number as u32,
            in_file: [a as u32, b as u32],
            rank,
            tie_scale,
            exceeds: exceeds > 0.0,
        }
    }
}

impl Candidate {
    fn new(order: BreakingOrder, bond: u32, verdict: &Verdict) -> Self {
        let (rank, tie_scale) = order.rank(verdict.measure, verdict.limit);
        Self {
            bond,
            in_file: [0; 2],
            rank,
            tie_scale,
            exceeds: verdict.measure >= verdict.limit,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ligament_model::failure::{Criteria, Criterion, Measure};

    fn stretch_limits(limit: &[f64]) -> Criteria {
        Criteria {
            list: vec![Criterion::brittle("", Measure::Tension, limit.to_vec())],
        }
    }

    fn chosen(rule: &BreakingRule, stretch: &[f64], limit: &[f64], intact: &[bool]) -> Vec<u32> {
        let deformations: Vec<BondDeformation> = stretch
            .iter()
            .map(|&stretch| BondDeformation::new([stretch, 0.0, 0.0]))
            .collect();
        next_to_break(
            &BondNumbers::whole(0),
            rule,
            &deformations,
            &stretch_limits(limit).without_state(),
            intact,
            |bond| [bond, 0],
        )
    }

    fn rule(order: BreakingOrder, bonds_per_iteration: usize) -> BreakingRule {
        BreakingRule {
            order,
            bonds_per_iteration,
            tie_tolerance: 1e-8,
        }
    }

    #[test]
    fn largest_excess_or_ratio_first() {
        // Excesses 1, 3, 2, -1, 5 (broken); ratios 2, 1.3, 1.5, 0.5, 6.
        let (stretch, limit) = ([2.0, 13.0, 6.0, 1.0, 6.0], [1.0, 10.0, 4.0, 2.0, 1.0]);
        let intact = [true, true, true, true, false];
        assert_eq!(
            chosen(&rule(BreakingOrder::Excess, 2), &stretch, &limit, &intact),
            [1, 2]
        );
        assert_eq!(
            chosen(&rule(BreakingOrder::Ratio, 2), &stretch, &limit, &intact),
            [0, 2]
        );
        assert_eq!(
            chosen(&rule(BreakingOrder::Excess, 9), &stretch, &limit, &intact),
            [1, 2, 0]
        );
    }

    #[test]
    fn proportional_loading_breaks_the_largest_ratio_with_its_ties() {
        let first = |stretch: &[f64], limit: &[f64], intact: &[bool]| {
            let deformations: Vec<BondDeformation> = stretch
                .iter()
                .map(|&stretch| BondDeformation::new([stretch, 0.0, 0.0]))
                .collect();
            let first = first_to_break(
                1e-8,
                &deformations,
                &stretch_limits(limit).without_state(),
                intact,
            );
            (first.ratio, first.bonds)
        };
        // Ratios 2 (broken), -3, 0.5, 0.2, 0.5 + 2e-9, 0 (unbreakable), 0.5 - 1e-8.
        let stretch = [2.0, -3.0, 1.0, 0.2, 0.5 + 2e-9, 9.0, 0.5 - 1e-8];
        let limit = [1.0, 1.0, 2.0, 1.0, 1.0, f64::INFINITY, 1.0];
        let intact = [false, true, true, true, true, true, true];
        assert_eq!(first(&stretch, &limit, &intact), (0.5 + 2e-9, vec![2, 4]));
        assert_eq!(first(&stretch[1..2], &limit, &intact), (0.0, vec![]));
        let unbreakable = first(&stretch[5..6], &limit[5..6], &[true]);
        assert_eq!(unbreakable, (0.0, vec![]));
    }

    #[test]
    fn nothing_at_the_limit_nothing_breaks() {
        assert!(
            chosen(
                &rule(BreakingOrder::Excess, 5),
                &[0.99, -3.0],
                &[1.0, 1.0],
                &[true; 2]
            )
            .is_empty()
        );
        assert_eq!(
            chosen(
                &rule(BreakingOrder::Excess, 5),
                &[1.0, -3.0],
                &[1.0, 1.0],
                &[true; 2]
            ),
            [0]
        );
        assert!(
            chosen(
                &rule(BreakingOrder::Excess, 5),
                &[9.0],
                &[f64::INFINITY],
                &[true]
            )
            .is_empty()
        );
    }

    #[test]
    fn a_tied_group_breaks_together_and_in_the_order_of_its_numbers() {
        let just_below = 2.0 - 1e-10;
        let stretch = [2.0, just_below, 1.5, 2.0 + 1e-10];
        assert_eq!(
            chosen(
                &rule(BreakingOrder::Excess, 1),
                &stretch,
                &[1.0; 4],
                &[true; 4]
            ),
            [0, 1, 3]
        );
        // Also where a member lies just under its limit.
        assert_eq!(
            chosen(
                &rule(BreakingOrder::Ratio, 1),
                &[just_below, 2.0],
                &[2.0; 2],
                &[true; 2]
            ),
            [0, 1]
        );
        assert_eq!(
            chosen(
                &rule(BreakingOrder::Excess, 1),
                &[just_below, 2.0],
                &[2.0; 2],
                &[true; 2]
            ),
            [0, 1]
        );
        // But not alone.
        assert!(
            chosen(
                &rule(BreakingOrder::Ratio, 1),
                &[just_below],
                &[2.0],
                &[true]
            )
            .is_empty()
        );
    }
}
