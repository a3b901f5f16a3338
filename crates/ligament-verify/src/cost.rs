//! The cost of imaginary elements, compared with pairs of points (MBB-PD, introduction and conclusion 1).

use anyhow::bail;

use super::equations::Equations;
use super::experiment::{Compute, Experiment, Findings};
use super::published::published;
use super::table::{Extent, Labels};
use super::trial::{Memory, Template, template};

/// The experiment.
pub(super) const EXPERIMENT: Experiment = Experiment {
    name: "cost",
    title: "Cost of imaginary elements",
    source: "count by hand; Masoumi, Ravandi and Salehi (MBB-PD), introduction and conclusion 1",
    setup: "Plate 100 x 100 mm on a lattice with m = 3, with the laws bbpd, pds and mbb-pd: unknowns, bonds, entries of one triangle of \
            the stiffness, values of its Cholesky factor and multiplications that make it, with the order of elimination that the program \
            chooses. The time of a run goes with these numbers; it is no entry, as it is another on every machine.",
    cases: &[&PLATE],
    compute: Compute::Code(compute),
};

static PLATE: Template = template!("mbb-plate/tension.toml");

/// Side of the plate, m.
const SIDE: f64 = 0.1;

fn compute(extent: Extent) -> anyhow::Result<Findings> {
    let mut models = Memory::default();
    let mut cost = |labels: Labels<'_>, law: &str| -> anyhow::Result<f64> {
        let d = labels.number("d")?;
        let cells = (1e3 * SIDE / d).round() as u32;
        let trial = (PLATE.trial())
            .on_lattice([cells, cells], 1e-3 * d)
            .set("model.law", law)
            .set(
                "material.poisson",
                if law == "bbpd" { 1.0 / 3.0 } else { 0.3 },
            );
        let (bonds, equations) = models.result(trial.command(), || {
            let model = trial.model()?;
            Ok((
                model.plane().bonds.len() as f64,
                Equations::from_model(&model)?,
            ))
        })?;
        Ok(match labels.text("of")? {
            "unknowns" => equations.unknowns,
            "bonds" => bonds,
            "entries" => equations.matrix,
            "factor" => equations.factor,
            "multiplications" => equations.multiplications,
            other => bail!("`{other}` is no cost"),
        })
    };
    let counts =
        published!("mbb-counts").judge(extent, |labels| cost(labels, labels.text("law")?))?;
    let ratios = published!("mbb-cost").judge(extent, |labels| {
        Ok(cost(labels, labels.text("law")?)? / cost(labels, "bbpd")?)
    })?;
    Ok(Findings {
        tables: vec![counts, ratios],
        plots: Vec::new(),
        ..Findings::default()
    })
}
