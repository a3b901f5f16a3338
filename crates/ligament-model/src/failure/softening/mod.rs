//! What a bond does between its limit and its breakage: the fall of its force.
//!
//! All laws are written for a bond whose measure is e, with its limit e_0, as functions of the largest kappa = e/e_0 so far: the
//! force is `mu` times that at the limit, and `omega = mu/kappa` times the elastic one of the same deformation. Unloading and
//! reloading below the largest kappa are straight through the origin.

pub mod brittle;
pub mod exponential;
mod law;
pub mod linear;
pub mod plastic;
pub mod two_branch;

pub use law::{Law, Parameter, Softened};

/// All laws of softening.
pub const LAWS: [&Law; 6] = [
    &brittle::LAW,
    &linear::LAW,
    &two_branch::LAW,
    &exponential::LAW,
    &plastic::LAW,
    &linear::BILINEAR,
];

#[cfg(feature = "case")]
crate::worded_by_table! { Law: LAWS, LAWS.into_iter().copied(), it => [it.word, it.words] }

/// Distance of the end from the limit, over the limit, below which the force of a bond drops.
const DROP: f64 = 1e-3;

/// What happens after the limit.
#[derive(Debug, Clone, PartialEq)]
pub struct AfterLimit {
    law: Law,
    /// Parameter of the law for each bond, shape (n_bonds); empty where it has none.
    parameter: Vec<f64>,
}

impl AfterLimit {
    /// A law with its parameter for each bond (n_bonds), if it has one.
    pub fn new(law: Law, parameter: Vec<f64>) -> Self {
        Self { law, parameter }
    }

    /// The law that goes by this word, with its [`parameter`](Self::parameter) for each bond; None for any other word.
    pub fn from_word(word: &str, parameter: Vec<f64>) -> Option<Self> {
        let law = LAWS.into_iter().find(|law| law.word == word)?;
        Some(Self::new(*law, parameter))
    }

    /// The word for the law in results.
    pub fn word(&self) -> &'static str {
        self.law.word
    }

    /// The law of softening.
    pub fn law(&self) -> &Law {
        &self.law
    }

    /// The parameter of the law for each bond, shape (n_bonds); empty where it has none.
    pub fn parameter(&self) -> &[f64] {
        &self.parameter
    }

    fn parameter_of(&self, bond: usize) -> f64 {
        self.parameter.get(bond).copied().unwrap_or(f64::NAN)
    }

    /// State of a bond whose largest e/e_0 so far is `kappa`, short of its [`end`](Self::end).
    pub fn at(&self, bond: usize, kappa: f64) -> Softened {
        if kappa <= 1.0 {
            return Softened::SOUND;
        }
        (self.law.at)(self.parameter_of(bond), kappa)
    }

    /// e/e_0 at which the bond breaks; infinite if never.
    #[inline]
    pub fn end(&self, bond: usize) -> f64 {
        if self.is_brittle() {
            return 1.0;
        }
        (self.law.end)(self.parameter_of(bond))
    }

    /// Largest e/e_0 whose softening counts before the bond breaks, at a deformation `kappa` times that at the limit: short of the
    /// [`end`](Self::end), so that a bond which waits for its turn to break has a little left to hold its points by. None where the
    /// force drops rather than falls: such a bond keeps what it has, and the order of breaking decides as for brittle ones.
    #[inline]
    pub fn extreme(&self, bond: usize, kappa: f64) -> Option<f64> {
        if kappa < 1.0 {
            return Some(kappa);
        }
        let end = self.end(bond);
        let drops = end - 1.0 < DROP && kappa >= end;
        let last = 1.0 + (end - 1.0) * (1.0 - exponential::LAST_FORCE);
        (!drops).then_some(kappa.min(last))
    }

    /// Energy that the whole life of the bond takes, over that stored at the limit; infinite if it never ends.
    pub fn total_dissipated(&self, bond: usize) -> f64 {
        (self.law.total)(self.parameter_of(bond))
    }

    /// Whether the bond breaks at its limit.
    #[inline]
    pub fn is_brittle(&self) -> bool {
        !self.law.softens
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

    fn laws() -> [AfterLimit; 4] {
        [
            AfterLimit::new(linear::LAW, vec![4.0]),
            // The kink, at 1.87, lies between two parts of every rule below.
            AfterLimit::new(two_branch::LAW, vec![6.915]),
            AfterLimit::new(exponential::LAW, vec![2.5]),
            AfterLimit::new(plastic::LAW, Vec::new()),
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
        for law in &laws()[..3] {
            let just_before = law.at(0, law.end(0) * (1.0 - 1e-12));
            assert!((just_before.dissipated / law.total_dissipated(0) - 1.0).abs() < 1e-2);
        }
        // A straight fall ends at zero force, an exponential one at the force where it is cut off.
        assert!(laws()[0].at(0, 4.0 - 1e-9).force < 1e-9);
        let [_, _, exponential, _] = laws();
        assert!(
            (exponential.at(0, exponential.end(0)).force - exponential::LAST_FORCE).abs() < 1e-15
        );
    }

    /// Petersson's corners: a bond that takes g = 2.5 times f_t w_0 has a third of its force at kappa = 1/3 + 0.8 g, and none at 3.6 g.
    /// The area g under force and opening is half of what the life takes over the energy at the limit, 1/2.
    #[test]
    fn two_branches_have_petersson_s_corners() {
        let parameter = two_branch::LAW.parameter.as_ref();
        let end = parameter.map(|it| (it.for_energy)(2.0 * 2.5));
        assert!(end.is_some_and(|end| (end - 3.6 * 2.5).abs() < 1e-14));
        let law = AfterLimit::new(two_branch::LAW, vec![9.0]);
        let force = |kappa: f64| law.at(0, kappa).force;
        assert!((force(1.0 / 3.0 + 0.8 * 2.5) - 1.0 / 3.0).abs() < 1e-15);
        assert!((force(1.0 + 0.5 * (1.0 / 3.0 + 2.0 - 1.0)) - 2.0 / 3.0).abs() < 1e-15);
        assert!((law.total_dissipated(0) - 5.0).abs() < 1e-14);
    }

    #[test]
    fn words_and_parameters_lead_back() {
        for law in laws()
            .into_iter()
            .chain([AfterLimit::new(brittle::LAW, Vec::new())])
        {
            let parameter = law.parameter().to_vec();
            assert_eq!(AfterLimit::from_word(law.word(), parameter), Some(law));
        }
        assert_eq!(AfterLimit::from_word("britle", Vec::new()), None);
    }

    /// A bond beyond its end has less than two thousandths left, one whose law is a drop waits with all it has.
    #[test]
    fn a_bond_beyond_its_end_waits_for_its_turn() {
        let [straight, two, exponential, plastic] = laws();
        for law in [straight, two, exponential] {
            let end = law.end(0);
            let extreme = law.extreme(0, 2.0 * end);
            assert_eq!(extreme, law.extreme(0, end));
            let left = extreme.map(|kappa| law.at(0, kappa).force);
            assert!(
                left.is_some_and(|force| force > 2e-4 && force < 2e-3),
                "{left:?}"
            );
            assert_eq!(law.extreme(0, 1.5), Some(1.5));
        }
        assert_eq!(plastic.extreme(0, 1e6), Some(1e6));
        let drop = AfterLimit::new(linear::LAW, vec![1.000001]);
        assert_eq!(drop.extreme(0, 1.1), None);
    }

    #[test]
    fn below_the_limit_nothing_changes() {
        for law in laws() {
            assert_eq!(law.at(0, 0.999), Softened::SOUND);
            assert_eq!(law.at(0, 1.0), Softened::SOUND);
        }
    }
}
