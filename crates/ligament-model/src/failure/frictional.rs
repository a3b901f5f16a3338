//! Sliding that compression makes harder (MPPD eqs 52 to 58), from two strengths, from the tensile strength and an angle, or as given.

use std::f64::consts::FRAC_PI_2;

use super::basis::Basis;
use super::kind::{COMPRESSIVE_STRENGTH, Choice, Kind, Limits, PerSpace, TENSILE_STRENGTH};
use super::measure::Measure;
use super::stretch;
use super::unfit::Setting;
use super::unfit::{NoLimit, Unfit};
use crate::material::{Isotropic, Material, Space};

pub use super::kind::Calibration;

/// Sliding that compression makes harder.
pub static FRICTIONAL: Kind = Kind {
    source: "MPPD eqs 52 to 58",
    takes: &[TENSILE_STRENGTH, COMPRESSIVE_STRENGTH],
    keys: &["limit", "friction_angle", "calibration"],
    brittle_because: Some(
        "its limit moves with the stretch, so that there is no one deformation at which softening begins",
    ),
    check,
    suits,
    ..Kind::new(
        "frictional",
        "Sliding that compression makes harder, from both strengths, from the `tensile_strength` and a `friction_angle`, or from a \
         `limit` and a `friction_angle`.",
        &[Measure::Friction],
        PerSpace::new(limits, limits),
    )
};

/// Checks that a given limit `a` of sliding without stretch has the angle by which it decreases with the stretch.
fn check(choice: &Choice) -> Result<(), Unfit> {
    match (choice.limit, choice.friction_angle) {
        (Some(_), None) => Err(Unfit::Missing {
            field: "friction_angle",
            reason: "(in rad) beside `limit`: a bond fails at |gamma| + s tan(beta) = a, and `limit` is a alone".into(),
        }),
        (_, Some(angle)) if !(0.0..FRAC_PI_2).contains(&angle) => Err(Unfit::OutOfRange {
            field: "friction_angle",
            expected: "at least 0 and less than pi/2 (rad)".to_owned(),
            found: angle,
        }),
        (Some(_), Some(_)) if choice.calibration.is_some() => Err(Unfit::NotWith {
            field: "calibration",
            named: Setting::Field("calibration"),
            setting: Setting::Field("limit"),
            reason: "cohesion and friction are given, and no strength is used".into(),
        }),
        _ => Ok(()),
    }
}

/// Refuses a compressive strength below the tensile one, because friction makes sliding harder under compression.
fn suits(choice: &Choice, material: &Material) -> Result<(), Unfit> {
    if choice.friction_angle.is_some() {
        return Ok(());
    }
    match (material.tensile_strength, material.compressive_strength) {
        (Some(tensile), Some(compressive)) if compressive < tensile => Err(Unfit::OutOfRange {
            field: COMPRESSIVE_STRENGTH.key,
            expected: "at least the tensile_strength for the criterion \"frictional\"".to_owned(),
            found: compressive,
        }),
        _ => Ok(()),
    }
}

/// Limits a and coefficients tan(beta).
fn limits<const D: usize>(choice: &Choice, basis: &Basis<'_, D>) -> Result<Vec<Limits>, NoLimit> {
    let (space, calibration) = (basis.space, choice.calibration.unwrap_or_default());
    let conditions = basis.constants.iter().zip(basis.materials);
    let conditions = conditions.map(|(constants, material)| {
        let slope = choice.friction_angle.map(f64::tan);
        if let (Some(cohesion), Some(slope)) = (choice.limit, slope) {
            return Ok(Some(Friction { cohesion, slope }));
        }
        let (Some(split), Some(tensile)) = (constants, material.tensile_strength) else {
            return Ok(None);
        };
        let constants = &split.material;
        if let Some(slope) = slope {
            return Ok(Some(with_slope(
                constants,
                tensile,
                space,
                (slope, calibration),
            )));
        }
        let Some(compressive) = material.compressive_strength else {
            return Ok(None);
        };
        let found = condition(constants, [tensile, compressive], space, calibration);
        let fault = NoLimit::NoFriction {
            poisson: constants.bar_constants(space).poisson,
            tensile,
            compressive,
        };
        found.ok_or(fault).map(Some)
    });
    let conditions: Vec<Option<Friction>> = conditions.collect::<Result<_, _>>()?;
    let of = |value: fn(&Friction) -> f64| -> Vec<f64> {
        let or_never = |it: &Option<Friction>| it.as_ref().map_or(f64::INFINITY, value);
        conditions.iter().map(or_never).collect()
    };
    let (cohesion, slope) = (of(|it| it.cohesion), of(|it| it.slope));
    let limit = basis.weakest(&cohesion);
    let materials = basis.weakest_materials(&cohesion);
    // A bond that never fails has no slope, which may be infinite: infinity times zero is no number.
    let slope_of = |(limit, material): (&f64, usize)| {
        if limit.is_finite() {
            slope[material]
        } else {
            0.0
        }
    };
    let coefficient = limit.iter().zip(materials).map(slope_of).collect();
    Ok(vec![Limits::new(limit, coefficient)])
}

/// Condition of a bond: |gamma| + s tan(beta) <= a (MPPD eq. 58).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Friction {
    /// a: limit sliding without stretch.
    pub cohesion: f64,
    /// tan(beta).
    pub slope: f64,
}

/// The condition for the strengths F_t and F_c > F_t of a bar (Pa, both positive), with sin(phi) = (F_c - F_t)/(F_c + F_t) (MPPD
/// eq. 57):
///
/// | calibration | tan(beta) or sin(beta) | a/s_0t |
/// |---|---|---|
/// | printed, eqs 56, 55 | tan(beta) = (1 + nu) tan(phi) | (1 + nu)(1 + sin(phi))/(2 cos(phi)) |
/// | two points | sin(beta) = sin(phi) (1 + nu)/(1 - nu) | (1 - nu) tan(beta)/2 + (1 + nu)/(2 cos(beta)) |
///
/// None where the two strengths leave no angle: with two points if nu >= F_t/F_c, in plane strain with nu/(1 - nu) for nu.
///
/// A bond at the angle x to the axis of a bar under the stress sigma, with the strains e = sigma/E along it and -nu e across it, has
///
/// s = e (cos^2 x - nu sin^2 x) = e ((1 - nu) + (1 + nu) cos 2x)/2, |gamma| = (1 + nu) |e sin 2x|/2.
///
/// In space the strains across the bar are the same all around, so that the strain of a bond has no part out of the plane of the bond and
/// the axis: the bonds of that plane are those of all directions, and both calibrations hold with E and nu of the material.
///
/// - Printed: a plane across the bond has the stresses sigma cos^2 x and sigma |sin 2x|/2 = E |gamma|/(1 + nu). Mohr and Coulomb allow
///   E |gamma|/(1 + nu) + tan(phi) sigma cos^2 x <= F_t (1 + sin(phi))/(2 cos(phi)), and E s stands for sigma cos^2 x.
/// - Two points: the largest |gamma| + s tan(beta) over x is |e| (1 + nu)/(2 cos(beta)) + e tan(beta)(1 - nu)/2. It is a at both e = F_t/E
///   and e = -F_c/E, which gives sin(beta) and a.
pub fn condition(
    material: &Isotropic,
    [tensile, compressive]: [f64; 2],
    space: impl Into<Space>,
    calibration: Calibration,
) -> Option<Friction> {
    let space = space.into();
    let poisson = material.bar_constants(space).poisson;
    let limit = stretch::limit(material, tensile, space);
    let sin_phi = (compressive - tensile) / (compressive + tensile);
    match calibration {
        Calibration::Printed => {
            let cos_phi = (1.0 - sin_phi * sin_phi).sqrt();
            Some(Friction {
                cohesion: 0.5 * limit * (1.0 + poisson) * (1.0 + sin_phi) / cos_phi,
                slope: (1.0 + poisson) * sin_phi / cos_phi,
            })
        }
        Calibration::TwoPoint => {
            let sin_beta = (1.0 + poisson) / (1.0 - poisson) * sin_phi;
            if sin_beta >= 1.0 {
                return None;
            }
            let cos_beta = (1.0 - sin_beta * sin_beta).sqrt();
            let slope = sin_beta / cos_beta;
            Some(Friction {
                cohesion: 0.5 * limit * ((1.0 - poisson) * slope + (1.0 + poisson) / cos_beta),
                slope,
            })
        }
    }
}

/// The condition for the tensile strength F_t of a bar (Pa) and tan(beta): the paper's calibration by a tension test alone, "adopting
/// different values of a and beta" (MPPD after eq. 58). The cohesion is that of [`condition`] with the same tan(beta).
pub fn with_slope(
    material: &Isotropic,
    tensile: f64,
    space: impl Into<Space>,
    (slope, calibration): (f64, Calibration),
) -> Friction {
    let space = space.into();
    let poisson = material.bar_constants(space).poisson;
    let limit = stretch::limit(material, tensile, space);
    let per_limit = match calibration {
        Calibration::Printed => {
            let tan_phi = slope / (1.0 + poisson);
            (1.0 + poisson) * (tan_phi + tan_phi.hypot(1.0))
        }
        Calibration::TwoPoint => (1.0 - poisson) * slope + (1.0 + poisson) * slope.hypot(1.0),
    };
    Friction {
        cohesion: 0.5 * limit * per_limit,
        slope,
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]
mod tests {
    use super::*;
    use crate::material::Plane;

    /// Largest |gamma| + s tan(beta) over the directions of bonds, relative to a, for the strains (axial, lateral) of a bar:
    /// s = s_m + s_d cos 2x and gamma = s_d sin 2x make it s_m tan(beta) + |s_d|/cos(beta).
    fn utilisation(friction: Friction, [axial, lateral]: [f64; 2]) -> f64 {
        let (mean, deviator) = (0.5 * (axial + lateral), 0.5 * (axial - lateral).abs());
        let per_cosine = (1.0 + friction.slope.powi(2)).sqrt();
        (mean * friction.slope + deviator * per_cosine) / friction.cohesion
    }

    /// Stresses of a bar at which it yields in tension and in compression, over its tensile strength.
    fn yields(poisson: f64, plane: Plane, calibration: Calibration) -> Option<[f64; 2]> {
        let material = Isotropic {
            young: 2e10,
            poisson,
        };
        let in_plane = material.in_plane(plane);
        let friction = condition(&material, [5e6, 15e6], plane, calibration)?;
        let strain = 5e6 / in_plane.young;
        let of_sign = |sign: f64| {
            let strains = [sign * strain, -in_plane.poisson * sign * strain];
            1.0 / utilisation(friction, strains)
        };
        Some([of_sign(1.0), of_sign(-1.0)])
    }

    /// Deviations of the printed calibration for F_c = 3 F_t, from an independent calculation; printed to 3 digits.
    #[test]
    fn the_printed_calibration_is_exact_without_lateral_strain_only() {
        let known = [
            (0.0, 1.0, 3.0),
            (0.1, 1.016, 2.605),
            (0.25, 1.040, 2.165),
            (1.0 / 3.0, 1.052, 1.975),
            (-0.5, 0.908, 9.91),
        ];
        for (poisson, tension, compression) in known {
            let [t, c] = yields(poisson, Plane::Stress, Calibration::Printed).unwrap();
            assert!((t - tension).abs() < 6e-4, "{poisson}: {t}");
            assert!(
                (c - compression).abs() < 6e-4 * compression,
                "{poisson}: {c}"
            );
        }
    }

    /// With the angle that two strengths give, the tensile strength alone has the cohesion of both; 1e-15 for the other form of it.
    #[test]
    fn the_tensile_strength_and_the_angle_of_both_strengths_give_their_cohesion() {
        for plane in [Plane::Stress, Plane::Strain] {
            for poisson in [-0.4, 0.0, 0.2] {
                for calibration in [Calibration::Printed, Calibration::TwoPoint] {
                    let material = Isotropic {
                        young: 2e10,
                        poisson,
                    };
                    let both = condition(&material, [5e6, 15e6], plane, calibration).unwrap();
                    let one = with_slope(&material, 5e6, plane, (both.slope, calibration));
                    assert_eq!(one.slope, both.slope);
                    let error = (one.cohesion / both.cohesion - 1.0).abs();
                    assert!(error < 1e-15, "{poisson} {calibration:?}: {error:e}");
                }
            }
        }
    }

    /// Without friction it is the largest sliding, as the paper says (below eq. 58).
    #[test]
    fn without_friction_it_is_the_largest_sliding() {
        let material = Isotropic {
            young: 2e10,
            poisson: 0.25,
        };
        for calibration in [Calibration::Printed, Calibration::TwoPoint] {
            let friction = with_slope(&material, 5e6, Plane::Stress, (0.0, calibration));
            let sliding = super::super::sliding::limit(&material, 5e6, Plane::Stress);
            assert_eq!((friction.cohesion, friction.slope), (sliding, 0.0));
        }
    }

    /// A bar of any angle yields at its tensile strength by the strains of the bar, at every Poisson's ratio.
    #[test]
    fn a_bar_yields_at_the_tensile_strength_whatever_the_angle() {
        for (poisson, plane) in [
            (-0.4, Plane::Stress),
            (0.3, Plane::Stress),
            (0.2, Plane::Strain),
        ] {
            for angle in [0.0, 0.3, 1.0] {
                let material = Isotropic {
                    young: 2e10,
                    poisson,
                };
                let in_plane = material.in_plane(plane);
                let calibration = (f64::tan(angle), Calibration::TwoPoint);
                let friction = with_slope(&material, 5e6, plane, calibration);
                let strain = 5e6 / in_plane.young;
                let found = utilisation(friction, [strain, -in_plane.poisson * strain]);
                assert!((found - 1.0).abs() < 1e-14, "{poisson} {angle}: {found}");
            }
        }
    }

    #[test]
    fn two_points_are_met_where_that_is_possible() {
        for (poisson, plane) in [
            (0.0, Plane::Stress),
            (0.25, Plane::Stress),
            (-0.5, Plane::Stress),
            (0.2, Plane::Strain),
        ] {
            let [t, c] = yields(poisson, plane, Calibration::TwoPoint).unwrap();
            assert!(
                (t - 1.0).abs() < 1e-12 && (c - 3.0).abs() < 1e-12,
                "{poisson}"
            );
        }
        assert_eq!(yields(0.34, Plane::Stress, Calibration::TwoPoint), None);
        assert_eq!(yields(0.26, Plane::Strain, Calibration::TwoPoint), None);
    }
}
