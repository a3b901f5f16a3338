//! Writer of a checked case as TOML.

use toml_edit::visit_mut::{VisitMut, visit_value_mut};
use toml_edit::{ArrayOfTables, DocumentMut, Item, Table, TableLike, Value};

use super::ineffective_keys::keys_without_effect;
use super::sections::Case;

/// The case as TOML, with a header for each section and nested tables inline.
pub(super) fn to_toml(case: &Case) -> Result<String, toml_edit::ser::Error> {
    let mut document: DocumentMut = toml_edit::ser::to_document(case)?;
    for (section, key) in keys_without_effect(&case.settings()) {
        let table = match section {
            "" => Some(document.as_table_mut() as &mut dyn TableLike),
            name => document.get_mut(name).and_then(Item::as_table_like_mut),
        };
        table.and_then(|it| it.remove(key));
    }
    Exponents.visit_document_mut(&mut document);
    for (key, item) in document.iter_mut() {
        *item = with_header(std::mem::take(item), key.get() == "material");
    }
    if let Some(criteria) = document
        .get_mut("fracture")
        .and_then(|it| it.get_mut("criterion"))
    {
        *criteria = with_header(std::mem::take(criteria), false);
    }
    Ok(document.to_string())
}

/// Converts inline tables, and lists of them, to tables with headers; with `nested` also one level below.
fn with_header(item: Item, nested: bool) -> Item {
    match item {
        Item::Value(Value::InlineTable(section)) => {
            let mut table: Table = section.into_table();
            if nested {
                for (_, item) in table.iter_mut() {
                    *item = with_header(std::mem::take(item), false);
                }
                table.set_implicit(true);
            }
            Item::Table(table)
        }
        Item::Value(Value::Array(list)) if list.iter().all(Value::is_inline_table) => {
            let tables = list.into_iter().filter_map(|value| match value {
                Value::InlineTable(section) => Some(section.into_table()),
                _ => None,
            });
            Item::ArrayOfTables(tables.collect::<ArrayOfTables>())
        }
        other => other,
    }
}

/// Writes large and small numbers with an exponent: 1.5e10 instead of 15000000000.0.
struct Exponents;

impl VisitMut for Exponents {
    fn visit_value_mut(&mut self, value: &mut Value) {
        match value {
            Value::Float(float) => {
                let size = float.value().abs();
                if size != 0.0
                    && !(1e-3..1e5).contains(&size)
                    && let Ok(written) = format!("{:e}", float.value()).parse()
                {
                    *value = written;
                }
            }
            other => visit_value_mut(self, other),
        }
    }
}
