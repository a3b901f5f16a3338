//! Refinement of a mesh where bonds break, by runs one after the other.

use ligament_model::case_type;
use ligament_model::case_type::Range;

use super::Position;

case_type! {
    /// Bonds around which the mesh is refined.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
    pub enum Indicator {
        /// Bonds that broke or lost half of their force.
        #[default]
        Half,
        /// Bonds that broke or began to soften.
        Softening,
        /// Bonds that broke.
        Broken,
    }
}

/// Refinement of a mesh where bonds break: runs one after the other, each from the unloaded body on a mesh that is finer where bonds of the runs
/// before broke.
#[derive(Debug, Clone, PartialEq)]
pub struct Refine {
    /// Size of the cells where bonds break.
    pub fineness: Fineness,
    /// Bonds around which the mesh is refined.
    pub indicator: Indicator,
    /// Largest utilisation of bonds that stay coarse, 0 to 1; around others the mesh is refined too.
    pub strength_share: f64,
    /// Relative change of the peak and of the work between two passes of one size at which no other pass follows.
    pub tolerance: f64,
    /// Largest number of passes.
    pub passes: u32,
    /// Number of the present pass, from 1: cells are halved at most one time fewer.
    pub pass: u32,
    /// Places around which the mesh of the present pass is fine.
    pub places: Vec<FinePlace>,
}

/// Size of the cells where bonds break.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Fineness {
    /// Length of the edges of an equilateral triangle, or a regular tetrahedron, of the size of a cell, m.
    Size(f64),
    /// Number of times that edges are halved.
    Levels(u32),
}

/// A place around which a mesh is fine.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FinePlace {
    /// Position, m.
    pub position: Position,
    /// Number of the pass that found it; 0 for a place that is given.
    pub pass: u32,
    /// Whether a bond that broke or softened has its middle there.
    pub is_open: bool,
}

impl Refine {
    /// Range of the size of cells.
    pub const SIZE: Range<'static> = Range::POSITIVE;

    /// Range of the number of times that edges are halved.
    pub const LEVELS: Range<'static> = Range::new(&[("minimum", 1.0), ("maximum", 12.0)]);

    /// Range of the largest utilisation of bonds that stay coarse.
    pub const STRENGTH_SHARE: Range<'static> =
        Range::new(&[("exclusiveMinimum", 0.0), ("maximum", 1.0)]);

    /// Range of relative changes.
    pub const TOLERANCE: Range<'static> = Range::SHARE;

    /// Range of the number of passes, and of the present one.
    pub const PASSES: Range<'static> = Range::new(&[("minimum", 1.0)]);

    /// Refinement down to a size of the cells, around bonds that broke or lost half of their force.
    pub fn new(fineness: Fineness) -> Self {
        Self {
            fineness,
            indicator: Indicator::Half,
            strength_share: 0.8,
            tolerance: 0.02,
            passes: 5,
            pass: 1,
            places: Vec::new(),
        }
    }
}
