//! Bonds whose ends a stiffer material restrains: their loss of k_t and gain of k_n.
//!
//! A point rotates with the stiffest of its materials. In a layer sheared by gamma between stiff parts the ends of bonds miss a share beta of
//! the rotation gamma/2 of the layer, in the mean over both ends, and a bond straight across has the shear gamma instead of gamma/2. With
//!
//! k_t' = (1 - d) k_t, k_theta' = (1 - d) k_theta, k_n' = k_n + g k_t, d = 3 x beta/(1 + 3 beta), g = eta d
//!
//! the layer has the stiffness that it would have if its points turned with it. In D dimensions with the cosine c of a bond to the normal
//! of the layer, the sums over bonds of weight w, and t^2 = (1 - c^2)/(D - 1), it has so
//!
//! - pulled, where eta sum w d c^4 = sum w d (c^2 - c^4),
//! - sheared, where sum w d (c^2 (1 + beta)/2 - (1 + eta) c^2 t^2) = sum w beta c^2/2: the right side is what the missing rotation adds to the
//!   force, the left one what the bonds give up.
//!
//! Bonds in all directions give x = 1, eta = (D - 1)/3. Few bonds have particular directions: x and eta of an end follow from the sums over the
//! bonds of the points in its family. A bond has the means over its ends, in proportion to their restraints. The weight Omega alpha
//! V_A V_B l abs(k_t) phi/kappa^2 is that of the energy under a given traction, of a bond with the fraction phi of its length in the layer
//! and k_t over that of the stiffest material kappa. The normal of a point is the gradient of 3 beta/(1 + 3 beta) of its bonds over the
//! ends of these, by least squares. The equations are this project's own.

use nalgebra::{SMatrix, SVector};

use super::BondStiffness;
use super::restraint::{Exchange, Restraint};
use crate::bonds::BondSet;
use crate::cloud::PointCloud;

/// Largest x: a restrained bond keeps 0.025 of its k_t.
const LARGEST_LOSS: f64 = 1.3;

/// Part of the trace of the spread of a family that is added to it, so that families along a line have a normal.
const SPREAD: f64 = 0.02;

/// Sums over the bonds of a point, with the loss d for x = 1.
#[derive(Debug, Clone, Copy, Default)]
struct Sums {
    /// Sum w d c^4.
    along: f64,
    /// Sum w d (c^2 - c^4), which is D - 1 times the sum w d c^2 t^2.
    across: f64,
    /// Sum w d c^2 (1 + beta)/2.
    turned: f64,
    /// Sum w beta c^2/2.
    missing: f64,
}

impl Sums {
    /// The terms of a bond of weight w with the cosine c.
    fn from_bond(weight: f64, cosine: f64, restraint: &Restraint) -> Self {
        let (beta, square) = (restraint.mean(), cosine * cosine);
        let lost = weight * restraint.usual_loss();
        Self {
            along: lost * square * square,
            across: lost * (square - square * square),
            turned: 0.5 * lost * square * (1.0 + beta),
            missing: 0.5 * weight * beta * square,
        }
    }

    fn plus(self, other: Self) -> Self {
        Self {
            along: self.along + other.along,
            across: self.across + other.across,
            turned: self.turned + other.turned,
            missing: self.missing + other.missing,
        }
    }

    /// Factors x of the loss, at most [`LARGEST_LOSS`], and x eta of the gain, with eta at most three times the value for bonds in all directions.
    fn balance<const D: usize>(self) -> [f64; 2] {
        let tangents = D as f64 - 1.0;
        if self.along == 0.0 {
            return [1.0, tangents / 3.0];
        }
        let eta = (self.across / self.along).min(tangents);
        let given_up = self.turned - (1.0 + eta) * self.across / tangents;
        let x = if self.missing < LARGEST_LOSS * given_up {
            self.missing / given_up
        } else {
            LARGEST_LOSS
        };
        [x, x * eta]
    }
}

impl BondStiffness {
    /// The densities with the exchanges of the restrained bonds between points with rotations. The directions of the bonds determine x and
    /// eta where a uniform strain is an equilibrium with the factors alpha and Omega (n_bonds) of the correction, `balanced`; without such
    /// a correction they have the values for bonds in all directions, since the sums assume its uniform strains to be right.
    pub fn exchanged<const D: usize>(
        mut self,
        bonds: &BondSet<D>,
        cloud: &PointCloud<D>,
        balanced: Option<[&[f64]; 2]>,
    ) -> Self {
        if self.held.is_empty() {
            return self;
        }
        let factors = match balanced {
            Some(correction) => Layers {
                stiffness: &self,
                correction,
                bonds,
                cloud,
            }
            .factors(),
            None => vec![[1.0, (D as f64 - 1.0) / 3.0]; cloud.len()],
        };
        let of_bond = |(restraint, ends): (&Restraint, &[u32; 2])| {
            if restraint.ends == [0.0; 2] {
                return Exchange {
                    lost: 0.0,
                    gained: 0.0,
                };
            }
            let [lost, gained] = [0, 1].map(|k| {
                let of_end = |end: usize| restraint.share(end) * factors[ends[end] as usize][k];
                restraint.usual_loss() * (of_end(0) + of_end(1))
            });
            Exchange { lost, gained }
        };
        self.exchange = self.held.iter().zip(&*bonds.ends).map(of_bond).collect();
        self
    }
}

/// Layers of a body whose bonds have stiffness densities.
struct Layers<'a, const D: usize> {
    stiffness: &'a BondStiffness,
    /// Factors alpha and Omega, shape (n_bonds).
    correction: [&'a [f64]; 2],
    bonds: &'a BondSet<D>,
    cloud: &'a PointCloud<D>,
}

impl<const D: usize> Layers<'_, D> {
    /// Factors x of the loss and x eta of the gain at the points, shape (n_points).
    fn factors(&self) -> Vec<[f64; 2]> {
        let of_points = self.cloud.over_families(|point| {
            let Sums {
                along,
                across,
                turned,
                missing,
            } = self.sums(point);
            [along, across, turned, missing]
        });
        let sums = |point: u32| {
            let [along, across, turned, missing] = of_points[point as usize];
            Sums {
                along,
                across,
                turned,
                missing,
            }
        };
        self.cloud.over_families(|point| {
            let family = self.bonds.incidence.at(point).iter();
            let others = family.map(|&bond| sums(self.bonds.neighbour(bond, point)));
            others.fold(sums(point), Sums::plus).balance::<D>()
        })
    }

    /// Place of a point among the ends of a bond.
    fn end(&self, bond: usize, point: u32) -> usize {
        usize::from(self.bonds.ends[bond][1] == point)
    }

    /// Vector along a bond away from a point, m.
    fn away(&self, bond: usize, point: u32) -> SVector<f64, D> {
        let sign = [1.0, -1.0][self.end(bond, point)];
        SVector::from(self.bonds.direction[bond]) * (sign * self.bonds.length[bond])
    }

    /// Sums over the bonds of a point that a stiffer material at the point restrains.
    fn sums(&self, point: u32) -> Sums {
        let held = &self.stiffness.held;
        let restrains = |&bond: &usize| held[bond].ends[self.end(bond, point)] > 0.0;
        let own = self.bonds.incidence.at(point).iter();
        let restrained: Vec<usize> = own.map(|&it| it as usize).filter(restrains).collect();
        if restrained.is_empty() {
            return Sums::default();
        }
        let normal = self.normal(point);
        let of_bond = |bond: usize| {
            let cosine = normal.dot(&SVector::from(self.bonds.direction[bond]));
            let weight = self.weight(bond) * held[bond].share(self.end(bond, point));
            Sums::from_bond(weight, cosine, &held[bond])
        };
        restrained
            .into_iter()
            .map(of_bond)
            .fold(Sums::default(), Sums::plus)
    }

    /// Weight w of a restrained bond.
    fn weight(&self, bond: usize) -> f64 {
        let stiffness = self.stiffness;
        let shear = stiffness.shear[bond].abs();
        if shear == 0.0 {
            return 0.0;
        }
        let [a, b] = self.bonds.ends[bond].map(|end| self.cloud.volumes[end as usize]);
        let [alpha, omega] = self.correction.map(|factors| factors[bond]);
        let in_layer = stiffness
            .series
            .get(bond)
            .map_or(1.0, |series| 1.0 / series);
        let rigidity = alpha * omega * a * b * self.bonds.length[bond] * shear;
        rigidity * in_layer / stiffness.held[bond].softness.powi(2)
    }

    /// Normal of a layer at a point; zero where the restraint of the bonds has no gradient.
    fn normal(&self, point: u32) -> SVector<f64, D> {
        let (mut volume, mut loss) = (0.0, 0.0);
        let [mut place, mut moment] = [SVector::<f64, D>::zeros(); 2];
        let mut spread = SMatrix::<f64, D, D>::zeros();
        for &bond in self.bonds.incidence.at(point) {
            let other = self.bonds.neighbour(bond, point);
            let (bond, weight) = (bond as usize, self.cloud.volumes[other as usize]);
            let away = self.away(bond, point);
            volume += weight;
            place += weight * away;
            spread += weight * away * away.transpose();
            let restraint = self.stiffness.held[bond];
            if restraint.ends[self.end(bond, point)] > 0.0 {
                loss += weight * restraint.usual_loss();
                moment += weight * restraint.usual_loss() * away;
            }
        }
        spread -= place * place.transpose() / volume;
        let slack = SPREAD * spread.trace();
        let gradient = (spread + SMatrix::identity() * slack)
            .cholesky()
            .map(|factor| factor.solve(&(moment - place * (loss / volume))));
        gradient
            .and_then(|it| it.try_normalize(0.0))
            .unwrap_or_else(SVector::zeros)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Restraint of a bond between ends that do not turn.
    const FULL: Restraint = Restraint {
        ends: [1.0; 2],
        softness: 1.0,
    };

    /// Factors x and x eta of bonds of equal weights in a layer across x.
    fn factors<const D: usize>(directions: &[[f64; D]], restraint: &Restraint) -> [f64; 2] {
        let terms = directions
            .iter()
            .map(|n| Sums::from_bond(1.0, n[0], restraint));
        terms.fold(Sums::default(), Sums::plus).balance::<D>()
    }

    /// Forces across x, pulled and sheared along y by one, of bonds whose ends miss a share of the rotation, relative to bonds whose ends do
    /// not: with unit k_n and k_t/2.
    fn forces(directions: &[[f64; 2]], missing: f64, [lost, gained]: [f64; 2]) -> [f64; 2] {
        let (axial, shear) = (1.0 + 0.5 * gained, 0.5 * (1.0 - lost));
        let sums = directions.iter().map(|&[c, s]| {
            let across = 0.5 * (c * c - s * s) + 0.5 * missing;
            [
                c * (axial * c * c * c + shear * s * s * c),
                c * (axial * c * s * s + shear * across * c),
            ]
        });
        sums.fold([0.0; 2], |sum, it| [sum[0] + it[0], sum[1] + it[1]])
    }

    /// Bonds in all directions: twelve around the circle and the corners of an icosahedron, whose means of fourth powers are those of all
    /// directions, whatever their restraint.
    #[test]
    fn bonds_in_all_directions_have_the_usual_exchange() {
        let circle = (0..12).map(|k| f64::from(k) * std::f64::consts::PI / 6.0);
        let circle: Vec<[f64; 2]> = circle.map(|it| [it.cos(), it.sin()]).collect();
        let golden = 0.5 * (1.0 + 5.0_f64.sqrt());
        let size = golden.hypot(1.0);
        let [a, b] = [1.0 / size, golden / size];
        let corners = [[a, b], [a, -b], [-a, b], [-a, -b]];
        let corners: Vec<[f64; 3]> = (corners.into_iter())
            .flat_map(|[a, b]| [[0.0, a, b], [a, b, 0.0], [b, 0.0, a]])
            .collect();
        let half = Restraint {
            ends: [0.0, 1.0],
            ..FULL
        };
        for restraint in [FULL, half] {
            let found = [
                (factors(&circle, &restraint), 1.0 / 3.0),
                (factors(&corners, &restraint), 2.0 / 3.0),
            ];
            for ([x, gain], eta) in found {
                assert!((x - 1.0).abs() < 1e-12, "{x}");
                assert!((gain - eta).abs() < 1e-12, "{gain}");
            }
        }
    }

    /// Bonds across one cell of a lattice, with a horizon of three: the layer has the forces of one that turns. As bonds in all directions
    /// it would be 3 % too stiff where it is pulled, and 8 % too soft where it is sheared.
    #[test]
    fn few_directions_carry_what_a_layer_that_turns_carries() {
        let places = (1..=3).flat_map(|x| (-2..=2).map(move |y| [f64::from(x), f64::from(y)]));
        let near = places.filter(|[x, y]| x.hypot(*y) <= 3.0);
        // As many bonds of a kind cross the cell as they have cells along x.
        let crossing = near.flat_map(|[x, y]| {
            let [c, s] = [x, y].map(|it| it / x.hypot(y));
            std::iter::repeat_n([c, s], x as usize)
        });
        let crossing: Vec<[f64; 2]> = crossing.collect();
        let turning = forces(&crossing, 0.0, [0.0; 2]);
        for missing in [1.0, 0.5] {
            let restraint = Restraint {
                ends: [missing; 2],
                ..FULL
            };
            let usual = restraint.usual_loss();
            let exchange = factors(&crossing, &restraint).map(|it| usual * it);
            let found = forces(&crossing, missing, exchange);
            for (found, expected) in found.into_iter().zip(turning) {
                assert!((found / expected - 1.0).abs() < 1e-12, "{found} {expected}");
            }
        }
        let as_all = forces(&crossing, 1.0, [0.75, 0.25]);
        let errors = [as_all[0] / turning[0] - 1.0, as_all[1] / turning[1] - 1.0];
        assert!(errors[0] > 0.03 && errors[1] < -0.078, "{errors:?}");
    }

    /// Where all bonds are straight across, they keep half of k_t; where too many are oblique, as little as a bond may.
    #[test]
    fn straight_and_oblique_bonds() {
        let [x, gain] = factors(&[[1.0, 0.0]], &FULL);
        assert!((0.75 * x - 0.5).abs() < 1e-12 && gain == 0.0, "{x} {gain}");
        let oblique = [0.5, 0.75_f64.sqrt()];
        assert_eq!(factors(&[oblique], &FULL), [LARGEST_LOSS; 2]);
    }
}
