//! Most similar names for "did you mean".

/// Lists longer than this are not printed in an error.
const SHORT_LIST: usize = 20;

/// Smallest similarity of a suggested name (Jaro-Winkler, 0 to 1).
const LIKENESS: f64 = 0.8;

/// The candidate most similar to `found`, if one is similar enough.
pub fn nearest<'a>(found: &str, candidates: &'a [String]) -> Option<&'a str> {
    let found = found.to_lowercase();
    candidates
        .iter()
        .map(|candidate| {
            (
                strsim::jaro_winkler(&found, &candidate.to_lowercase()),
                candidate,
            )
        })
        .filter(|(likeness, _)| *likeness >= LIKENESS)
        .max_by(|(a, _), (b, _)| a.total_cmp(b))
        .map(|(_, candidate)| candidate.as_str())
}

/// The tail of an error about a name: `; did you mean ...? valid keys: ...`.
///
/// `noun` names the candidates in the plural; `quote` encloses a name.
pub fn hint(found: &str, candidates: &[String], noun: &str, quote: char) -> String {
    let quoted = |name: &str| format!("{quote}{name}{quote}");
    let suggestion =
        nearest(found, candidates).map(|name| format!("did you mean {}?", quoted(name)));
    let list = (1..=SHORT_LIST).contains(&candidates.len()).then(|| {
        let names: Vec<_> = candidates.iter().map(|name| quoted(name)).collect();
        format!("{noun}: {}", names.join(", "))
    });
    match (suggestion, list) {
        (Some(suggestion), Some(list)) => format!("; {suggestion} {list}"),
        (Some(text), None) | (None, Some(text)) => format!("; {text}"),
        (None, None) => String::new(),
    }
}
