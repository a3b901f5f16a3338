//! Brazilian disks with one slot and with several (NHPD section 3.2).

use std::f64::consts::PI;

use anyhow::{Context, bail};
use ligament::run::Solution;
use ligament_analysis::history::BreakRecord;

use super::crack_path::{Crack, Segment, distance, middle};
use super::experiment::{Compute, Experiment, Findings};
use super::published::published;
use super::spread::spread;
use super::table::{Extent, LabelError, Labels};
use super::trial::{Memory, StoredMesh, Template, Trial, stored_mesh, template};
use ligament_plot::plots::{Colour, Plot, Series};
use ligament_run::summary::DROP;

/// The experiment.
pub(super) const EXPERIMENT: Experiment = Experiment {
    name: "slots",
    title: "Brazilian disks with slots",
    source: "Zhang, Yang and Zhuang (NHPD), section 3.2, Figs 14 to 20",
    setup: "The disk of diameter 0.1 m with one slot of 30 mm through its middle, at an angle to the loading axis, or with two to four \
            parallel slots of 20 mm at 45 degrees, 15 mm apart (our own geometry: the text has none). Bonds that cross a slot are \
            left out. Mesh of 2 mm (2,998 points; in the fast subset 3 mm, 1,273 points), NHPD with lambda = 2.5, 3 and 3.5 and the F_t that \
            the paper gives for each, E = 15 GPa, nu = 0.21, plane stress. Assumed, because the text does not say: platens that are the nodes of the \
            rim with |x| <= 3 mm, moved together in steps of 1 um; five bonds an iteration, first those most beyond their limit. The peak is the \
            largest load before the load first falls by 2 %; a test ends when it has fallen by a fifth. `domain` is the \
            correction of the paper, `patch` the one under which uniform strains are equilibria. Points with a damage above 0.3 are cracked.",
    cases: &[
        &SLOTS[0].1,
        &SLOTS[1].1,
        &SLOTS[2].1,
        &SLOTS[3].1,
        &SLOTS[4].1,
        &SLOTS[5].1,
        &SLOTS[6].1,
        &SLOTS[7].1,
    ],
    compute: Compute::Code(compute),
};

/// Cases by the angle of their slot, or by the number of slots.
static SLOTS: [(&str, Template); 8] = [
    ("0", template!("slotted-disk/slot-00.toml")),
    ("30", template!("slotted-disk/slot-30.toml")),
    ("45", template!("slotted-disk/slot-45.toml")),
    ("60", template!("slotted-disk/slot-60.toml")),
    ("90", template!("slotted-disk/slot-90.toml")),
    ("two", template!("multi-slot-disk/two-slots.toml")),
    ("three", template!("multi-slot-disk/three-slots.toml")),
    ("four", template!("multi-slot-disk/four-slots.toml")),
];

static COARSE: StoredMesh = stored_mesh!("disk-3mm.msh");
static FINE: StoredMesh = stored_mesh!("disk-2mm.msh");

/// Horizon factors of the paper with its adjusted strengths, Pa.
const ADJUSTED: [(f64, f64); 3] = [(2.5, 4.69e6), (3.0, 3.81e6), (3.5, 3.21e6)];

/// Strength of the intact disk in closed form: pi D t F_t/2, N.
const INTACT: f64 = 0.5 * PI * 0.1 * 1.0 * 3.81e6;

/// Share of the largest load at which a test ends: most cracks are then complete, and halves between platens carry no further load.
const END: f64 = 0.8;

/// Radius of the disk, m.
const RADIUS: f64 = 0.05;

/// The platens: top and bottom of the disk, m.
const PLATENS: [Segment; 2] = [
    [[-0.003, RADIUS], [0.003, RADIUS]],
    [[-0.003, -RADIUS], [0.003, -RADIUS]],
];

/// Results of a test.
#[derive(Debug, Clone)]
struct SlottedTest {
    /// Largest load before it first falls, over [`INTACT`].
    peak: f64,
    /// Curve of displacement, mm, and load over [`INTACT`].
    curve: Vec<[f64; 2]>,
    /// Distance of the first broken bond from the nearest end of a slot, over its horizon.
    start: f64,
    /// Distance of the first cracked point from the nearest end of a slot, over its horizon.
    first_crack: f64,
    /// Distance between a crack from a slot and a platen, the larger one of both platens, over the radius.
    to_platens: f64,
    /// Distance between the cracks of neighbouring slots or these slots, the largest one of all pairs, over the mean horizon of cracked
    /// points; 0 with one slot.
    between_slots: f64,
    /// Mean distance of the crack from its image after half a turn, over the mean horizon of its points.
    mismatch: f64,
}

impl SlottedTest {
    fn from_run(solution: &Solution, breaks: &[BreakRecord]) -> anyhow::Result<Self> {
        let (model, outcome) = (&solution.model, &solution.outcome);
        let slots: Vec<Segment> = (model.setup.precracks.iter())
            .map(|slot| slot.line())
            .map(|slot| [slot[0], slot[slot.len() - 1]])
            .collect();
        let from_tip = |at: [f64; 2]| {
            let tips = slots.iter().flatten();
            tips.map(|&tip| distance(at, [tip; 2]))
                .fold(f64::INFINITY, f64::min)
        };
        let first = breaks.first().context("no bond breaks")?;
        let first = middle(model, first.bond as usize);
        let first_point = Crack::first_point(model, breaks).context("no point is cracked")?;
        let crack = Crack::from_breakages(model, breaks);
        let parts: Vec<Crack> = slots.iter().map(|&slot| crack.part_from(slot)).collect();
        let to_platen = |platen: &Segment| {
            let gaps = parts.iter().map(|part| part.gap_to(*platen));
            gaps.fold(f64::INFINITY, f64::min)
        };
        let pairs = (1..slots.len()).map(|second| {
            let [one, other] = [&parts[second - 1], &parts[second]];
            let to_slots = one
                .gap_to(slots[second])
                .min(other.gap_to(slots[second - 1]));
            to_slots.min(one.gap_between(other))
        });
        let half_turn = crack.half_turn([0.0, 1.0]);
        let peak = outcome.first_peak(DROP);
        let curve = outcome.envelope();
        Ok(Self {
            peak: peak.context("the run has no state at rest")?.reaction / INTACT,
            curve: (curve.iter())
                .map(|point| [1e3 * point.displacement, point.reaction / INTACT])
                .collect(),
            start: from_tip(first.at) / first.horizon,
            first_crack: from_tip(first_point.at) / first_point.horizon,
            to_platens: PLATENS.iter().map(to_platen).fold(0.0, f64::max) / RADIUS,
            between_slots: pairs.fold(0.0, f64::max) / crack.mean_horizon(),
            mismatch: half_turn.map_or(f64::NAN, |it| it.mean) / crack.mean_horizon(),
        })
    }
}

/// Settings of a test.
#[derive(Debug, Clone, Copy)]
struct Case<'a> {
    slots: &'a str,
    mesh: &'a str,
    correction: &'a str,
    lambda: f64,
}

impl<'a> Case<'a> {
    fn of_labels(labels: Labels<'a>, lambda: f64) -> Result<Self, LabelError> {
        Ok(Self {
            slots: labels.text("slots")?,
            mesh: labels.text("mesh")?,
            correction: labels.text("correction")?,
            lambda,
        })
    }

    fn trial(self) -> anyhow::Result<Trial> {
        let found = SLOTS.iter().find(|(name, _)| *name == self.slots);
        let (_, template) = found.with_context(|| format!("no slots `{}`", self.slots))?;
        let strength = ADJUSTED.iter().find(|(lambda, _)| *lambda == self.lambda);
        let (_, strength) =
            strength.with_context(|| format!("no F_t at lambda = {}", self.lambda))?;
        let trial = template.trial().set("model.horizon_factor", self.lambda);
        let trial = trial.set("material.tensile_strength", *strength);
        let trial = trial.set("correction.surface", self.correction);
        let trial = trial.set("fracture.stop.load_fraction", END);
        Ok(trial.on_mesh(match self.mesh {
            "2 mm" => &FINE,
            "3 mm" => &COARSE,
            other => bail!("no mesh `{other}`"),
        }))
    }

    fn test(self, tests: &mut Memory<SlottedTest>) -> anyhow::Result<SlottedTest> {
        tests.reading_with_breakages(&self.trial()?, SlottedTest::from_run)
    }
}

/// The test of a disk with slots on a mesh, under a correction and with a horizon factor.
pub(super) fn trial(
    slots: &str,
    mesh: &str,
    correction: &str,
    lambda: f64,
) -> anyhow::Result<Trial> {
    let case = Case {
        slots,
        mesh,
        correction,
        lambda,
    };
    case.trial()
}

fn compute(extent: Extent) -> anyhow::Result<Findings> {
    let mut tests = Memory::default();
    let tests = &mut tests;
    let tables = vec![
        published!("adjusted-strength").judge(extent, adjusted)?,
        published!("slots-spread").judge(extent, |labels| over_horizons(labels, tests))?,
        published!("slots-crack").judge(extent, |labels| crack(labels, tests))?,
    ];
    let plots = match extent {
        Extent::Fast => Vec::new(),
        Extent::Full => plots(tests)?,
    };
    Ok(Findings {
        tables,
        plots,
        ..Findings::default()
    })
}

/// Strength F_t (MPa) by eq. 22 that preserves the strength of the structure for other horizon factors than 3.
fn adjusted(labels: Labels<'_>) -> anyhow::Result<f64> {
    let lambda = labels.number("lambda")?;
    let at_3 = match labels.text("section")? {
        "3.2" => 3.81,
        "3.3" => 10.0,
        other => bail!("no strength of section `{other}`"),
    };
    Ok(8.0 * at_3 / (3.0 * lambda - 1.0))
}

/// Spread of the peaks over the horizon factors.
fn over_horizons(labels: Labels<'_>, tests: &mut Memory<SlottedTest>) -> anyhow::Result<f64> {
    let mut peaks = Vec::new();
    for (lambda, _) in ADJUSTED {
        peaks.push(Case::of_labels(labels, lambda)?.test(tests)?.peak);
    }
    Ok(spread(&peaks))
}

fn crack(labels: Labels<'_>, tests: &mut Memory<SlottedTest>) -> anyhow::Result<f64> {
    let test = Case::of_labels(labels, labels.number("lambda")?)?.test(tests)?;
    Ok(match labels.text("of")? {
        "first bond" => test.start,
        "first crack" => test.first_crack,
        "to platens" => test.to_platens,
        "between slots" => test.between_slots,
        "half turn" => test.mismatch,
        other => bail!("nothing `{other}` of a crack"),
    })
}

/// Colours of the horizon factors.
const COLOURS: [Colour; 3] = [Colour::Sky, Colour::Green, Colour::Vermilion];

/// Plots of the peaks over the angle of one slot, and of the curves of all tests on the fine mesh (Figs 14 and 17).
fn plots(tests: &mut Memory<SlottedTest>) -> anyhow::Result<Vec<Plot>> {
    let mesh = "2 mm";
    let mut plots = Vec::new();
    for correction in ["domain", "patch"] {
        let mut peaks = Vec::new();
        for ((lambda, _), colour) in ADJUSTED.into_iter().zip(COLOURS) {
            let mut points = Vec::new();
            for (slots, _) in &SLOTS[..5] {
                let case = Case {
                    slots,
                    mesh,
                    correction,
                    lambda,
                };
                points.push([slots.parse()?, case.test(tests)?.peak]);
            }
            peaks.push(Series::line(format!("lambda = {lambda}"), colour, points));
        }
        let title = format!("Disk with a slot, correction `{correction}`");
        let axes = [
            "angle of the slot to the loading axis, degrees",
            "peak load / 598.47 kN",
        ];
        plots.push(Plot::new(
            format!("slots-peaks-{correction}"),
            &title,
            axes,
            peaks,
        ));
        for (slots, _) in &SLOTS {
            let mut curves = Vec::new();
            for ((lambda, _), colour) in ADJUSTED.into_iter().zip(COLOURS) {
                let curve = Case {
                    slots,
                    mesh,
                    correction,
                    lambda,
                }
                .test(tests)?
                .curve;
                curves.push(Series::curve(format!("lambda = {lambda}"), colour, curve));
            }
            let what = match slots.parse::<u32>() {
                Ok(angle) => format!("a slot at {angle} degrees"),
                Err(_) => format!("{slots} slots"),
            };
            let title = format!("Disk with {what}, correction `{correction}`");
            let axes = ["displacement, mm", "load / 598.47 kN"];
            plots.push(Plot::new(
                format!("slots-{slots}-{correction}"),
                &title,
                axes,
                curves,
            ));
        }
    }
    Ok(plots)
}
