//! Thermal expansion.

use super::elasticity::{Elasticity, Plane, Space};
use crate::tensor::SymTensor;

/// Coefficients of linear thermal expansion, 1/K.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Expansion {
    /// Coefficients alpha_1 and alpha_2, along the axes of the material in the plane.
    pub in_plane: [f64; 2],
    /// Coefficient alpha_3 across the plane, which plane strain requires.
    pub across: Option<f64>,
}

impl Expansion {
    /// An expansion that is the same in all directions, with the coefficient alpha, 1/K.
    pub fn uniform(coefficient: f64) -> Self {
        Self {
            in_plane: [coefficient; 2],
            across: Some(coefficient),
        }
    }

    /// Stress-free strain of a body for a temperature change of one kelvin, 1/K: [in the plane](Self::plane_strain), and in space alpha
    /// along all axes.
    ///
    /// # Panics
    ///
    /// Panics in plane strain if the constants across the plane are missing.
    pub fn free_strain<const D: usize>(
        &self,
        elasticity: &Elasticity,
        space: Space,
    ) -> SymTensor<D> {
        match space {
            Space::Plane(plane) => {
                let strains = self.plane_strain(elasticity, plane);
                SymTensor::<2>::from_engineering(&strains).resized()
            }
            Space::Solid => SymTensor::isotropic(self.in_plane[0]),
        }
    }

    /// Stress-free strain (eps_xx, eps_yy, gamma_xy) in the plane for a temperature change of one kelvin, 1/K. In the axes of the material
    /// it is
    ///
    /// - in plane stress (alpha_1, alpha_2, 0);
    /// - in plane strain (alpha_1 + nu_31 alpha_3, alpha_2 + nu_32 alpha_3, 0) with nu_3i = nu_i3 E_3/E_i: the stress
    ///   -E_3 alpha_3 across the plane keeps the strain there zero and widens the plane. If isotropic, (1 + nu) alpha.
    ///
    /// A material given by the stiffness of its plane expands by (alpha_1, alpha_2, 0) along x and y in both states.
    ///
    /// # Panics
    ///
    /// Panics in plane strain if the constants across the plane are missing.
    pub fn plane_strain(&self, elasticity: &Elasticity, plane: Plane) -> [f64; 3] {
        const NEEDED: &str = "plane strain needs the constants across the plane";
        let (minor, angle) = match elasticity {
            // The constants are those of the plane in either state.
            Elasticity::Anisotropic(_) => {
                let [xx, yy] = self.in_plane;
                return [xx, yy, 0.0];
            }
            Elasticity::Isotropic(material) => ([material.poisson; 2], 0.0),
            Elasticity::Orthotropic(material) => {
                let minor = match plane {
                    Plane::Stress => [0.0; 2],
                    Plane::Strain => {
                        let across = material.out_of_plane.expect(NEEDED);
                        [0, 1].map(|i| across.poisson[i] * across.young / material.young[i])
                    }
                };
                (minor, material.angle)
            }
        };
        let [one, two] = match plane {
            Plane::Stress => self.in_plane,
            Plane::Strain => {
                let across = self.across.expect(NEEDED);
                [0, 1].map(|i| self.in_plane[i] + minor[i] * across)
            }
        };
        let (s, c) = angle.sin_cos();
        [
            one * c * c + two * s * s,
            one * s * s + two * c * c,
            2.0 * (one - two) * s * c,
        ]
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::material::{Isotropic, Orthotropic, OutOfPlane};
    use nalgebra::{Matrix3, Vector3};

    const LAMINA: Orthotropic = Orthotropic {
        young: [15e9, 5e9],
        poisson: 0.25,
        shear_modulus: 4.8e9,
        out_of_plane: Some(OutOfPlane {
            young: 7e9,
            poisson: [0.2, 0.35],
        }),
        angle: 0.4,
    };

    const EXPANSION: Expansion = Expansion {
        in_plane: [-1e-6, 30e-6],
        across: Some(27e-6),
    };

    /// The stress-free strain of the plane from the three-dimensional compliance: of the stresses of the fully held body,
    /// -C alpha with the inverse C of S over the three normal directions, those in the plane are let go while eps_3 stays zero.
    /// Turned by an angle, a tensor: the extension along a direction at psi to the axis 1 is n . eps n.
    #[test]
    fn plane_strain_follows_from_the_compliance_of_the_solid() {
        let ([e1, e2], OutOfPlane { young: e3, poisson }) =
            (LAMINA.young, LAMINA.out_of_plane.unwrap());
        let [s12, s13, s23] = [-LAMINA.poisson / e1, -poisson[0] / e1, -poisson[1] / e2];
        let compliance = Matrix3::new(1.0 / e1, s12, s13, s12, 1.0 / e2, s23, s13, s23, 1.0 / e3);
        let alpha = Vector3::new(-1e-6, 30e-6, 27e-6);
        let stiffness = compliance.try_inverse().unwrap();
        let held = stiffness * -alpha;
        let in_plane = stiffness.fixed_view::<2, 2>(0, 0).into_owned();
        let free = in_plane.try_inverse().unwrap() * -held.fixed_rows::<2>(0).into_owned();
        let elasticity = Elasticity::Orthotropic(LAMINA);
        let [xx, yy, xy] = EXPANSION.plane_strain(&elasticity, Plane::Strain);
        for psi in [0.0_f64, 0.7, 1.9] {
            let (s, c) = (LAMINA.angle + psi).sin_cos();
            let extension = xx * c * c + yy * s * s + xy * s * c;
            let expected = free[0] * psi.cos().powi(2) + free[1] * psi.sin().powi(2);
            assert!((extension - expected).abs() < 1e-14 * 30e-6);
        }
        let [xx, yy, _] = EXPANSION.plane_strain(&elasticity, Plane::Stress);
        assert!((xx + yy - 29e-6).abs() < 1e-14 * 30e-6);
    }

    /// (1 + nu) alpha in plane strain, in either form of the same material.
    #[test]
    fn isotropic_bodies_widen_by_poissons_ratio() {
        let (young, poisson) = (7e9, 0.3);
        let isotropic = Elasticity::Isotropic(Isotropic { young, poisson });
        let as_orthotropic = Elasticity::Orthotropic(Orthotropic {
            young: [young; 2],
            poisson,
            shear_modulus: young / 2.6,
            out_of_plane: Some(OutOfPlane {
                young,
                poisson: [poisson; 2],
            }),
            angle: 1.1,
        });
        let expansion = Expansion::uniform(20e-6);
        for elasticity in [isotropic, as_orthotropic] {
            for (plane, expected) in [(Plane::Stress, 20e-6), (Plane::Strain, 26e-6)] {
                let [xx, yy, xy] = expansion.plane_strain(&elasticity, plane);
                for (found, expected) in [(xx, expected), (yy, expected), (xy, 0.0)] {
                    assert!((found - expected).abs() < 1e-15 * 26e-6 * 4.0);
                }
            }
        }
    }
}
