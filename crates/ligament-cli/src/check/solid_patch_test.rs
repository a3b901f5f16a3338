//! What `ligament check` tells of the stiffness of a body in space as it is discretised.

use std::io::{self, Write};

use ligament::Model;
use ligament::patch_test::{SolidPatchTest, solid_patch_test};
use ligament_model::Isotropic;
use ligament_model::space::uniform_strain::SolidConstants;
use ligament_output::quantity::{place, quantity};
use ligament_run::stages::Stages;

use super::Extent;
use super::entry::entry;

/// Points of a body up to which the test is done unasked.
const MOST_POINTS: usize = 2_000;

/// Writes the elastic constants of the free body, and how far its bonds are from uniform strains.
pub(super) fn write(
    out: &mut dyn Write,
    extent: Extent,
    model: &Model<3>,
    stages: &mut Stages,
) -> io::Result<()> {
    if extent == Extent::Model {
        return Ok(());
    }
    writeln!(out, "free body under uniform stress")?;
    let points = model.system.cloud.len();
    if extent == Extent::Matrix && points > MOST_POINTS {
        let words = format!(
            "it takes six solutions, and the body has more than {MOST_POINTS} points; ask with --patch-test"
        );
        return entry(out, "not computed", words);
    }
    match stages.time("patch test", || solid_patch_test(model)) {
        Ok(test) => write_test(out, &test),
        Err(reason) => entry(out, "not computed", reason),
    }
}

fn write_test(out: &mut dyn Write, test: &SolidPatchTest) -> io::Result<()> {
    match &test.constants {
        Some((body, material)) => write_constants(out, body, material)?,
        None => entry(
            out,
            "E, nu",
            "none: several materials do not strain uniformly under a uniform stress",
        )?,
    }
    let percent = test.scatter.map(|it| format!("{:.2}", 100.0 * it));
    let words = format!(
        "off the mean strain by {} % rms (along x, y, z, in shear xy, xz, yz), at most {:.1} % at {}",
        percent.join(", "),
        100.0 * test.largest,
        place(&test.place)
    );
    entry(out, "strains of the bonds", words)
}

fn write_constants(
    out: &mut dyn Write,
    body: &SolidConstants,
    material: &Isotropic,
) -> io::Result<()> {
    let modulus = |found: f64, given: f64| {
        let more = 100.0 * (found / given - 1.0);
        format!("{} ({more:+.2} %)", quantity(found, "Pa"))
    };
    let Isotropic { young, poisson } = *material;
    let [x, y, z] = body.young.map(|it| modulus(it, young));
    let words = format!("{x} along x, {y} along y, {z} along z");
    entry(out, "Young's modulus", words)?;
    let ratios = body.poisson.map(|it| format!("{it:.4}")).join(", ");
    let words = format!("{ratios} in xy, xz, yx, yz, zx, zy for {poisson:.4}");
    entry(out, "Poisson's ratio", words)?;
    let given = 0.5 * young / (1.0 + poisson);
    let [xy, xz, yz] = body.shear_modulus.map(|it| modulus(it, given));
    let words = format!("{xy} in xy, {xz} in xz, {yz} in yz");
    entry(out, "shear modulus", words)
}
