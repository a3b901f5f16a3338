//! Cracks of a body as lines, from the bonds that parted.
//!
//! A bond model opens a crack by breaking all bonds across it, so that broken bonds fill a band two horizons wide. The line in the
//! middle of the band is where the *nearest* neighbours parted. Every point has a cell of the body ([`Faces`]); the face between
//! the cells of two points is open where their bond has parted, and open faces with common ends make a graph along which the
//! body has come apart. Of this graph the lines are taken ([`crack_lines`]):
//!
//! 1. Of every connected part the longest of all shortest ways, which goes through a band of loose cells as straight as they
//!    allow. An end of it within a horizon of a pre-crack, or else of the outline, is drawn there.
//! 2. Branches: ways to what is farther than a horizon from all lines so far, the farthest first. Two lines nearer than a horizon
//!    are one crack, because bonds reach from one beyond the other.
//! 3. A part that stays shorter than a horizon is no crack, unless it starts at a pre-crack.
//! 4. Lines follow cells and are jagged on their scale: each place of a line becomes the mean of the line within a horizon on
//!    both sides of it, less near its ends, which stay.
//!
//! A tip is right to a cell, the length of a line to some per cent (`tests/crack_lines.rs`).

mod bridges;
mod faces;
mod lines;
mod paths;
mod smooth;

pub use faces::{Faces, Part};
pub use lines::{CrackEnd, CrackLine, crack_lines};
