//! What a picture of bodies is to show.

use std::path::PathBuf;

use super::Target;
use super::colour_map::ColourMap;
use super::select::Choice;

/// Width of a column and of a page of a paper, mm.
pub(super) const WIDTHS: [f64; 2] = [90.0, 180.0];

/// How much larger displacements are drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Magnification {
    /// So that the largest is about a twentieth of the body; of a mode a tenth.
    Auto,
    /// By this factor.
    Times(f64),
}

/// A picture of a field, or of a crack.
#[derive(Debug, Clone, PartialEq)]
pub struct FieldRequest {
    /// Folders with results.
    pub folders: Vec<PathBuf>,
    /// Labels of the results; where empty, the names of their folders.
    pub labels: Vec<String>,
    /// Field with its component, or `none`; None: damage where bonds broke, else the displacement; of modes the strain energy
    /// density.
    pub field: Option<String>,
    /// Outputs of each folder.
    pub choice: Choice,
    /// Factor on the displacement.
    pub magnification: Magnification,
    /// Whether broken bonds are drawn.
    pub crack: bool,
    /// Part of the plane, lower left and upper right corner, m.
    pub window: Option<[[f64; 2]; 2]>,
    /// Number of bands of colour.
    pub bands: Option<usize>,
    /// First and last level, SI units.
    pub range: Option<[f64; 2]>,
    /// Colours; None: as the signs of the field ask for.
    pub map: Option<ColourMap>,
    /// Bodies in a row.
    pub columns: Option<usize>,
    /// Size and file.
    pub target: Target,
}
