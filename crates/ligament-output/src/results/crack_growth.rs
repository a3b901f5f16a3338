//! Table of the growth of the cracks of a stored run, lines or surfaces.

use std::path::Path;

use ligament_analysis::energy_release::{GrowthState, ReleaseRates, release_rates};

use super::columns::{CRACK_GROWTH, GROWTH_RATE, names};
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
    /// Length of all lines, m; none for a solid.
    pub(super) length: Option<f64>,
}

/// Writes the sizes of the cracks, with energies per new area, taken over growth of at least `least` (m^2); in a motion with their rates.
///
/// # Errors
///
/// If the file cannot be written.
pub(super) fn write_growth(
    path: &Path,
    [in_space, in_time]: [bool; 2],
    grown: &[CrackSize<'_>],
    least: f64,
) -> Result<(), Error> {
    let mut columns = names(CRACK_GROWTH, in_space);
    if in_time {
        columns.extend(names(GROWTH_RATE, in_space));
    }
    let mut table = Table::create(path, &columns)?;
    let state = |it: &CrackSize<'_>| GrowthState {
        area: it.area,
        displacement: it.record.displacement,
        reaction: it.record.reaction,
        released_energy: it.record.released_energy,
        dissipated_energy: it.record.dissipated_energy,
    };
    let states: Vec<GrowthState> = grown.iter().map(state).collect();
    let before = std::iter::once(None).chain(grown.iter().map(Some));
    for ((it, before), rates) in grown.iter().zip(before).zip(release_rates(&states, least)) {
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
        if in_time {
            row.push(it.record.load_factor.into());
            row.extend(it.rates_since(before));
        }
        table.append(&row)?;
    }
    Ok(())
}

impl CrackSize<'_> {
    /// Rates of the length, in the plane, and of the area since the record before, m/s and m^2/s.
    fn rates_since(&self, before: Option<&Self>) -> Vec<Value<'static>> {
        let rate = |of: fn(&Self) -> Option<f64>| {
            let before = before?;
            let time = self.record.load_factor - before.record.load_factor;
            Some((of(self)? - of(before)?) / time)
        };
        let in_plane = self.length.map(|_| rate(|it| it.length));
        let rates = in_plane.into_iter().chain([rate(|it| Some(it.area))]);
        rates
            .map(|it| it.map_or(Value::Missing, Value::from))
            .collect()
    }
}
