//! Error of a request for yield domains.

/// Allowed horizons of lattices, in spacings.
pub(super) const RATIOS: std::ops::RangeInclusive<f64> = 1.0..=50.0;

/// Error of a request for yield domains.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum YieldError {
    /// A horizon without neighbours, or with thousands of them.
    #[error("m = {ratio}: the horizon of a lattice is {} to {} spacings", RATIOS.start(), RATIOS.end())]
    Ratio {
        /// Given value.
        ratio: f64,
    },
    /// A Poisson's ratio that is impossible in the plane.
    #[error("nu = {poisson} is not between -1 and 1, as Poisson's ratio in the plane is")]
    Poisson {
        /// Given value.
        poisson: f64,
    },
    /// A ratio of strengths that is not positive.
    #[error(
        "the ratio of strengths is {ratio}, and should be positive: compressive over tensile strength"
    )]
    Strengths {
        /// Given value.
        ratio: f64,
    },
    /// A compressive strength below the tensile one, for which there is no friction.
    #[error(
        "frictional sliding needs --ratio of 1 or more (compressive over tensile strength), got {ratio}"
    )]
    NoFriction {
        /// Given value.
        ratio: f64,
    },
    /// Two strengths for which there is no friction.
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
    /// A law whose strains of bonds do not depend on the direction.
    #[error(
        "the bonds of model.law = \"{law}\" have all strains of the body whatever their direction, so that directions weaken nothing: \
         families yield at the limits that `ligament check` lists"
    )]
    NoDirections {
        /// Word of the law.
        law: &'static str,
    },
    /// A criterion that depends on more of a body than the strain of a bond.
    #[error(
        "the criterion \"{criterion}\" looks at the stress of the body, which is the same for all families: it yields at the strength, and no \
         diagram is drawn of it; take others with --criterion"
    )]
    OfStress {
        /// Name of the criterion.
        criterion: &'static str,
    },
    /// A case with an anisotropic material, or with several Poisson's ratios.
    #[error("the case has {which}: give Poisson's ratio in the plane with --nu")]
    NoPoisson {
        /// Description of the elastic constants of the case.
        which: &'static str,
    },
    /// No point has this tag.
    #[error("there is no {tagged} {tag}: their numbers are {lowest} to {highest}")]
    NoPoint {
        /// The noun that tags belong to: `node` or `cell`.
        tagged: &'static str,
        /// Requested tag.
        tag: u64,
        /// Lowest tag.
        lowest: u64,
        /// Highest tag.
        highest: u64,
    },
    /// A position away from the body.
    #[error("there is no point of the body within a horizon ({horizon:.3e} m) of ({}, {}); the nearest is {nearest}", at[0], at[1])]
    NotInBody {
        /// Position without a point.
        at: [f64; 2],
        /// Description of the nearest point.
        nearest: String,
        /// Horizon of the nearest point, m.
        horizon: f64,
    },
    /// A family that no strain causes to yield.
    #[error(
        "no bond of {of} ever fails: its limits are infinite (no_fail, or a material without strength)"
    )]
    NeverYields {
        /// Description of the family.
        of: String,
    },
}
