//! Report of `ligament check` on the stiffness of the body in bending and, in space, in torsion, and on the horizon over the smallest ligament.

use std::io;

use ligament::Model;
use ligament::bending_test::{
    BendingTest, MOST_SIDES, Section, THICK, TOO_STIFF, WIDE, bending_test, most_points,
    smallest_ligament, thinnest_section,
};
use ligament::setup::Surface;
use ligament_output::quantity::{place, quantity};
use ligament_run::stages::Stages;

use super::report::CheckExtent;
use super::report::Report;

/// Errors of peaks by the ratio of the horizon to the ligament, up to a ratio: notched beams, panels and a torsion test against cohesive
/// finite elements (docs/verification.md).
const ERRORS: [(f64, &str); 3] = [
    (0.2, "some 1 to 3 %"),
    (0.4, "some 2 to 5 %"),
    (f64::INFINITY, "some 8 to 22 %"),
];

/// Writes the stiffness of the body at its thinnest section over that of the continuum; returns a warning where it is too large.
pub(super) fn write(
    report: &mut Report<'_>,
    extent: CheckExtent,
    model: &Model,
    stages: &mut Stages,
) -> io::Result<Option<String>> {
    if extent == CheckExtent::Model {
        return Ok(None);
    }
    report.head("strip at the thinnest section, bent");
    let (most_points, most_sides) = match extent {
        CheckExtent::PatchTest => (usize::MAX, usize::MAX),
        _ => (most_points(model.setup.body.dimensions()), MOST_SIDES),
    };
    let section = match stages.time("section", || thinnest_section(model, most_sides)) {
        Ok(section) => section,
        Err(reason) => return report.detail("not computed", reason).map(|()| None),
    };
    let words = format!(
        "{} at {}, {:.1} distances of points across, {:.1} horizons",
        quantity(section.thickness, "m"),
        place(&section.place[..model.setup.body.dimensions()]),
        section.thickness / section.spacing,
        section.horizons()
    );
    report.detail("thinnest section", words)?;
    if section.horizons() > THICK && !model.setup.law.row.resists_rotations() {
        let words = format!("more than {THICK} horizons across, which is enough for bending");
        report.detail("not tested", words)?;
        return Ok(None);
    }
    let tested = stages.time("bending test", || {
        bending_test(model, &section, most_points)
    });
    match tested {
        Ok(test) => {
            write_test(report, &test)?;
            Ok((test.largest() > TOO_STIFF).then(|| warning(model, &section, &test)))
        }
        Err(reason) => report.detail("not computed", reason).map(|()| None),
    }
}

fn write_test(report: &mut Report<'_>, test: &BendingTest) -> io::Result<()> {
    let words = |stiffness: f64| {
        let more = 100.0 * (stiffness - 1.0);
        format!(
            "{} as stiff as the material ({more:+.1} %)",
            ratio_text(stiffness)
        )
    };
    let of = format!("{}, a strip of {} points", words(test.bending), test.points);
    report.entry("in bending", of)?;
    match test.torsion {
        Some(torsion) => report.entry("in torsion", words(torsion)),
        None => Ok(()),
    }
}

/// Text of a ratio of stiffnesses, without digits above one hundred.
fn ratio_text(stiffness: f64) -> String {
    match stiffness > 100.0 {
        true => "more than 100 times".to_owned(),
        false => format!("{stiffness:.3} times"),
    }
}

fn warning(model: &Model, section: &Section, test: &BendingTest) -> String {
    let across = section.thickness / section.spacing;
    let torsion = test
        .torsion
        .map(|it| format!(" and {} in torsion", ratio_text(it)));
    let is_patched = matches!(model.setup.correction.surface, Surface::Patch(_));
    let cure = match test.refinement() {
        Some(factor) if is_patched => {
            format!(
                "about {:.0} distances keep the error within 5 %",
                (across / factor).ceil()
            )
        }
        Some(_) => "a finer mesh and correction.surface = \"patch\" reduce this".to_owned(),
        None => "a finer mesh does not help".to_owned(),
    };
    format!(
        "the body is {} as stiff as its material in bending{} where it is thinnest, {} with {across:.1} distances of points across at \
         {}: {cure}",
        ratio_text(test.bending),
        torsion.unwrap_or_default(),
        quantity(section.thickness, "m"),
        place(&section.place[..model.setup.body.dimensions()]),
    )
}

/// Writes the smallest ligament of a body whose bonds may break, in horizons; returns a warning where bonds soften and it has too few.
pub(super) fn write_ligament(
    report: &mut Report<'_>,
    extent: CheckExtent,
    model: &Model,
    stages: &mut Stages,
) -> io::Result<Option<String>> {
    let criteria = &model.criteria.list;
    if extent == CheckExtent::Model || criteria.is_empty() {
        return Ok(None);
    }
    let Ok(section) = stages.time("ligament", || smallest_ligament(model, MOST_SIDES)) else {
        return Ok(None);
    };
    let dimensions = model.setup.body.dimensions();
    let ratio = 1.0 / section.horizons();
    let [length, middle] = [
        quantity(section.thickness, "m"),
        place(&section.place[..dimensions]),
    ];
    report.head("smallest ligament");
    report.detail("ligament", format!("{length}, its middle at {middle}"))?;
    report.detail("horizon", format!("{ratio:.2} of it"))?;
    let softens = criteria.iter().any(|it| !it.after.is_brittle());
    let error = ERRORS.iter().find(|(up_to, _)| ratio <= *up_to);
    Ok(error
        .filter(|_| softens && ratio > WIDE)
        .map(|(_, error)| {
            format!(
                "the horizon is {ratio:.2} of the ligament of {length} at {middle}: the largest load is then {error} too high by \
                 `rankine`, because bonds resist gradients and rotations; a finer mesh there reduces this"
            )
        }))
}
