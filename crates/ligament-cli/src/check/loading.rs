//! Report of `ligament check` on a case with loads: supports, loads, equations and disk space.

use std::io;
use std::path::Path;

use ligament::Loading;
use ligament::foresight::refuse;
use ligament::setup::{
    Analysis, ELASTIC_ENERGY_TOLERANCE, Load, Position, Reading as Given, RigidForm, Setup, Support,
};
use ligament::units::Units;
use ligament_analysis::probe::{Reading, Shares};
use ligament_analysis::{ControlKind, Equilibrium, gauges};
use ligament_case::case::CaseFile;
use ligament_model::tensor::norm;
use ligament_output::quantity::quantity;
use ligament_run::disk::{self, FieldsOnDisk};
use ligament_run::memory;
use ligament_run::messages::with_point_names;
use ligament_run::model::Model;
use ligament_run::stages::Stages;
use ligament_run::summary::temperature_change;

use super::body::write_group;
use super::first_failure::{self, PredictedRun};
use super::report::{CheckExtent, Report, megabytes, spread};
use super::{equations, model};

/// Checks supports, loads and equations, and returns what a run would tell before its first load step.
pub(super) fn check(
    case: &CaseFile,
    extent: CheckExtent,
    model: &Model,
    stages: &mut Stages,
    report: &mut Report<'_>,
) -> anyhow::Result<PredictedRun> {
    let loading = Loading::new(model);
    let mut loading = loading.map_err(|it| case.error_at_key(it))?;
    loading.solver.factor_memory = memory::factor_bytes(case, &*model.system);
    let problem = loading.problem(model);
    let equilibrium = match extent {
        CheckExtent::Model => None,
        CheckExtent::Matrix | CheckExtent::PatchTest => Some(stages.time("analysis", || {
            Equilibrium::new(&problem, ELASTIC_ENERGY_TOLERANCE)
        })?),
    };

    model::write(report, case, model)?;
    write_boundary(report, model, &loading)?;
    // Contact may hold a free body.
    let free = gauges::of_intact_body(&*model.system, &*loading.boundary);
    for free in free.into_iter().filter(|_| !model.setup.has_contact()) {
        let message = with_point_names(
            free.message(model.setup.closing),
            model.body(),
            &model.setup,
        );
        report.entry("not held", message)?;
    }
    write_loading(report, &model.setup)?;
    write_room(report, case, model)?;
    if let Some(equilibrium) = &equilibrium {
        equations::write(report, case, model, equilibrium)?;
    }
    refuse(&problem, &model.setup.analysis).map_err(|it| case.error_in_case_terms(it))?;
    let Some(equilibrium) = equilibrium else {
        return Ok(PredictedRun::default());
    };
    let too_costly = first_failure::too_costly(case, extent, &problem, &equilibrium);
    drop(equilibrium);
    first_failure::write(report, case, model, &problem, too_costly, stages)
}

/// Writes the disk space of the fields, and a warning where the disk of the current folder has less.
pub(super) fn write_room(
    report: &mut Report<'_>,
    case: &CaseFile,
    model: &Model,
) -> io::Result<()> {
    let fields = FieldsOnDisk::new(case, model);
    let of_one = megabytes(fields.of_one);
    let Some((most, all)) = fields.most.zip(fields.all()) else {
        let words = format!("about {of_one} every {} events", fields.every);
        return report.detail("fields on disk", words);
    };
    let between = match case.case.output.during_breakage {
        0 => String::new(),
        most => format!(", and up to {most} between the breakages of a load step"),
    };
    let words = format!(
        "about {}, at most {most} states of {of_one}{between}",
        megabytes(all)
    );
    report.detail("fields on disk", words)?;
    match disk::free(Path::new(".")) {
        Some(free) if all > free => report.line(format!(
            "warning: the fields may need {}, and the disk has {} free: set a larger output.fields_every, or output.bonds = false",
            megabytes(all),
            megabytes(free)
        )),
        _ => Ok(()),
    }
}

pub(super) fn write_boundary(
    report: &mut Report<'_>,
    model: &Model,
    loading: &Loading,
) -> io::Result<()> {
    let body = model.body();
    report.head("supports and loads");
    for group in &loading.boundary.groups {
        write_group(report, body, &group.name, &group.points)?;
    }
    write_restraints(report, &model.setup)?;
    write_rigid_bodies(report, model, loading)?;
    if let Some(changes) = temperature_change(&loading.boundary) {
        report.entry("temperature change", spread(changes, "K"))?;
    }
    let control = &loading.boundary.control;
    let points = control.points.len();
    let units = model.setup.units();
    let what = match control.kind {
        ControlKind::Temperature => "the temperature, changed by".to_owned(),
        ControlKind::Displacement => format!("{points} points, moved by"),
        ControlKind::Force => format!("{points} points, loaded by"),
        ControlKind::RigidBody(body) => {
            format!("`{}`, moved by", model.setup.rigid_bodies[body].name)
        }
        ControlKind::FreeBody(body) => {
            let name = &model.setup.rigid_bodies[body].name;
            format!("nothing; the curve is of `{name}`, which starts with")
        }
    };
    let unit = model.setup.control_unit();
    let words = match control.kind {
        ControlKind::Force if points == 0 => "nothing, so that the curve is zero".to_owned(),
        _ => format!("{what} {}", quantity(control.magnitude, unit)),
    };
    report.entry("controlled by", words)?;
    if control.kind == ControlKind::Force && units == Units::COUPLE {
        let words =
            "mean rotation of the loaded points, rad, which is larger than that of the section";
        report.detail("displacement is", words)?;
    }
    if loading.boundary.is_displaced_by_all() {
        let words = "on which all forces do work, over the size of this load: the body is free";
        report.detail("displacement is", words)?;
    }
    write_probes(report, model, loading)
}

/// Writes what each probe reads.
fn write_probes(report: &mut Report<'_>, model: &Model, loading: &Loading) -> io::Result<()> {
    for (probe, given) in loading.probes.iter().zip(&model.setup.probes) {
        let words = |(place, position): (&Shares, &Position)| place_words(model, place, *position);
        let reads = match (&probe.reading, &given.reading) {
            (Reading::RelativeDisplacement { places, .. }, Given::Between { positions, .. }) => {
                let words: Vec<String> = places.iter().zip(positions).map(words).collect();
                words.join(" to ")
            }
            (Reading::Field { place, .. }, Given::At { position, .. }) => words((place, position)),
            (Reading::SectionForce { bonds, .. }, _) => format!("{} bonds", bonds.len()),
            (Reading::Field { place, .. }, _) => format!("mean over {} points", place.len()),
            (Reading::Force { points, .. }, _) => format!("force on {} points", points.len()),
            (Reading::GrowingTip(_), _) => "ring that follows the crack".into(),
            (Reading::Tip(integral), _) => format!("ring with {} points", integral.points().len()),
            _ => continue,
        };
        report.entry(&format!("probe {}", probe.name), reads)?;
    }
    Ok(())
}

/// Writes shape, gap and motion of each rigid body.
fn write_rigid_bodies(report: &mut Report<'_>, model: &Model, loading: &Loading) -> io::Result<()> {
    let setup = &model.setup;
    for (body, given) in loading.contact.rigid_bodies.iter().zip(&setup.rigid_bodies) {
        let shape = match given.form {
            RigidForm::Ball { .. } if setup.body.dimensions() == 3 => "sphere",
            RigidForm::Ball { .. } => "circle",
            RigidForm::Wall { .. } => "wall",
            RigidForm::Box { .. } => "box",
        };
        let size = norm(given.motion());
        let unit = match setup.analysis.is_motion() {
            true => "m/s",
            false => "m",
        };
        let motion = match given.mass {
            Some(mass) => format!(
                "{}, {} at the start",
                quantity(mass, "kg"),
                quantity(size, unit)
            ),
            None if size == 0.0 => "at rest".to_owned(),
            None => format!("moved by {}", quantity(size, unit)),
        };
        let words = format!(
            "{shape}, {} from the body, {motion}",
            quantity(body.gap, "m")
        );
        report.entry(&format!("rigid {}", body.name), words)?;
    }
    Ok(())
}

/// Description of the points of a probe: those of the cell around its position, or the nearest point with its distance.
fn place_words(model: &Model, place: &Shares, position: Position) -> String {
    let body = model.body();
    let [(point, _)] = place[..] else {
        let labels: Vec<String> = place.iter().map(|(point, _)| body.label(*point)).collect();
        return format!("within {}", labels.join(", "));
    };
    let words = body.place(point);
    let distance = model.distance_to(point, position);
    if distance == 0.0 {
        return words;
    }
    let unit = model.setup.units().displacement;
    format!("{words}, {} from the position", quantity(distance, unit))
}

fn write_loading(report: &mut Report<'_>, setup: &Setup) -> io::Result<()> {
    let steps = setup.n_steps().unwrap_or(0);
    let stages: Vec<&str> = setup.stages.iter().map(|it| it.name.as_str()).collect();
    if !stages.is_empty() {
        report.entry("stages", stages.join(", "))?;
    }
    let loading = match &setup.analysis {
        Analysis::Stepped(_) => format!("{steps} load steps"),
        Analysis::Event(_) if !stages.is_empty() => {
            "exact path from breakage to breakage, through all stages".to_owned()
        }
        Analysis::Elastic { .. } if !stages.is_empty() => {
            format!("{steps} elastic solutions, one at the end of each part of a stage")
        }
        Analysis::Event(_) => {
            "exact path from breakage to breakage, up to load factor 1".to_owned()
        }
        Analysis::Elastic { .. } | Analysis::Modal(_) | Analysis::Motion(_) => {
            "one elastic solution at load factor 1".to_owned()
        }
    };
    report.detail("analysis", loading)
}

/// Writes the fixed components and springs of each support, and the loads through springs or a platen.
fn write_restraints(report: &mut Report<'_>, setup: &Setup) -> io::Result<()> {
    for (index, support) in setup.supports.iter().enumerate() {
        let name = format!("{} holds", support.name(index));
        report.entry(
            &name,
            support_words(support, setup.body.dimensions()).join(", "),
        )?;
    }
    for load in setup.loads.iter().filter(|it| it.is_restraint()) {
        report.entry(&format!("{} acts", load.name), load_words(load).join(", "))?;
    }
    Ok(())
}

fn support_words(support: &Support, dimensions: usize) -> Vec<String> {
    let mut words: Vec<String> = (support.components())
        .map(|it| it.name().to_owned())
        .collect();
    for (component, total) in support.stiffness.along_axes().components() {
        let unit = if component.is_rotation() {
            "N m/rad"
        } else {
            "N/m"
        };
        words.push(format!(
            "{} by springs of {}",
            component.name(),
            quantity(total, unit)
        ));
    }
    if let Some(normal) = support.restrained_normal() {
        let spring = support.stiffness.normal;
        let spring = spring.map(|total| format!(" by springs of {}", quantity(total, "N/m")));
        let normal: Vec<String> = normal[..dimensions].iter().map(f64::to_string).collect();
        let normal = normal.join(", ");
        words.push(format!("along ({normal}){}", spring.unwrap_or_default()));
    }
    words
}

fn load_words(load: &Load) -> Vec<String> {
    let springs = load.stiffness;
    let springs = springs.map(|total| format!("through springs of {}", quantity(total, "N/m")));
    let platen = load
        .tilts
        .then(|| "by a rigid platen that may tilt".to_owned());
    springs.into_iter().chain(platen).collect()
}
