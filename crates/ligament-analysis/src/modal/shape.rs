//! Motions of the points and their masses.

use ligament_model::{Bonds, LumpedMass};

use super::{Mode, ModeKind, Moving, Rotations};
use crate::equilibrium::ROUNDING;
use crate::fields;
use crate::internal::{self, BondSweep, InternalForces};
use crate::unknowns::{COMPONENTS, Component, Unknowns};
use ligament_model::BondsLeft;
use ligament_model::thermal::ThermalStrain;

/// Displacements closer than this (relative) to the largest one count as largest.
const TIE: f64 = 1e-6;

/// Masses of the degrees of freedom.
pub(super) struct Masses {
    /// Mass of each degree of freedom, zero where it is known or has none, shape (3 n_points).
    of_dof: Vec<f64>,
    /// Degrees of freedom that are no unknowns.
    known: Vec<usize>,
}

impl Masses {
    /// Masses of the unknowns.
    pub(super) fn new(mass: &LumpedMass, unknowns: &Unknowns, rotations: Rotations) -> Self {
        let of_component = |dof: usize| match (Component::at(dof), rotations) {
            (Component::X | Component::Y, _) => mass.mass[dof / COMPONENTS],
            (Component::Rotation, Rotations::Inertia) => mass.inertia[dof / COMPONENTS],
            (Component::Rotation, Rotations::Massless) => 0.0,
        };
        let n_dofs = COMPONENTS * mass.mass.len();
        Self {
            of_dof: (0..n_dofs)
                .map(|dof| unknowns.number(dof).map_or(0.0, |_| of_component(dof)))
                .collect(),
            known: (0..n_dofs)
                .filter(|&dof| unknowns.number(dof).is_none())
                .collect(),
        }
    }

    /// Mass of each degree of freedom, zero where it is known or has none, shape (3 n_points).
    pub(super) fn of_dof(&self) -> &[f64] {
        &self.of_dof
    }

    /// Sets what cannot move to zero.
    pub(super) fn clear_known(&self, shape: &mut [f64]) {
        for &dof in &self.known {
            shape[dof] = 0.0;
        }
    }

    /// Takes from a shape what lies along orthonormal others.
    pub(super) fn remove(&self, others: &[Vec<f64>], shape: &mut [f64]) {
        for other in others {
            let along = inner(&self.of_dof, other, shape);
            for (value, other) in shape.iter_mut().zip(other) {
                *value -= along * other;
            }
        }
    }

    /// Scales a shape to phi^T M phi = 1; the first of the largest displacements becomes positive.
    pub(super) fn normalise(&self, shape: &mut [f64]) {
        let norm = inner(&self.of_dof, shape, shape).sqrt();
        let displacements = || {
            let is_displacement = |(dof, _): &(usize, &f64)| dof % COMPONENTS < 2;
            shape.iter().enumerate().filter(is_displacement)
        };
        let largest = displacements().fold(0.0_f64, |largest, (_, value)| largest.max(value.abs()));
        let first = displacements().find(|(_, value)| value.abs() >= (1.0 - TIE) * largest);
        let sign = first.map_or(1.0, |(_, value)| value.signum());
        let factor = sign / norm;
        shape.iter_mut().for_each(|value| *value *= factor);
    }
}

/// Sum of weight a b.
pub(super) fn inner(weight: &[f64], a: &[f64], b: &[f64]) -> f64 {
    let products = weight.iter().zip(a).zip(b);
    products.map(|((weight, a), b)| weight * a * b).sum()
}

/// omega^2 = phi^T K phi of a normalised shape, from the deformations of the bonds: exact to the square of the shape's error.
pub(super) fn eigenvalue(system: &dyn Bonds, shape: &[f64]) -> f64 {
    2.0 * internal::sweep(
        system,
        BondsLeft::whole(&vec![true; system.ends().len()]),
        shape,
        ThermalStrain::NONE,
    )
    .stored_energy
}

/// The mode of a normalised shape, rigid if its omega^2 is not above `rigid_below`.
pub(super) fn mode(
    system: &dyn Bonds,
    unknowns: &Unknowns,
    masses: &Masses,
    moving: &Moving,
    shape: Vec<f64>,
    rigid_below: f64,
) -> Mode {
    let intact = vec![true; system.ends().len()];
    let BondSweep {
        deformations,
        internal,
        stored_energy,
        ..
    } = internal::sweep(
        system,
        BondsLeft::whole(&intact),
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
            BondsLeft::whole(&intact),
            &deformations,
        ),
        shape,
    }
}

/// Largest |K phi - omega^2 M phi|, forces relative to the forces and moments to the moments that meet at a point. A rigid
/// motion has no forces but rounding: there what rounding may be is the scale.
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
            internal.values[dof] - eigenvalue * masses.of_dof[dof] * shape[dof]
        })
        .collect();
    let largest = (shape.iter().enumerate())
        .filter(|(dof, _)| dof % COMPONENTS < 2)
        .fold(0.0_f64, |largest, (_, value)| largest.max(value.abs()));
    let stiffness = system.largest_point_stiffness();
    let of_rounding = |stiffness: f64| ROUNDING / super::RESIDUAL_TOLERANCE * stiffness * largest;
    let scales = InternalForces {
        force_scale: internal.force_scale.max(of_rounding(stiffness.force)),
        moment_scale: internal.moment_scale.max(of_rounding(stiffness.moment)),
        thermal: 0.0,
        values: Vec::new(),
    };
    internal::relative_residual(&out_of_balance, unknowns.degrees_of_freedom(), &scales)
}
