//! Reference factors of the correction.

use super::lines::Lines;
use super::settings::Reference;
use crate::bonds::BondSet;
use crate::cloud::PointCloud;
use crate::correction::sweep_order::SweepOrder;
use crate::horizon::Horizons;
use crate::parallel;

/// Number of sweeps over the points. On a block of tetrahedra graded four to one they leave 8 % of T_P/T - I as a root mean square, of 180 %
/// before, most of it at edges and corners; with four times as many the energy released by a crack in the block changes by less than 1 %.
const SWEEPS: usize = 10;

/// Largest change of a factor, and the reciprocal of the smallest: the family of a corner of a solid is an eighth of one inside.
const LARGEST: f64 = 8.0;

/// A symmetric tensor at a point.
type Tensor<const D: usize> = [[f64; D]; D];

/// Reference factors of the correction, but for one number for the body, shape (n_bonds), from factors alpha (n_bonds) and axial densities
/// k_n (n_bonds, N/m^6) of bonds as in a body of one material, which are computed only if needed; collective.
///
/// Horizons follow the mesh. Where it is graded, families reach farther to one side than to the other, and with alpha alone they store more
/// or less energy of a uniform strain than the material does; the factors nearest to these reproduce the strain and keep the energy.
/// [`Reference::Families`] uses alpha g instead, with g nearest to 1 in the entropy g log g for which
///
/// T_P V_P = sum over the bonds of s_P alpha g k_n l V_A V_B n n^T = T V_P I
///
/// at every point P. The stress of a bond acts along its whole length: s_P is the share of the bond that lies nearest to P. T_P, in Pa, is the
/// stress at P under the dilation eps = I, and T the mean over the body of a third (in the plane half) of its trace with g = 1, by volume.
/// Then g = exp(n . M n), with a symmetric tensor M_P a point and its mean along the bond, M = sum over the points of s_P M_P. Where the
/// directions of the bonds at P are spread evenly and M is uniform, a change of M changes T_P/T by (2 M + I tr M)/(D + 2), by which each
/// sweep goes on. The equations are this project's own.
pub fn reference<const D: usize>(
    kind: Reference,
    bonds: &BondSet<D>,
    cloud: &PointCloud<D>,
    horizons: &Horizons,
    alpha: &[f64],
    axial: impl FnOnce() -> Vec<f64>,
) -> Vec<f64> {
    if kind == Reference::Body {
        return alpha.to_vec();
    }
    let (order, axial) = (SweepOrder::new(bonds, cloud), axial());
    let volume = |&point: &u32| cloud.volumes[point as usize];
    let weight = |bond: usize| {
        let [a, b] = bonds.ends[bond].map(|end| volume(&end));
        alpha[bond] * axial[bond] * bonds.length[bond] * a * b
    };
    let families = Families {
        bonds,
        lines: Lines::new(bonds, cloud, horizons, &order),
        weights: (0..bonds.len()).map(weight).collect(),
        volumes: order.owned().iter().map(volume).collect(),
        order,
    };
    let mean = families.mean_stress();
    let mut tensors = vec![[[0.0; D]; D]; families.order.all().len()];
    for _ in 0..SWEEPS {
        let stresses = families.stresses(&families.factors(&tensors));
        for (tensor, stress) in tensors.iter_mut().zip(stresses) {
            approach(tensor, stress.map(|row| row.map(|it| it / mean)));
        }
        let values = tensors.as_flattened_mut().as_flattened_mut();
        families.order.ghosts.update(values, D * D);
    }
    let factors = families.with_bonds_of_other_ranks(families.factors(&tensors));
    let products = alpha.iter().zip(factors);
    products.map(|(alpha, factor)| alpha * factor).collect()
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
    order: SweepOrder<'a>,
    lines: Lines,
    /// Products alpha k_n l V_A V_B of the bonds.
    weights: Vec<f64>,
    /// Volumes of the owned points, by index.
    volumes: Vec<f64>,
}

impl<const D: usize> Families<'_, D> {
    /// Mean T without factors, Pa.
    fn mean_stress(&self) -> f64 {
        let divided =
            (0..self.bonds.len()).filter(|&bond| !self.lines.shares_of_bond(bond).is_empty());
        let mut sums = [
            divided.map(|bond| self.weights[bond]).sum::<f64>(),
            D as f64 * self.volumes.iter().sum::<f64>(),
        ];
        self.order.subdomain.all_reduce_sum(&mut sums);
        sums[0] / sums[1]
    }

    /// Tensors T_P of the owned points, by index, for factors g (n_bonds), Pa.
    fn stresses(&self, factors: &[f64]) -> Vec<Tensor<D>> {
        let sums = self.lines.sums(&self.order, |bond| {
            let size = factors[bond] * self.weights[bond];
            let direction = self.bonds.direction[bond];
            direction.map(|one| direction.map(|other| size * one * other))
        });
        let own = sums.into_iter().zip(&self.volumes);
        own.map(|(sum, volume)| sum.map(|row| row.map(|it| it / volume)))
            .collect()
    }

    /// Factors g for tensors M by index, shape (n_bonds); 1 of bonds that another process divides.
    fn factors(&self, tensors: &[Tensor<D>]) -> Vec<f64> {
        let of_bond = |bond: usize| {
            let direction = &self.bonds.direction[bond];
            let shares = self.lines.shares_of_bond(bond).iter();
            let terms = shares.map(|it| it.share * along(direction, &tensors[it.index as usize]));
            terms.sum::<f64>().exp().clamp(1.0 / LARGEST, LARGEST)
        };
        parallel::values(self.bonds.len(), 0.0, of_bond)
    }

    /// The factors (n_bonds) with those that other processes compute; collective.
    fn with_bonds_of_other_ranks(&self, mut factors: Vec<f64>) -> Vec<f64> {
        let subdomain = self.order.subdomain;
        let across = self
            .bonds
            .ends
            .iter()
            .enumerate()
            .filter_map(|(bond, ends)| {
                let is_divided = !self.lines.shares_of_bond(bond).is_empty();
                let other = ends
                    .iter()
                    .find(|&&end| is_divided && !subdomain.owns(end))?;
                let [a, b] = subdomain.numbers(*ends).map(f64::from);
                Some((subdomain.rank(*other), [a, b, factors[bond]]))
            });
        for [a, b, factor] in subdomain.send(across.collect()) {
            let ends = [a, b].map(|end| subdomain.point(end as u32));
            let bond = (self.bonds.ends).binary_search_by(|it| it.map(Some).cmp(&ends));
            bond.into_iter().for_each(|bond| factors[bond] = factor);
        }
        factors
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
