//! Report of `ligament check` on the model, before supports and loads.

use std::io;

use ligament::body::Origin;
use ligament::setup::Section;
use ligament_case::case::CaseFile;
use ligament_model::{Elasticity, Plane};
use ligament_output::quantity::quantity;
use ligament_output::summary::Spread;
use ligament_run::model::Model;
use ligament_run::summary::{analysis_words, correction_line, family, formulation_line, heading};

use super::report::{Report, spread};
use super::{body, criteria};

/// Writes the report on the model.
pub(super) fn write(report: &mut Report<'_>, case: &CaseFile, model: &Model) -> anyhow::Result<()> {
    report.line(heading(&case.case.title))?;
    report.line(analysis_words(&model.setup))?;
    let volume = model.system.volumes.iter().sum();
    body::write(report, model.body(), volume)?;
    body::write_refinement(report, model)?;
    write_section(report, model)?;
    write_materials(report, model)?;
    write_bonds(report, model)?;
    criteria::write(report, model)?;
    Ok(write_energy_ratios(report, model)?)
}

fn write_section(report: &mut Report<'_>, model: &Model) -> io::Result<()> {
    let Section::Plane { state, thickness } = model.setup.section else {
        return Ok(());
    };
    let state = match state {
        Plane::Stress => "plane stress",
        Plane::Strain => "plane strain",
    };
    let thickness = quantity(thickness, "m");
    report.entry("thickness", format!("{thickness}, {state}"))
}

fn write_materials(report: &mut Report<'_>, model: &Model) -> io::Result<()> {
    report.head("materials");
    for (index, material) in model.setup.materials().iter().enumerate() {
        let volume = model.volume_of_material(index);
        let name = if material.name.is_empty() {
            "the whole body"
        } else {
            &material.name
        };
        let constants = constants(&material.elasticity);
        let mut words = format!("{name}: {constants}, volume {}", quantity(volume, "m^3"));
        for (name, value, unit) in [
            ("F_t", material.tensile_strength, "Pa"),
            ("F_c", material.compressive_strength, "Pa"),
            ("G_c", material.fracture_energy, "J/m^2"),
            ("G_IIc", material.fracture_energy_sliding, "J/m^2"),
        ] {
            if let Some(value) = value {
                words += &format!(", {name} = {}", quantity(value, unit));
            }
        }
        if let Some(expansion) = material.expansion {
            let [one, two] = expansion.in_plane;
            words += &format!(", alpha = {}", quantity(one, "1/K"));
            if one != two {
                words += &format!(" and {}", quantity(two, "1/K"));
            }
        }
        if let Some(density) = material.density {
            words += &format!(", mass {}", quantity(density * volume, "kg"));
        }
        report.words(words)?;
    }
    Ok(())
}

/// Text of elastic constants.
fn constants(elasticity: &Elasticity) -> String {
    match *elasticity {
        Elasticity::Isotropic(it) => {
            format!("E = {}, nu = {}", quantity(it.young, "Pa"), it.poisson)
        }
        Elasticity::Orthotropic(it) => {
            let [young_1, young_2, shear] =
                [it.young[0], it.young[1], it.shear_modulus].map(|it| quantity(it, "Pa"));
            format!(
                "E_1 = {young_1}, E_2 = {young_2}, nu_12 = {}, G = {shear}, axis 1 at {} rad",
                it.poisson, it.angle
            )
        }
        Elasticity::Anisotropic(it) => {
            let c = it.stiffness;
            let of_rows = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)];
            let values = of_rows.map(|place| quantity(c[place], "Pa"));
            format!("c11, c12, c16, c22, c26, c66 = {}", values.join(", "))
        }
    }
}

fn write_bonds(report: &mut Report<'_>, model: &Model) -> io::Result<()> {
    let (system, fixed) = (&model.system, &model.fixed);
    let over = |values: &[f64]| Spread::over(values.iter().copied());
    report.head("bonds");
    let (bonds, cut) = (model.counts.bonds, model.cut_bonds());
    report.entry("bonds", format!("{bonds} ({cut} cut by pre-cracks)"))?;
    let has_holes = match model.body().origin() {
        Origin::Lattice(lattice) => !lattice.holes.is_empty(),
        Origin::SolidLattice(lattice) => !lattice.holes.is_empty(),
        Origin::Mesh(_) | Origin::SolidMesh(_) | Origin::Points => false,
    };
    if has_holes || model.across_voids() > 0 {
        report.entry("pairs across voids", model.across_voids())?;
    }
    if model.counts.across_layers > 0 {
        report.entry("through a layer", model.counts.across_layers)?;
    }
    if model.counts.far_points > 0 {
        let elements = format!("{} points of elements", model.counts.far_points);
        report.entry("far field", elements)?;
    }
    if model.counts.volumetric_cells > 0 {
        let cells = model.counts.volumetric_cells;
        report.entry("cells", format!("{cells} carry volumetric stiffness"))?;
    }
    if model.no_fail_points() > 0 {
        report.entry("points with no_fail", no_fail_words(model))?;
    }
    report.detail("nearest distance", spread(over(&system.spacing), "m"))?;
    report.entry("horizon", spread(over(&fixed.horizon), "m"))?;
    let Spread { min, mean, max } = family(model);
    let of_points = format!("{min} to {max}, mean {mean:.1}");
    report.entry("bonds of a point", of_points)?;
    report.words(formulation_line(&model.setup))?;
    report.words(correction_line(
        &model.setup.correction,
        model.correction.as_ref(),
    ))?;
    report.detail("correction factor", spread(over(&fixed.domain_factor), "-"))
}

fn write_energy_ratios(report: &mut Report<'_>, model: &Model) -> io::Result<()> {
    report.head("strain energy of the points over the continuum's");
    for ratios in &model.fixed.energy_ratios {
        let Spread { min, mean, max } = Spread::over(ratios.at_points.iter().copied());
        report.detail(
            ratios.strain,
            format!("{min:.4} to {max:.4}, mean {mean:.4}"),
        )?;
    }
    Ok(())
}

/// Number of the points with `no_fail`, and how far bonds that never fail reach beyond them.
fn no_fail_words(model: &Model) -> String {
    let marked = &model.fixed.no_fail;
    let mut reached = vec![false; marked.len()];
    for &[a, b] in model.system.ends.iter() {
        for (from, to) in [(a as usize, b as usize), (b as usize, a as usize)] {
            reached[to] |= marked[from] && !marked[to];
        }
    }
    let horizons = model.fixed.horizon.iter().zip(marked);
    let farthest = horizons
        .filter(|it| *it.1)
        .fold(0.0, |most: f64, it| most.max(*it.0));
    let others = reached.iter().filter(|it| **it).count();
    format!(
        "{}, and {others} others up to {} from them have bonds that never fail",
        model.no_fail_points(),
        quantity(farthest, "m")
    )
}
