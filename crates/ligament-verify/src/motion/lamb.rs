//! A force on the edge of a half-plane: Lamb's problem.

use anyhow::bail;

use super::record::Record;
use crate::experiment::{Compute, Experiment, Findings};
use crate::published::published;
use crate::table::{Extent, Labels};
use crate::trial::{Memory, Template, template};

/// The experiment.
pub(crate) const EXPERIMENT: Experiment = Experiment {
    name: "motion_lamb",
    title: "A force on the edge of a half-plane (Lamb's problem)",
    source: "closed form (Lamb 1904, Cagniard 1939), by tools/reference_waves.py",
    setup: "Plane strain, E = 60 GPa, nu = 0.25, rho = 2650 kg/m^3: c_P = 5212, c_S = 3009, c_R = 2767 m/s. bbpd, 560 x 180 points of 0.5 mm, lambda = 3, \
            quiet edges at three sides. A vertical force of 1 kN/m on a point of the upper row is a Ricker wavelet of 80 kHz (Rayleigh waves are 35 mm \
            long). Displacements at 40, 60 and 80 mm from it, extrapolated from the upper two rows to the edge by a straight line. Times are those of extrema, \
            from the peak of the force on; u_x is positive away from the force, u_y along it. The P wave is read as the smallest u_x before the Rayleigh wave \
            comes, the Rayleigh wave as the largest and the smallest u_y and u_x. c_R is from the largest u_y at 40 and 80 mm.",
    cases: &[&CASE],
    compute: Compute::Code(compute),
};

static CASE: Template = template!("verification/motion-lamb.toml");

/// Time of the peak of the force and period of its wavelet, s.
const PEAK_TIME: f64 = 15e-6;
const PERIOD: f64 = 12.5e-6;

/// Speeds of the P wave and of the Rayleigh wave, m/s.
const SPEEDS: [f64; 2] = [5212.5, 2766.9];

/// Distances from the force, mm.
const STATIONS: [&str; 3] = ["40", "60", "80"];

/// Displacements along x and along the force at a station, m.
type Station = [Record; 2];

fn compute(extent: Extent) -> anyhow::Result<Findings> {
    let mut memory = Memory::default();
    let mut stations = || {
        memory.reading(&CASE.trial(), |solution| {
            let edge = |component: &str, station: &str| {
                let upper = Record::of_probe(solution, &format!("{component}-{station}"))?;
                let lower = Record::of_probe(solution, &format!("{component}-{station}-below"))?;
                anyhow::Ok(upper.times_factor(1.5).plus(-0.5, &lower))
            };
            let mut all: Vec<Station> = Vec::new();
            for station in STATIONS {
                all.push([edge("x", station)?, edge("y", station)?.times_factor(-1.0)]);
            }
            Ok(all)
        })
    };
    let times = published!("motion-lamb-times").judge(extent, |labels| {
        Ok(1e6 * (extremum(labels, &stations()?)?[0] - PEAK_TIME))
    })?;
    let sizes = published!("motion-lamb-sizes").judge(extent, |labels| {
        Ok(1e9 * extremum(labels, &stations()?)?[1])
    })?;
    let speed = published!("motion-rayleigh").judge(extent, |_| {
        let all = stations()?;
        let time = |place: usize| {
            let distance = 0.04 + 0.02 * place as f64;
            Ok::<f64, anyhow::Error>(all[place][1].peak(window("R", distance)?)?[0])
        };
        Ok(0.04 / (time(2)? - time(0)?))
    })?;
    Ok(Findings {
        tables: vec![times, sizes, speed],
        ..Findings::default()
    })
}

/// Time (s) and size (m) of the extremum of an entry.
fn extremum(labels: Labels<'_>, stations: &[Station]) -> anyhow::Result<[f64; 2]> {
    let distance = 1e-3 * labels.number("x, mm")?;
    let place = (STATIONS.iter()).position(|it| labels.text("x, mm").ok() == Some(*it));
    let Some(place) = place else {
        bail!("no station at {distance} m");
    };
    let [along, across] = &stations[place];
    let (wave, feature) = (labels.text("wave")?, labels.text("extremum")?);
    let (record, sign) = match feature {
        "largest u_x" => (along, 1.0),
        "smallest u_x" => (along, -1.0),
        "largest u_y" => (across, 1.0),
        "smallest u_y" => (across, -1.0),
        other => bail!("no extremum `{other}`"),
    };
    let [time, size] = record
        .clone()
        .times_factor(sign)
        .peak(window(wave, distance)?)?;
    Ok([time, sign * size])
}

/// Window of time around the arrival of a wave, s.
fn window(wave: &str, distance: f64) -> anyhow::Result<[f64; 2]> {
    let [arrival, before, after] = match wave {
        "P" => [distance / SPEEDS[0], 1.2, 0.8],
        "R" => [distance / SPEEDS[1], 1.1, 1.1],
        other => bail!("no wave `{other}`"),
    };
    let middle = PEAK_TIME + arrival;
    Ok([middle - before * PERIOD, middle + after * PERIOD])
}
