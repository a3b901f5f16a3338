//! Sections and cracks in the words of the plane and of space.

use std::io::{self, Write};

use ligament::formulation::constants;
use ligament::setup::Dim;
use ligament::{Model, Setup};
use ligament_model::Material;

use super::told::Told;
use super::{criteria, model};

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
}
