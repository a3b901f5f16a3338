//! Energy release rate and stress intensity factors at the front of a crack, as integrals over a ring around it.
//!
//! With the stress sigma, the displacement u, the density W = sigma : eps/2, forces f per volume and a field q_k, by which the front would
//! advance, the energy release rate is (Li 1985, Shih 1986)
//!
//! J L = int (sigma_ij u_j,k - W delta_ik) q_k,i dV - int f_j u_j,k q_k dV,
//!
//! whatever q_k is that has the length L along the front, the integral of q, and vanishes far from it. Here q_k = q e_k in the direction of growth e
//! at the nearest place of the front. The weight q falls over a ring between the radii r_1 and r_2, q = (1 + cos(pi (r - r_1)/(r_2 -
//! r_1)))/2, and in space along the front as well, so that a sum over the points with their volumes is accurate. In the plane L is the
//! thickness. Around a circle e turns, so that q_k,i has the part t_k t_i q/rho with the tangent t of the front at the distance rho from the axis. Faces
//! without tractions have no part in J; tractions are among the forces on the points.
//!
//! The integral of the sum of two fields contains an interaction integral, bilinear in both. With an auxiliary field whose only stress intensity factor
//! is K_a = 1 ([`super::tip_field`]) it is 2 K_a K/E' for the modes I and II and K_a K/mu for the mode III, which gives each K separately (Yau 1980).
//! E' is E in plane stress and E/(1 - nu^2) in plane strain and in space.

use super::carried::StrainReading;
use super::crack_front::CrackFront;
use super::tip_field::{ElasticField, PlaneModuli, TipQuantity};
use crate::cloud::PointCloud;
use crate::grid::in_space;
use crate::layout::Layout;
use crate::system::BondSystem;
use crate::tensor::dot;

/// A point with a nonzero weight.
#[derive(Debug, Clone, PartialEq)]
struct WeightedPoint {
    point: u32,
    /// Volume over the length L, m^2.
    area: f64,
    /// Weight q times the area, m^2.
    weight: f64,
    /// Direction of growth e.
    direction: [f64; 3],
    /// Tangent t of the front.
    tangent: [f64; 3],
    /// Gradient of q times the area, m.
    gradient: [f64; 3],
    /// Weight q over rho times the area, m; 0 for a straight front.
    widening: f64,
    /// Auxiliary field; None for the energy release rate, which takes the field of the body twice.
    auxiliary: Option<ElasticField>,
}

/// An integral over a ring around the front of a crack.
#[derive(Debug, Clone, PartialEq)]
pub struct DomainIntegral {
    points: Vec<WeightedPoint>,
    /// 1/2; E'/2 or mu of a stress intensity factor.
    factor: f64,
}

impl DomainIntegral {
    /// The integral of a quantity over the owned points of a cloud; None for a stress intensity factor without the moduli of an isotropic
    /// material.
    pub fn new<const D: usize>(
        cloud: &PointCloud<D>,
        front: &CrackFront,
        quantity: TipQuantity,
        moduli: Option<PlaneModuli>,
    ) -> Option<Self> {
        let (factor, moduli) = match quantity {
            TipQuantity::EnergyRelease | TipQuantity::Advance => (0.5, None),
            TipQuantity::Opening | TipQuantity::Sliding => (0.5 * moduli?.young, moduli),
            TipQuantity::Tearing => (moduli?.shear(), moduli),
        };
        let weighted = |point: u32| {
            let at = front.sees(in_space(cloud.positions[point as usize]));
            let area = cloud.volumes[point as usize] / front.length;
            let auxiliary = moduli.map(|moduli| {
                let place = [at.distance, at.angle];
                let field = ElasticField::of_front(quantity, moduli, place, at.curvature);
                field.turned_from(at.axes)
            });
            (at.weight > 0.0 && at.distance > 0.0).then(|| WeightedPoint {
                point,
                area,
                weight: area * at.weight,
                direction: at.axes[0],
                tangent: at.axes[2],
                gradient: at.gradient.map(|it| area * it),
                widening: area * at.weight * at.curvature,
                auxiliary,
            })
        };
        Some(Self {
            points: cloud.subdomain.owned().filter_map(weighted).collect(),
            factor,
        })
    }

    /// Owned points with a weight.
    pub fn points(&self) -> impl ExactSizeIterator<Item = u32> {
        self.points.iter().map(|it| it.point)
    }

    /// Integral of the weight over the owned points over the length of the front, m^2.
    pub fn area(&self) -> f64 {
        self.points.iter().map(|it| it.weight).sum()
    }
}

impl WeightedPoint {
    /// Contribution of the point with two fields: (sigma^a_ij u^b_j,k + sigma^b_ij u^a_j,k - sigma^a : eps^b delta_ik) q_k,i, less the work of the
    /// forces.
    fn mutual(&self, [a, b]: [&ElasticField; 2]) -> f64 {
        let carried =
            a.work_of_traction(self.gradient, b.slope) + b.work_of_traction(self.gradient, a.slope);
        let density = a.work_in(b);
        let forces = dot(a.force, b.slope) + dot(b.force, a.slope);
        let straight =
            carried - density * dot(self.direction, self.gradient) - self.weight * forces;
        if self.widening == 0.0 {
            return straight;
        }
        let along = a.work_of_traction(self.tangent, b.slope_along)
            + b.work_of_traction(self.tangent, a.slope_along);
        straight + self.widening * (along - density)
    }
}

impl<const D: usize> BondSystem<D> {
    /// Value of an integral in a motion with forces of supports and loads on the points (n_degrees_of_freedom), N: the part of the owned points.
    pub(crate) fn domain_integral(
        &self,
        layout: Layout,
        integral: &DomainIntegral,
        reading: StrainReading<'_>,
        forces: &[f64],
    ) -> f64 {
        let part = |at: &WeightedPoint| {
            let first = layout.range(at.point).start;
            let volume = self.cloud.volumes[at.point as usize];
            let force: [f64; D] = std::array::from_fn(|axis| forces[first + axis] / volume);
            if at.gradient == [0.0; 3] && at.widening == 0.0 && force == [0.0; D] {
                return Some(0.0);
            }
            let fit = self.fit_of_motion(layout, reading.motion(), at.point);
            let transposed = fit.transposed_gradient()?;
            let strain = self.strain_by(layout, reading, at.point)?;
            let stress = self.stress_in(layout, reading, at.point, &strain)?;
            let derivative = |direction: [f64; 3]| {
                let along = |axis| {
                    (0..D)
                        .map(|it| transposed[(it, axis)] * direction[it])
                        .sum()
                };
                in_space::<D>(std::array::from_fn(along))
            };
            let field = ElasticField {
                stress: stress.resized(),
                strain: strain.resized(),
                slope: derivative(at.direction),
                slope_along: derivative(at.tangent),
                force: in_space(force),
            };
            let second = at.auxiliary.as_ref().unwrap_or(&field);
            Some(at.mutual([&field, second]))
        };
        let parts = integral
            .points
            .iter()
            .map(|it| part(it).unwrap_or(f64::NAN));
        integral.factor * parts.fold(0.0, |sum, part| sum + part)
    }
}

#[cfg(test)]
mod tests;
