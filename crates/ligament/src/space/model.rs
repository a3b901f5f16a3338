//! From a solid body to its discrete model: the page of [`crate::model`] in space.

use std::sync::Arc;

use ligament_model::correction::Correction;
use ligament_model::failure::Criteria;
use ligament_model::space::SolidSystem;
use ligament_model::{BondSet, FixedFields, PointCloud};

use super::formulation;
use crate::error::SetupError;
use crate::loading;
use crate::model::Model;
use crate::setup::Setup;
use crate::stage::{Finding, StageWatcher, stage};
use crate::warning;

impl Model<3> {
    /// Builds the model of a setup in space.
    pub(super) fn in_space(
        setup: Setup<3>,
        watcher: &mut dyn StageWatcher,
    ) -> Result<Self, SetupError> {
        setup.check()?;
        let material_of_cell = loading::material_of_cell(&setup)?;
        let cloud = stage(watcher, "points", || points(&setup, &material_of_cell));
        let horizons = setup.horizon.of_points(&cloud);
        let bonds = stage(watcher, "bonds", || BondSet::search(&cloud, &horizons));
        watcher.found(&Finding::Bonds {
            points: cloud.len(),
            bonds: bonds.len(),
            across_voids: 0,
        });
        let (stiffness, correction) = stage(watcher, "correction", || {
            let alpha = formulation::alpha(&setup, &cloud, &bonds);
            let stiffness = formulation::stiffness(&setup, &cloud, &bonds, &alpha);
            (stiffness, Correction::fixed(alpha, vec![1.0; bonds.len()]))
        });
        watcher.found(&Finding::Correction(&setup.correction, correction.report.as_ref()));
        let fixed = FixedFields {
            horizon: horizons.radius,
            precrack_share: vec![0.0; cloud.len()],
            energy_ratios: Vec::new(),
            domain_factor: correction.domain_factor.clone(),
            shear_ratio: correction.shear_ratio.clone(),
            patch_residual: correction.patch_residual().to_vec(),
            no_fail: loading::no_fail(&setup, &cloud)?,
            scatter: None,
            absent: Vec::new(),
        };
        let system = stage(watcher, "rigidities", || {
            let element = formulation::element(&setup.law);
            let (alpha, omega) = (&correction.length_factor, &correction.domain_factor);
            SolidSystem::new(cloud, bonds, element, stiffness, alpha.clone(), omega)
        });
        let (report, spacing) = (correction.report.as_ref(), &system.cloud.spacing);
        let warnings = warning::of_model(&setup, spacing, report, &fixed, 0);
        Ok(Self {
            warnings,
            correction_range: correction.domain_factor_range(),
            correction: correction.report,
            setup,
            system: Arc::new(system),
            fixed,
            criteria: Arc::new(Criteria::default()),
        })
    }
}

/// The points of the body, with the index of the material of each cell (n_cells).
fn points(setup: &Setup<3>, material_of_cell: &[u32]) -> PointCloud<3> {
    setup.body.cloud(1.0, material_of_cell, setup.materials.len())
}
