//! Explicit against implicit steps.

use std::collections::BTreeSet;

use super::experiment::{Compute, Experiment, Findings};
use super::published::known;
use super::table::{Extent, Labels};
use super::trial::{Memory, Trial};

/// The experiment.
pub(super) const EXPERIMENT: Experiment = Experiment {
    name: "motion_schemes",
    title: "Explicit against implicit steps",
    source: "two schemes for the same equations",
    setup: "The plate of `motion_branching` (Borden) with 100 x 40 points of 1 mm, bbpd, both schemes with steps of 0.1 us. Bonds that are broken by both up to a \
            time over those that one of them broke more of.",
    cases: &[CASE],
    compute: Compute::Code(compute),
};

const CASE: &str = "cases/branching/case.toml";

fn compute(extent: Extent) -> anyhow::Result<Findings> {
    let mut memory = Memory::default();
    let table = known("motion-schemes")?.judge(extent, |labels| common(labels, &mut memory))?;
    Ok(Findings {
        tables: vec![table],
        ..Findings::default()
    })
}

/// Share of the bonds that break in both schemes up to a time.
fn common(labels: Labels<'_>, memory: &mut Memory<Vec<(u32, f64)>>) -> anyhow::Result<f64> {
    let until = 1e-6 * labels.number("time, us")?;
    let mut broken = |scheme: &str| {
        let trial = (Trial::of_file(CASE)?)
            .on_lattice([100, 40], 1e-3)
            .set("motion.duration", 30e-6)
            .set("motion.rows", 30)
            .set("motion.step", 1e-7)
            .set("motion.scheme", scheme);
        let all = memory.reading_with_breakages(&trial, |_, records| {
            let all = records.iter();
            Ok(all.map(|it| (it.bond, it.load_factor)).collect())
        })?;
        let early = all.into_iter().filter(|(_, time)| *time <= until);
        anyhow::Ok(early.map(|(bond, _)| bond).collect::<BTreeSet<u32>>())
    };
    let (explicit, implicit) = (broken("explicit")?, broken("implicit")?);
    let both = explicit.intersection(&implicit).count();
    Ok(both as f64 / explicit.len().max(implicit.len()) as f64)
}
