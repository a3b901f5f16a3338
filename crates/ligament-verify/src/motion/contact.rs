//! Bodies that meet: colliding bars, a circle on a block, a block on a slope.

use std::f64::consts::PI;

use anyhow::{Context, bail};
use ligament::run::Solution;
use ligament_analysis::history::{ObserverError, StepRecord, View};
use ligament_analysis::{Component, Observer};

use super::record::Record;
use super::waves::with_law;
use crate::experiment::{Compute, Experiment, Findings};
use crate::published::published;
use crate::table::{Extent, Labels};
use crate::trial::{Template, template};

/// The experiment.
pub(crate) const EXPERIMENT: Experiment = Experiment {
    name: "motion_contact",
    title: "Bodies that meet",
    source: "closed forms: exchange of momentum (Saint-Venant), Hertz (Johnson 1985), Coulomb's friction",
    setup: "Collision: two bars of 40 x 3 points of 1 mm, nu = 0; one flies at 20 m/s into the other, and 80 us later both are apart. Shares of the first \
            momentum and energy. Circle: a rigid circle of 0.4 m pressed into a block of 120 x 60 points of 1 mm, E = 70 GPa, nu = 0.25, plane strain, with \
            damping until it rests; the compression of the 20 mm below its middle, over that of the half-plane under Hertz's pressure for the force on the base. \
            Slope: a block of 8 x 4 points of 1 mm on a rigid slope of 25 degrees, with damping; its mean acceleration once gravity is constant, over g, and its last \
            velocity over that without friction.",
    cases: &[&COLLISION, &CIRCLE, &SLOPE],
    compute: Compute::Code(compute),
};

static COLLISION: Template = template!("verification/motion-collision.toml");
static CIRCLE: Template = template!("verification/motion-hertz.toml");
static SLOPE: Template = template!("verification/motion-slope.toml");

/// Number of points of each bar.
const POINTS: f64 = 120.0;

/// Place between the bars, m.
const BETWEEN: f64 = 0.0405;

/// First velocity of the flying bar, m/s.
const VELOCITY: f64 = 20.0;

/// Radius of the circle, m; E/(1 - nu^2), Pa, and nu of the block; depths between which its compression is read, m.
const RADIUS: f64 = 0.4;
const MODULUS: f64 = 70e9 / (1.0 - 0.0625);
const POISSON: f64 = 0.25;
const DEPTHS: [f64; 2] = [0.5e-3, 20.5e-3];

/// Gravity, m/s^2; angle of the slope, degrees; time from which on gravity is constant, and duration after it, s.
const GRAVITY: f64 = 9.81;
const ANGLE: f64 = 25.0;
const GROWTH: f64 = 8e-3;

fn compute(extent: Extent) -> anyhow::Result<Findings> {
    let collision = published!("motion-collision").judge(extent, collision)?;
    let circle = published!("motion-hertz").judge(extent, |_| circle())?;
    let slope = published!("motion-slope").judge(extent, slope)?;
    Ok(Findings {
        tables: vec![collision, circle, slope],
        ..Findings::default()
    })
}

/// Velocities of all degrees of freedom at the rows of a motion.
#[derive(Debug, Default)]
struct Velocities(Vec<Vec<f64>>);

impl Observer for Velocities {
    fn step(&mut self, _: &StepRecord, view: &View<'_>) -> Result<(), ObserverError> {
        self.0
            .extend(view.motion.map(|rates| rates.velocity.to_vec()));
        Ok(())
    }
}

impl Velocities {
    /// Sum over the points left (or right) of a place of the velocities along x in the last row, m/s.
    fn last(&self, solution: &Solution, is_of: impl Fn(f64) -> bool) -> anyhow::Result<f64> {
        let last = self.0.last().context("the motion has no rows")?;
        let body = solution.model.plane();
        let (layout, cloud) = (body.layout(), &body.cloud);
        let points = 0..cloud.len() as u32;
        let own = points.filter(|&it| is_of(cloud.positions[it as usize][0] + cloud.origin[0]));
        Ok(own.map(|it| layout.value(it, Component::X, last)).sum())
    }
}

/// Share of the first momentum or energy after a collision.
fn collision(labels: Labels<'_>) -> anyhow::Result<f64> {
    let mut velocities = Velocities::default();
    let trial = with_law(COLLISION.trial(), labels.text("law")?, "plane");
    let solution = trial.solve_seen(&mut velocities)?;
    let first = POINTS * VELOCITY;
    let last = solution.outcome.history.last().context("no rows")?;
    let motion = last.motion.context("no motion")?;
    Ok(match labels.text("share of")? {
        "momentum, both bars" => velocities.last(&solution, |_| true)? / first,
        "momentum, second bar" => velocities.last(&solution, |x| x > BETWEEN)? / first,
        "energy, lost in contact" => motion.friction_energy / motion.initial_energy,
        other => bail!("no share of `{other}`"),
    })
}

/// Compression below a circle over that of the half-plane.
fn circle() -> anyhow::Result<f64> {
    let solution = CIRCLE.trial().solve()?;
    let compression = Record::of_probe(&solution, "compression")?;
    let found = compression.values.last().context("no rows")?.abs();
    let last = solution.outcome.history.last().context("no rows")?;
    let force = last.group_forces.first().context("no base")?[1];
    let half = (4.0 * force * RADIUS / (PI * MODULUS)).sqrt();
    // Displacement of a place at a depth, less a constant: the integral of the strain below Hertz's pressure.
    let at = |depth: f64| {
        let far = half.hypot(depth);
        let strain = 2.0 * ((depth + far) / half).ln();
        let lateral = 2.0 * depth / half.powi(2) * (far - depth);
        force / (PI * MODULUS) * (strain - POISSON / (1.0 - POISSON) * lateral)
    };
    Ok(found / (at(DEPTHS[1]) - at(DEPTHS[0])))
}

/// Mean acceleration of a block on a slope over gravity, or its way over that without friction.
fn slope(labels: Labels<'_>) -> anyhow::Result<f64> {
    let trial = SLOPE.trial().set("rigid.0.friction", labels.number("mu")?);
    let mut velocities = Velocities::default();
    let solution = trial.solve_seen(&mut velocities)?;
    let end = velocities.last(&solution, |_| true)?;
    let times = Record::of_rows(&solution, |row| row.load_factor).times;
    let kept = times.partition_point(|time| *time < GROWTH * (1.0 - 1e-9)) + 1;
    velocities.0.truncate(kept);
    let start = velocities.last(&solution, |_| true)?;
    let points = solution.model.plane().cloud.len() as f64;
    Ok(match labels.text("of")? {
        "acceleration over g" => (end - start) / points / GROWTH / GRAVITY,
        "last velocity over that without friction" => {
            // The integral of the smooth ramp is half of its duration.
            let free = GRAVITY * ANGLE.to_radians().sin() * 1.5 * GROWTH;
            end / points / free
        }
        other => bail!("no quantity `{other}`"),
    })
}
