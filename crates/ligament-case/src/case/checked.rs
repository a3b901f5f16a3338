//! A checked case.

use ligament::units::Units;
use serde::Serialize;

use super::analysis::{Analysis, Modal};
use super::body_section::BodySection;
use super::conditions::Support;
use super::correction::Correction;
use super::fracture::{Fracture, Output};
use super::load::Load;
use super::material::{self, Material};
use super::model::ModelSection;
use super::precrack::Precrack;
use super::probe::Probe;
use super::region::Region;
use super::solver::Solver;
use super::temperature::Temperature;

/// A checked case with every default filled in.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Case {
    /// One line on what the case is.
    pub title: String,
    /// What is computed.
    pub analysis: Analysis,
    /// The body: a mesh or a lattice.
    #[serde(flatten)]
    pub body: BodySection,
    /// The materials: one without a group for the whole body, or one for each of some groups.
    #[serde(rename = "material", serialize_with = "material::serialize")]
    pub materials: Vec<Material>,
    /// The bond model.
    pub model: ModelSection,
    /// The corrections of the bonds.
    pub correction: Correction,
    /// Cracks that are there from the start.
    #[serde(rename = "precrack", skip_serializing_if = "Vec::is_empty")]
    pub precracks: Vec<Precrack>,
    /// Supports.
    #[serde(rename = "support", skip_serializing_if = "Vec::is_empty")]
    pub supports: Vec<Support>,
    /// Loads: one or more unless the temperature changes, but none where modes are wanted.
    #[serde(rename = "load", skip_serializing_if = "Vec::is_empty")]
    pub loads: Vec<Load>,
    /// Changes of temperature.
    #[serde(rename = "temperature", skip_serializing_if = "Vec::is_empty")]
    pub temperatures: Vec<Temperature>,
    /// Parts of the body where bonds never break.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub no_fail: Vec<Region>,
    /// Extra columns of the history.
    #[serde(rename = "probe", skip_serializing_if = "Vec::is_empty")]
    pub probes: Vec<Probe>,
    /// How bonds break, in an analysis of fracture.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fracture: Option<Fracture>,
    /// Natural modes that are wanted, in a modal analysis.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub modal: Option<Modal>,
    /// How the equations are solved.
    pub solver: Solver,
    /// What a run writes; every mode in any case.
    pub output: Output,
}

impl Case {
    /// Units of the displacement and the force in the history, which are those of the first load, or of the temperature where
    /// there is none.
    pub fn units(&self) -> Units {
        let first = self.loads.first();
        first.map_or(Units::TEMPERATURE, |load| load.action.units())
    }
}
