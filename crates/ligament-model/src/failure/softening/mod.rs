//! What a bond does between its limit and its breakage: the fall of its force.
//!
//! All laws are written for a bond whose measure is e, with its limit e_0, as functions of the largest kappa = e/e_0 so far: the
//! force is `mu` times that at the limit, and `omega = mu/kappa` times the elastic one of the same deformation. Unloading and
//! reloading below the largest kappa are straight through the origin.

pub mod bilinear;
pub mod exponential;
pub mod plastic;

/// What happens after the limit.
#[derive(Debug, Clone, PartialEq)]
pub enum AfterLimit {
    /// The bond breaks (Silling and Askari 2005, prototype microelastic brittle).
    Brittle,
    /// The force falls in a straight line to zero at `end` times the limit, shape (n_bonds).
    Bilinear {
        /// e_u/e_0.
        end: Vec<f64>,
    },
    /// The force falls exponentially, with this `scale`, shape (n_bonds).
    Exponential {
        /// e_f/e_0.
        scale: Vec<f64>,
    },
    /// The force stays.
    Plastic,
}

/// A bond past its limit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Softened {
    /// Force over force at the limit: the printed mu of the damage variables (MPPD eqs 45, 46, 50).
    pub force: f64,
    /// Secant stiffness over elastic stiffness.
    pub secant: f64,
    /// Energy that is gone, over that stored at the limit.
    pub dissipated: f64,
}

impl Softened {
    /// A bond that never passed its limit.
    pub const SOUND: Self = Self {
        force: 1.0,
        secant: 1.0,
        dissipated: 0.0,
    };
}

impl AfterLimit {
    /// The word for it in a case file, and in results.
    pub fn word(&self) -> &'static str {
        match self {
            Self::Brittle => "brittle",
            Self::Bilinear { .. } => "bilinear",
            Self::Exponential { .. } => "exponential",
            Self::Plastic => "plastic",
        }
    }

    /// What it has for each bond, shape (n_bonds); empty where it has nothing.
    pub fn parameter(&self) -> &[f64] {
        match self {
            Self::Brittle | Self::Plastic => &[],
            Self::Bilinear { end: values } | Self::Exponential { scale: values } => values,
        }
    }

    /// What goes by this word, with the [`parameter`](Self::parameter) of each bond; None for any other word.
    pub fn from_word(word: &str, parameter: Vec<f64>) -> Option<Self> {
        Some(match word {
            "brittle" => Self::Brittle,
            "bilinear" => Self::Bilinear { end: parameter },
            "exponential" => Self::Exponential { scale: parameter },
            "plastic" => Self::Plastic,
            _ => return None,
        })
    }

    /// State of a bond whose largest e/e_0 so far is `kappa`, short of its [`end`](Self::end).
    pub fn at(&self, bond: usize, kappa: f64) -> Softened {
        if kappa <= 1.0 {
            return Softened::SOUND;
        }
        match self {
            Self::Brittle => Softened::SOUND,
            Self::Bilinear { end } => bilinear::at(end[bond], kappa),
            Self::Exponential { scale } => exponential::at(scale[bond], kappa),
            Self::Plastic => plastic::at(kappa),
        }
    }

    /// e/e_0 at which the bond breaks; infinite if never.
    pub fn end(&self, bond: usize) -> f64 {
        match self {
            Self::Brittle => 1.0,
            Self::Bilinear { end } => end[bond],
            Self::Exponential { scale } => exponential::end(scale[bond]),
            Self::Plastic => f64::INFINITY,
        }
    }

    /// Energy that the whole life of the bond takes, over that stored at the limit; infinite if it never ends.
    pub fn total_dissipated(&self, bond: usize) -> f64 {
        match self {
            Self::Brittle => 1.0,
            Self::Bilinear { end } => bilinear::total(end[bond]),
            Self::Exponential { scale } => exponential::total(scale[bond]),
            Self::Plastic => f64::INFINITY,
        }
    }

    /// Whether the bond breaks at its limit.
    pub fn is_brittle(&self) -> bool {
        *self == Self::Brittle
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Work of the force up to kappa by Simpson's rule, less what unloading gives back.
    fn dissipated(law: &AfterLimit, kappa: f64) -> f64 {
        const PARTS: usize = 20_000;
        let step = (kappa - 1.0) / PARTS as f64;
        let force = |k: f64| law.at(0, k).force;
        let after: f64 = (0..PARTS)
            .map(|part| {
                let start = 1.0 + part as f64 * step;
                step / 6.0 * (force(start) + 4.0 * force(start + 0.5 * step) + force(start + step))
            })
            .sum();
        // Twice, because the energy at the limit is 1/2.
        2.0 * (0.5 + after - 0.5 * law.at(0, kappa).force * kappa)
    }

    fn laws() -> [AfterLimit; 3] {
        [
            AfterLimit::Bilinear { end: vec![4.0] },
            AfterLimit::Exponential { scale: vec![2.5] },
            AfterLimit::Plastic,
        ]
    }

    #[test]
    fn dissipated_energy_is_the_area_under_the_force() {
        for law in laws() {
            for kappa in [1.0, 1.3, 2.0, 3.9] {
                let softened = law.at(0, kappa);
                let expected = dissipated(&law, kappa);
                assert!(
                    (softened.dissipated - expected).abs() < 1e-10,
                    "{law:?} at {kappa}"
                );
                assert!((softened.secant * kappa - softened.force).abs() < 1e-15);
            }
        }
    }

    #[test]
    fn the_whole_life_takes_what_the_ends_say() {
        for law in &laws()[..2] {
            let just_before = law.at(0, law.end(0) * (1.0 - 1e-12));
            assert!((just_before.dissipated / law.total_dissipated(0) - 1.0).abs() < 1e-2);
        }
        // A straight fall ends at zero force, an exponential one at the force where it is cut off.
        assert!(laws()[0].at(0, 4.0 - 1e-9).force < 1e-9);
        let [_, exponential, _] = laws();
        assert!(
            (exponential.at(0, exponential.end(0)).force - exponential::LAST_FORCE).abs() < 1e-15
        );
    }

    #[test]
    fn words_and_parameters_lead_back() {
        for law in laws().into_iter().chain([AfterLimit::Brittle]) {
            let parameter = law.parameter().to_vec();
            assert_eq!(AfterLimit::from_word(law.word(), parameter), Some(law));
        }
        assert_eq!(AfterLimit::from_word("britle", Vec::new()), None);
    }

    #[test]
    fn below_the_limit_nothing_changes() {
        for law in laws() {
            assert_eq!(law.at(0, 0.999), Softened::SOUND);
            assert_eq!(law.at(0, 1.0), Softened::SOUND);
        }
    }
}
