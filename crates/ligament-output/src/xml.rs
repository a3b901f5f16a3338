//! What the XML formats share.

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
}
