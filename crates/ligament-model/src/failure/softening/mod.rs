//! Laws of softening: the fall of the force of a bond between its limit and its breakage.
//!
//! All laws are written for a bond whose measure is e, with its limit e_0, as functions of the largest kappa = e/e_0 so far: the
//! force is `mu` times that at the limit, and `omega = mu/kappa` times the elastic one of the same deformation. Unloading and
//! reloading below the largest kappa are straight through the origin.

pub mod brittle;
#[cfg(feature = "case")]
mod case;
pub mod cornelissen;
mod curve;
pub mod exponential;
mod law;
pub mod linear;
pub mod model_codes;
pub mod plastic;
mod softened;
pub mod two_branch;

pub use curve::{Curve, CurveError};
pub use law::{Fall, Law, Parameter};
pub use softened::Softened;

/// All laws of softening that have a name.
pub const LAWS: [&Law; 9] = [
    &brittle::LAW,
    &linear::LAW,
    &two_branch::LAW,
    &cornelissen::LAW,
    &model_codes::CEB_FIP,
    &model_codes::FIB,
    &exponential::LAW,
    &plastic::LAW,
    &linear::BILINEAR,
];

/// Distance of the end from the limit, over the limit, below which the force of a bond drops.
const DROP: f64 = 1e-3;

/// Law of the bonds after their limit.
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

    /// The law of a [text](Self::text) in results, with its [`parameter`](Self::parameter) for each bond; None for any other text.
    pub fn from_text(text: &str, parameter: Vec<f64>) -> Option<Self> {
        let named = LAWS.into_iter().find(|law| law.word == text).cloned();
        Some(Self::new(named.or_else(|| Law::of_text(text))?, parameter))
    }

    /// The [text](Law::text) for the law in results.
    pub fn text(&self) -> String {
        self.law.text()
    }

    /// The word for the law.
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
        self.law.at(self.parameter_of(bond), kappa)
    }

    /// e/e_0 at which the bond breaks; infinite if never.
    #[inline]
    pub fn end(&self, bond: usize) -> f64 {
        if self.is_brittle() {
            return 1.0;
        }
        self.law.end(self.parameter_of(bond))
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

    /// Energy dissipated by the bond until it breaks over the energy stored at the limit; infinite if it never breaks.
    pub fn total_dissipated(&self, bond: usize) -> f64 {
        self.law.total(self.parameter_of(bond))
    }

    /// Whether the bond breaks at its limit.
    #[inline]
    pub fn is_brittle(&self) -> bool {
        !self.law.softens
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]
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

    /// Laws by curves, named and given, with ends beyond their steepest slopes.
    fn curves() -> [AfterLimit; 4] {
        let given = [[0.0, 3e6], [2e-5, 1e6], [3e-5, 1e6], [1e-4, 0.0]];
        let laws = [
            cornelissen::LAW,
            model_codes::CEB_FIP,
            model_codes::FIB,
            Curve::new(&given).map(Law::by_curve).unwrap(),
        ];
        laws.map(|law| AfterLimit::new(law, vec![12.0]))
    }

    /// Areas under the stress over the opening by the sources: w_c = 5.136 G/f_t with c_1 = 3 and c_2 = 6.93 (Cornelissen 1986), 7 G/f_t by CEB-FIP
    /// 1990 and 5 G/f_t by the fib Model Code. 1e-4: the straight lines of the first; the others are exact. 1e-8 of the energy: the rule above
    /// across the corners, whose slopes differ by up to 3 over steps of 5e-4.
    #[test]
    fn curves_have_the_areas_of_their_sources() {
        let openings = [5.136, 7.0, 5.0];
        for (law, opening) in curves().iter().zip(openings) {
            let area = 0.5 * law.total_dissipated(0) / 12.0;
            assert!((area * opening - 1.0).abs() < 1e-4, "{law:?} {area}");
        }
        for law in curves() {
            for kappa in [1.0, 1.3, 2.0, 3.9, 11.0] {
                let softened = law.at(0, kappa);
                let error = (softened.dissipated - dissipated(&law, kappa)).abs();
                assert!(error < 1e-5, "{} at {kappa}: {error:e}", law.word());
                assert!((softened.secant * kappa - softened.force).abs() < 1e-15);
            }
            let end = law.end(0);
            let just_before = law.at(0, end * (1.0 - 1e-12));
            assert!((just_before.dissipated / law.total_dissipated(0) - 1.0).abs() < 1e-9);
            assert!(just_before.force < 1e-9);
            let parameter = law.law().parameter_for(law.total_dissipated(0));
            assert!((parameter - 12.0).abs() < 1e-12);
            let again = AfterLimit::from_text(&law.text(), law.parameter().to_vec());
            assert_eq!(again, Some(law));
        }
    }

    /// The curve through Petersson's corners is the law in two lines, and a straight curve the law in one; 1e-12: rounding.
    #[test]
    fn curves_of_straight_lines_are_the_laws_in_lines() {
        let kinked = Curve::kinked([2.0 / 9.0, 1.0 / 3.0]).unwrap();
        let straight = Curve::new(&[[0.0, 1.0], [1.0, 0.0]]).unwrap();
        for (curve, law) in [(kinked, two_branch::LAW), (straight, linear::LAW)] {
            let curve = Law::by_curve(curve);
            let [ours, known] = [&curve, &law].map(|it| it.parameter.unwrap());
            assert!((ours.above - known.above).abs() < 1e-12);
            assert!((ours.least_energy - known.least_energy).abs() < 1e-12);
            assert!((curve.parameter_for(5.0) - law.parameter_for(5.0)).abs() < 1e-12);
            for kappa in [1.0, 1.2, 2.0, 3.5, 7.0, 8.9] {
                let [ours, known] = [&curve, &law].map(|it| it.at(9.0, kappa));
                assert!((ours.force - known.force).abs() < 1e-12, "{kappa}");
                assert!(
                    (ours.dissipated - known.dissipated).abs() < 1e-12,
                    "{kappa}"
                );
            }
        }
    }

    /// What named curves ask of their end is no less than their steepest slope does, to 1 %.
    #[test]
    fn ends_of_named_curves_exceed_their_steepest_slopes() {
        for law in &curves()[..3] {
            let parameter = law.law().parameter.unwrap();
            let corners = law.law().stress_over_opening().unwrap();
            let area = 0.5 * law.law().total(1.0);
            // Slopes over G/f_t, of which the end has 1/area.
            let slopes = corners
                .windows(2)
                .map(|it| (it[0][1] - it[1][1]) / (it[1][0] - it[0][0]) / area);
            let steepest = slopes.fold(0.0, f64::max);
            assert!(
                parameter.above >= steepest * (1.0 - 1e-9) && parameter.above < 1.02 * steepest
            );
            let least = law.law().total(parameter.above);
            assert!((parameter.least_energy / least - 1.0).abs() < 1e-3);
        }
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
        let end = two_branch::LAW.parameter_for(2.0 * 2.5);
        assert!((end - 3.6 * 2.5).abs() < 1e-14);
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
            assert_eq!(AfterLimit::from_text(&law.text(), parameter), Some(law));
        }
        assert_eq!(AfterLimit::from_text("britle", Vec::new()), None);
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
