//! Report of `ligament check` on the stiffness of the discrete body.

use std::io;

use ligament::Model;
use ligament::patch_test::{Constants, PatchTest, patch_test};
use ligament_model::tensor::SymTensor;
use ligament_output::quantity::{place, quantity};
use ligament_run::stages::Stages;

use super::report::CheckExtent;
use super::report::Report;

/// Largest number of points for which the test is done by default, in the plane and in space: at 10,000 points of thirty bonds it takes a
/// second or two, several times the rest of a check, at 100,000 half a minute and 3 GB.
const MOST_POINTS: [usize; 2] = [20_000, 2_000];

/// Cost of the test, in the plane and in space.
const COST: [&str; 2] = ["a factor of the matrix", "six solutions"];

/// Names of the axes.
const AXES: [&str; 3] = ["x", "y", "z"];

/// Writes the elastic constants of the free body, and the deviation of its bonds from uniform strains.
pub(super) fn write(
    report: &mut Report<'_>,
    extent: CheckExtent,
    model: &Model,
    stages: &mut Stages,
) -> io::Result<()> {
    if extent == CheckExtent::Model {
        return Ok(());
    }
    report.head("free body under uniform stress");
    let kind = model.setup.body.dimensions() - 2;
    let (most, cost) = (MOST_POINTS[kind], COST[kind]);
    if extent == CheckExtent::Matrix && model.system.n_points() > most {
        let words =
            format!("it needs {cost}, and the body has more than {most} points; use --patch-test");
        return report.entry("not computed", words);
    }
    if model.cut_bonds() > 0 {
        report.detail("pre-cracks", "ignored: the test uses the intact body")?;
    }
    match stages.time("patch test", || patch_test(model)) {
        Ok(test) => write_test(report, &test),
        Err(reason) => report.entry("not computed", reason),
    }
}

fn write_test(report: &mut Report<'_>, test: &PatchTest) -> io::Result<()> {
    let dimensions = test.place.len();
    match &test.constants {
        Some(constants) => write_constants(report, constants, dimensions)?,
        None => report.entry(
            "E, nu",
            "none: a body of several materials does not strain uniformly under a uniform stress",
        )?,
    }
    // Order: along the axes, then in shear.
    let places = SymTensor::<3>::COMPONENTS.iter().zip(&test.scatter);
    let (along, in_shear): (Vec<_>, Vec<_>) = places.partition(|([i, j], _)| i == j);
    let all = along.iter().chain(&in_shear);
    let percent: Vec<String> = all.map(|(_, it)| format!("{:.2}", 100.0 * *it)).collect();
    let strains = match dimensions {
        2 => "along x, along y, in shear",
        _ => "along x, y, z, in shear xy, xz, yz",
    };
    let words = format!(
        "differ from the mean strain by {} % rms ({strains}), at most {:.1} % at {}",
        percent.join(", "),
        100.0 * test.largest,
        place(&test.place)
    );
    report.detail("strains of the bonds", words)
}

fn write_constants(
    report: &mut Report<'_>,
    constants: &Constants,
    dimensions: usize,
) -> io::Result<()> {
    let Constants {
        angle,
        body,
        material,
    } = constants;
    let modulus = |found: f64, given: f64| {
        let more = 100.0 * (found / given - 1.0);
        format!("{} ({more:+.2} %)", quantity(found, "Pa"))
    };
    let axis = |axis: usize| match angle {
        None => AXES[axis].to_owned(),
        Some(_) => format!("axis {}", axis + 1),
    };
    let young = (0..dimensions).map(|it| {
        let modulus = modulus(body.young[it], material.young[it]);
        format!("{modulus} along {}", axis(it))
    });
    let young: Vec<String> = young.collect();
    report.entry("Young's modulus", young.join(", "))?;
    let given = material.poisson[0][1];
    let pairs = (0..dimensions).flat_map(|a| (0..dimensions).map(move |b| (a, b)));
    let ratios = pairs.filter(|(a, b)| a != b);
    let ratios = ratios.map(|(a, b)| format!("{:.4}", body.poisson[a][b]));
    let ratios: Vec<String> = ratios.collect();
    let words = match dimensions {
        2 => format!("{} for {given:.4}", ratios[0]),
        _ => format!(
            "{} in xy, xz, yx, yz, zx, zy for {given:.4}",
            ratios.join(", ")
        ),
    };
    report.entry("Poisson's ratio", words)?;
    let places = SymTensor::<3>::COMPONENTS
        .iter()
        .filter(|[i, j]| i < j && *j < dimensions);
    let moduli = places.map(|&[i, j]| {
        let shear_modulus = body.shear_modulus.at(i, j);
        let modulus = modulus(shear_modulus, material.shear_modulus.at(i, j));
        match dimensions {
            2 => modulus,
            _ => format!("{modulus} in {}{}", AXES[i], AXES[j]),
        }
    });
    let moduli: Vec<String> = moduli.collect();
    report.detail("shear modulus", moduli.join(", "))
}
