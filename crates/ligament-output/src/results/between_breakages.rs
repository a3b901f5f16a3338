//! Which states between the breakages of load steps a run keeps.

use serde::{Deserialize, Serialize};

use super::stored_state::StoredState;

/// The kept states between the breakages of load steps, of each step at most a given number.
///
/// The number of breakages of a step is not known before its end. A state is kept where it reaches a multiple of the spacing: the breakages of its
/// step up to it and up to the equilibrium before it have different quotients by the spacing. The spacing is 1 at first. When a step would have too
/// many states, the spacing doubles for all steps, until those of this step that still reach a multiple are few enough. So states are as many breakages apart in
/// every step, and the step with the most breakages has between half of the largest number and all of it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct StatesBetweenBreakages {
    /// Breakages between two states.
    spacing: usize,
    /// Kept states, each with the breakages of its step up to the equilibrium before it.
    kept: Vec<(StoredState, usize)>,
    /// Step of the last equilibrium between breakages, and its breakages until then.
    last: (usize, usize),
}

impl Default for StatesBetweenBreakages {
    fn default() -> Self {
        Self {
            spacing: 1,
            kept: Vec::new(),
            last: (0, 0),
        }
    }
}

impl StatesBetweenBreakages {
    /// Goes on to the equilibrium of a step after some of its breakages, of whose states at most so many are kept; returns whether others are dropped.
    pub(super) fn enter(&mut self, step: usize, breakages: usize, most: usize) -> bool {
        let before = match self.last {
            (of, before) if of == step => before,
            _ => 0,
        };
        self.last = (step, breakages);
        self.kept
            .push((StoredState::between(step, breakages), before));
        let spacing = self.spacing;
        self.thin_out();
        while self.kept.iter().filter(|(it, _)| it.step == step).count() > most {
            self.spacing *= 2;
            self.thin_out();
        }
        self.spacing > spacing
    }

    /// Whether a state is kept.
    pub(super) fn has(&self, state: StoredState) -> bool {
        self.kept.iter().any(|(it, _)| *it == state)
    }

    fn thin_out(&mut self) {
        let spacing = self.spacing;
        self.kept.retain(|(state, before)| {
            let breakages = state.breakages().unwrap_or_default();
            breakages / spacing > before / spacing
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Kept states of steps with these numbers of bonds that break at a time.
    fn kept(steps: &[&[usize]], most: usize) -> Vec<(usize, usize)> {
        let mut states = StatesBetweenBreakages::default();
        for (step, breaking) in (1..).zip(steps) {
            let mut breakages = 0;
            for broken in *breaking {
                breakages += broken;
                states.enter(step, breakages, most);
            }
        }
        let kept = states.kept.iter().map(|(state, _)| *state);
        kept.map(|it| (it.step, it.breakages().unwrap_or_default()))
            .collect()
    }

    #[test]
    fn all_states_of_few_breakages_are_kept() {
        assert_eq!(kept(&[&[1, 2], &[3]], 2), [(1, 1), (1, 3), (2, 3)]);
        assert_eq!(kept(&[&[1, 2]], 0), []);
    }

    /// 100 rounds of 5 bonds: with at most 10 states every 64 bonds, in the first round after each multiple of 64.
    #[test]
    fn states_of_a_step_are_evenly_spread_over_its_breakages() {
        let expected = [65, 130, 195, 260, 320, 385, 450];
        assert_eq!(kept(&[&[5; 100]], 10), expected.map(|it| (1, it)));
        for most in 1..40 {
            let count = kept(&[&[1; 999]], most).len();
            assert!(count <= most && 2 * count >= most, "{count} of {most}");
        }
    }

    /// The step with most breakages sets the spacing of all, whether it comes first or last.
    #[test]
    fn all_steps_have_the_same_spacing() {
        let (few, many) = ([3; 4], [2; 30]);
        assert_eq!(kept(&[&few, &many], 4), [(2, 16), (2, 32), (2, 48)]);
        assert_eq!(kept(&[&many, &few], 4), [(1, 16), (1, 32), (1, 48)]);
    }

    /// What is kept at the end depends neither on the states that were dropped on the way nor on when they were.
    #[test]
    fn thinning_keeps_what_a_known_spacing_keeps() {
        let breaking: Vec<usize> = (0..200).map(|round| 1 + (round * round) % 7).collect();
        let mut breakages = 0;
        let sums = breaking.iter().map(|broken| {
            breakages += broken;
            [breakages - broken, breakages]
        });
        let sums: Vec<[usize; 2]> = sums.collect();
        let reaching = |spacing: usize| -> Vec<(usize, usize)> {
            let reached = sums
                .iter()
                .filter(|[before, now]| (before + 1..=*now).any(|it| it % spacing == 0));
            reached.map(|it| (1, it[1])).collect()
        };
        let spacings = (0..).map(|power| 1 << power);
        let first = spacings.map(reaching).find(|all| all.len() <= 12);
        assert_eq!(Some(kept(&[&breaking], 12)), first);
    }
}
