//! From a case to the setup of a computation, and from a faulty field of the setup back to the key of the case.

use std::sync::Arc;

use ligament::body::{Body, CellSet, Hole, LatticeBody, LatticeError, MeshBody};
use ligament::error::Fault as SetupFault;
use ligament::setup::{
    Action, Analysis, Correction, Displacement, Horizon, Iteration, Load, MaterialRegion, Place,
    Probe, Profile, Reading, Section, Setup, Support, Surface, Temperature, TemperatureChange,
};
use ligament::stage::{StageWatcher, stage};
use ligament::{Field, SetupError};
use ligament_analysis::breaking::BreakingRule;
use ligament_analysis::driver::StopRules;
use ligament_analysis::driver::event::EventSettings;
use ligament_analysis::driver::stepped::SteppedSettings;
use ligament_analysis::modal::ModalSettings;
use ligament_analysis::solver::SolverSettings;
use ligament_model::bonds::precrack::PreCrack;
use ligament_model::correction::StopRule;
use ligament_model::{Material, Plane, Shape};

use crate::case::{
    self, BodySection, CaseError, CaseFile, CorrectionRule, Fault, LatticeSection, Stepping, Steps,
};
use crate::mesh_file::read_mesh;
use crate::temperature_table;

impl CaseFile {
    /// The setup of the case, with its body and the tables that it names read from their files.
    ///
    /// # Errors
    ///
    /// If a file cannot be read, or nothing is left of the lattice or of one of its sets.
    pub fn setup(&self, watcher: &mut dyn StageWatcher) -> anyhow::Result<Setup> {
        let body: Arc<dyn Body> = match &self.case.body {
            BodySection::Mesh(section) => {
                let mesh = stage(watcher, "read mesh", || read_mesh(&section.file))?;
                Arc::new(MeshBody::from(mesh))
            }
            BodySection::Lattice(section) => {
                Arc::new(stage(watcher, "lattice", || lattice(self, section))?)
            }
        };
        Ok(self.setup_on(body)?)
    }

    /// The setup of the case on a body that is there already, whatever body the case names.
    ///
    /// # Errors
    ///
    /// If a table of temperatures cannot be read.
    pub fn setup_on(&self, body: Arc<dyn Body>) -> Result<Setup, CaseError> {
        let case = &self.case;
        let temperatures = case.temperatures.iter().enumerate();
        let region = |material: &case::Material| MaterialRegion {
            group: material.group.clone(),
            material: material.into(),
        };
        Ok(Setup {
            body,
            section: Section::Plane {
                state: plane(self),
                thickness: case.body.thickness(),
            },
            materials: case.materials.iter().map(region).collect(),
            law: (&case.model).into(),
            horizon: horizon(&case.model),
            bonds_through_voids: false,
            correction: correction(&case.correction),
            precracks: case.precracks.iter().map(precrack).collect(),
            no_fail: case.no_fail.iter().map(|it| place_of(Some(it))).collect(),
            supports: case.supports.iter().map(support).collect(),
            loads: case.loads.iter().map(load).collect(),
            temperatures: temperatures
                .map(|(index, it)| self.temperature(index, it))
                .collect::<Result<_, _>>()?,
            criteria: (case.fracture.iter())
                .flat_map(|it| it.criteria.clone())
                .collect(),
            probes: case.probes.iter().map(probe).collect(),
            analysis: analysis(case),
            solver: solver(&case.solver),
            threads: self.threads(),
        })
    }

    /// Number of threads that the case asks for, if it does.
    pub fn threads(&self) -> Option<usize> {
        self.case.solver.threads.map(|threads| threads as usize)
    }

    /// The error of a faulty field of the setup at the key that it comes from.
    pub fn located(&self, error: SetupError) -> CaseError {
        let SetupError { field, fault } = error;
        let fault = match *fault {
            SetupFault::UnknownName {
                what,
                found,
                candidates,
            } => Fault::unknown_name(what, found, candidates),
            SetupFault::Missing { reason, .. } if field.part == Some("expansion") => {
                Fault::Required {
                    key: "thermal_expansion",
                    reason,
                }
            }
            SetupFault::NothingHappens => {
                "there is no [[load]] and no point whose temperature changes: nothing would happen"
                    .into()
            }
            SetupFault::SampledTwice {
                place,
                first,
                second,
            } => self.row_twice(field, &place, [first, second]),
            other => Fault::Other(other.to_string()),
        };
        self.error(&self.key(field), fault)
    }

    /// The error of a computation, with a faulty field of the setup at the key that it comes from.
    pub fn explained(&self, error: ligament::Error) -> anyhow::Error {
        match error {
            ligament::Error::Setup(error) => self.located(error).into(),
            other => other.into(),
        }
    }

    /// Key path of what a field of the setup comes from.
    fn key(&self, field: Field) -> String {
        let list = match field.name {
            "supports" => "support",
            "loads" => "load",
            "temperatures" => "temperature",
            "probes" => "probe",
            "criteria" => "fracture.criterion",
            "horizon" => "model",
            "materials" => "material",
            other => other,
        };
        let Some(index) = field.index else {
            return list.to_owned();
        };
        let element = match field.name {
            "materials" => self.case.materials[index].key(),
            _ => format!("{list}.{index}"),
        };
        let part = match field.part {
            Some("place") => self.place_key(field.name, index),
            Some("action") => self.case.loads[index].action.key(),
            Some("expansion") => "thermal_expansion",
            Some("change") => match &self.case.temperatures[index].change {
                case::TemperatureChange::Uniform { .. } => "change",
                case::TemperatureChange::Table { .. } => "file",
                case::TemperatureChange::Field { .. } => "mesh_field",
            },
            Some("name") if field.name == "temperatures" => "mesh_field",
            Some(other) => other,
            None => return element,
        };
        format!("{element}.{part}")
    }

    /// The key by which an element of a list says where it is.
    fn place_key(&self, list: &str, index: usize) -> &'static str {
        let place = match list {
            "supports" => place(Some(&self.case.supports[index].place)),
            "loads" => place(self.case.loads[index].place.as_ref()),
            "temperatures" => place_of(self.case.temperatures[index].region.as_ref()),
            _ => place_of(self.case.no_fail.get(index)),
        };
        match place {
            Place::Box(_) => "box",
            Place::At(_) => "at",
            Place::Group(_) | Place::Everywhere => "group",
        }
    }

    fn temperature(
        &self,
        index: usize,
        section: &case::Temperature,
    ) -> Result<Temperature, CaseError> {
        let change = match &section.change {
            case::TemperatureChange::Uniform { change } => TemperatureChange::Uniform(*change),
            case::TemperatureChange::Table { file } => {
                let rows = temperature_table::rows_of(file);
                let rows = rows
                    .map_err(|reason| self.error(&format!("temperature.{index}.file"), reason))?;
                TemperatureChange::Table(rows.into_iter().map(|(_, sample)| sample).collect())
            }
            case::TemperatureChange::Field {
                mesh_field,
                time_step,
                reference,
            } => TemperatureChange::Field {
                name: mesh_field.clone(),
                time_step: *time_step,
                reference: *reference,
            },
        };
        Ok(Temperature {
            place: place_of(section.region.as_ref()),
            change,
        })
    }

    /// The fault of two rows of a table of temperatures for a point.
    fn row_twice(&self, field: Field, place: &str, samples: [usize; 2]) -> Fault {
        let section = field
            .index
            .map(|index| &self.case.temperatures[index].change);
        let Some(case::TemperatureChange::Table { file }) = section else {
            return format!("{place} has two temperatures").into();
        };
        // The rows were read before: only their lines are asked for.
        let rows = temperature_table::rows_of(file).unwrap_or_default();
        let [first, second] = samples.map(|it| rows.get(it).map_or(0, |(line, _)| *line));
        let file = file.display();
        format!("{file}:{second}: {place} has a row already, in line {first}").into()
    }
}

/// State of the plane.
pub fn plane(case: &CaseFile) -> Plane {
    case.case.body.plane()
}

/// Materials, in the order of the case file.
pub fn materials(case: &CaseFile) -> Vec<Material> {
    case.case.materials.iter().map(Into::into).collect()
}

fn lattice(case: &CaseFile, section: &LatticeSection) -> Result<LatticeBody, CaseError> {
    let circle = |it: &case::Circle| Shape::Circle {
        centre: it.centre,
        radius: it.radius,
    };
    let hole = |hole: &case::Hole| Hole {
        name: hole.name.clone(),
        shape: match &hole.shape {
            case::HoleShape::Circle(it) => circle(it),
            case::HoleShape::Rectangle(corners) => Shape::rectangle(*corners),
            case::HoleShape::Polygon(corners) => Shape::Polygon(corners.clone()),
            case::HoleShape::Outside(disk) => Shape::Outside {
                centre: disk.centre,
                radius: disk.radius,
            },
        },
    };
    let set = |(name, set): (&String, &case::CellSet)| {
        let cells = match set {
            case::CellSet::Bottom(count) => CellSet::Bottom(*count),
            case::CellSet::Top(count) => CellSet::Top(*count),
            case::CellSet::Left(count) => CellSet::Left(*count),
            case::CellSet::Right(count) => CellSet::Right(*count),
            case::CellSet::Box(corners) => CellSet::Inside(Shape::rectangle(*corners)),
            case::CellSet::Circle(it) => CellSet::Inside(circle(it)),
            case::CellSet::Polygon(corners) => CellSet::Inside(Shape::Polygon(corners.clone())),
        };
        (name.clone(), cells)
    };
    let holes: Vec<Hole> = section.remove.iter().map(hole).collect();
    let sets = section.sets.iter().map(set).collect();
    let body = LatticeBody::new(
        section.cells,
        section.spacing,
        section.corner,
        &holes,
        &sets,
    );
    body.map_err(|error| {
        let key = match &error {
            LatticeError::NothingLeft { .. } => "lattice.remove".to_owned(),
            LatticeError::EmptySet { name } => LatticeSection::set_key(name),
            LatticeError::NoRim { hole } => format!("lattice.remove.{hole}"),
        };
        case.error(&key, error.to_string())
    })
}

fn horizon(model: &case::ModelSection) -> Horizon {
    match model.horizon_factor {
        Some(factor) => Horizon::Factor(factor),
        None => Horizon::Length(model.horizon.unwrap_or_default()),
    }
}

fn correction(correction: &case::Correction) -> Correction {
    let iteration = |it: &case::Iteration| Iteration {
        stop: match (it.rule, it.tolerance) {
            (CorrectionRule::Mean, tolerance) => tolerance.map(StopRule::Mean),
            (CorrectionRule::Sum, tolerance) => tolerance.map(StopRule::Sum),
            (CorrectionRule::Auto, _) => None,
        },
        max_sweeps: it.max_sweeps as usize,
    };
    Correction {
        alpha: correction.alpha.0,
        surface: match (correction.surface, &correction.iteration) {
            (case::Surface::Domain, Some(it)) => Surface::Domain(iteration(it)),
            (case::Surface::Volume, _) => Surface::Volume,
            (case::Surface::None | case::Surface::Domain, _) => Surface::None,
        },
        domain: correction.domain.0,
    }
}

fn precrack(crack: &case::Precrack) -> PreCrack {
    PreCrack {
        points: crack.points(),
        ends: crack.ends.0,
    }
}

fn place(place: Option<&case::Place>) -> Place {
    match place {
        Some(case::Place::Group(group)) => Place::Group(group.clone()),
        Some(case::Place::Box(corners)) => Place::Box(*corners),
        Some(case::Place::At(position)) => Place::At(*position),
        None => Place::Everywhere,
    }
}

fn place_of(region: Option<&case::Region>) -> Place {
    match region {
        Some(case::Region::Group(group)) => Place::Group(group.clone()),
        Some(case::Region::Box(corners)) => Place::Box(*corners),
        None => Place::Everywhere,
    }
}

fn support(support: &case::Support) -> Support {
    let held = &support.displacement;
    Support {
        place: place(Some(&support.place)),
        x: held.x.is_some(),
        y: held.y.is_some(),
        rotation: held.rotation.is_some(),
    }
}

fn load(load: &case::Load) -> Load {
    Load {
        name: load.name.clone(),
        place: place(load.place.as_ref()),
        action: match load.action {
            case::Action::Displacement(it) => Action::Displacement(Displacement {
                x: it.x,
                y: it.y,
                rotation: it.rotation,
            }),
            case::Action::Force(it) => Action::Force([it.x, it.y]),
            case::Action::ForcePerLength(it) => Action::ForcePerLength([it.x, it.y]),
            case::Action::BodyForce(it) => Action::BodyForce([it.x, it.y]),
            case::Action::Moment(it) => Action::Moment(it),
            case::Action::BodyCouple(it) => Action::BodyCouple(it),
            case::Action::Pressure(it) => Action::Pressure(it),
        },
        profile: load.profile.map(|it| Profile {
            along: it.along.0,
            zero: it.zero,
            one: it.one,
        }),
    }
}

fn probe(probe: &case::Probe) -> Probe {
    let reading = match probe.reading {
        case::Reading::Between { between, component } => Reading::Between {
            positions: between,
            component: component.0,
        },
        case::Reading::At { at, field } => Reading::At {
            position: at,
            field: field.0,
        },
        case::Reading::Section { section, component } => Reading::Section {
            line: section,
            component: component.0,
        },
    };
    Probe {
        name: probe.name.clone(),
        reading,
    }
}

/// What is computed.
fn analysis(case: &case::Case) -> Analysis {
    match (&case.modal, &case.fracture) {
        (Some(modal), _) => Analysis::Modal(self::modal(modal)),
        (None, None) => Analysis::default(),
        (None, Some(fracture)) => match &fracture.control {
            case::Control::Stepped(stepping) => Analysis::Stepped(stepped(fracture, stepping)),
            case::Control::Event => Analysis::Event(event(fracture)),
        },
    }
}

/// How to step, for a case with load steps.
fn stepped(fracture: &case::Fracture, stepping: &Stepping) -> SteppedSettings {
    let load_factors = match &stepping.steps {
        Steps::Uniform(count) => (1..=*count)
            .map(|step| f64::from(step) / f64::from(*count))
            .collect(),
        Steps::Factors(factors) => factors.clone(),
    };
    SteppedSettings {
        load_factors,
        refine_first_break: stepping.refine_first_break as usize,
        rule: BreakingRule {
            order: stepping.order.0,
            bonds_per_iteration: stepping.bonds_per_iteration as usize,
            tie_tolerance: fracture.tie_tolerance,
        },
        energy_tolerance: fracture.energy_tolerance,
        round_limit: stepping.max_iterations as usize,
        stop: stop_rules(&fracture.stop),
    }
}

/// How to follow the exact path.
fn event(fracture: &case::Fracture) -> EventSettings {
    EventSettings {
        tie_tolerance: fracture.tie_tolerance,
        energy_tolerance: fracture.energy_tolerance,
        stop: stop_rules(&fracture.stop),
    }
}

fn stop_rules(stop: &case::Stop) -> StopRules {
    StopRules {
        load_fraction: stop.load_fraction,
        displacement: stop.displacement,
        bonds: stop.bonds.map(|bonds| bonds as usize),
        wall_time: stop.wall_time,
        negative_energy: stop.negative_energy,
    }
}

/// How the equations are solved.
fn solver(chosen: &case::Solver) -> SolverSettings {
    let default = SolverSettings::default();
    SolverSettings {
        factorisation: chosen.factorisation.0,
        ordering: chosen.ordering.0,
        update: chosen.update.0,
        rebuild_every: chosen
            .rebuild_every
            .map_or(default.rebuild_every, |bonds| bonds as usize),
    }
}

/// Settings of a modal analysis.
fn modal(modal: &case::Modal) -> ModalSettings {
    ModalSettings {
        modes: modal.modes as usize,
        rotations: modal.rotations.0,
        tolerance: modal.tolerance,
    }
}
