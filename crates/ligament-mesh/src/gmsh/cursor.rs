//! Sequential reading of values from the bytes of a file.

use super::error::GmshError;
use crate::remark::FilePosition;

/// Encoding of the numbers in the sections.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Encoding {
    /// Numbers as text, one row of the format per line.
    Ascii,
    /// Numbers as bytes, the least significant first.
    LittleEndian,
    /// Numbers as bytes, the most significant first.
    BigEndian,
}

/// A reading position in the bytes of a file.
pub(super) struct Cursor<'a> {
    bytes: &'a [u8],
    offset: usize,
    /// Encoding of the file, which decides whether positions are lines or bytes.
    file: Encoding,
    /// Encoding of the numbers that are read next: text in sections that are text in every file.
    encoding: Encoding,
    /// Whether a row of text may go on in the next line.
    has_free_rows: bool,
    /// Name of the current section, and the offset at which it begins.
    section: (&'a str, usize),
}

impl<'a> Cursor<'a> {
    /// A cursor at the beginning of the file, behind a byte order mark if it has one; the format section is always text.
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        const BYTE_ORDER_MARK: &[u8] = "\u{feff}".as_bytes();
        let has_mark = bytes.starts_with(BYTE_ORDER_MARK);
        Self {
            bytes,
            offset: if has_mark { BYTE_ORDER_MARK.len() } else { 0 },
            file: Encoding::Ascii,
            encoding: Encoding::Ascii,
            has_free_rows: false,
            section: ("MeshFormat", 0),
        }
    }

    /// Switches from the text of the format line to binary values, the first of which is the integer 1.
    pub(super) fn begin_binary(&mut self) -> Result<(), GmshError> {
        // Skips the end of the line, which the cursor has reached.
        self.offset += 1;
        self.encoding = Encoding::LittleEndian;
        self.file = self.encoding;
        let begin = self.offset;
        let one = self.int("the integer 1")?;
        if one == 1_i32.swap_bytes() {
            self.encoding = Encoding::BigEndian;
            self.file = self.encoding;
        } else if one != 1 {
            return Err(GmshError::UnknownByteOrder {
                place: self.place(begin),
            });
        }
        Ok(())
    }

    /// Reads numbers as text, also in a binary file.
    pub(super) fn as_text<T>(&mut self, read: impl FnOnce(&mut Self) -> T) -> T {
        let before = std::mem::replace(&mut self.encoding, Encoding::Ascii);
        let found = read(self);
        self.encoding = before;
        found
    }

    /// Reads rows of text that may go on in the next line.
    pub(super) fn with_free_rows<T>(&mut self, read: impl FnOnce(&mut Self) -> T) -> T {
        self.has_free_rows = true;
        let found = read(self);
        self.has_free_rows = false;
        found
    }

    /// Returns to an offset within the current section.
    pub(super) fn rewind(&mut self, offset: usize) {
        self.offset = offset;
    }

    pub(super) fn is_ascii(&self) -> bool {
        self.encoding == Encoding::Ascii
    }

    pub(super) fn offset(&self) -> usize {
        self.offset
    }

    /// Number of bytes not read yet.
    pub(super) fn remaining(&self) -> usize {
        self.bytes.len() - self.offset
    }

    /// Position of a byte, as a line or an offset by the kind of file.
    pub(super) fn place(&self, offset: usize) -> FilePosition {
        if self.file == Encoding::Ascii {
            let before = &self.bytes[..offset.min(self.bytes.len())];
            FilePosition::Line(1 + before.iter().filter(|byte| **byte == b'\n').count())
        } else {
            FilePosition::Byte(offset)
        }
    }

    pub(super) fn truncation_error(&self) -> GmshError {
        let (name, begin) = self.section;
        GmshError::TruncatedSection {
            place: self.place(begin),
            name: name.to_owned(),
        }
    }

    /// Name of the current section, and the offset at which it begins.
    pub(super) fn section(&self) -> (&'a str, usize) {
        self.section
    }

    /// The error for the text `found` at `offset` instead of the expected value.
    pub(super) fn unexpected_text_error(
        &self,
        offset: usize,
        expected: &'static str,
        found: impl Into<String>,
    ) -> GmshError {
        GmshError::Unexpected {
            place: self.place(offset),
            expected,
            found: found.into(),
        }
    }

    fn skip_while(&mut self, skipped: impl Fn(u8) -> bool) {
        let rest = &self.bytes[self.offset..];
        self.offset += rest
            .iter()
            .position(|byte| !skipped(*byte))
            .unwrap_or(rest.len());
    }

    /// Moves to the next row of an ASCII section; a binary section has no rows.
    pub(super) fn begin_row(&mut self) {
        if self.is_ascii() {
            self.skip_while(|byte| byte.is_ascii_whitespace());
        }
    }

    /// Checks that an ASCII row ends here.
    pub(super) fn end_row(&mut self) -> Result<(), GmshError> {
        if !self.is_ascii() || self.has_free_rows {
            return Ok(());
        }
        self.skip_while(is_blank);
        match self.bytes.get(self.offset) {
            None => Err(self.truncation_error()),
            Some(b'\n') => Ok(()),
            Some(_) => {
                let begin = self.offset;
                let found = self.rest_of_line();
                Err(self.unexpected_text_error(begin, "the end of the line", shortened_text(found)))
            }
        }
    }

    /// Rest of the line, without blanks around it; the cursor moves to the end of the line.
    fn rest_of_line(&mut self) -> &'a [u8] {
        let begin = self.offset;
        self.skip_while(|byte| byte != b'\n');
        self.bytes[begin..self.offset].trim_ascii()
    }

    /// Next line that is not blank, and its offset: text, also in a binary file.
    ///
    /// The cursor moves behind the end of the line, where binary values begin.
    pub(super) fn text_line(&mut self) -> Result<(usize, &'a [u8]), GmshError> {
        self.skip_while(|byte| byte.is_ascii_whitespace());
        let begin = self.offset;
        let line = self.rest_of_line();
        if self.remaining() == 0 {
            return Err(self.truncation_error());
        }
        self.offset += 1;
        Ok((begin, line))
    }

    /// Count on the next line, and its offset.
    pub(super) fn count_line(&mut self, expected: &'static str) -> Result<(usize, u64), GmshError> {
        let (begin, line) = self.text_line()?;
        std::str::from_utf8(line)
            .ok()
            .and_then(|text| text.parse().ok())
            .map(|count| (begin, count))
            .ok_or_else(|| self.unexpected_text_error(begin, expected, shortened_text(line)))
    }

    /// Next word of an ASCII row.
    fn token(&mut self, expected: &'static str) -> Result<&'a [u8], GmshError> {
        match self.has_free_rows {
            true => self.skip_while(|byte| byte.is_ascii_whitespace()),
            false => self.skip_while(is_blank),
        }
        let begin = self.offset;
        self.skip_while(|byte| !byte.is_ascii_whitespace());
        if begin == self.offset {
            return Err(match self.bytes.get(begin) {
                None => self.truncation_error(),
                Some(_) => self.unexpected_text_error(begin, expected, "the end of the line"),
            });
        }
        Ok(&self.bytes[begin..self.offset])
    }

    /// Next word of the row, if it has digits alone: in one pass over them, as most of a file is such words. The cursor stays before any other.
    fn digits(&mut self) -> Option<u64> {
        let rest = &self.bytes[self.offset..];
        let word = rest.iter().position(|byte| !is_blank(*byte))?;
        let mut end = word;
        let mut value: u64 = 0;
        while let Some(digit @ b'0'..=b'9') = rest.get(end) {
            value = value
                .checked_mul(10)?
                .checked_add(u64::from(digit - b'0'))?;
            end += 1;
        }
        let is_whole = end > word && rest.get(end).is_none_or(u8::is_ascii_whitespace);
        is_whole.then(|| {
            self.offset += end;
            value
        })
    }

    fn parsed<T: std::str::FromStr>(&mut self, expected: &'static str) -> Result<T, GmshError> {
        self.parsed_by(expected, |text| text.parse().ok())
    }

    fn parsed_by<T>(
        &mut self,
        expected: &'static str,
        parse: impl Fn(&str) -> Option<T>,
    ) -> Result<T, GmshError> {
        let token = self.token(expected)?;
        std::str::from_utf8(token)
            .ok()
            .and_then(parse)
            .ok_or_else(|| {
                self.unexpected_text_error(
                    self.offset - token.len(),
                    expected,
                    shortened_text(token),
                )
            })
    }

    fn raw<const N: usize>(&mut self) -> Result<[u8; N], GmshError> {
        let chunk = self.bytes[self.offset..]
            .first_chunk()
            .ok_or_else(|| self.truncation_error())?;
        self.offset += N;
        Ok(*chunk)
    }

    /// Next `int`.
    pub(super) fn int(&mut self, expected: &'static str) -> Result<i32, GmshError> {
        match self.encoding {
            Encoding::Ascii => self.parsed(expected),
            Encoding::LittleEndian => self.raw().map(i32::from_le_bytes),
            Encoding::BigEndian => self.raw().map(i32::from_be_bytes),
        }
    }

    /// Next `int`, which must not be negative.
    pub(super) fn unsigned_int(&mut self, expected: &'static str) -> Result<u64, GmshError> {
        let begin = self.offset;
        let value = self.int(expected)?;
        u64::try_from(value)
            .map_err(|_| self.unexpected_text_error(begin, expected, value.to_string()))
    }

    /// Next `size_t`.
    pub(super) fn size(&mut self, expected: &'static str) -> Result<u64, GmshError> {
        match self.encoding {
            Encoding::Ascii => match self.digits() {
                Some(value) => Ok(value),
                None => self.parsed(expected),
            },
            Encoding::LittleEndian => self.raw().map(u64::from_le_bytes),
            Encoding::BigEndian => self.raw().map(u64::from_be_bytes),
        }
    }

    /// Next `double`.
    pub(super) fn real(&mut self, expected: &'static str) -> Result<f64, GmshError> {
        match self.encoding {
            Encoding::Ascii => self.parsed_by(expected, |text| {
                text.parse().ok().or_else(|| fortran_real(text))
            }),
            Encoding::LittleEndian => self.raw().map(f64::from_le_bytes),
            Encoding::BigEndian => self.raw().map(f64::from_be_bytes),
        }
    }

    /// Refuses a count, read at `offset`, of items of at least `bytes_each` bytes for which the file is too short.
    pub(super) fn check_count(
        &self,
        offset: usize,
        count: u64,
        bytes_each: usize,
        items: &'static str,
    ) -> Result<usize, GmshError> {
        usize::try_from(count)
            .ok()
            .filter(|count| *count <= self.remaining() / bytes_each)
            .ok_or_else(|| GmshError::CountBeyondFile {
                place: self.place(offset),
                items,
                count,
            })
    }

    /// Name of the section that begins here; `None` at the end of the file.
    pub(super) fn begin_section(&mut self) -> Result<Option<&'a str>, GmshError> {
        self.skip_while(|byte| byte.is_ascii_whitespace());
        let begin = self.offset;
        if self.remaining() == 0 {
            return Ok(None);
        }
        let line = self.rest_of_line();
        let name = line
            .strip_prefix(b"$")
            .and_then(|name| std::str::from_utf8(name).ok());
        let name = name.ok_or_else(|| {
            self.unexpected_text_error(begin, "the $ of a section", shortened_text(line))
        })?;
        self.section = (name, begin);
        // Binary values begin directly behind the end of the line.
        self.offset = self.bytes.len().min(self.offset + 1);
        Ok(Some(name))
    }

    /// Checks that the current section ends here.
    pub(super) fn end_section(&mut self) -> Result<(), GmshError> {
        self.skip_while(|byte| byte.is_ascii_whitespace());
        let begin = self.offset;
        let line = self.rest_of_line();
        match line.strip_prefix(b"$End") {
            Some(name) if name == self.section.0.as_bytes() => Ok(()),
            // A file that ends within the word is truncated; the word is not wrong.
            _ if self.remaining() == 0 && self.end_mark().starts_with(line) => {
                Err(self.truncation_error())
            }
            _ => Err(self.unexpected_text_error(
                begin,
                "the end of the section",
                shortened_text(line),
            )),
        }
    }

    fn end_mark(&self) -> Vec<u8> {
        [b"$End", self.section.0.as_bytes()].concat()
    }

    /// Skips the rest of the current section, and its end.
    pub(super) fn skip_section(&mut self) -> Result<(), GmshError> {
        let mark = self.end_mark();
        let mut rest = &self.bytes[self.offset..];
        while let Some(dollar) = rest.iter().position(|byte| *byte == b'$') {
            rest = &rest[dollar..];
            // Only a whole word ends the section: $EndElementData does not end $EndElement.
            let behind = rest.get(mark.len()).copied().unwrap_or(b'\n');
            if rest.starts_with(&mark) && behind.is_ascii_whitespace() {
                self.offset = self.bytes.len() - rest.len() + mark.len();
                return Ok(());
            }
            rest = &rest[1..];
        }
        Err(self.truncation_error())
    }
}

/// A number as Fortran programs write it: with D as the letter of the exponent, or with no letter before an exponent of three digits
/// (`2.5D-01`, `0.25-101`).
fn fortran_real(text: &str) -> Option<f64> {
    let (digits, exponent) = match text.find(['d', 'D']) {
        Some(at) => (&text[..at], &text[at + 1..]),
        None => text
            .rfind(['+', '-'])
            .filter(|at| text.len() - at == "-101".len())
            .map(|at| text.split_at(at))?,
    };
    format!("{digits}e{exponent}").parse().ok()
}

/// White space within a line.
fn is_blank(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t' | b'\r')
}

/// Text from the file, shortened for a message.
pub(super) fn shortened_text(found: &[u8]) -> String {
    const LENGTH: usize = 40;
    if found.is_empty() {
        return "nothing".to_owned();
    }
    let text = String::from_utf8_lossy(&found[..found.len().min(LENGTH)]);
    let dots = if found.len() > LENGTH { "…" } else { "" };
    format!("\"{}{dots}\"", text.escape_debug())
}
