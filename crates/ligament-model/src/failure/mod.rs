//! Failure criteria: when a bond fails, and what it does after.
//!
//! A criterion compares a [`Measure`] of the bond's deformation with a limit, and says what is [`AfterLimit`]. Its utilisation
//! is measure over limit; the bond fails where that reaches one. Of several criteria the first that is met decides. A [`Choice`]
//! of a [`Kind`] becomes criteria with the limits of all bonds by [`criteria`].
//!
//! | kind | measure | limit |
//! |---|---|---|
//! | [`strength`] | tension | from the energy at the tensile strength (NHPD eqs 14 to 16) |
//! | [`bond_rankine`] | normal stress | F_t |
//! | [`mohr_coulomb`] | normal stress, stress of Mohr and Coulomb | F_t, cohesion |
//! | [`rankine`] | principal stress, at which bonds begin to soften; then energy | F_t, from G_c |
//! | [`stretch`] | tension, compression | F/E (MPPD eqs 44 to 46) |
//! | [`fibre`] | fibre | F/E (MPPD eqs 28, 44) |
//! | [`sliding`] | sliding | s_0t (1 + nu)/2 (MPPD eq. 49) |
//! | [`frictional`] | friction | a, tan(beta) (MPPD eqs 52 to 58) |
//! | [`fracture_energy`] | tension, energy | from G_c, the elastic moduli and the mean length of the bonds (Silling and Askari 2005) |
//! | [`mixed_mode`] | mixed mode, along x or y | from G_Ic, G_IIc and the bonds that a crack cuts (MBB-PD appendix C) |
//! | [`printed`] | stretch or angle by the class of the bond | the same as printed, and from the bonds that are left (MBB-PD eqs 22 to 24) |

mod admissible;
pub mod along_line;
mod basis;
pub mod bond_rankine;
pub mod crack_at_points;
pub mod crack_energies;
pub mod crack_opening;
mod criterion;
pub mod fibre;
pub mod fracture_energy;
pub mod frictional;
mod from_choices;
pub mod hooke;
pub mod joint;
mod kind;
mod measure;
pub mod mixed_mode;
pub mod mohr_coulomb;
pub mod printed;
pub mod rankine;
pub mod sliding;
pub mod softening;
pub mod starting;
mod state_variables;
pub mod strength;
mod stress_limits;
pub mod stretch;
mod unfit;

pub use basis::Basis;
pub use criterion::{Criteria, Criterion, Surroundings, Verdict};
pub use from_choices::criteria;
pub use kind::{Calibration, Choice, Kind, Limits, MakeLimits, PerSpace, Property};
pub use measure::Measure;
pub use measure::Weakened;
pub use softening::{AfterLimit, Softened};
pub use state_variables::{CriteriaInState, StateVariables, Stresses};
pub use unfit::Setting;
pub use unfit::{NoLimit, Unfit};

/// All kinds of criteria.
pub static KINDS: [&Kind; 15] = [
    &strength::STRENGTH,
    &bond_rankine::BOND_RANKINE,
    &rankine::RANKINE,
    &mohr_coulomb::MOHR_COULOMB,
    &stretch::TENSION,
    &stretch::COMPRESSION,
    &fibre::FIBRE,
    &sliding::SLIDING,
    &frictional::FRICTIONAL,
    &fracture_energy::CRITICAL_STRETCH,
    &fracture_energy::BOND_ENERGY,
    &mixed_mode::MIXED_MODE,
    &printed::OPENING,
    &printed::SLIDING,
    &printed::MIXED,
];

#[cfg(feature = "case")]
crate::worded_by_table! { Kind: KINDS, KINDS.into_iter().copied(), it => [it.word, it.words] }

#[cfg(test)]
mod block_tests;
