//! Results of a run that are read from its cracks at the end: length, area, and height of the path.

use std::path::Path;

use ligament_output::Error;
use ligament_output::results::cracks::StoredCracks;
use ligament_output::results::solid_cracks::{SolidCracks, has_solid};
use ligament_post::crack::CrackLine;

/// Length of all crack lines without pre-cracks, m.
pub(super) const LENGTH: &str = "crack.length";

/// Area of all cracks without pre-cracks, m^2.
pub(super) const AREA: &str = "crack.area";

/// Height y of the path at an x or over a range, m.
pub(super) const HEIGHT: &str = "crack.height";

/// Names of all results of cracks.
pub(super) const NAMES: [&str; 3] = [LENGTH, AREA, HEIGHT];

/// Cracks of a run at its end.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct CrackResults {
    /// Lines, the longest first; None for a solid.
    lines: Option<Vec<CrackLine>>,
    /// Area of all cracks, m^2.
    area: f64,
}

impl CrackResults {
    /// Reads the cracks from the folder of a run.
    ///
    /// # Errors
    ///
    /// If the folder has no results of a run under loads.
    pub(super) fn read(folder: &Path) -> Result<Self, Error> {
        if has_solid(folder)? {
            let surface = SolidCracks::open(folder)?.surface(usize::MAX);
            return Ok(Self {
                lines: None,
                area: surface.area(),
            });
        }
        let cracks = StoredCracks::open(folder)?;
        let mut lines = cracks.lines(usize::MAX);
        lines.sort_by(|a, b| b.length().total_cmp(&a.length()));
        let length = total_length(&lines);
        Ok(Self {
            lines: Some(lines),
            area: cracks.thickness * length,
        })
    }

    /// Whether the run is one of a solid, whose cracks have no length and no height.
    pub(super) fn is_of_solid(&self) -> bool {
        self.lines.is_none()
    }

    /// Length and area by their names.
    pub(super) fn number(&self, name: &str) -> Option<f64> {
        match name {
            LENGTH => self.lines.as_deref().map(total_length),
            AREA => Some(self.area),
            _ => None,
        }
    }

    /// Mean height over a range of x of the longest line that leads from one end of the range to the other, m.
    pub(super) fn height(&self, range: [f64; 2]) -> Option<f64> {
        let mut lines = self.lines.iter().flatten();
        lines.find_map(|line| line.mean_height(range))
    }
}

fn total_length(lines: &[CrackLine]) -> f64 {
    // The sum of an empty iterator would be -0.0.
    lines.iter().fold(0.0, |sum, line| sum + line.length())
}
