//! Crack lines of a body, from its broken bonds.
//!
//! A bond model opens a crack by breaking all bonds across it, so that broken bonds fill a band two horizons wide. The line in the middle of
//! the band is where the bonds of the *nearest* neighbours are broken. Every point has a cell of the body ([`Faces`]); the face between the
//! cells of two points is open where their bond is broken, and open faces with common ends make a graph along which the body is separated.
//! Lines are extracted from this graph ([`crack_lines`]):
//!
//! 1. The longest of all shortest paths of every connected part, which crosses a band of detached cells as straight as they allow. An end of
//!    it within a horizon of a pre-crack, or else of the outline, is moved there.
//! 2. Branches: paths to corners farther than a horizon from all lines so far, the farthest first. Two lines nearer than a horizon are one
//!    crack, because bonds reach across both.
//! 3. A part shorter than a horizon is no crack, unless it starts at a pre-crack.
//! 4. Lines follow cells and are jagged on their scale: each position of a line becomes the mean of the line within a horizon on both sides
//!    of it, less near its ends, which are fixed.
//!
//! Open faces also put the corners of cells on sides of the crack ([`sides_of_cells`]), and cut the cells into pieces that move apart
//! ([`opened_cells`]).
//!
//! The jump of the displacement across a line is its opening and sliding ([`openings`]).
//!
//! A tip has an error of one cell, the length of a line of some per cent (`tests/crack_lines.rs`).

mod bridges;
mod faces;
mod lines;
mod opened;
mod opening;
mod paths;
mod smooth;
mod tips;

pub use faces::{FaceState, Faces};
pub use lines::{CrackEnd, CrackLine, crack_lines};
pub use opened::{opened_cells, sides_of_cells};
pub use opening::{CrackOpening, openings};
