//! Elastic fields at the fronts of cracks.
//!
//! The field of a straight front in an isotropic body (Williams 1957) has, for K_I, K_II and K_III = 1, displacements with sqrt(r) and stresses with
//! 1/sqrt(r). Carried along a circle, with the distance rho from its axis, the same displacements have the strains
//!
//! eps_33 = u_1/rho, gamma_13 = u_3,1 - u_3/rho,
//!
//! besides the ones of the straight front, and their stresses are balanced by forces of the order of the stress over rho.

use std::f64::consts::PI;

use super::crack_front::combined;
use crate::material::Stiffness;
use crate::tensor::{SymTensor, dot};

/// Relative difference of moduli up to which a material counts as isotropic.
const ISOTROPIC: f64 = 1e-9;

/// Quantity at the front of a crack.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TipQuantity {
    /// Energy release rate J.
    EnergyRelease,
    /// Stress intensity factor K_I of opening.
    Opening,
    /// Stress intensity factor K_II of sliding in the plane.
    Sliding,
    /// Stress intensity factor K_III of sliding along the front.
    Tearing,
    /// Length by which a crack has grown.
    Advance,
}

impl TipQuantity {
    /// All quantities.
    pub const ALL: [Self; 5] = [
        Self::EnergyRelease,
        Self::Opening,
        Self::Sliding,
        Self::Tearing,
        Self::Advance,
    ];

    /// Symbol, the keyword in case files, and meaning.
    pub const fn symbol(self) -> [&'static str; 2] {
        match self {
            Self::EnergyRelease => ["J", "Energy release rate, J/m^2."],
            Self::Opening => ["K_I", "Stress intensity factor of opening, Pa m^0.5."],
            Self::Sliding => [
                "K_II",
                "Stress intensity factor of sliding, Pa m^0.5: positive where the left side of the crack, seen towards its tip, slides towards the tip; in a solid the side of the normal.",
            ],
            Self::Tearing => [
                "K_III",
                "Stress intensity factor of sliding along the front of a solid, Pa m^0.5: positive where the side of the normal n slides along g x n, with the direction g of growth.",
            ],
            Self::Advance => [
                "advance",
                "Length by which the crack has grown from the tip of the pre-crack, m: with `growing`.",
            ],
        }
    }

    /// SI unit.
    pub fn unit(self) -> &'static str {
        match self {
            Self::EnergyRelease => "J/m^2",
            Self::Opening | Self::Sliding | Self::Tearing => "Pa m^0.5",
            Self::Advance => "m",
        }
    }
}

#[cfg(feature = "case")]
crate::worded_by_table! { TipQuantity: TipQuantity::ALL, TipQuantity::ALL.into_iter(), it => it.symbol() }

/// Elastic constants of an isotropic material, of a body in the plane or across the front of a crack in space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlaneModuli {
    /// E', Pa: E in plane stress, E/(1 - nu^2) in plane strain.
    pub young: f64,
    /// E'/(2 mu) - 1: nu in plane stress, nu/(1 - nu) in plane strain.
    pub poisson: f64,
}

impl PlaneModuli {
    /// Constants of a stiffness, Pa; None where it is not isotropic in the plane.
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

    /// Shear modulus mu, Pa.
    pub fn shear(&self) -> f64 {
        0.5 * self.young / (1.0 + self.poisson)
    }

    /// lambda of plane strain, Pa.
    fn lame(&self) -> f64 {
        2.0 * self.shear() * self.poisson / (1.0 - self.poisson)
    }

    /// Strain of a stress without strain along the front.
    fn strain(&self, stress: &SymTensor<3>) -> SymTensor<3> {
        let trace = stress.at(0, 0) + stress.at(1, 1);
        SymTensor::from_fn(|row, column| {
            let of_trace = match row == column && row < 2 {
                true => self.poisson * trace,
                false => 0.0,
            };
            ((1.0 + self.poisson) * stress.at(row, column) - of_trace) / self.young
        })
    }

    /// Stress of a strain.
    fn stress(&self, strain: &SymTensor<3>) -> SymTensor<3> {
        let of_trace = SymTensor::isotropic(self.lame() * strain.trace());
        strain.scaled(2.0 * self.shear()).plus(&of_trace)
    }
}

/// Elastic field at a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ElasticField {
    /// Stress, Pa.
    pub(super) stress: SymTensor<3>,
    /// Strain.
    pub(super) strain: SymTensor<3>,
    /// u,1: derivative of the displacement along the direction of growth.
    pub(super) slope: [f64; 3],
    /// Derivative of the displacement along the front.
    pub(super) slope_along: [f64; 3],
    /// Force per volume, N/m^3.
    pub(super) force: [f64; 3],
}

/// Field of a straight front.
struct StraightField {
    /// Components of the stress across the front and of shear along it in their order, without the normal one along it, Pa.
    stress: [f64; 6],
    /// Rotation in the plane across the front, (u_2,1 - u_1,2)/2.
    rotation: f64,
    /// Displacement, m.
    displacement: [f64; 3],
}

impl StraightField {
    /// Field of the intensity 1 Pa m^0.5 of one mode at a distance (m) and an angle.
    fn new(quantity: TipQuantity, moduli: PlaneModuli, distance: f64, angle: f64) -> Self {
        let root = (2.0 * PI * distance).sqrt();
        let [sine, sine_3] = [0.5 * angle, 1.5 * angle].map(f64::sin);
        let [cosine, cosine_3] = [0.5 * angle, 1.5 * angle].map(f64::cos);
        let kappa = (3.0 - moduli.poisson) / (1.0 + moduli.poisson);
        let moved = 0.5 * distance / (moduli.shear() * root);
        // phi' of the complex potentials: four times its real part is the trace, its imaginary part gives the rotation.
        let (stress, imaginary, displacement) = match quantity {
            TipQuantity::Tearing => (
                [0.0, 0.0, 0.0, 0.0, -sine, cosine],
                0.0,
                [0.0, 0.0, 4.0 * sine],
            ),
            TipQuantity::Sliding => (
                [
                    -sine * (2.0 + cosine * cosine_3),
                    sine * cosine * cosine_3,
                    cosine * (1.0 - sine * sine_3),
                    0.0,
                    0.0,
                    0.0,
                ],
                -0.5 * cosine,
                [
                    sine * (kappa + 1.0 + 2.0 * cosine * cosine),
                    -cosine * (kappa - 1.0 - 2.0 * sine * sine),
                    0.0,
                ],
            ),
            TipQuantity::EnergyRelease | TipQuantity::Opening | TipQuantity::Advance => (
                [
                    cosine * (1.0 - sine * sine_3),
                    cosine * (1.0 + sine * sine_3),
                    sine * cosine * cosine_3,
                    0.0,
                    0.0,
                    0.0,
                ],
                -0.5 * sine,
                [
                    cosine * (kappa - 1.0 + 2.0 * sine * sine),
                    sine * (kappa + 1.0 - 2.0 * cosine * cosine),
                    0.0,
                ],
            ),
        };
        Self {
            stress: stress.map(|it| it / root),
            // (kappa + 1)/(2 mu) = 4/E'.
            rotation: 4.0 / moduli.young * (imaginary / root),
            displacement: displacement.map(|it| moved * it),
        }
    }
}

impl ElasticField {
    /// Field of a front with the intensity 1 Pa m^0.5 of one mode, in the axes of the front, at a distance (m) and an angle from the direction of
    /// growth and with the curvature 1/rho (1/m) of the front.
    pub(super) fn of_front(
        quantity: TipQuantity,
        moduli: PlaneModuli,
        [distance, angle]: [f64; 2],
        curvature: f64,
    ) -> Self {
        let straight = StraightField::new(quantity, moduli, distance, angle);
        let mut stress = SymTensor::from_components(&straight.stress);
        let strain = moduli.strain(&stress);
        stress = stress.plus(&SymTensor::from_components(&[
            0.0,
            0.0,
            0.0,
            moduli.lame() * strain.trace(),
            0.0,
            0.0,
        ]));
        let slope = [
            strain.at(0, 0),
            strain.at(1, 0) + straight.rotation,
            2.0 * strain.at(2, 0),
        ];
        let [u, _, w] = straight.displacement.map(|it| it * curvature);
        let curved = SymTensor::from_components(&[0.0, 0.0, 0.0, u, -0.5 * w, 0.0]);
        let (mu, lambda) = (moduli.shear(), moduli.lame());
        let across = strain.at(0, 1) - straight.rotation;
        // The divergence of the stress.
        let divergence = [
            lambda * (slope[0] - u) + stress.at(0, 0) - stress.at(2, 2) - 2.0 * mu * u,
            lambda * across + stress.at(0, 1),
            mu * (slope[2] - w),
        ];
        Self {
            stress: stress.plus(&moduli.stress(&curved)),
            strain: strain.plus(&curved),
            slope,
            slope_along: [-w, 0.0, u],
            force: divergence.map(|it| -curvature * it),
        }
    }

    /// The field in the axes of the body, in place of the ones with these unit vectors.
    pub(super) fn turned_from(self, axes: [[f64; 3]; 3]) -> Self {
        let columns: [[f64; 3]; 3] = std::array::from_fn(|it| axes.map(|axis| axis[it]));
        Self {
            stress: self.stress.rotated(columns),
            strain: self.strain.rotated(columns),
            slope: combined(axes, self.slope),
            slope_along: combined(axes, self.slope_along),
            force: combined(axes, self.force),
        }
    }

    /// Work of the stress in the strain of another field, J/m^3.
    pub(super) fn work_in(&self, other: &Self) -> f64 {
        self.stress.contracted(&other.strain)
    }

    /// Work of the traction on a plane with a normal of any length in a motion.
    pub(super) fn work_of_traction(&self, normal: [f64; 3], motion: [f64; 3]) -> f64 {
        dot(self.stress.times(normal), motion)
    }
}
