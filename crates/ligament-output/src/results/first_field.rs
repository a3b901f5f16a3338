//! The field that shows best what happened in a run: pictures, the page and Python show it unless another one is named.

use std::path::Path;

use ligament_analysis::result_fields::{
    DAMAGE, DAMAGE_COMPRESSION, DAMAGE_SLIDING, DAMAGE_TENSION, DISPLACEMENT, ResultField,
    STRAIN_ENERGY_DENSITY,
};

use super::outputs::{OutputKind, Outputs};
use super::point_fields::location;
use super::softening_table;
use crate::Error;
use crate::csv::read::CsvTable;
use crate::vtu::read::VtuFile;

/// Outcome of a run for its bonds: whether any broke or softened.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BondOutcome {
    /// No bond broke or softened.
    Nothing,
    /// Bonds broke, and none softened.
    Broke,
    /// Bonds softened.
    Softened,
}

/// Damage of softening bonds by the ways in which they fail.
const OF_SOFTENING: [&ResultField; 3] = [&DAMAGE_TENSION, &DAMAGE_SLIDING, &DAMAGE_COMPRESSION];

/// The field that shows best what happened in a run; `largest` is the largest value of a field at the end, 0 without the field.
///
/// Where bonds soften, few of them break before the crack is open: the damage of their main mode of softening shows the crack from its
/// beginning.
pub fn first_field(outcome: BondOutcome, largest: impl Fn(&str) -> f64) -> &'static ResultField {
    let by_failure_mode = || {
        let sizes = OF_SOFTENING.map(|it| (it, largest(it.name)));
        let most = sizes
            .into_iter()
            .reduce(|most, it| if it.1 > most.1 { it } else { most });
        most.filter(|it| it.1 > 0.0).map(|it| it.0)
    };
    match outcome {
        BondOutcome::Nothing => &DISPLACEMENT,
        BondOutcome::Broke => &DAMAGE,
        BondOutcome::Softened => by_failure_mode().unwrap_or(&DAMAGE),
    }
}

/// The field that shows best what happened in a stored run, or in its natural modes.
///
/// # Errors
///
/// If a file cannot be used.
pub fn first_field_of(outputs: &Outputs) -> Result<&'static ResultField, Error> {
    if outputs.kind == OutputKind::Modes {
        return Ok(&STRAIN_ENERGY_DENSITY);
    }
    let outcome = if has_rows(&outputs.folder.join(softening_table::FILE))? {
        BondOutcome::Softened
    } else if has_rows(&outputs.folder.join("breaks.csv"))? {
        BondOutcome::Broke
    } else {
        BondOutcome::Nothing
    };
    let last = outputs.files.last_key_value();
    let last = last.map(|(_, path)| VtuFile::open(path)).transpose()?;
    let largest = |name: &str| {
        let values = last
            .as_ref()
            .and_then(|file| file.numbers(location(file), name).ok()?);
        values.into_iter().flatten().fold(0.0, f64::max)
    };
    Ok(first_field(outcome, largest))
}

fn has_rows(path: &Path) -> Result<bool, Error> {
    if !path.is_file() {
        return Ok(false);
    }
    let steps = CsvTable::read(path)?.values::<usize>("step")?;
    Ok(!steps.is_empty())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_field_follows_what_the_bonds_did() {
        let sliding = |name: &str| {
            if name == DAMAGE_SLIDING.name {
                0.5
            } else {
                0.25
            }
        };
        for (outcome, expected) in [
            (BondOutcome::Nothing, "displacement"),
            (BondOutcome::Broke, "damage"),
            (BondOutcome::Softened, "damage_sliding"),
        ] {
            assert_eq!(first_field(outcome, sliding).name, expected);
        }
        assert_eq!(
            first_field(BondOutcome::Softened, |_| 0.25).name,
            "damage_tension"
        );
        assert_eq!(first_field(BondOutcome::Softened, |_| 0.0).name, "damage");
    }
}
