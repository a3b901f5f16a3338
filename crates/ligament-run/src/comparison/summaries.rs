//! Comparison of summaries, number by number.

use anyhow::Context;
use serde_json::Value;

use super::values::apart;

/// End of the first of two runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Ending {
    /// End by the computation, or by the user.
    ByCourse,
    /// End by a limit of wall time, which the other run need not have.
    ByTime,
}

/// Keys of values that may differ between equal runs: times, memory, threads and the record of the program.
const PASSING: [&str; 4] = ["version", "provenance", "stages", "threads"];

/// Keys of the end of a run, which differ where the first run ended by a limit of wall time.
const OF_THE_END: [&str; 2] = ["termination", "termination_message"];

/// Description of the first difference of two summaries; `None` if only times, memory, threads or the program differ.
pub(super) fn difference(
    then: &[u8],
    now: &[u8],
    ending: Ending,
) -> anyhow::Result<Option<String>> {
    let read = |bytes| serde_json::from_slice::<Value>(bytes).context("a summary is not JSON");
    let is_passing = |key: &str| {
        PASSING.contains(&key)
            || key.ends_with("seconds")
            || (ending == Ending::ByTime && OF_THE_END.contains(&key))
    };
    Ok(first("", &read(then)?, &read(now)?, &is_passing))
}

/// Description of the first difference of two values below a key.
fn first(
    key: &str,
    then: &Value,
    now: &Value,
    is_passing: &dyn Fn(&str) -> bool,
) -> Option<String> {
    let below = |name: &str| match key {
        "" => name.to_owned(),
        _ => format!("{key}.{name}"),
    };
    match (then, now) {
        (Value::Object(then), Value::Object(now)) => {
            let names = then.keys();
            let added = now.keys().filter(|name| !then.contains_key(*name));
            let mut counted = names.chain(added).filter(|name| !is_passing(name));
            counted.find_map(|name| {
                let [then, now] = [then, now].map(|map| map.get(name).unwrap_or(&Value::Null));
                first(&below(name), then, now, is_passing)
            })
        }
        (Value::Array(then), Value::Array(now)) if then.len() == now.len() => {
            let mut pairs = then.iter().zip(now).enumerate();
            pairs.find_map(|(k, (then, now))| first(&below(&k.to_string()), then, now, is_passing))
        }
        _ if then == now => None,
        _ => Some(format!(
            "`{key}`: {}",
            apart(&then.to_string(), &now.to_string())
        )),
    }
}
