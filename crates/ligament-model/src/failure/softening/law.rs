//! Laws of softening.

use super::curve::Curve;
use super::softened::Softened;

/// Word of a law by a curve that a user gave.
const WORD: &str = "curve";

/// A law of softening: the fall of a bond's force after its limit e_0.
#[derive(Debug, Clone)]
pub struct Law {
    /// Word of the law in case files and in results.
    pub word: &'static str,
    /// Sentence on the force.
    pub words: &'static str,
    /// Papers of the law, by the keys of the references, with their equations; empty without any.
    pub source: &'static str,
    /// Short description of the force.
    pub force: &'static str,
    /// Parameter of the law, if there is one.
    pub parameter: Option<Parameter>,
    /// Whether a bond still carries force after its limit.
    pub softens: bool,
    /// Reason why the law is only for sliding bonds, with `{}` for the criterion of sliding; None for any bond.
    pub sliding_because: Option<&'static str>,
    /// Force and energy after the limit.
    pub fall: Fall,
}

/// Force and energy of a bond after its limit.
#[derive(Debug, Clone)]
pub enum Fall {
    /// Functions of the law's parameter, which is arbitrary for a law without one.
    Formula {
        /// State of a bond past its limit, from the parameter and the largest kappa = e/e_0 so far.
        at: fn(f64, f64) -> Softened,
        /// kappa at which the bond breaks; infinite if never.
        end: fn(f64) -> f64,
        /// Energy that the whole life of the bond takes, over that stored at the limit; infinite if it never ends.
        total: fn(f64) -> f64,
        /// The parameter for a given ratio `total`.
        for_energy: fn(f64) -> f64,
    },
    /// Stress over the opening of a crack, as a user gave it; the parameter is kappa at its end.
    Curve(Curve),
    /// Stress over the opening of a crack by a law that has a name; the parameter is kappa at its end.
    Named(fn() -> &'static Curve),
}

/// The parameter of a law of softening.
#[derive(Debug, Clone, Copy)]
pub struct Parameter {
    /// Name of the parameter.
    pub key: &'static str,
    /// Description of the parameter, for text before its value.
    pub words: &'static str,
    /// Value that the parameter must exceed.
    pub above: f64,
    /// Reason why only this law has the parameter, with `{}` for the law.
    pub exclusive_reason: &'static str,
    /// Ratio of dissipated energy to energy stored at the limit that every parameter exceeds.
    pub least_energy: f64,
}

impl Parameter {
    /// The parameter `end` of a law whose force falls to zero: the deformation at zero force over the deformation at the limit, which must exceed
    /// `above`.
    pub const fn end(above: f64, least_energy: f64) -> Self {
        Self {
            key: "end",
            words: ", to zero at",
            above,
            exclusive_reason: "only a force that falls to zero, such as {}, has an end",
            least_energy,
        }
    }
}

impl Law {
    /// State of a bond past its limit, from the law's parameter and the largest kappa = e/e_0 so far.
    pub fn at(&self, parameter: f64, kappa: f64) -> Softened {
        match &self.fall {
            Fall::Formula { at, .. } => at(parameter, kappa),
            Fall::Curve(curve) => curve.at(parameter, kappa),
            Fall::Named(curve) => curve().at(parameter, kappa),
        }
    }

    /// kappa at which the bond breaks; infinite if never.
    pub fn end(&self, parameter: f64) -> f64 {
        match &self.fall {
            Fall::Formula { end, .. } => end(parameter),
            Fall::Curve(_) | Fall::Named(_) => parameter,
        }
    }

    /// Energy that the whole life of the bond takes, over that stored at the limit; infinite if it never ends.
    pub fn total(&self, parameter: f64) -> f64 {
        match &self.fall {
            Fall::Formula { total, .. } => total(parameter),
            Fall::Curve(curve) => curve.total(parameter),
            Fall::Named(curve) => curve().total(parameter),
        }
    }

    /// The parameter for which the dissipated energy of a bond is `energy` times the energy stored at its limit, more than the least ratio.
    pub fn parameter_for(&self, energy: f64) -> f64 {
        match &self.fall {
            Fall::Formula { for_energy, .. } => for_energy(energy),
            Fall::Curve(_) | Fall::Named(_) => energy / self.total(1.0),
        }
    }

    /// Openings of a crack over G/f_t and stresses over the strength f_t from the limit to the end of the law, shape (n, 2); None for a law without a
    /// parameter from the fracture energy G.
    pub fn stress_over_opening(&self) -> Option<Vec<[f64; 2]>> {
        /// Dissipated energy of a bond over the energy at its limit: so large that the elastic energy is negligible.
        const ENERGY: f64 = 1e3;
        const INTERVALS: u32 = 720;
        self.parameter?;
        let parameter = self.parameter_for(ENERGY);
        let end = self.end(parameter);
        let corner = |interval: u32| {
            let kappa = 1.0 + (end - 1.0) * f64::from(interval) / f64::from(INTERVALS);
            let force = self.at(parameter, kappa).force;
            [2.0 * (kappa - force) / ENERGY, force]
        };
        Some((0..=INTERVALS).map(corner).collect())
    }

    /// The law by a curve that a user gave.
    pub fn by_curve(curve: Curve) -> Self {
        let steepest = curve.steepest();
        let least_energy = curve.total(steepest);
        Self {
            word: WORD,
            words: "Its force follows a curve of stress over opening.",
            source: "",
            force: "force falls by its curve of stress over opening",
            parameter: Some(Parameter::end(steepest, least_energy)),
            softens: true,
            sliding_because: None,
            fall: Fall::Curve(curve),
        }
    }

    /// The text for the law in results: its word, and after it opening and stress of each corner of a curve that a user gave,
    /// `curve 0:1 0.2:0.3 1:0`.
    pub fn text(&self) -> String {
        let points = self.given_curve().into_iter().flat_map(Curve::points);
        let points = points.map(|[opening, stress]| format!(" {opening}:{stress}"));
        self.word.to_owned() + &points.collect::<String>()
    }

    /// The law by the curve of a [`text`](Self::text); None for any other text.
    pub(super) fn of_text(text: &str) -> Option<Self> {
        let corners = text.strip_prefix(WORD)?.split_whitespace();
        let corner = |text: &str| {
            let (opening, stress) = text.split_once(':')?;
            Some([opening.parse().ok()?, stress.parse().ok()?])
        };
        let corners: Option<Vec<[f64; 2]>> = corners.map(corner).collect();
        Curve::new(&corners?).ok().map(Self::by_curve)
    }

    /// The curve that a user gave; None for a law with a name.
    pub fn given_curve(&self) -> Option<&Curve> {
        match &self.fall {
            Fall::Curve(curve) => Some(curve),
            Fall::Formula { .. } | Fall::Named(_) => None,
        }
    }
}

impl PartialEq for Law {
    fn eq(&self, other: &Self) -> bool {
        self.word == other.word && self.given_curve() == other.given_curve()
    }
}
