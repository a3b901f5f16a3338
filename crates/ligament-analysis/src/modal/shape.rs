//! Modes from their shapes.

use ligament_model::Bonds;

use super::masses::Masses;
use super::mode::{Mode, ModeKind, RESIDUAL_TOLERANCE};
use super::participation::Moving;
use crate::equilibrium::ROUNDING;
use crate::fields;
use crate::internal::{self, BondSweep, InternalForces};
use crate::state::UnbrokenBonds;
use crate::unknowns::Unknowns;
use ligament_model::interface::PointStiffness;
use ligament_model::thermal::ThermalStrain;

/// Eigenvalue omega^2 = phi^T K phi of a normalised shape, from the deformations of the bonds; exact to the square of the shape's
/// error.
pub(super) fn eigenvalue(system: &dyn Bonds, shape: &[f64]) -> f64 {
    2.0 * internal::sweep(
        system,
        UnbrokenBonds::whole(&vec![true; system.ends.len()]),
        shape,
        ThermalStrain::NONE,
    )
    .stored_energy
}

/// Mode of a normalised shape, rigid if its omega^2 is not above `rigid_below`.
pub(super) fn mode(
    system: &dyn Bonds,
    unknowns: &Unknowns,
    masses: &Masses,
    moving: &Moving,
    shape: Vec<f64>,
    rigid_below: f64,
) -> Mode {
    let intact = vec![true; system.ends.len()];
    let BondSweep {
        deformations,
        internal,
        stored_energy,
        ..
    } = internal::sweep(
        system,
        UnbrokenBonds::whole(&intact),
        &shape,
        ThermalStrain::NONE,
    );
    let eigenvalue = 2.0 * stored_energy;
    Mode {
        kind: if eigenvalue.abs() <= rigid_below {
            ModeKind::Rigid
        } else {
            ModeKind::Elastic
        },
        eigenvalue,
        residual: residual(system, unknowns, masses, &shape, eigenvalue, internal),
        participation: moving.participation(masses, &shape),
        strain_energy_density: fields::strain_energy_density(
            system,
            UnbrokenBonds::whole(&intact),
            &deformations,
            &[],
        ),
        shape,
    }
}

/// Largest |K phi - omega^2 M phi|, forces relative to the forces and moments relative to the moments at a point. Forces of a rigid
/// motion are rounding, so that the bound of rounding is their scale.
fn residual(
    system: &dyn Bonds,
    unknowns: &Unknowns,
    masses: &Masses,
    shape: &[f64],
    eigenvalue: f64,
    internal: InternalForces,
) -> f64 {
    let out_of_balance: Vec<f64> = unknowns
        .degrees_of_freedom()
        .iter()
        .map(|&dof| {
            let dof = dof as usize;
            internal.values[dof] - eigenvalue * masses.of_dof()[dof] * shape[dof]
        })
        .collect();
    let displacements = unknowns.layout().displacements(shape);
    let largest = displacements.fold(0.0_f64, |largest, value| largest.max(value.abs()));
    let stiffness = system.point_stiffness();
    let stiffest = |of: fn(&PointStiffness) -> f64| stiffness.iter().map(of).fold(0.0, f64::max);
    let of_rounding = |stiffness: f64| ROUNDING / RESIDUAL_TOLERANCE * stiffness * largest;
    let scales = InternalForces {
        force_scale: internal
            .force_scale
            .max(of_rounding(stiffest(|it| it.force))),
        moment_scale: internal
            .moment_scale
            .max(of_rounding(stiffest(|it| it.moment))),
        thermal: 0.0,
        values: Vec::new(),
        on_rigid_bodies: Vec::new(),
    };
    internal::relative_residual(&out_of_balance, unknowns, &scales)
}
