//! The failure criteria that a case chooses, with the limits of its bonds.

mod mixed_mode;

use ligament_model::failure::{
    AfterLimit, Criteria, Criterion, Measure, fracture_energy, frictional, sliding,
    softening::{bilinear, exponential},
    strength, stretch, weakest, weakest_materials,
};
use ligament_model::law::bbpd;
use ligament_model::{BondSystem, Isotropic, Material, Plane};

use crate::case::{self, After, CaseError, CaseFile, CriterionKind, FrictionCalibration};
use crate::resolve;

/// The criteria of a case on its bonds; none without a fracture section. Bonds of points marked in `no_fail` (n_points)
/// never fail.
///
/// # Errors
///
/// If the strengths of a material leave a criterion without a limit, or its fracture energy leaves nothing after the
/// limit.
pub fn criteria(
    case: &CaseFile,
    system: &BondSystem,
    no_fail: &[bool],
) -> Result<Criteria, CaseError> {
    let Some(fracture) = &case.case.fracture else {
        return Ok(Criteria::default());
    };
    let limits = Limits {
        case,
        system,
        no_fail,
        plane: resolve::plane(case),
        materials: resolve::materials(case),
    };
    let mut list = Vec::new();
    for (place, criterion) in fracture.criteria.iter().enumerate() {
        list.extend(limits.criterion(place, criterion)?);
    }
    Ok(Criteria { list })
}

/// The elastic constants that the law of the case makes of a material, which limits are made with: Young's modulus with
/// the Poisson's ratio of central forces where the law knows no other. None for a material with axes.
pub fn constants(case: &CaseFile, material: &Material) -> Option<Isotropic> {
    let given = material.elasticity.isotropic()?;
    Some(if case.case.model.law.fixes_poisson() {
        bbpd::central(&given, resolve::plane(case))
    } else {
        given
    })
}

/// What limits are made from.
struct Limits<'a> {
    case: &'a CaseFile,
    system: &'a BondSystem,
    no_fail: &'a [bool],
    plane: Plane,
    materials: Vec<Material>,
}

impl Limits<'_> {
    /// The criterion of an entry of the case, or the two that it stands for.
    fn criterion(
        &self,
        place: usize,
        wanted: &case::Criterion,
    ) -> Result<Vec<Criterion>, CaseError> {
        let key = format!("fracture.criterion.{place}");
        let (name, plane) = (wanted.kind.word(), self.plane);
        let given_or = |given: Option<f64>, of: &dyn Fn(&Isotropic, &Material) -> Option<f64>| {
            let of_materials = match given {
                Some(limit) => vec![limit; self.materials.len()],
                None => self.each(of),
            };
            weakest(self.system, self.no_fail, &of_materials)
        };
        let tension = |constants: &Isotropic, material: &Material| {
            Some(stretch::limit(constants, material.tensile_strength?, plane))
        };
        let compression = |constants: &Isotropic, material: &Material| {
            Some(stretch::limit(
                constants,
                material.compressive_strength?,
                plane,
            ))
        };
        let slide = |constants: &Isotropic, material: &Material| {
            Some(sliding::limit(constants, material.tensile_strength?, plane))
        };
        let mut criterion = match wanted.kind {
            CriterionKind::Strength => Criterion::brittle(name, Measure::Tension, self.strength()),
            CriterionKind::Tension { limit } => {
                Criterion::brittle(name, Measure::Tension, given_or(limit, &tension))
            }
            CriterionKind::Compression { limit } => {
                Criterion::brittle(name, Measure::Compression, given_or(limit, &compression))
            }
            CriterionKind::Sliding { limit } => {
                Criterion::brittle(name, Measure::Sliding, given_or(limit, &slide))
            }
            CriterionKind::Frictional { calibration } => self.friction(&key, name, calibration)?,
            CriterionKind::CriticalStretch => {
                Criterion::brittle(name, Measure::Tension, self.critical_stretch())
            }
            CriterionKind::BondEnergy { limit } => Criterion {
                coefficient: self.shear_ratio(),
                ..Criterion::brittle(
                    name,
                    Measure::Energy,
                    limit.map_or_else(
                        || self.critical_stretch(),
                        |_| given_or(limit, &|_, _| None),
                    ),
                )
            },
            CriterionKind::MixedMode { limits } => return Ok(self.mixed_mode(limits).to_vec()),
        };
        criterion.after = self.after(&key, &criterion, wanted.after)?;
        Ok(vec![criterion])
    }

    /// A value of each material, with the constants that the law makes of its own; infinite where it has none.
    fn each(&self, of: impl Fn(&Isotropic, &Material) -> Option<f64>) -> Vec<f64> {
        let of = |material: &Material| of(&constants(self.case, material)?, material);
        (self.materials.iter())
            .map(|it| of(it).unwrap_or(f64::INFINITY))
            .collect()
    }

    fn strength(&self) -> Vec<f64> {
        let energies = self.each(|constants, material| {
            let tensile_strength = material.tensile_strength?;
            Some(strength::critical_energy(
                constants,
                tensile_strength,
                self.plane,
            ))
        });
        strength::critical_stretches(self.system, &energies, self.no_fail)
    }

    /// Limits a and coefficients tan(beta); a bond between materials takes those of the one with the smaller a.
    fn friction(
        &self,
        key: &str,
        name: &'static str,
        calibration: FrictionCalibration,
    ) -> Result<Criterion, CaseError> {
        let calibration = match calibration {
            FrictionCalibration::Printed => frictional::Calibration::Printed,
            FrictionCalibration::TwoPoint => frictional::Calibration::TwoPoint,
        };
        let mut impossible = None;
        let conditions: Vec<Option<frictional::Friction>> = (self.materials.iter())
            .map(|material| {
                let constants = constants(self.case, material)?;
                let strengths = [material.tensile_strength?, material.compressive_strength?];
                let condition =
                    frictional::condition(&constants, strengths, self.plane, calibration);
                if condition.is_none() {
                    impossible.get_or_insert((constants.in_plane(self.plane).poisson, strengths));
                }
                condition
            })
            .collect();
        if let Some((poisson, [tensile, compressive])) = impossible {
            let reason = format!(
                "a bar with Poisson's ratio {poisson:.4} (in the plane) and strengths {tensile:.4e} and {compressive:.4e} Pa fits no \
                 friction: calibration = \"two-point\" needs poisson < tensile_strength/compressive_strength = {:.4}; take \
                 \"printed\", or strengths that lie closer together",
                tensile / compressive
            );
            return Err(self.case.error(key, reason));
        }
        let of = |value: fn(&frictional::Friction) -> f64| -> Vec<f64> {
            let or_never =
                |it: &Option<frictional::Friction>| it.as_ref().map_or(f64::INFINITY, value);
            conditions.iter().map(or_never).collect()
        };
        let (cohesion, slope) = (of(|it| it.cohesion), of(|it| it.slope));
        let limit = weakest(self.system, self.no_fail, &cohesion);
        let materials = weakest_materials(self.system, &cohesion);
        // A bond that never fails has no slope, which may be infinite: infinity times zero is no number.
        let slope_of = |(limit, material): (&f64, usize)| {
            if limit.is_finite() {
                slope[material]
            } else {
                0.0
            }
        };
        Ok(Criterion {
            coefficient: limit.iter().zip(materials).map(slope_of).collect(),
            ..Criterion::brittle(name, Measure::Friction, limit)
        })
    }

    /// Critical stretches from the fracture energy; a bond has the mean opening modulus and the mean length of its ends.
    fn critical_stretch(&self) -> Vec<f64> {
        let energies = self.each(|_, material| material.fracture_energy);
        let energy = weakest(self.system, self.no_fail, &energies);
        let moduli =
            self.each(|constants, _| Some(fracture_energy::opening_modulus(constants, self.plane)));
        let lengths = fracture_energy::mean_lengths(self.system);
        let modulus = |end: u32| self.system.cloud.mean_property(end as usize, &moduli);
        (energy.into_iter().zip(&self.system.bonds.ends))
            .map(|(energy, &[a, b])| {
                let modulus = 0.5 * (modulus(a) + modulus(b));
                let length = 0.5 * (lengths[a as usize] + lengths[b as usize]);
                fracture_energy::critical_stretch(energy, modulus, length)
            })
            .collect()
    }

    /// k_t/k_n of each bond; 0 where the bond has no stiffness at all.
    fn shear_ratio(&self) -> Vec<f64> {
        (self
            .system
            .rigidities
            .axial
            .iter()
            .zip(&self.system.rigidities.shear))
        .map(|(&axial, &shear)| if axial == 0.0 { 0.0 } else { shear / axial })
        .collect()
    }

    fn after(
        &self,
        key: &str,
        criterion: &Criterion,
        wanted: After,
    ) -> Result<AfterLimit, CaseError> {
        let n_bonds = self.system.bonds.len();
        Ok(match wanted {
            After::Brittle => AfterLimit::Brittle,
            After::Plastic => AfterLimit::Plastic,
            After::Bilinear { end: Some(end) } => AfterLimit::Bilinear {
                end: vec![end; n_bonds],
            },
            After::Exponential { scale: Some(scale) } => AfterLimit::Exponential {
                scale: vec![scale; n_bonds],
            },
            After::Bilinear { end: None } => AfterLimit::Bilinear {
                end: self.spending_fracture_energy(key, criterion, bilinear::end_for)?,
            },
            After::Exponential { scale: None } => AfterLimit::Exponential {
                scale: self.spending_fracture_energy(key, criterion, exponential::scale_for)?,
            },
        })
    }

    /// What makes the lives of the bonds take the fracture energy: (s_G/e_0)^2 times the energy at the limit e_0, where
    /// s_G is the critical stretch of a brittle bond with that fracture energy.
    fn spending_fracture_energy(
        &self,
        key: &str,
        criterion: &Criterion,
        solve: fn(f64) -> Option<f64>,
    ) -> Result<Vec<f64>, CaseError> {
        let brittle = self.critical_stretch();
        let of_bond = |(bond, (&limit, &brittle)): (usize, (&f64, &f64))| {
            // Bonds that never fail need no end.
            if limit.is_infinite() || brittle.is_infinite() {
                return Ok(f64::INFINITY);
            }
            solve((brittle / limit).powi(2)).ok_or_else(|| {
                let horizon = self.system.bonds.horizon[bond];
                let reason = format!(
                    "nothing is left of the fracture energy after the limit: a bond of horizon {horizon:.3e} m stores all of it at \
                     the limit {limit:.3e} (it would break at {brittle:.3e}); take a horizon below {:.3e} m, a larger \
                     fracture_energy or a smaller strength",
                    horizon * (brittle / limit).powi(2)
                );
                self.case.error(key, reason)
            })
        };
        criterion
            .limit
            .iter()
            .zip(&brittle)
            .enumerate()
            .map(of_bond)
            .collect()
    }
}
