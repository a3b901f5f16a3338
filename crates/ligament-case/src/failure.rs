//! The failure criteria that a case chooses, with the limits of its bonds.

use ligament_model::failure::crack_energies::{Components, Lattice};
use ligament_model::failure::{self, Basis, Criteria};
use ligament_model::law::bbpd;
use ligament_model::{BondSystem, Isotropic, Material};

use crate::case::{CaseError, CaseFile, Form};
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
    let materials = resolve::materials(case);
    let spacing = (system.cloud.spacing.iter().copied()).fold(f64::INFINITY, f64::min);
    let basis = Basis {
        system,
        no_fail,
        plane: resolve::plane(case),
        constants: materials.iter().map(|it| constants(case, it)).collect(),
        materials: &materials,
        lattice: Lattice {
            spacing,
            horizon: resolve::horizon(case, spacing),
            thickness: system.cloud.thickness,
            components: match case.case.model.form {
                Some(Form::Rows) => Components::OwnRows,
                _ => Components::All,
            },
        },
    };
    failure::criteria(&fracture.criteria, &basis).map_err(|(place, no_limit)| {
        case.error(&format!("fracture.criterion.{place}"), no_limit.to_string())
    })
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
