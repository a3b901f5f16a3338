//! What a user should know about a model before trusting its results.

use ligament_mesh::Mesh;
use ligament_model::correction::CorrectionReport;
use ligament_model::{Isotropic, Plane};
use ligament_output::results::FixedFields;

use crate::case::{CaseFile, Law};
use crate::resolve;

/// Below this the domain correction is not known to have a fixed point.
const SMALLEST_SAFE_FACTOR: f64 = 2.0;

/// A point whose energy under uniaxial strain is off by more than this is told of.
const ENERGY_TOLERANCE: f64 = 1e-4;

/// A Poisson's ratio within this of the one that a law fixes counts as that one: users write 0.333.
const POISSON_TOLERANCE: f64 = 1e-3;

/// Warnings about the mesh, the horizon factor, the correction, pre-cracks (`touched`: bonds that only touch an end of
/// one) and the materials.
pub fn of_model(
    case: &CaseFile,
    mesh: &Mesh,
    correction: Option<&CorrectionReport>,
    fixed: &FixedFields,
    touched: usize,
) -> Vec<String> {
    let mut warnings: Vec<String> = mesh
        .remarks
        .iter()
        .map(|remark| format!("mesh: {remark}"))
        .collect();
    let factor = case.case.model.horizon_factor;
    if correction.is_some() && factor < SMALLEST_SAFE_FACTOR {
        warnings.push(format!(
            "model.horizon_factor = {factor} is less than {SMALLEST_SAFE_FACTOR}: the domain correction may have no \
             fixed point, and peak loads then depend on the number of sweeps"
        ));
    }
    if let Some(correction) = correction.filter(|report| !report.converged) {
        warnings.push(correction_warning(mesh, correction, fixed));
    }
    if touched > 0 {
        warnings.push(format!(
            "{touched} bonds only touch an end of a pre-crack and stay whole: if the crack begins at the outline, let \
             it begin a little outside"
        ));
    }
    let plane = resolve::plane(case);
    let materials = resolve::materials(case);
    let constants = materials.iter().filter_map(|it| it.elasticity.isotropic());
    warnings.extend(constants.filter_map(|it| poisson_warning(case.case.model.law, &it, plane)));
    warnings
}

fn correction_warning(mesh: &Mesh, correction: &CorrectionReport, fixed: &FixedFields) -> String {
    let [x, y, ..] = &fixed.energy_ratios;
    let error = |point: usize| (x[point] - 1.0).abs().max((y[point] - 1.0).abs());
    let off = (0..x.len())
        .filter(|&point| error(point) > ENERGY_TOLERANCE)
        .count();
    let worst = (0..x.len())
        .max_by(|&i, &j| error(i).total_cmp(&error(j)))
        .unwrap_or_default();
    let [at_x, at_y] = mesh.positions[worst];
    format!(
        "the domain correction did not converge in {} sweeps (last change {:.2e}): {off} of {} points have energies off \
         by more than {ENERGY_TOLERANCE}, the worst by {:.1e} (node {} at {at_x:.4}, {at_y:.4}); more \
         correction.max_sweeps may help",
        correction.sweeps,
        correction.last_change,
        x.len(),
        error(worst),
        mesh.node_tags[worst],
    )
}

fn poisson_warning(law: Law, material: &Isotropic, plane: Plane) -> Option<String> {
    let (poisson, limit) = (material.poisson, Isotropic::central_force_poisson(plane));
    match law {
        Law::Bbpd if (poisson - limit).abs() > POISSON_TOLERANCE => Some(format!(
            "Poisson's ratio {poisson} is not used: bonds that only resist stretch have {limit:.4}"
        )),
        Law::Bbpd => None,
        Law::Pds if poisson > limit => Some(format!(
            "Poisson's ratio {poisson} is greater than {limit:.4}: the shear stiffness of the bonds is negative, the stability \
             of the intact model is checked"
        )),
        _ if poisson > limit => Some(format!(
            "Poisson's ratio {poisson} is greater than {limit:.4}: shear and rotational stiffness of the bonds are negative, \
             the stability of the intact model is checked"
        )),
        _ => None,
    }
}
