//! What `ligament check` tells of the characteristic length of a material, and whether a run that breaks bonds depends on the mesh.

use std::io;

use ligament::Setup;
use ligament_model::Material;
use ligament_model::failure::Criterion;
use ligament_model::material::Space;
use ligament_output::quantity::{between, four_digits, quantity};
use ligament_run::model::Model;

use super::report::Report;

/// Writes for each material with a strength and a fracture energy its characteristic length
///
/// l_ch = E G_c/F_t^2,
///
/// and the horizon over it. With a horizon of at most l_ch a crack spends its energy over several bonds that soften, and neither strength nor
/// toughness hang on the mesh. Bonds that break at once by a strength know no energy: K_Ic grows with the root of the horizon.
pub(super) fn write(report: &mut Report<'_>, model: &Model) -> io::Result<()> {
    for material in model.setup.materials() {
        if let Some(length) = characteristic_length(model, &material) {
            report.entry("characteristic length", words(model, &material, length))?;
        }
    }
    let list = &model.criteria.list;
    let breaks_by_stress = |it: &&Criterion| it.follows_stress() && it.after.is_brittle();
    let starts = list.iter().any(|it| it.starting().is_some());
    if list.iter().any(|it| breaks_by_stress(&it)) && !starts {
        let words = "brittle bonds with a limit of stress: the strength does not depend on the mesh, but the toughness does (K_Ic grows \
            with sqrt(H)); `rankine` softens according to the fracture energy";
        report.entry("cracks", words)?;
    }
    Ok(())
}

/// l_ch of a material, m; None without a strength or a fracture energy.
fn characteristic_length(model: &Model, material: &Material) -> Option<f64> {
    let young = young(&model.setup, material)?;
    Some(young * material.fracture_energy? / material.tensile_strength?.powi(2))
}

fn words(model: &Model, material: &Material, length: f64) -> String {
    let of_points = || model.fixed.horizon.iter().copied();
    let largest = of_points().fold(0.0, f64::max);
    let smallest = of_points().fold(f64::INFINITY, f64::min);
    let name = match material.name.as_str() {
        "" => String::new(),
        name => format!("{name}: "),
    };
    let shares = between([smallest / length, largest / length], "-");
    let finer = match largest > length {
        true => format!(
            "; a horizon no larger than that takes a mesh {} times finer",
            four_digits(largest / length)
        ),
        false => String::new(),
    };
    format!(
        "{name}E G_c/F_t^2 = {}, the horizon is {shares} of it{finer}",
        quantity(length, "m")
    )
}

/// Young's modulus of a bar of a material with the constants that the law makes of it, Pa; none for one with axes.
pub(super) fn young(setup: &Setup, material: &Material) -> Option<f64> {
    let constants = setup.law.constants(material, setup.space())?;
    Some(match setup.space() {
        Space::Plane(plane) => constants.in_plane(plane).young,
        Space::Solid => constants.young,
    })
}
