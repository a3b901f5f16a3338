//! A bar that spalls where a reflected pulse of pressure becomes tension.

use anyhow::{Context, bail};

use crate::crack_path::middle;
use crate::experiment::{Compute, Experiment, Findings};
use crate::published::published;
use crate::table::{Extent, Labels};
use crate::trial::{Memory, Template, template};

/// The experiment.
pub(crate) const EXPERIMENT: Experiment = Experiment {
    name: "motion_spall",
    title: "A bar that spalls",
    source: "closed form: the incident pulse less the reflected one; Bohus granite",
    setup: "Bar of granite, 140 mm long, rho = 2660 kg/m^3, c = 4050 m/s (E = 43.63 GPa, nu = 0), tensile strength 18.9 MPa, `bond-rankine`, NHPD, patch \
            correction, lambda = 3. A pressure on its left end grows to 41.5 MPa in 8 us and falls to zero in 32 us. The peak comes back from the free end, and the \
            stress first reaches the strength at d = F_t c 32 us/(2 x 41.5 MPa) = 29.5 mm from this end, 140 mm/c + 8 us + d/c after the beginning. Distance and time of \
            the first broken bond.",
    cases: &[&CASE],
    compute: Compute::Code(compute),
};

static CASE: Template = template!("verification/motion-spall.toml");

/// Length of the bar, mm.
const LENGTH: f64 = 140.0;

fn compute(extent: Extent) -> anyhow::Result<Findings> {
    let mut memory = Memory::default();
    let table = published!("motion-spall").judge(extent, |labels| first(labels, &mut memory))?;
    Ok(Findings {
        tables: vec![table],
        ..Findings::default()
    })
}

/// Distance (mm) from the free end, or time (us), of the first broken bond.
fn first(labels: Labels<'_>, memory: &mut Memory<[f64; 2]>) -> anyhow::Result<f64> {
    let spacing = labels.number("h, mm")?;
    let cells = [LENGTH, 2.0].map(|length| (length / spacing).round() as u32);
    let trial = CASE.trial().on_lattice(cells, 1e-3 * spacing);
    let [distance, time] = memory.reading_with_breakages(&trial, |solution, records| {
        let first = records.first().context("no bond breaks")?;
        let [x, _] = middle(&solution.model, first.bond as usize).at;
        Ok([LENGTH - 1e3 * x, 1e6 * first.load_factor])
    })?;
    Ok(match labels.text("of")? {
        "distance, mm" => distance,
        "time, us" => time,
        other => bail!("no quantity `{other}`"),
    })
}
