//! Properties that hold of any body: random meshes, materials, laws, planes, loads and pre-cracks of fixed seeds.
//!
//! - [`invariance`]: turned, mirrored, shifted and in other units, a case has the answer turned, mirrored, shifted and in these.
//! - [`course`]: along every fracture run forces and energies balance and nothing heals.
//! - [`symmetry`]: a body that is its own mirror image moves, and breaks, like one.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

mod answer;
mod course;
mod image;
mod invariance;
mod specimen;
mod symmetry;
