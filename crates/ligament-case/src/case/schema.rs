//! The JSON schema of a case file, for editors, generated from the structures that read it.

use schemars::Schema;
use schemars::generate::SchemaSettings;
use schemars::transform::{Transform, transform_subschemas};
use serde_json::{Map, Value, json};

use super::sections::Case;
use super::values::UNIT;

/// The JSON schema of a case file.
///
/// The schema is of draft 7, the newest that the language server taplo (Even Better TOML) checks, and without references, at which taplo
/// loses adjacent descriptions.
pub fn schema() -> Value {
    let settings = SchemaSettings::draft07().with(|it| it.inline_subschemas = true);
    let mut schema = settings
        .with_transform(TomlAdaptation)
        .into_generator()
        .into_root_schema_for::<Case>();
    schema.insert("title".to_owned(), "Case file of Ligament".into());
    // Tombi reads the version of TOML here.
    schema.insert("x-tombi-toml-version".to_owned(), "v1.0.0".into());
    schema.to_value()
}

/// Adaptation of the schema to TOML: TOML has no null, and formats of numbers are of no use to editors. Words become one `enum`, because
/// editors offer a key once for each alternative of a `oneOf`; their meanings go to the description, and to the key that taplo shows beside
/// the word.
#[derive(Debug, Clone)]
struct TomlAdaptation;

impl Transform for TomlAdaptation {
    fn transform(&mut self, schema: &mut Schema) {
        transform_subschemas(self, schema);
        schema.remove("format");
        without_null(schema);
        words(schema);
        describe_words(schema);
        titles(schema);
    }
}

/// Units of numbers, which the descriptions of keys name.
const UNITS: [&str; 20] = [
    "m", "rad", "s", "kg", "K", "N", "Pa", "Hz", "1/s", "1/K", "m/s", "m/s^2", "N m", "N/m",
    "N/m^2", "N/m^3", "N m/m^3", "J/m^2", "kg/m^3", "kg m^2",
];

/// The unit that a description names before its words, "The velocity, m/s.": after the first comma with a unit behind it.
fn unit_in(description: &str) -> Option<&'static str> {
    let sentence = description.lines().next()?;
    let mut places = sentence.match_indices(", ");
    places.find_map(|(place, comma)| {
        let rest = &sentence[place + comma.len()..];
        UNITS.into_iter().find(|unit| {
            let behind = rest.strip_prefix(unit);
            behind.is_some_and(|it| it.starts_with(['.', ',', ';', ':']))
        })
    })
}

/// Whether a key of a table has a unit of its own.
fn has_units(table: &Map<String, Value>) -> bool {
    let keys = table.get("properties").and_then(Value::as_object);
    keys.is_some_and(|keys| keys.values().any(|key| key.get(UNIT).is_some()))
}

/// Units of the keys of a table, and their titles: the key in words with its unit, `tensile strength (Pa)`.
fn titles(schema: &mut Schema) {
    let Some(Value::Object(keys)) = schema.get_mut("properties") else {
        return;
    };
    for (key, of_key) in keys {
        let Value::Object(of_key) = of_key else {
            continue;
        };
        let description = of_key.get("description").and_then(Value::as_str);
        let unit = description.and_then(unit_in).filter(|_| !has_units(of_key));
        if let Some(unit) = unit {
            of_key.insert(UNIT.to_owned(), unit.into());
        }
        let unit = unit.map(|unit| format!(" ({unit})")).unwrap_or_default();
        let title = format!("{}{unit}", key.replace('_', " "));
        of_key.entry("title").or_insert_with(|| title.into());
    }
}

fn without_null(schema: &mut Schema) {
    let is_null = |value: &Value| value == &json!({ "type": "null" });
    // The default of a table follows from its keys.
    if (schema.get("default")).is_some_and(|it| it.is_null() || it.is_object()) {
        schema.remove("default");
    }
    if let Some(Value::Array(types)) = schema.get_mut("type") {
        types.retain(|it| it != "null");
        if let [only] = types.as_slice() {
            let only = only.clone();
            schema.insert("type".to_owned(), only);
        }
    }
    if let Some(Value::Array(values)) = schema.get_mut("enum") {
        values.retain(|it| !it.is_null());
    }
    let Some(Value::Array(alternatives)) = schema.get_mut("anyOf") else {
        return;
    };
    let count = alternatives.len();
    alternatives.retain(|it| !is_null(it));
    if alternatives.len() < count
        && let [Value::Object(only)] = alternatives.as_slice()
    {
        let only = only.clone();
        schema.remove("anyOf");
        for (key, value) in only {
            // The description of the key takes precedence over that of its type.
            if key != "description" || schema.get(&key).is_none() {
                schema.insert(key, value);
            }
        }
    }
}

/// Converts the alternatives of an enumeration, one word each, to a list of words.
fn words(schema: &mut Schema) {
    let Some(Value::Array(alternatives)) = schema.get("oneOf") else {
        return;
    };
    let word = |it: &Value| Some((it.get("const")?.clone(), it.get("description").cloned()));
    let Some(words) = alternatives.iter().map(word).collect::<Option<Vec<_>>>() else {
        return;
    };
    let (values, docs): (Vec<_>, Vec<_>) = words.into_iter().unzip();
    schema.remove("oneOf");
    schema.insert("type".to_owned(), "string".into());
    schema.insert("enum".to_owned(), Value::Array(values));
    schema.insert(
        "x-taplo".to_owned(),
        json!({ "docs": { "enumValues": docs } }),
    );
}

/// Appends the meanings of the words to the description, once: of the schema or of one of its alternatives.
fn describe_words(schema: &mut Schema) {
    let with_words = |it: &Value| {
        let docs = it.pointer("/x-taplo/docs/enumValues")?.as_array()?.clone();
        Some((it.get("enum")?.as_array()?.clone(), docs))
    };
    let alternatives = schema.get("anyOf").and_then(Value::as_array);
    let of_alternatives = || alternatives?.iter().find_map(with_words);
    let Some((words, docs)) = with_words(schema.as_value()).or_else(of_alternatives) else {
        return;
    };
    let lines = words.iter().zip(&docs).map(|(word, doc)| {
        let (word, doc) = (
            word.as_str().unwrap_or_default(),
            doc.as_str().unwrap_or_default(),
        );
        format!("\n- `{word}`: {doc}")
    });
    let list: String = lines.collect();
    let description = schema
        .get("description")
        .and_then(Value::as_str)
        .unwrap_or_default();
    if !description.ends_with(&list) {
        let description = format!("{description}\n{list}");
        schema.insert("description".to_owned(), description.into());
    }
}
