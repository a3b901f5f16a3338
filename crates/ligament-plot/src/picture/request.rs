//! Request for a picture of bodies.

use std::path::PathBuf;

use super::Target;
use super::colour_map::ColourMap;
use super::select::Choice;
use super::solid::{Section, Upward, View};

/// Width of a column and of a page of a paper, mm.
pub(super) const WIDTHS: [f64; 2] = [90.0, 180.0];

/// Factor by which displacements are drawn larger.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Magnification {
    /// The largest displacement is about a twentieth of the body, in a mode a tenth.
    Auto,
    /// Magnification by a given factor.
    Times(f64),
}

/// Style of cracks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CrackDrawing {
    /// The broken bonds, coloured by criterion.
    Bonds,
    /// Lines between the faces that opened, with their tips, on the undeformed body with axes.
    Lines,
}

impl FieldRequest {
    /// The usual picture of the results in a folder, of the usual size.
    pub fn default_for(folder: PathBuf) -> Self {
        Self {
            folders: vec![folder],
            labels: Vec::new(),
            field: None,
            choice: Choice::Default,
            magnification: Magnification::Auto,
            crack: None,
            lines: Vec::new(),
            window: None,
            bands: None,
            range: None,
            map: None,
            columns: None,
            solid: SolidRequest::default(),
            target: Target::default(),
        }
    }

    /// Whether lines are drawn over the body, which then is undeformed.
    pub(super) fn has_lines(&self) -> bool {
        self.crack == Some(CrackDrawing::Lines) || !self.lines.is_empty()
    }
}

/// Parts of solids that are drawn, and the side from which they are seen.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SolidRequest {
    /// The side from which solids are seen; `None`: obliquely, for a section along its normal, or from the front if it is across y.
    pub view: Option<View>,
    /// Axis that points up; `None`: z.
    pub up: Option<Upward>,
    /// Plane of the section that is drawn.
    pub section: Option<Section>,
    /// Level of the field whose surface is drawn.
    pub level: Option<f64>,
}

impl SolidRequest {
    /// The side from which solids are seen.
    pub(super) fn view(&self) -> View {
        // A plane across y is seen from in front, with x to the right.
        let from = |[x, y, z]: [f64; 3]| match x == 0.0 && z == 0.0 {
            true => [0.0, -y.abs(), 0.0],
            false => [x, y, z],
        };
        let of_section = || self.section.map(|it| View::along(from(it.normal)));
        let view = self.view.or_else(of_section).unwrap_or(View::OBLIQUE);
        view.with_up(self.up.unwrap_or_default())
    }

    /// Name of a given option that applies to solids only, if any.
    pub(super) fn option_for_solids(&self) -> Option<&'static str> {
        let options = [
            ("view", self.view.is_some()),
            ("up", self.up.is_some()),
            ("section", self.section.is_some()),
            ("iso", self.level.is_some()),
        ];
        let requested = options.into_iter().find(|(_, is_asked)| *is_asked);
        requested.map(|it| it.0)
    }
}

/// A picture of a field, or of a crack.
#[derive(Debug, Clone, PartialEq)]
pub struct FieldRequest {
    /// Folders with results.
    pub folders: Vec<PathBuf>,
    /// Labels of the results; where empty, the names of their folders.
    pub labels: Vec<String>,
    /// Field with its component, or `none`. `None`: damage where bonds broke, else the displacement; for modes the strain energy
    /// density.
    pub field: Option<String>,
    /// Outputs of each folder.
    pub choice: Choice,
    /// Factor on the displacement.
    pub magnification: Magnification,
    /// Style of cracks; `None`: only pre-cracks in a mesh.
    pub crack: Option<CrackDrawing>,
    /// Tables `x,y` (m) of lines to draw over the body, separated by empty rows.
    pub lines: Vec<PathBuf>,
    /// Part of the plane, lower left and upper right corner, m.
    pub window: Option<[[f64; 2]; 2]>,
    /// Number of bands of colour.
    pub bands: Option<usize>,
    /// First and last level, SI units.
    pub range: Option<[f64; 2]>,
    /// Colours; `None`: chosen by the signs of the field.
    pub map: Option<ColourMap>,
    /// Bodies in a row.
    pub columns: Option<usize>,
    /// Settings of solids.
    pub solid: SolidRequest,
    /// Size and file.
    pub target: Target,
}
