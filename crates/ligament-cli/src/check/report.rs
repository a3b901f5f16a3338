//! Lines of the report of a check.

use std::fmt::Display;
use std::io::{self, Write};

use ligament_output::quantity::{between, quantity};
use ligament_output::summary::Spread;

use crate::lines;

/// Extent of a check.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CheckExtent {
    /// Points, bonds and their correction, without a matrix.
    Model,
    /// The model, the symbolic analysis of the matrix, and the patch test of a body that is not too large.
    Matrix,
    /// The model, the matrix, and the patch test of a body of any size.
    PatchTest,
}

/// Lines of a report that are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Lines {
    /// Lines by which a case is judged before a run: some 30.
    Main,
    /// All lines, with the details of groups, corrections, solvers and times.
    All,
}

/// A report of sections, whose heads are written with their first lines.
pub(super) struct Report<'a> {
    out: &'a mut dyn Write,
    lines: Lines,
    head: Option<&'static str>,
}

impl<'a> Report<'a> {
    pub(super) fn new(out: &'a mut dyn Write, lines: Lines) -> Self {
        Self {
            out,
            lines,
            head: None,
        }
    }

    /// Begins a section.
    pub(super) fn head(&mut self, head: &'static str) {
        self.head = Some(head);
    }

    /// Writes a line that is not indented, such as a warning.
    pub(super) fn line(&mut self, text: impl Display) -> io::Result<()> {
        writeln!(self.out, "{text}")
    }

    /// Writes a line of words in the section.
    pub(super) fn words(&mut self, words: impl Display) -> io::Result<()> {
        self.write_head()?;
        writeln!(self.out, "  {words}")
    }

    /// Writes a line with a name and its value.
    pub(super) fn entry(&mut self, name: &str, value: impl Display) -> io::Result<()> {
        self.write_head()?;
        lines::entry(self.out, 21, name, value)
    }

    /// Writes a line with a name and its value, if all lines are written.
    pub(super) fn detail(&mut self, name: &str, value: impl Display) -> io::Result<()> {
        match self.lines {
            Lines::Main => Ok(()),
            Lines::All => self.entry(name, value),
        }
    }

    fn write_head(&mut self) -> io::Result<()> {
        match self.head.take() {
            Some(head) => writeln!(self.out, "{head}"),
            None => Ok(()),
        }
    }
}

/// Text of the smallest, largest and mean value of a quantity in an SI unit, `-` for none.
pub(super) fn spread(Spread { min, mean, max }: Spread, unit: &str) -> String {
    let values = between([min, max], unit);
    let mean = quantity(mean, unit);
    match values == mean {
        true => values,
        false => format!("{values}, mean {mean}"),
    }
}

/// Text of a size in bytes, to a tenth of a megabyte.
pub(super) fn megabytes(bytes: f64) -> String {
    format!("{:.1} MB", bytes / 1e6)
}
