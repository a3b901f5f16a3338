//! The test of Kalthoff and Winkler: cracks from two notches under an impact.

use anyhow::{Context, bail};
use ligament::Model;
use ligament_analysis::history::BreakRecord;

use super::fast_crack::{Break, breaks, direction, distance, largest_speed, rayleigh};
use crate::experiment::{Compute, Experiment, Findings};
use crate::published::published;
use crate::table::{Extent, Labels};
use crate::trial::{Memory, Template, template};

/// The experiment.
pub(crate) const EXPERIMENT: Experiment = Experiment {
    name: "motion_kalthoff",
    title: "Impact on a plate with two notches",
    source: "test of Kalthoff and Winkler 1988; speeds of waves",
    setup: "Plate 100 x 200 mm of steel, E = 191 GPa, nu = 0.25, rho = 8000 kg/m^3, G_c = 22,120 J/m^2, plane strain, bbpd, `critical-stretch`. Between \
            notches of 50 mm from its left side, 50 mm apart, the side moves at 16.5 m/s for 90 us. The angle is that of the principal axis of the \
            middles of broken bonds more than a horizon from the tip of a notch, on its outer side and steeper than 45 degrees (cracks from the right side are not meant), \
            with the notch: the mean of both cracks. A crack has started \
            when it is a horizon away from the tip. Speeds are those of the farthest broken bond over 8 us.",
    cases: &[&CASE],
    compute: Compute::Code(compute),
};

static CASE: Template = template!("kalthoff/case.toml");

/// Tips of the notches, m, with the sign of the outer side.
const TIPS: [([f64; 2], f64); 2] = [([0.05, 0.125], 1.0), ([0.05, 0.075], -1.0)];

/// Half of the height of the plate, m.
const MIDDLE: f64 = 0.1;

/// Duration over which a speed is read, s.
const WINDOW: f64 = 8e-6;

/// Speed of Rayleigh waves, m/s: that of shear waves is sqrt(mu/rho).
fn limit() -> f64 {
    (191e9 / 2.5 / 8000f64).sqrt() * rayleigh(0.25)
}

/// Angle, degrees; start, us; largest speed over that of Rayleigh waves.
type Reading = [f64; 3];

fn compute(extent: Extent) -> anyhow::Result<Findings> {
    let mut memory = Memory::default();
    let table = published!("motion-kalthoff").judge(extent, |labels| entry(labels, &mut memory))?;
    Ok(Findings {
        tables: vec![table],
        ..Findings::default()
    })
}

fn entry(labels: Labels<'_>, memory: &mut Memory<Reading>) -> anyhow::Result<f64> {
    let spacing = labels.number("h, mm")?;
    let factor = labels.number("lambda")?;
    let across = |length: f64| (length / spacing).round() as u32;
    let trial = (CASE.trial())
        .on_lattice([across(100.0), across(200.0)], 1e-3 * spacing)
        .set("model.horizon_factor", factor);
    let horizon = 1e-3 * spacing * factor;
    let [angle, start, speed] = memory.reading_with_breakages(&trial, |solution, records| {
        read(&solution.model, records, horizon)
    })?;
    Ok(match labels.text("of")? {
        "angle, degrees" => angle,
        "start, us" => start,
        "speed over c_R" => speed,
        other => bail!("no quantity `{other}`"),
    })
}

fn read(model: &Model, records: &[BreakRecord], horizon: f64) -> anyhow::Result<Reading> {
    let all = breaks(model, records);
    let [mut angle, mut start, mut speed] = [0.0, f64::INFINITY, 0.0_f64];
    for (tip, sign) in TIPS {
        let is_outside = |it: &&Break| sign * (it.at[1] - tip[1]) > (it.at[0] - tip[0]).max(0.0);
        let is_away = |it: &&Break| distance(it.at, tip) > horizon;
        let of_notch = || {
            let half = all.iter().filter(|it| sign * (it.at[1] - MIDDLE) > 0.0);
            half.filter(is_outside).filter(is_away)
        };
        let first = of_notch().next().context("no crack grows from a notch")?;
        start = first.time.min(start);
        let places: Vec<[f64; 2]> = of_notch().map(|it| it.at).collect();
        angle += 0.5 * direction(&places).abs().to_degrees();
        speed = largest_speed(of_notch(), tip, WINDOW).max(speed);
    }
    Ok([angle, 1e6 * start, speed / limit()])
}
