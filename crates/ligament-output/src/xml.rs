//! Common parts of the XML formats.

<<<<<<< libraries
/// The text as the value of an XML attribute in double quotes.
pub(crate) fn escape_attribute(text: &str) -> String {
    // The ampersand goes first: it stands in what the others become.
    [
        ("&", "&amp;"),
        ("<", "&lt;"),
        (">", "&gt;"),
        ("\"", "&quot;"),
        ("'", "&apos;"),
    ]
    .into_iter()
    .fold(text.to_owned(), |text, (plain, escaped)| {
        text.replace(plain, escaped)
    })
=======
/// Characters and their escapes. The ampersand is escaped first and restored last, because all other escapes contain it.
const ESCAPED: [(&str, &str); 5] = [
    ("&", "&amp;"),
    ("<", "&lt;"),
    (">", "&gt;"),
    ("\"", "&quot;"),
    ("'", "&apos;"),
];

/// The text as the value of an XML attribute in double quotes.
pub(crate) fn escape_attribute(text: &str) -> String {
    let replace = |text: String, (plain, escaped): (&str, &str)| text.replace(plain, escaped);
    ESCAPED.into_iter().fold(text.to_owned(), replace)
}

/// The value of an attribute in the text of a tag written by this crate, still escaped.
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
    let replace = |text: String, (plain, escaped): (&str, &str)| text.replace(escaped, plain);
    ESCAPED.into_iter().rev().fold(text.to_owned(), replace)
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
>>>>>>> summary
}
