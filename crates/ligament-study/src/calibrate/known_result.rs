//! Names of results that a summary can have, to refuse a wrong name before the first run.

use ligament_output::summary::{ModalSummary, Summary, schema};
use serde_json::{Value, json};

use crate::quantities::{Quantities, QuantityError};

/// Result whose parts are names of groups.
const BY_GROUP: &str = "reactions_at_peak.";

/// Refuses the name of a result that no run of this kind has as a number.
pub(super) fn check(name: &str, is_modal: bool) -> Result<(), QuantityError> {
    if name.starts_with(BY_GROUP) && !is_modal {
        return Ok(());
    }
    let complete = Quantities::from_summary(&match is_modal {
        true => example(&schema::<ModalSummary>()),
        false => example(&schema::<Summary>()),
    });
    // Lists of the example have one entry.
    let is_index = |part: &str| part.bytes().all(|it| it.is_ascii_digit());
    let parts = name
        .split('.')
        .map(|it| if is_index(it) { "0" } else { it });
    complete
        .number(&parts.collect::<Vec<_>>().join("."))
        .map(drop)
}

/// A value of a schema with all keys, one entry in each list, and zeros.
fn example(schema: &Value) -> Value {
    if !schema["anyOf"].is_null() {
        // An optional value: the other form is null.
        return example(&schema["anyOf"][0]);
    }
    let kinds = &schema["type"];
    match kinds.as_str().or_else(|| kinds[0].as_str()) {
        Some("object") => {
            let keys = schema["properties"].as_object().into_iter().flatten();
            keys.map(|(key, of_key)| (key.clone(), example(of_key)))
                .collect()
        }
        Some("array") => json!([example(&schema["items"])]),
        Some("number" | "integer") => json!(0),
        Some("boolean") => json!(false),
        _ => json!(""),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_known_before_the_first_run() {
        for name in [
            "first_peak.reaction",
            "first_break.load_factor",
            "first_broken_bond.place.1",
            "elastic_stiffness",
            "softened_bonds",
            "correction.energy_ratios.2.mean",
            "seconds",
            "reactions_at_peak.top.force_x",
        ] {
            assert!(check(name, false).is_ok(), "{name}");
        }
        assert!(check("modes.3.frequency", true).is_ok());
    }

    #[test]
    fn wrong_names_are_refused_with_the_nearest() {
        let error = |name, is_modal| check(name, is_modal).unwrap_err().to_string();
        assert!(error("peak.force", false).contains("no result `peak.force`"));
        assert!(error("first_pek.reaction", false).contains("`first_peak.reaction`"));
        assert!(error("title", false).contains("no number"));
        assert!(error("first_peak.reaction", true).contains("no result"));
        assert!(error("modes.0.frequncy", true).contains("`modes.0.frequency`"));
    }
}
