//! Tips of cracks that grow from the ends of pre-cracks in the plane.
//!
//! A crack is where the bonds of nearest neighbours are broken. Their midpoints that hang together, with gaps up to a horizon, from the first tip
//! on are the crack that grew from it; the tip is the midpoint farthest away along the shortest path through them. The ring around it is that of a
//! straight crack along the line that fits best the crack within the outer radius.

use super::crack_front::CrackFront;
use super::domain_integral::DomainIntegral;
use super::tip_field::{PlaneModuli, TipQuantity};
use crate::geometry::distance_to;
use crate::grid::in_space;
use crate::system::BondSystem;
use crate::tensor::{SymTensor, cross, dot, minus, norm};

/// Length of the bonds of nearest neighbours over the mean spacing of their ends, at most.
const NEAREST: f64 = 1.5;

/// The tip of a pre-crack in the plane from which a crack grows.
#[derive(Debug, Clone, PartialEq)]
pub struct GrowingTip {
    /// Front of the pre-crack with the radii of the ring.
    pub front: CrackFront,
    /// Quantity that is read.
    pub quantity: TipQuantity,
    /// Moduli of the material, where it is isotropic.
    pub moduli: Option<PlaneModuli>,
    /// Number of the material.
    pub material: usize,
    /// Horizon at the pre-crack, m.
    pub horizon: f64,
    /// Sides of the other pre-cracks in the coordinates of the cloud, m.
    pub others: Vec<[[f64; 3]; 2]>,
}

/// A crack that grew from a tip.
struct GrownCrack {
    /// Places of the crack and of its last part before it grew, within the outer radius of the tip, m.
    near: Vec<[f64; 3]>,
    tip: [f64; 3],
    /// Length of the path to the tip, m.
    advance: f64,
}

impl GrowingTip {
    /// The crack that grew along the midpoints of broken bonds.
    fn crack(&self, midpoints: &[[f64; 3]]) -> GrownCrack {
        let start = self.front.place;
        let mut paths = vec![f64::INFINITY; midpoints.len()];
        let mut reached = vec![false; midpoints.len()];
        let (mut tip, mut advance) = (start, 0.0);
        let mut last = start;
        loop {
            for (path, midpoint) in paths.iter_mut().zip(midpoints) {
                let gap = norm(minus(*midpoint, last));
                if gap <= self.horizon {
                    *path = path.min(advance + gap);
                }
            }
            let waiting = (0..midpoints.len()).filter(|it| !reached[*it] && paths[*it].is_finite());
            let Some(next) = waiting.min_by(|a, b| paths[*a].total_cmp(&paths[*b])) else {
                break;
            };
            reached[next] = true;
            (tip, last, advance) = (midpoints[next], midpoints[next], paths[next]);
        }
        let [_, outer] = self.front.radii;
        let spacing = 0.25 * self.horizon;
        let before = (0..(outer / spacing) as usize).map(|it| {
            let back = it as f64 * spacing;
            std::array::from_fn(|axis| start[axis] - back * self.front.axes[0][axis])
        });
        let grown = midpoints.iter().zip(&reached).filter(|it| *it.1);
        let near = before.chain(grown.map(|it| *it.0));
        GrownCrack {
            near: near.filter(|it| norm(minus(*it, tip)) < outer).collect(),
            tip,
            advance,
        }
    }

    /// The front of the crack along the midpoints of broken bonds; None where it is not straight within the ring, or other cracks are there.
    fn front_at(&self, crack: &GrownCrack, midpoints: &[[f64; 3]]) -> Option<CrackFront> {
        let [_, outer] = self.front.radii;
        if crack.advance == 0.0 {
            return Some(self.front);
        }
        let n = crack.near.len() as f64;
        let mean = [0, 1, 2].map(|axis| crack.near.iter().map(|it| it[axis]).sum::<f64>() / n);
        let of_place = |it: &[f64; 3]| {
            let [x, y, _] = minus(*it, mean);
            SymTensor::<2>::dyad([x, y], [x, y])
        };
        let spread = crack.near.iter().map(of_place);
        let spread = spread.fold(SymTensor::ZERO, |sum, it| sum.plus(&it));
        let [x, y] = spread.principal_direction();
        let from_mean = minus(crack.tip, mean);
        let sign = dot([x, y, 0.0], from_mean).signum();
        let growth = [sign * x, sign * y, 0.0];
        let normal = cross([0.0, 0.0, 1.0], growth);
        let off = |it: &[f64; 3]| dot(normal, minus(*it, mean)).abs();
        let mut within = midpoints
            .iter()
            .filter(|it| norm(minus(**it, crack.tip)) < outer);
        if within.any(|it| off(it) > self.horizon) {
            return None;
        }
        if (self.others.iter()).any(|side| distance_to(*side, crack.tip) < outer) {
            return None;
        }
        let along = dot(growth, from_mean);
        Some(CrackFront {
            place: std::array::from_fn(|axis| mean[axis] + along * growth[axis]),
            axes: [growth, normal, [0.0, 0.0, 1.0]],
            ..self.front
        })
    }
}

impl<const D: usize> BondSystem<D> {
    /// Integral around the tip of the crack that grew from a pre-crack, and the length of its growth, m; None where the ring leaves the
    /// body or its material, or the crack is not straight within it. Collective.
    pub(crate) fn at_growing_tip(
        &self,
        tip: &GrowingTip,
        intact: &[bool],
    ) -> (f64, Option<DomainIntegral>) {
        let cloud = &self.cloud;
        let ends = self.bonds.ends.iter().zip(&self.bonds.length).zip(intact);
        let broken = ends.filter(|((ends, length), intact)| {
            let spacing = ends.map(|it| cloud.spacing[it as usize]);
            !**intact
                && cloud.subdomain.owns_bond(**ends)
                && **length <= 0.5 * NEAREST * (spacing[0] + spacing[1])
        });
        let midpoint = |((ends, _), _): ((&[u32; 2], _), _)| {
            let [a, b] = ends.map(|it| in_space(cloud.positions[it as usize]));
            std::array::from_fn(|axis| 0.5 * (a[axis] + b[axis]))
        };
        let midpoints = cloud
            .subdomain
            .all_gather_list(broken.map(midpoint).collect());
        let crack = tip.crack(&midpoints);
        let integral = tip.front_at(&crack, &midpoints).and_then(|front| {
            let integral = DomainIntegral::new(cloud, &front, tip.quantity, tip.moduli)?;
            let area = cloud.subdomain.sum(integral.area());
            let leaves = |point: u32| cloud.shares(point as usize)[tip.material] < 1.0;
            let leaves = cloud.subdomain.any(integral.points().any(leaves));
            (front.is_filled(area) && !leaves).then_some(integral)
        });
        (crack.advance, integral)
    }
}
