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

#[cfg(test)]
mod tests {
    use super::*;

    fn names(texts: &[&str]) -> Vec<String> {
        texts.iter().map(|&text| text.to_owned()).collect()
    }

    #[test]
    fn the_nearest_name_is_suggested_and_a_far_one_is_not() {
        let candidates = names(&["platen-top", "platen-bottom", "disk"]);
        assert_eq!(nearest("platen-topp", &candidates), Some("platen-top"));
        assert_eq!(nearest("Disk", &candidates), Some("disk"));
        assert_eq!(nearest("quux", &candidates), None);
    }

    #[test]
    fn a_long_list_is_left_out() {
        let many: Vec<String> = (0..40).map(|index| format!("group-{index}")).collect();
        assert_eq!(hint("quux", &many, "groups", '`'), "");
        assert_eq!(
            hint("quux", &names(&["a", "b"]), "groups", '`'),
            "; groups: `a`, `b`"
        );
    }
}
