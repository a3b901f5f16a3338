//! The results of a run, read from their folder.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use ligament_analysis::result_fields::{DISPLACEMENT, HORIZON, ROTATION, THERMAL_STRAIN, VOLUME};
use ligament_analysis::{BondDeformation, ElementKind};
use ligament_model::Absence;
use ligament_model::tensor::SymTensor;
use ligament_model::thermal::StressFreeStrains;

use super::cracks::softened_pairs;
use super::location;
use super::model_file::{COEFFICIENTS, GROUP, INTERFACE, STIFF_CELLS, model_file};
use super::outputs::{OutputKind, kind_of, numbered_files, require_results};
use super::softening_table::BEGINS;
use super::stored_state::StoredState;
use super::tables::stored_names;
use crate::csv::read::{CsvTable, Row};
use crate::remedy::Remedy;
use crate::vtu::PIECES_EXTENSION;
use crate::vtu::read::VtuFile;
use crate::{Error, FieldLocation};

/// The results of a run.
#[derive(Debug)]
pub struct StoredRun {
    /// The folder of the results.
    pub folder: PathBuf,
    /// Points, bonds and limits.
    pub model: StoredModel,
    /// Rows of the history, in their order.
    pub history: Vec<StoredStep>,
    /// Broken bonds, in the order of breaking.
    pub breaks: Vec<StoredBreak>,
    /// Tags of the ends of the bonds whose force began to fall beyond a limit, with the step; empty where several processes ran the case.
    pub softened: Vec<([i64; 2], usize)>,
    /// Names of the stored components of a bond's deformation: two, or three for bonds with strains of their own.
    pub deformation_names: &'static [&'static str],
    /// Files of fields by their states.
    fields: BTreeMap<StoredState, PathBuf>,
}

/// The model of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredModel {
    /// The noun that tags belong to: `node` or `cell`.
    pub tagged: &'static str,
    /// Tags of the points, shape (n_points).
    pub tags: Vec<i64>,
    /// Positions, shape (n_points), m; z = 0 in the plane.
    pub positions: Vec<[f64; 3]>,
    /// Whether the body is a solid.
    pub in_space: bool,
    /// Volumes, shape (n_points), m^3.
    pub volumes: Vec<f64>,
    /// Horizons, shape (n_points), m.
    pub horizon: Vec<f64>,
    /// Whether the bonds of a point never fail, shape (n_points).
    pub no_fail: Vec<bool>,
    /// Supported and loaded points by the name of their group in the history; empty for runs of earlier versions.
    pub groups: BTreeMap<String, Vec<u32>>,
    /// Bonds and absent bonds.
    pub bonds: StoredBonds,
    /// The failure criteria, in the order of the case.
    pub criteria: Vec<StoredCriterion>,
    /// Whether cells resist strains beside bonds.
    pub has_stiff_cells: bool,
    /// Whether several processes wrote the model.
    pub is_in_pieces: bool,
    /// Largest utilisations of the bonds over the run; none where the run did not end, or several processes ran it.
    pub largest: Option<StoredLargest>,
}

/// The bonds of a model, and the pairs within a horizon without a bond.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredBonds {
    /// Ends, shape (n_bonds).
    pub ends: Vec<[u32; 2]>,
    /// Reason why a pair has no bond, shape (n_bonds).
    pub absence: Vec<Option<Absence>>,
    /// Bond horizons H, shape (n_bonds), m.
    pub horizon: Vec<f64>,
    /// Factor alpha, shape (n_bonds).
    pub length_factor: Vec<f64>,
    /// Factor Omega, shape (n_bonds).
    pub domain_factor: Vec<f64>,
    /// Name of each interface between materials, and whether each bond crosses it, shape (n_bonds).
    pub interfaces: Vec<(String, Vec<bool>)>,
}

/// A failure criterion with its limits.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredCriterion {
    /// Name of the criterion, as in the table of broken bonds.
    pub name: String,
    /// Name of the measure.
    pub measure: String,
    /// Name of the law after the limit.
    pub after: String,
    /// Limits of the measure, shape (n_bonds). For bonds that began to soften by the stress around them, the measure at which they began, if the
    /// run ended.
    pub limit: Vec<f64>,
    /// Limits before bonds began to soften by the stress around them, shape (n_bonds); empty where that changed no limit.
    pub limit_at_start: Vec<f64>,
    /// Coefficients of the measure, each with shape (n_bonds); may be empty.
    pub coefficients: Vec<Vec<f64>>,
    /// Parameter of the law after the limit, shape (n_bonds) or empty.
    pub parameter: Vec<f64>,
}

/// The largest utilisation of each bond over the load steps, or events, in which it was intact.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredLargest {
    /// Largest utilisation, shape (n_bonds).
    pub utilisation: Vec<f64>,
    /// Step of the largest utilisation, shape (n_bonds).
    pub step: Vec<i64>,
    /// Number of its criterion, shape (n_bonds).
    pub criterion: Vec<i64>,
    /// Step in which each bond began to soften by the stress around it, -1 for bonds that did not, shape (n_bonds); empty where no criterion
    /// lets bonds begin.
    pub began_in: Vec<i64>,
}

/// A row of the history.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StoredStep {
    /// Number of the step or event.
    pub step: usize,
    /// Load factor.
    pub load_factor: f64,
    /// Displacement of the first load, m.
    pub displacement: f64,
    /// Force of the first load, N.
    pub reaction: f64,
    /// Whether no bond was left to break in this state.
    pub at_rest: bool,
}

/// A broken bond.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredBreak {
    /// Number in the order of all breakages, from 1.
    pub order: usize,
    /// Round of breakages in the step, from 1.
    pub round: usize,
    /// Step and load at the breakage.
    pub at: StoredStep,
    /// Tags of the two ends of the bond.
    pub tags: [i64; 2],
    /// Name of the criterion by which the bond failed.
    pub criterion: String,
    /// Measure of the deformation over the limit, at the breakage.
    pub utilisation: f64,
    /// Deformation of the bond at the breakage; the relative rotation of its ends, which enters no criterion, is not stored.
    pub deformation: BondDeformation,
}

/// The motions of the points in a step.
#[derive(Debug, Clone, PartialEq)]
pub struct Motions {
    /// Displacements of the points, shape (n_points), m; zero along z in the plane.
    pub displacement: Vec<[f64; 3]>,
    /// Rotations of the points about the axes, shape (n_points), rad; only about z in the plane.
    pub rotation: Vec<[f64; 3]>,
    /// Free thermal strains of the points; empty where the temperature does not change.
    pub thermal_strain: StressFreeStrains,
}

impl StoredRun {
    /// Whether bonds have strains of their own.
    pub fn has_own_strains(&self) -> bool {
        self.deformation_names == ElementKind::Imaginary.strain_names()
    }

    /// Opens the results in a folder.
    ///
    /// # Errors
    ///
    /// If there are no results, a required file was not written, or a file cannot be used.
    pub fn open(folder: &Path) -> Result<Self, Error> {
        require_run(folder)?;
        let model = StoredModel::read(folder)?;
        let broken = CsvTable::read(folder.join("breaks.csv"))?;
        let [pairs, strains] = [ElementKind::Beam, ElementKind::Imaginary]
            .map(|kind| stored_names(kind.strain_names()));
        let has_strains = broken.columns().iter().any(|column| column == strains[0]);
        let deformation_names = if has_strains { strains } else { pairs };
        Ok(Self {
            deformation_names,
            history: CsvTable::read(folder.join("history.csv"))?.rows(StoredStep::from_history)?,
            breaks: broken.rows(|row| StoredBreak::read(row, model.tagged, deformation_names))?,
            softened: softened_pairs(folder, BEGINS)?,
            fields: numbered_files(folder, "fields")?,
            folder: folder.to_path_buf(),
            model,
        })
    }

    /// The steps with fields at their ends, ascending.
    pub fn field_steps(&self) -> impl Iterator<Item = usize> {
        let states = self.fields.keys();
        let ends = states.filter(|it| it.breakages().is_none());
        ends.map(|it| it.step)
    }

    /// The row of the history of a step.
    pub fn step(&self, step: usize) -> Option<&StoredStep> {
        self.history.iter().find(|row| row.step == step)
    }

    /// The motions of the points at the end of a step; `None` where it has no fields.
    ///
    /// # Errors
    ///
    /// If the file cannot be used.
    pub fn motions(&self, step: usize) -> Result<Option<Motions>, Error> {
        let Some(path) = self.fields.get(&StoredState::end(step)) else {
            return Ok(None);
        };
        let file = VtuFile::open(path)?;
        let location = location(&file);
        let displacement = file.finite_numbers(location, DISPLACEMENT.name)?;
        let rotation = file.finite_numbers(location, ROTATION.name)?;
        let rotation: Vec<[f64; 3]> = match self.model.in_space {
            true => rotation.as_chunks().0.to_vec(),
            false => rotation
                .into_iter()
                .map(|about_z| [0.0, 0.0, about_z])
                .collect(),
        };
        let n_points = self.model.positions.len();
        let components = file.component_names(location, THERMAL_STRAIN.name);
        let thermal = match components.is_empty() {
            true => Vec::new(),
            false => file.finite_numbers(location, THERMAL_STRAIN.name)?,
        };
        let displacement: Vec<[f64; 3]> = displacement.as_chunks().0.to_vec();
        if [rotation.len(), displacement.len()] != [n_points; 2] {
            return Err(file.malformed(format!(
                "it does not have the {n_points} points of the model"
            )));
        }
        Ok(Some(Motions {
            displacement,
            rotation,
            thermal_strain: free_strains(&components, &thermal),
        }))
    }
}

/// Free strains of the points from the values of their components in a file, by the names of the components.
fn free_strains(components: &[String], values: &[f64]) -> StressFreeStrains {
    let of_point = |values: &[f64]| {
        let strain = |name: &&str| {
            let place = components.iter().position(|it| it == name);
            place.map_or(0.0, |it| values[it])
        };
        let strains: Vec<f64> = SymTensor::<3>::NAMES.iter().map(strain).collect();
        SymTensor::<3>::from_engineering(&strains)
    };
    StressFreeStrains::new(values.chunks(components.len().max(1)).map(of_point))
}

fn require_run(folder: &Path) -> Result<(), Error> {
    let no_results = |reason: &str| {
        Err(Error::NoResults {
            path: folder.to_path_buf(),
            reason: reason.to_owned(),
        })
    };
    require_results(folder)?;
    if kind_of(folder) == OutputKind::Modes {
        return no_results(
            "it has natural modes, in which no bond breaks; explain needs a static or a fracture analysis",
        );
    }
    if model_file(folder).is_none() {
        let remedy = Remedy::RunAgain {
            key: "output.model",
            value: "true",
        };
        return Err(Error::NoModel(folder.to_path_buf(), remedy));
    }
    if !folder.join("history.csv").is_file() {
        return no_results("it has no history.csv");
    }
    Ok(())
}

impl StoredModel {
    fn read(folder: &Path) -> Result<Self, Error> {
        let file = VtuFile::open(model_file(folder).unwrap_or_else(|| folder.join("model.vtu")))?;
        let numbers = |name| file.finite_numbers(FieldLocation::Point, name);
        let (tagged, tags) = file.tags(FieldLocation::Point)?;
        let no_fail = file.required_integers(FieldLocation::Point, "no_fail")?;
        let bonds = StoredBonds::read(&file)?;
        let positions = file.points()?;
        Ok(Self {
            tagged,
            tags,
            in_space: positions.iter().any(|it| it[2] != 0.0),
            positions,
            volumes: numbers(VOLUME.name)?,
            horizon: numbers(HORIZON.name)?,
            no_fail: no_fail.into_iter().map(|flag| flag != 0).collect(),
            groups: groups(&file)?,
            criteria: criteria(folder, &file, &bonds.absence)?,
            largest: StoredLargest::read(&file, &bonds.absence)?,
            bonds,
            has_stiff_cells: file.field_data()?.iter().any(|it| it.0 == STIFF_CELLS),
            is_in_pieces: file
                .path()
                .extension()
                .is_some_and(|it| it == PIECES_EXTENSION),
        })
    }
}

/// Supported and loaded points by the name of their group.
fn groups(file: &VtuFile) -> Result<BTreeMap<String, Vec<u32>>, Error> {
    let marked = marks(file, FieldLocation::Point, GROUP)?.into_iter();
    let points = |(name, is_in): (String, Vec<bool>)| {
        let points = (0..).zip(is_in).filter(|(_, is_in)| *is_in);
        (name, points.map(|it| it.0).collect())
    };
    Ok(marked.map(points).collect())
}

impl StoredBonds {
    fn read(file: &VtuFile) -> Result<Self, Error> {
        let absent = file.required_integers(FieldLocation::Cell, "absent")?;
        let absence: Vec<Option<Absence>> = absent.into_iter().map(Absence::from_number).collect();
        Ok(Self {
            ends: file.lines()?,
            horizon: file.finite_numbers(FieldLocation::Cell, "horizon")?,
            length_factor: bond_values(file, "length_factor", &absence)?,
            domain_factor: bond_values(file, "domain_factor", &absence)?,
            interfaces: marks(file, FieldLocation::Cell, INTERFACE)?,
            absence,
        })
    }
}

/// Names of the fields of marks with a prefix, without it, and whether each point or cell is marked.
fn marks(
    file: &VtuFile,
    location: FieldLocation,
    prefix: &str,
) -> Result<Vec<(String, Vec<bool>)>, Error> {
    let fields = file.fields(location);
    let named = fields.filter_map(|field| Some((field, field.strip_prefix(prefix)?)));
    let marked = |(field, name): (&str, &str)| {
        let marks = file.required_integers(location, field)?;
        Ok((name.to_owned(), marks.iter().map(|it| *it != 0).collect()))
    };
    named.map(marked).collect()
}

/// Values of a field that all bonds must have; absent bonds have none.
fn bond_values(file: &VtuFile, name: &str, absence: &[Option<Absence>]) -> Result<Vec<f64>, Error> {
    let values = file.required_numbers(FieldLocation::Cell, name)?;
    let mut bonds = values
        .iter()
        .zip(absence)
        .filter(|(_, absence)| absence.is_none());
    match bonds.any(|(value, _)| value.is_nan()) {
        false => Ok(values),
        true => Err(file.malformed(format!("bonds have no {name}"))),
    }
}

fn criteria(
    folder: &Path,
    file: &VtuFile,
    absence: &[Option<Absence>],
) -> Result<Vec<StoredCriterion>, Error> {
    CsvTable::read(folder.join("criteria.csv"))?.rows(|row| {
        let name: String = row.value("criterion")?;
        let field = |what: &str| {
            let name = format!("{what}.{name}");
            let is_there = file.components(FieldLocation::Cell, &name).is_some();
            is_there
                .then(|| bond_values(file, &name, absence))
                .transpose()
        };
        let mut coefficients = Vec::new();
        for what in COEFFICIENTS {
            coefficients.extend(field(what)?);
        }
        Ok(StoredCriterion {
            measure: row.value("measure")?,
            after: row.value("after")?,
            limit: bond_values(file, &format!("limit.{name}"), absence)?,
            coefficients,
            limit_at_start: field("limit_at_start")?.unwrap_or_default(),
            parameter: field("after")?.unwrap_or_default(),
            name,
        })
    })
}

impl StoredLargest {
    fn read(file: &VtuFile, absence: &[Option<Absence>]) -> Result<Option<Self>, Error> {
        let (location, name) = (FieldLocation::Cell, "largest_utilisation");
        if file.components(location, name).is_none() {
            return Ok(None);
        }
        Ok(Some(Self {
            utilisation: bond_values(file, name, absence)?,
            step: file.required_integers(location, "step_of_largest")?,
            criterion: file.required_integers(location, "criterion_of_largest")?,
            began_in: (file.integers(location, "step_of_softening")?).unwrap_or_default(),
        }))
    }
}

impl StoredStep {
    fn from_history(row: Row<'_>) -> Result<Self, Error> {
        let at_rest = row.value::<u8>("at_rest")? != 0;
        Self::read(row, at_rest)
    }

    fn read(row: Row<'_>, at_rest: bool) -> Result<Self, Error> {
        Ok(Self {
            at_rest,
            step: row.value("step")?,
            load_factor: row.number("load_factor")?,
            displacement: row.number("displacement")?,
            reaction: row.number("reaction")?,
        })
    }
}

impl StoredBreak {
    fn read(row: Row<'_>, tagged: &str, names: &[&str]) -> Result<Self, Error> {
        let component = |place: usize| names.get(place).map_or(Ok(0.0), |name| row.number(name));
        Ok(Self {
            order: row.value("order")?,
            round: row.value("round")?,
            at: StoredStep::read(row, false)?,
            tags: [
                row.value(&format!("{tagged}_a"))?,
                row.value(&format!("{tagged}_b"))?,
            ],
            criterion: row.value("criterion")?,
            utilisation: row.number("utilisation")?,
            deformation: BondDeformation::new([component(0)?, component(1)?, component(2)?]),
        })
    }
}
