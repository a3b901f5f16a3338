//! Names that most programs use: `use ligament::prelude::*`.

pub use ligament_analysis::modal::{ModalOutcome, ModalSettings};
pub use ligament_analysis::{Component, Observer};
pub use ligament_mesh::{Mesh, gmsh};
pub use ligament_model::bonds::precrack::Ends;
pub use ligament_model::failure::Choice;
pub use ligament_model::failure::strength::STRENGTH;
pub use ligament_model::law::rotational::{RotationalScale, RotationalStiffness};
pub use ligament_model::{Elasticity, Isotropic, Material, Plane, Shape};

pub use crate::body::{AnyBody, Body, CellSet, Geometry, Hole, LatticeBody, MeshBody, Points};
pub use crate::error::{Error, Fault, Field, SetupError};
pub use crate::model::Model;
pub use crate::run::{NoObserver, Solution};
pub use crate::setup::{
    Action, Analysis, Calibration, Correction, Course, CrackShape, Displacement, Form, Horizon,
    Law, Load, MaterialRegion, Place, PreCrack, Probe, Profile, Reading, Section, Setup, Stage,
    Strains, Support, Temperature, TemperatureChange, event, stepped,
};
