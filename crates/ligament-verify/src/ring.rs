//! Displacements of a thick ring under internal pressure, compared with Lame's solution.

use ligament::run::Solution;

use super::case_run::displacements;

/// Relative distance from a radius within which a point lies on it.
const ON_RIM: f64 = 1e-6;

/// A ring in plane strain.
pub(super) struct Ring {
    /// Radii, m.
    pub(super) inner: f64,
    pub(super) outer: f64,
    /// Young's modulus, Pa, and Poisson's ratio.
    pub(super) young: f64,
    pub(super) poisson: f64,
    /// Pressure on the inside, Pa.
    pub(super) pressure: f64,
}

/// Ratios of the radial displacements of a ring to Lame's solution.
pub(super) struct RadialDisplacements {
    /// Mean ratio over the points of the inside and of the outside.
    pub(super) inside: f64,
    pub(super) outside: f64,
    /// L2 norm of the differences from Lame's displacements over the norm of these.
    pub(super) difference: f64,
}

impl Ring {
    /// Lame's solution u_r = (1 + nu)/E A ((1 - 2 nu) r + r_o^2/r), A = p r_i^2/(r_o^2 - r_i^2), m.
    pub(super) fn lame(&self, r: f64) -> f64 {
        let (inner, outer) = (self.inner, self.outer);
        let constant = self.pressure * inner.powi(2) / (outer.powi(2) - inner.powi(2));
        let shape = (1.0 - 2.0 * self.poisson) * r + outer.powi(2) / r;
        (1.0 + self.poisson) / self.young * constant * shape
    }
}

/// Places and radial displacements of all points in the last state of a run, without the rigid motion of a ring, m.
pub(super) fn radial(solution: &Solution) -> Vec<([f64; 2], f64)> {
    let cloud = &solution.model.plane().cloud;
    let places = cloud.positions.iter();
    let places = places.map(|[x, y]| [x + cloud.origin[0], y + cloud.origin[1]]);
    let moved: Vec<([f64; 2], [f64; 2])> = places.zip(displacements(solution)).collect();
    // Lame's field has a zero mean over the volume, and a rotation has no u_r. Points of a lattice have equal volumes.
    let weights = match cloud.lattice_cell {
        Some(_) => vec![1.0; cloud.len()],
        None => cloud.volumes.to_vec(),
    };
    let whole: f64 = weights.iter().sum();
    let mean = [0, 1].map(|axis| {
        let weighted = moved.iter().zip(&weights);
        weighted
            .map(|((_, u), weight)| weight * u[axis])
            .sum::<f64>()
            / whole
    });
    let radial = moved.into_iter().map(|([x, y], [u, v])| {
        let found = ((u - mean[0]) * x + (v - mean[1]) * y) / x.hypot(y);
        ([x, y], found)
    });
    radial.collect()
}

/// Radial displacements of a ring in the last state of a run.
pub(super) fn radial_displacements(solution: &Solution, ring: &Ring) -> RadialDisplacements {
    let radial = radial(solution).into_iter();
    let radial: Vec<[f64; 2]> = radial.map(|([x, y], u)| [x.hypot(y), u]).collect();
    let on = |radius: f64| {
        let points = radial
            .iter()
            .filter(|[r, _]| (r / radius - 1.0).abs() < ON_RIM);
        let ratios: Vec<f64> = points.map(|[r, u]| u / ring.lame(*r)).collect();
        ratios.iter().sum::<f64>() / ratios.len() as f64
    };
    let difference: f64 = radial
        .iter()
        .map(|[r, u]| (u - ring.lame(*r)).powi(2))
        .sum();
    let size: f64 = radial.iter().map(|[r, _]| ring.lame(*r).powi(2)).sum();
    RadialDisplacements {
        inside: on(ring.inner),
        outside: on(ring.outer),
        difference: (difference / size).sqrt(),
    }
}
