//! Quantities that expressions read from runs, by name.
//!
//! | name | quantity |
//! |---|---|
//! | a name of [`history`] | the value in a row of the history, or in the last one |
//! | `intact.NAME` | the same in the last row without a broken bond |
//! | `end.NAME` | the same in the last equilibrium of a run that goes on until none follows |
//! | `frequency.N` | frequency of the elastic mode N, counted from 1, Hz; the case is one of natural modes |
//! | `turn.N` | root mean square by which factors of bonds change where the mesh is turned by N degrees |
//! | `phase_speed.N` | speed of waves with N points per wavelength from the probe `near` to `far`, over `speed` |
//! | `at_point.X.Y.u_x` | displacement of the point nearest to a place, whose coordinates are numbers of the experiment by their names, m |
//! | `direction.STIFFNESS.OF` | [stiffness of bonds](crate::directions) over their direction |
//! | `first_yield.CRITERION.STRAIN.STATISTIC` | errors of [first yield](crate::anisotropy) on a mesh |
//! | `largest.u_x` | largest size of a displacement of all points, m |
//! | `loaded_elements.LOAD.u_x` | the same of a [square of finite elements](crate::square_elements), m |
//! | `elements.PROBLEM.u_x` | difference of a plate from finite elements: L2 norm over all points, over the norm by the elements |
//! | `modes.NAME`, `square_elements.NAME`, `lamina_elements.NAME` | frequency of a [named mode](crate::named_modes) of the case, of finite elements,
//! Hz |
//! | `common_breaks.N` | bonds that break up to N us with explicit and implicit steps alike, over those that one of them breaks more of |
//! | `ghost.largest.MARGIN`, `ghost.rms.MARGIN` | [ghost forces](crate::ghost_forces) of the points farther than a number, m, from the outline |
//! | `crack.height.FROM.TO` | mean height y of the crack's line between two numbers along x, m |
//! | `grown.N` | load factor at which the cracks from a flaw are N `half_length` long |
//! | any other name | the row of [`QUANTITIES`] |

use std::collections::{BTreeMap, BTreeSet};

use anyhow::{Context, ensure};
use ligament::patch_test::{PatchTest, patch_test};
use ligament::run::Solution;
use ligament::setup::ELASTIC_ENERGY_TOLERANCE;
use ligament::{Loading, Model};
use ligament_analysis::history::BreakRecord;
use ligament_analysis::modal::ModeKind;
use ligament_analysis::{Equilibrium, Termination};
use ligament_model::moduli::{EngineeringConstants, family_stiffness};

use super::history::{self, HistoryCollector};
use super::loaded_run::{
    LoadedRun, area, axis, extent, gap_of_cuts, gap_to_platens, half_turn, is_symmetric,
    leads_left, mean, radius, share_of_breaks_at_rim, turn_to_left,
};
use crate::anisotropy::Anisotropy;
use crate::case_run::{CaseRun, Number};
use crate::crack_path::{asymmetry, ends, share_off_lines};
use crate::directions::stiffness;
use crate::ghost_forces::GhostForces;
use crate::named_modes::Frequencies;
use crate::patch_test::{change_by_turn, poisson, ratios_of_constants, scatter, young};
use crate::square_elements::SquareLoad;
use crate::{griffith, lamina_elements, square_elements};

/// Name of the curve of displacement and load among the quantities.
pub(super) const CURVE: &str = "curve";

/// Source of a quantity: a run, a case, its equations or a family of bonds.
#[derive(Clone, Copy)]
enum Source {
    Run(fn(&LoadedRun<'_>) -> anyhow::Result<f64>),
    /// A function of a run and of the rest of the name.
    Named(fn(&LoadedRun<'_>, &str) -> anyhow::Result<f64>),
    /// A function of the case run and of the rest of the name.
    CaseRun(fn(&CaseRun, &str, Number<'_>) -> anyhow::Result<f64>),
    Equations(fn(&Equations) -> f64),
    Family(fn(&EngineeringConstants) -> f64),
    Patch(fn(&PatchTest) -> anyhow::Result<f64>),
    Ghost,
    CommonBreaks,
    FirstYield,
    Modes(Cantilever),
    Row,
    End,
    Curve,
    Frequency,
}

/// A cantilever with named modes.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Cantilever {
    Case,
    SquareOfElements,
    LaminaOfElements,
}

/// Quantities of runs and of equations.
static QUANTITIES: &[(&str, Source)] = &[
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
    // Distance of this middle from the nearer of the two places on the x axis at the distance `radius` from the origin, m.
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
    (
        "first_break.y",
        Source::Run(|it| Ok(it.first_break()?.at[1])),
    ),
    // Angle of the plane across it with a line at the angle `flaw` to the x axis, degrees, and the load at the first break.
    (
        "first_break.plane",
        Source::Run(|it| {
            let [a, b] = ends(&it.solution.model, it.first()?.bond as usize);
            let plane = (b[1] - a[1]).atan2(b[0] - a[0]).to_degrees() + 90.0;
            Ok((plane - it.number("flaw")?).rem_euclid(180.0))
        }),
    ),
    (
        "first_break.reaction",
        Source::Run(|it| {
            let first = it.solution.outcome.first_break;
            Ok(first.context("no bond breaks")?.reaction)
        }),
    ),
    (
        "breaks.largest_x",
        Source::Run(|it| Ok(it.breaks().iter().map(|it| it.at[0]).fold(0.0, f64::max))),
    ),
    // Fast cracks.
    (
        "branches.cracks",
        Source::Run(|it| Ok(it.branches()?.cracks)),
    ),
    (
        "branches.time",
        Source::Run(|it| Ok(it.branches()?.first.time)),
    ),
    (
        "branches.x",
        Source::Run(|it| Ok(it.branches()?.first.at[0])),
    ),
    ("branches.speed", Source::Run(|it| Ok(it.branches()?.speed))),
    ("notches.angle", Source::Run(|it| Ok(it.notches()?.angle))),
    ("notches.start", Source::Run(|it| Ok(it.notches()?.start))),
    ("notches.speed", Source::Run(|it| Ok(it.notches()?.speed))),
    // Pressures under a rigid body, over `directions` along the surface and `side_points` integration points of a side.
    (
        "pressed.force",
        Source::Run(|it| Ok(it.contact_pressure()?.force)),
    ),
    (
        "pressed.reach",
        Source::Run(|it| Ok(it.contact_pressure()?.reach)),
    ),
    (
        "pressed.largest",
        Source::Run(|it| Ok(it.contact_pressure()?.largest[0])),
    ),
    (
        "pressed.fit",
        Source::Run(|it| Ok(it.contact_pressure()?.largest[1])),
    ),
    // Share of the broken bonds that do not cross the lines y = `line` and -`line`, and the largest difference of damage between a point and its
    // mirror images.
    (
        "crack.beside",
        Source::Run(|it| {
            let line = it.number("line")?;
            Ok(share_off_lines(it.solution, [-line, line]))
        }),
    ),
    (
        "crack.asymmetry",
        Source::Run(|it| Ok(asymmetry(it.solution))),
    ),
    // Share of the first 100 broken bonds that end on the circle of `radius` about the origin, %.
    ("breaks.at_rim", Source::Run(share_of_breaks_at_rim)),
    // Extent along y, mean x and |x|, mean y of the cracked points, m, and whether they join the platens, at the first peak and at the end.
    (
        "at_peak.extent",
        Source::Run(|it| Ok(extent(&it.crack_at_peak()?))),
    ),
    (
        "at_peak.mean_x",
        Source::Run(|it| Ok(mean(&it.crack_at_peak()?, |[x, _]| x))),
    ),
    (
        "at_peak.mean_y",
        Source::Run(|it| Ok(mean(&it.crack_at_peak()?, |[_, y]| y))),
    ),
    (
        "at_peak.width",
        Source::Run(|it| Ok(mean(&it.crack_at_peak()?, |[x, _]| x * x).sqrt())),
    ),
    (
        "at_peak.splits",
        Source::Run(|it| it.splits(&it.crack_at_peak()?)),
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
    ("crack.to_platens", Source::Run(gap_to_platens)),
    ("crack.between_cuts", Source::Run(|it| Ok(gap_of_cuts(it)))),
    // Mean distance of a crack that goes along x (y) from its image after half a turn, m.
    (
        "crack.half_turn_x",
        Source::Run(|it| Ok(half_turn(&it.crack(), [1.0, 0.0]))),
    ),
    (
        "crack.half_turn_y",
        Source::Run(|it| Ok(half_turn(&it.crack(), [0.0, 1.0]))),
    ),
    // 1 where this distance is at most a horizon; 1 where the crack reaches farther on the left; and the angle of the cut's two cracks,
    // degrees.
    ("crack.is_symmetric", Source::Run(is_symmetric)),
    ("crack.leads_left", Source::Run(leads_left)),
    ("crack.towards_left", Source::Run(turn_to_left)),
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
        Source::Run(|it| griffith::relative_strength(it.solution, it.numbers)),
    ),
    (
        "griffith.crossing",
        Source::Run(|it| griffith::crossing_energy(it.solution, it.numbers)),
    ),
    (
        "griffith.released",
        Source::Run(|it| griffith::released_energy_ratio(it.solution, it.numbers)),
    ),
    (
        "griffith.separation",
        Source::Run(|it| griffith::separation_energy(it.solution, it.numbers)),
    ),
    (
        "griffith.deviation",
        Source::Run(|it| griffith::deviation(it.solution, it.numbers)),
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
    // Ratios of the body's constants and of the material's along x, along y and in shear; the largest deviation of a bond.
    (
        "patch.young_x",
        Source::Patch(|it| Ok(ratios_of_constants(it)?[0])),
    ),
    (
        "patch.young_y",
        Source::Patch(|it| Ok(ratios_of_constants(it)?[1])),
    ),
    (
        "patch.shear_modulus",
        Source::Patch(|it| Ok(ratios_of_constants(it)?[2])),
    ),
    ("patch.largest", Source::Patch(|it| Ok(it.largest))),
    ("equations.unknowns", Source::Equations(|it| it.unknowns)),
    ("equations.bonds", Source::Equations(|it| it.bonds)),
    ("equations.matrix", Source::Equations(|it| it.matrix)),
    ("equations.factor", Source::Equations(|it| it.factor)),
    (
        "equations.multiplications",
        Source::Equations(|it| it.multiplications),
    ),
];

/// Refuses a name without a quantity.
pub(super) fn ensure_known(name: &str) -> anyhow::Result<()> {
    source(name).map(|_| ())
}

fn source(name: &str) -> anyhow::Result<Source> {
    let found = QUANTITIES.iter().find(|it| it.0 == name);
    let (first, _) = name.split_once('.').unwrap_or((name, ""));
    Ok(match (found, first) {
        (Some(it), _) => it.1,
        (_, "frequency") => Source::Frequency,
        (_, "turn") => {
            Source::CaseRun(|case_run, angle, _| change_by_turn(case_run, angle.parse()?))
        }
        (_, "direction") => Source::CaseRun(|case_run, name, _| stiffness(case_run, name)),
        (_, "loaded_elements") => Source::CaseRun(|_, name, number| loaded_elements(name, number)),
        (_, "intact") => Source::Named(|it, name| it.intact(name)),
        (_, "end") => Source::End,
        (_, "phase_speed") => Source::Named(|it, points| it.phase_speed(points.parse()?)),
        (_, "at_point") => Source::Named(|it, name| it.at_point(name)),
        (_, "common_breaks") => Source::CommonBreaks,
        (_, "first_yield") => Source::FirstYield,
        (_, "largest") => Source::Named(|it, name| it.largest(name)),
        (_, "elements") => Source::Named(|it, name| it.difference_from_elements(name)),
        (_, "modes") => Source::Modes(Cantilever::Case),
        (_, "square_elements") => Source::Modes(Cantilever::SquareOfElements),
        (_, "lamina_elements") => Source::Modes(Cantilever::LaminaOfElements),
        (_, "ghost") => Source::Ghost,
        (_, "crack") => Source::Named(|it, name| it.crack_quantity(name)),
        (_, "grown") => Source::Named(|it, length| it.load_at_length(length.parse()?)),
        (_, CURVE) => Source::Curve,
        _ if history::NAMES.contains(&first) => Source::Row,
        _ => anyhow::bail!("no label, no number and no quantity is called `{name}`"),
    })
}

/// Quantities read from a run.
pub(super) struct RunResults {
    /// Quantities by name, in all rows of the history or once; the reason why one has no value.
    values: BTreeMap<String, Result<Vec<f64>, String>>,
    /// Displacement and load up to the end, m and N; empty where nothing was loaded.
    pub(super) curve: Vec<[f64; 2]>,
}

/// Further results of a case run that quantities need.
#[derive(Default)]
struct ComputedResults {
    /// Frequencies of the elastic modes, Hz.
    modes: Vec<f64>,
    equations: Option<Equations>,
    /// Constants of the family of the point nearest to the origin.
    family: Option<EngineeringConstants>,
    /// Model of the patch test and the ghost forces.
    model: Option<Model>,
    patch: Option<PatchTest>,
    ghosts: Option<GhostForces>,
    run: Option<(Solution, HistoryCollector)>,
    to_the_end: Option<Solution>,
    cantilevers: BTreeMap<Cantilever, Frequencies>,
    /// Breakages with explicit and with implicit steps.
    schemes: Vec<Vec<BreakRecord>>,
    /// Errors of first yield, by the name of the quantity up to its statistic.
    first_yields: BTreeMap<String, Anisotropy>,
}

impl ComputedResults {
    /// Computes all results of a case that the sources need.
    fn new(
        case_run: &CaseRun,
        sources: &[(String, Source)],
        numbers: Number<'_>,
    ) -> anyhow::Result<Self> {
        let mut found = Self::default();
        for (name, source) in sources {
            match source {
                Source::FirstYield => {
                    let (of, _) = name.rsplit_once('.').unwrap_or_default();
                    if !found.first_yields.contains_key(of) {
                        let mut words = of.split('.').skip(1);
                        let (criterion, strain) =
                            words.next().zip(words.next()).context("no strain")?;
                        let anisotropy = Anisotropy::new(&case_run.model()?, criterion, strain)?;
                        found.first_yields.insert(of.to_owned(), anisotropy);
                    }
                }
                Source::CommonBreaks if found.schemes.is_empty() => {
                    for scheme in ["explicit", "implicit"] {
                        let case_run = case_run.clone().set("motion.scheme", scheme);
                        found.schemes.push(case_run.solve_with_breakages()?.1);
                    }
                }
                Source::Frequency if found.modes.is_empty() => found.modes = frequencies(case_run)?,
                Source::Equations(_) if found.equations.is_none() => {
                    found.equations = Some(Equations::from_model(&case_run.model()?)?);
                }
                Source::Family(_) if found.family.is_none() => {
                    found.family = Some(family_in_the_middle(case_run)?);
                }
                Source::Patch(_) if found.patch.is_none() => {
                    found.patch = Some(patch_test(found.model(case_run)?)?);
                }
                Source::Ghost if found.ghosts.is_none() => {
                    found.ghosts = Some(GhostForces::from_model(found.model(case_run)?)?);
                }
                Source::Modes(of) if !found.cantilevers.contains_key(of) => {
                    let frequencies = of.frequencies(case_run, numbers)?;
                    found.cantilevers.insert(*of, frequencies);
                }
                Source::End if found.to_the_end.is_none() => {
                    found.to_the_end = Some(case_run.solve_to_the_end()?);
                }
                Source::Run(_) | Source::Named(_) | Source::Row | Source::Curve
                    if found.run.is_none() =>
                {
                    let mut watch = HistoryCollector::new(sources.iter().map(|it| &*it.0));
                    found.run = Some((case_run.solve_with_observer(&mut watch)?, watch));
                }
                _ => {}
            }
        }
        Ok(found)
    }

    fn model(&mut self, case_run: &CaseRun) -> anyhow::Result<&Model> {
        Ok(match self.model.take() {
            Some(model) => self.model.insert(model),
            None => self.model.insert(case_run.model()?),
        })
    }

    /// The value of a quantity, or its values in all rows.
    fn values(
        &self,
        (name, source): &(String, Source),
        case_run: &CaseRun,
        numbers: Number<'_>,
    ) -> anyhow::Result<Vec<f64>> {
        let run = || self.run.as_ref().context("the case was not run");
        let loaded = || {
            let (solution, watch) = run()?;
            anyhow::Ok(LoadedRun {
                solution,
                breaks: &watch.breaks,
                numbers,
            })
        };
        let (_, rest) = name.split_once('.').unwrap_or_default();
        Ok(vec![match source {
            Source::CaseRun(of) => of(case_run, rest, numbers)?,
            Source::Named(of) => of(&loaded()?, rest)?,
            Source::CommonBreaks => common_breaks(&self.schemes, 1e-6 * rest.parse::<f64>()?),
            Source::FirstYield => {
                let (of, statistic) = name.rsplit_once('.').unwrap_or_default();
                let anisotropy = self.first_yields.get(of).context("nothing yields")?;
                anisotropy.named(statistic)?
            }
            Source::Modes(of) => {
                let frequencies = self.cantilevers.get(of).context("no modes were found")?;
                frequencies.named(rest)?
            }
            Source::Frequency => frequency(&self.modes, rest)?,
            Source::Equations(of) => of(self.equations.as_ref().context("there is no model")?),
            Source::Family(of) => of(self.family.as_ref().context("there is no family")?),
            Source::Patch(of) => of(self.patch.as_ref().context("there is no patch test")?)?,
            Source::Ghost => {
                let ghosts = self.ghosts.as_ref().context("there are no ghost forces")?;
                ghosts.named(rest, numbers)?
            }
            Source::Curve => anyhow::bail!("a curve is no number"),
            Source::Run(of) => of(&loaded()?)?,
            Source::Row => {
                let (solution, watch) = run()?;
                return watch.values(solution, name, numbers);
            }
            Source::End => {
                let solution = self.to_the_end.as_ref().context("the case was not run")?;
                let termination = &solution.outcome.termination;
                let ends = matches!(termination, Termination::NoEquilibrium { .. });
                ensure!(ends, "an equilibrium follows: {termination}");
                let last = solution.outcome.history.last();
                history::value(solution, last.context("no equilibrium")?, rest)?
            }
        }])
    }
}

impl RunResults {
    /// Runs a case and reads some quantities.
    pub(super) fn from_case_run(
        case_run: &CaseRun,
        wanted: &BTreeSet<String>,
        numbers: Number<'_>,
    ) -> anyhow::Result<Self> {
        let sources = wanted.iter().map(|name| Ok((name.clone(), source(name)?)));
        let sources: Vec<(String, Source)> = sources.collect::<anyhow::Result<_>>()?;
        let found = ComputedResults::new(case_run, &sources, numbers)?;
        let values = sources.iter().filter(|it| it.0 != CURVE).map(|it| {
            let values = found.values(it, case_run, numbers);
            (it.0.clone(), values.map_err(|error| format!("{error:#}")))
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

    /// The value of a quantity, in a row of the history or in the last one.
    pub(super) fn value(&self, name: &str, row: Option<usize>) -> anyhow::Result<f64> {
        let values = self.values.get(name);
        let values = values.with_context(|| format!("`{name}` was not read"))?;
        let values = values
            .as_ref()
            .map_err(|it| anyhow::Error::msg(it.clone()))?;
        let in_row = row.and_then(|row| values.get(row)).or(values.last());
        in_row
            .copied()
            .with_context(|| format!("the run has no rows for `{name}`"))
    }
}

impl Cantilever {
    fn frequencies(self, case_run: &CaseRun, number: Number<'_>) -> anyhow::Result<Frequencies> {
        match self {
            Self::Case => Frequencies::from_case_run(case_run, number("along")? as usize),
            Self::SquareOfElements => {
                square_elements::frequencies(number("nu")?, number("density")?)
            }
            Self::LaminaOfElements => lamina_elements::frequencies(number("turned")?),
        }
    }
}

/// Number of bonds that break up to a time in all runs, over the largest number of them in one run.
fn common_breaks(runs: &[Vec<BreakRecord>], until: f64) -> f64 {
    let early = |run: &Vec<BreakRecord>| -> BTreeSet<u32> {
        let early = run.iter().filter(|it| it.load_factor <= until);
        early.map(|it| it.bond).collect()
    };
    let broken: Vec<BTreeSet<u32>> = runs.iter().map(early).collect();
    let most = broken.iter().map(BTreeSet::len).max().unwrap_or_default();
    let common = broken.into_iter().reduce(|one, other| &one & &other);
    common.unwrap_or_default().len() as f64 / most as f64
}

/// The largest displacement of a square of finite elements, m, from a name such as `traction.u_x`.
fn loaded_elements(name: &str, number: Number<'_>) -> anyhow::Result<f64> {
    let (load, of) = name.split_once('.').context("no component is named")?;
    let (load, nu) = (SquareLoad::named(load)?, number("nu")?);
    Ok(square_elements::largest_displacements(load, nu)?[axis(of)?])
}

fn family_in_the_middle(case_run: &CaseRun) -> anyhow::Result<EngineeringConstants> {
    let model = case_run.model()?;
    let middle = model.plane().cloud.nearest_point([0.0, 0.0]);
    let stiffness = family_stiffness(model.plane(), middle);
    EngineeringConstants::from_stiffness(stiffness).context("the family has no stiffness")
}

/// Frequencies of the elastic modes, Hz.
fn frequencies(case_run: &CaseRun) -> anyhow::Result<Vec<f64>> {
    let modes = case_run.modes()?;
    let elastic = modes.iter().filter(|mode| mode.kind == ModeKind::Elastic);
    Ok(elastic.map(|mode| mode.frequency()).collect())
}

fn frequency(modes: &[f64], number: &str) -> anyhow::Result<f64> {
    let number: usize = number.parse()?;
    let found = number.checked_sub(1).and_then(|it| modes.get(it)).copied();
    found.with_context(|| format!("the body has no elastic mode {number}"))
}

/// Sizes of the equations of equilibrium, with the program's elimination order.
#[derive(Debug, Clone, Copy)]
struct Equations {
    /// Number of bonds.
    bonds: f64,
    /// Number of unknowns, the order of the stiffness matrix.
    unknowns: f64,
    /// Number of entries of the matrix's lower triangle.
    matrix: f64,
    /// Number of values of the matrix's factor.
    factor: f64,
    /// Number of multiplications of the factorisation.
    multiplications: f64,
}

impl Equations {
    /// The sizes of the equations of a model.
    ///
    /// # Errors
    ///
    /// If the supports and loads, or the equations, cannot be set up.
    fn from_model(model: &Model) -> anyhow::Result<Self> {
        let loading = Loading::new(model)?;
        let problem = loading.problem(model);
        let equilibrium = Equilibrium::new(&problem, ELASTIC_ENERGY_TOLERANCE)?;
        let stiffness = equilibrium.stiffness();
        let stiffness = stiffness.context("the equations are solved without a matrix")?;
        let symbolic = stiffness.symbolic();
        Ok(Self {
            bonds: model.plane().bonds.len() as f64,
            unknowns: stiffness.unknowns().len() as f64,
            matrix: symbolic.pattern().n_entries() as f64,
            factor: symbolic.n_factor_values() as f64,
            multiplications: symbolic.n_multiplications(),
        })
    }
}
