//! Softening that the largest principal stress around a bond starts, after Rankine.
//!
//! A bond begins to soften where the stress sigma = C : eps around it, with its own stretch along it and the strains of its ends beside it
//! ([`super::surroundings`]), has a principal stress sigma_1 = F_t, and is pulled across by at least a quarter of that. With the deformation e_i at
//! which that happens its force falls to zero so that the bond takes what one of `bond-energy` takes: in one straight line at
//!
//! e_f = e_c^2/e_i, e = sqrt(max(s, 0)^2 + gamma^2 k_t/k_n),
//!
//! with the critical stretch e_c of the fracture energy. All bonds that are pulled begin together, whatever their direction, so that
//! strength and fracture energy do not depend on each other. A bond that never began breaks where it is pulled across by the stress
//! E e_c: in a body with a horizon of several l_ch = E G_c/F_t^2, in which a crack spends its energy before its bonds get to the strength.

use std::sync::Arc;

use super::basis::{Basis, weakest_materials};
use super::bond_rankine::tensile;
use super::fracture_energy::critical_stretches;
use super::hooke::Moduli;
use super::kind::{Choice, FRACTURE_ENERGY, Kind, Limits, PerSpace, TENSILE_STRENGTH};
use super::measure::Measure;
use super::setting::Setting;
use super::starting::Starting;
use super::surroundings::Surroundings;
use super::unfit::{NoLimit, Unfit};
use crate::material::Space;
use crate::scatter::Scattered;

/// Principal stress around the bond, which then softens by the fracture energy.
pub const RANKINE: Kind = Kind {
    takes: &[TENSILE_STRENGTH, FRACTURE_ENERGY],
    check,
    softens_because: Some(
        "it says where bonds begin to soften; `bond-rankine` is the criterion by which they break at once",
    ),
    ..Kind::new(
        "rankine",
        "Largest principal stress around the bond, at which it begins to soften, from the `tensile_strength`; it takes what \
         `bond-energy` gives it, from the `fracture_energy`.",
        &[Measure::NormalStress, Measure::Energy],
        PerSpace::both(limits, limits),
    )
};

fn check(choice: &Choice) -> Result<(), Unfit> {
    let key = choice.after.law.parameter.map(|it| it.key);
    match key.filter(|_| choice.after.parameter.is_some()) {
        Some(key) => Err(Unfit::NotWith {
            field: key,
            named: Setting::Field(key),
            setting: Setting::Criterion(RANKINE.word),
            reason: "each bond has its own, from the `fracture_energy` and from where it begins to soften".into(),
        }),
        None => Ok(()),
    }
}

/// Limits of bonds that never began to soften, and of those that did: none before they do.
fn limits<const D: usize>(_: &Choice, basis: &Basis<'_, D>) -> Result<Vec<Limits>, NoLimit> {
    let largest = critical_stretches(basis);
    let mut never_began = tensile(basis);
    let mut strength = never_began.limit.clone();
    basis.scatter(Scattered::Strength, &mut strength, |factor| factor);
    let moduli = moduli(basis);
    for ((limit, largest), it) in never_began.limit.iter_mut().zip(&largest).zip(&moduli) {
        // Bonds that never fail have an infinite one.
        *limit = if limit.is_finite() {
            largest * it.bar
        } else {
            f64::INFINITY
        };
    }
    let mut toughness = largest;
    basis.scatter(Scattered::FractureEnergy, &mut toughness, f64::sqrt);
    let starting = Starting::new(strength, toughness, moduli);
    Ok(vec![
        Limits {
            is_brittle: true,
            ..never_began
        },
        begun_limits(starting, basis),
    ])
}

/// Moduli of the bonds (n_bonds), between materials those of the one with the smaller strength.
fn moduli<const D: usize>(basis: &Basis<'_, D>) -> Vec<Moduli> {
    let strength = basis.each(|_, material| material.tensile_strength);
    let of_materials = basis.constants.iter();
    let of_materials: Vec<Moduli> = of_materials
        .map(|it| it.map_or(Moduli::BAR, |it| Moduli::new(&it, basis.space)))
        .collect();
    let materials = weakest_materials(basis.system, &strength).into_iter();
    materials.map(|it| of_materials[it]).collect()
}

/// Limits of bonds none of which began, with k_t/k_n as the law has it: corrections change it from bond to bond, and a bond whose
/// shear they make stiff would be at its end from the start.
fn begun_limits<const D: usize>(starting: Starting, basis: &Basis<'_, D>) -> Limits {
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
        limit: vec![f64::INFINITY; starting.strength.len()],
        coefficient: starting.moduli.iter().map(ratio).collect(),
        surroundings: Some(Arc::new(Surroundings::Starting(starting))),
        is_brittle: false,
    }
}
