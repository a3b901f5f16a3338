//! Common parts of the XML formats.

/// The text as the value of an XML attribute in double quotes.
pub(crate) fn escape_attribute(text: &str) -> String {
    // The ampersand is escaped first, because all other escapes contain it.
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
}
