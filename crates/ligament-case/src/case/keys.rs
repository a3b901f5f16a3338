//! Properties of the keys of a case file, from the schema, which is generated from the documentation and attributes of the structures that
//! read them.

use std::sync::LazyLock;

use ligament::setup::Setup;
use ligament_model::case_type::{is_within, range_in_words};
use serde_json::Value as Json;

use super::document::{Node, Value};
use super::fault::{Fault, KeyFault};
use super::key_path::KeyPath;
use super::schema::schema;
use super::values::{RANGE, UNIT};

static SCHEMA: LazyLock<Json> = LazyLock::new(schema);

/// Unit of the number at a key path, if any: its own unit, or the unit of the enclosing table or list.
pub fn unit_of(key: &KeyPath) -> Option<&'static str> {
    let (mut schema, mut unit) = (&*SCHEMA, None);
    for part in &key.0 {
        schema = schema_below(schema, part)?;
        unit = schema[UNIT].as_str().or(unit);
    }
    unit.filter(|_| schema["type"] != "object")
}

/// Paths of the keys of this name in the sections of a case, with the index 0 for entries of lists: `material.young`, `load.0.force`.
pub(super) fn in_sections(name: &str) -> Vec<String> {
    let sections = SCHEMA["properties"].as_object().into_iter().flatten();
    let has = |(section, schema): (&String, &Json)| {
        let (place, table) = match schema.get("items") {
            Some(entry) => (format!("{section}.0"), entry),
            None => (section.clone(), schema),
        };
        schema_below(table, name)?;
        let is_own = table_of(table)["properties"].get(name).is_some();
        is_own.then(|| format!("{place}.{name}"))
    };
    sections.filter_map(has).collect()
}

/// The schema of the table among a key's alternatives, or the schema itself.
fn table_of(schema: &Json) -> &Json {
    let alternatives = schema["anyOf"]
        .as_array()
        .filter(|_| schema["type"].is_null());
    let table = alternatives.and_then(|all| all.iter().find(|it| it["type"] == "object"));
    table.unwrap_or(schema)
}

/// The schema of a key or an element within a schema; elements without a schema have the schema of their list.
fn schema_below<'a>(schema: &'a Json, part: &str) -> Option<&'a Json> {
    if part.parse::<usize>().is_ok() {
        return Some(schema.get("items").unwrap_or(schema));
    }
    let table = table_of(schema);
    let names = || {
        table
            .get("additionalProperties")
            .filter(|it| it.is_object())
    };
    table["properties"].get(part).or_else(names)
}

/// Check of a value with its schema and key.
type Check<'a> = &'a dyn Fn(&Node, &Json, &KeyPath) -> Result<(), KeyFault>;

/// Refuses a document with a number out of the range of its key.
pub(super) fn check_ranges(document: &Node) -> Result<(), KeyFault> {
    check_below(document, &SCHEMA, &KeyPath::default(), &in_range)
}

/// The setup of a document, unless its body does not have the coordinates, vectors or couples of the document.
pub(crate) fn check_dimensions(document: &Node, setup: Setup) -> Result<Setup, KeyFault> {
    let dimensions = setup.body.dimensions();
    let check: Check = &|node, schema, key| in_dimensions(node, schema, key, dimensions);
    check_below(document, &SCHEMA, &KeyPath::default(), check)?;
    Ok(setup)
}

/// Checks a value and the values below it. Sections check numbers in lists.
fn check_below(node: &Node, schema: &Json, key: &KeyPath, check: Check) -> Result<(), KeyFault> {
    check(node, schema, key)?;
    let child = |node: &Node, part: &str| match schema_below(schema, part) {
        Some(schema) => check_below(node, schema, &key.child(part), check),
        None => Ok(()),
    };
    match &node.value {
        Value::Table(entries) => {
            let mut entries = entries.iter();
            entries.try_for_each(|entry| child(&entry.node, &entry.key))
        }
        Value::List(nodes) => {
            let mut nodes = nodes.iter().enumerate();
            nodes.try_for_each(|(place, node)| match node.number() {
                Some(_) => Ok(()),
                None => child(node, &place.to_string()),
            })
        }
        _ => Ok(()),
    }
}

fn in_range(node: &Node, schema: &Json, key: &KeyPath) -> Result<(), KeyFault> {
    let Some(number) = node.number().filter(|it| it.is_finite()) else {
        return Ok(());
    };
    match range_of(schema) {
        Some(expected) if !is_within(number, bounds(schema)) => {
            let found = match node.value {
                Value::Integer(number) if schema["type"] == "integer" => number.to_string(),
                _ => format!("{number:?}"),
            };
            let fault = Fault::out_of_range(expected, found);
            Err(KeyFault::new(key.clone(), fault))
        }
        _ => Ok(()),
    }
}

fn in_dimensions(
    node: &Node,
    schema: &Json,
    key: &KeyPath,
    dimensions: usize,
) -> Result<(), KeyFault> {
    let is_coordinates = schema["minItems"] == 2 && schema["maxItems"] == 3;
    let table = table_of(schema);
    let components = table["properties"].as_object();
    let is_vector = components.is_some_and(|it| it.keys().eq(["x", "y", "z"]));
    let is_couple = is_vector && table != schema;
    let refuse = |reason: &str| Err(KeyFault::new(key.clone(), reason));
    match (&node.value, dimensions) {
        (Value::List(found), _) if is_coordinates && found.len() != dimensions => {
            let body = match dimensions {
                2 => "a body in the plane takes two coordinates, [x, y]",
                _ => "a solid takes three coordinates, [x, y, z]",
            };
            let found: Vec<f64> = found.iter().filter_map(Node::number).collect();
            refuse(&format!("{body}, found {found:?}"))
        }
        (Value::Integer(_) | Value::Float(_), 3) if is_couple => {
            refuse("a couple in a solid turns about an axis: give a vector, { z = 1.0 }")
        }
        (Value::Table(_), 2) if is_couple => {
            refuse("a couple in the plane turns about z: give a number")
        }
        (Value::Table(_), 2) if is_vector && node.get("z").is_some() => {
            let reason = "a body in the plane has no z";
            Err(KeyFault::new(key.child("z"), reason))
        }
        _ => Ok(()),
    }
}

/// The bounds of a key's number.
fn bounds(schema: &Json) -> impl Fn(&str) -> Option<f64> {
    |keyword| schema[keyword].as_f64()
}

/// Description of a key's range, "greater than 0"; `None` for an arbitrary number or a count from 0.
fn range_of(schema: &Json) -> Option<String> {
    let words = schema[RANGE].as_str().map(str::to_owned);
    words.or_else(|| range_in_words(bounds(schema)))
}

/// The rows of a Markdown table of the keys at a path and in tables below it: description, range and default.
pub fn rows(path: &str) -> Vec<String> {
    let key = KeyPath::parse(path).unwrap_or_default();
    let schema = (key.0.iter()).try_fold(&*SCHEMA, |schema, part| schema_below(schema, part));
    let mut found = Vec::new();
    if let Some(schema) = schema {
        add_rows(schema, path, &mut found);
    }
    found
}

fn add_rows(schema: &Json, path: &str, found: &mut Vec<String>) {
    let table = table_of(schema);
    let items = table
        .get("items")
        .filter(|it| table_of(it)["type"] == "object");
    if let Some(items) = items {
        return add_rows(items, path, found);
    }
    for (name, schema) in table["properties"].as_object().into_iter().flatten() {
        let path = format!("{path}.{name}");
        found.push(row(schema, &path));
        add_rows(schema, &path, found);
    }
    // Tables with the keys of the enclosing one contribute only their further keys.
    let mut named = table["additionalProperties"].clone();
    if let Some(Json::Object(keys)) = named.get_mut("properties") {
        keys.retain(|key, _| table["properties"].get(key).is_none());
        add_rows(&named, &format!("{path}.NAME"), found);
    }
}

fn row(schema: &Json, path: &str) -> String {
    let description = schema["description"].as_str().unwrap_or_default();
    let mut text = description
        .replace("\n\n", "\n")
        .replace("\n- ", " ")
        .replace('\n', " ");
    if let Some(range) = range_of(schema) {
        text += &format!(" Must be {range}.");
    }
    if let Some(default) = schema.get("default").filter(|it| !it.is_object()) {
        text += &format!(" Default {}.", default.to_string().replace('"', "`"));
    }
    format!("| `{path}` | {} |", text.replace('|', "\\|"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn unit(key: &str) -> Option<&'static str> {
        KeyPath::parse(key).and_then(|key| unit_of(&key))
    }

    /// Descriptions that do not name the unit of their key.
    fn without_unit(schema: &Json) -> Vec<&Json> {
        let parts = schema.as_object().into_iter().flat_map(|it| it.values());
        let parts = parts.chain(schema.as_array().into_iter().flatten());
        let below = parts.flat_map(without_unit);
        let unit = schema[UNIT].as_str().map(|it| format!(", {it}"));
        let description = schema["description"].as_str().unwrap_or_default();
        let is_named = unit.is_none_or(|it| description.contains(&it));
        below.chain((!is_named).then_some(schema)).collect()
    }

    #[test]
    fn descriptions_name_the_units_of_their_keys() {
        assert_eq!(without_unit(&SCHEMA), Vec::<&Json>::new());
    }

    #[test]
    fn keys_of_tables_and_lists_have_the_unit_of_these() {
        for (key, expected) in [
            ("material.young", "Pa"),
            ("material.steel.density", "kg/m^3"),
            ("material.thermal_expansion_3", "1/K"),
            ("material.fracture_energy", "J/m^2"),
            ("precrack.0.points.1.0", "m"),
            ("precrack.0.angle", "rad"),
            ("lattice.remove.0.circle.radius", "m"),
            ("lattice.set.top.circle.centre", "m"),
            ("lattice.spacing.0", "m"),
            ("load.0.force.x", "N"),
            ("load.0.force_per_length.y", "N/m"),
            ("load.0.force_per_area.y", "N/m^2"),
            ("load.1.body_force.y", "N/m^3"),
            ("load.1.acceleration.x", "m/s^2"),
            ("load.0.displacement.rotation", "rad"),
            ("load.0.displacement.x", "m"),
            ("load.0.moment", "N m"),
            ("load.0.body_couple", "N m/m^3"),
            ("load.0.profile.zero", "m"),
            ("temperature.0.change", "K"),
            ("fracture.stop.displacement", "m"),
            ("fracture.stop.wall_time", "s"),
        ] {
            assert_eq!(unit(key), Some(expected), "{key}");
        }
        for key in [
            "title",
            "model.law",
            "material.poisson",
            "load.0.force",
            "no.such.key",
        ] {
            assert_eq!(unit(key), None, "{key}");
        }
    }
}
