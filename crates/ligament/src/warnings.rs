//! What a user should know about a model before trusting its results.

use ligament_mesh::Mesh;
use ligament_model::correction::CorrectionReport;
use ligament_model::{Material, Plane};

use crate::case::CaseFile;
use crate::resolve;

/// Below this the domain correction is not known to have a fixed point.
const SMALLEST_SAFE_FACTOR: f64 = 2.0;

/// Warnings about the mesh, the horizon factor, the correction and the materials.
pub fn of_model(case: &CaseFile, mesh: &Mesh, correction: &CorrectionReport) -> Vec<String> {
    let mut warnings: Vec<String> = mesh
        .remarks
        .iter()
        .map(|remark| format!("mesh: {remark}"))
        .collect();
    let factor = case.case.model.horizon_factor;
    if factor < SMALLEST_SAFE_FACTOR {
        warnings.push(format!(
            "model.horizon_factor = {factor} is less than {SMALLEST_SAFE_FACTOR}: the domain correction may have no \
             fixed point, and peak loads then depend on the number of sweeps"
        ));
    }
    if !correction.converged {
        warnings.push(format!(
            "the domain correction did not converge in {} sweeps (last change {:.2e}, energy off by up to {:.1e} at a \
             point): raise correction.max_sweeps or model.horizon_factor",
            correction.sweeps, correction.last_change, correction.largest_residual
        ));
    }
    let plane = resolve::plane(case);
    warnings.extend(
        resolve::materials(case)
            .iter()
            .filter_map(|material| poisson_warning(material, plane)),
    );
    warnings
}

fn poisson_warning(material: &Material, plane: Plane) -> Option<String> {
    let limit = Material::central_force_poisson(plane);
    (material.poisson > limit).then(|| {
        format!(
            "Poisson's ratio {} is greater than {limit:.4}: shear and rotational stiffness of the bonds are negative, \
             the stability of the intact model is checked",
            material.poisson
        )
    })
}
