//! Estimate of the time that a run takes, printed before it begins.

use std::time::Duration;

use ligament_analysis::history::Ahead;
use rayon::current_num_threads;

use crate::progress::duration_text;

/// Time of an explicit step for a bond on one thread, s: a plate of `nhpd` with 1390 bonds took 19 ns.
const STEP_OF_BOND: f64 = 20e-9;

/// Multiplications of a factorisation in a second on one thread.
const MULTIPLICATIONS: f64 = 1e10;

/// Time of preparing a bond, with the correction, on one thread, s: a plate of a million points with 13 million bonds took 17 s.
const PREPARED_BOND: f64 = 1.3e-6;

/// Shortest estimated time that a run announces before it begins, s.
const LONG: f64 = 60.0;

/// Number of time steps from which on a run announces them, even if they take little time.
const MANY: usize = 1_000_000_000;

/// Announcement of a run of a body with a number of bonds, where it takes long.
pub(crate) fn announcement(ahead: Ahead, bonds: usize) -> Option<String> {
    match ahead {
        Ahead::TimeSteps { count, is_implicit } => {
            let seconds = count as f64 * bonds as f64 * STEP_OF_BOND / current_num_threads() as f64;
            let at_least = if is_implicit { "more than " } else { "" };
            let is_told = seconds >= LONG || count >= MANY;
            is_told.then(|| {
                format!(
                    "{count} time steps: {at_least}{}",
                    rounded_duration_text(seconds)
                )
            })
        }
        Ahead::Factor { multiplications } => {
            let seconds = multiplications / MULTIPLICATIONS / current_num_threads() as f64;
            let text = || {
                format!(
                    "each factor of the stiffness takes {multiplications:.0e} multiplications: {}",
                    rounded_duration_text(seconds)
                )
            };
            (seconds >= LONG).then(text)
        }
    }
}

/// Announcement of the preparation of a number of bonds, where it takes long.
pub(crate) fn preparation_announcement(bonds: f64) -> Option<String> {
    let seconds = PREPARED_BOND * bonds / current_num_threads() as f64;
    let text = || {
        format!(
            "about {bonds:.1e} bonds to prepare: {}",
            rounded_duration_text(seconds)
        )
    };
    (seconds >= LONG).then(text)
}

/// An estimated time as text.
fn rounded_duration_text(seconds: f64) -> String {
    let text = match Duration::try_from_secs_f64(seconds) {
        Ok(time) if seconds < 3e9 => duration_text(time),
        _ => "more than a hundred years".to_owned(),
    };
    format!("roughly {text} on this machine")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_runs_are_told_and_short_ones_are_not() {
        let steps = |count| Ahead::TimeSteps {
            count,
            is_implicit: false,
        };
        assert_eq!(announcement(steps(1000), 1000), None);
        let text = announcement(steps(2 * MANY), 10).unwrap_or_default();
        assert!(
            text.starts_with("2000000000 time steps: roughly "),
            "{text}"
        );
        let factor = Ahead::Factor {
            multiplications: 1e20,
        };
        assert!(announcement(factor, 10).is_some_and(|it| it.ends_with("years on this machine")));
        assert!(
            preparation_announcement(1e6).is_none() && preparation_announcement(1e10).is_some()
        );
    }
}
