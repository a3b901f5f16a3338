//! An entry of a table: a known value, its reliability, and the verdict on the computed value.

use super::printed::{PrintedNumber, Tolerance};

/// A known value for comparison with a computed one.
#[derive(Debug, Clone, PartialEq)]
pub struct Entry {
    /// Labels of the value, one for each key of the heading.
    pub labels: Vec<String>,
    /// Known value.
    pub known: PrintedNumber,
    /// Allowed distance of the computed value from the known one.
    pub allowed: Tolerance,
    /// Reliability of the value.
    pub standing: Reliability,
    /// Whether the entry belongs to the fast subset.
    pub is_fast: bool,
}

/// Reliability of a known value.
#[derive(Debug, Clone, PartialEq)]
pub enum Reliability {
    /// The value is reliable.
    Sound,
    /// The value is reliable, but truncated after its last digit, not rounded.
    Truncated {
        /// Evidence for the truncation.
        reason: String,
    },
    /// The value is a misprint.
    Misprint {
        /// Correct value, for the comparison.
        instead: PrintedNumber,
        /// Evidence for the misprint.
        reason: String,
    },
    /// The set-up of the table does not give the value, for unknown reasons.
    Open {
        /// Value of an independent calculation, for the comparison.
        instead: PrintedNumber,
        /// Evidence about the value.
        reason: String,
    },
    /// The value is reliable, and the method does not reach it within the tolerance.
    Missed {
        /// Value of the method, for the comparison where it misses the known value.
        instead: PrintedNumber,
        /// Reason why the method misses the value.
        reason: String,
    },
}

/// Verdict on the computed value of an entry.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// The computed value, rounded, equals the known one to its last digit.
    Rounded,
    /// The computed value, truncated, equals the known one to its last digit.
    Truncated,
    /// The computed value is within the tolerance.
    Within,
    /// The known value is a misprint, and the computed one agrees with the correct value.
    Misprint,
    /// The known value is not met for unknown reasons, and the computed one agrees with an independent calculation.
    Differs,
    /// The known value is right and not met, for a known reason.
    Missed,
    /// The entry is shown without a judgement.
    Shown,
    /// The computed value is outside of the tolerance.
    Failed,
}

impl Entry {
    /// Verdict on a computed value.
    pub(super) fn verdict(&self, computed: f64) -> Verdict {
        let agrees = |printed: &PrintedNumber| self.allowed.admits(printed, computed);
        match &self.standing {
            _ if !computed.is_finite() => Verdict::Failed,
            Reliability::Sound if self.allowed == Tolerance::Any => Verdict::Shown,
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
            Reliability::Truncated { .. } if self.known.is_truncated_from(computed) => {
                Verdict::Truncated
            }
            Reliability::Misprint { instead, .. } if agrees(instead) => Verdict::Misprint,
            Reliability::Open { instead, .. } if agrees(instead) => Verdict::Differs,
            _ => Verdict::Failed,
        }
    }
}

impl Reliability {
    /// Reason why the known value is not used directly, if any.
    pub(super) fn reason(&self) -> Option<&str> {
        match self {
            Self::Sound => None,
            Self::Truncated { reason }
            | Self::Misprint { reason, .. }
            | Self::Open { reason, .. }
            | Self::Missed { reason, .. } => Some(reason),
        }
    }

    /// Value for the comparison in place of the known one, if any.
    pub(super) fn replacement_value(&self) -> Option<&PrintedNumber> {
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

    /// Text of the verdict.
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

    fn entry(known: &str, allowed: Tolerance, standing: Reliability) -> Entry {
        Entry {
            labels: Vec::new(),
            known: PrintedNumber::parse(known).unwrap(),
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
        let printed = entry("2294.9", Tolerance::Digits, Reliability::Sound);
        assert_eq!(
            verdicts(&printed, &[2294.94, 2294.86, 2294.96]),
            [Rounded, Rounded, Failed]
        );
        let near = entry("2294.9", Tolerance::Relative(0.01), Reliability::Sound);
        assert_eq!(
            verdicts(&near, &[2294.9, 2310.0, 2272.0, 2318.0]),
            [Rounded, Within, Within, Failed]
        );
        // Half a unit of the only digit of 0 is no excuse for missing the tolerance.
        let zero = entry("0", Tolerance::Absolute(0.01), Reliability::Sound);
        assert_eq!(verdicts(&zero, &[-0.005, 0.3]), [Rounded, Failed]);
        let shown = entry("0.1", Tolerance::Any, Reliability::Sound);
        assert_eq!(verdicts(&shown, &[0.1, 7.0]), [Shown, Shown]);
        for it in [printed, near, zero, shown] {
            assert_eq!(verdicts(&it, &[f64::NAN, f64::INFINITY]), [Failed, Failed]);
        }
    }

    /// A band may reach further to one side; for a missed value it is around the value of the method.
    #[test]
    fn a_band_is_about_the_value_it_belongs_to() {
        use Verdict::{Failed, Missed, Within};
        let band = Tolerance::Between(-0.05, 0.01);
        let sound = entry("1.00", band, Reliability::Sound);
        let found = verdicts(&sound, &[0.96, 1.008, 1.02, 0.94]);
        assert_eq!(found, [Within, Within, Failed, Failed]);
        let (instead, reason) = (
            PrintedNumber::parse("0.80").unwrap(),
            String::from("few bonds"),
        );
        let missed = entry("1.00", band, Reliability::Missed { instead, reason });
        let found = verdicts(&missed, &[0.96, 0.76, 0.82]);
        assert_eq!(found, [Within, Missed, Failed]);
    }

    #[test]
    fn a_truncated_value_is_met_by_what_was_cut() {
        use Verdict::{Failed, Truncated};
        let reason = String::from("cut");
        let cut = entry(
            "0.01085",
            Tolerance::Digits,
            Reliability::Truncated { reason },
        );
        let found = verdicts(&cut, &[0.010856, 0.01085, 0.010849, 0.010861]);
        assert_eq!(found, [Truncated, Truncated, Failed, Failed]);
        let reason = String::from("cut");
        let negative = entry("-0.5", Tolerance::Digits, Reliability::Truncated { reason });
        assert_eq!(verdicts(&negative, &[-0.58, -0.48]), [Truncated, Failed]);
    }

    #[test]
    fn a_misprint_must_still_be_what_should_stand_there() {
        let (instead, reason) = (
            PrintedNumber::parse("2053").unwrap(),
            String::from("digits exchanged"),
        );
        let misprint = entry(
            "2025.5",
            Tolerance::Digits,
            Reliability::Misprint {
                instead: instead.clone(),
                reason: reason.clone(),
            },
        );
        let found = verdicts(&misprint, &[2053.2, 2025.5]);
        assert_eq!(found, [Verdict::Misprint, Verdict::Failed]);
        let open = entry(
            "2025.5",
            Tolerance::Relative(0.001),
            Reliability::Open { instead, reason },
        );
        let found = verdicts(&open, &[2054.0, 2025.5]);
        assert_eq!(found, [Verdict::Differs, Verdict::Failed]);
    }

    #[test]
    fn a_missed_value_must_still_be_missed_by_as_much() {
        let (instead, reason) = (
            PrintedNumber::parse("0.8").unwrap(),
            String::from("few bonds"),
        );
        let missed = entry(
            "0.0",
            Tolerance::Absolute(0.3),
            Reliability::Missed { instead, reason },
        );
        let found = verdicts(&missed, &[0.7, 1.2, 0.2, 0.01]);
        use Verdict::{Failed, Missed, Rounded, Within};
        assert_eq!(found, [Missed, Failed, Within, Rounded]);
    }
}
