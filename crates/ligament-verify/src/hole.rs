//! Stress concentration at a round hole in a plate under tension.

use anyhow::Context;
use ligament::body::Origin;
use ligament::run::Solution;
use ligament_analysis::interface::StressReading;
use ligament_model::UnbrokenBonds;
use ligament_model::thermal::ThermalStrain;

use super::experiment::{Compute, Experiment, Findings};
use super::published::published;
use super::table::Extent;
use super::trial::{Memory, StoredMesh, Template, displacements, stored_mesh, template};

/// The experiment.
pub(super) const EXPERIMENT: Experiment = Experiment {
    name: "hole",
    title: "Stress concentration at a round hole",
    source: "closed form for a strip of finite width (Howland 1930; Peterson): K_t = 3.03 of the stress on the whole section at d/W = 0.1",
    setup: "Plate 100 x 200 mm with a hole of 10 mm, pulled along its length by tractions on its ends, on Delaunay meshes that are 1, 0.5 and \
            0.25 mm wide at the hole, and a tenth of the distance from it wider outside (1,494, 2,342 and 3,753 points). E = 15 GPa, \
            nu = 0.3, plane stress, NHPD, no bonds across the hole. Hoop stresses at the rim, from the strain between neighbours there \
            times E, from the virial stress of the points and from the traction, are fitted by a + b cos(2 theta): K_t is a + b over the \
            stress at the ends, the scatter the root mean square of what the fit leaves over a + b.",
    cases: &[&CASE],
    compute: Compute::Code(compute),
};

static CASE: Template = template!("verification/plate-with-hole.toml");

static MESHES: [(&str, StoredMesh); 3] = [
    ("1", stored_mesh!("plate-with-hole-1mm.msh")),
    ("0.5", stored_mesh!("plate-with-hole-0.5mm.msh")),
    ("0.25", stored_mesh!("plate-with-hole-0.25mm.msh")),
];

const YOUNG: f64 = 15e9;

/// Traction on the ends, Pa: the force per length of the case over its thickness.
const TRACTION: f64 = 1e6;

/// Quantities from which K_t is obtained, in the order of the readings.
const FROM: [&str; 3] = ["strain", "virial stress", "traction"];

/// K_t and the scatter about it, %, from each quantity.
type Reading = [[f64; 2]; FROM.len()];

fn compute(extent: Extent) -> anyhow::Result<Findings> {
    let mut memory = Memory::default();
    let table = published!("hole").judge(extent, |labels| {
        let size = labels.text("h")?;
        let stored = MESHES.iter().find(|(name, _)| *name == size);
        let (_, stored) = stored.context("no such mesh")?;
        let trial = (CASE.trial())
            .on_mesh(stored)
            .set("model.horizon_factor", labels.number("lambda")?)
            .set("correction.surface", labels.text("correction")?);
        let reading = memory.reading(&trial, read)?;
        let from = labels.text("from")?;
        let from = FROM.iter().position(|it| *it == from);
        Ok(reading[from.context("no such stress")?][usize::from(labels.text("of")? == "scatter")])
    })?;
    Ok(Findings {
        tables: vec![table],
        plots: Vec::new(),
        ..Findings::default()
    })
}

fn read(solution: &Solution) -> anyhow::Result<Reading> {
    let Origin::Mesh(mesh) = solution.model.body().origin() else {
        anyhow::bail!("the body is no mesh");
    };
    let rim = mesh.group("hole").context("the mesh has no hole")?;
    let moved: Vec<[f64; 2]> = displacements(solution).collect();
    let strains = rim.edges.iter().map(|edge| {
        let [a, b] = edge.map(|node| node as usize);
        let [x, u] = [&mesh.positions, &moved].map(|of| [of[b][0] - of[a][0], of[b][1] - of[a][1]]);
        let squared = x[0] * x[0] + x[1] * x[1];
        let middle = [0, 1].map(|axis| 0.5 * (mesh.positions[a][axis] + mesh.positions[b][axis]));
        let strain = (x[0] * u[0] + x[1] * u[1]) / squared;
        [middle[1].atan2(middle[0]), YOUNG * strain / TRACTION]
    });
    let system = solution.model.plane();
    let state = &solution.outcome.state;
    let deformations = system.deformations(&state.intact, &state.displacement, ThermalStrain::NONE);
    let bonds = UnbrokenBonds::whole(&state.intact);
    let stresses = |reading| system.stresses(reading, bonds, &deformations).values;
    let virial = stresses(StressReading::Virial);
    let (virial, _) = virial.as_chunks::<3>();
    let tractions = stresses(StressReading::Traction);
    let (tractions, _) = tractions.as_chunks::<4>();
    let hoop = |node: u32, [xx, yy, xy]: [f64; 3]| {
        let [x, y] = mesh.positions[node as usize];
        let [s, c] = [y, x].map(|it| it / x.hypot(y));
        let stress = s * s * xx + c * c * yy - 2.0 * s * c * xy;
        [y.atan2(x), stress / TRACTION]
    };
    let nodes = || rim.nodes.iter().copied();
    Ok([
        fit(strains),
        fit(nodes().map(|node| hoop(node, virial[node as usize]))),
        fit(nodes().map(|node| {
            let [xx, yx, yy, xy] = tractions[node as usize];
            hoop(node, [xx, yy, 0.5 * (yx + xy)])
        })),
    ])
}

/// Value a + b of the fit a + b cos(2 theta) to values over theta, and its residual over that, %.
fn fit(values: impl Iterator<Item = [f64; 2]>) -> [f64; 2] {
    let values: Vec<[f64; 2]> = values.collect();
    let count = values.len() as f64;
    let mean = |of: &dyn Fn(f64, f64) -> f64| {
        values
            .iter()
            .map(|[angle, value]| of((2.0 * angle).cos(), *value))
            .sum::<f64>()
            / count
    };
    let (c, cc) = (mean(&|c, _| c), mean(&|c, _| c * c));
    let (v, cv) = (mean(&|_, v| v), mean(&|c, v| c * v));
    let b = (cv - c * v) / (cc - c * c);
    let a = v - b * c;
    let left = mean(&|c, v| (v - a - b * c).powi(2)).sqrt();
    [a + b, 100.0 * left / (a + b)]
}
