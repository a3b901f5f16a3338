//! Table of the growth of the cracks of a stored run, lines or surfaces.

use std::path::Path;

use ligament_analysis::energy_release::{GrowthState, ReleaseRates, release_rates};

use super::columns::{CRACK_GROWTH, names};
use super::cracks::CrackRecord;
use crate::Error;
use crate::csv::{Table, Value};

/// A record of the history with the size of all cracks.
pub(super) struct CrackSize<'a> {
    pub(super) record: &'a CrackRecord,
    /// Area of all cracks, m^2.
    pub(super) area: f64,
    /// Values of the columns between force and area, which differ between lines in the plane and surfaces in a solid.
    pub(super) counts: Vec<Value<'static>>,
}

/// Writes the sizes of the cracks, with energies per new area, taken over growth of at least `least` (m^2).
///
/// # Errors
///
/// If the file cannot be written.
pub(super) fn write_growth(
    path: &Path,
    in_space: bool,
    grown: &[CrackSize<'_>],
    least: f64,
) -> Result<(), Error> {
    let mut table = Table::create(path, &names(CRACK_GROWTH, in_space))?;
    let state = |it: &CrackSize<'_>| GrowthState {
        area: it.area,
        displacement: it.record.displacement,
        reaction: it.record.reaction,
        released_energy: it.record.released_energy,
        dissipated_energy: it.record.dissipated_energy,
    };
    let states: Vec<GrowthState> = grown.iter().map(state).collect();
    for (it, rates) in grown.iter().zip(release_rates(&states, least)) {
        let rate = |of: fn(&ReleaseRates) -> f64| {
            rates.as_ref().map_or(Value::Missing, |it| of(it).into())
        };
        let mut row: Vec<Value<'_>> = vec![
            it.record.step.into(),
            it.record.load_factor.into(),
            it.record.displacement.into(),
            it.record.reaction.into(),
        ];
        row.extend(&it.counts);
        row.extend([
            it.area.into(),
            rate(|it| it.by_compliance),
            rate(|it| it.by_energy),
            rate(|it| it.dissipated),
        ]);
        table.append(&row)?;
    }
    Ok(())
}
