//! Lines of a deck and of the files that it includes, in blocks that begin with a keyword.

use std::borrow::Cow;
use std::io;
use std::ops::Range;
use std::sync::Arc;

use super::error::InpError;
use super::fields::{self, Fields};
use super::keyword::{DataLine, Header, Options, squeezed};
use crate::remark::FileLine;

/// Reads a file by its name.
pub(super) type ReadFile<'a> = dyn FnMut(&str) -> io::Result<Vec<u8>> + 'a;

/// Number of files that may include each other in a row.
const DEPTH: usize = 20;

/// A line of one of the files, in few bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
pub(super) struct Position {
    file: u16,
    line: u32,
}

/// A keyword and the places of its data.
#[derive(Debug)]
pub(super) struct Block {
    pub(super) position: Position,
    pub(super) header: Header,
    data: Vec<Lines>,
}

/// Lines of one file in a row.
#[derive(Debug)]
struct Lines {
    first: Position,
    bytes: Range<usize>,
}

struct File<'a> {
    name: Option<Arc<str>>,
    text: Cow<'a, [u8]>,
}

/// A deck with all files that it includes.
pub(super) struct Source<'a> {
    files: Vec<File<'a>>,
    pub(super) blocks: Vec<Block>,
}

impl<'a> Source<'a> {
    /// Divides a deck into blocks; included files stand where they are included.
    pub(super) fn read(text: &'a [u8], read: &mut ReadFile<'_>) -> Result<Self, InpError> {
        let file = File {
            name: None,
            text: Cow::Borrowed(text),
        };
        let mut source = Self {
            files: vec![file],
            blocks: Vec::new(),
        };
        source.divide(read, 0)?;
        Ok(source)
    }

    /// The line of a position, as errors and remarks name it.
    pub(super) fn line(&self, position: Position) -> FileLine {
        FileLine {
            file: self.files[usize::from(position.file)].name.clone(),
            number: position.line as usize,
        }
    }

    /// A block whose parameters are all among those known.
    pub(super) fn command<'s>(
        &'s self,
        block: &'s Block,
        known: &[&'static str],
    ) -> Result<Command<'s>, InpError> {
        let options = block.header.options(known);
        let options = options.map_err(|parameter| InpError::UnknownParameter {
            line: self.line(block.position),
            keyword: block.header.name.clone(),
            parameter: parameter.to_owned(),
        })?;
        Ok(Command {
            source: self,
            block,
            options,
        })
    }

    /// Data lines of a block, without comments; blank lines are among them.
    pub(super) fn rows<'s>(&'s self, block: &'s Block) -> impl Iterator<Item = Row<'s>> + use<'s> {
        block.data.iter().flat_map(move |lines| {
            let file = lines.first.file;
            let text = &self.files[usize::from(file)].text[lines.bytes.clone()];
            let cursor = Cursor {
                text,
                offset: 0,
                line: lines.first.line,
            };
            let data = cursor.filter(|(_, line)| !text[line.clone()].starts_with(b"*"));
            data.map(move |(line, bytes)| Row {
                source: self,
                position: Position { file, line },
                fields: Fields::new(&text[bytes.clone()]),
                text: &text[bytes],
            })
        })
    }

    /// Data lines of a block as text, without blank lines at the end.
    pub(super) fn data_lines(&self, block: &Block) -> Vec<DataLine> {
        let line = |row: Row<'_>| DataLine {
            line: self.line(row.position),
            text: String::from_utf8_lossy(row.text).into_owned(),
        };
        let mut lines: Vec<DataLine> = self.rows(block).map(line).collect();
        while lines.last().is_some_and(|line| line.text.is_empty()) {
            lines.pop();
        }
        lines
    }

    /// Divides the last file into blocks.
    fn divide(&mut self, read: &mut ReadFile<'_>, depth: usize) -> Result<(), InpError> {
        let index = self.files.len() - 1;
        let file = index as u16;
        let mut cursor = self.beginning(index)?;
        while let Some((line, bytes)) = self.next_line(index, &mut cursor) {
            let position = Position { file, line };
            let text = &self.files[index].text[bytes.clone()];
            if text.is_empty() && self.blocks.is_empty() || text.starts_with(b"**") {
                continue;
            }
            if text.starts_with(b"*") {
                let header = self.whole_header(index, bytes, &mut cursor);
                self.begin(position, Header::new(&header), read, depth)?;
                continue;
            }
            let Some(block) = self.blocks.last_mut() else {
                return Err(InpError::DataWithoutKeyword {
                    line: self.line(position),
                });
            };
            match block.data.last_mut().filter(|it| it.first.file == file) {
                Some(lines) => lines.bytes.end = cursor.0,
                None => block.data.push(Lines {
                    first: position,
                    bytes: bytes.start..cursor.0,
                }),
            }
        }
        Ok(())
    }

    /// The beginning of a file, behind its mark of UTF-8; refuses a file that is no text.
    fn beginning(&self, index: usize) -> Result<(usize, u32), InpError> {
        let text = &self.files[index].text;
        if text.contains(&0) {
            let file = self.files[index].name.clone();
            return Err(InpError::NotText { file });
        }
        let mark = b"\xef\xbb\xbf";
        Ok((
            if text.starts_with(mark) {
                mark.len()
            } else {
                0
            },
            1,
        ))
    }

    /// The line at a place of a file, which is moved behind it.
    fn next_line(&self, index: usize, place: &mut (usize, u32)) -> Option<(u32, Range<usize>)> {
        let mut cursor = Cursor {
            text: &self.files[index].text,
            offset: place.0,
            line: place.1,
        };
        let line = cursor.next();
        *place = (cursor.offset, cursor.line);
        line
    }

    /// Text of a keyword line, with the lines on which it goes on: behind a comma at its end follows a line that begins with a letter.
    fn whole_header(&self, index: usize, bytes: Range<usize>, place: &mut (usize, u32)) -> String {
        let file = &self.files[index].text;
        let mut header = String::from_utf8_lossy(&file[bytes]).into_owned();
        let mut ahead = *place;
        while header.ends_with(',') {
            let Some((_, bytes)) = self.next_line(index, &mut ahead) else {
                break;
            };
            match file[bytes.clone()] {
                [] | [b'*', b'*', ..] => {}
                [first, ..] if first.is_ascii_alphabetic() => {
                    header.push_str(&String::from_utf8_lossy(&file[bytes]));
                    *place = ahead;
                }
                _ => break,
            }
        }
        header
    }

    /// Begins a block, or reads the file that a keyword includes.
    fn begin(
        &mut self,
        position: Position,
        header: Header,
        read: &mut ReadFile<'_>,
        depth: usize,
    ) -> Result<(), InpError> {
        let name = squeezed(&header.name);
        let is_include = name == "INCLUDE";
        let mut input = None;
        if is_include || ["NODE", "ELEMENT"].contains(&name.as_str()) {
            let mut parameters = header.parameters.iter();
            let parameter = parameters.find(|it| it.name == "INPUT");
            input = parameter.and_then(|it| it.value.clone());
        }
        if is_include && input.is_none() {
            return Err(InpError::MissingParameter {
                line: self.line(position),
                keyword: header.name,
                parameter: "INPUT",
            });
        }
        if !is_include {
            self.blocks.push(Block {
                position,
                header,
                data: Vec::new(),
            });
        }
        match input {
            Some(name) => self.include(position, &name, read, depth + 1),
            None => Ok(()),
        }
    }

    fn include(
        &mut self,
        position: Position,
        name: &str,
        read: &mut ReadFile<'_>,
        depth: usize,
    ) -> Result<(), InpError> {
        let failure = |source: &Self, reason: String| InpError::UnreadableInclude {
            line: source.line(position),
            file: name.to_owned(),
            reason,
        };
        if depth > DEPTH || self.files.len() > usize::from(u16::MAX) {
            return Err(failure(self, "files include each other".to_owned()));
        }
        let text = read(name).map_err(|error| failure(self, error.to_string()))?;
        self.files.push(File {
            name: Some(name.into()),
            text: Cow::Owned(text),
        });
        self.divide(read, depth)
    }
}

/// Lines of a text from some place on: their numbers, and their bytes without blanks around.
struct Cursor<'a> {
    text: &'a [u8],
    offset: usize,
    line: u32,
}

impl Iterator for Cursor<'_> {
    type Item = (u32, Range<usize>);

    fn next(&mut self) -> Option<(u32, Range<usize>)> {
        let rest = &self.text[self.offset..];
        if rest.is_empty() {
            return None;
        }
        let end = rest.iter().position(|byte| *byte == b'\n');
        let line = &rest[..end.unwrap_or(rest.len())];
        let begin = self.offset + line.len() - line.trim_ascii_start().len();
        let bytes = begin..begin + line.trim_ascii().len();
        let number = self.line;
        self.offset += line.len() + usize::from(end.is_some());
        self.line += 1;
        Some((number, bytes))
    }
}

/// A keyword with its parameters and data.
pub(super) struct Command<'s> {
    pub(super) source: &'s Source<'s>,
    pub(super) block: &'s Block,
    options: Options<'s>,
}

impl<'s> Command<'s> {
    pub(super) fn position(&self) -> Position {
        self.block.position
    }

    /// Data lines that are not blank.
    pub(super) fn rows(&self) -> impl Iterator<Item = Row<'s>> + use<'s> {
        self.all_rows().filter(|row| !row.text.is_empty())
    }

    /// Data lines, also blank ones.
    pub(super) fn all_rows(&self) -> impl Iterator<Item = Row<'s>> + use<'s> {
        self.source.rows(self.block)
    }

    pub(super) fn has(&self, parameter: &str) -> bool {
        self.options.has(parameter)
    }

    pub(super) fn value(&self, parameter: &str) -> Option<&'s str> {
        self.options.value(parameter)
    }

    /// Value of a parameter in capital letters.
    pub(super) fn word(&self, parameter: &str) -> Option<String> {
        self.value(parameter).map(str::to_uppercase)
    }

    /// Value of a parameter that the keyword must have.
    pub(super) fn required(&self, parameter: &'static str) -> Result<&'s str, InpError> {
        let value = self.value(parameter);
        value.ok_or_else(|| InpError::MissingParameter {
            line: self.source.line(self.position()),
            keyword: self.block.header.name.clone(),
            parameter,
        })
    }

    /// Integer value of a parameter that the keyword must have.
    pub(super) fn integer(&self, parameter: &'static str) -> Result<i64, InpError> {
        let value = self.required(parameter)?;
        fields::integer(value.as_bytes()).ok_or_else(|| self.unexpected("an integer", value))
    }

    pub(super) fn unexpected(&self, expected: &'static str, found: &str) -> InpError {
        let line = self.source.line(self.position());
        InpError::unexpected(line, expected, found.as_bytes())
    }

    pub(super) fn unknown(&self, what: &'static str, name: &str) -> InpError {
        self.source.unknown(self.position(), what, name)
    }

    pub(super) fn not_carried_out(&self, what: &str, remedy: &'static str) -> InpError {
        self.source.not_carried_out(self.position(), what, remedy)
    }
}

impl Source<'_> {
    /// The error for a name that nothing has.
    pub(super) fn unknown(&self, position: Position, what: &'static str, name: &str) -> InpError {
        InpError::UnknownName {
            line: self.line(position),
            what,
            name: name.to_owned(),
        }
    }

    /// The error for something that would change the mesh.
    pub(super) fn not_carried_out(
        &self,
        position: Position,
        what: &str,
        remedy: &'static str,
    ) -> InpError {
        InpError::NotCarriedOut {
            line: self.line(position),
            what: what.to_owned(),
            remedy,
        }
    }

    /// The sum of a number of a node or element and an increment.
    pub(super) fn shifted(&self, position: Position, label: u32, by: i64) -> Result<u32, InpError> {
        let sum = i64::from(label).saturating_add(by);
        fields::as_label(sum).ok_or_else(|| {
            let expected = "numbers of nodes and elements from 1 to 999999999";
            InpError::unexpected(self.line(position), expected, sum.to_string().as_bytes())
        })
    }
}

/// A data line, whose fields are read one after the other.
pub(super) struct Row<'a> {
    pub(super) source: &'a Source<'a>,
    pub(super) position: Position,
    pub(super) fields: Fields<'a>,
    pub(super) text: &'a [u8],
}

impl<'a> Row<'a> {
    /// Whether the data go on in the next line.
    pub(super) fn goes_on(&self) -> bool {
        self.text.ends_with(b",")
    }

    /// Next field; empty behind the end of the line.
    pub(super) fn field(&mut self) -> &'a [u8] {
        self.fields.next().unwrap_or_default()
    }

    /// Number of the next node or element.
    pub(super) fn label(&mut self, expected: &'static str) -> Result<u32, InpError> {
        let field = self.field();
        fields::label(field).ok_or_else(|| self.unexpected(expected, field))
    }

    /// Next integer; `default` for an empty field.
    pub(super) fn integer(
        &mut self,
        expected: &'static str,
        default: i64,
    ) -> Result<i64, InpError> {
        match self.field() {
            [] => Ok(default),
            field => fields::integer(field).ok_or_else(|| self.unexpected(expected, field)),
        }
    }

    /// Next number; zero for an empty field.
    pub(super) fn real(&mut self, expected: &'static str) -> Result<f64, InpError> {
        match self.field() {
            [] => Ok(0.0),
            field => fields::real(field).ok_or_else(|| self.unexpected(expected, field)),
        }
    }

    /// Next three coordinates, m.
    pub(super) fn coordinates(&mut self) -> Result<[f64; 3], InpError> {
        let mut next = || self.real("a coordinate");
        Ok([next()?, next()?, next()?])
    }

    pub(super) fn unexpected(&self, expected: &'static str, found: &[u8]) -> InpError {
        InpError::unexpected(self.source.line(self.position), expected, found)
    }
}
