//! The discrete peridynamic model.
//!
//! A mesh or a lattice becomes a bond system in stages; each stage is a function from immutable values to one new value:
//!
//! | stage | value | module |
//! |---|---|---|
//! | points with their volumes | [`PointCloud`] | [`cloud`] |
//! | horizon of each point | [`Horizons`] | [`horizon`] |
//! | dual-horizon bonds | [`BondSet`] | [`bonds`] |
//! | micromoduli | [`BondStiffness`] | [`law`] |
//! | factors alpha and Omega | [`Correction`] | [`correction`] |
//! | failure criteria with their limits | [`Criteria`](failure::Criteria) | [`failure`] |
//! | points, bonds and rigidities of the equations | [`BondSystem`] | [`system`] |
//! | masses, for modes | [`LumpedMass`] | [`mass`] |
//!
//! All quantities are in SI units. The crate has no matrices, files or printing. Equations carry the key of their source, such as NHPD or
//! MPPD: `docs/references.md` lists the papers.

pub mod advice;
pub mod bonds;
pub mod boxes;
pub mod case_type;
pub mod change;
pub mod cloud;
pub mod communicator;
pub mod connected;
pub mod contact;
pub mod correction;
pub mod deformation;
pub mod dimension;
pub mod element;
pub mod failure;
pub mod far_field;
pub mod fixed;
pub mod geometry;
pub mod ghosts;
pub mod grid;
pub mod held;
pub mod horizon;
pub mod interface;
pub mod law;
pub mod layout;
pub mod mass;
pub mod material;
pub mod moduli;
mod point_sums;
mod predicates;
pub mod prefix_sums;
pub mod product;
pub mod rigid_motions;
pub mod scatter;
pub mod shape;
pub mod stress;
pub mod subdomain;
pub mod surface;
pub mod sweep;
pub mod system;
pub mod tensor;
pub mod thermal;
pub mod topology;
pub mod uniform_strain;
mod vector_registers;
pub mod volumetric;
#[cfg(feature = "case")]
pub mod word;

pub use advice::Advice;
pub use bonds::{BondSet, Incidence};
pub use cloud::PointCloud;
pub use cloud::lattice::Lattice;
pub use correction::Correction;
pub use deformation::{Deformations, SpaceDeformation};
pub use element::ElementKind;
pub use fixed::{Absence, AbsentBond, ConstantFields, EnergyRatio};
pub use grid::{BodyGrid, Canvas, PointTags, Tags, box_corners, in_space, raised};
pub use horizon::Horizons;
pub use interface::Bonds;
pub use law::BondStiffness;
pub use ligament_mesh::{Numbering, parallel};
pub use mass::LumpedMass;
pub use material::{Anisotropic, Elasticity, Expansion, Isotropic, Material, Orthotropic, Plane};
pub use scatter::Scatter;
pub use shape::Shape;
pub use system::elements::System;
pub use system::{BondSystem, StressAcrossPlane, UnbrokenBonds};
pub use topology::{CoupledPoints, Topology};
