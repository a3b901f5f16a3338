//! A thick cylinder of imaginary elements under internal pressure (MBB-PD section 4.2).

use super::experiment::{Compute, Experiment, Findings};
use super::published::published;
use super::table::Extent;
use super::trial::{Template, Trial, displacements, template};
use ligament::run::Solution;

/// The experiment.
pub(super) const EXPERIMENT: Experiment = Experiment {
    name: "cylinder",
    title: "Thick cylinder of imaginary elements",
    source: "Lame's solution, independent calculation; Masoumi, Ravandi and Salehi (MBB-PD), section 4.2",
    setup: "Ring from 1.5 to 2.2 m on a square lattice, E = 65.8 GPa, plane strain, m = 3, 400 MPa on the faces of the cells at the \
            hole. u_r of all points, less the rigid motion that leaves nothing of it in the mean, against Lame's solution. The paper has a polar grid of 1 mm: eqs 12 \
            to 15 take differences between neighbours along x and along y, which a polar grid has not, and along r and theta they \
            leave u_r/r out of the hoop strain. Square cells with steps at the rims stand in its place; of 1 mm they would be 8 million \
            points.",
    cases: &[&RING],
    compute: Compute::Code(compute),
};

static RING: Template = template!("thick-cylinder/case.toml");

const INNER: f64 = 1.5;
const OUTER: f64 = 2.2;
const YOUNG: f64 = 65.8e9;
const PRESSURE: f64 = 400e6;

fn compute(extent: Extent) -> anyhow::Result<Findings> {
    let table = published!("mbb-cylinder").judge(extent, |labels| {
        let (spacing, nu) = (1e-3 * labels.number("d")?, labels.number("nu")?);
        Ok(100.0 * difference(&trial(spacing, nu).solve()?, nu))
    })?;
    Ok(Findings {
        tables: vec![table],
        plots: Vec::new(),
        ..Findings::default()
    })
}

/// The cylinder on a lattice of a spacing (m).
pub(super) fn trial(spacing: f64, nu: f64) -> Trial {
    let cells = 2 * (OUTER / spacing).round() as u32;
    (RING.trial())
        .on_lattice([cells, cells], spacing)
        .set("material.poisson", nu)
}

/// The radial displacement of a point, m.
pub(super) struct Radial {
    /// Position of the point, m.
    pub(super) place: [f64; 2],
    /// Radial displacement by the lattice, m.
    pub(super) found: f64,
    /// Radial displacement by Lame, m.
    pub(super) exact: f64,
}

/// L2 norm over the points of the difference from Lame's u_r over that of u_r.
fn difference(solution: &Solution, nu: f64) -> f64 {
    let points = radial(solution, nu);
    let apart: f64 = points.iter().map(|it| (it.found - it.exact).powi(2)).sum();
    let size: f64 = points.iter().map(|it| it.exact.powi(2)).sum();
    (apart / size).sqrt()
}

/// The radial displacements of all points, compared with
///
/// u_r = (1 + nu)/E A ((1 - 2 nu) r + r_o^2/r), A = p r_i^2/(r_o^2 - r_i^2).
pub(super) fn radial(solution: &Solution, nu: f64) -> Vec<Radial> {
    let cloud = &solution.model.plane().cloud;
    let places = cloud.positions.iter();
    let places = places.map(|[x, y]| [x + cloud.origin[0], y + cloud.origin[1]]);
    let points: Vec<([f64; 2], [f64; 2])> = places.zip(displacements(solution)).collect();
    // The lattice is symmetric about the centre: the rigid motion is the mean displacement and the mean rotation. A rotation has no u_r.
    let count = points.len() as f64;
    let mean = [0, 1].map(|axis| points.iter().map(|(_, u)| u[axis]).sum::<f64>() / count);
    let constant = PRESSURE * INNER.powi(2) / (OUTER.powi(2) - INNER.powi(2));
    let of_point = |(place, [u, v]): ([f64; 2], [f64; 2])| {
        let [x, y] = place;
        let r = x.hypot(y);
        Radial {
            place,
            found: ((u - mean[0]) * x + (v - mean[1]) * y) / r,
            exact: (1.0 + nu) / YOUNG * constant * ((1.0 - 2.0 * nu) * r + OUTER.powi(2) / r),
        }
    };
    points.into_iter().map(of_point).collect()
}
