//! An entry of a table: a known value, whether it is to be trusted, and the verdict on what was computed.

use super::printed::{Allowed, Printed};

/// A value that is known before it is computed.
#[derive(Debug, Clone, PartialEq)]
pub struct Entry {
    /// Labels of the value, one for each key of the heading.
    pub labels: Vec<String>,
    /// The value.
    pub known: Printed,
    /// Allowed distance of the computed value from the known one.
    pub allowed: Allowed,
    /// Whether the value is to be trusted.
    pub standing: Reliability,
    /// Whether the entry belongs to the fast subset.
    pub is_fast: bool,
}

/// Whether a known value is to be trusted.
#[derive(Debug, Clone, PartialEq)]
pub enum Reliability {
    /// The value is to be trusted.
    Sound,
    /// The value is to be trusted, but its last digit was cut off, not rounded.
    Truncated {
        /// The evidence for the cut.
        reason: String,
    },
    /// The value was printed in error.
    Misprint {
        /// What should stand there, and is compared with.
        instead: Printed,
        /// The evidence for the error.
        reason: String,
    },
    /// The set-up of the table does not lead to the value, for no known reason.
    Open {
        /// What an independent calculation gives, and is compared with.
        instead: Printed,
        /// The knowledge about the value.
        reason: String,
    },
    /// The value is to be trusted, and the method does not come near enough to it.
    Missed {
        /// What the method gives, and is compared with where it misses the value.
        instead: Printed,
        /// The reason why it misses it.
        reason: String,
    },
}

/// The outcome of comparing an entry with what was computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// The computed value, rounded, is the known one to its last digit.
    Rounded,
    /// The computed value, cut off, is the known one to its last digit.
    Truncated,
    /// The computed value is as near as it should be.
    Within,
    /// The known value is a misprint, and the computed one is what should stand there.
    Misprint,
    /// The known value is not met for no known reason, and the computed one is that of an independent calculation.
    Differs,
    /// The known value is right and is not met, for a known reason.
    Missed,
    /// The entry is shown, not judged.
    Shown,
    /// The computed value should be near the known one, and is not.
    Failed,
}

impl Entry {
    /// What becomes of the entry with this computed value.
    pub(super) fn verdict(&self, computed: f64) -> Verdict {
        let agrees = |printed: &Printed| self.allowed.admits(printed, computed);
        match &self.standing {
            _ if !computed.is_finite() => Verdict::Failed,
            Reliability::Sound if self.allowed == Allowed::Any => Verdict::Shown,
            Reliability::Missed { instead, .. } if !agrees(&self.known) => match agrees(instead) {
                true => Verdict::Missed,
                false => Verdict::Failed,
            },
            Reliability::Sound if !agrees(&self.known) => Verdict::Failed,
            Reliability::Sound | Reliability::Missed { .. }
                if self.known.is_rounded_from(computed) =>
            {
                Verdict::Rounded
            }
            Reliability::Sound | Reliability::Missed { .. } => Verdict::Within,
            Reliability::Truncated { .. } if self.known.is_cut_from(computed) => Verdict::Truncated,
            Reliability::Misprint { instead, .. } if agrees(instead) => Verdict::Misprint,
            Reliability::Open { instead, .. } if agrees(instead) => Verdict::Differs,
            _ => Verdict::Failed,
        }
    }
}

impl Reliability {
    /// The reason why the known value is not taken as it is.
    pub(super) fn reason(&self) -> Option<&str> {
        match self {
            Self::Sound => None,
            Self::Truncated { reason }
            | Self::Misprint { reason, .. }
            | Self::Open { reason, .. }
            | Self::Missed { reason, .. } => Some(reason),
        }
    }

    /// What the computed value is compared with instead of the known one.
    pub(super) fn instead(&self) -> Option<&Printed> {
        match self {
            Self::Misprint { instead, .. }
            | Self::Open { instead, .. }
            | Self::Missed { instead, .. } => Some(instead),
            Self::Sound | Self::Truncated { .. } => None,
        }
    }
}

impl Verdict {
    /// All verdicts, the best first.
    pub const ALL: [Self; 8] = [
        Self::Rounded,
        Self::Truncated,
        Self::Within,
        Self::Misprint,
        Self::Differs,
        Self::Missed,
        Self::Shown,
        Self::Failed,
    ];

    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Self::Rounded => "rounded",
            Self::Truncated => "truncated",
            Self::Within => "within tolerance",
            Self::Misprint => "misprint",
            Self::Differs => "differs, cause unknown",
            Self::Missed => "missed",
            Self::Shown => "not judged",
            Self::Failed => "FAILED",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn entry(known: &str, allowed: Allowed, standing: Reliability) -> Entry {
        Entry {
            labels: Vec::new(),
            known: Printed::parse(known).unwrap(),
            allowed,
            standing,
            is_fast: true,
        }
    }

    /// The verdicts on several computed values.
    fn verdicts(entry: &Entry, computed: &[f64]) -> Vec<Verdict> {
        computed.iter().map(|value| entry.verdict(*value)).collect()
    }

    #[test]
    fn a_sound_value_is_met_nearly_met_or_missed() {
        use Verdict::{Failed, Rounded, Shown, Within};
        let printed = entry("2294.9", Allowed::Digits, Reliability::Sound);
        assert_eq!(
            verdicts(&printed, &[2294.94, 2294.86, 2294.96]),
            [Rounded, Rounded, Failed]
        );
        let near = entry("2294.9", Allowed::Relative(0.01), Reliability::Sound);
        assert_eq!(
            verdicts(&near, &[2294.9, 2310.0, 2272.0, 2318.0]),
            [Rounded, Within, Within, Failed]
        );
        // Half a unit of the only digit of 0 is no excuse for missing the tolerance.
        let zero = entry("0", Allowed::Absolute(0.01), Reliability::Sound);
        assert_eq!(verdicts(&zero, &[-0.005, 0.3]), [Rounded, Failed]);
        let shown = entry("0.1", Allowed::Any, Reliability::Sound);
        assert_eq!(verdicts(&shown, &[0.1, 7.0]), [Shown, Shown]);
        for it in [printed, near, zero, shown] {
            assert_eq!(verdicts(&it, &[f64::NAN, f64::INFINITY]), [Failed, Failed]);
        }
    }

    #[test]
    fn a_truncated_value_is_met_by_what_was_cut() {
        use Verdict::{Failed, Truncated};
        let reason = String::from("cut");
        let cut = entry(
            "0.01085",
            Allowed::Digits,
            Reliability::Truncated { reason },
        );
        let found = verdicts(&cut, &[0.010856, 0.01085, 0.010849, 0.010861]);
        assert_eq!(found, [Truncated, Truncated, Failed, Failed]);
        let reason = String::from("cut");
        let negative = entry("-0.5", Allowed::Digits, Reliability::Truncated { reason });
        assert_eq!(verdicts(&negative, &[-0.58, -0.48]), [Truncated, Failed]);
    }

    #[test]
    fn a_misprint_must_still_be_what_should_stand_there() {
        let (instead, reason) = (
            Printed::parse("2053").unwrap(),
            String::from("digits exchanged"),
        );
        let misprint = entry(
            "2025.5",
            Allowed::Digits,
            Reliability::Misprint {
                instead: instead.clone(),
                reason: reason.clone(),
            },
        );
        let found = verdicts(&misprint, &[2053.2, 2025.5]);
        assert_eq!(found, [Verdict::Misprint, Verdict::Failed]);
        let open = entry(
            "2025.5",
            Allowed::Relative(0.001),
            Reliability::Open { instead, reason },
        );
        let found = verdicts(&open, &[2054.0, 2025.5]);
        assert_eq!(found, [Verdict::Differs, Verdict::Failed]);
    }

    #[test]
    fn a_missed_value_must_still_be_missed_by_as_much() {
        let (instead, reason) = (Printed::parse("0.8").unwrap(), String::from("few bonds"));
        let missed = entry(
            "0.0",
            Allowed::Absolute(0.3),
            Reliability::Missed { instead, reason },
        );
        let found = verdicts(&missed, &[0.7, 1.2, 0.2, 0.01]);
        use Verdict::{Failed, Missed, Rounded, Within};
        assert_eq!(found, [Missed, Failed, Within, Rounded]);
    }
}
