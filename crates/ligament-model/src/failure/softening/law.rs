//! What a law of softening is.

/// A law of softening: the fall of a bond's force after its limit e_0.
///
/// The functions take the law's parameter (any number where it has none) and the largest kappa = e/e_0 so far.
#[derive(Debug, Clone, Copy)]
pub struct Law {
    /// Word of the law in case files and in results.
    pub word: &'static str,
    /// Sentence on what the force does.
    pub words: &'static str,
    /// Papers of the law, by the keys of the references, with their equations; empty without any.
    pub source: &'static str,
    /// What the force does, in few words; the parameter follows, if there is one.
    pub force: &'static str,
    /// Parameter of the law, if there is one.
    pub parameter: Option<Parameter>,
    /// Whether a bond goes on after its limit at all.
    pub softens: bool,
    /// Reason why only bonds that slide may follow the law, if that is so, with `{}` for the criterion of sliding.
    pub sliding_because: Option<&'static str>,
    /// The bond past its limit.
    pub at: fn(f64, f64) -> Softened,
    /// kappa at which the bond breaks; infinite if never.
    pub end: fn(f64) -> f64,
    /// Energy that the whole life of the bond takes, over that stored at the limit; infinite if it never ends.
    pub total: fn(f64) -> f64,
}

/// The parameter of a law of softening.
#[derive(Debug, Clone, Copy)]
pub struct Parameter {
    /// Name of the parameter.
    pub key: &'static str,
    /// Value that the parameter must exceed.
    pub above: f64,
    /// Reason why no other law has the parameter, with `{}` for this one.
    pub of_it_alone: &'static str,
    /// Energy of the whole life of a bond, over what it stores at its limit, that any parameter exceeds.
    pub least_energy: f64,
    /// The parameter for which the whole life of a bond takes so many times what it stores at its limit, more than the least.
    pub for_energy: fn(f64) -> f64,
}

impl PartialEq for Law {
    fn eq(&self, other: &Self) -> bool {
        self.word == other.word
    }
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
