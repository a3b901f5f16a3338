//! Corrections of bonds in space: factors alpha and Omega, see [`correction`](crate::correction) for what they are.
//!
//! | alpha | Omega |
//! |---|---|
//! | [`length`](crate::correction::length): short bonds count more | [`axes`]: iterated until the energies of three uniaxial strains are right |
//! | [`partial_volume`]: cells that the horizon cuts | [`surface`]: by the volumes of the families |
//! | none: 1 | [`patch`]: uniform strains are equilibria; another factor for shear and rotation |
//! | | none: 1 |

pub mod axes;
mod families;
pub mod partial_volume;
pub mod patch;
mod strain_mode;
pub mod surface;

pub use axes::energy_ratios;
pub use strain_mode::SolidStrainMode;
