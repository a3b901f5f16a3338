//! `ligament check`: everything up to the first solve, or the model alone, and what it takes.

mod body;
mod criteria;
mod equations;
mod modal;

use std::io::{self, Write};
use std::path::Path;

use ligament_analysis::connectivity::Fragments;
use ligament_analysis::gauges;
use ligament_analysis::probe::Reading;
use ligament_analysis::{ControlKind, Equilibrium};
use ligament_model::Elasticity;
use ligament_output::results::point_grid;

use ligament::Loading;
use ligament::body::Body;
use ligament::run::on_threads;
use ligament::setup::Analysis;
use ligament::setup::ELASTIC_ENERGY_TOLERANCE;
use ligament_case::case::{CaseFile, Control, Steps};
use ligament_case::setup::materials;
use ligament_run::gauges::words;
use ligament_run::model::{Model, build_model};
use ligament_run::progress::{Progress, ProgressMode};
use ligament_run::stages::{Stage, Stages};
use ligament_run::summary::{
    Spread, correction_line, family, formulation_line, heading, temperature_change,
};

/// How far a check goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Extent {
    /// Points, bonds and their correction; no matrix.
    Model,
    /// The symbolic analysis of the matrix as well.
    Matrix,
}

/// Builds the model of a case and reports it; with a folder, writes `points.vtu` with all fixed fields into it.
pub fn check(
    case: &CaseFile,
    extent: Extent,
    fields: Option<&Path>,
    out: &mut (dyn Write + Send),
) -> anyhow::Result<()> {
    on_threads(case.threads(), || check_here(case, extent, fields, out))?
}

/// Checks a case on the threads of the caller.
fn check_here(
    case: &CaseFile,
    extent: Extent,
    fields: Option<&Path>,
    out: &mut dyn Write,
) -> anyhow::Result<()> {
    let mut stages = Stages::default();
    let model = build_model(case, &mut stages, &Progress::new(ProgressMode::Quiet))?;
    match model.setup.analysis {
        Analysis::Modal(settings) => {
            modal::check(case, settings, extent, &model, &mut stages, out)?;
        }
        _ => check_loading(case, extent, &model, &mut stages, out)?,
    }
    write_stages(out, stages.done())?;
    let loose = Fragments::find(&*model.system, &vec![true; model.system.bonds.len()])
        .points
        .len();
    if loose > 1 {
        writeln!(
            out,
            "warning: the body consists of {loose} parts that no bond connects"
        )?;
    }
    for warning in &model.warnings {
        writeln!(out, "warning: {warning}")?;
    }
    if let Some(folder) = fields {
        std::fs::create_dir_all(folder)?;
        let path = folder.join("points.vtu");
        let cloud = &model.system.cloud;
        point_grid(
            &path,
            &model.body().grid(),
            &cloud.volumes,
            &cloud.spacing,
            &model.fixed,
        )?;
        writeln!(out, "fields written to {}", path.display())?;
    }
    Ok(())
}

/// Checks supports, loads and equations of a case with loads.
fn check_loading(
    case: &CaseFile,
    extent: Extent,
    model: &Model,
    stages: &mut Stages,
    out: &mut dyn Write,
) -> anyhow::Result<()> {
    let loading = Loading::new(&model.setup, &model.system).map_err(|it| case.located(it))?;
    let problem = loading.problem(&model.system, &model.criteria);
    let equilibrium = match extent {
        Extent::Model => None,
        Extent::Matrix => Some(stages.time("analysis", || {
            Equilibrium::new(&problem, ELASTIC_ENERGY_TOLERANCE)
        })?),
    };

    write_model(out, case, model)?;
    write_boundary(out, case, model.body(), &loading)?;
    for free in gauges::of_intact_body(&*model.system, &*loading.boundary) {
        writeln!(out, "  not held: {}", words(&free, model.body()))?;
    }
    write_loading(out, case)?;
    if let Some(equilibrium) = &equilibrium {
        equations::write(out, case, model, equilibrium.stiffness())?;
    }
    Ok(())
}

/// Writes what is known before supports and loads.
fn write_model(out: &mut dyn Write, case: &CaseFile, model: &Model) -> anyhow::Result<()> {
    writeln!(out, "{}", heading(&case.case.title))?;
    let volume = model.system.cloud.volumes.iter().sum();
    body::write(out, model.body(), volume)?;
    write_materials(out, case, model)?;
    write_bonds(out, case, model)?;
    criteria::write(out, case, model)?;
    Ok(write_energy_ratios(out, model)?)
}

fn write_stages(out: &mut dyn Write, stages: &[Stage]) -> io::Result<()> {
    writeln!(out, "time and memory")?;
    for stage in stages {
        writeln!(out, "  time, {:<15} {:.3} s", stage.name, stage.seconds)?;
    }
    let total: f64 = stages.iter().map(|stage| stage.seconds).sum();
    writeln!(out, "  time, all             {total:.3} s")?;
    if let Some(bytes) = stages.last().and_then(|stage| stage.peak_bytes) {
        writeln!(out, "  peak memory           {:.1} MB", bytes as f64 / 1e6)?;
    }
    Ok(())
}

fn write_materials(out: &mut dyn Write, case: &CaseFile, model: &Model) -> io::Result<()> {
    let cloud = &model.system.cloud;
    writeln!(out, "materials")?;
    for (index, material) in materials(case).iter().enumerate() {
        let volume: f64 = (0..cloud.len())
            .map(|point| cloud.shares(point)[index] * cloud.volumes[point])
            .sum();
        let name = if material.name.is_empty() {
            "the whole body"
        } else {
            &material.name
        };
        let constants = match material.elasticity {
            Elasticity::Isotropic(it) => format!("E = {:.4e} Pa, nu = {}", it.young, it.poisson),
            Elasticity::Orthotropic(it) => {
                let [young_1, young_2] = it.young;
                format!(
                    "E_1 = {young_1:.4e} Pa, E_2 = {young_2:.4e} Pa, nu_12 = {}, G = {:.4e} Pa, axis 1 at {} rad",
                    it.poisson, it.shear_modulus, it.angle
                )
            }
            Elasticity::Anisotropic(it) => {
                let c = it.stiffness;
                let of_rows = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)];
                let values = of_rows.map(|place| format!("{:.4e}", c[place]));
                format!("c11, c12, c16, c22, c26, c66 = {} Pa", values.join(", "))
            }
        };
        write!(out, "  {name}: {constants}, volume {volume:.6e} m^3")?;
        for (name, value, unit) in [
            ("F_t", material.tensile_strength, "Pa"),
            ("F_c", material.compressive_strength, "Pa"),
            ("G_c", material.fracture_energy, "J/m^2"),
            ("G_IIc", material.fracture_energy_sliding, "J/m^2"),
        ] {
            if let Some(value) = value {
                write!(out, ", {name} = {value:.4e} {unit}")?;
            }
        }
        if let Some(expansion) = material.expansion {
            let [one, two] = expansion.in_plane;
            write!(out, ", alpha = {one:.4e}")?;
            if one != two {
                write!(out, " and {two:.4e}")?;
            }
            write!(out, " 1/K")?;
        }
        match material.density {
            Some(density) => writeln!(out, ", mass {:.6e} kg", density * volume)?,
            None => writeln!(out)?,
        }
    }
    Ok(())
}

fn write_bonds(out: &mut dyn Write, case: &CaseFile, model: &Model) -> io::Result<()> {
    let spread = |out: &mut dyn Write, name: &str, values: Spread, unit: &str| {
        writeln!(
            out,
            "  {name:<21} {:.4e} to {:.4e}{unit}, mean {:.4e}",
            values.min, values.max, values.mean
        )
    };
    writeln!(out, "bonds")?;
    writeln!(
        out,
        "  bonds                 {} ({} cut by pre-cracks)",
        model.system.bonds.len(),
        model.cut_bonds
    )?;
    if !model.body().holes().is_empty() {
        writeln!(out, "  pairs across holes    {}", model.across_holes)?;
    }
    writeln!(out, "  points with no_fail   {}", model.no_fail_points)?;
    spread(
        out,
        "nearest distance",
        Spread::over(model.system.cloud.spacing.iter().copied()),
        " m",
    )?;
    spread(
        out,
        "horizon",
        Spread::over(model.fixed.horizon.iter().copied()),
        " m",
    )?;
    spread(out, "bonds of a point", family(model), "")?;
    writeln!(
        out,
        "  {}",
        formulation_line(case, model.setup.law.element())
    )?;
    writeln!(
        out,
        "  {}",
        correction_line(case, model.correction.as_ref())
    )?;
    spread(
        out,
        "correction factor",
        Spread::over(model.fixed.domain_factor.iter().copied()),
        "",
    )
}

fn write_energy_ratios(out: &mut dyn Write, model: &Model) -> io::Result<()> {
    writeln!(out, "strain energy of the points over the continuum's")?;
    let modes = ["uniaxial x", "uniaxial y", "biaxial", "shear"];
    for (mode, ratios) in modes.iter().zip(&model.fixed.energy_ratios) {
        let Spread { min, mean, max } = Spread::over(ratios.iter().copied());
        writeln!(out, "  {mode:<21} {min:.6} to {max:.6}, mean {mean:.6}")?;
    }
    Ok(())
}

fn write_boundary(
    out: &mut dyn Write,
    case: &CaseFile,
    body: &dyn Body,
    loading: &Loading,
) -> io::Result<()> {
    writeln!(out, "supports and loads")?;
    for group in &loading.boundary.groups {
        write_group(out, body, &group.name, &group.points)?;
    }
    if let Some(Spread { min, mean, max }) = temperature_change(&loading.boundary) {
        writeln!(
            out,
            "  temperature change    {min:.4e} to {max:.4e} K, mean {mean:.4e}"
        )?;
    }
    let control = &loading.boundary.control;
    let (count, size, units) = (control.points.len(), control.magnitude, case.case.units());
    match control.kind {
        ControlKind::Temperature => writeln!(
            out,
            "  controlled by         the temperature, size {size:.4e} {}",
            units.displacement
        )?,
        ControlKind::Displacement => writeln!(
            out,
            "  controlled by         {count} points, size {size:.4e} {}",
            units.displacement
        )?,
        ControlKind::Force => writeln!(
            out,
            "  controlled by         {count} points, size {size:.4e} {}",
            units.force
        )?,
    }
    for probe in loading.probes.iter() {
        let reads = match &probe.reading {
            Reading::RelativeDisplacement { points, .. } => {
                points.map(|point| body.place(point)).join(" to ")
            }
            Reading::Field { point, .. } => body.place(*point),
            Reading::SectionForce { bonds, .. } => format!("{} bonds", bonds.len()),
        };
        writeln!(out, "  probe {:<15} {reads}", probe.name)?;
    }
    Ok(())
}

fn write_group(out: &mut dyn Write, body: &dyn Body, name: &str, points: &[u32]) -> io::Result<()> {
    let where_at = match points {
        [only] => body.place(*only),
        points => format!("{} points", points.len()),
    };
    writeln!(out, "  {name:<21} {where_at}")
}

fn write_loading(out: &mut dyn Write, case: &CaseFile) -> io::Result<()> {
    let loading = match case.case.fracture.as_ref().map(|it| &it.control) {
        None => "one elastic solution at load factor 1".to_owned(),
        Some(Control::Stepped(stepping)) => match &stepping.steps {
            Steps::Uniform(count) => format!("{count} load steps"),
            Steps::Factors(factors) => format!("{} load steps", factors.len()),
        },
        Some(Control::Event) => {
            "exact path from breakage to breakage, up to load factor 1".to_owned()
        }
    };
    writeln!(out, "  followed in           {loading}")
}
