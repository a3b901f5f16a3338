//! Failure by the stresses on the plane across a bond, after Mohr and Coulomb with a tension cut-off.
//!
//! A bond fails where sigma_n = F_t, or where |tau| + sigma_n tan(phi) = c. The plane across a bond is one of those on which a body may
//! slide; of a family of bonds the planes have all directions, and the worst of them decides as in a continuum.

use std::f64::consts::FRAC_PI_2;

use super::basis::Basis;
use super::bond_rankine::{BRITTLE, tensile};
use super::hooke::modulus;
use super::kind::{COMPRESSIVE_STRENGTH, Choice, Kind, Limits, PerSpace, TENSILE_STRENGTH};
use super::measure::Measure;
use super::of_stress::of_stress;
use super::unfit::{NoLimit, Unfit};
use crate::material::Material;

/// Tensile stress across the bond, and shear stress with friction.
pub const MOHR_COULOMB: Kind = Kind {
    takes: &[TENSILE_STRENGTH, COMPRESSIVE_STRENGTH],
    keys: &["cohesion", "friction_angle"],
    brittle_because: Some(BRITTLE),
    check,
    suits,
    ..Kind::new(
        "mohr-coulomb",
        "Stresses on the plane across the bond: tension up to the `tensile_strength`, and shear with friction, from the \
         `compressive_strength` and a `friction_angle` or one that fits both strengths, or from a `cohesion` and a `friction_angle`.",
        &[Measure::NormalStress, Measure::CoulombStress],
        PerSpace::both(limits, limits),
    )
};

fn check(choice: &Choice) -> Result<(), Unfit> {
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

/// Without an angle both strengths must leave one.
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

/// Limits F_t/E' of tension and c/E' of shear; a bond between materials takes those of the one with the smaller cohesion.
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
        Some(friction(material)?.cohesion / modulus(constants, basis.space))
    });
    let slopes: Vec<f64> = (basis.materials.iter())
        .map(|it| friction(it).map_or(0.0, |it| it.slope))
        .collect();
    let sheared = of_stress(basis, &cohesions, |material, it| {
        let [lateral, shear, bar, along] = it.coefficients();
        [lateral, shear, bar, along, slopes[material]]
    });
    Ok(vec![tensile(basis), sheared])
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
