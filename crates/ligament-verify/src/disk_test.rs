//! Results of a test of the intact Brazilian disk.

use std::f64::consts::PI;

use anyhow::Context;
use ligament::run::Solution;
use ligament_analysis::history::BreakRecord;
use ligament_run::summary::DROP;

use super::crack_path::{Crack, Place, Segment, ends, middle};

/// Radius of the disk, m.
const RADIUS: f64 = 0.05;

/// Half-width of the platens, m.
const PLATEN: f64 = 0.0015;

/// Splitting load of the disk in closed form: pi D t F_t/2, N.
pub(super) const CLOSED_FORM: f64 = 0.5 * PI * (2.0 * RADIUS) * 1.0 * 3.81e6;

/// Number of first breakages among which those at the rim are counted.
const EARLY: usize = 100;

/// Distance from the circle within which a point is on the rim, m: coordinates of a mesh are rounded.
const ON_RIM: f64 = 1e-9;

/// Results of a test of the intact disk up to its split.
#[derive(Debug, Clone)]
pub(super) struct DiskTest {
    /// Largest load before it first falls, over [`CLOSED_FORM`].
    pub(super) peak: f64,
    /// Force over displacement before the first breakage, N/m.
    pub(super) stiffness: f64,
    /// Curve of displacement, mm, and load, kN.
    pub(super) curve: Vec<[f64; 2]>,
    /// Distance of the first broken bond from the loaded diameter's middle along it, over the radius.
    pub(super) first_bond: f64,
    /// Distance of the first cracked point from the loaded diameter's middle along it, over the radius.
    pub(super) first_crack: f64,
    /// Share of the first [`EARLY`] broken bonds that end on the rim, %.
    pub(super) at_rim: f64,
    /// The crack at the peak.
    pub(super) at_peak: Band,
    /// The crack after the load has fallen.
    pub(super) at_end: Band,
}

/// The crack at a stage of a test.
#[derive(Debug, Clone, Copy)]
pub(super) struct Band {
    /// Extent along the loaded diameter, over the diameter.
    pub(super) length: f64,
    /// Mean signed distance of the cracked points from the loaded diameter, over the radius.
    pub(super) aside: f64,
    /// Root mean square of that distance, over the radius.
    pub(super) width: f64,
    /// Mean position along the loaded diameter, from the middle, over the radius.
    pub(super) above: f64,
    /// Whether the crack joins the platens.
    pub(super) splits: bool,
}

impl DiskTest {
    pub(super) fn from_run(solution: &Solution, breaks: &[BreakRecord]) -> anyhow::Result<Self> {
        let (model, outcome) = (&solution.model, &solution.outcome);
        let peak = outcome.first_peak(DROP);
        let peak = peak.context("the run has no state at rest")?;
        let first = breaks.first().context("no bond breaks")?;
        let crack = Crack::first_point(model, breaks).context("no point is cracked")?;
        let share_of_radius = |place: Place| place.at[1].abs() / RADIUS;
        let until_peak = breaks.partition_point(|it| it.load_factor <= peak.load_factor);
        let at_rim = |it: &&BreakRecord| {
            let is_on_rim = |[x, y]: [f64; 2]| x.hypot(y) > RADIUS - ON_RIM;
            ends(model, it.bond as usize).into_iter().any(is_on_rim)
        };
        let early = &breaks[..EARLY.min(breaks.len())];
        Ok(Self {
            peak: peak.reaction / CLOSED_FORM,
            stiffness: outcome.elastic_stiffness,
            curve: (outcome.envelope().iter())
                .map(|point| [1e3 * point.displacement, 1e-3 * point.reaction])
                .collect(),
            first_bond: share_of_radius(middle(model, first.bond as usize)),
            first_crack: share_of_radius(crack),
            at_rim: 100.0 * early.iter().filter(at_rim).count() as f64 / early.len() as f64,
            at_peak: Band::new(&Crack::from_breakages(model, &breaks[..until_peak])),
            at_end: Band::new(&Crack::from_breakages(model, breaks)),
        })
    }
}

impl Band {
    /// Position and extent of a crack; without points it has length 0 in the middle.
    fn new(crack: &Crack) -> Self {
        let count = crack.points.len().max(1) as f64;
        let mean = |of: &dyn Fn([f64; 2]) -> f64| {
            crack.points.iter().map(|point| of(point.at)).sum::<f64>() / count
        };
        let heights = || crack.points.iter().map(|point| point.at[1]);
        let extent =
            heights().fold(f64::NEG_INFINITY, f64::max) - heights().fold(f64::INFINITY, f64::min);
        let platen = |y: f64| -> Segment { [[-PLATEN, y], [PLATEN, y]] };
        Self {
            length: extent.max(0.0) / (2.0 * RADIUS),
            aside: mean(&|[x, _]| x) / RADIUS,
            width: mean(&|[x, _]| x * x).sqrt() / RADIUS,
            above: mean(&|[_, y]| y) / RADIUS,
            splits: crack.joins(platen(RADIUS), platen(-RADIUS)),
        }
    }
}
