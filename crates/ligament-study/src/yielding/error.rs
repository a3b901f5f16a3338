//! What cannot be looked at.

/// Horizons of lattices, in spacings.
pub(super) const RATIOS: std::ops::RangeInclusive<f64> = 1.0..=50.0;

/// What cannot be looked at.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum YieldError {
    /// A horizon without neighbours, or of thousands of them.
    #[error("m = {ratio}: the horizon of a lattice is {} to {} spacings", RATIOS.start(), RATIOS.end())]
    Ratio {
        /// The one given.
        ratio: f64,
    },
    /// A Poisson's ratio that no material has in the plane.
    #[error("nu = {poisson} is not between -1 and 1, as Poisson's ratio in the plane is")]
    Poisson {
        /// The one given.
        poisson: f64,
    },
    /// A ratio of strengths that is none.
    #[error(
        "the ratio of strengths is {ratio}, and should be positive: compressive over tensile strength"
    )]
    Strengths {
        /// The one given.
        ratio: f64,
    },
    /// Friction needs a compressive strength of at least the tensile one.
    #[error(
        "frictional sliding needs --ratio of 1 or more (compressive over tensile strength), got {ratio}"
    )]
    NoFriction {
        /// The one given.
        ratio: f64,
    },
    /// Two strengths that no friction fits.
    #[error(
        "no friction fits both strengths at nu = {poisson} in the plane: --calibration two-point needs nu below \
         1/{ratio} (tensile over compressive strength); take --calibration printed, or a smaller --ratio"
    )]
    NoTwoPoints {
        /// Poisson's ratio in the plane.
        poisson: f64,
        /// Compressive over tensile strength.
        ratio: f64,
    },
    /// A case whose bonds never fail.
    #[error(
        "the case has no [fracture] section, so its bonds have no limits: give it one (for example --set fracture.steps=1, \
         with a strength of the material), or take limits that are the same for all bonds with --criterion"
    )]
    NoCriteria,
    /// Bonds that do not see the strain by their direction.
    #[error(
        "the bonds of model.law = \"{law}\" have all strains of the body whatever their direction, so that directions weaken nothing: \
         families yield at the limits that `ligament check` lists"
    )]
    NoDirections {
        /// Word of the law.
        law: &'static str,
    },
    /// A criterion that looks at more of a body than the strain of a bond.
    #[error(
        "the criterion \"{criterion}\" looks at the stress of the body, which is the same for all families: it yields at the strength, and no \
         diagram is drawn of it; take others with --criterion"
    )]
    OfStress {
        /// Name of the criterion.
        criterion: &'static str,
    },
    /// A case without a Poisson's ratio for all directions, or with several.
    #[error("the case has {which}: give Poisson's ratio in the plane with --nu")]
    NoPoisson {
        /// The elastic constants that the case has instead, in words.
        which: &'static str,
    },
    /// No point has this tag.
    #[error("there is no {tagged} {tag}: their numbers are {lowest} to {highest}")]
    NoPoint {
        /// The noun that tags belong to: `node` or `cell`.
        tagged: &'static str,
        /// The one asked for.
        tag: u64,
        /// Lowest number.
        lowest: u64,
        /// Highest number.
        highest: u64,
    },
    /// A position away from the body.
    #[error("there is no point of the body within a horizon ({horizon:.3e} m) of ({}, {}); the nearest is {nearest}", at[0], at[1])]
    NotInBody {
        /// The position.
        at: [f64; 2],
        /// The nearest point.
        nearest: String,
        /// Horizon of the nearest point, m.
        horizon: f64,
    },
    /// A family that no strain makes yield.
    #[error(
        "no bond of {of} ever fails: its limits are infinite (no_fail, or a material without strength)"
    )]
    NeverYields {
        /// Whose.
        of: String,
    },
}
