//! Split of an isotropic material between bonds and cells.

use super::elasticity::{Isotropic, Plane, Space};

crate::case_type! {
    /// What carries the part of the stiffness that bonds cannot have above the Poisson's ratio of central forces (1/3 in plane stress, else
    /// 1/4).
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
    pub enum PoissonForm {
        /// The cells of the body, by their changes of volume.
        #[default]
        Cells,
        /// The bonds, with a negative shear stiffness: the form of the papers, which cracks make unstable.
        Bonds,
    }
}

/// Distance from the Poisson's ratio of central forces up to which a ratio is that, by rounding.
const ROUNDING: f64 = 1e-12;

/// Isotropic material split between the bonds and the cells of a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VolumetricSplit {
    /// Constants of the material under its law.
    pub material: Isotropic,
    /// Constants of the material that the bonds make up.
    pub bonds: Isotropic,
    /// Modulus kappa of the cells against changes of volume, Pa; 0 where bonds make up the whole material.
    pub modulus: f64,
}

impl VolumetricSplit {
    /// A material whose whole stiffness bonds make up.
    pub fn whole(material: Isotropic) -> Self {
        Self {
            material,
            bonds: material,
            modulus: 0.0,
        }
    }

    /// The split of a material with a Poisson's ratio above that of central forces, nu_l; other materials stay whole. With the shear modulus
    /// mu bonds make up the material of
    ///
    /// nu_0 = nu_l, E_0 = 2 mu (1 + nu_l), whose lambda' is mu,
    ///
    /// and the cells have
    ///
    /// kappa = lambda' - mu, lambda' = E nu/((1 + nu)(1 - 2 nu)), in plane stress E nu/(1 - nu^2).
    pub fn new(material: Isotropic, space: Space) -> Self {
        let limit = Isotropic::central_force_poisson(space);
        let Isotropic { young, poisson } = material;
        if poisson <= limit + ROUNDING {
            return Self::whole(material);
        }
        let shear = young / (2.0 * (1.0 + poisson));
        let lateral = match space {
            Space::Plane(Plane::Stress) => young * poisson / (1.0 - poisson * poisson),
            Space::Plane(Plane::Strain) | Space::Solid => {
                young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson))
            }
        };
        Self {
            material,
            bonds: Isotropic {
                young: 2.0 * shear * (1.0 + limit),
                poisson: limit,
            },
            modulus: lateral - shear,
        }
    }

    /// Whether cells have a part of the stiffness.
    pub fn is_split(&self) -> bool {
        self.modulus > 0.0
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]
mod tests {
    use super::*;
    use crate::material::{Elasticity, add_volumetric};

    const SPACES: [Space; 3] = [
        Space::Plane(Plane::Stress),
        Space::Plane(Plane::Strain),
        Space::Solid,
    ];

    /// The stiffnesses of bonds and cells sum to that of the material, within the rounding of 1 - 2 nu.
    #[test]
    fn bonds_and_cells_make_up_the_material() {
        for space in SPACES {
            for poisson in [0.34, 0.4, 0.45, 0.49, 0.4999] {
                let material = Isotropic {
                    young: 7.0,
                    poisson,
                };
                let split = VolumetricSplit::new(material, space);
                let whole = Elasticity::Isotropic(material).stiffness_in(space).unwrap();
                let mut sum = (Elasticity::Isotropic(split.bonds).stiffness_in(space)).unwrap();
                match space {
                    Space::Plane(_) => add_volumetric::<2>(&mut sum, split.modulus),
                    Space::Solid => add_volumetric::<3>(&mut sum, split.modulus),
                }
                assert!(
                    (&sum - &whole).norm() < 1e-11 * whole.norm(),
                    "{space:?} {poisson}"
                );
            }
        }
    }

    /// Moduli over mu at Poisson's ratios of plane strain and of space: 2 nu/(1 - 2 nu) - 1.
    #[test]
    fn moduli_of_cells_are_known_multiples_of_the_shear_modulus() {
        for (poisson, expected) in [
            (0.3, 0.5),
            (0.35, 4.0 / 3.0),
            (0.4, 3.0),
            (0.45, 8.0),
            (0.49, 48.0),
        ] {
            let young = 2.0 * (1.0 + poisson);
            for space in &SPACES[1..] {
                let split = VolumetricSplit::new(Isotropic { young, poisson }, *space);
                assert!((split.modulus / expected - 1.0).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn materials_up_to_the_ratio_of_central_forces_stay_whole() {
        for space in SPACES {
            for poisson in [-0.5, 0.0, 0.2, Isotropic::central_force_poisson(space)] {
                let material = Isotropic {
                    young: 3.0,
                    poisson,
                };
                let split = VolumetricSplit::new(material, space);
                assert_eq!(split, VolumetricSplit::whole(material));
                assert!(!split.is_split());
            }
        }
    }
}
