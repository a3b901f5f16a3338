//! Softening that the largest principal stress around a bond starts, after Rankine.
//!
//! A bond begins to soften where the stress sigma = C : eps around it, with its own stretch and shear along it and the strains of its ends beside
//! it ([`Surroundings`]), has a principal stress sigma_1 = F_t, and is pulled across by at least a quarter of that. With the deformation e_i at
//! which that happens its force falls to zero so that the bond takes what one of `bond-energy` takes: in one straight line at
//!
//! e_f = e_c^2/e_i, e = sqrt(max(s, 0)^2 + gamma^2 k_t/k_n),
//!
//! with the critical stretch e_c of the fracture energy. All bonds that are pulled begin together, whatever their direction, so that
//! strength and fracture energy do not depend on each other. A bond that never began breaks where it is pulled across by the stress
//! E e_c: in a body with a horizon of several l_ch = E G_c/F_t^2, in which a crack spends its energy before its bonds get to the strength.

use std::sync::Arc;

use super::basis::Basis;
use super::bond_rankine::tensile;
use super::criterion::Surroundings;
use super::fracture_energy::critical_stretches_for;
use super::hooke::Moduli;
use super::kind::{Choice, FRACTURE_ENERGY, Kind, Limits, PerSpace, TENSILE_STRENGTH};
use super::measure::Measure;
use super::starting::{Starting, Surface};
use super::unfit::Setting;
use super::unfit::{NoLimit, Unfit};
use crate::material::Space;
use crate::scatter::Scattered;

/// Principal stress around the bond, which then softens by the fracture energy.
pub static RANKINE: Kind = Kind {
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
        PerSpace::new(limits, limits),
    )
};

/// Refuses a parameter of softening: each bond has its own.
pub(super) fn check(choice: &Choice) -> Result<(), Unfit> {
    let key = choice.after.parameter.map(|it| it.key);
    match key.filter(|_| choice.parameter().is_some()) {
        Some(key) => Err(Unfit::NotWith {
            field: key,
            named: Setting::Field(key),
            setting: Setting::Criterion(choice.kind.word),
            reason: "each bond has its own, from the `fracture_energy` and from where it begins to soften".into(),
        }),
        None => Ok(()),
    }
}

/// Limits of bonds that never began to soften, and of softening bonds, which have none before.
fn limits<const D: usize>(_: &Choice, basis: &Basis<'_, D>) -> Result<Vec<Limits>, NoLimit> {
    let [never_began, begun] = tension_limits(basis, &[1]);
    let name = Some("rankine-at-once");
    let never_began = Limits {
        name,
        ..never_began
    };
    let name = Some(RANKINE.word);
    Ok(vec![never_began, Limits { name, ..begun }])
}

/// Limits of bonds that never began to soften by tension, and of softening bonds. `never_began` has the positions of all criteria of the former,
/// counted back from that of the latter.
pub(super) fn tension_limits<const D: usize>(
    basis: &Basis<'_, D>,
    never_began: &'static [usize],
) -> [Limits; 2] {
    let energy = basis.each(|_, material| material.fracture_energy);
    let mut of_stress = tensile(basis);
    let starting = starting(basis, Surface::Tension, (&of_stress, &energy), never_began);
    // Bonds that never fail have an infinite limit.
    let largest = critical_stretches_for(basis, &energy).into_iter();
    let both = of_stress
        .limit
        .iter_mut()
        .zip(largest.zip(&starting.moduli));
    for (limit, (largest, moduli)) in both.filter(|(limit, _)| limit.is_finite()) {
        *limit = largest * moduli.bar;
    }
    of_stress.is_brittle = true;
    [of_stress, energy_limits(starting, basis)]
}

/// Condition for the start of softening, from the limits of a measure of stress with the coefficients of its moduli, and the fracture energies
/// (n_materials).
pub(super) fn starting<const D: usize>(
    basis: &Basis<'_, D>,
    surface: Surface,
    (of_stress, energy): (&Limits, &[f64]),
    never_began: &'static [usize],
) -> Starting {
    let mut strength = of_stress.limit.clone();
    basis.scatter(Scattered::Strength, &mut strength, |factor| factor);
    let mut critical = critical_stretches_for(basis, energy);
    basis.scatter(Scattered::FractureEnergy, &mut critical, f64::sqrt);
    let count = of_stress.coefficient.len() / strength.len().max(1);
    let coefficients = of_stress.coefficient.chunks_exact(count.max(1));
    Starting {
        surface,
        strength,
        critical,
        moduli: coefficients.map(Moduli::from_coefficients).collect(),
        never_began,
    }
}

/// k_t/k_n as the law has it: corrections change it from bond to bond, and a bond whose shear they make stiff would be at its end from
/// the start.
pub(super) fn shear_ratio(moduli: &Moduli, space: Space) -> f64 {
    // Poisson's ratio of the plane, lambda/E' = nu; of space nu/(1 - nu).
    let ratio = match space {
        Space::Plane(_) => (1.0 - 3.0 * moduli.lateral) / (1.0 + moduli.lateral),
        Space::Solid => {
            let nu = moduli.lateral / (1.0 + moduli.lateral);
            (1.0 - 4.0 * nu) / (1.0 + nu)
        }
    };
    ratio.max(0.0)
}

/// Limits of the energy of bonds before any begins to soften.
pub(super) fn energy_limits<const D: usize>(starting: Starting, basis: &Basis<'_, D>) -> Limits {
    let ratio = |it: &Moduli| shear_ratio(it, basis.space);
    Limits {
        limit: vec![f64::INFINITY; starting.strength.len()],
        coefficient: starting.moduli.iter().map(ratio).collect(),
        surroundings: Some(Arc::new(Surroundings::Starting(starting))),
        is_brittle: false,
        name: None,
    }
}
