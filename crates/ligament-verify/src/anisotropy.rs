//! First yield on irregular meshes, compared with lattices: effect of the bonds' directions on criteria.

use std::sync::Arc;

use anyhow::Context;
use ligament_model::failure::Criteria;
use ligament_post::yielding::field::{Distribution, families, mean_error};
use ligament_post::yielding::{Family, PrincipalStretches, lattice};

use super::experiment::{Compute, Experiment, Findings};
use super::published::published;
use super::table::{Extent, LabelError, Labels, Table};
use super::trial::{Memory, StoredMesh, Template, stored_mesh, template};
use ligament_plot::plots::{Colour, Mark, Plot, Series};
use ligament_run::model::Model;
use ligament_study::yielding::criteria::{Combination, Strengths};

/// The experiment.
pub(super) const EXPERIMENT: Experiment = Experiment {
    name: "anisotropy",
    title: "First yield on irregular meshes",
    source: "closed form, independent calculation",
    setup: "Families of the interior points (no neighbour on the rim) of a disk of 2 mm cells (Delaunay, 2,948 points) and a \
            plate of 4 mm cells (frontal Delaunay, 1,543 points), NHPD with lambda = 2, 3 and 4, nu = 0.21, beside the lattice \
            whose families have as many bonds as theirs in the mean (m = 2, 3 and 4). For each point a uniform strain is turned through \
            all orientations; its error is how much later the orientation that yields last yields than the one that yields \
            first. `stretch` and `sliding` have one limit for all bonds: the directions alone decide. `strength` is the \
            criterion of NHPD, whose s_0 differs from bond to bond. \
            What it says of irregular meshes: on the disk a family errs less than the lattice of its size in the mean (stretch, lambda = \
            3: 3.2 against 5.6 %), its worst directions are its own, and at an orientation common to all points the mean error hardly \
            varies (0.3 %), so that no path of cracks is preferred, while single families may err twice as much as the lattice. \
            The frontal algorithm fills the plate with nearly equilateral triangles: that is a triangular lattice, whose families all err \
            in the same directions. With the strength of NHPD the scatter of s_0 among the bonds of a family outweighs their directions \
            (disk: 38 to 17 % in the mean), and more bonds help little; its common part is small on the disk again.",
    cases: &[&DISK, &PLATE],
    compute: Compute::Code(compute),
};

static DISK: Template = template!("brazilian-disk/case.toml");
static PLATE: Template = template!("plate-tension/case.toml");

static DISK_MESH: StoredMesh = stored_mesh!("disk-2mm-platen-1.5mm.msh");
static PLATE_MESH: StoredMesh = stored_mesh!("plate.msh");

/// Strengths for limits that are equal for all bonds; the errors under one measure do not depend on them.
const STRENGTHS: Strengths = Strengths::OF_THE_TABLES;

fn compute(extent: Extent) -> anyhow::Result<Findings> {
    let mut memory = Memory::default();
    let table =
        published!("mesh-anisotropy").judge(extent, |labels| statistic(labels, &mut memory))?;
    let plots = vec![
        plot(&table, "stretch", "extension")?,
        plot(&table, "sliding", "shear")?,
        plot(&table, "strength", "extension")?,
    ];
    Ok(Findings {
        tables: vec![table],
        plots,
        ..Findings::default()
    })
}

fn strains(labels: Labels<'_>) -> Result<PrincipalStretches, LabelError> {
    Ok(match labels.text("strain")? {
        "extension" => PrincipalStretches::new(1.0, 0.0),
        _ => PrincipalStretches::new(1.0, -1.0),
    })
}

fn uniform(criterion: &str, n_bonds: usize) -> anyhow::Result<Criteria> {
    let combination: Combination = criterion.parse().map_err(anyhow::Error::msg)?;
    Ok(combination.criteria(&STRENGTHS, n_bonds)?)
}

/// The error of the lattice whose families have about `size` bonds, %.
fn on_lattice(size: f64, criterion: &str, strains: PrincipalStretches) -> anyhow::Result<f64> {
    let directions = lattice::directions(lattice::ratio_of_size(size));
    let criteria = uniform(criterion, directions.len())?;
    let worst = Family::of_directions(&directions, &criteria).worst(strains);
    Ok(100.0 * worst.context("nothing yields")?.error)
}

/// The criterion of an entry: for stretch only its limit in tension, so that compression does not limit pure shear.
fn criterion(labels: Labels<'_>) -> Result<&str, LabelError> {
    Ok(match labels.text("criterion")? {
        "stretch" => "tension",
        other => other,
    })
}

/// Statistics of the errors on a mesh.
#[derive(Debug, Clone)]
struct Anisotropy {
    /// Mean number of bonds of an interior point.
    size: f64,
    /// Errors of the interior points.
    errors: Distribution,
    /// Largest minus smallest mean error over all points at one orientation.
    range: f64,
}

fn statistic(labels: Labels<'_>, memory: &mut Memory<Anisotropy>) -> anyhow::Result<f64> {
    let (template, mesh) = match labels.text("mesh")? {
        "disk" => (&DISK, &DISK_MESH),
        _ => (&PLATE, &PLATE_MESH),
    };
    let trial = (template.trial())
        .set("model.horizon_factor", labels.number("lambda")?)
        .set("material.poisson", 0.21)
        .set("material.tensile_strength", 3.81e6)
        .set("fracture.steps", 1)
        .on_mesh(mesh);
    let (name, strains) = (criterion(labels)?, strains(labels)?);
    let key = format!("{} {name} {strains:?}", trial.command());
    let found = memory.result(key, || anisotropy(&trial.model()?, name, strains))?;
    let Distribution {
        mean,
        percentile_5,
        percentile_95,
        worst,
        ..
    } = found.errors;
    Ok(match labels.text("statistic")? {
        "bonds" => found.size,
        "mean" => 100.0 * mean,
        "5 %" => 100.0 * percentile_5,
        "95 %" => 100.0 * percentile_95,
        "worst" => 100.0 * worst,
        "common" => 100.0 * found.range,
        _ => on_lattice(found.size, name, strains)?,
    })
}

fn anisotropy(
    model: &Model,
    criterion: &str,
    strains: PrincipalStretches,
) -> anyhow::Result<Anisotropy> {
    let system = model.plane();
    let criteria = match criterion {
        "strength" => model.criteria.clone(),
        other => Arc::new(uniform(other, system.bonds.len())?),
    };
    let is_interior = model.interior(&model.body().rim());
    let yields = families(system, &criteria, |_| strains);
    let inside: Vec<u32> = (0..)
        .zip(&is_interior)
        .filter(|(_, is_in)| **is_in)
        .map(|(point, _)| point)
        .collect();
    let sizes = inside
        .iter()
        .map(|&point| system.bonds.incidence.at(point).len() as f64);
    let errors = inside
        .iter()
        .filter_map(|&point| Some(yields[point as usize]?.worst.error));
    let errors = Distribution::from_values(errors.collect()).context("nothing yields")?;
    let (mut lowest, mut highest) = (f64::INFINITY, 0.0);
    for degrees in 0..180u32 {
        let orientation = f64::from(degrees).to_radians();
        let mean = mean_error(system, &criteria, strains, &inside, orientation);
        let mean = mean.context("nothing yields")?;
        (lowest, highest) = (f64::min(lowest, mean), f64::max(highest, mean));
    }
    Ok(Anisotropy {
        size: sizes.sum::<f64>() / inside.len() as f64,
        errors,
        range: highest - lowest,
    })
}

/// Plot of the statistics over lambda, compared with the lattice.
fn plot(table: &Table, criterion: &str, strain: &str) -> Result<Plot, LabelError> {
    let mut series = Vec::new();
    for (mesh, colour, of_lattice) in [
        ("disk", Colour::Blue, Colour::Sky),
        ("plate", Colour::Vermilion, Colour::Orange),
    ] {
        for (statistic, label, mark, colour) in [
            ("mean", format!("{mesh}, mean"), Mark::Line, colour),
            ("5 %", format!("{mesh}, 5 and 95 %"), Mark::Dashes, colour),
            ("95 %", String::new(), Mark::Dashes, colour),
            ("worst", format!("{mesh}, worst"), Mark::Circles, colour),
            (
                "lattice",
                format!("lattice, as {mesh}"),
                Mark::Line,
                of_lattice,
            ),
        ] {
            let of = format!(
                "mesh={mesh}, criterion={criterion}, strain={strain}, statistic={statistic}"
            );
            let points = table.computed("lambda", &of)?;
            series.push(Series::new(label, mark, colour, points));
        }
    }
    Ok(Plot::new(
        format!("mesh-anisotropy-{criterion}"),
        format!("Error of first yield on meshes: {criterion}, {strain}"),
        ["horizon factor lambda", "error, %"],
        series,
    ))
}
