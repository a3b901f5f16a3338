//! Case files: what to compute, in TOML.
//!
//! A case has a body, materials, the bond model, supports and loads, and optionally pre-cracks, probes, and the breakage of bonds,
//! natural modes or a motion in time. All values are in SI units. [`CaseFile::load`] reads and checks a case; every fault is reported with its line, column and
//! key path.

mod analysis;
mod conditions;
mod contact;
pub mod decode;
pub mod document;
pub mod fault;
pub mod file;
mod fracture;
mod ineffective_keys;
pub mod key_path;
pub mod keys;
mod kind;
mod lattice;
mod material;
mod mesh_section;
mod model;
mod overrides;
mod places;
mod precrack;
mod probe;
mod refine;
mod resolved;
mod schema;
mod sections;
mod setup_errors;
pub mod source;
mod stage;
pub mod values;
mod word;

pub use analysis::{Analysis, Output, StressField};
pub use conditions::{Amplitude, InitialVelocity, Load, Profile, Shape, Support, Temperature};
pub use contact::{Rigid, RigidShape};
pub use fault::{CaseError, Fault, Location};
pub use file::CaseFile;
pub use fracture::{Control, Distribution, Fracture, Scatter, Scatters, Steps};
pub use lattice::{CellSet, Circle, Hole, LatticeSection, MOST_CELLS, Polygon};
pub use lattice::{SolidLatticeSection, Spacing};
pub use material::Material;
pub use mesh_section::{BodyKind, MeshSection};
pub use model::{Correction, ModelSection};
pub use overrides::{parts as override_parts, unset};
pub use places::{Coordinates, Corners, Couple, FarField, Rectangle, Region, Vector};
pub use precrack::Precrack;
pub use probe::Probe;
pub use schema::schema;
pub use sections::Case;
pub use values::Point;
pub use word::{Word, word_of};
