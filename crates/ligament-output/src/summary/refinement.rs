//! Summary of a refinement: its passes, and why the last one was the last.

use ligament_analysis::refinement_pass::{LastPass, PassRecord};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::UnitsSummary;
use crate::quantity::quantity;

/// Passes of a refinement, from the first one to the one of the results.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default)]
pub struct RefinementSummary {
    /// Records of the passes.
    pub passes: Vec<PassRecord>,
    /// Reason why no other pass follows; none where one follows, or where the pass was stopped.
    pub last: Option<LastPass>,
}

impl RefinementSummary {
    /// Names and texts of the passes and of the end, for the user.
    pub fn rows(&self, units: &UnitsSummary) -> Vec<(String, String)> {
        let passes = self
            .passes
            .iter()
            .map(|pass| (format!("pass {}", pass.pass), words(pass, units)));
        let last = self
            .last
            .map(|it| ("no other pass".to_owned(), it.words().to_owned()));
        passes.chain(last).collect()
    }
}

/// Size, numbers and results of a pass, with their changes since the pass before.
fn words(pass: &PassRecord, units: &UnitsSummary) -> String {
    let with_change = |value: String, change: Option<f64>| match change {
        Some(change) => format!("{value} ({:+.2} %)", 100.0 * change),
        None => value,
    };
    let peak = with_change(quantity(pass.peak, &units.force), pass.peak_change);
    let work = with_change(quantity(pass.work, "J"), pass.work_change);
    let mut words = format!(
        "size {}, {} points, {} bonds; peak {peak}, work {work}",
        quantity(pass.size, "m"),
        pass.points,
        pass.bonds
    );
    if let Some(path) = pass.path_change {
        words += &format!(", path within {}", quantity(path, "m"));
    }
    if let Some(inside) = pass.inside {
        words += &format!(
            ", {:.0} % of the open bonds in the fine part",
            100.0 * inside
        );
    }
    words + &format!(", energy ratio {:.3}", pass.energy_ratio)
}
