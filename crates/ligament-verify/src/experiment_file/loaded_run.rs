//! Quantities of a run that loads a body: peaks, cracks and others that its experiment compares.

use std::f64::consts::FRAC_1_SQRT_2;

use anyhow::{Context, bail};
use ligament::run::Solution;
use ligament_analysis::driver::LoadPoint;
use ligament_analysis::history::{BreakRecord, StepRecord};
use ligament_output::csv::read::CsvTable;
use ligament_run::summary::LOAD_DROP;

use super::history;
use crate::case_run::{Number, displacement_at, largest_displacements};
use crate::contact_pressure::{ContactPressure, contact_pressure};
use crate::crack_path::{Crack, CrackPoint, Segment, distance, ends, lines, mean_height, middle};
use crate::fast_crack::{Branches, Break, CracksOfNotches, breaks};
use crate::hole::concentrations;
use crate::places::repository;
use crate::record::{Record, phase_speed};
use crate::ring::{RadialDisplacements, Ring, radial_displacements};

/// Distance from a circle within which a point lies on it, m: coordinates of a mesh are rounded.
const ON_CIRCLE: f64 = 1e-9;

/// Number of first breakages in which breakages at the rim are counted.
const EARLY: usize = 100;

/// Table of problem, d, x, y (mm), u_x, u_y (um) of plates by finite elements.
const ELEMENTS: &str = "tests/reference/mbb-pd-elements.csv";

/// A run with its breakages in their order, and the numbers of the experiment.
pub(super) struct LoadedRun<'a> {
    pub(super) solution: &'a Solution,
    pub(super) breaks: &'a [BreakRecord],
    pub(super) numbers: Number<'a>,
}

impl LoadedRun<'_> {
    pub(super) fn number(&self, name: &str) -> anyhow::Result<f64> {
        (self.numbers)(name)
    }

    pub(super) fn last(&self) -> anyhow::Result<&StepRecord> {
        self.solution
            .outcome
            .history
            .last()
            .context("the run has no history")
    }

    pub(super) fn peak(&self) -> anyhow::Result<LoadPoint> {
        self.solution
            .outcome
            .peak()
            .context("the run has no state at rest")
    }

    pub(super) fn first_peak(&self) -> anyhow::Result<LoadPoint> {
        let peak = self.solution.outcome.first_peak(LOAD_DROP);
        peak.context("the run has no state at rest")
    }

    pub(super) fn first(&self) -> anyhow::Result<&BreakRecord> {
        self.breaks.first().context("no bond breaks")
    }

    pub(super) fn first_break(&self) -> anyhow::Result<CrackPoint> {
        Ok(middle(&self.solution.model, self.first()?.bond as usize))
    }

    pub(super) fn first_crack(&self) -> anyhow::Result<CrackPoint> {
        let found = Crack::first_point(&self.solution.model, self.breaks);
        found.context("no point is cracked")
    }

    pub(super) fn crack(&self) -> Crack {
        Crack::from_breakages(&self.solution.model, self.breaks)
    }

    /// The crack when the load first falls.
    pub(super) fn crack_at_peak(&self) -> anyhow::Result<Crack> {
        let peak = self.first_peak()?.load_factor;
        let until = self.breaks.partition_point(|it| it.load_factor <= peak);
        Ok(Crack::from_breakages(
            &self.solution.model,
            &self.breaks[..until],
        ))
    }

    /// The straight cuts of the body, from their first to their last places.
    pub(super) fn cuts(&self) -> Vec<Segment> {
        let cuts = self.solution.model.setup.precracks.iter();
        let lines = cuts.map(|cut| cut.line());
        lines.map(|line| [line[0], line[line.len() - 1]]).collect()
    }

    /// Distance of a place from the nearest end of a cut, m.
    pub(super) fn distance_from_tip(&self, place: CrackPoint) -> anyhow::Result<f64> {
        let cuts = self.cuts();
        let tips = cuts.iter().flatten();
        let distances = tips.map(|&tip| distance(place.at, [tip; 2]));
        distances.reduce(f64::min).context("the body has no cut")
    }

    /// The platens: segments of the half-width `platen` above and below the origin, `radius` away.
    pub(super) fn platens(&self) -> anyhow::Result<[Segment; 2]> {
        let (radius, half) = (self.number("radius")?, self.number("platen")?);
        Ok([radius, -radius].map(|y| [[-half, y], [half, y]]))
    }

    pub(super) fn ring(&self) -> anyhow::Result<RadialDisplacements> {
        let ring = Ring {
            inner: self.number("inner")?,
            outer: self.number("outer")?,
            young: self.number("young")?,
            poisson: self.number("poisson")?,
            pressure: self.number("pressure")?,
        };
        Ok(radial_displacements(self.solution, &ring))
    }

    pub(super) fn hole(&self) -> anyhow::Result<[[f64; 2]; 3]> {
        concentrations(
            self.solution,
            self.number("young")?,
            self.number("traction")?,
        )
    }

    pub(super) fn breaks(&self) -> Vec<Break> {
        breaks(&self.solution.model, self.breaks)
    }

    pub(super) fn branches(&self) -> anyhow::Result<Branches> {
        Branches::new(&self.breaks(), self.numbers)
    }

    pub(super) fn notches(&self) -> anyhow::Result<CracksOfNotches> {
        CracksOfNotches::new(&self.breaks(), self.numbers)
    }

    pub(super) fn contact_pressure(&self) -> anyhow::Result<ContactPressure> {
        let (directions, points) = (self.number("directions")?, self.number("side_points")?);
        contact_pressure(self.solution, directions as usize, points as u32)
    }

    pub(super) fn phase_speed(&self, points: f64) -> anyhow::Result<f64> {
        let rows = &self.solution.outcome.history;
        let times: Vec<f64> = rows.iter().map(|row| row.load_factor).collect();
        let record = |name: &str| {
            let values = rows
                .iter()
                .map(|row| history::value(self.solution, row, name));
            anyhow::Ok(Record {
                times: times.clone(),
                values: values.collect::<anyhow::Result<_>>()?,
            })
        };
        let (near, far) = (record("probe.near")?, record("probe.far")?);
        let numbers = [
            self.number("speed")?,
            self.number("gauge")?,
            self.number("spacing")?,
        ];
        phase_speed([&near, &far], points, numbers)
    }

    /// Load factor at which the cracks from both ends of a flaw through the origin at 45 degrees are `length` times `half_length` long in the mean,
    /// up to their farthest broken bonds.
    pub(super) fn load_at_length(&self, length: f64) -> anyhow::Result<f64> {
        let half = self.number("half_length")?;
        let tip = half * FRAC_1_SQRT_2;
        let mut farthest = [0.0_f64; 2];
        let long = self.breaks().into_iter().find(|it| {
            let [x, y] = it.at;
            let (side, sign) = if x + y > 0.0 { (0, 1.0) } else { (1, -1.0) };
            let reach = (x - sign * tip).hypot(y - sign * tip);
            farthest[side] = farthest[side].max(reach);
            0.5 * (farthest[0] + farthest[1]) >= length * half
        });
        Ok(long.context("the cracks do not become so long")?.time)
    }

    /// The value of a history quantity in the last row without a broken bond.
    pub(super) fn intact(&self, name: &str) -> anyhow::Result<f64> {
        let mut rows = self.solution.outcome.history.iter();
        let row = rows.rfind(|row| row.broken_bonds == 0);
        let row = row.context("no row without a broken bond")?;
        history::value(self.solution, row, name)
    }

    /// The displacement at `X.Y.u_x`, m.
    pub(super) fn at_point(&self, name: &str) -> anyhow::Result<f64> {
        let [x, y, of] = name.split('.').collect::<Vec<_>>()[..] else {
            bail!("`{name}` is not `X.Y.u_x`");
        };
        let place = [self.number(x)?, self.number(y)?];
        Ok(displacement_at(self.solution, place)[axis(of)?])
    }

    /// The largest displacement of all points, m.
    pub(super) fn largest(&self, of: &str) -> anyhow::Result<f64> {
        Ok(largest_displacements(self.solution)?[axis(of)?])
    }

    /// The difference of `PROBLEM.u_x` from finite elements at all points, for a spacing of `d` mm.
    pub(super) fn difference_from_elements(&self, name: &str) -> anyhow::Result<f64> {
        let (problem, of) = name.split_once('.').context("no component is named")?;
        let (problem, spacing, axis) = (problem.replace('_', "-"), self.number("d")?, axis(of)?);
        let text = std::fs::read_to_string(repository().join(ELEMENTS)).context(ELEMENTS)?;
        let sheet = CsvTable::parse(ELEMENTS, &text)?;
        let problems = sheet.values::<String>("problem")?.into_iter();
        let numbers = sheet.numbers(["d_mm", "x_mm", "y_mm", "ux_um", "uy_um"])?;
        let (mut difference, mut size) = (0.0, 0.0);
        for (of, [d, x, y, along, across]) in problems.zip(numbers) {
            if of == problem && d == spacing {
                let element = [along, across][axis] / 1e6;
                let found = displacement_at(self.solution, [1e-3 * x, 1e-3 * y])[axis];
                difference += (found - element).powi(2);
                size += element.powi(2);
            }
        }
        Ok((difference / size).sqrt())
    }

    /// The quantity `height.FROM.TO` of the crack: the mean height of its line between two numbers along x, m.
    pub(super) fn crack_quantity(&self, name: &str) -> anyhow::Result<f64> {
        let ["height", from, to] = name.split('.').collect::<Vec<_>>()[..] else {
            bail!("no quantity of the crack is called `{name}`");
        };
        let between = [self.number(from)?, self.number(to)?];
        let lines = lines(&self.solution.model, self.breaks);
        mean_height(&lines, between).context("no line of the crack passes there")
    }

    pub(super) fn splits(&self, crack: &Crack) -> anyhow::Result<f64> {
        let [upper, lower] = self.platens()?;
        Ok(f64::from(u8::from(crack.connects(upper, lower))))
    }
}

/// The axis of a component of the displacement.
pub(super) fn axis(component: &str) -> anyhow::Result<usize> {
    match component {
        "u_x" => Ok(0),
        "u_y" => Ok(1),
        other => bail!("no component `{other}`"),
    }
}

/// Work under a curve, J.
pub(super) fn area(curve: &[LoadPoint]) -> f64 {
    let of_pair = |pair: &[LoadPoint]| {
        0.5 * (pair[0].reaction + pair[1].reaction) * (pair[1].displacement - pair[0].displacement)
    };
    curve.windows(2).map(of_pair).sum()
}

pub(super) fn radius(place: CrackPoint) -> f64 {
    place.at[0].hypot(place.at[1])
}

/// Mean of a function of the cracked points; 0 without points.
pub(super) fn mean(crack: &Crack, of: impl Fn([f64; 2]) -> f64) -> f64 {
    let count = crack.points.len().max(1) as f64;
    crack.points.iter().map(|point| of(point.at)).sum::<f64>() / count
}

pub(super) fn extent(crack: &Crack) -> f64 {
    let heights = || crack.points.iter().map(|point| point.at[1]);
    let [low, high] = [
        heights().fold(f64::INFINITY, f64::min),
        heights().fold(f64::NEG_INFINITY, f64::max),
    ];
    (high - low).max(0.0)
}

pub(super) fn share_of_breaks_at_rim(ran: &LoadedRun<'_>) -> anyhow::Result<f64> {
    let radius = ran.number("radius")?;
    ran.first()?;
    let is_on_rim = |[x, y]: [f64; 2]| x.hypot(y) > radius - ON_CIRCLE;
    let ends_there = |it: &&BreakRecord| {
        let ends = ends(&ran.solution.model, it.bond as usize);
        ends.into_iter().any(is_on_rim)
    };
    let early = &ran.breaks[..EARLY.min(ran.breaks.len())];
    Ok(100.0 * early.iter().filter(ends_there).count() as f64 / early.len() as f64)
}

pub(super) fn gap_to_platens(ran: &LoadedRun<'_>) -> anyhow::Result<f64> {
    let crack = ran.crack();
    let parts: Vec<Crack> = ran.cuts().iter().map(|&cut| crack.part_from(cut)).collect();
    let to_platen = |platen: Segment| {
        let gaps = parts.iter().map(|part| part.gap_to(platen));
        gaps.fold(f64::INFINITY, f64::min)
    };
    Ok(ran
        .platens()?
        .map(to_platen)
        .into_iter()
        .fold(0.0, f64::max))
}

pub(super) fn gap_of_cuts(ran: &LoadedRun<'_>) -> f64 {
    let (crack, cuts) = (ran.crack(), ran.cuts());
    let parts: Vec<Crack> = cuts.iter().map(|&cut| crack.part_from(cut)).collect();
    let pairs = (1..cuts.len()).map(|second| {
        let [one, other] = [&parts[second - 1], &parts[second]];
        let to_cuts = one.gap_to(cuts[second]).min(other.gap_to(cuts[second - 1]));
        to_cuts.min(one.gap_between(other))
    });
    pairs.fold(0.0, f64::max)
}

/// NaN where the crack has no part on one side.
pub(super) fn half_turn(crack: &Crack, along: [f64; 2]) -> f64 {
    crack.half_turn(along).map_or(f64::NAN, |it| it.mean)
}

pub(super) fn is_symmetric(ran: &LoadedRun<'_>) -> anyhow::Result<f64> {
    let crack = ran.crack();
    let mismatch = half_turn(&crack, [1.0, 0.0]) / crack.mean_horizon();
    Ok(f64::from(u8::from(mismatch <= 1.0)))
}

pub(super) fn leads_left(ran: &LoadedRun<'_>) -> anyhow::Result<f64> {
    let crack = ran.crack();
    let reach = |sign: f64| {
        let tip = crack.part(|[x, _]| sign * x > 0.0).tip();
        tip.map_or(0.0, radius)
    };
    Ok(f64::from(u8::from(reach(-1.0) > reach(1.0))))
}

/// Angle to the x axis of the mean direction of the crack from the right end of the first cut, minus the angle for the left end, degrees,
/// over their common length; NaN where there is no crack at an end.
pub(super) fn turn_to_left(ran: &LoadedRun<'_>) -> anyhow::Result<f64> {
    let crack = ran.crack();
    let [left, right] = *ran.cuts().first().context("the body has no cut")?;
    let angle = |end: [f64; 2], sign: f64| {
        let common = crack.common_part([1.0, 0.0])?;
        let [x, y] = common.part(|[x, _]| sign * x > sign * end[0]).centre()?;
        Some((y - end[1]).abs().atan2(sign * (x - end[0])))
    };
    Ok(match (angle(left, -1.0), angle(right, 1.0)) {
        (Some(left), Some(right)) => (right - left).to_degrees(),
        _ => f64::NAN,
    })
}
