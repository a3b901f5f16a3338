//! The criterion of bonds with strains of their own (MBB-PD): opening along x and along y, each mixed with shear.

use super::basis::Basis;
use super::crack_energies::{Limits as ModeLimits, Toughness};
use super::kind::{Choice, FRACTURE_ENERGY, Kind, Limits, PerSpace};
use super::measure::Measure;
use super::unfit::Unfit;
use crate::element::imaginary::BondClass;
use crate::material::Material;

/// Opening and shear, from the fracture energies.
pub static MIXED_MODE: Kind = Kind {
    source: "MBB-PD eqs 21, C.1, C.4; Benzeggagh and Kenane 1996",
    takes: &[FRACTURE_ENERGY],
    keys: &["critical_stretch", "critical_angle"],
    brittle_because: Some(
        "which bonds a strain is taken from changes when their neighbours break, so that it says nothing of what a bond went through",
    ),
    suits,
    ..Kind::new(
        "mixed-mode",
        "Opening and shear of the bonds of `mbb-pd`, from the fracture energies or limits of both.",
        &[Measure::MixedModeX, Measure::MixedModeY],
        PerSpace::in_plane(|choice, basis| Ok(limits(choice, basis))),
    )
};

/// Limits and coefficients of the bonds of a material.
struct MaterialLimits {
    /// s_I of opening along x and along y; infinite where it never fails.
    stretch: [f64; 2],
    /// Coefficients along x and along y: q, G_IIc/G_Ic and eta.
    coefficients: [[f64; 3]; 2],
}

/// Refuses two fracture energies without the exponent for mixed modes.
pub(super) fn suits(choice: &Choice, material: &Material) -> Result<(), Unfit> {
    let differ =
        (material.fracture_energy_sliding).is_some_and(|it| Some(it) != material.fracture_energy);
    if choice.takes().is_empty() || !differ || material.mixed_mode_exponent.is_some() {
        return Ok(());
    }
    Err(Unfit::Missing {
        field: "mixed_mode_exponent",
        reason: "because fracture_energy_sliding is not fracture_energy: G_c = G_Ic + (G_IIc - G_Ic) (G_II/G)^exponent".into(),
    })
}

/// Opening along x and along y. Bonds along y do not open along x, nor the other way round; the others do both.
///
/// A bond of several materials has the coefficients of the softest of them, with the energies of the weakest.
fn limits(choice: &Choice, basis: &Basis<'_>) -> Vec<Limits> {
    let of_materials: Vec<MaterialLimits> = match (choice.critical_stretch, choice.critical_angle) {
        (Some(stretch), Some(angle)) => {
            let limits = ModeLimits {
                stretch: [stretch; 2],
                angle: [angle; 2],
            };
            let each = basis.materials.iter();
            each.map(|_| material_limits(&limits, 1.0, 1.0)).collect()
        }
        _ => (basis.materials.iter())
            .map(|it| limits_from_energies(it, basis))
            .collect(),
    };
    let axes = [0, 1].map(|axis| opening(axis, &of_materials, basis));
    axes.into()
}

fn opening(axis: usize, of_materials: &[MaterialLimits], basis: &Basis<'_>) -> Limits {
    let bonds = &basis.system.bonds;
    let stretches: Vec<f64> = of_materials.iter().map(|it| it.stretch[axis]).collect();
    let materials = basis.weakest_materials(&stretches);
    let other_axis = [BondClass::Vertical, BondClass::Horizontal][axis];
    let mut limit = basis.weakest(&stretches);
    for (limit, &direction) in limit.iter_mut().zip(&bonds.direction) {
        if BondClass::from_direction(direction) == other_axis {
            *limit = f64::INFINITY;
        }
    }
    // What would be 1 for all bonds is not stored.
    let is_mixed = (of_materials.iter()).any(|it| it.coefficients[axis][1] != 1.0);
    let count = if is_mixed { 3 } else { 1 };
    let coefficient = materials.iter();
    let coefficient =
        coefficient.flat_map(|&material| &of_materials[material].coefficients[axis][..count]);
    Limits::new(limit, coefficient.copied().collect())
}

/// Limits from the fracture energies of a material; one without them never fails.
fn limits_from_energies(material: &Material, basis: &Basis<'_>) -> MaterialLimits {
    let Some(opening) = material.fracture_energy else {
        return MaterialLimits {
            stretch: [f64::INFINITY; 2],
            coefficients: [[0.0, 1.0, 1.0]; 2],
        };
    };
    let sliding = material.fracture_energy_sliding.unwrap_or(opening);
    let (plane, lattice) = basis.plane_and_lattice();
    let energies = lattice.crack_energies(&material.elasticity.plane_stiffness(plane));
    let of_modes = |sliding| energies.limits(&Toughness { opening, sliding });
    let exponent = material.mixed_mode_exponent.unwrap_or(1.0);
    material_limits(&of_modes(opening), sliding / opening, exponent)
}

/// Limits from given limits of both modes with equal toughness.
fn material_limits(limits: &ModeLimits, ratio: f64, exponent: f64) -> MaterialLimits {
    let of_axis = |axis: usize| {
        let share = (limits.stretch[axis] / limits.angle[axis]).powi(2);
        [share, ratio, exponent]
    };
    MaterialLimits {
        stretch: limits.stretch,
        coefficients: [0, 1].map(of_axis),
    }
}
