//! A cylinder and a sphere that rest on a block.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use anyhow::{Context, bail};
use ligament::run::Solution;

use crate::experiment::{Compute, Experiment, Findings};
use crate::published::published;
use crate::table::{Extent, Labels};
use crate::trial::{Memory, Template, template};

/// The experiment.
pub(crate) const EXPERIMENT: Experiment = Experiment {
    name: "contact_hertz",
    title: "A cylinder and a sphere pressed into a block",
    source: "closed form (Hertz; Johnson 1985, sections 4.2 and 4.3)",
    setup: "Rigid, of a radius R = 0.1 m, pressed into a block of E = 70 GPa, nu = 0.25 by a displacement in one step. Cylinder: 140 x 70 points of 0.5 mm, plane \
            strain, nhpd. Sphere: 36 x 36 x 18 points of 1 mm, bbpd. The mean pressures p of the sides of cells that are in contact as a whole, at the distance r from the middle, are fitted by p^2 = p_0^2 - b r^2, by \
            least squares, for p_0. The half-width or radius a is that of Hertz's pressures with the second moment of all pressures, 1/F times the integral of p r^2: \
            a^2/4, of the sphere 2 a^2/5. All quantities are over those of Hertz for the force F on the block: p_0, a, the force of both, \
            pi a p_0/2 for each length or 2 pi a^2 p_0/3, and the largest pressure of a side.",
    cases: &[&CYLINDER, &SPHERE],
    compute: Compute::Code(compute),
};

static CYLINDER: Template = template!("verification/contact-cylinder.toml");
static SPHERE: Template = template!("verification/contact-sphere.toml");

/// Radius, m, and E/(1 - nu^2), Pa.
const RADIUS: f64 = 0.1;
const MODULUS: f64 = 70e9 / (1.0 - 0.0625);

/// Pressures of a contact.
#[derive(Debug, Clone, Copy)]
struct Pressed {
    /// Force, N; of the cylinder for each length, N/m.
    force: f64,
    /// Largest pressure of a side of a cell, and of the fit, Pa.
    largest: [f64; 2],
    /// Half-width or radius by the second moment of the pressures, m.
    reach: f64,
}

fn compute(extent: Extent) -> anyhow::Result<Findings> {
    let mut memory = Memory::default();
    let table = published!("contact-hertz").judge(extent, |labels| entry(labels, &mut memory))?;
    Ok(Findings {
        tables: vec![table],
        ..Findings::default()
    })
}

fn entry(labels: Labels<'_>, memory: &mut Memory<Pressed>) -> anyhow::Result<f64> {
    let body = labels.text("body")?;
    // Directions along the surface, which come first, and integration points of a side of a cell.
    let (case, along, points) = match body {
        "cylinder" => (&CYLINDER, 1, 2),
        "sphere" => (&SPHERE, 2, 6),
        other => bail!("no body `{other}`"),
    };
    let found = memory.reading(&case.trial(), |solution| pressed(solution, along, points))?;
    let force = found.force;
    let (reach, largest, of_fit) = if body == "cylinder" {
        let reach = (4.0 * force * RADIUS / (PI * MODULUS)).sqrt();
        let of_fit = 0.5 * PI * found.reach * found.largest[1];
        (reach, 2.0 * force / (PI * reach), of_fit)
    } else {
        let reach = (0.75 * force * RADIUS / MODULUS).cbrt();
        let of_fit = 2.0 / 3.0 * PI * found.reach.powi(2) * found.largest[1];
        (reach, 1.5 * force / (PI * reach.powi(2)), of_fit)
    };
    Ok(match labels.text("of")? {
        "p_0" => found.largest[1] / largest,
        "largest pressure" => found.largest[0] / largest,
        "a" => found.reach / reach,
        "force" => of_fit / force,
        other => bail!("no quantity `{other}`"),
    })
}

/// Pressures under a rigid body from the sides of cells in contact, over so many directions along the surface and so many integration points of a side.
fn pressed(solution: &Solution, along: usize, points: u32) -> anyhow::Result<Pressed> {
    let touches = &solution.outcome.state.surfaces.touching().touches;
    let all = touches.first().context("no contact")?.iter();
    let all: Vec<_> = all.filter(|it| it.depth() > 0.0).collect();
    let force: f64 = all.iter().map(|it| it.stiffness * it.depth()).sum();
    let squares = |arm: &[f64]| -> f64 { arm.iter().take(along).map(|it| it * it).sum() };
    let moments = all
        .iter()
        .map(|it| it.stiffness * it.depth() * squares(&it.arm));
    let second = moments.sum::<f64>() / force;
    // Of p_0 sqrt(1 - r^2/a^2) over a strip and over a disk.
    let of_reach = if along == 1 { 0.25 } else { 0.4 };
    let mut sides: BTreeMap<u32, Vec<[f64; 2]>> = BTreeMap::new();
    for it in &all {
        let reading = [squares(&it.arm), it.stiffness * it.depth() / it.area];
        sides.entry(it.place / points).or_default().push(reading);
    }
    // Only sides of cells that are in contact as a whole.
    let whole = sides.values().filter(|it| it.len() == points as usize);
    let places = whole.map(|it| {
        let mean = |axis: usize| it.iter().map(|it| it[axis]).sum::<f64>() / f64::from(points);
        [mean(0), mean(1).powi(2)]
    });
    let places: Vec<[f64; 2]> = places.collect();
    let count = places.len() as f64;
    let mean = |axis: usize| places.iter().map(|it| it[axis]).sum::<f64>() / count;
    let (x, y) = (mean(0), mean(1));
    let products = places.iter().map(|it| (it[0] - x) * (it[1] - y));
    let spread: f64 = places.iter().map(|it| (it[0] - x).powi(2)).sum();
    let slope = products.sum::<f64>() / spread;
    let square = y - slope * x;
    let largest = places.iter().map(|it| it[1]).fold(0.0, f64::max);
    Ok(Pressed {
        force,
        largest: [largest.sqrt(), square.sqrt()],
        reach: (second / of_reach).sqrt(),
    })
}
