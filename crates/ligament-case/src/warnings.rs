//! What a user should know about a model before trusting its results.

use ligament_model::correction::CorrectionReport;
use ligament_model::failure::Measure;
use ligament_model::{ElementKind, Isotropic, Plane};
use ligament_output::results::FixedFields;

use crate::body::Body;
use crate::case::{CaseFile, ModelSection};
use crate::formulation;
use crate::resolve;

/// Below this the domain correction is not known to have a fixed point.
const SMALLEST_SAFE_FACTOR: f64 = 2.0;

/// A point whose energy under uniaxial strain is off by more than this is told of.
const ENERGY_TOLERANCE: f64 = 1e-4;

/// A Poisson's ratio within this of the one that a law fixes counts as that one: users write 0.333.
const POISSON_TOLERANCE: f64 = 1e-3;

/// Warnings about the body, the horizons over the distances `spacing` (n_points) of nearest points, the correction,
/// pre-cracks (`touched`: bonds that only touch an end of one) and the materials.
pub fn of_model(
    case: &CaseFile,
    body: &dyn Body,
    spacing: &[f64],
    correction: Option<&CorrectionReport>,
    fixed: &FixedFields,
    touched: usize,
) -> Vec<String> {
    let mut warnings = body.remarks();
    if correction.is_some() {
        warnings.extend(horizon_warning(case, spacing, fixed));
    }
    if let Some(correction) = correction.filter(|report| !report.converged) {
        warnings.push(correction_warning(body, correction, fixed));
    }
    if touched > 0 {
        warnings.push(format!(
            "{touched} bonds only touch an end of a pre-crack and stay whole: if the crack begins at the outline, let \
             it begin a little outside, or give it `ends = \"included\"`"
        ));
    }
    let plane = resolve::plane(case);
    let materials = resolve::materials(case);
    let constants = materials.iter().filter_map(|it| it.elasticity.isotropic());
    warnings.extend(constants.filter_map(|it| poisson_warning(&case.case.model, &it, plane)));
    warnings.extend(sliding_warning(case));
    let constants = materials.iter().filter_map(|it| it.elasticity.isotropic());
    warnings.extend(constants.filter_map(|it| energy_warning(case, &it, plane)));
    warnings
}

fn horizon_warning(case: &CaseFile, spacing: &[f64], fixed: &FixedFields) -> Option<String> {
    let smallest = (fixed.horizon.iter().zip(spacing))
        .map(|(horizon, nearest)| horizon / nearest)
        .fold(f64::INFINITY, f64::min);
    let (factor, what) = match case.case.model.horizon_factor {
        Some(factor) => (factor, format!("model.horizon_factor = {factor} is")),
        None => (
            smallest,
            format!(
                "the horizon is {smallest:.4} times the distance to the nearest point for some points,"
            ),
        ),
    };
    (factor < SMALLEST_SAFE_FACTOR).then(|| {
        format!(
            "{what} less than {SMALLEST_SAFE_FACTOR}: the domain correction may have no fixed point, and peak loads then \
             depend on the number of sweeps"
        )
    })
}

fn correction_warning(
    body: &dyn Body,
    correction: &CorrectionReport,
    fixed: &FixedFields,
) -> String {
    let [x, y, ..] = &fixed.energy_ratios;
    let error = |point: usize| (x[point] - 1.0).abs().max((y[point] - 1.0).abs());
    let off = (0..x.len())
        .filter(|&point| error(point) > ENERGY_TOLERANCE)
        .count();
    let worst = (0..x.len())
        .max_by(|&i, &j| error(i).total_cmp(&error(j)))
        .unwrap_or_default();
    let [at_x, at_y] = body.positions()[worst];
    format!(
        "the domain correction did not converge in {} sweeps (last change {:.2e}): {off} of {} points have energies off \
         by more than {ENERGY_TOLERANCE}, the worst by {:.1e} ({} at {at_x:.4}, {at_y:.4}); more \
         correction.max_sweeps may help",
        correction.sweeps,
        correction.last_change,
        x.len(),
        error(worst),
        body.label(worst as u32),
    )
}

/// The shear of a bond between points without rotations is that of the body and its rotation together.
fn sliding_warning(case: &CaseFile) -> Option<String> {
    let law = case.case.model.law;
    if formulation::element(&case.case.model) != ElementKind::Spring {
        return None;
    }
    let sees_rotations = |measure: &Measure| match measure {
        Measure::Sliding | Measure::Friction => true,
        // Without a shear stiffness there is no energy of shear.
        Measure::Energy => !law.fixes_poisson(),
        _ => false,
    };
    let kinds = case.case.fracture.iter().flat_map(|it| &it.criteria);
    let mut kinds = kinds.map(|it| it.kind);
    let kind = kinds.find(|it| it.measures.iter().any(sees_rotations));
    kind.map(|kind| {
        format!(
            "criterion \"{}\": under law = \"{}\" points have no rotations, so that where the body turns its rotation counts \
             as sliding of the bonds; \"mppd\" tells them apart",
            kind.word,
            law.word()
        )
    })
}

/// Where shear gives energy back, bonds nearly along a crack have none to reach a limit with.
fn energy_warning(case: &CaseFile, material: &Isotropic, plane: Plane) -> Option<String> {
    let mut kinds = case.case.fracture.iter().flat_map(|it| &it.criteria);
    let looks_at_energy = kinds.any(|it| it.kind.measures.contains(&Measure::Energy));
    let limit = Isotropic::central_force_poisson(plane);
    let gives_energy = material.poisson > limit && !case.case.model.law.fixes_poisson();
    (looks_at_energy && gives_energy).then(|| {
        format!(
            "criterion \"bond-energy\": above Poisson's ratio {limit:.4} (here {}) shear lowers the energy of the bonds, and those \
             nearly along a crack never fail; \"critical-stretch\" breaks them",
            material.poisson
        )
    })
}

fn poisson_warning(model: &ModelSection, material: &Isotropic, plane: Plane) -> Option<String> {
    let (poisson, limit) = (material.poisson, Isotropic::central_force_poisson(plane));
    if model.law.fixes_poisson() {
        let differs = (poisson - limit).abs() > POISSON_TOLERANCE;
        return differs.then(|| {
            format!("Poisson's ratio {poisson} is not used: bonds that only resist stretch have {limit:.4}")
        });
    }
    let negative = match formulation::element(model) {
        ElementKind::Beam => "shear and rotational stiffness of the bonds are negative",
        ElementKind::Spring => "the shear stiffness of the bonds is negative",
        ElementKind::Imaginary | ElementKind::TrueStrain | ElementKind::Pairwise => return None,
    };
    (poisson > limit).then(|| {
        format!(
            "Poisson's ratio {poisson} is greater than {limit:.4}: {negative}, the stability of the intact model is checked"
        )
    })
}
