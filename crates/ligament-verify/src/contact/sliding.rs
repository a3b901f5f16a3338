//! Friction between a body and rigid bodies: a block on a floor, a wedge, a block that a spring pulls.

use std::f64::consts::PI;

use anyhow::{Context, bail};
use ligament::run::Solution;
use ligament_analysis::Termination;

use crate::experiment::{Compute, Experiment, Findings};
use crate::motion::record::Record;
use crate::published::published;
use crate::table::{Extent, Labels};
use crate::trial::{Memory, Template, template};

/// The experiment.
pub(crate) const EXPERIMENT: Experiment = Experiment {
    name: "contact_sliding",
    title: "Blocks that slide, and a wedge that splits",
    source: "closed forms: Coulomb's friction; balance of forces; cantilevers (Kanninen 1973); equation of motion of a mass on a spring",
    setup: "Floor: a block of 20 x 8 points of 1 mm on a rigid floor under its weight, pulled along the floor in load steps of 1 % of mu times the weight: the \
            shear force over the weight in the last equilibrium. Wedge: the sides of a rigid wedge of 30 degrees move in load steps into the slot of a beam of 22 x 80 mm, arms of 11 mm \
            that are 49.75 mm long, E = 10 GPa, G_c = 100 J/m^2, `critical-stretch`: in the last step before the first break the force on a side along the wedge over P tan(15 degrees + phi) \
            for the force P across it, P over 3 E I d/(a + 0.64 h)^3 for the half of the opening d, and d over that at which the energy release \
            rate is G_c. Spring: a block of 20 x 8 points (0.16 kg) on a floor with mu = 0.3, pulled through a spring of 576 N/m whose far end moves at v = 10 mm/s. It slides \
            once the spring has mu N, by v (1 - cos omega t). Half a period later the far end stops, and the block runs on and sticks. The spring \
            has mu N + v sqrt(k m) at most, and mu N - 2 v sqrt(k m) at rest.",
    cases: &[&FLOOR, &WEDGE, &SPRING],
    compute: Compute::Code(compute),
};

static FLOOR: Template = template!("verification/contact-floor.toml");
static WEDGE: Template = template!("verification/contact-wedge.toml");
static SPRING: Template = template!("verification/contact-spring.toml");

/// Gravity, m/s^2; pull over mu times the weight at the end of the load steps, which end between two percents.
const GRAVITY: f64 = 9.81;
const PULL: f64 = 1.095;

/// Angle of a side of the wedge, degrees; Young's modulus, Pa; fracture energy, J/m^2; thickness, depth and length of an arm, m.
const ANGLE: f64 = 15.0;
const YOUNG: f64 = 10e9;
const TOUGHNESS: f64 = 100.0;
const THICKNESS: f64 = 0.01;
const DEPTH: f64 = 0.011;
const LENGTH: f64 = 49.75e-3;

/// Mass, kg; stiffness of the spring, N/m; velocity of its far end, m/s; its start, s; coefficient of friction.
const MASS: f64 = 0.16;
const STIFFNESS: f64 = 576.0;
const VELOCITY: f64 = 0.01;
const START: f64 = 0.02;
const FRICTION: f64 = 0.3;

fn compute(extent: Extent) -> anyhow::Result<Findings> {
    let (mut wedges, mut springs) = (Memory::default(), Memory::default());
    let floor = published!("contact-floor").judge(extent, floor)?;
    let wedge = published!("contact-wedge").judge(extent, |labels| wedge(labels, &mut wedges))?;
    let spring =
        published!("contact-spring").judge(extent, |labels| spring(labels, &mut springs))?;
    Ok(Findings {
        tables: vec![floor, wedge, spring],
        ..Findings::default()
    })
}

/// Shear force over the weight in the last equilibrium.
fn floor(labels: Labels<'_>) -> anyhow::Result<f64> {
    let friction = labels.number("mu")?;
    let trial = (FLOOR.trial())
        .set("rigid.0.friction", friction)
        .set("load.1.acceleration.x", PULL * friction * GRAVITY);
    let outcome = trial.solve_to_the_end()?.outcome;
    if !matches!(outcome.termination, Termination::NoEquilibrium { .. }) {
        bail!("the block does not slide: {}", outcome.termination);
    }
    let last = outcome.history.last().context("no equilibrium")?;
    let on_floor = last.rigid_bodies.first().context("no floor")?.force;
    Ok((on_floor[0] / on_floor[1]).abs())
}

/// Forces and opening of the wedge in the last step before the first break, over those of the closed forms.
fn wedge(labels: Labels<'_>, memory: &mut Memory<[f64; 3]>) -> anyhow::Result<f64> {
    let friction = labels.number("mu")?;
    let mut trial = WEDGE.trial();
    for side in ["rigid.0.friction", "rigid.1.friction"] {
        trial = trial.set(side, friction);
    }
    let [along, across, opening] = memory.reading(&trial, |solution| {
        let mut rows = solution.outcome.history.iter();
        let before = rows.rfind(|row| row.broken_bonds == 0);
        let before = before.context("no step without a broken bond")?;
        let side = before.rigid_bodies.first().context("no wedge")?.force;
        let sloping = (ANGLE.to_radians() + friction.atan()).tan();
        let arm = LENGTH + 0.64 * DEPTH;
        let opening = 0.5 * before.probes.first().context("no probe")?;
        let inertia = THICKNESS * DEPTH.powi(3) / 12.0;
        let force = 3.0 * YOUNG * inertia * opening / arm.powi(3);
        let at_start = (4.0 * TOUGHNESS / (3.0 * YOUNG * DEPTH.powi(3))).sqrt() * arm.powi(2);
        Ok([
            (side[1] / side[0]).abs() / sloping,
            side[0].abs() / force,
            opening / at_start,
        ])
    })?;
    Ok(match labels.text("of")? {
        "force along the wedge" => along,
        "force across it" => across,
        "opening before the first break" => opening,
        other => bail!("no quantity `{other}`"),
    })
}

/// Force of the spring over that of the closed form, or the time at which it is largest.
fn spring(labels: Labels<'_>, memory: &mut Memory<[f64; 3]>) -> anyhow::Result<f64> {
    let trial = match labels.text("scheme")? {
        "explicit" => SPRING.trial(),
        "implicit" => SPRING.trial().set_toml("motion", IMPLICIT),
        other => bail!("no scheme `{other}`"),
    };
    let [largest, time, rest] = memory.reading(&trial, pulled)?;
    Ok(match labels.text("of")? {
        "largest force" => largest,
        "its time" => time,
        "force at rest" => rest,
        other => bail!("no quantity `{other}`"),
    })
}

/// Implicit steps in the place of explicit ones; the block itself comes to rest by the dissipation of the scheme.
const IMPLICIT: &str =
    "{ duration = 0.22, rows = 440, scheme = \"implicit\", step = 5e-4, dissipation = 0.05 }";

fn pulled(solution: &Solution) -> anyhow::Result<[f64; 3]> {
    let groups = &solution
        .outcome
        .history
        .first()
        .context("no rows")?
        .group_forces;
    let place = groups.len().checked_sub(1).context("no spring")?;
    let force = Record::of_rows(solution, |row| row.group_forces[place][0]);
    let end = force.times.last().copied().unwrap_or_default();
    let [time, largest] = force.peak([0.0, end])?;
    let rest = force.at(end)?;
    let limit = FRICTION * MASS * GRAVITY;
    let swing = VELOCITY * (STIFFNESS * MASS).sqrt();
    let begin = START + limit / (STIFFNESS * VELOCITY);
    let quarter = 0.5 * PI * (MASS / STIFFNESS).sqrt();
    Ok([
        largest / (limit + swing),
        time / (begin + quarter),
        rest / (limit - 2.0 * swing),
    ])
}
