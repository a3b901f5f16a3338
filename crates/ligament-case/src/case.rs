//! Case files: what to compute, in TOML.
//!
//! A case has a body, materials, the bond model, supports and loads, and optionally pre-cracks, probes, and the breakage of bonds,
//! natural modes or a motion in time. All values are in SI units. [`CaseFile::load`] reads and checks a case; every fault is reported with its line, column and
//! key path.

mod amplitude;
mod analysis;
mod body_kind;
mod conditions;
mod contact;
mod coordinates;
mod correction;
mod criterion;
pub mod decode;
pub mod document;
pub mod fault;
pub mod file;
mod fracture;
pub mod key_path;
pub mod keys;
mod kind;
pub(crate) mod lattice_keys;
mod lattice_section;
mod load;
mod located;
mod material;
mod mesh_section;
mod model;
mod not_with;
mod output;
mod overrides;
mod precrack;
mod probe;
mod region;
mod resolved;
mod scatter;
mod schema;
mod sections;
mod setting;
mod solid_lattice_section;
mod solver;
pub mod source;
mod sources;
mod stage;
pub mod values;
mod word;

pub use amplitude::{Amplitude, Shape};
pub use analysis::{Analysis, MOST_MODES, Modal};
pub use body_kind::BodyKind;
pub use conditions::{InitialVelocity, Support, Temperature};
pub use contact::{Rigid, RigidShape};
pub use coordinates::{Coordinates, Couple, Vector};
pub use correction::Correction;
pub use criterion::Criterion;
pub use fault::{CaseError, Fault, Location};
pub use file::CaseFile;
pub use fracture::{Control, Fracture, Steps};
pub use lattice_keys::MOST_CELLS;
pub use lattice_section::{CellSet, Circle, Hole, LatticeSection, Polygon, Spacing};
pub use load::{Load, Profile};
pub use material::Material;
pub use mesh_section::MeshSection;
pub use model::ModelSection;
pub use output::{Output, StressField};
pub use overrides::{parts as override_parts, unset};
pub use precrack::Precrack;
pub use probe::Probe;
pub use region::{Corners, FarField, Rectangle, Region};
pub use scatter::{Distribution, Scatter, Scatters};
pub use schema::schema;
pub use sections::Case;
pub use solid_lattice_section::SolidLatticeSection;
pub use solver::{MOST_THREADS, Solver};
pub use values::Point;
pub use word::{Word, Worded, word_of};
