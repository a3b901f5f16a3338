//! The columns that curves show: of the history, or of the growth and the tips of cracks beside it.

use std::path::Path;

use ligament_output::csv::read::CsvTable;
use ligament_output::results::StoredState;
use ligament_output::results::columns::{HISTORY, TIME, is_in_time, unit_of, unit_of_crack};
use ligament_output::results::steps::{StepChoice, StepName};

use super::PictureError;
use crate::stored_loading::{StoredLoading, stored_loading};
use ligament::suggestion::hint;

/// Names that select all energies and all probes, unless a column has this name.
const ENERGIES: &str = "energies";
const PROBES: &str = "probes";

/// Share of the largest energy below which another energy cannot be seen beside it.
const VISIBLE_SHARE: f64 = 1e-3;

/// Columns of [`ENERGIES`], in the order of the ledger.
const ENERGY_COLUMNS: [&str; 9] = [
    "external_work",
    "kinetic_energy",
    "stored_energy",
    "released_energy",
    "damping_energy",
    "contact_energy",
    "friction_energy",
    "initial_energy",
    "dissipated_energy",
];

/// Files with columns over the records of a run; only the first always exists.
const TABLES: [&str; 3] = ["history.csv", "crack_growth.csv", "crack_tips.csv"];

/// The tables of a run whose columns are drawn.
pub(super) struct Tables<'a> {
    folder: &'a Path,
    history: CsvTable,
    loading: Option<StoredLoading>,
}

/// A curve in SI units.
pub(super) struct Curve {
    /// Name of the column along y.
    pub(super) name: String,
    pub(super) points: Vec<[f64; 2]>,
    pub(super) units: [String; 2],
    /// Whether each point is in equilibrium with its load; at other points bonds were still failing.
    pub(super) at_rest: Vec<bool>,
    /// Whether the points do not form a line, such as the tips of several cracks.
    pub(super) is_scattered: bool,
    /// Description and point of the first breakage or softening.
    pub(super) first: Option<(&'static str, [f64; 2])>,
}

impl<'a> Tables<'a> {
    /// The tables in a folder.
    pub(super) fn open(folder: &'a Path) -> Result<Self, PictureError> {
        let history = CsvTable::read(folder.join(TABLES[0]))?;
        // A table that is not the history of a run is refused.
        history.values::<usize>("step")?;
        let loading = stored_loading(folder).ok();
        Ok(Self {
            folder,
            history,
            loading,
        })
    }

    /// The column along x where none is named: the time of a motion, else the displacement.
    pub(super) fn usual_x(&self) -> &'static str {
        match is_in_time(self.history.columns()) {
            true => TIME,
            false => "displacement",
        }
    }

    /// The columns that names select: single ones, all energies that can be seen beside the largest, or all probes.
    pub(super) fn selected_columns(&self, names: &[String]) -> Result<Vec<String>, PictureError> {
        let has = |name: &str| self.history.columns().iter().any(|it| it == name);
        let mut selected = Vec::new();
        for name in names {
            match name.as_str() {
                ENERGIES if !has(ENERGIES) => {
                    let mut sizes = Vec::new();
                    for name in ENERGY_COLUMNS.into_iter().filter(|it| has(it)) {
                        let values = self.history.values::<f64>(name)?.into_iter();
                        sizes.push((name, values.fold(0.0, |most, it| it.abs().max(most))));
                    }
                    let largest = sizes.iter().fold(0.0, |most, it| it.1.max(most));
                    let seen = sizes.iter().filter(|it| it.1 > VISIBLE_SHARE * largest);
                    selected.extend(seen.map(|it| it.0.to_owned()));
                }
                PROBES if !has(PROBES) => {
                    let probes = self.loading.iter().flat_map(|it| it.probes.keys());
                    selected.extend(probes.filter(|it| has(it)).cloned());
                }
                name => selected.push(name.to_owned()),
            }
        }
        match selected.is_empty() {
            true => Err(self.unknown(&names.join(", "), &self.history)),
            false => Ok(selected),
        }
    }

    /// The curve of a column over another one of the same table.
    pub(super) fn curve(&self, x: &str, y: &str) -> Result<Curve, PictureError> {
        let beside = || -> Result<Option<(usize, CsvTable)>, PictureError> {
            for (place, file) in TABLES.iter().enumerate().skip(1) {
                let path = self.folder.join(file);
                if path.is_file() {
                    let sheet = CsvTable::read(path)?;
                    if sheet.columns().iter().any(|it| it == y) {
                        return Ok(Some((place, sheet)));
                    }
                }
            }
            Ok(None)
        };
        let is_of_history = self.history.columns().iter().any(|it| it == y);
        let other = if is_of_history { None } else { beside()? };
        let (place, sheet) = other
            .as_ref()
            .map_or((0, &self.history), |it| (it.0, &it.1));
        let numbers = |name: &str| {
            if sheet.columns().iter().any(|it| it == name) {
                let texts = sheet.texts(name).into_iter().flatten();
                // An unknown value of a row is empty.
                let known = texts.map(|it| {
                    if it.is_empty() {
                        Ok(f64::NAN)
                    } else {
                        it.parse()
                    }
                });
                return known
                    .collect::<Result<Vec<f64>, _>>()
                    .or_else(|_| Ok(sheet.values::<f64>(name)?));
            }
            Err(self.unknown(name, sheet))
        };
        let (of_x, of_y) = (numbers(x)?, numbers(y)?);
        let points: Vec<[f64; 2]> = of_x.into_iter().zip(of_y).map(|(x, y)| [x, y]).collect();
        let steps = sheet.values::<usize>("step")?;
        Ok(Curve {
            name: name_in_words(y, ""),
            at_rest: at_rest(sheet, points.len())?,
            is_scattered: place == 2,
            first: first_failure(self.folder, &steps, &points).filter(|_| place < 2),
            points,
            units: [x, y].map(|it| self.unit_of(it, place).to_owned()),
        })
    }

    fn unit_of(&self, column: &str, table: usize) -> &'static str {
        let of_crack = unit_of_crack(TABLES[table], column);
        let of_history = || match &self.loading {
            Some(loading) => loading.unit_of(column),
            None => unit_of(column),
        };
        // The units of the load follow from the case.
        let of_load = ["displacement", "reaction"].contains(&column);
        of_crack.filter(|_| !of_load).unwrap_or_else(of_history)
    }

    fn unknown(&self, name: &str, sheet: &CsvTable) -> PictureError {
        let nearest = hint(name, sheet.columns(), "columns", '`');
        let all = sheet.columns().join(", ");
        let mut beside = TABLES[1..].iter();
        let of_cracks = beside.any(|it| unit_of_crack(it, name).is_some())
            && !HISTORY.iter().any(|it| it.0.name == name);
        PictureError::UnknownColumn {
            path: sheet.path().to_path_buf(),
            name: name.to_owned(),
            hint: match nearest {
                _ if of_cracks => "; `ligament crack` writes it beside the history".to_owned(),
                nearest if nearest.contains("columns: ") => nearest,
                nearest => format!("{nearest}; columns: {all}"),
            },
        }
    }
}

/// Name of a column in words.
pub(super) fn name_in_words(column: &str, unit: &str) -> String {
    match (column, unit) {
        // A temperature alone is a load whose size is its change.
        ("displacement", "K") => "temperature change".to_owned(),
        ("reaction", "J/K") => "work of the thermal forces per kelvin".to_owned(),
        _ => column.replace(['_', '.'], " "),
    }
}

/// Common name of several columns with one unit.
pub(super) fn common_name(unit: &str) -> &'static str {
    match unit {
        "J" => "energy",
        "m" => "displacement",
        "m/s" => "velocity",
        "m/s^2" => "acceleration",
        "N" => "force",
        "Pa" => "stress",
        _ => "value",
    }
}

/// Whether each row is in equilibrium with its load; all are in tables without this column.
fn at_rest(sheet: &CsvTable, n_rows: usize) -> Result<Vec<bool>, PictureError> {
    if !sheet.columns().iter().any(|name| name == "at_rest") {
        return Ok(vec![true; n_rows]);
    }
    let flags = sheet.values::<u8>("at_rest")?;
    Ok(flags.into_iter().map(|flag| flag != 0).collect())
}

/// Description and point of the first breakage or softening.
fn first_failure(
    folder: &Path,
    steps: &[usize],
    points: &[[f64; 2]],
) -> Option<(&'static str, [f64; 2])> {
    let choice = StepChoice::One(StepName::First);
    let stored: Vec<StoredState> = steps.iter().copied().map(StoredState::end).collect();
    let (what, step) = choice.steps(folder, &stored).ok()?.first()?.happened?;
    let row = steps.iter().position(|it| *it == step)?;
    Some((what, points[row])).filter(|it| it.1[1].is_finite())
}
