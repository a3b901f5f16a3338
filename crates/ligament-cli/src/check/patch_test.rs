//! What `ligament check` tells of the stiffness of the body as it is discretised.

use std::io::{self, Write};

use ligament::patch_test::{Constants, PatchTest, patch_test};
use ligament_output::quantity::{place, quantity};
use ligament_run::model::Model;
use ligament_run::stages::Stages;

use super::Extent;
use super::entry::entry;

/// Points of a body up to which the test is done unasked: at 10,000 points of thirty bonds it takes a second or two, several times what
/// all else of a check does, at 100,000 half a minute and 3 GB.
const MOST_POINTS: usize = 20_000;

/// Writes the elastic constants of the free body, and how far its bonds are from uniform strains.
pub(super) fn write(
    out: &mut dyn Write,
    extent: Extent,
    model: &Model,
    stages: &mut Stages,
) -> io::Result<()> {
    if extent == Extent::Model {
        return Ok(());
    }
    writeln!(out, "free body under uniform stress")?;
    let points = model.system.cloud.len();
    if extent == Extent::Matrix && points > MOST_POINTS {
        let words = format!(
            "it takes a factor of the matrix, and the body has more than {MOST_POINTS} points; ask with --patch-test"
        );
        return entry(out, "not computed", words);
    }
    if model.cut_bonds() > 0 {
        entry(out, "pre-cracks", "left out: the whole body is tested")?;
    }
    match stages.time("patch test", || patch_test(model)) {
        Ok(test) => write_test(out, &test),
        Err(reason) => entry(out, "not computed", reason),
    }
}

fn write_test(out: &mut dyn Write, test: &PatchTest) -> io::Result<()> {
    match &test.constants {
        Some(constants) => write_constants(out, constants)?,
        None => entry(
            out,
            "E, nu",
            "none: several materials do not strain uniformly under a uniform stress",
        )?,
    }
    let percent = test.scatter.map(|it| format!("{:.2}", 100.0 * it));
    let words = format!(
        "off the mean strain by {} % rms (along x, along y, in shear), at most {:.1} % at {}",
        percent.join(", "),
        100.0 * test.largest,
        place(&test.place)
    );
    entry(out, "strains of the bonds", words)
}

fn write_constants(out: &mut dyn Write, constants: &Constants) -> io::Result<()> {
    let Constants {
        angle,
        body,
        material,
    } = constants;
    let modulus = |found: f64, given: f64| {
        format!(
            "{} ({:+.2} %)",
            quantity(found, "Pa"),
            100.0 * (found / given - 1.0)
        )
    };
    let [one, two] = [0, 1].map(|axis| modulus(body.young[axis], material.young[axis]));
    let [first, second] = match angle {
        None => ["x", "y"],
        Some(_) => ["axis 1", "axis 2"],
    };
    entry(
        out,
        "Young's modulus",
        format!("{one} along {first}, {two} along {second}"),
    )?;
    let poisson = format!("{:.4} for {:.4}", body.poisson, material.poisson);
    entry(out, "Poisson's ratio", poisson)?;
    entry(
        out,
        "shear modulus",
        modulus(body.shear_modulus, material.shear_modulus),
    )
}
