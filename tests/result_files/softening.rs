//! What `softening.csv` should hold.

use ligament_analysis::history::{StepRecord, View};
use ligament_model::failure::Weakened;

use super::expected::{Entry, Expected, Rows};

/// Bonds that began to soften, and whose force fell below a half, a quarter and a tenth, step by step.
pub(crate) struct Softened {
    rows: Rows,
    /// Rows that each bond has so far.
    told: Vec<usize>,
}

impl Softened {
    pub(crate) fn new(tagged: &str, n_bonds: usize) -> Self {
        let columns = ["step", "load_factor", "displacement", "reaction", "event"];
        let ends = ["a", "b"].map(|end| format!("{tagged}_{end}"));
        let columns = columns.map(str::to_owned).into_iter().chain(ends);
        Self {
            rows: Rows::new(columns.chain(["criterion".to_owned()])),
            told: vec![0; n_bonds],
        }
    }

    /// Adds a step; `tags` gives the tags of the ends of a bond.
    pub(crate) fn step(
        &mut self,
        record: &StepRecord,
        view: &View<'_>,
        tags: impl Fn(usize) -> [usize; 2],
        labels: &[String],
    ) {
        let softening = &view.state.softening;
        let mut news = Vec::new();
        for bond in 0..self.told.len() {
            // Of the criteria with something to tell, the one that the bond is farthest beyond.
            let of = |criterion: usize| {
                let largest = *softening.largest[criterion].get(bond)?;
                let opens =
                    view.criteria.criteria().list[criterion].measure.weakens() == Weakened::Opening;
                let force = softening
                    .bond(view.criteria.criteria(), criterion, bond)
                    .force;
                let below = [0.5, 0.25, 0.1]
                    .into_iter()
                    .filter(|share| opens && force < *share);
                let rows = if largest > 1.0 { 1 + below.count() } else { 0 };
                (rows > self.told[bond]).then_some((largest, criterion, rows))
            };
            let all = (0..softening.largest.len()).filter_map(of);
            if let Some(it) = all.reduce(|best, it| if it.0 > best.0 { it } else { best }) {
                news.push((bond, it));
            }
        }
        news.sort_by(|(_, one), (_, other)| other.0.total_cmp(&one.0));
        for (bond, (_, criterion, rows)) in news {
            for event in &["begins", "half", "quarter", "opens"][self.told[bond]..rows] {
                let [a, b] = tags(bond);
                let row: [Entry; 8] = [
                    record.step.into(),
                    record.load_factor.into(),
                    record.displacement.into(),
                    record.reaction.into(),
                    (*event).into(),
                    a.into(),
                    b.into(),
                    labels[criterion].as_str().into(),
                ];
                self.rows.push(row);
            }
            self.told[bond] = rows;
        }
    }

    pub(crate) fn into_expected(self, expected: &mut Expected) {
        self.rows.into_expected("softening.csv", expected);
    }
}
