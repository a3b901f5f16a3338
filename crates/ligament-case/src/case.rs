//! Case files: what to compute, in TOML.
//!
//! A case names a body, materials, the bond model, supports and loads, and optionally pre-cracks, probes,
//! how bonds break, or that natural modes are wanted. All values are in SI units. [`CaseFile::load`] reads
//! and checks one; every fault is reported with its line, column and key path.

mod analysis;
mod body_section;
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
mod solver;
mod temperature;
pub mod values;
mod word;

use std::path::Path;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use analysis::{Analysis, MOST_MODES, Modal, Rotations};
pub use body_section::BodySection;
pub use conditions::{Displacement, Support, Vector};
pub use correction::{Alpha, Correction, CorrectionDomain, CorrectionRule, Iteration, Surface};
pub use expansion::Expansion;
pub use fault::{CaseError, Fault, Location};
pub use file::CaseFile;
pub use fracture::{BreakOrder, Control, Fracture, Output, Stepping, Steps, Stop, StressField};
pub use lattice_section::{CellSet, Circle, Hole, HoleShape, LatticeSection, MOST_CELLS};
pub use ligament::units::Units;
pub use load::{Action, Load, Profile};
pub use material::{Anisotropic, Elasticity, Material, Orthotropic};
pub use mesh_section::{MeshSection, Plane};
pub use model::{Calibration, Form, Law, ModelSection, RotationalStiffness, Strains};
pub use precrack::{CrackLine, Ends, Precrack};
pub use probe::{Component, Field, Probe, Reading};
pub use region::{Place, Region};
pub use schema::schema;
pub use solver::{Factorisation, MOST_THREADS, Ordering, Solver, Update};
pub use temperature::{Temperature, TemperatureChange};
pub use values::{Axis, Point};

use document::Node;
use fault::{Fault as F, KeyFault};
use key_path::KeyPath;
use values::require_unique;

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

/// The sections as they are read; `material` is read apart because it has two forms.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = schema::exactly_one(&["mesh", "lattice"])))]
struct RawCase {
    /// One line on what the case is.
    #[serde(default)]
    title: String,
    /// What is computed; without it `fracture` where there is a `[fracture]` section, else `static`.
    analysis: Option<Analysis>,
    /// The body, meshed by Gmsh; or a `[lattice]`.
    mesh: Option<mesh_section::RawMesh>,
    /// The body as a rectangle of equal cells with a point at the centre of each; or a `[mesh]`.
    lattice: Option<lattice_section::RawLattice>,
    /// The material of the whole body; or a table `[material.NAME]` with a `group` for each of several.
    #[serde(rename = "material")]
    #[schemars(schema_with = "material::schema")]
    _material: serde::de::IgnoredAny,
    /// The bond model.
    model: model::RawModel,
    /// The corrections of the bonds; without it as in the paper of the law.
    #[serde(default)]
    correction: correction::RawCorrection,
    /// Cracks and slots that are there from the start.
    #[serde(default)]
    precrack: Vec<precrack::RawPrecrack>,
    /// What holds the body; nothing need.
    #[serde(default)]
    support: Vec<conditions::RawSupport>,
    /// Loads as they are at load factor 1; the first is the axis of the force-displacement curve.
    #[serde(default)]
    load: Vec<load::RawLoad>,
    /// Changes of temperature at load factor 1; where several reach, the last holds.
    #[serde(default)]
    temperature: Vec<temperature::RawTemperature>,
    /// Parts of the body where bonds never break.
    #[serde(default)]
    no_fail: Vec<region::RawRegion>,
    /// Extra columns of `history.csv`.
    #[serde(default)]
    probe: Vec<probe::RawProbe>,
    /// How bonds break; without it the case is one linear elastic solution.
    fracture: Option<fracture::RawFracture>,
    /// Natural modes that are wanted, with `analysis = "modal"`.
    modal: Option<analysis::RawModal>,
    /// How the equations are solved; nothing need be said.
    #[serde(default)]
    solver: solver::RawSolver,
    /// What a run writes.
    output: Option<fracture::RawOutput>,
}

impl Case {
    /// Reads and checks a parsed document; `folder` is that of the case file.
    fn from_document(document: &Node, folder: &Path) -> Result<Self, KeyFault> {
        let raw: RawCase =
            decode::decode(document, &KeyPath::default()).map_err(name_missing_section)?;
        let section = |name: &str| KeyPath::default().child(name);
        let body = BodySection::from_sections(raw.mesh, raw.lattice, folder)?;
        let materials = match document.get("material") {
            Some(node) => material::read(node)?,
            None => return Err(missing_section("material")),
        };
        let given = analysis::Given {
            fracture: raw.fracture.is_some(),
            modal: raw.modal.is_some(),
            loads: !raw.load.is_empty(),
            temperature: !raw.temperature.is_empty(),
            probes: !raw.probe.is_empty(),
            output: raw.output.is_some(),
        };
        let analysis = Analysis::named_or_meant(raw.analysis, &given)?;
        if raw.load.is_empty() && raw.temperature.is_empty() && analysis != Analysis::Modal {
            return Err(missing_section("load"));
        }
        let modal = match analysis {
            Analysis::Modal => Some(raw.modal.unwrap_or_default().complete()),
            Analysis::Static | Analysis::Fracture => None,
        };
        let mut number = 0;
        let loads = each("load", raw.load, |load, key| {
            number += 1;
            load.check(key, number)
        })?;
        let law = raw.model.law();
        let fracture = raw
            .fracture
            .map(|it| it.check(&section("fracture"), law))
            .transpose()?;
        let model = raw.model.check(&section("model"))?;
        let case = Self {
            title: raw.title,
            analysis,
            body,
            materials,
            correction: raw.correction.check(&section("correction"), &model)?,
            model,
            precracks: each("precrack", raw.precrack, precrack::RawPrecrack::check)?,
            supports: each("support", raw.support, conditions::RawSupport::check)?,
            loads,
            temperatures: each("temperature", raw.temperature, |it, key| {
                it.check(key, folder)
            })?,
            no_fail: each("no_fail", raw.no_fail, region::RawRegion::check)?,
            probes: each("probe", raw.probe, probe::RawProbe::check)?,
            solver: raw.solver.complete(),
            output: raw
                .output
                .unwrap_or_default()
                .complete(&section("output"), fracture.as_ref())?,
            fracture,
            modal,
        };
        case.check_across_sections()?;
        Ok(case)
    }

    /// Units of the displacement and the force in the history, which are those of the first load, or of the temperature where
    /// there is none.
    pub fn units(&self) -> Units {
        let first = self.loads.first();
        first.map_or(Units::TEMPERATURE, |load| load.action.units())
    }

    fn check_across_sections(&self) -> Result<(), KeyFault> {
        material::require_suitable(&self.materials, self.model.law, self.body.plane())?;
        mbb_pd::check(self)?;
        if let Some(fracture) = &self.fracture {
            material::require_strengths(&self.materials, &fracture.criteria)?;
        }
        if self.modal.is_some() {
            material::require_densities(&self.materials)?;
        }
        let path = |list: &str, index: usize| KeyPath::default().child(list).child(index);
        let is_field = |it: &Temperature| matches!(it.change, TemperatureChange::Field { .. });
        let field = self.temperatures.iter().position(is_field);
        if let (Some(index), BodySection::Lattice(_)) = (field, &self.body) {
            let fault = F::NotWith {
                key: "mesh_field",
                setting: "[lattice]".to_owned(),
                reason: "it is in the file of a mesh; a lattice takes a `file` of its own",
            };
            return Err(KeyFault::new(
                path("temperature", index).child("mesh_field"),
                fault,
            ));
        }
        let loads = self.loads.iter().enumerate();
        let advice =
            ": give one of the loads another `name` (the name of a load without one is its group)";
        require_unique(
            loads.map(|(index, load)| (path("load", index), load.name.as_str())),
            advice,
        )?;
        let probes = self.probes.iter().enumerate();
        require_unique(
            probes.map(|(index, probe)| (path("probe", index).child("name"), probe.name.as_str())),
            "",
        )
    }
}

/// Checks every element of a list of sections under its own key path.
fn each<Raw, Checked>(
    list: &str,
    sections: Vec<Raw>,
    mut check: impl FnMut(Raw, &KeyPath) -> Result<Checked, KeyFault>,
) -> Result<Vec<Checked>, KeyFault> {
    let list = KeyPath::default().child(list);
    sections
        .into_iter()
        .enumerate()
        .map(|(index, raw)| check(raw, &list.child(index)))
        .collect()
}

/// A missing section is more than a missing key: the error says what it is for.
fn name_missing_section(fault: KeyFault) -> KeyFault {
    match &fault.fault {
        F::MissingKey { key, .. } if fault.key.0.len() == 1 => missing_section(key),
        _ => fault,
    }
}

fn missing_section(name: &str) -> KeyFault {
    let (section, purpose) = match name {
        "material" => ("[material]".to_owned(), "`young` (in Pa) and `poisson`"),
        "model" => ("[model]".to_owned(), "`law` and `horizon_factor`"),
        _ => (
            format!("[[{name}]]"),
            "one or more, or a [[temperature]], or nothing would happen (natural modes need none: analysis = \"modal\")",
        ),
    };
    KeyFault::new(
        KeyPath::default().child(name),
        F::MissingSection { section, purpose },
    )
}
