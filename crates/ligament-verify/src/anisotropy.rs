//! First yield on irregular meshes, compared with lattices: effect of the bonds' directions on criteria.

use std::sync::Arc;

use anyhow::{Context, bail};
use ligament_model::failure::Criteria;
use ligament_post::yielding::field::{Distribution, families, mean_error};
use ligament_post::yielding::{Family, PrincipalStretches, lattice};
use ligament_run::model::Model;
use ligament_study::yielding::criteria::{Combination, Strengths};

/// Strengths for equal limits of all bonds, on which errors under one measure do not depend.
const STRENGTHS: Strengths = Strengths::TABLE_STRENGTHS;

fn uniform(criterion: &str, n_bonds: usize) -> anyhow::Result<Criteria> {
    let combination: Combination = criterion.parse().map_err(anyhow::Error::msg)?;
    Ok(combination.criteria(&STRENGTHS, n_bonds)?)
}

/// The error of the lattice whose families have about `size` bonds.
fn on_lattice(size: f64, criterion: &str, strains: PrincipalStretches) -> anyhow::Result<f64> {
    let directions = lattice::directions(lattice::ratio_of_size(size));
    let criteria = uniform(criterion, directions.len())?;
    let worst = Family::from_directions(&directions, &criteria).worst(strains);
    Ok(worst.context("nothing yields")?.error)
}

/// Statistics of the errors on a mesh.
pub(super) struct Anisotropy {
    criterion: String,
    strains: PrincipalStretches,
    /// Mean number of bonds of an interior point.
    size: f64,
    /// Errors of the interior points.
    errors: Distribution,
    /// Largest minus smallest mean error over all points at one orientation.
    range: f64,
}

impl Anisotropy {
    /// The errors of a model with a criterion (`strength` for the criterion of the model), under an `extension` or `shear`.
    pub(super) fn new(model: &Model, criterion: &str, strain: &str) -> anyhow::Result<Self> {
        let strains = match strain {
            "extension" => PrincipalStretches::new(1.0, 0.0),
            "shear" => PrincipalStretches::new(1.0, -1.0),
            other => bail!("no strain `{other}`"),
        };
        // The criterion of stretch has only its limit in tension, so that compression does not limit pure shear.
        let criterion = match criterion {
            "stretch" => "tension",
            other => other,
        };
        let system = model.plane();
        let criteria = match criterion {
            "strength" => model.criteria.clone(),
            other => Arc::new(uniform(other, system.bonds.len())?),
        };
        let is_interior = model.interior(&model.body().rim());
        let yields = families(system, &criteria, |_| strains);
        let inside: Vec<u32> = (0..)
            .zip(&is_interior)
            .filter(|(_, is_in)| **is_in)
            .map(|(point, _)| point)
            .collect();
        let sizes = inside
            .iter()
            .map(|&point| system.bonds.incidence.at(point).len() as f64);
        let errors = inside
            .iter()
            .filter_map(|&point| Some(yields[point as usize]?.worst.error));
        let errors = Distribution::from_values(errors.collect()).context("nothing yields")?;
        let (mut lowest, mut highest) = (f64::INFINITY, 0.0);
        for degrees in 0..180u32 {
            let orientation = f64::from(degrees).to_radians();
            let mean = mean_error(system, &criteria, strains, &inside, orientation);
            let mean = mean.context("nothing yields")?;
            (lowest, highest) = (f64::min(lowest, mean), f64::max(highest, mean));
        }
        Ok(Self {
            criterion: criterion.to_owned(),
            strains,
            size: sizes.sum::<f64>() / inside.len() as f64,
            errors,
            range: highest - lowest,
        })
    }

    /// A statistic by its name.
    pub(super) fn named(&self, name: &str) -> anyhow::Result<f64> {
        Ok(match name {
            "bonds" => self.size,
            "mean" => self.errors.mean,
            "percentile_5" => self.errors.percentile_5,
            "percentile_95" => self.errors.percentile_95,
            "worst" => self.errors.worst,
            "common" => self.range,
            "lattice" => on_lattice(self.size, &self.criterion, self.strains)?,
            other => bail!("no statistic `{other}`"),
        })
    }
}
