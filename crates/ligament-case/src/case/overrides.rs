//! `--set key=value`: settings of the command line on top of a case file.

use super::document::{Entry, Node, Origin, Value};
use super::key_path::KeyPath;

/// Puts the override `given` (`key=value`, the one with this index) into the document.
pub(super) fn apply(document: &mut Node, given: &str, index: usize) -> Result<(), String> {
    let origin = Origin::Override(index);
    let (key, text) = given
        .split_once('=')
        .ok_or("expected key=value, such as model.horizon_factor=4")?;
    let path = KeyPath::parse(key.trim())
        .ok_or_else(|| format!("`{key}` is not a key path such as load.0.displacement.y"))?;
    let value = parse_value(text.trim(), origin)?;
    set(document, &path, value, origin)
}

/// A TOML value, or a bare word for a string without its quotes.
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

/// The value one segment down; tables that are not there yet are made.
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
            let index: usize = segment.parse().map_err(|_| {
                format!("`{above}` is a list: `{segment}` should be an index from 0")
            })?;
            // A case without criteria has one all the same, and several are put together on the command line.
            if index == count && above.to_string() == "fracture.criterion" {
                let value = Value::Table(Vec::new());
                nodes.push(Node { origin, value });
            }
            nodes
                .get_mut(index)
                .ok_or_else(|| out_of_range(above, index, count))
        }
        _ => Err(format!(
            "`{above}` is a value, not a table: it has no `{segment}` below it"
        )),
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
            // A list section that is not there is an empty list: an index into it is out of range.
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
