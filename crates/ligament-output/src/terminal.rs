//! Output of foreign texts on a terminal.
//!
//! A title, a name of a group or a line of a file may contain escape sequences that control a terminal. [`EscapedWriter`] shows control characters
//! instead of sending them.

use std::borrow::Cow;
use std::io::{self, Write};

/// A writer that shows control characters, except tabs and line ends, in the form `\u{1b}`.
#[derive(Debug)]
pub struct EscapedWriter<W> {
    inner: W,
    /// Whether the last byte may be the first of the two bytes of a control character above 0x7f.
    is_in_control: bool,
}

/// First byte of the characters U+0080 to U+00BF.
const LEAD: u8 = 0xc2;

impl<W: Write> EscapedWriter<W> {
    /// A plain writer around another writer.
    pub fn new(inner: W) -> Self {
        Self {
            inner,
            is_in_control: false,
        }
    }
}

impl<W: Write> Write for EscapedWriter<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let mut shown = Vec::with_capacity(bytes.len());
        for &byte in bytes {
            match (self.is_in_control, byte) {
                (true, 0x80..0xa0) => shown.extend(format!("\\u{{{byte:x}}}").bytes()),
                (true, _) => shown.extend([LEAD, byte]),
                (false, LEAD) => {}
                (false, b'\t' | b'\n' | b'\r') => shown.push(byte),
                (false, 0..0x20 | 0x7f) => shown.extend(format!("\\u{{{byte:x}}}").bytes()),
                (false, _) => shown.push(byte),
            }
            self.is_in_control = !self.is_in_control && byte == LEAD;
        }
        self.inner.write_all(&shown)?;
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.inner.flush()
    }
}

/// A text with its control characters shown in the form `\u{1b}`.
pub fn plain(text: &str) -> Cow<'_, str> {
    if !text
        .chars()
        .any(|letter| letter.is_control() && !matches!(letter, '\t' | '\n'))
    {
        return Cow::Borrowed(text);
    }
    let mut shown = Vec::new();
    // Writing to memory cannot fail.
    let _ = EscapedWriter::new(&mut shown).write_all(text.as_bytes());
    Cow::Owned(String::from_utf8_lossy(&shown).into_owned())
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn control_characters_are_shown_and_letters_left() {
        let text = "Plate \u{1b}]0;renamed\u{7} \u{9b}2J, 5 \u{b5}m,\t\u{e9}\u{2192}\n";
        let expected = "Plate \\u{1b}]0;renamed\\u{7} \\u{9b}2J, 5 \u{b5}m,\t\u{e9}\u{2192}\n";
        assert_eq!(plain(text), expected);
        let mut out = Vec::new();
        // Characters may come in parts.
        let mut plain = EscapedWriter::new(&mut out);
        text.bytes()
            .for_each(|byte| plain.write_all(&[byte]).unwrap());
        assert_eq!(String::from_utf8(out).unwrap(), expected);
    }
}
