//! Search for the value of a key with which a result meets its target, by brackets and with few runs.
//!
//! [`Search::next`] is a function of the trials so far, so that a search can be continued from its record. The first guess assumes that the
//! result is proportional to the key, as a peak load is to the strengths of the bonds; then secants seek trials on both sides of the
//! target, and false position (Illinois rule, and a bisection where the bracket does not halve) narrows the bracket. Results of fracture
//! jump: where the bracket is as narrow as the resolution and neither end meets the target, the search ends with the jump.

use serde::{Deserialize, Serialize};

/// Parameters of a search.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Search {
    /// First value of the key.
    pub start: f64,
    /// Smallest and largest value of the key that may be tried.
    pub limits: [f64; 2],
    /// Target of the result.
    pub target: f64,
    /// Largest difference from the target that counts as met, in units of the result.
    pub tolerance: f64,
    /// Width of a bracket, relative to its larger end, below which it is not divided.
    pub resolution: f64,
    /// Largest number of trials.
    pub most_trials: usize,
}

/// A value of the key and its result.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Trial {
    /// Value of the key.
    pub key: f64,
    /// Result of the run with this value of the key.
    pub result: f64,
}

/// Next action of a search.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Next {
    /// Trial of this value of the key.
    Try(f64),
    /// End of the search.
    Stop(Verdict),
}

/// End of a search.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Verdict {
    /// This trial meets the target.
    Met(Trial),
    /// The result jumps over the target between two values of the key that are equal within the resolution.
    Jump([Trial; 2]),
    /// The results of all allowed values of the key are on one side of the target.
    OutOfReach,
    /// No more trials are allowed.
    OutOfTrials,
}

/// Largest factor by which a guess without a bracket changes the key.
const LARGEST_STRIDE: f64 = 4.0;

/// Share by which a guess exceeds the step of the secant, to obtain a result beyond the target.
const OVERSHOOT: f64 = 0.25;

/// Smallest distance of a value from the ends of its bracket, over the bracket's width.
const MARGIN: f64 = 0.02;

/// Significant digits of the trial values.
const DIGITS: usize = 7;

impl Search {
    /// Next action after these trials, given in their order.
    pub fn next(&self, trials: &[Trial]) -> Next {
        let Some(best) = self.best(trials) else {
            return Next::Try(self.nearest_allowed(self.start));
        };
        if self.deviation(&best).abs() <= self.tolerance {
            return Next::Stop(Verdict::Met(best));
        }
        let bracket = self.bracket(trials);
        if let Some(ends) = bracket
            && self.is_narrow(ends)
        {
            return Next::Stop(Verdict::Jump(ends));
        }
        if trials.len() >= self.most_trials {
            return Next::Stop(Verdict::OutOfTrials);
        }
        match bracket {
            Some(ends) => Next::Try(self.nearest_allowed(self.inside(ends, trials))),
            None => self.outside(best, trials),
        }
    }

    /// The trial nearest to the target.
    pub fn best(&self, trials: &[Trial]) -> Option<Trial> {
        let nearest =
            |a: &&Trial, b: &&Trial| self.deviation(a).abs().total_cmp(&self.deviation(b).abs());
        trials.iter().min_by(nearest).copied()
    }

    fn deviation(&self, trial: &Trial) -> f64 {
        trial.result - self.target
    }

    /// The nearest value within the limits, rounded to the significant digits of trials.
    fn nearest_allowed(&self, key: f64) -> f64 {
        let written = format!("{key:.*e}", DIGITS - 1);
        written
            .parse()
            .unwrap_or(key)
            .clamp(self.limits[0], self.limits[1])
    }

    /// Neighbouring trials on both sides of the target, lower key first; the nearest pair if there are several.
    fn bracket(&self, trials: &[Trial]) -> Option<[Trial; 2]> {
        let mut sorted = trials.to_vec();
        sorted.sort_by(|a, b| a.key.total_cmp(&b.key));
        let pairs = sorted.windows(2).map(|pair| [pair[0], pair[1]]);
        let around = pairs.filter(|[a, b]| (self.deviation(a) > 0.0) != (self.deviation(b) > 0.0));
        let missed = |[a, b]: &[Trial; 2]| self.deviation(a).abs().min(self.deviation(b).abs());
        around.min_by(|a, b| missed(a).total_cmp(&missed(b)))
    }

    fn is_narrow(&self, [a, b]: [Trial; 2]) -> bool {
        b.key - a.key <= self.resolution * a.key.abs().max(b.key.abs())
    }

    /// A value between two trials around the target.
    fn inside(&self, [a, b]: [Trial; 2], trials: &[Trial]) -> f64 {
        // Successive trials on the same side keep the other end: its weight is halved for each of them (Illinois), and after three of them
        // the bracket is halved.
        let same_side = |trial: &&Trial| {
            let last = trials.last().unwrap_or(trial);
            (self.deviation(trial) > 0.0) == (self.deviation(last) > 0.0)
        };
        let in_a_row = trials.iter().rev().take_while(same_side).count();
        let middle = 0.5 * (a.key + b.key);
        if in_a_row > 3 {
            return middle;
        }
        let weight = 0.5f64.powi(in_a_row.saturating_sub(1) as i32);
        let last_is_above = trials.last().is_some_and(|last| self.deviation(last) > 0.0);
        let weighted = |trial: &Trial| {
            let is_last_side = (self.deviation(trial) > 0.0) == last_is_above;
            self.deviation(trial) * if is_last_side { 1.0 } else { weight }
        };
        let (miss_a, miss_b) = (weighted(&a), weighted(&b));
        let share = (miss_a / (miss_a - miss_b)).clamp(MARGIN, 1.0 - MARGIN);
        a.key + share * (b.key - a.key)
    }

    /// A value beyond trials that all lie on one side of the target.
    fn outside(&self, best: Trial, trials: &[Trial]) -> Next {
        let key = match self.nearest_other(best, trials) {
            None => self.in_proportion(best),
            Some(other) if other.result == best.result => self.beyond_level(best, trials),
            Some(other) => self.along_secant(best, other),
        };
        let key = self.nearest_allowed(key);
        if !trials.iter().any(|trial| trial.key == key) {
            return Next::Try(key);
        }
        // The key is at a limit: only the other limit remains.
        let untried = |limit: &f64| limit.is_finite() && !trials.iter().any(|it| it.key == *limit);
        match self.limits.into_iter().find(untried) {
            Some(limit) => Next::Try(limit),
            None => Next::Stop(Verdict::OutOfReach),
        }
    }

    /// The trial nearest to the target with another key than the best.
    fn nearest_other(&self, best: Trial, trials: &[Trial]) -> Option<Trial> {
        let others: Vec<Trial> = (trials.iter().copied())
            .filter(|trial| trial.key != best.key)
            .collect();
        self.best(&others)
    }

    /// Next key if the result were proportional to the key.
    fn in_proportion(&self, trial: Trial) -> f64 {
        if trial.key == 0.0 {
            let [low, high] = self.limits;
            return if high.is_finite() { high } else { low };
        }
        let ratio = self.target / trial.result;
        let ratio = if ratio > 0.0 { ratio } else { LARGEST_STRIDE };
        trial.key * ratio.clamp(1.0 / LARGEST_STRIDE, LARGEST_STRIDE)
    }

    /// Next key by the secant through two trials, from the better one.
    fn along_secant(&self, best: Trial, other: Trial) -> f64 {
        let slope = (best.result - other.result) / (best.key - other.key);
        let step = -self.deviation(&best) / slope * (1.0 + OVERSHOOT);
        let far = (LARGEST_STRIDE - 1.0) * best.key.abs().max((best.key - other.key).abs());
        // A step towards zero keeps a share of the key, and so its sign.
        let inwards = (1.0 - 1.0 / LARGEST_STRIDE) * best.key.abs();
        let [down, up] = match best.key {
            key if key > 0.0 => [inwards, far],
            key if key < 0.0 => [far, inwards],
            _ => [far, far],
        };
        best.key + step.clamp(-down, up)
    }

    /// Key beyond all trials, alternately on either side, where the result does not change with the key; first on the side where a growing result
    /// would meet the target.
    fn beyond_level(&self, best: Trial, trials: &[Trial]) -> f64 {
        let sizes = trials.iter().map(|trial| trial.key.abs());
        let grows = self.target.abs() > best.result.abs();
        let size = if grows == trials.len().is_multiple_of(2) {
            LARGEST_STRIDE * sizes.fold(0.0, f64::max)
        } else {
            sizes.fold(f64::INFINITY, f64::min) / LARGEST_STRIDE
        };
        size.copysign(best.key)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SEARCH: Search = Search {
        start: 3.0,
        limits: [f64::NEG_INFINITY, f64::INFINITY],
        target: 10.0,
        tolerance: 0.1,
        resolution: 1e-4,
        most_trials: 30,
    };

    /// Follows a search over a known function.
    fn follow(search: &Search, of: impl Fn(f64) -> f64) -> (Vec<Trial>, Verdict) {
        let mut trials = Vec::new();
        loop {
            match search.next(&trials) {
                Next::Stop(verdict) => return (trials, verdict),
                Next::Try(key) => {
                    assert!(
                        (search.limits[0]..=search.limits[1]).contains(&key),
                        "{key}"
                    );
                    let result = of(key);
                    trials.push(Trial { key, result });
                }
            }
        }
    }

    fn met(search: &Search, of: impl Fn(f64) -> f64) -> (f64, usize) {
        match follow(search, of) {
            (trials, Verdict::Met(trial)) => (trial.key, trials.len()),
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn a_result_in_proportion_takes_two_trials() {
        assert_eq!(met(&SEARCH, |key| 4.0 * key), (2.5, 2));
        assert_eq!(met(&SEARCH, |key| 10.0 * key / 3.0), (3.0, 1));
        let negative = Search {
            start: -1.0,
            ..SEARCH
        };
        assert_eq!(met(&negative, |key| -2.0 * key), (-5.0, 4));
    }

    #[test]
    fn smooth_results_take_few_trials() {
        for (of, root) in [
            (
                &(|key: f64| key.powi(3)) as &dyn Fn(f64) -> f64,
                10f64.cbrt(),
            ),
            (&|key: f64| 20.0 - key.sqrt(), 100.0),
            (
                &|key: f64| 40.0 * (1.0 - (-key / 7.0).exp()),
                -7.0 * 0.75f64.ln(),
            ),
            (&|key: f64| 100.0 / key, 10.0),
            (&|key: f64| key.exp(), 10f64.ln()),
        ] {
            let (key, trials) = met(&SEARCH, of);
            assert!((of(key) - 10.0).abs() <= SEARCH.tolerance);
            assert!((key / root - 1.0).abs() < 0.05, "{key} for {root}");
            assert!(trials <= 9, "{trials} trials for {root}");
        }
    }

    #[test]
    fn a_result_with_noise_is_met_as_well() {
        // Ordered breaking makes a peak uneven by some percent.
        let noisy = |key: f64| 4.0 * key * (1.0 + 0.03 * (37.0 * key).sin());
        let (key, trials) = met(&SEARCH, noisy);
        assert!((noisy(key) - 10.0).abs() <= 0.1 && trials <= 12, "{trials}");
    }

    #[test]
    fn a_jump_over_the_target_is_told_with_both_its_sides() {
        let (trials, verdict) = follow(&SEARCH, |key| if key < 2.0 { 9.0 } else { 11.0 });
        let Verdict::Jump([below, above]) = verdict else {
            panic!("{verdict:?}")
        };
        assert!(below.key < 2.0 && above.key >= 2.0 && above.key - below.key <= 2e-4);
        assert_eq!([below.result, above.result], [9.0, 11.0]);
        assert!(trials.len() <= 30);
    }

    #[test]
    fn limits_are_kept_and_may_be_too_narrow() {
        let limited = Search {
            limits: [1.0, 4.0],
            ..SEARCH
        };
        assert_eq!(follow(&limited, |key| key).1, Verdict::OutOfReach);
        let (key, _) = met(&limited, |key| key * key);
        assert!((key - 10f64.sqrt()).abs() < 0.05);
        let falling = |key: f64| 14.0 - 2.0 * key;
        assert!((met(&limited, falling).0 - 2.0).abs() <= 0.05);
    }

    #[test]
    fn a_result_that_does_not_depend_on_the_key_ends() {
        let (trials, verdict) = follow(&SEARCH, |_| 5.0);
        assert_eq!(verdict, Verdict::OutOfTrials);
        assert_eq!(trials.len(), SEARCH.most_trials);
        let limited = Search {
            limits: [1.0, 4.0],
            ..SEARCH
        };
        assert_eq!(follow(&limited, |_| 5.0).1, Verdict::OutOfReach);
    }

    #[test]
    fn a_search_goes_on_from_its_record() {
        let of = |key: f64| key.powi(3);
        let (trials, _) = follow(&SEARCH, of);
        for done in 0..trials.len() {
            assert_eq!(SEARCH.next(&trials[..done]), Next::Try(trials[done].key));
        }
    }
}
