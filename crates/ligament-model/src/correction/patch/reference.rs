//! Reference factors of the correction.

use rayon::prelude::*;

use crate::bonds::BondSet;
use crate::cloud::PointCloud;
use crate::correction::sweep_order::SweepOrder;

/// Number of sweeps over the points. On a block of tetrahedra graded four to one they leave 8 % of T_P/T - I as a root mean square, of 180 %
/// before, most of it at edges and corners; with four times as many the energy released by a crack in the block changes by less than 1 %.
const SWEEPS: usize = 10;

/// Largest change of a factor, and the reciprocal of the smallest: the family of a corner of a solid is an eighth of one inside.
const LARGEST: f64 = 8.0;

crate::case_type! {
    /// Reference factors, from which the patch correction departs as little as it can: alpha times one number for the body, which for `Families` is
    /// multiplied by a factor of each bond.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Reference {
        /// alpha times one number for the body.
        Body,
        /// alpha times factors with which a dilation has one stress at all points, also where the mesh is graded.
        Families,
    }
}

/// A symmetric tensor at a point.
type Tensor<const D: usize> = [[f64; D]; D];

/// Reference factors of the correction, but for one number for the body, shape (n_bonds), from factors alpha (n_bonds) and axial densities
/// k_n (n_bonds, N/m^6) of bonds as in a body of one material, which are computed only if needed.
///
/// Horizons follow the mesh. Where it is graded, families reach farther to one side than to the other, and with alpha alone they store more
/// or less energy of a uniform strain than the material does; the factors nearest to these reproduce the strain and keep the energy.
/// [`Reference::Families`] uses alpha g instead, with g nearest to 1 in the entropy g log g for which
///
/// T_P = sum over the bonds of P of alpha g k_n l V_J n n^T = T I
///
/// at every point P with neighbours J. T_P, in Pa, is twice the stress of the bonds at P under the dilation eps = I, and T the mean over the body
/// of a third (in the plane half) of its trace with g = 1, by volume. Then g = exp(n . (M_P + M_J) n/2) with a symmetric tensor M a point. Where the directions of a family are spread evenly
/// and both ends change alike, a change of M changes T_P/T by (2 M + I tr M)/(D + 2), by which each sweep goes on. The equations are this
/// project's own.
pub fn reference<const D: usize>(
    kind: Option<Reference>,
    bonds: &BondSet<D>,
    cloud: &PointCloud<D>,
    alpha: &[f64],
    axial: impl FnOnce() -> Vec<f64>,
) -> Vec<f64> {
    if kind.unwrap_or(Reference::of_dimension(D)) == Reference::Body {
        return alpha.to_vec();
    }
    let (order, axial) = (SweepOrder::new(bonds, cloud), axial());
    let families = Families {
        bonds,
        cloud,
        indices: order.indices(),
        weights: (0..bonds.len())
            .map(|bond| alpha[bond] * axial[bond] * bonds.length[bond])
            .collect(),
    };
    let mut tensors = vec![[[0.0; D]; D]; order.all().len()];
    let mean = families.mean_stress(&order, &tensors);
    for _ in 0..SWEEPS {
        let stresses = families.stresses(&order, &tensors);
        for (tensor, stress) in tensors.iter_mut().zip(stresses) {
            approach(tensor, stress.map(|row| row.map(|it| it / mean)));
        }
        let values = tensors.as_flattened_mut().as_flattened_mut();
        order.ghosts.update(values, D * D);
    }
    let factors = (0..bonds.len()).map(|bond| alpha[bond] * families.factor(bond, &tensors));
    factors.collect()
}

/// Changes M of a point such that T_P/T would become the unit tensor if all families were spread evenly.
fn approach<const D: usize>(tensor: &mut Tensor<D>, mut excess: Tensor<D>) {
    (0..D).for_each(|axis| excess[axis][axis] -= 1.0);
    let common = 0.5 * trace(&excess);
    for (tensor, excess) in tensor
        .as_flattened_mut()
        .iter_mut()
        .zip(excess.as_flattened())
    {
        *tensor -= 0.5 * (D as f64 + 2.0) * excess;
    }
    (0..D).for_each(|axis| tensor[axis][axis] += common);
}

struct Families<'a, const D: usize> {
    bonds: &'a BondSet<D>,
    cloud: &'a PointCloud<D>,
    /// Index of each point.
    indices: Vec<u32>,
    /// Products alpha k_n l of the bonds.
    weights: Vec<f64>,
}

impl Reference {
    /// The better choice by dimension. In space, where families grow with the third power of the horizon, a mesh graded four to one has 1.3
    /// times the energy of a uniform strain in the mean with one number for the body. In the plane it has 1.05 times at most, and stresses
    /// at holes, deflections and places of first breakage are more accurate with one number.
    const fn of_dimension(dimension: usize) -> Self {
        match dimension {
            3 => Self::Families,
            _ => Self::Body,
        }
    }
}

impl<const D: usize> Families<'_, D> {
    /// Mean T for tensors M by index, Pa.
    fn mean_stress(&self, order: &SweepOrder<'_>, tensors: &[Tensor<D>]) -> f64 {
        let mut sums = [0.0; 2];
        for (&point, stress) in order.owned().iter().zip(self.stresses(order, tensors)) {
            let volume = self.cloud.volumes[point as usize];
            sums[0] += volume * trace(&stress) / D as f64;
            sums[1] += volume;
        }
        order.subdomain.all_reduce_sum(&mut sums);
        sums[0] / sums[1]
    }

    /// Tensors T_P of the owned points, by index, for tensors M by index, Pa.
    fn stresses(&self, order: &SweepOrder<'_>, tensors: &[Tensor<D>]) -> Vec<Tensor<D>> {
        let own = order.owned().par_iter();
        own.map(|&point| self.stress(point, tensors)).collect()
    }

    fn stress(&self, point: u32, tensors: &[Tensor<D>]) -> Tensor<D> {
        let mut stress = [[0.0; D]; D];
        for &bond in self.bonds.incidence.at(point) {
            let volume = self.cloud.volumes[self.bonds.neighbour(bond, point) as usize];
            let bond = bond as usize;
            let size = self.factor(bond, tensors) * self.weights[bond] * volume;
            let direction = self.bonds.direction[bond];
            for (row, one) in stress.iter_mut().zip(direction) {
                for (entry, other) in row.iter_mut().zip(direction) {
                    *entry += size * one * other;
                }
            }
        }
        stress
    }

    /// Factor g of a bond.
    fn factor(&self, bond: usize, tensors: &[Tensor<D>]) -> f64 {
        let direction = &self.bonds.direction[bond];
        let [one, other] = self.bonds.ends[bond].map(|end| {
            let index = self.indices[end as usize] as usize;
            along(direction, &tensors[index])
        });
        (0.5 * (one + other)).exp().clamp(1.0 / LARGEST, LARGEST)
    }
}

/// Product n . M n.
fn along<const D: usize>(direction: &[f64; D], tensor: &Tensor<D>) -> f64 {
    let of_row = |(one, row): (&f64, &[f64; D])| {
        let products = row
            .iter()
            .zip(direction)
            .map(|(entry, other)| entry * other);
        one * products.sum::<f64>()
    };
    direction.iter().zip(tensor).map(of_row).sum()
}

fn trace<const D: usize>(tensor: &Tensor<D>) -> f64 {
    (0..D).map(|axis| tensor[axis][axis]).sum()
}
