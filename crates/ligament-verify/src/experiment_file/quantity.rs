//! Quantities that expressions read from runs, by name.
//!
//! | name | quantity |
//! |---|---|
//! | `probe.NAME` | last value of a probe, whose `-` is `_` here |
//! | `frequency.N` | frequency of the elastic mode N from one on, Hz; the case is one of natural modes |
//! | `turn.N` | root mean square by which factors of bonds change where the mesh is turned by N degrees |
//! | others | the row of [`QUANTITIES`] |

use std::collections::{BTreeMap, BTreeSet};

use anyhow::Context;
use ligament::patch_test::{PatchTest, patch_test};
use ligament::run::Solution;
use ligament_analysis::driver::LoadPoint;
use ligament_analysis::history::{BreakRecord, StepRecord};
use ligament_analysis::modal::ModeKind;
use ligament_model::moduli::{EngineeringConstants, family_stiffness};
use ligament_run::summary::DROP;

use crate::crack_path::{Crack, Place, Segment, distance, ends, middle};
use crate::equations::Equations;
use crate::griffith;
use crate::hole::concentrations;
use crate::patch_test::{change_by_turn, poisson, scatter, young};
use crate::ring::{RadialDisplacements, Ring, radial_displacements};
use crate::trial::{Trial, probe};

/// Name of the curve of displacement and load among what is read.
pub(super) const CURVE: &str = "curve";

/// Distance from a circle within which a point lies on it, m: coordinates of a mesh are rounded.
const ON_CIRCLE: f64 = 1e-9;

/// Number of first breakages among which those at the rim are counted.
const EARLY: usize = 100;

/// A run with its breakages in their order, and the numbers of the experiment.
struct LoadedRun<'a> {
    solution: &'a Solution,
    breaks: &'a [BreakRecord],
    numbers: &'a Numbers<'a>,
}

/// What quantities need beside the run.
pub(super) struct Numbers<'a> {
    /// A number of the experiment, such as the radius of a disk. Entries of one run share what is read from it: numbers that differ between them belong
    /// to the name of a quantity.
    pub(super) number: &'a dyn Fn(&str) -> anyhow::Result<f64>,
}

/// Way to a quantity.
#[derive(Clone, Copy)]
enum Source {
    Run(fn(&LoadedRun<'_>) -> anyhow::Result<f64>),
    Equations(fn(&Equations) -> f64),
    Family(fn(&EngineeringConstants) -> f64),
    Patch(fn(&PatchTest) -> anyhow::Result<f64>),
    Turn,
    Probe,
    Curve,
    Frequency,
}

/// Quantities of runs and of equations.
static QUANTITIES: [(&str, Source); 61] = [
    (
        "elastic_stiffness",
        Source::Run(|it| Ok(it.solution.outcome.elastic_stiffness)),
    ),
    // Force over displacement of the load in the last state, N/m.
    (
        "last.stiffness",
        Source::Run(|it| {
            let last = it.last()?;
            Ok((last.reaction / last.displacement).abs())
        }),
    ),
    ("peak.reaction", Source::Run(|it| Ok(it.peak()?.reaction))),
    (
        "peak.displacement",
        Source::Run(|it| Ok(it.peak()?.displacement)),
    ),
    // The largest load before the load first falls by 2 %.
    (
        "first_peak.reaction",
        Source::Run(|it| Ok(it.first_peak()?.reaction)),
    ),
    (
        "first_peak.displacement",
        Source::Run(|it| Ok(it.first_peak()?.displacement)),
    ),
    // Work under the curve, J.
    (
        "curve.area",
        Source::Run(|it| Ok(area(&it.solution.outcome.envelope()))),
    ),
    (
        "first_break.load_factor",
        Source::Run(|it| Ok(it.first()?.load_factor)),
    ),
    // Position of the middle of the first broken bond: |y|, distance from the origin, from the nearest end of a cut, and its horizon, m.
    (
        "first_break.height",
        Source::Run(|it| Ok(it.first_break()?.at[1].abs())),
    ),
    (
        "first_break.from_origin",
        Source::Run(|it| Ok(radius(it.first_break()?))),
    ),
    (
        "first_break.from_tip",
        Source::Run(|it| it.distance_from_tip(it.first_break()?)),
    ),
    (
        "first_break.x",
        Source::Run(|it| Ok(it.first_break()?.at[0])),
    ),
    (
        "first_break.horizon",
        Source::Run(|it| Ok(it.first_break()?.horizon)),
    ),
    // Its distance from the nearer of the two places on the x axis at the distance `radius` from the origin, m.
    (
        "first_break.from_flank",
        Source::Run(|it| {
            let [x, y] = it.first_break()?.at;
            Ok((x.abs() - it.number("radius")?).hypot(y))
        }),
    ),
    // Position of the first point with a damage above 0.3.
    (
        "first_crack.height",
        Source::Run(|it| Ok(it.first_crack()?.at[1].abs())),
    ),
    (
        "first_crack.from_tip",
        Source::Run(|it| it.distance_from_tip(it.first_crack()?)),
    ),
    (
        "first_crack.horizon",
        Source::Run(|it| Ok(it.first_crack()?.horizon)),
    ),
    // Share of the first 100 broken bonds that end on the circle of `radius` about the origin, %.
    ("breaks.at_rim", Source::Run(at_rim)),
    // Extent along y, mean x and |x|, mean y of the cracked points, m, and whether they join the platens, at the first peak and at the end.
    (
        "at_peak.extent",
        Source::Run(|it| Ok(extent(&it.at_peak()?))),
    ),
    (
        "at_peak.mean_x",
        Source::Run(|it| Ok(mean(&it.at_peak()?, |[x, _]| x))),
    ),
    (
        "at_peak.mean_y",
        Source::Run(|it| Ok(mean(&it.at_peak()?, |[_, y]| y))),
    ),
    (
        "at_peak.width",
        Source::Run(|it| Ok(mean(&it.at_peak()?, |[x, _]| x * x).sqrt())),
    ),
    (
        "at_peak.splits",
        Source::Run(|it| it.splits(&it.at_peak()?)),
    ),
    ("crack.extent", Source::Run(|it| Ok(extent(&it.crack())))),
    (
        "crack.mean_x",
        Source::Run(|it| Ok(mean(&it.crack(), |[x, _]| x))),
    ),
    (
        "crack.mean_y",
        Source::Run(|it| Ok(mean(&it.crack(), |[_, y]| y))),
    ),
    (
        "crack.width",
        Source::Run(|it| Ok(mean(&it.crack(), |[x, _]| x * x).sqrt())),
    ),
    ("crack.splits", Source::Run(|it| it.splits(&it.crack()))),
    // Mean horizon of the cracked points, m.
    (
        "crack.horizon",
        Source::Run(|it| Ok(it.crack().mean_horizon())),
    ),
    // Distance between a crack from a cut and a platen, the larger one of both platens, and between the cracks of neighbouring cuts or these
    // cuts, the largest one of all pairs, 0 with one cut, m.
    ("crack.to_platens", Source::Run(to_platens)),
    ("crack.between_cuts", Source::Run(|it| Ok(between_cuts(it)))),
    // Mean distance of a crack that goes along x (y) from its image after half a turn, m.
    (
        "crack.half_turn_x",
        Source::Run(|it| Ok(half_turn(&it.crack(), [1.0, 0.0]))),
    ),
    (
        "crack.half_turn_y",
        Source::Run(|it| Ok(half_turn(&it.crack(), [0.0, 1.0]))),
    ),
    // 1 where that is at most a horizon, where the crack reaches farther on the left, and the angle of the cut's two cracks, degrees.
    ("crack.is_symmetric", Source::Run(is_symmetric)),
    ("crack.leads_left", Source::Run(leads_left)),
    ("crack.towards_left", Source::Run(towards_left)),
    // Radial displacements of a ring over Lame's, and stress concentrations at a hole with the scatter about them.
    ("ring.inside", Source::Run(|it| Ok(it.ring()?.inside))),
    ("ring.outside", Source::Run(|it| Ok(it.ring()?.outside))),
    (
        "ring.difference",
        Source::Run(|it| Ok(it.ring()?.difference)),
    ),
    ("hole.strain", Source::Run(|it| Ok(it.hole()?[0][0]))),
    (
        "hole.strain_scatter",
        Source::Run(|it| Ok(it.hole()?[0][1])),
    ),
    ("hole.virial", Source::Run(|it| Ok(it.hole()?[1][0]))),
    (
        "hole.virial_scatter",
        Source::Run(|it| Ok(it.hole()?[1][1])),
    ),
    ("hole.traction", Source::Run(|it| Ok(it.hole()?[2][0]))),
    (
        "hole.traction_scatter",
        Source::Run(|it| Ok(it.hole()?[2][1])),
    ),
    // Cracks driven by the fracture energy.
    (
        "griffith.strength",
        Source::Run(|it| griffith::relative_strength(it.solution, it.numbers.number)),
    ),
    (
        "griffith.crossing",
        Source::Run(|it| griffith::crossing_energy(it.solution, it.numbers.number)),
    ),
    (
        "griffith.released",
        Source::Run(|it| griffith::released(it.solution, it.numbers.number)),
    ),
    (
        "griffith.separation",
        Source::Run(|it| griffith::separation_energy(it.solution, it.numbers.number)),
    ),
    (
        "griffith.deviation",
        Source::Run(|it| griffith::deviation(it.solution, it.numbers.number)),
    ),
    // Constants of the family of the point nearest to the origin.
    ("family.young", Source::Family(|it| it.young[0])),
    (
        "family.shear_modulus",
        Source::Family(|it| it.shear_modulus.at(0, 1)),
    ),
    ("family.poisson", Source::Family(|it| it.poisson[0][1])),
    // The patch test.
    ("patch.young", Source::Patch(young)),
    ("patch.poisson", Source::Patch(poisson)),
    ("patch.scatter", Source::Patch(|it| Ok(scatter(it)))),
    ("equations.unknowns", Source::Equations(|it| it.unknowns)),
    ("equations.bonds", Source::Equations(|it| it.bonds)),
    ("equations.matrix", Source::Equations(|it| it.matrix)),
    ("equations.factor", Source::Equations(|it| it.factor)),
    (
        "equations.multiplications",
        Source::Equations(|it| it.multiplications),
    ),
];

/// Refuses a name that no quantity has.
pub(super) fn ensure_known(name: &str) -> anyhow::Result<()> {
    source(name).map(|_| ())
}

fn source(name: &str) -> anyhow::Result<Source> {
    if name.starts_with("probe.") {
        return Ok(Source::Probe);
    }
    if name.starts_with("frequency.") {
        return Ok(Source::Frequency);
    }
    if name.starts_with("turn.") {
        return Ok(Source::Turn);
    }
    if name == CURVE {
        return Ok(Source::Curve);
    }
    let found = QUANTITIES.iter().find(|it| it.0 == name);
    found
        .map(|it| it.1)
        .with_context(|| format!("no label, no number and no quantity is called `{name}`"))
}

/// What was read from a run.
pub(super) struct RunResults {
    /// Quantities by name; the reason why one has no value.
    values: BTreeMap<String, Result<f64, String>>,
    /// Displacement and load up to the end, m and N; empty where nothing was loaded.
    pub(super) curve: Vec<[f64; 2]>,
}

/// What a trial gives, as far as quantities need it.
#[derive(Default)]
struct Found {
    /// Frequencies of the elastic modes, Hz.
    modes: Vec<f64>,
    equations: Option<Equations>,
    /// Constants of the family of the point nearest to the origin.
    family: Option<EngineeringConstants>,
    patch: Option<PatchTest>,
    run: Option<(Solution, Vec<BreakRecord>)>,
}

impl Found {
    /// Runs a trial in all ways that the sources need.
    fn new(trial: &Trial, sources: &[(String, Source)]) -> anyhow::Result<Self> {
        let mut found = Self::default();
        for (_, source) in sources {
            match source {
                Source::Frequency if found.modes.is_empty() => found.modes = frequencies(trial)?,
                Source::Equations(_) if found.equations.is_none() => {
                    found.equations = Some(Equations::from_model(&trial.model()?)?);
                }
                Source::Family(_) if found.family.is_none() => {
                    found.family = Some(family_in_the_middle(trial)?);
                }
                Source::Patch(_) if found.patch.is_none() => {
                    found.patch = Some(patch_test(&trial.model()?)?);
                }
                Source::Run(_) | Source::Probe | Source::Curve if found.run.is_none() => {
                    found.run = Some(trial.solve_with_breakages()?);
                }
                _ => {}
            }
        }
        Ok(found)
    }

    fn value(
        &self,
        (name, source): &(String, Source),
        trial: &Trial,
        numbers: &Numbers<'_>,
    ) -> anyhow::Result<f64> {
        let run = || self.run.as_ref().context("the case was not run");
        match source {
            Source::Frequency => frequency(&self.modes, name),
            Source::Equations(of) => {
                Ok(of(self.equations.as_ref().context("there is no model")?))
            }
            Source::Family(of) => Ok(of(self.family.as_ref().context("there is no family")?)),
            Source::Patch(of) => of(self.patch.as_ref().context("there is no patch test")?),
            Source::Turn => change_by_turn(trial, name.trim_start_matches("turn.").parse()?),
            Source::Probe => probe(
                &run()?.0,
                &name.trim_start_matches("probe.").replace('_', "-"),
            ),
            Source::Curve => anyhow::bail!("a curve is no number"),
            Source::Run(of) => {
                let (solution, breaks) = run()?;
                of(&LoadedRun {
                    solution,
                    breaks,
                    numbers,
                })
            }
        }
    }
}

impl RunResults {
    /// Runs a trial and reads some quantities.
    pub(super) fn of_trial(
        trial: &Trial,
        wanted: &BTreeSet<String>,
        numbers: &Numbers<'_>,
    ) -> anyhow::Result<Self> {
        let sources = wanted.iter().map(|name| Ok((name.clone(), source(name)?)));
        let sources: Vec<(String, Source)> = sources.collect::<anyhow::Result<_>>()?;
        let found = Found::new(trial, &sources)?;
        let values = sources.iter().filter(|it| it.0 != CURVE).map(|it| {
            let value = found.value(it, trial, numbers);
            (it.0.clone(), value.map_err(|error| format!("{error:#}")))
        });
        let curve = found.run.as_ref().map(|it| it.0.outcome.envelope());
        let curve = curve.unwrap_or_default().into_iter();
        Ok(Self {
            values: values.collect(),
            curve: curve
                .map(|point| [point.displacement, point.reaction])
                .collect(),
        })
    }

    /// The value of a quantity that was read.
    pub(super) fn value(&self, name: &str) -> anyhow::Result<f64> {
        let value = self.values.get(name);
        let value = value.with_context(|| format!("`{name}` was not read"))?;
        value.clone().map_err(anyhow::Error::msg)
    }
}

fn family_in_the_middle(trial: &Trial) -> anyhow::Result<EngineeringConstants> {
    let model = trial.model()?;
    let middle = model.plane().cloud.nearest_point([0.0, 0.0]);
    let stiffness = family_stiffness(model.plane(), middle);
    EngineeringConstants::from_stiffness(stiffness).context("the family has no stiffness")
}

/// Frequencies of the elastic modes, Hz.
fn frequencies(trial: &Trial) -> anyhow::Result<Vec<f64>> {
    let modes = trial.modes()?;
    let elastic = modes.iter().filter(|mode| mode.kind == ModeKind::Elastic);
    Ok(elastic.map(|mode| mode.frequency()).collect())
}

fn frequency(modes: &[f64], name: &str) -> anyhow::Result<f64> {
    let number: usize = name.trim_start_matches("frequency.").parse()?;
    let found = number.checked_sub(1).and_then(|it| modes.get(it)).copied();
    found.with_context(|| format!("the body has no elastic mode {number}"))
}

impl LoadedRun<'_> {
    fn number(&self, name: &str) -> anyhow::Result<f64> {
        (self.numbers.number)(name)
    }

    fn last(&self) -> anyhow::Result<&StepRecord> {
        self.solution
            .outcome
            .history
            .last()
            .context("the run has no history")
    }

    fn peak(&self) -> anyhow::Result<LoadPoint> {
        self.solution
            .outcome
            .peak()
            .context("the run has no state at rest")
    }

    fn first_peak(&self) -> anyhow::Result<LoadPoint> {
        let peak = self.solution.outcome.first_peak(DROP);
        peak.context("the run has no state at rest")
    }

    fn first(&self) -> anyhow::Result<&BreakRecord> {
        self.breaks.first().context("no bond breaks")
    }

    fn first_break(&self) -> anyhow::Result<Place> {
        Ok(middle(&self.solution.model, self.first()?.bond as usize))
    }

    fn first_crack(&self) -> anyhow::Result<Place> {
        let found = Crack::first_point(&self.solution.model, self.breaks);
        found.context("no point is cracked")
    }

    fn crack(&self) -> Crack {
        Crack::from_breakages(&self.solution.model, self.breaks)
    }

    /// The crack when the load first falls.
    fn at_peak(&self) -> anyhow::Result<Crack> {
        let peak = self.first_peak()?.load_factor;
        let until = self.breaks.partition_point(|it| it.load_factor <= peak);
        Ok(Crack::from_breakages(
            &self.solution.model,
            &self.breaks[..until],
        ))
    }

    /// The straight cuts of the body, from their first to their last places.
    fn cuts(&self) -> Vec<Segment> {
        let cuts = self.solution.model.setup.precracks.iter();
        let lines = cuts.map(|cut| cut.line());
        lines.map(|line| [line[0], line[line.len() - 1]]).collect()
    }

    /// Distance of a place from the nearest end of a cut, m.
    fn distance_from_tip(&self, place: Place) -> anyhow::Result<f64> {
        let cuts = self.cuts();
        let tips = cuts.iter().flatten();
        let distances = tips.map(|&tip| distance(place.at, [tip; 2]));
        distances.reduce(f64::min).context("the body has no cut")
    }

    /// The platens: segments of the half-width `platen` above and below the origin, `radius` away.
    fn platens(&self) -> anyhow::Result<[Segment; 2]> {
        let (radius, half) = (self.number("radius")?, self.number("platen")?);
        Ok([radius, -radius].map(|y| [[-half, y], [half, y]]))
    }

    fn ring(&self) -> anyhow::Result<RadialDisplacements> {
        let ring = Ring {
            inner: self.number("inner")?,
            outer: self.number("outer")?,
            young: self.number("young")?,
            poisson: self.number("poisson")?,
            pressure: self.number("pressure")?,
        };
        Ok(radial_displacements(self.solution, &ring))
    }

    fn hole(&self) -> anyhow::Result<[[f64; 2]; 3]> {
        concentrations(
            self.solution,
            self.number("young")?,
            self.number("traction")?,
        )
    }

    fn splits(&self, crack: &Crack) -> anyhow::Result<f64> {
        let [upper, lower] = self.platens()?;
        Ok(f64::from(u8::from(crack.joins(upper, lower))))
    }
}

/// Work under a curve, J.
fn area(curve: &[LoadPoint]) -> f64 {
    let of_pair = |pair: &[LoadPoint]| {
        0.5 * (pair[0].reaction + pair[1].reaction) * (pair[1].displacement - pair[0].displacement)
    };
    curve.windows(2).map(of_pair).sum()
}

fn radius(place: Place) -> f64 {
    place.at[0].hypot(place.at[1])
}

/// Mean of a function of the cracked points; 0 without points.
fn mean(crack: &Crack, of: impl Fn([f64; 2]) -> f64) -> f64 {
    let count = crack.points.len().max(1) as f64;
    crack.points.iter().map(|point| of(point.at)).sum::<f64>() / count
}

fn extent(crack: &Crack) -> f64 {
    let heights = || crack.points.iter().map(|point| point.at[1]);
    let [low, high] = [
        heights().fold(f64::INFINITY, f64::min),
        heights().fold(f64::NEG_INFINITY, f64::max),
    ];
    (high - low).max(0.0)
}

fn at_rim(ran: &LoadedRun<'_>) -> anyhow::Result<f64> {
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

fn to_platens(ran: &LoadedRun<'_>) -> anyhow::Result<f64> {
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

fn between_cuts(ran: &LoadedRun<'_>) -> f64 {
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
fn half_turn(crack: &Crack, along: [f64; 2]) -> f64 {
    crack.half_turn(along).map_or(f64::NAN, |it| it.mean)
}

fn is_symmetric(ran: &LoadedRun<'_>) -> anyhow::Result<f64> {
    let crack = ran.crack();
    let mismatch = half_turn(&crack, [1.0, 0.0]) / crack.mean_horizon();
    Ok(f64::from(u8::from(mismatch <= 1.0)))
}

fn leads_left(ran: &LoadedRun<'_>) -> anyhow::Result<f64> {
    let crack = ran.crack();
    let reach = |sign: f64| {
        let tip = crack.part(|[x, _]| sign * x > 0.0).tip();
        tip.map_or(0.0, radius)
    };
    Ok(f64::from(u8::from(reach(-1.0) > reach(1.0))))
}

/// Angle to the x axis of the mean direction of the crack from the right end of the first cut, minus that from the left end, degrees, over their
/// common length; NaN where there is no crack at an end.
fn towards_left(ran: &LoadedRun<'_>) -> anyhow::Result<f64> {
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
