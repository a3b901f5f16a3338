//! The sweeps of the axis correction over the families of the points.

use rayon::prelude::*;

use crate::bonds::BondSet;
use crate::cloud::PointCloud;
use crate::correction::members::{BLOCK, Members};
use crate::correction::sweeps::SweptFamilies;

/// The families of own points along the curve; `rank` is the place of a point in the order of the sweeps.
pub(super) struct Families<'a> {
    coefficients: Coefficients<'a>,
    /// Omega of each member.
    domain_factor: Vec<f64>,
    /// e_A of the continuum for a uniaxial strain of own points, by rank, J/m^3.
    target: Vec<f64>,
    /// e_A/etil_A along x, y and z of the points, by rank.
    ratios: Vec<[f64; 3]>,
    /// The ratios before the last sweep, by rank.
    before: Vec<[f64; 3]>,
}

/// What a sweep multiplies the factors with: the members of the families, and arrays over them.
struct Coefficients<'a> {
    members: Members<'a, 3>,
    /// a^2 and b^2; c^2 is what is left of 1.
    squares: Vec<[f64; 2]>,
    /// 1/4 V_B alpha l times k_n - k_t and times k_t, J/m^3: a strain along x has s^2 = a^4 and |gamma|^2 = a^2 - a^4.
    energy: Vec<[f64; 2]>,
}

impl<'a> Families<'a> {
    /// The families with all factors 1, from alpha l (k_n, k_t) of a bond and the energy densities e_A of the continuum (n_points).
    pub(super) fn new(
        bonds: &'a BondSet<3>,
        cloud: &'a PointCloud<3>,
        densities: impl Fn(usize) -> [f64; 2] + Sync,
        targets: &[f64],
    ) -> Self {
        let members = Members::new(bonds, cloud);
        let squares = members.values(|_, bond| {
            let [a, b, _] = bonds.direction[bond as usize];
            [a * a, b * b]
        });
        let energy = members.values(|point, bond| {
            let quarter = 0.25 * cloud.volumes[bonds.neighbour(bond, point) as usize];
            let [axial, shear] = densities(bond as usize);
            [quarter * (axial - shear), quarter * shear]
        });
        let coefficients = Coefficients {
            members,
            squares,
            energy,
        };
        let domain_factor = vec![1.0; coefficients.energy.len()];
        let own = coefficients.members.seats.own().iter();
        let target: Vec<f64> = own.map(|&point| targets[point as usize]).collect();
        let mut ratios = vec![[0.0; 3]; coefficients.members.seats.all().len()];
        let own = ratios.par_iter_mut().zip(&target).enumerate();
        own.for_each(|(rank, (ratios, &target))| {
            let factors = &domain_factor[coefficients.members.family(rank)];
            *ratios = coefficients.energy_ratios(rank, factors, target);
        });
        coefficients.members.seats.complete(&mut ratios);
        Self {
            coefficients,
            domain_factor,
            target,
            before: ratios.clone(),
            ratios,
        }
    }
}

impl SweptFamilies for Families<'_> {
    fn sweep(&mut self) -> f64 {
        std::mem::swap(&mut self.ratios, &mut self.before);
        let (coefficients, before, target) = (&self.coefficients, &self.before, &self.target);
        let changes: Vec<f64> = (
            coefficients.members.blocks(&mut self.domain_factor),
            self.ratios[..target.len()].par_chunks_mut(BLOCK),
        )
            .into_par_iter()
            .enumerate()
            .map(|(number, (mut factors, ratios))| {
                let mut change = 0.0;
                for (rank, ratio) in (number * BLOCK..).zip(ratios) {
                    let own;
                    (own, factors) = factors.split_at_mut(coefficients.members.family(rank).len());
                    change += coefficients.update(rank, before, own);
                    *ratio = coefficients.energy_ratios(rank, own, target[rank]);
                }
                change
            })
            .collect();
        let seats = &coefficients.members.seats;
        seats.complete(&mut self.ratios);
        // Every bond was met at either end.
        0.5 * seats.total(changes.iter().sum::<f64>())
    }

    fn n_bonds(&self) -> usize {
        self.coefficients.members.n_bonds()
    }

    fn largest_residual(&self) -> f64 {
        let ratios = self.ratios.as_flattened().iter();
        let residuals = ratios.map(|r| (1.0 / r - 1.0).abs());
        self.coefficients
            .members
            .largest(residuals.fold(0.0, f64::max))
    }

    fn into_domain_factors(self) -> Vec<f64> {
        self.coefficients.members.of_bonds(&self.domain_factor)
    }
}

impl Coefficients<'_> {
    /// The factors Omega of a family after a sweep, from the ratios of all points; gives the sum of |change of Omega|.
    ///
    /// With q = 2 p, the sum of the ratios of both ends, Omega/sqrt((a/p_x)^2 + (b/p_y)^2 + (c/p_z)^2) is
    /// Omega q_x q_y q_z/(2 sqrt((a q_y q_z)^2 + (b q_x q_z)^2 + (c q_x q_y)^2)).
    fn update(&self, rank: usize, ratios: &[[f64; 3]], factors: &mut [f64]) -> f64 {
        let (family, own) = (self.members.family(rank), ratios[rank]);
        let members = (self.members.neighbour[family.clone()].iter())
            .zip(&self.squares[family])
            .zip(factors);
        let mut change = 0.0;
        for ((&neighbour, &[aa, bb]), factor) in members {
            let other = ratios[neighbour as usize];
            let [x, y, z] = [0, 1, 2].map(|axis| own[axis] + other[axis]);
            let (yz, xz, xy) = (y * z, x * z, x * y);
            let squares = aa * (yz * yz) + bb * (xz * xz) + (1.0 - aa - bb) * (xy * xy);
            let updated = *factor * (0.5 * x * yz) / squares.sqrt();
            change += (updated - *factor).abs();
            *factor = updated;
        }
        change
    }

    /// e_A/etil_A along the axes of a point.
    fn energy_ratios(&self, rank: usize, factors: &[f64], target: f64) -> [f64; 3] {
        let family = self.members.family(rank);
        let members = self.squares[family.clone()]
            .iter()
            .zip(&self.energy[family])
            .zip(factors);
        let mut trial = [0.0; 3];
        for ((&[aa, bb], &[more, shear]), omega) in members {
            for (sum, square) in trial.iter_mut().zip([aa, bb, 1.0 - aa - bb]) {
                *sum += omega * (square * (shear + more * square));
            }
        }
        trial.map(|sum| target / sum)
    }
}
