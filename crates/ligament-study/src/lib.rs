//! Questions that take many runs or a whole family of bonds. It changes when a study is to ask something else.
//!
//! | module | asks |
//! |---|---|
//! | [`sweep`] | what a case gives over all combinations of some of its settings |
//! | [`calibrate`] | with which value of a key a result meets a target |
//! | [`bond_stiffness`] | how stiff bonds are over their direction |
//! | [`yielding`] | at which load the first bond yields, and how the directions of the bonds distort that |
//!
//! What they share: results by their names ([`quantities`]), lines of least squares (`line_fit`), and meshes made by other programs
//! ([`meshing`]), because a study may vary a geometry.
#![cfg_attr(
    test,
    allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")
)]

pub mod bond_stiffness;
pub mod calibrate;
pub mod line_fit;
pub mod meshing;
pub mod quantities;
pub mod sweep;
pub mod yielding;
