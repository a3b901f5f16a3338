//! Bonds that begin to soften by the stress around them, at whatever deformation they have then.

use std::sync::Arc;

use super::basis::{Basis, weakest_materials};
use super::criterion::Criteria;
use super::kind::Limits;
use super::softening::AfterLimit;
use super::surroundings::{Moduli, Surroundings};
use crate::element::BondDeformation;
use crate::interface::Bonds;
use crate::material::Space;
use crate::stress::point_strain::Motion;

/// Share of the largest principal stress by which a bond must be pulled across to begin: a stray principal stress in a direction in
/// which nothing opens, as at the edge of a platen, begins nothing.
pub const SHARE: f64 = 0.25;

/// Deformation over F_t/E below which no bond begins: one that hardly takes part has none to speak of, and would never end.
const LEAST: f64 = 0.5;

/// By how much the energy of the whole life of a bond exceeds the least that its law of softening takes.
const BEYOND_LEAST: f64 = 1.001;

/// Where bonds begin to soften.
#[derive(Debug, Clone, PartialEq)]
pub struct Starting {
    /// F_t/E', shape (n_bonds); infinite where a bond never fails.
    strength: Vec<f64>,
    /// Critical stretch e_c of brittle bonds, shape (n_bonds).
    critical: Vec<f64>,
    /// Moduli of the bonds, shape (n_bonds).
    moduli: Vec<Moduli>,
}

/// Moduli of the bonds (n_bonds), between materials those of the one with the smaller strength.
pub(super) fn moduli<const D: usize>(basis: &Basis<'_, D>) -> Vec<Moduli> {
    let strength = basis.each(|_, material| material.tensile_strength);
    let of_materials = basis.constants.iter();
    let of_materials: Vec<Moduli> = of_materials
        .map(|it| it.map_or(Moduli::BAR, |it| Moduli::new(&it, basis.space)))
        .collect();
    let materials = weakest_materials(basis.system, &strength).into_iter();
    materials.map(|it| of_materials[it]).collect()
}

impl Starting {
    /// Bonds of strengths F_t/E', critical stretches and moduli (n_bonds).
    pub(super) fn new(strength: Vec<f64>, critical: Vec<f64>, moduli: Vec<Moduli>) -> Self {
        Self {
            strength,
            critical,
            moduli,
        }
    }

    /// Limits of bonds none of which began, with k_t/k_n as the law has it: corrections change it from bond to bond, and a bond whose
    /// shear they make stiff would be at its end from the start.
    pub(super) fn limits<const D: usize>(self, basis: &Basis<'_, D>) -> Limits {
        let ratio = |it: &Moduli| {
            // Poisson's ratio of the plane, lambda/E' = nu; of space nu/(1 - nu).
            let ratio = match basis.space {
                Space::Plane(_) => (1.0 - 3.0 * it.lateral) / (1.0 + it.lateral),
                Space::Solid => {
                    let nu = it.lateral / (1.0 + it.lateral);
                    (1.0 - 4.0 * nu) / (1.0 + nu)
                }
            };
            ratio.max(0.0)
        };
        Limits {
            limit: vec![f64::INFINITY; self.strength.len()],
            coefficient: self.moduli.iter().map(ratio).collect(),
            surroundings: Some(Arc::new(Surroundings::Starting(self))),
            is_brittle: false,
        }
    }

    /// F_t/E' of a bond and its moduli.
    pub(crate) fn surface(&self, bond: usize) -> (f64, &Moduli) {
        (self.strength[bond], &self.moduli[bond])
    }

    /// The deformation at which a bond began that has the deformation e at a stress so many times the strength: that at the strength, not
    /// below half of F_t/E, nor so large that nothing would be left of the energy.
    fn began_at(&self, bond: usize, deformation: f64, utilisation: f64, least_energy: f64) -> f64 {
        let least = LEAST * self.strength[bond] / self.moduli[bond].bar;
        let most = self.critical[bond] / (BEYOND_LEAST * least_energy).sqrt();
        (deformation / utilisation).max(least).min(most)
    }
}

impl Criteria {
    /// The deformations at which bonds began to soften, those that begin in a motion among them, from those that had begun: shape (n_bonds)
    /// for each criterion by which bonds begin, and infinite for bonds that did not; None where none begins now. `motion` has the bonds
    /// intact that are neither broken nor soften, and no other begins.
    pub fn beginning(
        &self,
        begun: &[Vec<f64>],
        system: &dyn Bonds,
        motion: Motion<'_>,
        deformations: &[BondDeformation],
    ) -> Option<Vec<Vec<f64>>> {
        let mut begun = begun.to_vec();
        let mut some = false;
        for (criterion, begun) in self.list.iter().zip(&mut begun) {
            let Some(starting) = criterion.starting() else {
                continue;
            };
            let least = criterion
                .after
                .law()
                .parameter
                .map_or(1.0, |it| it.least_energy);
            let stresses = system.principal_stresses(motion, deformations, starting);
            for (bond, &utilisation) in stresses.iter().enumerate() {
                if utilisation >= 1.0 && motion.intact[bond] {
                    let deformation = criterion.measure(bond, &deformations[bond]);
                    begun[bond] = starting.began_at(bond, deformation, utilisation, least);
                    some = true;
                }
            }
        }
        some.then_some(begun)
    }

    /// The criteria of bonds that began to soften at these deformations, as [`beginning`](Self::beginning) gives them.
    pub fn begun_at(&self, begun: &[Vec<f64>]) -> Self {
        let mut criteria = self.clone();
        for (place, begun) in begun.iter().enumerate() {
            let Some(starting) = self.list[place].starting() else {
                continue;
            };
            let law = *self.list[place].after.law();
            let of_energy = law.parameter.map(|it| it.for_energy);
            let parameter = begun
                .iter()
                .zip(&starting.critical)
                .map(|(began, critical)| {
                    let energy = (critical / began).powi(2);
                    match began.is_finite() {
                        true => of_energy.map_or(f64::NAN, |parameter| parameter(energy)),
                        false => f64::INFINITY,
                    }
                });
            criteria.list[place].after = AfterLimit::new(law, parameter.collect());
            criteria.list[place].limit.clone_from(begun);
            // The criterion before it is that of bonds that never began.
            let never_began = criteria.list[place - 1].limit.iter_mut().zip(begun);
            for (limit, _) in never_began.filter(|(_, began)| began.is_finite()) {
                *limit = f64::INFINITY;
            }
        }
        criteria
    }

    /// Deformations at which bonds began to soften where none did yet, shape (n_bonds) for each criterion by which they begin.
    pub fn none_begun(&self) -> Vec<Vec<f64>> {
        let of = |it: &super::Criterion| match it.starting() {
            Some(_) => vec![f64::INFINITY; it.limit.len()],
            None => Vec::new(),
        };
        self.list.iter().map(of).collect()
    }
}
