//! Elastic constants of lattices under the bond laws, compared with the given constants.

use ligament_model::law::{Calibration, LAWS};
use ligament_model::moduli::{EngineeringConstants, family_stiffness};

use anyhow::Context;

use super::experiment::{Compute, Experiment, Findings};
use super::published::{Published, published};
use super::table::{Extent, LabelError, Labels, Table};
use super::trial::{Memory, Template, template};
use ligament_plot::plots::{Colour, Plot, Series};

/// The experiment.
pub(super) const EXPERIMENT: Experiment = Experiment {
    name: "moduli",
    title: "Elastic constants of lattices",
    source: "closed form, independent calculation",
    setup: "The middle point of 37 x 37 points, far from the sides: stiffness of its family under uniform strains, \
            from it E, nu and G along the lattice. E = 70 GPa, plane stress; horizons of m = 2 to 8 spacings, \
            partial volumes and the surface correction by volumes (none with discrete calibration, which sums over \
            the family). PDS and MPPD are the same here. How much of a family lies inside its partial volumes \
            decides what other horizons miss; the beam form (MPPD eqs 42, 43) weighs short bonds more, and sums \
            over the family in place of integrals halve what E and nu miss and overshoot G.",
    cases: &[&CASE],
    compute: Compute::Code(compute),
};

static CASE: Template = template!("verification/lattice.toml");

/// Young's modulus of the case, Pa.
const YOUNG: f64 = 70e9;

fn compute(extent: Extent) -> anyhow::Result<Findings> {
    let mut memory = Memory::default();
    let mut judge = |table: Published| {
        table.judge(extent, |labels| {
            let nu = labels.number("nu")?;
            let constants = constants(labels, nu, &mut memory)?;
            Ok(match labels.text("constant")? {
                "E" => constants.young[0] / YOUNG,
                "G" => constants.shear_modulus.at(0, 1) * 2.0 * (1.0 + nu) / YOUNG,
                _ => constants.poisson[0][1],
            })
        })
    };
    let tables = vec![
        judge(published!("moduli"))?,
        judge(published!("moduli-horizons"))?,
    ];
    let plots = vec![
        plot(&tables[1], "E", "E over its input")?,
        plot(&tables[1], "nu", "nu (input 0.25, BBPD 1/3)")?,
    ];
    Ok(Findings {
        tables,
        plots,
        ..Findings::default()
    })
}

/// Whether the default constants of a law are sums over the families.
fn is_of_sums(word: &str) -> bool {
    let mut laws = LAWS.into_iter().filter(|law| law.word == word);
    laws.any(|law| law.options.calibration == Some(Calibration::Discrete))
}

/// The constants in the middle of the lattice of an entry.
fn constants(
    labels: Labels<'_>,
    nu: f64,
    memory: &mut Memory<EngineeringConstants>,
) -> anyhow::Result<EngineeringConstants> {
    let law = labels.text("law")?.to_lowercase();
    let trial = CASE.trial().set("material.poisson", nu);
    let trial = trial.set("model.horizon_factor", labels.number("m")?);
    let trial = match law.split_once(' ') {
        Some((law, calibration)) => {
            let trial = trial
                .set("model.law", law)
                .set("model.calibration", calibration);
            trial.set("correction.surface", "none")
        }
        None if is_of_sums(&law) => trial
            .set("model.law", law)
            .set("model.calibration", "integral"),
        None => trial.set("model.law", law),
    };
    memory.result(trial.command(), || {
        let model = trial.model()?;
        let system = model.plane();
        let middle = system.cloud.nearest_point([0.0, 0.0]);
        EngineeringConstants::from_stiffness(family_stiffness(system, middle))
            .context("the family has no stiffness")
    })
}

/// Plot of a constant over the horizon.
fn plot(table: &Table, constant: &str, axis: &str) -> Result<Plot, LabelError> {
    let laws = [
        ("BBPD", "1/3", Colour::Green),
        ("MPPD", "0.25", Colour::Vermilion),
        ("MPPD-beam", "0.25", Colour::Orange),
        ("MPPD-beam discrete", "0.25", Colour::Purple),
    ];
    let mut series = Vec::new();
    for (law, nu, colour) in laws {
        let of = format!("law={law}, nu={nu}, constant={constant}");
        series.push(Series::line(law, colour, table.computed("m", &of)?));
    }
    Ok(Plot::new(
        format!("moduli-{constant}"),
        format!("Elastic constants of lattices: {constant}"),
        ["horizon over spacing, m", axis],
        series,
    ))
}
