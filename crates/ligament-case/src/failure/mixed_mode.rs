//! The criterion of bonds with strains of their own: opening along x and along y, each mixed with shear.

use ligament_model::Material;
use ligament_model::element::imaginary::BondClass;
use ligament_model::failure::mixed_mode::{Components, Lattice, Limits as OfModes, Toughness};
use ligament_model::failure::{Criterion, Measure, weakest_materials};

use super::Limits;
use crate::case::{Form, MixedModeLimits};
use crate::resolve;

/// Limits and coefficients of the bonds of a material.
struct OfMaterial {
    /// s_I of opening along x and along y; infinite where it never fails.
    stretch: [f64; 2],
    /// q along x and along y, G_IIc/G_Ic, eta.
    coefficients: [[f64; 3]; 2],
}

impl Limits<'_> {
    /// Opening along x and along y, by which bonds break at their limits. Bonds along y do not open along x, nor the other way
    /// round; the others do both.
    ///
    /// A bond between materials takes what the one with the smaller critical stretch has.
    pub(super) fn mixed_mode(&self, given: Option<MixedModeLimits>) -> [Criterion; 2] {
        let of_materials: Vec<OfMaterial> = match given {
            Some(given) => self.materials.iter().map(|_| of_limits(given)).collect(),
            None => self
                .materials
                .iter()
                .map(|it| self.of_energies(it))
                .collect(),
        };
        let axes = [
            ("mixed-mode-x", Measure::MixedModeX, 0),
            ("mixed-mode-y", Measure::MixedModeY, 1),
        ];
        axes.map(|(name, measure, axis)| self.opening(name, measure, axis, &of_materials))
    }

    fn opening(
        &self,
        name: &'static str,
        measure: Measure,
        axis: usize,
        of_materials: &[OfMaterial],
    ) -> Criterion {
        let bonds = &self.system.bonds;
        let stretches: Vec<f64> = of_materials.iter().map(|it| it.stretch[axis]).collect();
        let materials = weakest_materials(self.system, &stretches);
        let other_axis = [BondClass::Vertical, BondClass::Horizontal][axis];
        let never = |bond: usize| {
            BondClass::of(bonds.direction[bond]) == other_axis
                || bonds.ends[bond]
                    .iter()
                    .any(|end| self.no_fail[*end as usize])
        };
        let of_bonds = materials.iter().enumerate();
        let limit = of_bonds.map(|(bond, &material)| {
            if never(bond) {
                f64::INFINITY
            } else {
                stretches[material]
            }
        });
        // What would be 1 for all bonds is not stored.
        let is_mixed = of_materials
            .iter()
            .any(|it| it.coefficients[axis][1] != 1.0);
        let count = if is_mixed { 3 } else { 1 };
        let coefficients = materials.iter();
        let coefficients =
            coefficients.flat_map(|&material| &of_materials[material].coefficients[axis][..count]);
        Criterion {
            coefficient: coefficients.copied().collect(),
            ..Criterion::brittle(name, measure, limit.collect())
        }
    }

    /// From the fracture energies of a material; none means that it never fails.
    fn of_energies(&self, material: &Material) -> OfMaterial {
        let Some(opening) = material.fracture_energy else {
            return OfMaterial {
                stretch: [f64::INFINITY; 2],
                coefficients: [[0.0, 1.0, 1.0]; 2],
            };
        };
        let sliding = material.fracture_energy_sliding.unwrap_or(opening);
        let energies = self
            .lattice()
            .crack_energies(&material.elasticity.plane_stiffness(self.plane));
        let of_modes = |sliding| energies.limits(&Toughness { opening, sliding });
        let exponent = material.mixed_mode_exponent.unwrap_or(1.0);
        of_material(&of_modes(opening), sliding / opening, exponent)
    }

    fn lattice(&self) -> Lattice {
        let spacing = self
            .system
            .cloud
            .spacing
            .iter()
            .copied()
            .fold(f64::INFINITY, f64::min);
        Lattice {
            spacing,
            horizon: resolve::horizon(self.case, spacing),
            thickness: self.system.cloud.thickness,
            components: match self.case.case.model.form {
                Some(Form::Rows) => Components::OwnRows,
                _ => Components::All,
            },
        }
    }
}

fn of_limits(given: MixedModeLimits) -> OfMaterial {
    let limits = OfModes {
        stretch: [given.critical_stretch; 2],
        angle: given.critical_angle,
    };
    of_material(&limits, 1.0, 1.0)
}

/// From the limits of modes that are equally tough.
fn of_material(limits: &OfModes, ratio: f64, exponent: f64) -> OfMaterial {
    let of_axis = |stretch: f64| [(stretch / limits.angle).powi(2), ratio, exponent];
    OfMaterial {
        stretch: limits.stretch,
        coefficients: limits.stretch.map(of_axis),
    }
}
