//! Sections, cracks and patch tests in the words of the plane and of space.

use std::io::{self, Write};

use ligament::formulation::constants;
use ligament::setup::Dim;
use ligament::{Model, Setup};
use ligament_model::Material;
use ligament_run::stages::Stages;

use super::told::Told;
use super::{Extent, criteria, model, patch_test, solid_patch_test};

impl Told<2> for Dim {
    fn section(out: &mut dyn Write, model: &Model) -> io::Result<()> {
        model::write_section(out, model)
    }

    fn young(setup: &Setup, material: &Material) -> Option<f64> {
        let plane = setup.plane();
        let constants = constants(material, &setup.law, plane)?;
        Some(constants.in_plane(plane).young)
    }

    fn cracks(out: &mut dyn Write, model: &Model) -> io::Result<()> {
        criteria::write_cracks(out, model)
    }

    fn patch_test(
        out: &mut dyn Write,
        extent: Extent,
        model: &Model,
        stages: &mut Stages,
    ) -> anyhow::Result<()> {
        Ok(patch_test::write(out, extent, model, stages)?)
    }
}

impl Told<3> for Dim {
    fn section(_: &mut dyn Write, _: &Model<3>) -> io::Result<()> {
        Ok(())
    }

    fn young(_: &Setup<3>, material: &Material) -> Option<f64> {
        Some(material.elasticity.isotropic()?.young)
    }

    fn cracks(_: &mut dyn Write, _: &Model<3>) -> io::Result<()> {
        Ok(())
    }

    fn patch_test(
        out: &mut dyn Write,
        extent: Extent,
        model: &Model<3>,
        stages: &mut Stages,
    ) -> anyhow::Result<()> {
        Ok(solid_patch_test::write(out, extent, model, stages)?)
    }
}
