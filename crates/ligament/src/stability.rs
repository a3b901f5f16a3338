//! Largest Poisson's ratio with which a body is stable.

use ligament_analysis::driver::stability_of;
use ligament_model::{Elasticity, Isotropic};

use crate::error::Error;
use crate::loading::Loading;
use crate::model::Model;
use crate::setup::{Analysis, Setup};

/// Number of halvings, with one factorisation each.
const HALVINGS: usize = 6;

/// Digits of a ratio after the point.
const DIGITS: f64 = 1e3;

/// The largest Poisson's ratio with which a model is stable, by bisection between the ratio of central forces, with which every body is
/// stable, and the largest ratio of its materials: to a 64th of this interval and three digits. Materials with a smaller ratio keep theirs.
/// `None` where no isotropic material has a ratio above the ratio of central forces, for an analysis without loads, and for a body that is
/// divided between processes.
///
/// # Errors
///
/// If a model with a smaller ratio cannot be built, or its equations cannot be set up.
pub fn largest_poisson(model: &Model) -> Result<Option<f64>, Error> {
    let setup = &model.setup;
    let is_divided = setup.solver.communicator.size() > 1;
    if setup.moduli_of_cells().is_some() {
        return Ok(None);
    }
    let constants = setup.materials.iter();
    let ratios = constants.filter_map(|it| Some(it.material.elasticity.isotropic()?.poisson));
    let mut stable = Isotropic::central_force_poisson(setup.space());
    let mut unstable = ratios.fold(stable, f64::max);
    if is_divided || matches!(setup.analysis, Analysis::Modal(_)) || unstable == stable {
        return Ok(None);
    }
    for _ in 0..HALVINGS {
        let middle = 0.5 * (stable + unstable);
        match is_stable(with_at_most(setup, middle))? {
            true => stable = middle,
            false => unstable = middle,
        }
    }
    Ok(Some((DIGITS * stable).floor() / DIGITS))
}

/// A setup with Poisson's ratios of isotropic materials up to a largest one.
fn with_at_most(setup: &Setup, largest: f64) -> Setup {
    let mut setup = setup.clone();
    for region in &mut setup.materials {
        if let Elasticity::Isotropic(constants) = &mut region.material.elasticity {
            constants.poisson = constants.poisson.min(largest);
        }
    }
    setup
}

/// Whether the intact model of a setup has no more negative eigenvalues than its rotations explain.
fn is_stable(setup: Setup) -> Result<bool, Error> {
    let model = Model::build(setup, &mut ())?;
    let problem = Loading::new(&model)?.problem(&model);
    let stability = stability_of(&problem)?;
    Ok(stability.is_none_or(|it| !it.is_unstable()))
}
