//! What the XML formats share.

/// The text as the value of an XML attribute in double quotes.
pub(crate) fn escape_attribute(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\'' => escaped.push_str("&apos;"),
            other => escaped.push(other),
        }
    }
    escaped
}

/// The value of an attribute in the text of a tag as this crate writes them, still escaped.
pub(crate) fn attribute<'a>(tag: &'a str, key: &str) -> Option<&'a str> {
    let mut rest = tag;
    loop {
        let (before, after) = rest.split_once("=\"")?;
        let (value, after) = after.split_once('"')?;
        let name = before.rsplit([' ', '\n']).next()?;
        if name == key {
            return Some(value);
        }
        rest = after;
    }
}

/// The text that [`escape_attribute`] escaped.
pub(crate) fn unescape(text: &str) -> String {
    let plain = [
        ("&lt;", "<"),
        ("&gt;", ">"),
        ("&quot;", "\""),
        ("&apos;", "'"),
        // Last, or what it uncovers would be taken for another one.
        ("&amp;", "&"),
    ];
    let replace = |text: String, (from, to): (&str, &str)| text.replace(from, to);
    plain.into_iter().fold(text.to_owned(), replace)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn attributes_read_back(first: String, second: String) {
            let tag = format!(
                "DataArray a=\"{}\" Name=\"{}\"",
                escape_attribute(&first),
                escape_attribute(&second)
            );
            prop_assert_eq!(attribute(&tag, "a").map(unescape), Some(first));
            prop_assert_eq!(attribute(&tag, "Name").map(unescape), Some(second));
            prop_assert_eq!(attribute(&tag, "Nam"), None);
        }
    }
}
