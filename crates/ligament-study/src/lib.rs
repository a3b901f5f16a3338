//! Studies of many runs or of whole families of bonds.
//!
//! | module | determines |
//! |---|---|
//! | [`sweep`] | the results of a case over all combinations of some of its settings |
//! | [`converge`] | the interval in which each result of a case lies as its points become finer |
//! | [`ensemble`] | samples of a case whose strength or fracture energy varies at random |
//! | [`calibrate`] | the value of a key with which a result equals a target |
//! | [`bond_stiffness`] | the stiffness of bonds over their direction |
//! | [`yielding`] | the load at which the first bond yields, and its distortion by the directions of the bonds |
//!
//! Sweeps, which intervals of convergence are computed from, and ensembles share a table of runs ([`run_table`]). Other common parts are results by name ([`quantities`]), lines of least squares
//! (`line_fit`), and meshes made by other programs ([`meshing`]), because a study may vary a geometry.
#![cfg_attr(
    test,
    allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")
)]

pub mod bond_stiffness;
pub mod calibrate;
pub mod converge;
pub mod ensemble;
pub mod line_fit;
pub mod meshing;
pub mod quantities;
pub mod run_table;
pub mod sweep;
pub mod yielding;
