//! First yield of lattices: the printed errors over orientation, and the calibration of the criteria on a bar.

use anyhow::Context;
use ligament_model::failure::{Calibration, Choice, frictional, sliding, stretch};
use ligament_post::yielding::{Family, PrincipalStretches, lattice, printed_orientations};

use super::case_run::CaseRun;
use super::experiment::{Compute, Experiment, Findings};
use super::published::known_table;
use super::table::{Extent, Labels, Table};
use ligament_plot::plots::{Colour, Plot, Series};
use ligament_study::yielding::criteria::{Combination, Strengths};

/// Experiment of the first yield of families.
pub(super) const EXPERIMENT: Experiment = Experiment {
    name: "yielding",
    title: "First yield of lattices",
    source: "Diana and Casolo 2019 (MPPD), Tables 7 to 9; closed form",
    setup: "Families of a square lattice with horizons of m = 2 to 5 spacings (12 to 80 bonds) under a uniform strain with \
            the principal stretches s_1 and s_2, turned by 0 to 90 degrees in 101 steps; nu = 0, compressive limit three \
            times the tensile one. The error is the one of the orientation that yields last, as `ligament yield` computes \
            it. A bar: the strains of a bar of E = 70 GPa, F_t = 1 MPa, F_c = 3 MPa, on the criteria that a case gives the \
            bonds of a lattice, in the worst direction of a bond.",
    cases: &[CASE],
    compute: Compute::Code(compute),
};

const CASE: &str = "cases/verification/lattice.toml";

/// Strengths as in the paper's tables.
const STRENGTHS: Strengths = Strengths::TABLE_STRENGTHS;

/// Young's modulus and tensile strength of the bar, Pa.
const YOUNG: f64 = 70e9;
const TENSILE_STRENGTH: f64 = 1e6;

const RATIOS: [(f64, Colour); 5] = [
    (2.0, Colour::Blue),
    (3.0, Colour::Vermilion),
    (3.2, Colour::Green),
    (4.0, Colour::Purple),
    (5.0, Colour::Orange),
];

fn compute(extent: Extent) -> anyhow::Result<Findings> {
    let printed = |table: &str, criterion: &str| -> anyhow::Result<Table> {
        let combination = named(criterion)?;
        known_table(table)?.judge(extent, |labels| {
            let directions = lattice::directions(labels.number("m")?);
            let worst = combination.printed_measure(&STRENGTHS, &directions, path(labels)?)?;
            Ok(100.0 * worst.context("nothing yields")?.error)
        })
    };
    let frictional = named("frictional")?;
    let first_yield = known_table("first-yield-frictional")?.judge(extent, |labels| {
        let directions = lattice::directions(labels.number("m")?);
        let criteria = frictional.criteria(&STRENGTHS, directions.len())?;
        let family = Family::from_directions(&directions, &criteria);
        let worst = family.worst_of(path(labels)?, printed_orientations());
        Ok(100.0 * worst.context("nothing yields")?.error)
    })?;
    let tables = vec![
        printed("mppd-table-7", "stretch")?,
        printed("mppd-table-8", "sliding")?,
        printed("mppd-table-9", "frictional")?,
        first_yield,
        known_table("bar-yield")?.judge(extent, bar_yield)?,
    ];
    let plots = ["stretch", "sliding", "frictional"].map(orientation_plot);
    Ok(Findings {
        tables,
        plots: plots.into_iter().collect::<anyhow::Result<_>>()?,
        ..Findings::default()
    })
}

fn named(criterion: &str) -> anyhow::Result<Combination> {
    criterion.parse().map_err(anyhow::Error::msg)
}

fn path(labels: Labels<'_>) -> anyhow::Result<PrincipalStretches> {
    Ok(PrincipalStretches::new(
        labels.number("s1")?,
        labels.number("s2")?,
    ))
}

/// Stress of a bar at first yield over its tensile strength, under the criterion of an entry.
fn bar_yield(labels: Labels<'_>) -> anyhow::Result<f64> {
    let frictional = |calibration| Choice {
        calibration: Some(calibration),
        ..frictional::FRICTIONAL.into()
    };
    let choices = match (labels.text("criterion")?, labels.text("calibration")?) {
        ("stretch", _) => vec![stretch::TENSION.into(), stretch::COMPRESSION.into()],
        ("sliding", _) => vec![sliding::SLIDING.into()],
        (_, "two-point") => vec![frictional(Calibration::TwoPoint)],
        _ => vec![frictional(Calibration::Printed)],
    };
    let nu = labels.number("nu")?;
    let case_run = CaseRun::from_file(CASE)?.set("material.poisson", nu);
    let case_run = case_run
        .set("material.tensile_strength", TENSILE_STRENGTH)
        .set("material.compressive_strength", 3.0 * TENSILE_STRENGTH)
        .set("fracture.steps", 1);
    let model = case_run.model_with(|setup| setup.criteria = choices)?;
    let middle = model.plane().cloud.nearest_point([0.0, 0.0]);
    let family = Family::at_point(model.plane(), &model.criteria, middle);
    let sign = match labels.text("bar")? {
        "tension" => 1.0,
        _ => -1.0,
    };
    let strain = sign * TENSILE_STRENGTH / YOUNG;
    let strains = PrincipalStretches::new(strain, -nu * strain);
    Ok(1.0 / family.theoretical_utilisation(strains))
}

/// Plot of the errors of a simple extension over its orientation (MPPD Figs 28 and 30).
fn orientation_plot(criterion: &str) -> anyhow::Result<Plot> {
    let combination = named(criterion)?;
    let extension = PrincipalStretches::new(1.0, 0.0);
    let mut series = Vec::new();
    for (ratio, colour) in RATIOS {
        let directions = lattice::directions(ratio);
        let criteria = combination.criteria(&STRENGTHS, directions.len())?;
        let family = Family::from_directions(&directions, &criteria);
        let point = |orientation: f64| {
            let error = family.error(extension, orientation)?;
            Some([orientation.to_degrees(), 100.0 * error])
        };
        let points = printed_orientations().filter_map(point).collect();
        let name = format!("m = {ratio}");
        series.push(Series::curve(name, colour, points));
    }
    Ok(Plot::new(
        format!("first-yield-{criterion}"),
        format!("Simple extension, error of first yield: {criterion}"),
        ["orientation, degrees", "error, %"],
        series,
    ))
}
