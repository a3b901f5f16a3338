//! The PMMA plate with an inclined slot (NHPD section 3.3).

use anyhow::{Context, bail};
use ligament::run::Solution;
use ligament_analysis::history::BreakRecord;

use super::crack_path::{Crack, Segment, distance, middle};
use super::experiment::{Compute, Experiment, Findings};
use super::published::published;
use super::spread::spread;
use super::table::{Extent, Labels};
use super::trial::{Memory, StoredMesh, Template, Trial, stored_mesh, template};
use ligament_plot::plots::{Colour, Plot, Series};
use ligament_run::summary::DROP;

/// The experiment.
pub(super) const EXPERIMENT: Experiment = Experiment {
    name: "inclined",
    title: "Plate with an inclined slot",
    source: "Zhang, Yang and Zhuang (NHPD), section 3.3, Figs 23 and 24",
    setup: "Square plate of side 150 mm, pulled at two opposite corners, with a slot of 45 mm through its middle: bonds that cross it are left \
            out. theta is the angle between the normal of the slot and the loading diagonal. NHPD with lambda = 2.2, 3 and 4 and the F_t \
            that the paper gives for each, plane stress. Assumed, because the text does not say: E = 2.94 GPa, nu = 0.38, t = 5 mm; a mesh of \
            4 mm, at the left (x < -30 mm) of 2 mm (2,981 points); patches 20 mm deep at the corners that move as one, and no breakage in them \
            and 20 mm beyond; steps of 4 um, five bonds an iteration, first those most beyond their limit. The peak is the largest load \
            before the load first falls by 2 %; a test ends when it has fallen to a twentieth. `domain` is the correction of the \
            paper, with at most 3,000 sweeps, `patch` the one under which uniform strains are equilibria. Points with a damage above 0.3 are \
            cracked. nu lies above 1/3, where the shear stiffness of a bond is negative.",
    cases: &[
        &PLATES[0].1,
        &PLATES[1].1,
        &PLATES[2].1,
        &PLATES[3].1,
        &PLATES[4].1,
    ],
    compute: Compute::Code(compute),
};

/// Cases by the angle theta of the slot.
static PLATES: [(&str, Template); 5] = [
    ("0", template!("inclined-slot-plate/plate-00.toml")),
    ("15", template!("inclined-slot-plate/plate-15.toml")),
    ("30", template!("inclined-slot-plate/plate-30.toml")),
    ("45", template!("inclined-slot-plate/plate-45.toml")),
    ("62.5", template!("inclined-slot-plate/plate-62.5.toml")),
];

static MESH: StoredMesh = stored_mesh!("diagonal-plate-4mm.msh");

/// Horizon factors of the paper with its adjusted strengths, Pa.
const ADJUSTED: [(f64, f64); 3] = [(2.2, 14.286e6), (3.0, 10e6), (4.0, 7.273e6)];

/// Results of a test.
#[derive(Debug, Clone)]
struct PlateTest {
    /// Largest load before it first falls, kN.
    peak: f64,
    /// Distance of the first broken bond from the nearer end of the slot, over its horizon.
    start: f64,
    /// Mean distance of the crack from its image after half a turn, over the mean horizon of its points.
    mismatch: f64,
    /// Angle by [`towards_left`], degrees.
    towards_left: f64,
    /// Whether the crack reaches farther on the left.
    leads_left: bool,
}

impl PlateTest {
    fn from_run(solution: &Solution, breaks: &[BreakRecord]) -> anyhow::Result<Self> {
        let (model, outcome) = (&solution.model, &solution.outcome);
        let slot = model.setup.precracks.first().context("no slot")?.line();
        let ends: Segment = [slot[0], slot[slot.len() - 1]];
        let first = breaks.first().context("no bond breaks")?;
        let first = middle(model, first.bond as usize);
        let from_end = ends.map(|end| distance(first.at, [end; 2]));
        let crack = Crack::from_breakages(model, breaks);
        let half_turn = crack.half_turn([1.0, 0.0]);
        let peak = outcome.first_peak(DROP);
        let peak = peak.context("the run has no state at rest")?;
        Ok(Self {
            peak: 1e-3 * peak.reaction,
            start: from_end[0].min(from_end[1]) / first.horizon,
            mismatch: half_turn.map_or(f64::NAN, |it| it.mean) / crack.mean_horizon(),
            towards_left: towards_left(&crack, ends),
            leads_left: reach(&crack, -1.0) > reach(&crack, 1.0),
        })
    }
}

/// Angle to the x axis of the mean direction of the crack from the right end of the slot, minus that from the left end, degrees, over their
/// common length: the difference between the fine and the coarse side of the mesh. NaN where there is no crack at an end.
fn towards_left(crack: &Crack, [left, right]: Segment) -> f64 {
    let angle = |end: [f64; 2], sign: f64| {
        let common = crack.common_part([1.0, 0.0])?;
        let [x, y] = common.part(|[x, _]| sign * x > sign * end[0]).centre()?;
        Some((y - end[1]).abs().atan2(sign * (x - end[0])))
    };
    match (angle(left, -1.0), angle(right, 1.0)) {
        (Some(left), Some(right)) => (right - left).to_degrees(),
        _ => f64::NAN,
    }
}

/// Largest distance of a point of the crack from the middle of the plate on one side, m; 0 without points.
fn reach(crack: &Crack, sign: f64) -> f64 {
    let tip = crack.part(|[x, _]| sign * x > 0.0).tip();
    tip.map_or(0.0, |tip| tip.at[0].hypot(tip.at[1]))
}

/// Settings of a test.
#[derive(Debug, Clone, Copy)]
struct Case<'a> {
    theta: &'a str,
    correction: &'a str,
    lambda: f64,
}

impl Case<'_> {
    fn trial(self) -> anyhow::Result<Trial> {
        let found = PLATES.iter().find(|(name, _)| *name == self.theta);
        let (_, template) = found.with_context(|| format!("no theta `{}`", self.theta))?;
        let strength = ADJUSTED.iter().find(|(lambda, _)| *lambda == self.lambda);
        let (_, strength) =
            strength.with_context(|| format!("no F_t at lambda = {}", self.lambda))?;
        let trial = template.trial().set("model.horizon_factor", self.lambda);
        let trial = trial.set("material.tensile_strength", *strength);
        let trial = match self.correction {
            "domain" => trial,
            // The whole section is replaced: sweeps belong to the other correction.
            other => trial.set("correction", format_args!("{{ surface = {other:?} }}")),
        };
        Ok(trial.on_mesh(&MESH))
    }

    fn test(self, tests: &mut Memory<PlateTest>) -> anyhow::Result<PlateTest> {
        tests.reading_with_breakages(&self.trial()?, PlateTest::from_run)
    }
}

/// The test of the plate with a slot, under a correction and with a horizon factor.
pub(super) fn trial(theta: &str, correction: &str, lambda: f64) -> anyhow::Result<Trial> {
    let case = Case {
        theta,
        correction,
        lambda,
    };
    case.trial()
}

fn compute(extent: Extent) -> anyhow::Result<Findings> {
    let mut tests = Memory::default();
    let tests = &mut tests;
    let tables = vec![
        published!("inclined-spread").judge(extent, |labels| over_horizons(labels, tests))?,
        published!("inclined-crack").judge(extent, |labels| crack(labels, tests))?,
        published!("inclined-symmetry").judge(extent, |labels| symmetry(labels, tests))?,
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

/// Spread of the peaks over the horizon factors.
fn over_horizons(labels: Labels<'_>, tests: &mut Memory<PlateTest>) -> anyhow::Result<f64> {
    let (theta, correction) = (labels.text("theta")?, labels.text("correction")?);
    let mut peaks = Vec::new();
    for (lambda, _) in ADJUSTED {
        peaks.push(
            Case {
                theta,
                correction,
                lambda,
            }
            .test(tests)?
            .peak,
        );
    }
    Ok(spread(&peaks))
}

fn crack(labels: Labels<'_>, tests: &mut Memory<PlateTest>) -> anyhow::Result<f64> {
    let case = Case {
        theta: labels.text("theta")?,
        correction: labels.text("correction")?,
        lambda: labels.number("lambda")?,
    };
    let test = case.test(tests)?;
    Ok(match labels.text("of")? {
        "start" => test.start,
        "half turn" => test.mismatch,
        other => bail!("nothing `{other}` of a crack"),
    })
}

/// Statistic of the symmetry of the cracks over all tests.
fn symmetry(labels: Labels<'_>, tests: &mut Memory<PlateTest>) -> anyhow::Result<f64> {
    let correction = labels.text("correction")?;
    let mut all = Vec::new();
    for (theta, _) in &PLATES {
        for (lambda, _) in ADJUSTED {
            all.push(
                Case {
                    theta,
                    correction,
                    lambda,
                }
                .test(tests)?,
            );
        }
    }
    let count = |is: &dyn Fn(&PlateTest) -> bool| all.iter().filter(|test| is(test)).count() as f64;
    Ok(match labels.text("of")? {
        "symmetric" => count(&|test| test.mismatch <= 1.0),
        "left leads" => count(&|test| test.leads_left),
        "towards the left" => {
            let angles = all.iter().map(|test| test.towards_left);
            angles.sum::<f64>() / all.len() as f64
        }
        other => bail!("nothing `{other}` of the symmetry"),
    })
}

/// Colours of the horizon factors.
const COLOURS: [Colour; 3] = [Colour::Sky, Colour::Green, Colour::Vermilion];

/// Plots of the peaks over the angle of the slot (Fig. 23).
fn plots(tests: &mut Memory<PlateTest>) -> anyhow::Result<Vec<Plot>> {
    let mut plots = Vec::new();
    for correction in ["domain", "patch"] {
        let mut peaks = Vec::new();
        for ((lambda, _), colour) in ADJUSTED.into_iter().zip(COLOURS) {
            let mut points = Vec::new();
            for (theta, _) in &PLATES {
                let test = Case {
                    theta,
                    correction,
                    lambda,
                }
                .test(tests)?;
                points.push([theta.parse()?, test.peak]);
            }
            peaks.push(Series::line(format!("lambda = {lambda}"), colour, points));
        }
        let title = format!("Plate with an inclined slot, correction `{correction}`");
        let axes = ["theta, degrees", "largest load, kN (t = 5 mm)"];
        plots.push(Plot::new(
            format!("inclined-peaks-{correction}"),
            &title,
            axes,
            peaks,
        ));
    }
    Ok(plots)
}
