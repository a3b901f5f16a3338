//! Shares of the points in the bonds that pass by them, and energies of the points by these shares.

use crate::bonds::{BondSet, Incidence};
use crate::cloud::PointCloud;
use crate::correction::Correction;
use crate::correction::domain::{MOST_MODES, energy_density, ratios};
use crate::correction::strain_mode::StrainMode;
use crate::correction::sweep_order::SweepOrder;
use crate::fixed::EnergyRatio;
use crate::horizon::Horizons;
use crate::law::BondStiffness;
use crate::material::Stiffness;
use crate::parallel;
use crate::tensor::{dot, minus};

/// The part of a bond that lies nearer to a point than to any other, over the length of the bond.
#[derive(Debug, Clone, Copy)]
pub(super) struct Share {
    bond: u32,
    /// Index of the point.
    pub(super) index: u32,
    pub(super) share: f64,
}

/// Shares of the points in the bonds: each bond is divided at the borders of the points' Voronoi cells. The shares of a bond sum to one.
///
/// Only the ends and the points bonded to the end with the larger horizon have shares, so none beyond a void or a pre-crack. The process
/// that owns this end knows them all.
pub(super) struct Lines {
    /// Shares in the order of the bonds, and from A to B.
    shares: Vec<Share>,
    /// First share of each bond, and the number of all shares at the end, shape (n_bonds + 1).
    starts: Vec<usize>,
    /// Numbers of the shares of each point, ascending, by index.
    of_points: Incidence,
}

impl Lines {
    /// Shares of the bonds whose end with the larger horizon is an owned point; other bonds have none.
    pub(super) fn new<const D: usize>(
        bonds: &BondSet<D>,
        cloud: &PointCloud<D>,
        horizons: &Horizons,
        order: &SweepOrder<'_>,
    ) -> Self {
        let indices = order.indices();
        let of_bond = |bond: usize| -> Vec<Share> {
            let [a, b] = bonds.ends[bond];
            let [of_a, of_b] = [a, b].map(|end| horizons.radius[end as usize]);
            let wider = if of_a < of_b { b } else { a };
            if !order.subdomain.owns(wider) {
                return Vec::new();
            }
            let shares = divided(bond, wider, bonds, cloud).into_iter();
            let of_point = |(point, share)| Share {
                bond: bond as u32,
                index: indices[point as usize],
                share,
            };
            shares.map(of_point).collect()
        };
        let of_bonds = parallel::values(bonds.len(), Vec::new(), of_bond);
        let mut starts = vec![0];
        for shares in &of_bonds {
            starts.push(starts[starts.len() - 1] + shares.len());
        }
        let shares: Vec<Share> = of_bonds.into_iter().flatten().collect();
        let numbered = (0..).zip(&shares).map(|(number, it)| (it.index, number));
        Self {
            of_points: Incidence::from_pairs(numbered, order.all().len()),
            starts,
            shares,
        }
    }

    /// Shares of a bond, from A to B.
    pub(super) fn shares_of_bond(&self, bond: usize) -> &[Share] {
        &self.shares[self.starts[bond]..self.starts[bond + 1]]
    }

    /// Sums over the bonds of the shares of each owned point times a value of the bond, by index; collective.
    pub(super) fn sums<const M: usize, const N: usize>(
        &self,
        order: &SweepOrder<'_>,
        value: impl Fn(usize) -> [[f64; M]; N] + Sync,
    ) -> Vec<[[f64; M]; N]> {
        let of_index = |index: usize| {
            let mut sum = [[0.0; M]; N];
            for &number in self.of_points.at(index as u32) {
                let Share { bond, share, .. } = self.shares[number as usize];
                let value = value(bond as usize);
                for (sum, value) in sum.as_flattened_mut().iter_mut().zip(value.as_flattened()) {
                    *sum += share * value;
                }
            }
            sum
        };
        let mut sums = parallel::values(order.all().len(), [[0.0; M]; N], of_index);
        let values = sums.as_flattened_mut().as_flattened_mut();
        order.ghosts.add_to_owners(values, M * N);
        sums.truncate(order.owned().len());
        sums
    }
}

/// Points with their shares of a bond, from A to B, among the ends and the points bonded to the end `wider`.
///
/// At a distance x from A along the bond, the squared distance of a point P is |P - A|^2 - 2 x n . (P - A) + x^2: which point is nearest is a
/// matter of straight lines. The points that can be are in the sphere whose diameter is the bond.
fn divided<const D: usize>(
    bond: usize,
    wider: u32,
    bonds: &BondSet<D>,
    cloud: &PointCloud<D>,
) -> Vec<(u32, f64)> {
    let [a, b] = bonds.ends[bond];
    let length = bonds.length[bond];
    let at = |point: u32| {
        let from_a = minus(cloud.positions[point as usize], cloud.positions[a as usize]);
        let along = dot(from_a, bonds.direction[bond]);
        (point, along, dot(from_a, from_a))
    };
    let family = bonds.incidence.at(wider).iter();
    let members = family.map(|&it| at(bonds.neighbour(it, wider)));
    let is_inside = |&(_, along, square): &(u32, f64, f64)| square < length * along;
    let mut candidates: Vec<_> = members.filter(is_inside).collect();
    candidates.push((b, length, length * length));
    let (mut nearest, mut from, mut shares) = ((a, 0.0, 0.0), 0.0, Vec::new());
    loop {
        let (point, along, square) = nearest;
        candidates.retain(|other| other.1 > along);
        let border = |other: &(u32, f64, f64)| 0.5 * (other.2 - square) / (other.1 - along);
        let next = (candidates.iter()).min_by(|one, other| border(one).total_cmp(&border(other)));
        let to = next.map_or(length, |next| border(next).max(from));
        if to > from {
            shares.push((point, (to - from) / length));
        }
        let Some(&next) = next else {
            return shares;
        };
        (nearest, from) = (next, to);
    }
}

/// Ratio of the strain energy density of every point to the density of the continuum, for each of [`StrainMode::all`], with the energy of a bond
/// divided among the points along its line; collective.
///
/// e_P V_P = 1/2 sum over the bonds of s_P Omega alpha (k_n s^2 + k_t |gamma|^2) l V_A V_B, with the share s_P of a bond that lies nearest to
/// P. The stress of a bond acts along its whole length: halves at its ends would show twice the energy at an outline, whose long bonds carry
/// the traction, where the body has none.
pub fn energy_ratios<const D: usize>(
    bonds: &BondSet<D>,
    cloud: &PointCloud<D>,
    horizons: &Horizons,
    stiffness: &BondStiffness,
    correction: &Correction,
    continuum: &[Stiffness],
) -> Vec<EnergyRatio> {
    let modes = StrainMode::<D>::all();
    let order = SweepOrder::new(bonds, cloud);
    let lines = Lines::new(bonds, cloud, horizons, &order);
    let energies = lines.sums(&order, |bond| {
        let [a, b] = bonds.ends[bond].map(|end| cloud.volumes[end as usize]);
        let size = 0.5 * correction.domain_factor[bond] * a * b;
        let mut energies = [0.0; MOST_MODES];
        for (energy, mode) in energies.iter_mut().zip(&modes) {
            *energy =
                size * energy_density(mode, bond, bonds, stiffness, &correction.length_factor);
        }
        [energies]
    });
    ratios(&modes, cloud, continuum, |place| {
        let own = order.owned().iter().zip(&energies);
        let densities =
            own.map(|(&point, [energies])| energies[place] / cloud.volumes[point as usize]);
        order.of_points(&densities.collect::<Vec<_>>())
    })
}
