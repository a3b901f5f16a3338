//! A thick ring under internal pressure on an irregular mesh.

use ligament::run::Solution;

use super::experiment::{Compute, Experiment, Findings};
use super::published::published;
use super::table::Extent;
use super::trial::{Memory, StoredMesh, Template, displacements, stored_mesh, template};

/// The experiment.
pub(super) const EXPERIMENT: Experiment = Experiment {
    name: "ring",
    title: "Thick ring under internal pressure on an irregular mesh",
    source: "closed form (Lame)",
    setup: "Ring from 0.1 to 0.2 m, plane strain, E = 65.8 GPa, nu = 0.2, NHPD, 100 MPa on the inside, on meshes of 10.1 mm (1,270 points) and \
            4.85 mm (4,995 points, 20 from the inside to the outside). u_r less the rigid motion that leaves nothing of it in the mean: its \
            mean over the points of the inside and of the outside over Lame's, and the L2 norm of what all points miss over that of Lame's u_r.",
    cases: &[&RING],
    compute: Compute::Code(compute),
};

static RING: Template = template!("pressure-annulus/case.toml");

static COARSE: StoredMesh = stored_mesh!("annulus-coarse.msh");
static FINE: StoredMesh = stored_mesh!("annulus.msh");

const INNER: f64 = 0.1;
const OUTER: f64 = 0.2;
const YOUNG: f64 = 65.8e9;
const POISSON: f64 = 0.2;
const PRESSURE: f64 = 100e6;

/// Relative distance from a radius within which a point lies on it.
const ON_RIM: f64 = 1e-6;

/// Mean ratios of u_r to Lame's solution on the inside and on the outside, and L2 norm of the differences over its norm, %.
type Reading = [f64; 3];

fn compute(extent: Extent) -> anyhow::Result<Findings> {
    let mut memory = Memory::default();
    let table = published!("ring").judge(extent, |labels| {
        let mesh = match labels.text("mesh")? {
            "10.1 mm" => &COARSE,
            _ => &FINE,
        };
        let trial = (RING.trial())
            .on_mesh(mesh)
            .set("model.horizon_factor", labels.number("lambda")?)
            .set("correction.surface", labels.text("correction")?);
        let [inside, outside, all] = memory.reading(&trial, |it| Ok(read(it)))?;
        Ok(match labels.text("of")? {
            "inside" => inside,
            "outside" => outside,
            _ => all,
        })
    })?;
    Ok(Findings {
        tables: vec![table],
        plots: Vec::new(),
        ..Findings::default()
    })
}

/// Lame's solution u_r = (1 + nu)/E A ((1 - 2 nu) r + r_o^2/r), A = p r_i^2/(r_o^2 - r_i^2), m.
fn lame(r: f64) -> f64 {
    let constant = PRESSURE * INNER.powi(2) / (OUTER.powi(2) - INNER.powi(2));
    (1.0 + POISSON) / YOUNG * constant * ((1.0 - 2.0 * POISSON) * r + OUTER.powi(2) / r)
}

fn read(solution: &Solution) -> Reading {
    let cloud = &solution.model.plane().cloud;
    let places = cloud.positions.iter();
    let places = places.map(|[x, y]| [x + cloud.origin[0], y + cloud.origin[1]]);
    let moved: Vec<([f64; 2], [f64; 2])> = places.zip(displacements(solution)).collect();
    // Lame's field has a zero mean over the volume, and a rotation has no u_r.
    let volume: f64 = cloud.volumes.iter().sum();
    let mean = [0, 1].map(|axis| {
        let weighted = moved.iter().zip(&cloud.volumes);
        weighted
            .map(|((_, u), volume)| volume * u[axis])
            .sum::<f64>()
            / volume
    });
    let radial: Vec<[f64; 2]> = (moved.iter())
        .map(|([x, y], [u, v])| {
            let r = x.hypot(*y);
            [r, ((u - mean[0]) * x + (v - mean[1]) * y) / r]
        })
        .collect();
    let on = |radius: f64| {
        let points = radial
            .iter()
            .filter(|[r, _]| (r / radius - 1.0).abs() < ON_RIM);
        let ratios: Vec<f64> = points.map(|[r, u]| u / lame(*r)).collect();
        ratios.iter().sum::<f64>() / ratios.len() as f64
    };
    let apart: f64 = radial.iter().map(|[r, u]| (u - lame(*r)).powi(2)).sum();
    let size: f64 = radial.iter().map(|[r, _]| lame(*r).powi(2)).sum();
    [on(INNER), on(OUTER), 100.0 * (apart / size).sqrt()]
}
