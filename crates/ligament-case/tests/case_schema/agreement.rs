//! Keys, defaults and faults: the schema against the reader.

use std::collections::BTreeSet;

use ligament_case::case::Fault;
use serde_json::{Value, json};

use super::documents::{all_of_schema, documents, tables};
use super::{SCHEMA, document, fault, objection, read};

#[test]
fn the_documents_are_right() {
    for document in documents() {
        assert_eq!(fault(&document), None);
        assert_eq!(objection(&document), None);
    }
}

#[test]
fn the_schema_is_of_a_draft_that_editors_know() {
    assert_eq!(SCHEMA["$schema"], "http://json-schema.org/draft-07/schema#");
    let text = SCHEMA.to_string();
    for gone in ["\"$ref\"", "\"null\"", "\"format\"", "\"const\":\"nhpd\""] {
        assert!(!text.contains(gone), "{gone}");
    }
}

/// In every table a key that it does not have is refused by both, and the keys that the reader then names are those of the
/// schema. The documents have all tables of the schema, so that this is asked of each.
#[test]
fn every_table_has_the_same_keys() {
    let mut asked = BTreeSet::new();
    for document in documents() {
        for (path, schema) in tables(&document) {
            let mut wrong = document.clone();
            let table = wrong.pointer_mut(&path.pointer).unwrap();
            // A name that the user chooses: a factor belongs there.
            let is_factor =
                ["/stage/*/loads", "/stage/*/control/probes"].contains(&path.pattern.as_str());
            table["unheard"] = if is_factor { json!({}) } else { json!(1) };
            assert!(objection(&wrong).is_some(), "{}", path.pointer);
            let refused = fault(&wrong);
            asked.insert(path.pattern.clone());
            // A name that the user chooses: a table belongs there.
            if ["/lattice/set", "/solid_lattice/set"].contains(&path.pattern.as_str())
                || is_factor
                || (path.pattern == "/material" && table_of_tables(&document))
            {
                assert!(refused.is_some(), "{}", path.pointer);
                continue;
            }
            let Some((_, Fault::UnknownKey { valid, .. })) = refused else {
                panic!("{}: {refused:?}", path.pointer);
            };
            let valid: BTreeSet<String> = valid.into_iter().collect();
            let table = document.pointer(&path.pointer).unwrap();
            assert_eq!(
                keys(&schema, table, &path.pattern),
                valid,
                "{}",
                path.pointer
            );
        }
    }
    assert_eq!(asked, all_of_schema().0);
}

fn table_of_tables(document: &Value) -> bool {
    let mut materials = document["material"].as_object().unwrap().values();
    materials.all(Value::is_object)
}

/// The keys that the schema gives a table; of a material those of its kind.
fn keys(schema: &Value, table: &Value, pattern: &str) -> BTreeSet<String> {
    if !pattern.starts_with("/material") {
        return schema["properties"]
            .as_object()
            .unwrap()
            .keys()
            .cloned()
            .collect();
    }
    let kinds = if pattern == "/material" {
        &schema["then"]
    } else {
        schema
    };
    let kind = match (table.get("c11"), table.get("young_1")) {
        (Some(_), _) => &kinds["then"],
        (None, Some(_)) => &kinds["else"]["then"],
        (None, None) => &kinds["else"]["else"],
    };
    let all = schema["properties"].as_object().unwrap().keys();
    let has = |key: &&String| kind["properties"].get(*key).is_none();
    let mut names: BTreeSet<String> = all.filter(has).cloned().collect();
    // The reader says of a `group` that the one material needs none.
    names.insert("group".to_owned());
    names
}

/// A default that the schema tells is the reader's: given or not, the case is the same. Each is tried in a document in which its
/// key applies.
#[test]
fn defaults_are_those_of_the_reader() {
    let mut tried = BTreeSet::new();
    for document in documents() {
        let as_it_is = read(&document).unwrap().case;
        for (path, schema) in tables(&document) {
            for (key, value) in schema["properties"].as_object().into_iter().flatten() {
                let Some(default) = value.get("default") else {
                    continue;
                };
                if document.pointer(&path.pointer).unwrap().get(key).is_some() {
                    continue;
                }
                // Beside tables of materials no key of one may stand, however it is valued.
                if path.pattern == "/material" && table_of_tables(&document) {
                    continue;
                }
                let mut with_default = document.clone();
                with_default.pointer_mut(&path.pointer).unwrap()[key] = default.clone();
                let given = match read(&with_default) {
                    Ok(given) => given.case,
                    Err(error) => {
                        let text = error.to_string();
                        assert!(
                            text.contains("does not apply") || text.contains("unknown key"),
                            "{text}"
                        );
                        continue;
                    }
                };
                // The reader keeps whether a thickness was given: a body in plane stress without one has a warning.
                if key != "thickness" {
                    assert_eq!(given, as_it_is, "{}/{key}", path.pointer);
                }
                tried.insert((path.pattern.clone(), key.clone()));
            }
        }
    }
    let all = all_of_schema().1.into_iter();
    let all = all.filter(|(.., schema)| schema.get("default").is_some());
    let all: BTreeSet<_> = all.map(|(table, key, _)| (table, key)).collect();
    let missing: Vec<_> = all.difference(&tried).collect();
    assert!(missing.is_empty(), "{missing:?}");
}

/// Every key says what it is, and words say what each of them means.
#[test]
fn every_key_is_described() {
    for (table, key, schema) in all_of_schema().1 {
        let description = schema["description"].as_str().unwrap_or_default();
        assert!(
            description.len() > 5 && description.contains('.'),
            "{table}/{key}: {description}"
        );
        if let Some(words) = schema["enum"].as_array() {
            let docs = schema["x-taplo"]["docs"]["enumValues"].as_array().unwrap();
            assert_eq!(docs.len(), words.len(), "{table}/{key}");
            for (word, doc) in words.iter().zip(docs) {
                let line = format!("- `{}`: {}", word.as_str().unwrap(), doc.as_str().unwrap());
                assert!(description.contains(&line), "{table}/{key}: {line}");
            }
        }
    }
}

const SMALL: &str = r#"
lattice = { cells = [10, 20], spacing = 0.1 }
model = { law = "nhpd", horizon_factor = 3 }
material = { young = 1e9, poisson = 0.2 }
load = [{ at = [0, 0], force = { x = 1 } }]
"#;

/// Values of the wrong type, words that do not exist, numbers out of range, keys that exclude each other.
#[test]
fn what_is_wrong_is_refused_by_both() {
    let small = document(SMALL);
    assert_eq!((fault(&small), objection(&small)), (None, None));
    for (pointer, value) in [
        ("/title", json!(1)),
        ("/analysis", json!("dynamic")),
        ("/lattice/cells", json!([10])),
        ("/lattice/cells", json!([10.5, 20])),
        ("/lattice/cells", json!([0, 20])),
        ("/lattice/spacing", json!(0)),
        ("/lattice/spacing", json!("1 mm")),
        ("/lattice/spacing", json!([0.1])),
        ("/lattice/thickness", json!(-1)),
        ("/lattice/plane", json!("flat")),
        ("/lattice/corner", json!([0, 0, 0])),
        ("/lattice/set", json!({ "a": {} })),
        ("/lattice/set", json!({ "a": { "bottom": 1, "top": 1 } })),
        (
            "/lattice/set",
            json!({ "a": { "circle": { "centre": [0, 0] } } }),
        ),
        ("/lattice/remove", json!([{ "polygon": [[0, 0], [1, 1]] }])),
        ("/mesh", json!({ "file": "disk.msh" })),
        ("/material", json!({})),
        ("/material", json!({ "young": 1e9 })),
        ("/material", json!({ "young": 1e9, "poisson": 0.5 })),
        ("/material", json!({ "young": "15e9", "poisson": 0.2 })),
        (
            "/material",
            json!({ "young": 1e9, "poisson": 0.2, "group": "a" }),
        ),
        (
            "/material",
            json!({ "young": 1e9, "poisson": 0.2, "c11": 1 }),
        ),
        (
            "/material",
            json!({ "young": 1e9, "poisson": 0.2, "young_3": 1 }),
        ),
        (
            "/material",
            json!({ "young_1": 1e9, "young_2": 1e9, "poisson_12": 0.2 }),
        ),
        (
            "/material",
            json!({ "a": { "young": 1e9, "poisson": 0.2 } }),
        ),
        ("/material", json!({ "a": { "group": "a", "young": 1e9 } })),
        (
            "/material",
            json!({ "young": 1e9, "a": { "group": "a", "young": 1e9, "poisson": 0.2 } }),
        ),
        ("/model", json!({ "law": "nhpd" })),
        ("/model", json!({ "horizon_factor": 3 })),
        (
            "/model",
            json!({ "law": "nhpd", "horizon": 1, "horizon_factor": 3 }),
        ),
        ("/model", json!({ "law": "NHPD", "horizon_factor": 3 })),
        ("/model", json!({ "law": "nhpd", "horizon_factor": 0.9 })),
        ("/correction", json!({ "alpha": true })),
        ("/correction", json!({ "tolerance": 0 })),
        ("/precrack", json!({ "points": [[0, 0], [1, 0]] })),
        ("/precrack", json!([{ "points": [[0, 0]] }])),
        ("/precrack", json!([{ "centre": [0, 0], "length": 1 }])),
        (
            "/precrack",
            json!([{ "centre": [0, 0], "length": 0, "angle": 0 }]),
        ),
        (
            "/precrack",
            json!([{ "points": [[0, 0], [1, 0]], "angle": 0 }]),
        ),
        ("/support", json!([{ "group": "a", "displacement": {} }])),
        (
            "/support",
            json!([{ "group": "a", "at": [0, 0], "displacement": { "x": 0 } }]),
        ),
        ("/support", json!([{ "displacement": { "x": 0 } }])),
        ("/load", json!([{ "at": [0, 0] }])),
        (
            "/load",
            json!([{ "at": [0, 0], "force": { "x": 1 }, "moment": 1 }]),
        ),
        ("/load", json!([{ "at": [0, 0], "force": { "w": 1 } }])),
        ("/load", json!([{ "at": [0, 0], "force": [1, 0] }])),
        ("/temperature", json!([{ "group": "a" }])),
        ("/no_fail", json!([{}])),
        ("/probe", json!([{ "name": "a", "component": "x" }])),
        (
            "/probe",
            json!([{ "name": "a", "at": [0, 0], "field": "stress" }]),
        ),
        ("/fracture", json!({ "steps": 0 })),
        ("/fracture", json!({ "steps": [] })),
        ("/fracture", json!({ "steps": "many" })),
        ("/fracture", json!({ "steps": 1.5 })),
        ("/fracture", json!({ "control": "free" })),
        (
            "/fracture",
            json!({ "control": "event", "stop": { "load_fraction": 1 } }),
        ),
        (
            "/fracture",
            json!({ "steps": 1, "criterion": [{ "limit": 1 }] }),
        ),
        ("/fracture", json!({ "steps": 1, "criterion": [] })),
        (
            "/fracture",
            json!({ "steps": 1, "criterion": [{ "kind": "tension", "limit": 0 }] }),
        ),
        (
            "/fracture",
            json!({ "steps": 1, "criterion": [{ "kind": "tension", "after": "linear", "end": 1 }] }),
        ),
        ("/solver", json!("fast")),
        ("/solver", json!({ "threads": 0 })),
        ("/output", json!({ "stress": "virial" })),
        ("/output", json!({ "stress": ["virial", "virial"] })),
        ("/output", json!({ "fields_every": -1 })),
        ("/output", json!({ "during_breakage": -1 })),
    ] {
        let mut wrong = small.clone();
        match pointer.rsplit_once('/') {
            Some((above, key)) => wrong.pointer_mut(above).unwrap()[key] = value.clone(),
            None => unreachable!(),
        }
        assert!(
            fault(&wrong).is_some(),
            "the reader takes {pointer} = {value}"
        );
        assert!(
            objection(&wrong).is_some(),
            "the schema takes {pointer} = {value}"
        );
    }
    for section in ["lattice", "model", "material"] {
        let mut without = small.clone();
        without.as_object_mut().unwrap().remove(section);
        assert!(
            fault(&without).is_some() && objection(&without).is_some(),
            "{section}"
        );
    }
}
