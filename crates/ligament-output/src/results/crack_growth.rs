//! Table of the growth of the cracks of a stored run, lines or surfaces.

use std::path::Path;

use ligament_analysis::energy_release::{GrowthState, ReleaseRates, release_rates};

use super::columns::{CRACK_GROWTH, GROWTH_RATE, names};
use super::cracks::CrackRecord;
use crate::Error;
use crate::csv::{Table, Value};

/// Number of rows over which rates are taken: single rows jump by the length of a cell.
pub(super) const ROWS: usize = 5;

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
    let lasting = Lasting::new(grown);
    for ((place, it), rates) in grown.iter().enumerate().zip(release_rates(&states, least)) {
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
            row.extend(lasting.rates(grown, place));
        }
        table.append(&row)?;
    }
    Ok(())
}

/// Sizes of the cracks that last: a broken bond stays broken, so that what later rows no longer have was no crack, such as a short branch that
/// is traced in one row and not in the next.
struct Lasting {
    /// Lengths of the lines, shape (n_records), m; empty for a solid.
    lengths: Vec<f64>,
    /// Areas, shape (n_records), m^2.
    areas: Vec<f64>,
}

impl Lasting {
    fn new(grown: &[CrackSize<'_>]) -> Self {
        let least_from = |mut sizes: Vec<f64>| {
            for place in (1..sizes.len()).rev() {
                sizes[place - 1] = sizes[place - 1].min(sizes[place]);
            }
            sizes
        };
        Self {
            lengths: least_from(grown.iter().filter_map(|it| it.length).collect()),
            areas: least_from(grown.iter().map(|it| it.area).collect()),
        }
    }

    /// Rates of the length, in the plane, and of the area of a record over the rows up to it, m/s and m^2/s.
    fn rates(&self, grown: &[CrackSize<'_>], place: usize) -> Vec<Value<'static>> {
        let first = place.saturating_sub(ROWS);
        let time = |place: usize| grown[place].record.load_factor;
        let rate = |sizes: &Vec<f64>| match place {
            0 => Value::Missing,
            _ => ((sizes[place] - sizes[first]) / (time(place) - time(first))).into(),
        };
        let sizes = [&self.lengths, &self.areas].into_iter();
        sizes.filter(|it| !it.is_empty()).map(rate).collect()
    }
}
