//! The orthotropic micropolar law (OMPPD section 2.1): stiffnesses that depend on the direction of the
//! bond in the axes of the material.

use std::f64::consts::PI;

use super::rotational::RotationalStiffness;
use super::{
    BondLaw, BondStiffness, CENTRAL_FORCE_TOLERANCE, Densities, Law, LawInput, Materials, Options,
    ShearForm,
};
use crate::element::ElementKind;
use crate::material::{Elasticity, Orthotropic, OutOfPlane, Plane, PoissonForm};

/// The law.
pub static LAW: BondLaw = BondLaw {
    options: Options {
        rotational_stiffness: Some(RotationalStiffness::Decaying),
        poisson: Some(PoissonForm::Bonds),
        ..Options::NONE
    },
    element: |_| ElementKind::Beam,
    shear_form: Some(|_| ShearForm::Constant),
    materials: Materials::Orthotropic,
    ..BondLaw::new(
        "orthotropic",
        "Stiffness by the direction in the axes of an orthotropic material, rotations.",
        "OMPPD eqs 50 to 59",
        densities,
        None,
    )
};

impl Law {
    /// Stiffness by the direction in the axes of an orthotropic material, with rotations.
    pub const ORTHOTROPIC: Self = Self::usual(&LAW);
}

/// Stiffness densities of every bond, OMPPD eqs 58 and 59 with the constants of eqs 50 to 53: with psi measured from the axis 1
/// of the material,
///
/// k_n = k_n1 cos^4 psi + k_n2 sin^4 psi + (2 k_v + 4 k_t1) sin^2 psi cos^2 psi,
/// k_t = (k_n1 + k_n2 - 2 k_v) sin^2 psi cos^2 psi + k_t1 (cos^2 psi - sin^2 psi)^2,
///
/// and a chosen k_theta. Plane strain takes the reduced constants C of [`crate::material::Orthotropic::principal_stiffness`]. An
/// isotropic material gives the densities of [`super::mppd`].
///
/// # Panics
///
/// Panics for a material without axes ([`Elasticity::Anisotropic`]): its six constants have no place in four.
fn densities(input: &LawInput<'_, 2>) -> BondStiffness {
    let (plane, rotational) = (input.space.plane(), input.rotational());
    let constants: Vec<[f64; 8]> = (input.elasticity.iter())
        .map(|material| harmonics(material, plane, input.cloud.thickness))
        .collect();
    BondStiffness::from_constants(input.bonds, input.cloud, &constants, |constants, bond| {
        let [a, b] = bond.direction;
        let [cos_2, sin_2] = [a * a - b * b, 2.0 * a * b];
        let [cos_4, sin_4] = [cos_2 * cos_2 - sin_2 * sin_2, 2.0 * cos_2 * sin_2];
        let [n_0, n_2c, n_2s, n_4c, n_4s, t_0, t_4c, t_4s] = constants;
        let volume = bond.horizon.powi(3);
        let shear = (t_0 + t_4c * cos_4 + t_4s * sin_4) / volume;
        Densities {
            axial: (n_0 + n_2c * cos_2 + n_2s * sin_2 + n_4c * cos_4 + n_4s * sin_4) / volume,
            shear,
            rotational: rotational.density(shear, bond.length, bond.horizon),
        }
    })
}

/// Smallest k_t H^3 t over the directions of bonds, Pa; negative where the rotations of the points are not stable.
pub fn smallest_shear(material: &Elasticity, plane: Plane) -> f64 {
    let [.., shear_0, cos_4, sin_4] = harmonics(material, plane, 1.0);
    shear_0 - cos_4.hypot(sin_4)
}

/// Share by which a modulus of cells exceeds the least one, so that rounding leaves no negative shear stiffness.
const BEYOND_ROUNDING: f64 = 1e-9;

/// The material that bonds without a negative shear stiffness make up, and the modulus kappa of the cells against changes of volume, Pa: with
/// the smallest k_t of all directions, 3/(pi t H^3) (4 kappa + ...) of C - kappa 1 (x) 1, which is 0 at
///
/// kappa = -(pi/12) min k_t H^3 t.
///
/// None where the bonds would have no stable material, or pull along some direction where they are shortened.
pub fn split(material: &Orthotropic, plane: Plane) -> Option<(Orthotropic, f64)> {
    let least = smallest_shear(&Elasticity::Orthotropic(*material), plane);
    if least >= 0.0 {
        return Some((*material, 0.0));
    }
    let modulus = -least * (PI / 12.0) * (1.0 + BEYOND_ROUNDING);
    let mut stiffness = material.principal_stiffness(plane);
    stiffness
        .fixed_view_mut::<2, 2>(0, 0)
        .add_scalar_mut(-modulus);
    stiffness.cholesky()?;
    let compliance = stiffness.try_inverse()?;
    let young = [0, 1].map(|axis| 1.0 / compliance[(axis, axis)]);
    let of_bonds = Orthotropic {
        young,
        poisson: -compliance[(0, 1)] * young[0],
        shear_modulus: 1.0 / compliance[(2, 2)],
        // Without coupling to the plane the constants of either state of the plane are the same.
        out_of_plane: material.out_of_plane.map(|_| OutOfPlane {
            young: young[0],
            poisson: [0.0; 2],
        }),
        angle: material.angle,
    };
    (smallest_axial(&of_bonds, plane) > 0.0).then_some((of_bonds, modulus))
}

/// Smallest k_n H^3 t over the directions of bonds, Pa: with c = cos 2 psi in the axes of the material it is a parabola in c.
fn smallest_axial(material: &Orthotropic, plane: Plane) -> f64 {
    let along_axes = Orthotropic {
        angle: 0.0,
        ..*material
    };
    let [mean, cos_2, _, cos_4, ..] = harmonics(&Elasticity::Orthotropic(along_axes), plane, 1.0);
    let at = |c: f64| mean + cos_2 * c + cos_4 * (2.0 * c * c - 1.0);
    let vertex = (-cos_2 / (4.0 * cos_4)).clamp(-1.0, 1.0);
    let ends = at(1.0).min(at(-1.0));
    if vertex.is_finite() {
        ends.min(at(vertex))
    } else {
        ends
    }
}

/// k_n H^3 and k_t H^3 (N/m^3) as series in the angle psi to the x axis: the constant term, and the factors of cos and sin of
/// 2 psi and 4 psi (k_t has none of 2 psi). Unlike k_n1 to k_t1 they have a mean over materials with different axes.
fn harmonics(material: &Elasticity, plane: Plane, thickness: f64) -> [f64; 8] {
    let (c, angle) = match material {
        Elasticity::Isotropic(material) => (material.plane_stiffness(plane), 0.0),
        Elasticity::Orthotropic(material) => (material.principal_stiffness(plane), material.angle),
        Elasticity::Anisotropic(_) => panic!("the orthotropic law needs a material with axes"),
    };
    let [c11, c12, c22, c66] = [c[(0, 0)], c[(0, 1)], c[(1, 1)], c[(2, 2)]];
    let unit = 3.0 / (PI * thickness);
    let n_1 = 4.0 * unit * (c11 - c66);
    let n_2 = 4.0 * unit * (c22 - c66);
    let v = 4.0 * unit * (3.0 * c12 - c66);
    let t_1 = unit * (8.0 * c66 - c11 - c22 - 2.0 * c12);
    let ([s2, c2], [s4, c4]) = (
        <[f64; 2]>::from((2.0 * angle).sin_cos()),
        <[f64; 2]>::from((4.0 * angle).sin_cos()),
    );
    let axial_2 = 0.5 * (n_1 - n_2);
    let axial_4 = 0.125 * (n_1 + n_2 - 2.0 * v - 4.0 * t_1);
    let axial_0 = 0.125 * (3.0 * (n_1 + n_2) + 2.0 * v + 4.0 * t_1);
    let mut shear_0 = 0.125 * (n_1 + n_2 - 2.0 * v + 4.0 * t_1);
    let mut shear_4 = 0.125 * (4.0 * t_1 - n_1 - n_2 + 2.0 * v);
    if shear_0.abs() + shear_4.abs() < CENTRAL_FORCE_TOLERANCE * axial_0 {
        (shear_0, shear_4) = (0.0, 0.0);
    }
    [
        axial_0,
        axial_2 * c2,
        axial_2 * s2,
        axial_4 * c4,
        axial_4 * s4,
        shear_0,
        shear_4 * c4,
        shear_4 * s4,
    ]
}
