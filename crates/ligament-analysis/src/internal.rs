//! Deformations, forces and residual of the bonds.

pub use ligament_model::sweep::{BondSweep, InternalForces};
use ligament_model::thermal::ThermalStrain;
use ligament_model::{Bonds, UnbrokenBonds};

use crate::unknowns::Unknowns;

/// Deformations, forces and energy of all bonds for displacements (n_degrees_of_freedom).
pub fn sweep(
    system: &dyn Bonds,
    bonds: UnbrokenBonds<'_>,
    displacement: &[f64],
    expansion: ThermalStrain<'_>,
) -> BondSweep {
    let deformations = system.deformations(bonds.intact, displacement, expansion);
    system.forces(bonds, deformations, expansion)
}

/// Largest |external - internal force| of a residual (n_unknowns), relative to the forces at a point.
pub fn relative_residual(residual: &[f64], unknowns: &Unknowns, internal: &InternalForces) -> f64 {
    // Largest residual force and moment.
    let mut largest = [0.0_f64; 2];
    for (value, &dof) in residual.iter().zip(unknowns.degrees_of_freedom()) {
        let component = unknowns.layout().component(dof as usize);
        // `f64::max` would ignore a NaN, and with it a failed solution.
        let size = if value.is_nan() {
            f64::INFINITY
        } else {
            value.abs()
        };
        let of_kind = &mut largest[usize::from(component.is_rotation())];
        *of_kind = of_kind.max(size);
    }
    let relative = |value: f64, scale: f64| if value == 0.0 { 0.0 } else { value / scale };
    relative(largest[0], internal.force_scale).max(relative(largest[1], internal.moment_scale))
}
