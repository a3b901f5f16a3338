//! Report of `ligament check` on a motion in time.

use std::io;

use ligament::Loading;
use ligament::setup::Setup;
use ligament_analysis::driver::motion::time_step;
use ligament_analysis::motion::{MotionSettings, Scheme};
use ligament_case::case::CaseFile;
use ligament_model::material::PlaneWaves;
use ligament_output::quantity::quantity;
use ligament_run::model::Model;
use ligament_run::stages::Stages;

use super::report::CheckExtent;
use super::report::Report;
use super::{loading, model};

/// Fewest points along a wave that is not much slower than the wave of the material.
const FEWEST_POINTS: f64 = 10.0;

/// Checks supports, loads and masses, and writes what the motion will do.
pub(super) fn check(
    case: &CaseFile,
    settings: &MotionSettings,
    extent: CheckExtent,
    model: &Model,
    stages: &mut Stages,
    report: &mut Report<'_>,
) -> anyhow::Result<()> {
    let loads = Loading::new(model);
    let loads = loads.map_err(|it| case.error_at_key(it))?;
    let problem = loads.problem(model);
    let step = match (extent, loads.motion(&problem)) {
        (CheckExtent::Matrix | CheckExtent::PatchTest, Some(motion)) => {
            Some(stages.time("critical step", || time_step(&motion, settings))?)
        }
        (CheckExtent::Model, _) | (_, None) => None,
    };
    model::write(report, case, model)?;
    loading::write_boundary(report, model, &loads)?;
    loading::write_room(report, case, model)?;
    report.head("motion");
    let rows = settings.rows;
    let duration = quantity(settings.duration, "s");
    report.entry(
        "duration",
        format!("{duration}, {rows} rows of the history"),
    )?;
    if let Some(step) = step {
        let critical = step.critical;
        let words = format!(
            "{}, of {} along {}",
            quantity(critical.step, "s"),
            model.body().place(critical.point),
            critical.component.name()
        );
        report.entry("critical step", words)?;
        let length = quantity(step.step, "s");
        let words = match settings.scheme {
            Scheme::Auto => format!(
                "{length} where the body moves; equilibria from row to row before and after"
            ),
            Scheme::Explicit | Scheme::Implicit => {
                let count = (settings.duration / step.step).round();
                format!("{length}, {count} steps")
            }
        };
        report.entry("time step", words)?;
    }
    Ok(write_waves(report, model)?)
}

/// Writes the speeds of plane waves along x in each material, and how many points lie along the shortest wave of the loads.
fn write_waves(report: &mut Report<'_>, model: &Model) -> io::Result<()> {
    let setup = &model.setup;
    let speeds: Vec<Vec<f64>> = (0..setup.materials.len())
        .filter_map(|index| speeds(setup, index))
        .collect();
    for (region, speeds) in setup.materials.iter().zip(&speeds) {
        let name = match region.material.name.as_str() {
            "" => "waves along x".to_owned(),
            name => format!("waves in {name}"),
        };
        let words: Vec<String> = speeds.iter().map(|it| quantity(*it, "m/s")).collect();
        report.entry(&name, words.join(", "))?;
    }
    let amplitudes = setup.loads.iter().filter_map(|it| it.amplitude.as_ref());
    let shortest = amplitudes
        .filter_map(|it| it.shortest_time())
        .reduce(f64::min);
    let slowest = speeds
        .iter()
        .filter_map(|it| it.first().copied())
        .reduce(f64::min);
    let (Some(time), Some(speed)) = (shortest, slowest) else {
        return Ok(());
    };
    let spacing = model.system.spacing.iter().copied().fold(0.0, f64::max);
    let points = time * speed / spacing;
    let length = quantity(time * speed, "m");
    report.entry(
        "shortest wave",
        format!("{length}, {points:.0} points long"),
    )?;
    if points < FEWEST_POINTS {
        report.line(format!(
            "warning: the shortest wave of the loads is {points:.1} points long, and waves of fewer than {FEWEST_POINTS} points are too slow: \
             take a longer pulse or more points"
        ))?;
    }
    Ok(())
}

/// Speeds of the plane waves along x in a material, fastest first, m/s.
fn speeds(setup: &Setup, index: usize) -> Option<Vec<f64>> {
    let material = &setup.materials[index].material;
    let (elasticity, density) = (&material.elasticity, material.density?);
    let plane = setup.plane();
    Some(match setup.body.dimensions() {
        2 => PlaneWaves::new(elasticity, plane, density, [1.0, 0.0])?
            .speeds
            .to_vec(),
        _ => {
            let waves = PlaneWaves::new(elasticity, plane, density, [1.0, 0.0, 0.0])?;
            waves.speeds[..2].to_vec()
        }
    })
}
