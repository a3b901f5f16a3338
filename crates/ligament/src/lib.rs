//! Peridynamics in memory: a typed setup in, a broken body out.
//!
//! A body is a set of points, each bonded to the others within its horizon. Forces go through the bonds, and cracks are bonds that broke. A
//! computation has three steps:
//!
//! | step | value | page |
//! |---|---|---|
//! | say what to compute | [`Setup`]: body, section, materials, law, corrections, supports, loads, criteria, analysis | [`setup`] |
//! | make bonds of it | [`Model`]: points, corrected bonds, limits, warnings | [`model`] |
//! | solve | [`Solution`](run::Solution): history, last state, why it ended; or natural modes | [`run`] |
//!
//! The first page is [`body`]: points from a mesh, a lattice or arrays. [`formulation`] turns law and corrections into stiffness
//! ([`direction`] gives it over the direction of a bond), [`loading`] supports and loads into forces and constraints on the points.
//! [`patch_test`] and [`bending_test`] measure the stiffness of the discrete body, [`crack_energy`] the energy that a crack dissipates,
//! [`foresight`] predicts the first bond at its limit, [`stability`] finds the largest Poisson's ratio of a stable body, and [`plausibility`] finds implausible values. The error of a setup is a
//! [`SetupError`] that names the field; what else the user should know about a model is a [`Message`].
//!
//! ```
//! use ligament::prelude::*;
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! // A plate of 30 by 10 points, 10 mm apart.
//! let position = |k: u32| [k % 30, k / 30].map(|it| 0.01 * f64::from(it));
//! let points = Points::new((0..300).map(position).collect(), vec![1e-4; 300])?
//!     .with_group("left", (0..300).filter(|k| k % 30 == 0))?
//!     .with_group("right", (0..300).filter(|k| k % 30 == 29))?;
//! let mut setup = Setup::new(points, Material::isotropic(210e9, 0.25), Law::NHPD);
//! setup.supports = vec![Support::new("left", &[Component::X, Component::Y])];
//! setup.loads = vec![Load::new("right", Action::Force([1e3, 0.0, 0.0]))];
//!
//! let solution = setup.solve(&mut NoObserver)?;
//! let last = solution.outcome.history.last().ok_or("no solution")?;
//! assert!(last.displacement > 0.0);
//! # Ok(())
//! # }
//! ```
//!
//! An [`Observer`](ligament_analysis::Observer) in the place of [`NoObserver`](run::NoObserver) receives the load steps of a run;
//! [`run::begin`] advances a run row by row; [`Model::build`] only builds the model. Nothing is printed and no file is read or written
//! here.
//!
//! This crate is the one to depend on: [`analysis`], [`mechanics`] and [`mesh`] are the crates beneath it, for programs that need more.
#![cfg_attr(
    test,
    allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")
)]

mod absent;
pub mod bending_test;
pub mod body;
mod coordinates;
pub mod counts;
pub mod crack_energy;
mod cutting;
mod described;
pub mod direction;
mod division;
pub mod ensemble;
pub mod error;
mod extent;
mod faces;
pub mod foresight;
pub mod formulation;
mod joints;
pub mod loading;
mod local;
pub mod model;
mod near_field;
pub mod near_growth;
mod notches;
mod parts;
pub mod patch_test;
pub mod plausibility;
mod precracks;
pub mod prelude;
pub mod processes;
mod refined_body;
pub mod refinement;
pub mod run;
pub mod setup;
mod soundness;
pub mod stability;
pub mod stage;
pub mod suggestion;
pub mod system;
pub mod units;
pub mod warning;

pub use ligament_analysis as analysis;
pub use ligament_analysis::Message;
pub use ligament_mesh as mesh;
pub use ligament_model as mechanics;

pub use body::Body;
pub use error::{Error, Fault, Field, SetupError, Torn};
pub use loading::{Loading, Vibration};
pub use model::Model;
pub use setup::Setup;
