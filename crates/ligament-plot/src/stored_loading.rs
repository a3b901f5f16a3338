//! Loading of a stored run, from the case beside its results.

use std::collections::BTreeMap;
use std::path::Path;

use ligament_output::folder::RESOLVED_CASE;
use ligament_output::results::columns::{self, unit_of_probe};
use ligament_output::{Error, read_text};

use ligament::units::Units;

/// Loading of a stored run.
#[derive(Debug, Clone)]
pub struct StoredLoading {
    /// Whether the rows of the history are events, each just before its bonds break.
    pub follows_path: bool,
    /// Whether the run is a motion in time, whose load factor is the time in s.
    pub in_time: bool,
    /// Whether the strains of bonds are taken over the distances after the deformation.
    pub has_true_strains: bool,
    /// Units of the first load.
    pub units: Units,
    /// Units of the probes by their names.
    pub probes: BTreeMap<String, &'static str>,
}

impl StoredLoading {
    /// SI unit of a column of the history of the run; `-` for a number without a unit.
    pub fn unit_of(&self, column: &str) -> &'static str {
        match column {
            "displacement" => self.units.displacement,
            "reaction" => self.units.force,
            "load_factor" if self.in_time => "s",
            name => (self.probes.get(name).copied()).unwrap_or_else(|| columns::unit_of(name)),
        }
    }
}

/// The loading, from the resolved case beside the results.
///
/// # Errors
///
/// If the case cannot be read.
pub fn stored_loading(folder: &Path) -> Result<StoredLoading, Error> {
    let case = resolved_case(folder)?;
    let control = case.get("fracture").and_then(|it| it.get("control"));
    let first = case.get("load").and_then(|loads| loads.get(0));
    let given = |key: &str| first.and_then(|load| load.get(key));
    let moves = |motion: &toml::Value| ["x", "y", "z"].iter().any(|it| motion.get(it).is_some());
    let motion = given("displacement").or(given("velocity"));
    let motion = motion.or(given("base_acceleration"));
    let turns = motion.is_some_and(|motion| !moves(motion));
    let in_time = case.contains_key("motion");
    let is_heated = case.contains_key("temperature");
    let strains = case.get("model").and_then(|it| it.get("strains"));
    let units = if first.is_none() && (in_time || !is_heated) {
        Units::FORCE
    } else if first.is_none() {
        Units::TEMPERATURE
    } else if given("pressure").is_some() {
        Units::PRESSURE
    } else if turns || given("moment").or(given("body_couple")).is_some() {
        Units::COUPLE
    } else {
        Units::FORCE
    };
    Ok(StoredLoading {
        in_time,
        follows_path: control.and_then(toml::Value::as_str) == Some("event"),
        has_true_strains: strains.and_then(toml::Value::as_str) == Some("true"),
        units,
        probes: probes(&case),
    })
}

/// Units of the probes of a case.
fn probes(case: &toml::Table) -> BTreeMap<String, &'static str> {
    let all = case.get("probe").and_then(toml::Value::as_array);
    let unit = |probe: &toml::Value| {
        let word = |key: &str| probe.get(key).and_then(toml::Value::as_str);
        let component = word("component").unwrap_or_default();
        let is_force = ["section", "group"]
            .iter()
            .any(|key| probe.get(key).is_some());
        let read = word("field").or(word("quantity"));
        let unit = unit_of_probe(read, component, is_force);
        Some((word("name")?.to_owned(), unit))
    };
    all.into_iter().flatten().filter_map(unit).collect()
}

/// The resolved case beside results.
pub fn resolved_case(folder: &Path) -> Result<toml::Table, Error> {
    let path = folder.join(RESOLVED_CASE);
    read_text(&path)?
        .parse()
        .map_err(|error: toml::de::Error| Error::Unreadable {
            path,
            // The message leaves out the line of the case, because a link may lead to any file.
            reason: error.message().trim().to_owned(),
        })
}
