//! Case files: what to compute, in TOML.
//!
//! A case names a body, materials, the bond model, supports and loads, and optionally pre-cracks, probes,
//! how bonds break, or that natural modes are wanted. All values are in SI units. [`CaseFile::load`] reads
//! and checks one; every fault is reported with its line, column and key path.

mod analysis;
mod body_section;
mod checked;
mod conditions;
mod correction;
mod criterion;
pub mod decode;
pub mod document;
mod expansion;
pub mod fault;
pub mod file;
mod fracture;
pub mod key_path;
pub mod keys;
mod lattice_section;
mod load;
mod material;
mod mbb_pd;
mod mesh_section;
mod model;
mod overrides;
mod precrack;
mod probe;
mod region;
mod resolved;
mod schema;
mod sections;
mod solver;
mod temperature;
pub mod values;
mod word;

pub use analysis::{Analysis, MOST_MODES, Modal};
pub use body_section::BodySection;
pub use checked::Case;
pub use conditions::{Displacement, Support, Vector};
pub use correction::{Correction, CorrectionRule, Iteration, Surface};
pub use expansion::Expansion;
pub use fault::{CaseError, Fault, Location};
pub use file::CaseFile;
pub use fracture::{Control, Fracture, Output, Stepping, Steps, Stop, StressField};
pub use lattice_section::{CellSet, Circle, Hole, HoleShape, LatticeSection, MOST_CELLS};
pub use ligament::units::Units;
pub use load::{Action, Load, Profile};
pub use material::{Anisotropic, Elasticity, Material, Orthotropic};
pub use mesh_section::MeshSection;
pub use model::{Law, ModelSection};
pub use precrack::{CrackLine, Precrack};
pub use probe::{Probe, Reading};
pub use region::{Place, Region};
pub use schema::schema;
pub use solver::{MOST_THREADS, Solver};
pub use temperature::{Temperature, TemperatureChange};
pub use values::Point;
pub use word::{Word, Worded};
