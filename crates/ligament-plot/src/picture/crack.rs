//! Broken bonds, as lines between their ends.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use ligament_output::csv::read::CsvTable;
use ligament_output::results::StoredState;
use ligament_output::results::cracks::columns_of_ends;
use ligament_output::results::outputs::cut_pairs;

use super::PictureError;
use crate::drawing::Rgb;
use crate::plots::Colour;

/// Colour of bonds cut by a pre-crack.
const CUT: Rgb = [0x8c; 3];

/// Colour over a field of broken bonds, where there is only one criterion.
const OVER_FIELD: Rgb = [0; 3];

/// Bonds that broke by one criterion, or that a pre-crack cut.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct BrokenBonds {
    /// Name of the criterion.
    pub(super) name: String,
    /// Colour of the criterion.
    pub(super) colour: Rgb,
    /// Tags of the ends with the first state in which they are broken.
    bonds: Vec<([i64; 2], StoredState)>,
}

/// All bonds that were broken or cut in a run.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Crack {
    /// Bonds cut by a pre-crack, then broken bonds by criterion.
    pub(super) kinds: Vec<BrokenBonds>,
    /// Whether the output of a step shows the bonds that break in it still whole.
    breaks_after_output: bool,
}

impl Crack {
    /// Reads the bonds that a pre-crack cut in a run, and the bonds that broke.
    pub(super) fn read(folder: &Path, follows_path: bool) -> Result<Self, PictureError> {
        let cut = cut_pairs(folder)?.unwrap_or_default();
        let cut = (!cut.is_empty()).then(|| BrokenBonds {
            name: "pre-crack".to_owned(),
            colour: CUT,
            bonds: cut.into_iter().map(|ends| (ends, 0.into())).collect(),
        });
        let broken = bonds_by_criterion(&CsvTable::read(folder.join("breaks.csv"))?)?;
        Ok(Self {
            kinds: cut.into_iter().chain(broken).collect(),
            breaks_after_output: follows_path,
        })
    }

    /// The bonds of a kind that are broken in an output, by the tags of their ends.
    pub(super) fn broken_until(&self, kind: &BrokenBonds, state: StoredState) -> Vec<[i64; 2]> {
        let is_broken = |at: StoredState| {
            let is_before = at.step < state.step || !self.breaks_after_output;
            kind.is_cut() || (at <= state && is_before)
        };
        let bonds = kind.bonds.iter().filter(|(_, at)| is_broken(*at));
        bonds.map(|(ends, _)| *ends).collect()
    }
}

impl BrokenBonds {
    /// Whether a pre-crack cut these bonds.
    pub(super) fn is_cut(&self) -> bool {
        self.colour == CUT
    }
}

/// The broken bonds of a table by their criteria.
fn bonds_by_criterion(sheet: &CsvTable) -> Result<Vec<BrokenBonds>, PictureError> {
    let ends = columns_of_ends(sheet);
    let mut by_name: BTreeMap<String, Vec<_>> = BTreeMap::new();
    let rows = sheet.rows(|row| {
        let ends = [row.value(&ends[0])?, row.value(&ends[1])?];
        Ok((row.value("criterion")?, ends, row.value("step")?))
    })?;
    let mut breakages: BTreeMap<usize, usize> = BTreeMap::new();
    for (name, ends, step) in rows {
        let count = breakages.entry(step).or_default();
        *count += 1;
        let at = StoredState::between(step, *count);
        by_name.entry(name).or_default().push((ends, at));
    }
    let of_name = |(name, bonds)| BrokenBonds {
        name,
        colour: OVER_FIELD,
        bonds,
    };
    Ok(by_name.into_iter().map(of_name).collect())
}

/// Gives each criterion of all cracks a colour of its own; black where there is only one, drawn over a field.
pub(super) fn paint(mut cracks: Vec<&mut Crack>, over_field: bool) {
    let kinds = cracks.iter().flat_map(|crack| &crack.kinds);
    let broken = kinds.filter(|kind| !kind.is_cut());
    let names: BTreeSet<String> = broken.map(|kind| kind.name.clone()).collect();
    if over_field && names.len() == 1 {
        return;
    }
    let kinds = cracks.iter_mut().flat_map(|crack| &mut crack.kinds);
    for kind in kinds.filter(|kind| !kind.is_cut()) {
        let place = names.iter().position(|it| *it == kind.name).unwrap_or(0);
        kind.colour = Colour::CYCLE[place % Colour::CYCLE.len()].rgb();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn crack(text: &str, follows_path: bool) -> Crack {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("breaks.csv"), text).unwrap();
        let mut crack = Crack::read(folder.path(), follows_path).unwrap();
        paint(vec![&mut crack], false);
        crack
    }

    const BREAKS: &str = "order,step,node_a,node_b,criterion\n1,2,5,6,tension\n2,3,6,7,frictional\n3,4,8,9,tension\n";

    #[test]
    fn bonds_are_grouped_by_criterion_up_to_the_step() {
        let crack = crack(BREAKS, false);
        let names: Vec<&str> = crack.kinds.iter().map(|it| it.name.as_str()).collect();
        assert_eq!(names, ["frictional", "tension"]);
        let of = |kind: usize, step: usize| crack.broken_until(&crack.kinds[kind], step.into());
        assert_eq!(of(1, 2), [[5, 6]]);
        assert_eq!(of(1, 9), [[5, 6], [8, 9]]);
        assert!(of(0, 2).is_empty());
        assert_ne!(crack.kinds[0].colour, crack.kinds[1].colour);
    }

    #[test]
    fn between_breakages_the_bonds_of_a_step_break_one_after_the_other() {
        let crack = crack(
            &BREAKS.replace("2,3,", "2,2,").replace("3,4,", "3,2,"),
            false,
        );
        let of = |state| {
            let kinds = crack.kinds.iter();
            kinds
                .map(|kind| crack.broken_until(kind, state).len())
                .sum::<usize>()
        };
        let states = [1, 2, 3].map(|count| of(StoredState::between(2, count)));
        assert_eq!(states, [1, 2, 3]);
        assert_eq!([of(StoredState::end(1)), of(StoredState::end(2))], [0, 3]);
    }

    /// On the exact path an output shows the state just before the bond of its event breaks.
    #[test]
    fn on_the_exact_path_bonds_break_after_the_output() {
        let crack = crack(BREAKS, true);
        let of = |step: usize| crack.broken_until(&crack.kinds[1], step.into()).len();
        assert_eq!([2, 3].map(of), [0, 1]);
    }
}
