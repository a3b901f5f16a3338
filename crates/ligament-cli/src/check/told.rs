//! What `ligament check` tells of bodies in the plane and in space in words of their own.

use std::io::{self, Write};

use ligament::formulation::constants;
use ligament::setup::{Dim, Dimension};
use ligament::{Model, Setup};
use ligament_model::Material;
use ligament_run::stages::Stages;

use super::{Extent, criteria, model, patch_test, solid_patch_test};

/// What is told of a model in D dimensions.
pub(super) trait Told<const D: usize>
where
    Dim: Dimension<D>,
{
    /// Writes what a point stands for.
    fn section(out: &mut dyn Write, model: &Model<D>) -> io::Result<()>;

    /// Young's modulus of a bar of a material with the constants that the law makes of it; None for one with axes.
    fn young(setup: &Setup<D>, material: &Material) -> Option<f64>;

    /// Writes what cracks spend, and what varies at random.
    fn cracks(out: &mut dyn Write, model: &Model<D>) -> io::Result<()>;

    /// Writes how stiff the body is as discretised.
    fn patch_test(
        out: &mut dyn Write,
        extent: Extent,
        model: &Model<D>,
        stages: &mut Stages,
    ) -> anyhow::Result<()>;
}

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
