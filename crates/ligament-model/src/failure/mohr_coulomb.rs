//! Failure by tension and by shear with friction, after Mohr and Coulomb with a tension cut-off.
//!
//! A brittle bond breaks where on the plane across it sigma_n = F_t, or |tau| + sigma_n tan(phi) = c. The plane across a bond is one of
//! those on which a body may slide; of a family of bonds the planes have all directions, and the worst of them decides as in a continuum.
//!
//! Softening begins where the stress around a bond reaches the surface on any plane, as with [`super::rankine`]: by tension where sigma_1
//! = F_t, and by shear where
//!
//! (sigma_1 - sigma_3)/(2 cos(phi)) + (sigma_1 + sigma_3)/2 tan(phi) = c,
//!
//! in the plane with the principal stresses in it. Of both surfaces it begins by the one that the stress is farther beyond, and by tension
//! where it is as far beyond both. Pulled bonds take what `bond-energy` takes. Sheared ones have a fracture energy of their own, and lose
//! their resistance to pressure as well, by the deformation sqrt(s^2 + gamma^2 k_t/k_n): bonds that stay stiff when pressed are struts across
//! the slip, and the body does not fail.

use std::f64::consts::FRAC_PI_2;

use super::basis::Basis;
use super::bond_rankine::tensile;
use super::hooke::modulus;
use super::kind::{COMPRESSIVE_STRENGTH, Choice, Kind, Limits, PerSpace, TENSILE_STRENGTH};
use super::measure::Measure;
use super::rankine;
use super::starting::Surface;
use super::stress_limits::stress_limits;
use super::unfit::{NoLimit, Unfit};
use crate::material::Material;

/// Tensile stress across the bond, and shear stress with friction.
pub static MOHR_COULOMB: Kind = Kind {
    takes: &[TENSILE_STRENGTH, COMPRESSIVE_STRENGTH],
    keys: &["cohesion", "friction_angle"],
    check,
    suits,
    ..Kind::new(
        "mohr-coulomb",
        "Tension up to the `tensile_strength`, and shear with friction, from the `compressive_strength` and a `friction_angle` or one \
         that fits both strengths, or from a `cohesion` and a `friction_angle`; where bonds soften, by the `fracture_energy` and by \
         `fracture_energy_sliding`.",
        &[
            Measure::NormalStress,
            Measure::CoulombStress,
            Measure::Energy,
            Measure::StoredEnergy,
        ],
        PerSpace::new(limits, limits),
    )
};

fn check(choice: &Choice) -> Result<(), Unfit> {
    rankine::check(choice)?;
    match choice.friction_angle {
        None if choice.cohesion.is_some() => Err(Unfit::Missing {
            field: "friction_angle",
            reason: "(in rad) beside `cohesion`: a bond fails at |tau| + sigma_n tan(phi) = c, and `cohesion` is c alone".into(),
        }),
        Some(angle) if !(0.0..FRAC_PI_2).contains(&angle) => Err(Unfit::OutOfRange {
            field: "friction_angle",
            expected: "at least 0 and less than pi/2 (rad)".to_owned(),
            found: angle,
        }),
        _ => match choice.cohesion {
            Some(found) if !(found > 0.0 && found.is_finite()) => Err(Unfit::OutOfRange {
                field: "cohesion",
                expected: "greater than 0 (Pa)".to_owned(),
                found,
            }),
            _ => Ok(()),
        },
    }
}

/// Refuses strengths that leave no angle of friction, where none is given.
fn suits(choice: &Choice, material: &Material) -> Result<(), Unfit> {
    match (material.tensile_strength, material.compressive_strength) {
        (Some(tensile), Some(compressive))
            if compressive < tensile && choice.friction_angle.is_none() =>
        {
            Err(Unfit::OutOfRange {
                field: COMPRESSIVE_STRENGTH.key,
                expected: "at least the tensile_strength for the criterion \"mohr-coulomb\" without a friction_angle".to_owned(),
                found: compressive,
            })
        }
        _ => Ok(()),
    }
}

/// Friction of a material.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Friction {
    /// Cohesion c, Pa.
    pub cohesion: f64,
    /// tan(phi).
    pub slope: f64,
}

impl Friction {
    /// Friction with which a bar under pressure fails at F_c:
    ///
    /// c = F_c (1 - sin(phi))/(2 cos(phi)), and without an angle phi sin(phi) = (F_c - F_t)/(F_c + F_t), with which a bar under tension fails
    /// at F_t by shear as well.
    pub fn new(tensile: f64, compressive: f64, angle: Option<f64>) -> Self {
        let sine = angle.map_or((compressive - tensile) / (compressive + tensile), f64::sin);
        let cosine = (1.0 - sine * sine).sqrt();
        Self {
            cohesion: compressive * (1.0 - sine) / (2.0 * cosine),
            slope: sine / cosine,
        }
    }
}

/// Limits F_t/E' of tension and c/E' of shear, at which brittle bonds break or softening begins.
fn limits<const D: usize>(choice: &Choice, basis: &Basis<'_, D>) -> Result<Vec<Limits>, NoLimit> {
    let friction = |material: &Material| {
        if let (Some(cohesion), Some(angle)) = (choice.cohesion, choice.friction_angle) {
            let slope = angle.tan();
            return Some(Friction { cohesion, slope });
        }
        let strengths = (material.tensile_strength?, material.compressive_strength?);
        Some(Friction::new(
            strengths.0,
            strengths.1,
            choice.friction_angle,
        ))
    };
    let cohesions = basis.each(|constants, material| {
        Some(friction(material)?.cohesion / modulus(&constants.bonds, basis.space))
    });
    let slopes: Vec<f64> = (basis.materials.iter())
        .map(|it| friction(it).map_or(0.0, |it| it.slope))
        .collect();
    let sheared = stress_limits(basis, &cohesions, |material, it| {
        let [lateral, shear, bar, along] = it.coefficients();
        [lateral, shear, bar, along, slopes[material]]
    });
    if !choice.after.softens {
        return Ok(named([(tensile(basis), TENSION), (sheared, SHEAR)]));
    }
    let [never_pulled, pulled] = rankine::tension_limits(basis, &[2, 1]);
    let [never_sheared, sheared] = shear_limits(basis, sheared);
    Ok(named([
        (never_pulled, "mohr-coulomb-tension-at-once"),
        (never_sheared, "mohr-coulomb-shear-at-once"),
        (pulled, TENSION),
        (sheared, SHEAR),
    ]))
}

/// Names of failure by tension and by shear in results; of bonds that soften, those that never began break at once.
const TENSION: &str = "mohr-coulomb-tension";
const SHEAR: &str = "mohr-coulomb-shear";

fn named<const N: usize>(limits: [(Limits, &'static str); N]) -> Vec<Limits> {
    let name = |(limits, name)| Limits {
        name: Some(name),
        ..limits
    };
    limits.into_iter().map(name).collect()
}

/// Limits of bonds that never began to soften by shear and limits of softening ones, from the limits c/E' at the start of softening.
///
/// A bond that never began breaks where the stress on the plane across it shears it by gamma = e_c/sqrt(k_t/k_n), the angle at which it would
/// have the whole energy.
fn shear_limits<const D: usize>(basis: &Basis<'_, D>, of_stress: Limits) -> [Limits; 2] {
    let energy = basis.each(|_, it| it.fracture_energy_sliding.or(it.fracture_energy));
    let slope = of_stress.coefficient.chunks_exact(5).map(|it| it[4]);
    let surface = Surface::Shear {
        slope: slope.collect(),
    };
    let starting = rankine::starting(basis, surface, (&of_stress, &energy), &[3, 2]);
    let mut never_began = of_stress;
    let both = never_began.limit.iter_mut().zip(&starting.moduli);
    for (bond, (limit, moduli)) in both.enumerate().filter(|it| it.1.0.is_finite()) {
        let ratio = rankine::shear_ratio(moduli, basis.space);
        *limit = 0.5 * moduli.shear * starting.critical[bond] / ratio.sqrt();
    }
    never_began.is_brittle = true;
    [never_began, rankine::energy_limits(starting, basis)]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Mohr's circles of a bar at its strengths touch the line of the friction that fits them.
    #[test]
    fn the_circles_of_both_strengths_touch_the_line() {
        for (angle, touches) in [(None, [true, true]), (Some(0.6), [false, true])] {
            let friction = Friction::new(3.0, 30.0, angle);
            // Largest |tau| + sigma tan(phi) over all planes of a bar under sigma, over c.
            let largest = |sigma: f64| {
                let on_plane = |degree: i32| {
                    let twice = f64::from(degree).to_radians() * 0.02;
                    let (sine, cosine) = twice.sin_cos();
                    0.5 * sigma.abs() * sine.abs() + 0.5 * sigma * (1.0 + cosine) * friction.slope
                };
                (0..=9000).map(on_plane).fold(0.0, f64::max) / friction.cohesion
            };
            let found = [largest(3.0), largest(-30.0)].map(|it| (it - 1.0).abs() < 1e-6);
            assert_eq!(found, touches);
        }
    }
}
