//! Stress concentration at a round hole in a plate under tension.

use anyhow::Context;
use ligament::body::Origin;
use ligament::run::Solution;
use ligament_analysis::interface::StressReading;
use ligament_model::UnbrokenBonds;
use ligament_model::thermal::ThermalStrain;

use super::case_run::displacements;

/// Stress concentration K_t at the rim of the hole of a plate, and the root mean square residual of its fit over K_t, %, from the strain
/// between neighbours times `young` (Pa), from the virial stress and from the traction; all over the `traction` (Pa) on the ends.
pub(super) fn concentrations(
    solution: &Solution,
    young: f64,
    traction: f64,
) -> anyhow::Result<[[f64; 2]; 3]> {
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
        [middle[1].atan2(middle[0]), young * strain / traction]
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
        [y.atan2(x), stress / traction]
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

/// Value a + b of the fit a + b cos(2 theta) to values over theta, and its residual over this value, %.
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
