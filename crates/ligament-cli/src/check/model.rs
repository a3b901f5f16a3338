//! Report of `ligament check` on the model, before supports and loads.

use std::io::{self, Write};

use ligament::body::Origin;
use ligament::setup::Section;
use ligament_case::case::CaseFile;
use ligament_model::{Elasticity, Plane};
use ligament_output::quantity::quantity;
use ligament_output::summary::Spread;
use ligament_run::model::Model;
use ligament_run::summary::{correction_line, family, formulation_line, heading};

use super::entry::{entry, spread};
use super::{body, criteria};

/// Writes the report on the model.
pub(super) fn write(out: &mut dyn Write, case: &CaseFile, model: &Model) -> anyhow::Result<()> {
    writeln!(out, "{}", heading(&case.case.title))?;
    let volume = model.system.volumes.iter().sum();
    body::write(out, model.body(), volume)?;
    write_section(out, model)?;
    write_materials(out, model)?;
    write_bonds(out, model)?;
    criteria::write(out, model)?;
    Ok(write_energy_ratios(out, model)?)
}

fn write_section(out: &mut dyn Write, model: &Model) -> io::Result<()> {
    let Section::Plane { state, thickness } = model.setup.section else {
        return Ok(());
    };
    let state = match state {
        Plane::Stress => "plane stress",
        Plane::Strain => "plane strain",
    };
    let thickness = quantity(thickness, "m");
    entry(out, "thickness", format!("{thickness}, {state}"))
}

fn write_materials(out: &mut dyn Write, model: &Model) -> io::Result<()> {
    writeln!(out, "materials")?;
    for (index, material) in model.setup.materials().iter().enumerate() {
        let volume = model.volume_of_material(index);
        let name = if material.name.is_empty() {
            "the whole body"
        } else {
            &material.name
        };
        let constants = constants(&material.elasticity);
        write!(
            out,
            "  {name}: {constants}, volume {}",
            quantity(volume, "m^3")
        )?;
        for (name, value, unit) in [
            ("F_t", material.tensile_strength, "Pa"),
            ("F_c", material.compressive_strength, "Pa"),
            ("G_c", material.fracture_energy, "J/m^2"),
            ("G_IIc", material.fracture_energy_sliding, "J/m^2"),
        ] {
            if let Some(value) = value {
                write!(out, ", {name} = {}", quantity(value, unit))?;
            }
        }
        if let Some(expansion) = material.expansion {
            let [one, two] = expansion.in_plane;
            write!(out, ", alpha = {}", quantity(one, "1/K"))?;
            if one != two {
                write!(out, " and {}", quantity(two, "1/K"))?;
            }
        }
        match material.density {
            Some(density) => writeln!(out, ", mass {}", quantity(density * volume, "kg"))?,
            None => writeln!(out)?,
        }
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

fn write_bonds(out: &mut dyn Write, model: &Model) -> io::Result<()> {
    let (system, fixed) = (&model.system, &model.fixed);
    let over = |values: &[f64]| Spread::over(values.iter().copied());
    writeln!(out, "bonds")?;
    let (bonds, cut) = (model.counts.bonds, model.cut_bonds());
    entry(out, "bonds", format!("{bonds} ({cut} cut by pre-cracks)"))?;
    let has_holes = match model.body().origin() {
        Origin::Lattice(lattice) => !lattice.holes.is_empty(),
        Origin::SolidLattice(lattice) => !lattice.holes.is_empty(),
        Origin::Mesh(_) | Origin::SolidMesh(_) | Origin::Points => false,
    };
    if has_holes || model.across_voids() > 0 {
        entry(out, "pairs across voids", model.across_voids())?;
    }
    if model.counts.across_layers > 0 {
        entry(out, "through a layer", model.counts.across_layers)?;
    }
    if model.counts.far_points > 0 {
        let elements = format!("{} points of elements", model.counts.far_points);
        entry(out, "far field", elements)?;
    }
    entry(out, "points with no_fail", model.no_fail_points())?;
    spread(out, "nearest distance", over(&system.spacing), "m")?;
    spread(out, "horizon", over(&fixed.horizon), "m")?;
    let Spread { min, mean, max } = family(model);
    let of_points = format!("{min} to {max}, mean {mean:.1}");
    entry(out, "bonds of a point", of_points)?;
    let formulation = formulation_line(&model.setup);
    writeln!(out, "  {formulation}")?;
    let correction = correction_line(&model.setup.correction, model.correction.as_ref());
    writeln!(out, "  {correction}")?;
    spread(out, "correction factor", over(&fixed.domain_factor), "-")
}

fn write_energy_ratios(out: &mut dyn Write, model: &Model) -> io::Result<()> {
    writeln!(out, "strain energy of the points over the continuum's")?;
    for ratios in &model.fixed.energy_ratios {
        let Spread { min, mean, max } = Spread::over(ratios.at_points.iter().copied());
        entry(
            out,
            ratios.strain,
            format!("{min:.4} to {max:.4}, mean {mean:.4}"),
        )?;
    }
    Ok(())
}
