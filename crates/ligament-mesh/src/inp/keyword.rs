//! Keywords with their parameters and data lines.

use std::collections::HashMap;

use super::fields::{Fields, label};
use crate::remark::FileLine;

/// A keyword that is no part of the mesh, such as `*ELASTIC` or `*BOUNDARY`, as the deck has it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Keyword {
    /// Line of the keyword.
    pub line: FileLine,
    /// Name of the keyword in capital letters, without the star, its words separated by one blank.
    pub name: String,
    /// Parameters in their order.
    pub parameters: Vec<Parameter>,
    /// Lines with data, without comments.
    pub data: Vec<DataLine>,
    /// Scope of the names and numbers in the data.
    pub scope: Scope,
}

/// A parameter of a keyword.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Parameter {
    /// Name in capital letters, its words separated by one blank.
    pub name: String,
    /// Value as written, without quotation marks; `None` for a parameter without one.
    pub value: Option<String>,
}

/// A line with data.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DataLine {
    /// Line of the file.
    pub line: FileLine,
    /// Text of the line.
    pub text: String,
}

/// The part of a model whose nodes, elements and sets a name or number refers to.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub enum Scope {
    /// The model, or the assembly of its instances.
    #[default]
    Model,
    /// A part, with its name.
    Part(String),
    /// An instance of a part, with its name.
    Instance(String),
}

impl Keyword {
    /// Whether the keyword has a given name, without regard to case and blanks.
    pub fn is(&self, name: &str) -> bool {
        squeezed(&self.name) == squeezed(name)
    }

    /// The parameter of a given name, without regard to case and blanks.
    pub fn parameter(&self, name: &str) -> Option<&Parameter> {
        let name = squeezed(name);
        let mut parameters = self.parameters.iter();
        parameters.find(|parameter| squeezed(&parameter.name) == name)
    }
}

impl Keyword {
    /// Names of the groups of sides on which the data lines of a `*DLOAD` press: `SET.P3` for side 3 of a set, `dload-17` for single
    /// elements under one pressure, by the first of their lines; `None` for lines without a side by number.
    pub fn pressed_sides(&self) -> Vec<Option<String>> {
        let mut firsts = HashMap::new();
        let name = |line: &DataLine| {
            let fields = line.fields();
            let [elements, kind, value, ..] = fields.as_slice() else {
                return None;
            };
            side_number(kind)?;
            Some(match label(elements.as_bytes()) {
                None => format!("{elements}.{}", kind.to_uppercase()),
                Some(_) => {
                    let first = firsts.entry(value.clone()).or_insert(line.line.number);
                    format!("dload-{first}")
                }
            })
        };
        self.data.iter().map(name).collect()
    }
}

/// Number of a side under pressure, such as `P3`.
pub(super) fn side_number(kind: &str) -> Option<u8> {
    let number = kind.strip_prefix(['P', 'p'])?;
    number.parse().ok().filter(|number| *number > 0)
}

impl DataLine {
    /// The text between the commas, without blanks around it and without quotation marks.
    pub fn fields(&self) -> Vec<String> {
        let fields = Fields::new(self.text.as_bytes());
        fields.map(text_of).collect()
    }
}

/// A line with a keyword, taken apart.
#[derive(Debug)]
pub(super) struct Header {
    pub(super) name: String,
    pub(super) parameters: Vec<Parameter>,
}

impl Header {
    /// Takes a keyword line apart, with the lines on which it goes on.
    pub(super) fn new(text: &str) -> Self {
        let mut fields = Fields::new(text.as_bytes());
        let name = fields.next().map(text_of).unwrap_or_default();
        let parameter = |field: &[u8]| {
            let field = String::from_utf8_lossy(field);
            match field.split_once('=') {
                Some((name, value)) => Parameter {
                    name: in_capitals(name),
                    value: Some(unquoted(value).to_owned()),
                },
                None => Parameter {
                    name: in_capitals(&field),
                    value: None,
                },
            }
        };
        Self {
            name: in_capitals(name.trim_start_matches('*')),
            parameters: fields.filter(|it| !it.is_empty()).map(parameter).collect(),
        }
    }

    /// Parameters by the names of those known; the first parameter that is none of them, or begins several of them, as an error.
    pub(super) fn options(&self, known: &[&'static str]) -> Result<Options<'_>, &str> {
        let mut options = Vec::new();
        for parameter in &self.parameters {
            let name = squeezed(&parameter.name);
            let exact = known.iter().find(|it| squeezed(it) == name);
            let mut begun = known.iter().filter(|it| squeezed(it).starts_with(&name));
            let named = match (exact, begun.next(), begun.next()) {
                (Some(exact), ..) => exact,
                (None, Some(only), None) => only,
                _ => return Err(&parameter.name),
            };
            options.push((*named, parameter.value.as_deref()));
        }
        Ok(Options(options))
    }
}

/// Parameters by their known names.
pub(super) struct Options<'a>(Vec<(&'static str, Option<&'a str>)>);

impl<'a> Options<'a> {
    pub(super) fn has(&self, name: &str) -> bool {
        self.0.iter().any(|(known, _)| *known == name)
    }

    /// Value of a parameter; `None` where the parameter or its value is missing.
    pub(super) fn value(&self, name: &str) -> Option<&'a str> {
        let mut options = self.0.iter().filter(|(known, _)| *known == name);
        let value = options.find_map(|(_, value)| *value);
        value.filter(|value| !value.is_empty())
    }
}

/// A name by which another one is found without regard to case and blanks.
pub(super) fn squeezed(name: &str) -> String {
    let characters = name.chars().filter(|it| !it.is_whitespace());
    characters.flat_map(char::to_uppercase).collect()
}

/// Text of a field, without quotation marks.
pub(super) fn text_of(field: &[u8]) -> String {
    unquoted(&String::from_utf8_lossy(field)).to_owned()
}

fn unquoted(text: &str) -> &str {
    let text = text.trim();
    let inner = text.strip_prefix('"').and_then(|it| it.strip_suffix('"'));
    inner.unwrap_or(text)
}

fn in_capitals(name: &str) -> String {
    let words: Vec<&str> = name.split_whitespace().collect();
    words.join(" ").to_uppercase()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parameters_are_found_by_their_beginnings_and_without_blanks() {
        let header = Header::new("*Nset , nset = \"Left edge, low\",GEN, , un sorted");
        assert_eq!(header.name, "NSET");
        let known = ["NSET", "GENERATE", "UNSORTED", "GENERIC"];
        assert_eq!(header.options(&known).err(), Some("GEN"));
        let options = header.options(&known[..3]).ok().unwrap();
        assert_eq!(options.value("NSET"), Some("Left edge, low"));
        assert!(options.has("GENERATE") && options.has("UNSORTED"));
        assert_eq!(options.value("GENERATE"), None);
    }
}
