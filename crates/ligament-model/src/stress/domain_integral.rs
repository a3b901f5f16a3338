//! Energy release rate and stress intensity factors at the tip of a straight crack in the plane, as integrals over a ring around it.
//!
//! With the stress sigma, the displacement u, the density W = sigma : eps/2, the direction 1 in which the crack would grow and forces f per
//! area, the energy release rate is (Li 1985)
//!
//! J = int (sigma_ij u_i,1 - W delta_1j) q,j dA - int f_i u_i,1 q dA,
//!
//! whatever the weight q is that falls from 1 near the tip to 0. Here it falls over a ring between the radii r_1 and r_2,
//! q = (1 + cos(pi (r - r_1)/(r_2 - r_1)))/2, so that a sum over the points with their areas V/t is accurate. Faces without tractions have no
//! part in it; tractions are among the forces on the points.
//!
//! The same integral of the sum of two fields has a part with both of them. With the field of a tip whose only intensity is K_a = 1 as the
//! second one (Williams 1957), its part is 2 K_a K/E', by which each of K_I and K_II is found alone (Yau 1980). E' is E in
//! plane stress and E/(1 - nu^2) in plane strain.

use std::f64::consts::PI;

use super::carried::StrainReading;
use crate::cloud::PointCloud;
use crate::layout::Layout;
use crate::material::Stiffness;
use crate::system::BondSystem;
use crate::tensor::{SymTensor, dot, minus, norm};

/// Relative difference of moduli up to which a material counts as isotropic.
const ISOTROPIC: f64 = 1e-9;

/// Distance from the line of a crack over that from its tip up to which a point is on the line.
const ON_LINE: f64 = 1e-9;

/// Quantity at the tip of a crack.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TipQuantity {
    /// Energy release rate J.
    EnergyRelease,
    /// Stress intensity factor K_I of opening.
    Opening,
    /// Stress intensity factor K_II of sliding in the plane.
    Sliding,
}

impl TipQuantity {
    /// All quantities.
    pub const ALL: [Self; 3] = [Self::EnergyRelease, Self::Opening, Self::Sliding];

    /// Symbol, the keyword in case files, and meaning.
    pub const fn symbol(self) -> [&'static str; 2] {
        match self {
            Self::EnergyRelease => ["J", "Energy release rate, J/m^2."],
            Self::Opening => ["K_I", "Stress intensity factor of opening, Pa m^0.5."],
            Self::Sliding => [
                "K_II",
                "Stress intensity factor of sliding, Pa m^0.5: positive where the left side of the crack, seen towards its tip, slides towards the tip.",
            ],
        }
    }

    /// SI unit.
    pub fn unit(self) -> &'static str {
        match self {
            Self::EnergyRelease => "J/m^2",
            Self::Opening | Self::Sliding => "Pa m^0.5",
        }
    }
}

#[cfg(feature = "case")]
crate::worded_by_table! { TipQuantity: TipQuantity::ALL, TipQuantity::ALL.into_iter(), it => it.symbol() }

/// Ring around the tip of a crack.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ring {
    /// Tip in the coordinates of the cloud, m.
    pub tip: [f64; 2],
    /// Unit vector in which the crack would grow.
    pub direction: [f64; 2],
    /// Side of points on the line of the crack, seen in this direction: 1 the left one, -1 the right one.
    pub side: f64,
    /// Radii between which the weight falls, m.
    pub radii: [f64; 2],
}

impl Ring {
    /// Angle of a place seen from the tip, from -pi to pi: 0 ahead of it, and of the sign of their side for points on the crack.
    fn angle(&self, from_tip: [f64; 2]) -> f64 {
        let [x, y] = self.direction;
        let (along, across) = (dot([x, y], from_tip), dot([-y, x], from_tip));
        if across.abs() <= ON_LINE * along.abs() {
            return if along > 0.0 { 0.0 } else { self.side * PI };
        }
        across.atan2(along)
    }

    /// Weight q at a distance r from the tip, and its derivative, 1/m.
    fn weight(&self, r: f64) -> [f64; 2] {
        let [inner, outer] = self.radii;
        let angle = PI * ((r - inner) / (outer - inner)).clamp(0.0, 1.0);
        let fall = 0.5 * PI / (outer - inner);
        [0.5 * (1.0 + angle.cos()), -fall * angle.sin()]
    }

    /// Integral of the weight over the plane, m^2.
    pub fn area(&self) -> f64 {
        let [inner, outer] = self.radii;
        let width = outer - inner;
        PI * (0.5 * (inner * inner + outer * outer) - 2.0 * (width / PI).powi(2))
    }
}

/// Elastic constants of an isotropic material in the plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlaneModuli {
    /// E', Pa: E in plane stress, E/(1 - nu^2) in plane strain.
    pub young: f64,
    /// E'/(2 mu) - 1: nu in plane stress, nu/(1 - nu) in plane strain.
    pub poisson: f64,
}

impl PlaneModuli {
    /// Constants of a stiffness in the plane, Pa; None where it is not isotropic.
    pub fn new(stiffness: &Stiffness) -> Option<Self> {
        let [along, across, shear] = [(0, 0), (0, 1), (2, 2)].map(|it| stiffness[it]);
        let isotropic = [
            stiffness[(1, 1)] - along,
            stiffness[(0, 2)],
            stiffness[(1, 2)],
            2.0 * shear - (along - across),
        ];
        let is_isotropic = isotropic.iter().all(|it| it.abs() <= ISOTROPIC * along);
        is_isotropic.then_some(Self {
            young: along - across * across / along,
            poisson: across / along,
        })
    }

    /// Strain of a stress in the plane.
    fn strain(&self, stress: &SymTensor<2>) -> SymTensor<2> {
        let of_trace = SymTensor::isotropic(-self.poisson * stress.trace());
        stress
            .scaled(1.0 + self.poisson)
            .plus(&of_trace)
            .scaled(1.0 / self.young)
    }
}

/// Elastic field at a point.
#[derive(Debug, Clone, Copy, PartialEq)]
struct ElasticField {
    /// Stress, Pa.
    stress: SymTensor<2>,
    /// Strain.
    strain: SymTensor<2>,
    /// u,1: derivative of the displacement along the direction of growth.
    slope: [f64; 2],
    /// Force on the point over the thickness, N/m.
    force: [f64; 2],
}

impl ElasticField {
    /// Field of a tip with a stress intensity factor of 1 Pa m^0.5 in opening or sliding, at a distance (m) and an angle from the direction of
    /// growth.
    fn near_tip(quantity: TipQuantity, moduli: PlaneModuli, distance: f64, angle: f64) -> Self {
        let root = (2.0 * PI * distance).sqrt();
        let [sine, sine_3] = [0.5 * angle, 1.5 * angle].map(f64::sin);
        let [cosine, cosine_3] = [0.5 * angle, 1.5 * angle].map(f64::cos);
        // phi' of the complex potentials: four times its real part is the trace, its imaginary part gives the rotation.
        let (components, imaginary) = match quantity {
            TipQuantity::Sliding => (
                [
                    -sine * (2.0 + cosine * cosine_3),
                    sine * cosine * cosine_3,
                    cosine * (1.0 - sine * sine_3),
                ],
                -0.5 * cosine,
            ),
            TipQuantity::EnergyRelease | TipQuantity::Opening => (
                [
                    cosine * (1.0 - sine * sine_3),
                    cosine * (1.0 + sine * sine_3),
                    sine * cosine * cosine_3,
                ],
                -0.5 * sine,
            ),
        };
        let stress = SymTensor::from_components(&components.map(|it| it / root));
        let strain = moduli.strain(&stress);
        // (kappa + 1)/(2 mu) = 4/E'.
        let rotation = 4.0 / moduli.young * (imaginary / root);
        Self {
            stress,
            strain,
            slope: [strain.at(0, 0), strain.at(1, 0) + rotation],
            force: [0.0; 2],
        }
    }

    /// The field, given in axes whose first is a unit vector, in the axes of the body; without forces.
    fn turned_from(self, [x, y]: [f64; 2]) -> Self {
        let axes = [[x, -y], [y, x]];
        Self {
            stress: self.stress.rotated(axes),
            strain: self.strain.rotated(axes),
            slope: axes.map(|axis| dot(axis, self.slope)),
            force: self.force,
        }
    }
}

/// A point with a nonzero weight.
#[derive(Debug, Clone, PartialEq)]
struct WeightedPoint {
    point: u32,
    /// Weight q.
    weight: f64,
    /// Area, m^2.
    area: f64,
    /// Gradient of q times the area, m.
    gradient: [f64; 2],
    /// Auxiliary field; None for the energy release rate, which takes the field of the body twice.
    auxiliary: Option<ElasticField>,
}

/// An integral over a ring around the tip of a crack.
#[derive(Debug, Clone, PartialEq)]
pub struct DomainIntegral {
    points: Vec<WeightedPoint>,
    direction: [f64; 2],
    thickness: f64,
    /// 1/2, or E'/2 of a stress intensity factor.
    factor: f64,
}

impl DomainIntegral {
    /// The integral of a quantity over the owned points of a cloud; None for a stress intensity factor without the moduli of an isotropic
    /// material.
    pub fn new(
        cloud: &PointCloud,
        ring: &Ring,
        quantity: TipQuantity,
        moduli: Option<PlaneModuli>,
    ) -> Option<Self> {
        let (factor, moduli) = match quantity {
            TipQuantity::EnergyRelease => (0.5, None),
            TipQuantity::Opening | TipQuantity::Sliding => (0.5 * moduli?.young, moduli),
        };
        let weighted = |point: u32| {
            let from_tip = minus(cloud.positions[point as usize], ring.tip);
            let distance = norm(from_tip);
            let [weight, slope] = ring.weight(distance);
            let area = cloud.volumes[point as usize] / cloud.thickness;
            let auxiliary = moduli.map(|moduli| {
                let angle = ring.angle(from_tip);
                let field = ElasticField::near_tip(quantity, moduli, distance, angle);
                field.turned_from(ring.direction)
            });
            (weight > 0.0 && distance > 0.0).then(|| WeightedPoint {
                point,
                weight,
                area,
                gradient: from_tip.map(|it| area * slope * it / distance),
                auxiliary,
            })
        };
        Some(Self {
            points: cloud.subdomain.owned().filter_map(weighted).collect(),
            direction: ring.direction,
            thickness: cloud.thickness,
            factor,
        })
    }

    /// Number of owned points with a weight.
    pub fn n_points(&self) -> usize {
        self.points.len()
    }

    /// Integral of the weight over the owned points, m^2.
    pub fn area(&self) -> f64 {
        self.points.iter().map(|it| it.weight * it.area).sum()
    }

    /// Contribution of a point with two fields: (sigma^a_ij u^b_i,1 + sigma^b_ij u^a_i,1 - sigma^a : eps^b delta_1j) q,j dA, less the work of the
    /// forces.
    fn mutual(&self, at: &WeightedPoint, [a, b]: [&ElasticField; 2]) -> f64 {
        let tractions = [a, b].map(|it| it.stress.times(at.gradient));
        let carried = dot(tractions[0], b.slope) + dot(tractions[1], a.slope);
        let density = a.stress.contracted(&b.strain) * dot(self.direction, at.gradient);
        let forces = dot(a.force, b.slope) + dot(b.force, a.slope);
        carried - density - at.weight * forces
    }
}

impl<const D: usize> BondSystem<D> {
    /// Value of an integral for a motion of a body in the plane with forces of supports and loads on its points (n_degrees_of_freedom), N: the
    /// contribution of the owned points.
    pub(crate) fn domain_integral(
        &self,
        layout: Layout,
        integral: &DomainIntegral,
        reading: StrainReading<'_>,
        forces: &[f64],
    ) -> f64 {
        let part = |at: &WeightedPoint| {
            let first = layout.range(at.point).start;
            let force: [f64; 2] =
                std::array::from_fn(|axis| forces[first + axis] / integral.thickness);
            if at.gradient == [0.0; 2] && force == [0.0; 2] {
                return Some(0.0);
            }
            let motion = reading.motion();
            let fit = self.fit_of_motion(layout, motion, at.point);
            let transposed = fit.transposed_gradient()?;
            let strain = self.strain_by(layout, reading, at.point)?;
            let stress = self.stress_in(layout, reading, at.point, &strain)?;
            let slope = std::array::from_fn(|axis| {
                let [x, y] = integral.direction;
                transposed[(0, axis)] * x + transposed[(1, axis)] * y
            });
            let field = ElasticField {
                stress: stress.resized(),
                strain: strain.resized(),
                slope,
                force,
            };
            let second = at.auxiliary.as_ref().unwrap_or(&field);
            Some(integral.mutual(at, [&field, second]))
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
