//! Elastic constants and scatter of the patch test, and factors of bonds on a rotated mesh.

use anyhow::Context;
use ligament::Model;
use ligament::patch_test::{Constants, PatchTest};
use ligament_mesh::{AnyMesh, gmsh};

use super::case_run::CaseRun;

/// Ratio of the Young's moduli of body and material, along the axis of the larger difference.
pub(super) fn young(test: &PatchTest) -> anyhow::Result<f64> {
    let [x, y, _] = ratios_of_constants(test)?;
    Ok(further_from_one(x, y))
}

/// Ratios of the constants of the body and of the material: Young's modulus along x and along y, shear modulus.
pub(super) fn ratios_of_constants(test: &PatchTest) -> anyhow::Result<[f64; 3]> {
    let Constants { body, material, .. } = constants(test)?;
    let [x, y] = [0, 1].map(|axis| body.young[axis] / material.young[axis]);
    let shear = body.shear_modulus.at(0, 1) / material.shear_modulus.at(0, 1);
    Ok([x, y, shear])
}

/// Poisson's ratio of the body.
pub(super) fn poisson(test: &PatchTest) -> anyhow::Result<f64> {
    Ok(constants(test)?.body.poisson[0][1])
}

/// Largest root mean square deviation of the strains of bonds from the mean strain, over the size of the mean strain.
pub(super) fn scatter(test: &PatchTest) -> f64 {
    test.scatter.iter().copied().fold(0.0, f64::max)
}

fn constants(test: &PatchTest) -> anyhow::Result<Constants> {
    test.constants
        .context("a body of several materials has no E")
}

/// The ratio, of two, that is farther from 1.
fn further_from_one(one: f64, other: f64) -> f64 {
    if (one - 1.0).abs() < (other - 1.0).abs() {
        other
    } else {
        one
    }
}

/// The factors of the bonds and their ratios, in the order of the mesh file.
fn factors(model: Model) -> Vec<f64> {
    let (numbering, ends) = (model.body().numbering(), &model.plane().bonds.ends);
    let mut bonds: Vec<usize> = (0..ends.len()).collect();
    bonds.sort_by_key(|&bond| numbering.ends_in_file(ends[bond]));
    let fixed = &model.fixed;
    let both = [&fixed.domain_factor, &fixed.shear_ratio].into_iter();
    let found = both.filter(|it| !it.is_empty());
    found
        .flat_map(|values| bonds.iter().map(|&bond| values[bond]))
        .collect()
}

/// Root mean square of the change of the factors of the bonds when the mesh of a case run is turned by an angle, degrees.
pub(super) fn change_by_turn(case_run: &CaseRun, angle: f64) -> anyhow::Result<f64> {
    let (sin, cos) = angle.to_radians().sin_cos();
    let file = case_run.mesh_file().context("the body is no mesh")?;
    let mut mesh = gmsh::parse(&std::fs::read(file)?)?;
    for place in &mut mesh.positions {
        let [x, y] = *place;
        *place = [cos * x - sin * y, sin * x + cos * y];
    }
    let straight = case_run.model()?;
    let turned = case_run.model_with(|setup| setup.body = AnyMesh::Plane(mesh).into())?;
    let (mut sum, mut count) = (0.0, 0.0);
    for (turned, straight) in factors(turned).into_iter().zip(factors(straight)) {
        sum += (turned / straight - 1.0_f64).powi(2);
        count += 1.0;
    }
    Ok((sum / count).sqrt())
}
