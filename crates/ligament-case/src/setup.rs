//! From a case to the setup of a computation, and from a faulty field of the setup back to the key of the case.

use std::sync::Arc;

use ligament::body::{Body, LatticeBody, LatticeError, MeshBody};
use ligament::error::Fault as SetupFault;
use ligament::setup::{Setup, TemperatureChange};
use ligament::stage::{StageWatcher, stage};
use ligament::{Field, SetupError};

use crate::case::key_path::KeyPath;
use crate::case::{CaseError, CaseFile, Fault, LatticeSection};
use crate::mesh_file::read_mesh;
use crate::temperature_table;

/// What a setup calls by the names of its types, and the words of a case for it.
const WORDS: [(&str, &str); 10] = [
    (" or `Law::MbbPd`", " or \"mbb-pd\""),
    ("`Law::MbbPd`", "model.law = \"mbb-pd\""),
    ("`Law::Orthotropic`", "model.law = \"orthotropic\""),
    ("`LatticeBody`", "[lattice] in the place of [mesh]"),
    ("`Alpha::None`", "\"none\""),
    ("`Surface::None`", "\"none\""),
    (
        "`Calibration::Integral`",
        "model.calibration = \"integral\"",
    ),
    ("`Form::Full`", "\"full\""),
    ("`Strains::Small`", "strains = \"small\""),
    (
        "`Place::Group`, `Place::Box` or `Place::Everywhere`",
        "`group`, `box`, or neither for the whole body",
    ),
];

impl CaseFile {
    /// The setup of the case, with its body and the tables that it names read from their files.
    ///
    /// # Errors
    ///
    /// If a file cannot be read, or nothing is left of the lattice or of one of its sets.
    pub fn setup(&self, watcher: &mut dyn StageWatcher) -> anyhow::Result<Setup> {
        let body: Arc<dyn Body> = match (&self.case.mesh, &self.case.lattice) {
            (Some(section), _) => {
                let mesh = stage(watcher, "read mesh", || read_mesh(&section.file))?;
                Arc::new(MeshBody::from(mesh))
            }
            (None, Some(section)) => Arc::new(stage(watcher, "lattice", || self.lattice(section))?),
            (None, None) => anyhow::bail!("the case has no body"),
        };
        Ok(self.setup_on(body)?)
    }

    /// The setup of the case on a body that is there already, whatever body the case names.
    ///
    /// # Errors
    ///
    /// If a table of temperatures cannot be read.
    pub fn setup_on(&self, body: Arc<dyn Body>) -> Result<Setup, CaseError> {
        let setup = self.case.setup(body);
        let mut setup = setup.map_err(|fault| self.source.error(fault))?;
        for (index, section) in self.case.temperatures.iter().enumerate() {
            if let Some(file) = &section.file {
                let rows = temperature_table::rows_of(file);
                let rows = rows
                    .map_err(|reason| self.error(&format!("temperature.{index}.file"), reason))?;
                let samples = rows.into_iter().map(|(_, sample)| sample);
                setup.temperatures[index].change = TemperatureChange::Table(samples.collect());
            }
        }
        Ok(setup)
    }

    fn lattice(&self, section: &LatticeSection) -> Result<LatticeBody, CaseError> {
        let key = KeyPath::default().child("lattice");
        let parts = section.parts(&key);
        let (holes, sets) = parts.map_err(|fault| self.source.error(fault))?;
        let (spacing, corner) = (section.spacing.0, section.corner);
        let body = LatticeBody::new(section.cells, spacing, corner, &holes, &sets);
        body.map_err(|error| {
            let key = match &error {
                LatticeError::NothingLeft { .. } => "lattice.remove".to_owned(),
                LatticeError::EmptySet { name } => LatticeSection::set_key(name),
                LatticeError::NoRim { hole } => format!("lattice.remove.{hole}"),
            };
            self.error(&key, error.to_string())
        })
    }

    /// Number of threads that the case asks for, if it does.
    pub fn threads(&self) -> Option<usize> {
        self.case.solver.threads.map(|threads| threads as usize)
    }

    /// The error of a faulty field of the setup at the key that it comes from.
    pub fn located(&self, error: SetupError) -> CaseError {
        let SetupError { field, fault } = error;
        let mut key = self.key(field);
        let fault = match *fault {
            SetupFault::Missing { reason, .. } => Fault::Required {
                key: missing_key(field),
                reason,
            },
            SetupFault::Unfit(unfit) => {
                key = unfit.key().map_or(key.clone(), |it| format!("{key}.{it}"));
                Fault::Other(unfit.to_string())
            }
            SetupFault::NameTwice { name, first } => Fault::NotUnique {
                name,
                first: self.key(first.part("name")),
                advice: match field.name {
                    "loads" => {
                        ": give one of the loads another `name` (the name of a load without one is its group)"
                    }
                    _ => "",
                },
            },
            SetupFault::Contradiction(reason) => {
                let in_words = |text: String, (name, word)| text.replace(name, word);
                Fault::Other(WORDS.into_iter().fold(reason.into_owned(), in_words))
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
            other => other.into(),
        };
        self.error(&key, fault)
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
            "body" => "lattice",
            "law" | "horizon" => "model",
            "materials" => "material",
            "precracks" => "precrack",
            "supports" => "support",
            "loads" => "load",
            "temperatures" => "temperature",
            "probes" => "probe",
            "criteria" => "fracture.criterion",
            "analysis.load_factors" => "fracture.steps",
            other => other,
        };
        let Some(index) = field.index else {
            let part = match (field.name, field.part) {
                ("law", None) => Some("law"),
                (_, part) => part,
            };
            return part.map_or(list.to_owned(), |part| format!("{list}.{part}"));
        };
        let element = match field.name {
            "materials" => self.case.materials[index].key(),
            _ => format!("{list}.{index}"),
        };
        let part = match (field.name, field.part) {
            ("supports", None) => "displacement",
            ("materials", Some("elasticity")) | ("loads", Some("name")) | (_, None) => {
                return element;
            }
            ("materials", Some(_)) => missing_key(field),
            ("precracks", Some("points")) => &self.points_key(index),
            (_, Some("place")) => self.place_key(field.name, index),
            (_, Some("action")) => self.case.loads[index].action_key(),
            (_, Some("change")) => self.case.temperatures[index].change_key(),
            (_, Some("reading")) => self.case.probes[index].reading_key(),
            ("temperatures", Some("name")) => "mesh_field",
            (_, Some(other)) => other,
        };
        format!("{element}.{part}")
    }

    /// The key of the points of a pre-crack, or of the one that repeats the point before it.
    fn points_key(&self, index: usize) -> String {
        let points = self.case.precracks[index].points.iter();
        let mut pairs = points.flat_map(|points| points.windows(2));
        let repeated = pairs.position(|pair| pair[0] == pair[1]);
        repeated.map_or("points".to_owned(), |before| {
            format!("points.{}", before + 1)
        })
    }

    /// The key by which an element of a list says where it is.
    fn place_key(&self, list: &str, index: usize) -> &'static str {
        let case = &self.case;
        let (corners, at) = match list {
            "supports" => (case.supports[index].r#box, case.supports[index].at),
            "loads" => (case.loads[index].r#box, case.loads[index].at),
            "temperatures" => (case.temperatures[index].r#box, None),
            _ => (case.no_fail[index].r#box, None),
        };
        match (corners, at) {
            (Some(_), _) => "box",
            (None, Some(_)) => "at",
            (None, None) => "group",
        }
    }

    /// The fault of two rows of a table of temperatures for a point.
    fn row_twice(&self, field: Field, place: &str, samples: [usize; 2]) -> Fault {
        let section = field.index.map(|index| &self.case.temperatures[index]);
        let Some(file) = section.and_then(|it| it.file.as_ref()) else {
            return format!("{place} has two temperatures").into();
        };
        // The rows were read before: only their lines are asked for.
        let rows = temperature_table::rows_of(file).unwrap_or_default();
        let [first, second] = samples.map(|it| rows.get(it).map_or(0, |(line, _)| *line));
        let file = file.display();
        format!("{file}:{second}: {place} has a row already, in line {first}").into()
    }
}

/// The key of a material that a part of the setup's comes from.
fn missing_key(field: Field) -> &'static str {
    match field.part {
        Some("elasticity.poisson") => "poisson_12",
        Some("elasticity.out_of_plane") => "young_3",
        Some("expansion") => "thermal_expansion",
        Some("expansion.across") => "thermal_expansion_3",
        Some(part) => part.trim_start_matches("elasticity."),
        None => "",
    }
}
