//! The sections of a case file, read and checked together.

use std::path::Path;

use schemars::JsonSchema;
use serde::Deserialize;

use super::analysis::{self, Analysis};
use super::body_section::BodySection;
use super::checked::Case;
use super::decode::decode;
use super::document::Node;
use super::fault::{Fault as F, KeyFault};
use super::key_path::KeyPath;
use super::temperature::{self, Temperature, TemperatureChange};
use super::values::{exactly_one, require_unique};
use super::{
    conditions, correction, fracture, lattice_section, load, material, mbb_pd, mesh_section, model,
    precrack, probe, region, solver,
};

/// The sections as they are read; `material` is read apart because it has two forms.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = exactly_one(&["mesh", "lattice"])))]
pub(super) struct RawCase {
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

impl RawCase {
    /// Reads and checks a parsed document; `folder` is that of the case file.
    pub(super) fn checked(document: &Node, folder: &Path) -> Result<Case, KeyFault> {
        let raw: Self = decode(document, &KeyPath::default()).map_err(name_missing_section)?;
        let given = raw.given();
        let section = |name: &str| KeyPath::default().child(name);
        let body = BodySection::from_sections(raw.mesh, raw.lattice, folder)?;
        let materials = match document.get("material") {
            Some(node) => material::read(node)?,
            None => return Err(missing_section("material")),
        };
        let analysis = Analysis::named_or_meant(raw.analysis, &given)?;
        if !given.loads && !given.temperature && analysis != Analysis::Modal {
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
        let case = Case {
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
        check_across_sections(&case)?;
        Ok(case)
    }

    /// Presence of the sections that not every analysis has.
    fn given(&self) -> analysis::Given {
        analysis::Given {
            fracture: self.fracture.is_some(),
            modal: self.modal.is_some(),
            loads: !self.load.is_empty(),
            temperature: !self.temperature.is_empty(),
            probes: !self.probe.is_empty(),
            output: self.output.is_some(),
        }
    }
}

/// Checks what sections ask of each other.
fn check_across_sections(case: &Case) -> Result<(), KeyFault> {
    material::require_suitable(&case.materials, case.model.law, case.body.plane())?;
    mbb_pd::check(case)?;
    if let Some(fracture) = &case.fracture {
        material::require_strengths(&case.materials, &fracture.criteria)?;
    }
    if case.modal.is_some() {
        material::require_densities(&case.materials)?;
    }
    let path = |list: &str, index: usize| KeyPath::default().child(list).child(index);
    let is_field = |it: &Temperature| matches!(it.change, TemperatureChange::Field { .. });
    let field = case.temperatures.iter().position(is_field);
    if let (Some(index), BodySection::Lattice(_)) = (field, &case.body) {
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
    let loads = case.loads.iter().enumerate();
    let advice =
        ": give one of the loads another `name` (the name of a load without one is its group)";
    require_unique(
        loads.map(|(index, load)| (path("load", index), load.name.as_str())),
        advice,
    )?;
    let probes = case.probes.iter().enumerate();
    require_unique(
        probes.map(|(index, probe)| (path("probe", index).child("name"), probe.name.as_str())),
        "",
    )
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
