//! `--set key=value` and `--unset key`: overrides of a case file on the command line.

use ligament::suggestion::hint;

use super::document::{Entry, Node, Origin, Value};
use super::key_path::KeyPath;

/// Mark before the key of an override that removes it.
const UNSET: char = '-';

/// The override that removes a key of the case file.
pub fn unset(key: &str) -> String {
    format!("{UNSET}{key}")
}

/// The key of an override, and its value, or `None` where it removes the key.
pub fn parts(given: &str) -> (&str, Option<&str>) {
    match given.strip_prefix(UNSET) {
        Some(key) => (key, None),
        None => {
            let (key, value) = given.split_once('=').unwrap_or((given, ""));
            (key.trim(), Some(value))
        }
    }
}

/// An override in the form of the command line: `--set key=value` or `--unset key`.
pub(super) fn command_line_form(given: &str) -> String {
    match given.strip_prefix(UNSET) {
        Some(key) => format!("--unset {key}"),
        None => format!("--set {given}"),
    }
}

/// Applies the override `given` (`key=value` or `-key`, with an index) to the document.
pub(super) fn apply(document: &mut Node, given: &str, index: usize) -> Result<(), String> {
    if let Some(key) = given.strip_prefix(UNSET) {
        return remove_value(document, &key_path(key)?);
    }
    let origin = Origin::Override(index);
    let (key, text) = given
        .split_once('=')
        .ok_or("expected key=value, such as model.horizon_factor=4")?;
    let path = key_path(key)?;
    let value = parse_value(text.trim(), origin)?;
    set(document, &path, value, origin)
}

fn key_path(key: &str) -> Result<KeyPath, String> {
    KeyPath::parse(key.trim())
        .ok_or_else(|| format!("`{key}` is not a key path such as load.0.displacement.y"))
}

/// Removes a key, or an entry of a list, from the document.
fn remove_value(document: &mut Node, path: &KeyPath) -> Result<(), String> {
    let mut node = document;
    let mut above = KeyPath::default();
    let last = path.0.len().saturating_sub(1);
    for (depth, segment) in path.0.iter().enumerate() {
        let place = place_of(node, &above, segment)?;
        let is_last = depth == last;
        node = match &mut node.value {
            Value::Table(entries) if is_last => {
                entries.remove(place);
                return Ok(());
            }
            Value::List(nodes) if is_last => {
                nodes.remove(place);
                return Ok(());
            }
            Value::Table(entries) => &mut entries[place].node,
            Value::List(nodes) => &mut nodes[place],
            _ => return Err(no_table(&above, segment)),
        };
        above = above.child(segment);
    }
    Ok(())
}

/// Index of a key in its table, or of an entry in its list.
fn place_of(node: &Node, above: &KeyPath, segment: &str) -> Result<usize, String> {
    match &node.value {
        Value::Table(entries) => {
            let place = entries.iter().position(|entry| entry.key == segment);
            place.ok_or_else(|| {
                let keys: Vec<String> = entries.iter().map(|entry| entry.key.clone()).collect();
                format!(
                    "the case has no `{}` to take away{}",
                    above.child(segment),
                    hint(segment, &keys, "keys that it has", '`')
                )
            })
        }
        Value::List(nodes) => {
            let index = list_index(above, segment)?;
            let count = nodes.len();
            let place = Some(index).filter(|&index| index < count);
            place.ok_or_else(|| out_of_range(above, index, count))
        }
        _ => Err(no_table(above, segment)),
    }
}

fn list_index(list: &KeyPath, segment: &str) -> Result<usize, String> {
    let not_a_number = |_| format!("`{list}` is a list: `{segment}` should be an index from 0");
    segment.parse().map_err(not_a_number)
}

fn no_table(above: &KeyPath, segment: &str) -> String {
    format!("`{above}` is a value, not a table: it has no `{segment}` below it")
}

/// Parses a TOML value; a bare word is a string without quotes.
fn parse_value(text: &str, origin: Origin) -> Result<Node, String> {
    if text.is_empty() {
        return Err("there is no value after `=`".to_owned());
    }
    match Node::parse_value(text, origin) {
        Ok(node) => Ok(node),
        Err(error) if text.starts_with(['"', '\'', '[', '{']) => {
            Err(format!("the value is not valid TOML: {}", error.message()))
        }
        Err(_) => Ok(Node {
            origin,
            value: Value::String(text.to_owned()),
        }),
    }
}

fn set(document: &mut Node, path: &KeyPath, value: Node, origin: Origin) -> Result<(), String> {
    let mut node = document;
    let mut above = KeyPath::default();
    for segment in &path.0 {
        node = descend(node, &above, segment, origin)?;
        above = above.child(segment);
    }
    *node = value;
    Ok(())
}

/// The value for one path segment; missing tables are created.
fn descend<'a>(
    node: &'a mut Node,
    above: &KeyPath,
    segment: &str,
    origin: Origin,
) -> Result<&'a mut Node, String> {
    match &mut node.value {
        Value::Table(entries) => Ok(entry(entries, above, segment, origin)),
        Value::List(nodes) => {
            let count = nodes.len();
            let index = list_index(above, segment)?;
            // Criteria may be added on the command line, also to a case without any.
            if index == count && above.to_string() == "fracture.criterion" {
                let value = Value::Table(Vec::new());
                nodes.push(Node { origin, value });
            }
            nodes
                .get_mut(index)
                .ok_or_else(|| out_of_range(above, index, count))
        }
        _ => Err(no_table(above, segment)),
    }
}

fn entry<'a>(
    entries: &'a mut Vec<Entry>,
    above: &KeyPath,
    segment: &str,
    origin: Origin,
) -> &'a mut Node {
    let position = entries
        .iter()
        .position(|entry| entry.key == segment)
        .unwrap_or_else(|| {
            // A missing list section is an empty list, in which any index is out of range.
            let value = if above.child(segment).is_repeated() {
                Value::List(Vec::new())
            } else {
                Value::Table(Vec::new())
            };
            let node = Node { origin, value };
            entries.push(Entry {
                key: segment.to_owned(),
                key_origin: origin,
                node,
            });
            entries.len() - 1
        });
    &mut entries[position].node
}

fn out_of_range(list: &KeyPath, index: usize, count: usize) -> String {
    match count {
        0 => format!("there is no `{list}.{index}`: the case has no `{list}`"),
        1 => format!("there is no `{list}.{index}`: the only index of `{list}` is 0"),
        _ => format!(
            "there is no `{list}.{index}`: the indices of `{list}` are 0 to {}",
            count - 1
        ),
    }
}
