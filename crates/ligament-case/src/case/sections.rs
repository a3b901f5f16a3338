//! The sections of a case file, read and checked together.

use std::path::Path;

use ligament::Message;
use ligament::body::AnyBody;
use ligament::near_growth::Growth;
use ligament::plausibility::{of_angle, without_thickness};
use ligament::setup::{self, Alpha, Interface, QuietEdge, Section, Setup, SurfaceContact};
use ligament_analysis::SolverSettings;
use ligament_analysis::modal::ModalSettings;
use ligament_analysis::motion::{MotionSettings, Scheme};
use ligament_mesh::{AnyMesh, Mesh, SolidMesh};
use ligament_model::Plane;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::analysis::{self, Analysis, Output, StressField};
use super::conditions::{InitialVelocity, Load, Support, Temperature};
use super::contact::Rigid;
use super::decode::decode;
use super::document::Node;
use super::fault::{Fault as F, KeyFault};
use super::fracture::{Control, Distribution, Fracture};
use super::ineffective_keys::{Settings, refuse_keys_without_effect};
use super::key_path::KeyPath;
use super::lattice::{LatticeSection, SolidLatticeSection};
use super::material::{self, Material};
use super::mesh_section::{BodyKind, MeshSection};
use super::model::{Correction, ModelSection};
use super::places::{FarField, Region};
use super::precrack::Precrack;
use super::probe::Probe;
use super::refine::Refine;
use super::stage::Stage;
use super::values::{each, exactly_one, metre, missing_key};
use crate::point_table::Tables;

/// A case: the sections of its file, with every default filled in.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = exactly_one(&["mesh", "lattice", "solid_lattice"])))]
pub struct Case {
    /// One line on what the case is.
    #[serde(default)]
    pub title: String,
    /// Kind of analysis; without it `motion` where there is a `[motion]` section, `fracture` where there is a `[fracture]` section, else
    /// `static`.
    pub analysis: Option<Analysis>,
    /// Name of the load, `temperature`, or name of the rigid body that is the axis of the force-displacement curve; without it the first load,
    /// otherwise the temperature, otherwise the first rigid body that moves.
    pub curve: Option<String>,
    /// The body, meshed by Gmsh; or a `[lattice]`.
    pub mesh: Option<MeshSection>,
    /// The body as a rectangle of equal cells with a point at the centre of each; or a `[mesh]`.
    pub lattice: Option<LatticeSection>,
    /// The body as a box of equal cells in space with a point at the centre of each; or a `[mesh]` of solid cells.
    pub solid_lattice: Option<SolidLatticeSection>,
    /// The material of the whole body; or a table `[material.NAME]` with a `group` for each of several.
    #[serde(
        rename = "material",
        deserialize_with = "material::skip",
        serialize_with = "material::serialize"
    )]
    #[schemars(schema_with = "material::schema")]
    pub materials: Vec<Material>,
    /// Interfaces between two materials with strengths of their own.
    #[serde(rename = "interface", default, skip_serializing_if = "Vec::is_empty")]
    pub interfaces: Vec<Interface>,
    /// The bond model.
    pub model: ModelSection,
    /// The corrections of the bonds; without it as in the paper of the law.
    #[serde(default)]
    pub correction: Correction,
    /// Cracks and slots that are there from the start.
    #[serde(rename = "precrack", default, skip_serializing_if = "Vec::is_empty")]
    pub precracks: Vec<Precrack>,
    /// Supports of the body, which needs none.
    #[serde(rename = "support", default, skip_serializing_if = "Vec::is_empty")]
    pub supports: Vec<Support>,
    /// Loads as they are at load factor 1; the first is the axis of the force-displacement curve.
    #[serde(rename = "load", default, skip_serializing_if = "Vec::is_empty")]
    pub loads: Vec<Load>,
    /// Stages one after the other, in which each load follows a factor of its own; without any all grow with one load factor.
    #[serde(rename = "stage", default, skip_serializing_if = "Vec::is_empty")]
    pub stages: Vec<Stage>,
    /// Changes of temperature at load factor 1; where several apply, the last one counts.
    #[serde(rename = "temperature", default, skip_serializing_if = "Vec::is_empty")]
    pub temperatures: Vec<Temperature>,
    /// Velocities at time zero of a motion.
    #[serde(
        rename = "initial_velocity",
        default,
        skip_serializing_if = "Vec::is_empty"
    )]
    pub initial_velocities: Vec<InitialVelocity>,
    /// Parts of the outline through which waves leave the body in a motion.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub quiet: Vec<QuietEdge>,
    /// Contact between parts of the body.
    #[serde(rename = "contact", default, skip_serializing_if = "Vec::is_empty")]
    pub contacts: Vec<SurfaceContact>,
    /// Rigid bodies that parts of the body meet.
    #[serde(rename = "rigid", default, skip_serializing_if = "Vec::is_empty")]
    pub rigid_bodies: Vec<Rigid>,
    /// Linear finite elements in place of bonds, away from parts of a meshed body.
    pub far_field: Option<FarField>,
    /// Runs one after the other, each from the unloaded body, on meshes that are finer where bonds of the runs before broke.
    pub refine: Option<Refine>,
    /// Parts of the body where bonds never break.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub no_fail: Vec<Region>,
    /// Extra columns of `history.csv`.
    #[serde(rename = "probe", default, skip_serializing_if = "Vec::is_empty")]
    pub probes: Vec<Probe>,
    /// How bonds break; without it the case is one linear elastic solution.
    pub fracture: Option<Fracture>,
    /// Requested natural modes, with `analysis = "modal"`.
    pub modal: Option<ModalSettings>,
    /// A motion in time under loads that depend on time.
    pub motion: Option<MotionSettings>,
    /// Solution of the equations; all keys are optional.
    #[serde(default, deserialize_with = "analysis::read_solver")]
    #[schemars(schema_with = "analysis::solver_schema")]
    pub solver: SolverSettings,
    /// Files that a run writes.
    #[serde(default)]
    pub output: Output,
}

/// A section that a case need not have.
fn optional<T, U>(
    section: &Option<T>,
    setup: impl FnOnce(&T) -> Result<U, KeyFault>,
) -> Result<Option<U>, KeyFault> {
    section.as_ref().map(setup).transpose()
}

impl Case {
    /// Reads a parsed document and fills in missing keys; `folder` is the folder of the case file, `body` the kind of a body in memory.
    pub(super) fn read(
        document: &Node,
        folder: &Path,
        body: Option<BodyKind>,
    ) -> Result<Self, KeyFault> {
        let mut case: Self = decode(document, &KeyPath::default()).map_err(name_missing_section)?;
        let material = document.get("material");
        case.materials = material::read(material.ok_or_else(|| missing_section("material"))?)?;
        case.require_one_body()?;
        if let Some(mesh) = &mut case.mesh {
            mesh.complete(&at("mesh"), folder, body)?;
        }
        case.complete_analysis(document)?;
        let is_idle = case.loads.is_empty()
            && case.temperatures.is_empty()
            && case.initial_velocities.is_empty()
            && case.rigid_bodies.is_empty();
        if is_idle && case.analysis != Some(Analysis::Modal) {
            return Err(missing_section("load"));
        }
        let (loads, temperatures) = (at("load"), at("temperature"));
        for (index, load) in case.loads.iter_mut().enumerate() {
            load.complete(&loads.child(index), index + 1, folder)?;
        }
        for (index, body) in case.rigid_bodies.iter_mut().enumerate() {
            body.complete(&at("rigid").child(index), folder)?;
        }
        for (index, stage) in case.stages.iter_mut().enumerate() {
            stage.complete(&at("stage").child(index), index + 1)?;
        }
        for (index, temperature) in case.temperatures.iter_mut().enumerate() {
            temperature.complete(&temperatures.child(index), folder)?;
        }
        case.model.complete(&at("model"))?;
        if let Some(refine) = &mut case.refine {
            refine.complete(&at("refine"), folder)?;
        }
        let law = case.model.law;
        case.correction.complete(&at("correction"), &law)?;
        if let Some(fracture) = &mut case.fracture {
            let (key, is_staged) = (at("fracture"), !case.stages.is_empty());
            if case.motion.is_none() {
                fracture.complete(&key, is_staged)?;
            }
            fracture.complete_criteria(&key, &law)?;
        }
        let on_exact_path = (case.fracture.as_ref()).is_some_and(|it| it.control == Control::Event);
        (case.output).complete(&at("output"), on_exact_path)?;
        Ok(case)
    }

    /// Sets the analysis, as given by the case or implied by its sections; refuses keys that do not apply in it.
    fn complete_analysis(&mut self, document: &Node) -> Result<(), KeyFault> {
        let is_breaking = self.fracture.is_some();
        let default_analysis = match (&self.motion, is_breaking) {
            (Some(_), _) => Analysis::Motion,
            (None, true) => Analysis::Fracture,
            (None, false) => Analysis::Static,
        };
        let analysis = *self.analysis.get_or_insert(default_analysis);
        refuse_keys_without_effect(document, &self.settings())?;
        let needs = |reason| Err(KeyFault::new(at("analysis"), reason));
        match analysis {
            Analysis::Motion if self.motion.is_none() => needs(
                "\"motion\" needs a [motion] section, which says how long it lasts: `duration`, in s",
            ),
            Analysis::Fracture if !is_breaking => {
                needs("\"fracture\" needs a [fracture] section, which says how the loads rise")
            }
            Analysis::Modal => {
                self.modal.get_or_insert_default();
                Ok(())
            }
            Analysis::Motion | Analysis::Fracture | Analysis::Static => Ok(()),
        }
    }

    /// Settings that decide whether keys have an effect.
    pub(super) fn settings(&self) -> Settings {
        Settings {
            analysis: self.analysis,
            scheme: self.motion.as_ref().map(|it| it.scheme),
            control: self.fracture.as_ref().map(|it| it.control),
            has_stages: !self.stages.is_empty(),
        }
    }

    fn require_one_body(&self) -> Result<(), KeyFault> {
        let given = [
            self.mesh.is_some(),
            self.lattice.is_some(),
            self.solid_lattice.is_some(),
        ];
        match given {
            [true, false, false] | [false, true, false] | [false, false, true] => Ok(()),
            [false, false, false] => Err(KeyFault::new(
                at("mesh"),
                F::MissingSection {
                    section: "[mesh] or [lattice]".to_owned(),
                    purpose: "one of them: [mesh] with `file`, the Gmsh file, or [lattice] with `cells` and `spacing`",
                },
            )),
            [true, true, _] => Err(KeyFault::new(
                at("lattice"),
                "the case has a [mesh] as well, but its body is one of the two: remove [mesh] or [lattice]",
            )),
            [_, _, true] => Err(KeyFault::new(
                at("solid_lattice"),
                "the case has a [mesh] or a [lattice] as well, but its body is one of them: remove the others",
            )),
        }
    }

    /// State of the plane.
    pub fn plane(&self) -> Plane {
        let of_mesh = self.mesh.as_ref().and_then(|it| it.plane);
        let of_lattice = self.lattice.as_ref().map(|it| it.plane);
        of_mesh.or(of_lattice).unwrap_or_default()
    }

    /// Whether the body is solid.
    pub fn is_solid(&self) -> bool {
        self.solid_lattice.is_some() || self.mesh.as_ref().is_some_and(|it| it.is_solid)
    }

    /// Thickness of a body in the plane, m, where it is given.
    pub fn thickness(&self) -> Option<f64> {
        let of_mesh = self.mesh.as_ref().and_then(|it| it.thickness);
        let of_lattice = self.lattice.as_ref().and_then(|it| it.thickness);
        of_mesh.or(of_lattice)
    }

    /// Section of a body.
    fn section(&self, body: &AnyBody) -> Section {
        match body {
            AnyBody::Plane(_) => Section::Plane {
                state: self.plane(),
                thickness: self.thickness().unwrap_or_else(metre),
            },
            AnyBody::Solid(_) => Section::Solid,
        }
    }

    /// Remarks on the scale of a mesh, and on implausible values in the sections of a body in the plane.
    fn remarks(&self) -> Vec<Message> {
        let scale = self.mesh.as_ref().and_then(|it| it.scale);
        let scale = scale.map(|it| {
            let text = format!(
                "the coordinates of the mesh are multiplied by {it}, and nothing else of the case"
            );
            Message::new("scaled-mesh", text)
                .with_advice("boxes, displacements and thicknesses are in m")
        });
        if self.is_solid() {
            return scale.into_iter().collect();
        }
        // A long body in plane strain is computed per metre of its length.
        let is_missing = self.thickness().is_none() && self.plane() == Plane::Stress;
        let missing = is_missing.then(without_thickness);
        let angles = (self.precracks.iter().enumerate()).filter_map(|(index, crack)| {
            let what = format!("the angle of pre-crack {}", index + 1);
            of_angle(&what, crack.angle?)
        });
        scale.into_iter().chain(missing).chain(angles).collect()
    }

    /// The setup of the case with its tables, on a given body.
    pub(crate) fn setup_on(&self, body: AnyBody, tables: Tables) -> Result<Setup, KeyFault> {
        let dimensions = body.dimensions();
        let law = self.model.law;
        let criteria = self.fracture.iter().filter_map(|it| it.criteria.as_deref());
        self.check_across_sections()?;
        Ok(Setup {
            section: self.section(&body),
            body,
            precracks: each(&at("precrack"), &self.precracks, |it, key| {
                it.setup(key, dimensions)
            })?,
            materials: (self.materials.iter())
                .map(Material::setup)
                .collect::<Result<_, _>>()?,
            interfaces: self.interfaces.clone(),
            law,
            rotational_scale: self.model.rotational_scale(),
            horizon: self.model.horizon(&at("model"))?,
            bonds_through_voids: self.model.bonds_through_voids,
            correction: self.correction.setup(&law),
            closing: self.model.closing,
            closing_friction: self.model.closing_friction,
            far_field: optional(&self.far_field, |it| it.setup(&at("far_field")))?,
            refine: optional(&self.refine, |it| it.setup(&at("refine"), tables))?,
            no_fail: each(&at("no_fail"), &self.no_fail, Region::place)?,
            supports: each(&at("support"), &self.supports, Support::setup)?,
            loads: each(&at("load"), &self.loads, |it, key| it.setup(key, tables))?,
            curve: self.curve.clone(),
            stages: each(&at("stage"), &self.stages, Stage::setup)?,
            temperatures: each(&at("temperature"), &self.temperatures, |it, key| {
                it.setup(key, tables)
            })?,
            initial_velocities: each(
                &at("initial_velocity"),
                &self.initial_velocities,
                InitialVelocity::setup,
            )?,
            quiet: self.quiet.clone(),
            contacts: self.contacts.clone(),
            rigid_bodies: each(&at("rigid"), &self.rigid_bodies, |it, key| {
                it.setup(key, dimensions, tables)
            })?,
            criteria: criteria.flatten().cloned().collect(),
            scatter: (self.fracture.as_ref())
                .and_then(|it| it.scatter.as_ref())
                .map(|it| it.setup(&at("fracture").child("scatter")))
                .transpose()?
                .unwrap_or_default(),
            probes: each(&at("probe"), &self.probes, Probe::setup)?,
            analysis: self.analysis_of_setup()?,
            solver: SolverSettings {
                allows_unstable: self.model.allow_unstable,
                ..self.solver.clone()
            },
            remarks: self.remarks(),
        })
    }

    /// Papers of the law, the corrections, the criteria and laws of softening, random properties and the motion, as texts with keys of the
    /// references, each once.
    pub fn sources(&self) -> Vec<&'static str> {
        let mut found = vec![self.model.law.row.source];
        found.extend(self.correction.alpha.map(Alpha::source));
        found.extend(self.correction.surface.map(|it| it.0.source()));
        let fracture = self.fracture.as_ref();
        let criteria = fracture.and_then(|it| it.criteria.as_deref());
        for criterion in criteria.into_iter().flatten() {
            found.extend([criterion.kind.source, criterion.after.source]);
        }
        let scatter = fracture.and_then(|it| it.scatter.as_ref());
        for scatter in scatter.iter().flat_map(|it| &it.0) {
            found.push(match scatter.distribution {
                Distribution::Weibull => "Weibull 1951",
                Distribution::Normal => "",
                Distribution::Lognormal => "Aitchison and Brown 1957",
            });
            if scatter.correlation_length > 0.0 {
                found.push("Shinozuka and Jan 1972");
            }
        }
        let motion = self.motion.as_ref();
        if motion.is_some_and(|it| it.scheme != Scheme::Explicit) {
            found.push("Hilber 1977");
        }
        if !self.quiet.is_empty() {
            found.push("Lysmer and Kuhlemeyer 1969");
        }
        let mut each = Vec::new();
        for source in found {
            if !source.is_empty() && !each.contains(&source) {
                each.push(source);
            }
        }
        each
    }

    /// Adds the places of a growth to the near field.
    pub fn grow(&mut self, growth: &Growth) {
        if let Some(far_field) = &mut self.far_field {
            far_field.grow(growth);
        }
    }

    fn analysis_of_setup(&self) -> Result<setup::Analysis, KeyFault> {
        Ok(match (&self.motion, &self.modal, &self.fracture) {
            (Some(motion), _, _) => {
                if !motion.is_explicit() && motion.step.is_none() {
                    return Err(missing_key(&at("motion"), "step"));
                }
                let fracture = self.fracture.as_ref();
                let breakages =
                    fracture.map_or(motion.breakages, |it| it.step_breakages(motion.breakages));
                setup::Analysis::Motion(MotionSettings {
                    breakages,
                    ..*motion
                })
            }
            (None, Some(modal), _) => setup::Analysis::Modal(*modal),
            (None, None, Some(fracture)) => {
                fracture.setup(&at("fracture"), !self.stages.is_empty())?
            }
            (None, None, None) => setup::Analysis::default(),
        })
    }

    /// A substitute for the body before it is built, of the same kind, with at most one point.
    pub(super) fn substitute_body(&self, is_solid: bool) -> Result<AnyBody, KeyFault> {
        Ok(match (is_solid, &self.lattice, &self.solid_lattice) {
            (true, _, Some(lattice)) => AnyBody::from(lattice.grid().substitute_body()?),
            (false, Some(lattice), _) => AnyBody::from(lattice.grid().substitute_body()?),
            (true, _, None) => AnyMesh::Solid(SolidMesh::default()).into(),
            (false, None, _) => AnyMesh::Plane(Mesh::default()).into(),
        })
    }

    /// Checks conditions across sections, beyond the checks of the setup.
    fn check_across_sections(&self) -> Result<(), KeyFault> {
        let law = self.model.law.row;
        let has_traction = self.output.stress.contains(&StressField::Traction);
        let stress = at("output").child("stress");
        if self.far_field.is_some() && has_traction {
            let reason = "forces through planes at points are summed over bonds, and the far field has elements: take \"material\" or \"virial\"";
            return Err(KeyFault::new(stress, reason));
        }
        if !law.couples_ends_alone && has_traction && self.modal.is_none() {
            let reason = format!(
                "the elements of {} couple up to six points, so that their forces go through no line: take \"material\" or \"virial\"",
                law.quoted()
            );
            return Err(KeyFault::new(stress, reason));
        }
        let field = (self.temperatures.iter()).position(|it| it.mesh_field.is_some());
        if let (Some(index), Some(_)) = (field, &self.lattice) {
            let fault = F::NotWith {
                key: "mesh_field",
                setting: "[lattice]".to_owned(),
                reason: "it is in the file of a mesh; a lattice takes a `file` of its own",
            };
            let key = at("temperature").child(index);
            return Err(KeyFault::new(key.child("mesh_field"), fault));
        }
        Ok(())
    }
}

/// Key path of a section.
fn at(section: &str) -> KeyPath {
    KeyPath::default().child(section)
}

/// Converts the fault of a missing section, to include its purpose.
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
    KeyFault::new(at(name), F::MissingSection { section, purpose })
}
