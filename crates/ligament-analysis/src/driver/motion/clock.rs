//! Times of a motion: equal time steps, a fixed number of them for each row of the history, and the pace of implicit steps.

use serde::{Deserialize, Serialize};

use crate::history::Ahead;
use crate::motion::{MotionError, MotionSettings, Scheme};

/// Largest number of time steps: a step of the smallest body takes a microsecond, so that these take eleven days.
const MOST_STEPS: f64 = 1e12;

/// Largest number of times that a step is halved.
pub(super) const HALVINGS: usize = 10;

/// Steps of a motion without a breakage after which halved steps are doubled again.
pub(super) const CALM: usize = 8;

/// Times of a motion.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Clock {
    /// Duration, s.
    pub(super) duration: f64,
    /// Number of rows of the history after the first one.
    pub(super) rows: usize,
    /// Number of time steps between two rows.
    pub(super) steps_per_row: usize,
}

impl Clock {
    /// Times with the largest step that divides the time between two rows and is not larger than `at_most`, s.
    ///
    /// # Errors
    ///
    /// If there are more steps than any machine can take.
    fn new(settings: &MotionSettings, at_most: f64) -> Result<Self, MotionError> {
        let MotionSettings { duration, rows, .. } = *settings;
        let between = duration / rows as f64;
        // A step that divides the time but for rounding is not made smaller.
        let steps_per_row = (between / at_most * (1.0 - 1e-12)).ceil().max(1.0);
        let steps = rows as f64 * steps_per_row;
        if steps.is_nan() || steps > MOST_STEPS {
            return Err(MotionError::TooManySteps { steps, at_most });
        }
        Ok(Self {
            duration,
            rows,
            steps_per_row: steps_per_row as usize,
        })
    }

    /// What steps at these times are to an observer.
    pub(super) fn ahead(&self, is_implicit: bool) -> Ahead {
        Ahead::TimeSteps {
            count: self.rows * self.steps_per_row,
            is_implicit,
        }
    }

    /// Times of implicit steps, without a given step from row to row. Where equilibria follow each other, a row is halved until its parts are as short as a step of the motion.
    ///
    /// # Errors
    ///
    /// If there are too many.
    pub(super) fn implicit(settings: &MotionSettings) -> Result<Self, MotionError> {
        let clock = Self::new(settings, settings.step.unwrap_or(settings.duration))?;
        let steps_per_row = match settings.scheme {
            Scheme::Auto => clock.steps_per_row.next_power_of_two(),
            Scheme::Explicit | Scheme::Implicit => clock.steps_per_row,
        };
        Ok(Self {
            steps_per_row,
            ..clock
        })
    }

    /// Times with a given step, or with a fraction of the critical step, s.
    ///
    /// # Errors
    ///
    /// If the given step is larger than the critical one, or there are too many.
    pub(super) fn explicit(settings: &MotionSettings, critical: f64) -> Result<Self, MotionError> {
        match settings.step {
            Some(step) if step > critical => Err(MotionError::StepTooLarge { step, critical }),
            Some(step) => Self::new(settings, step),
            None => Self::new(settings, settings.safety * critical),
        }
    }

    /// Time step, s.
    pub(super) fn step(&self) -> f64 {
        self.duration / (self.rows * self.steps_per_row) as f64
    }

    /// Time after a number of steps, s.
    pub(super) fn time(&self, steps: usize) -> f64 {
        self.duration * (steps as f64 / (self.rows * self.steps_per_row) as f64)
    }
}

/// Kind and length of the steps.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Pace {
    /// Whether the steps have inertia; steps without it are equilibria.
    pub(super) has_inertia: bool,
    /// Number of halvings: of the steps of the clock, without inertia of the time between two rows.
    pub(super) halvings: usize,
    /// Number of steps since the last halving or breakage.
    pub(super) calm: usize,
}

impl Pace {
    /// Steps without inertia from row to row.
    pub(super) const STATICS: Self = Self {
        has_inertia: false,
        halvings: 0,
        calm: 0,
    };

    /// Steps of the clock, with inertia.
    pub(super) const MOTION: Self = Self {
        has_inertia: true,
        ..Self::STATICS
    };

    /// Steps of half the length.
    pub(super) fn halved(self) -> Self {
        Self {
            halvings: self.halvings + 1,
            calm: 0,
            ..self
        }
    }

    /// Steps of twice the length.
    pub(super) fn doubled(self) -> Self {
        Self {
            halvings: self.halvings - 1,
            calm: 0,
            ..self
        }
    }

    /// Largest number of halvings.
    pub(super) fn most_halvings(&self, clock: &Clock) -> usize {
        match self.has_inertia {
            true => HALVINGS,
            false => clock.steps_per_row.trailing_zeros() as usize,
        }
    }

    /// Length of a step, in parts of a step of the clock: 1/2^[`HALVINGS`] of it each.
    pub(super) fn parts(&self, clock: &Clock) -> usize {
        let whole = 1_usize << HALVINGS;
        match self.has_inertia {
            true => whole >> self.halvings,
            false => (clock.steps_per_row * whole) >> self.halvings,
        }
    }

    /// Number of calm steps after which the steps are doubled.
    pub(super) fn calm_enough(&self) -> usize {
        if self.has_inertia { CALM } else { 1 }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]
mod tests {
    use super::*;

    #[test]
    fn steps_divide_the_time_between_rows() {
        let explicit = |step: Option<f64>| {
            let settings = MotionSettings {
                rows: 4,
                step,
                ..MotionSettings::new(1e-5)
            };
            Clock::explicit(&settings, 1e-6)
        };
        let clock = explicit(None).unwrap();
        assert_eq!(clock.steps_per_row, 4);
        assert_eq!(clock.time(16), 1e-5);
        // 2.5 e-6 s are ten steps of 2.5e-7 s.
        let given = explicit(Some(2.5e-7)).unwrap();
        assert_eq!(given.steps_per_row, 10);
        let too_large = explicit(Some(2e-6));
        assert!(matches!(too_large, Err(MotionError::StepTooLarge { .. })));
    }
}
