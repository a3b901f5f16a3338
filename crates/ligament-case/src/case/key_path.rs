//! Dotted paths to keys of a case file.

use std::fmt;

/// Paths of repeatable sections, first of a case, then of a study.
const REPEATED: [&[&str]; 12] = [
    &["interface"],
    &["precrack"],
    &["support"],
    &["load"],
    &["temperature"],
    &["no_fail"],
    &["probe"],
    &["lattice", "remove"],
    &["fracture", "criterion"],
    &["axis"],
    &["result"],
    &["plot"],
];

/// Path of a key from the root of the document: table keys and, for lists, indices counted from 0.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct KeyPath(pub Vec<String>);

impl KeyPath {
    /// The path extended by a key or index.
    pub fn child(&self, segment: impl fmt::Display) -> Self {
        let mut segments = self.0.clone();
        segments.push(segment.to_string());
        Self(segments)
    }

    /// Parses a dotted path; parts with dots or spaces are quoted as in TOML.
    pub fn parse(text: &str) -> Option<Self> {
        let keys = toml_edit::Key::parse(text).ok()?;
        Some(Self(keys.iter().map(|key| key.get().to_owned()).collect()))
    }

    /// The last part, empty for the root.
    pub fn last(&self) -> &str {
        self.0.last().map_or("", String::as_str)
    }

    /// The path of the table or list that contains this key.
    pub fn parent(&self) -> Self {
        let mut segments = self.0.clone();
        segments.pop();
        Self(segments)
    }

    /// Whether the section at this path is repeatable, and therefore a list.
    pub fn is_repeated(&self) -> bool {
        let repeated = |list: &&[&str]| self.0.iter().map(String::as_str).eq(list.iter().copied());
        REPEATED.iter().any(repeated)
    }

    /// Title of the table at this path in a case file: `[mesh]`, `[[load]]`, `load.0.displacement`.
    pub fn table_title(&self) -> String {
        let is_index =
            |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
        match self.0.as_slice() {
            [] => "the case file".to_owned(),
            [.., index] if is_index(index) && self.parent().is_repeated() => {
                format!("[[{}]]", self.parent())
            }
            segments if segments.iter().any(|segment| is_index(segment)) => format!("`{self}`"),
            _ => format!("[{self}]"),
        }
    }
}

impl fmt::Display for KeyPath {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, segment) in self.0.iter().enumerate() {
            if index > 0 {
                formatter.write_str(".")?;
            }
            let bare = |byte: u8| byte.is_ascii_alphanumeric() || byte == b'-' || byte == b'_';
            if !segment.is_empty() && segment.bytes().all(bare) {
                formatter.write_str(segment)?;
            } else {
                write!(formatter, "{segment:?}")?;
            }
        }
        Ok(())
    }
}
