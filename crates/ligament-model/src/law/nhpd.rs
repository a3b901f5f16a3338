//! The beam-like bond of NHPD: Zhang, Yang and Zhuang, "A micropolar peridynamics model with non-unified horizon for
//! damage of solids with different non-local effects", eq. 6.

use std::f64::consts::PI;

use rayon::prelude::*;

use super::BondStiffness;
use crate::bonds::BondSet;
use crate::cloud::PointCloud;
use crate::material::{Material, Plane};

/// Below this |1 - 3 nu| (or |1 - 4 nu| in plane strain) the shear stiffness counts as exactly zero, and with it the
/// rotational one: what rounding leaves of it would only make the system nearly singular.
const CENTRAL_FORCE_TOLERANCE: f64 = 1e-9;

/// Stiffness densities of every bond, NHPD eq. 6:
///
/// k_n = c, k_t = 12 d / l^2, k_theta = d / l, with the bond horizon H, the thickness t and
///
/// | | c (N/m^6) | d (N/m^4) |
/// |---|---|---|
/// | plane stress | 6 E / (pi t H^3 (1 - nu)) | E (1 - 3 nu) / (6 pi t H (1 - nu^2)) |
/// | plane strain | 6 E / (pi t H^3 (1 - 2 nu)(1 + nu)) | E (1 - 4 nu) / (6 pi t H (1 - 2 nu)(1 + nu)) |
///
/// A point at an interface has the volume-weighted mean of its materials' densities; a bond has the mean of its two
/// ends'. `d` is negative for nu > 1/3 (plane stress) or nu > 1/4 (plane strain).
pub fn stiffness(
    bonds: &BondSet,
    cloud: &PointCloud,
    materials: &[Material],
    plane: Plane,
) -> BondStiffness {
    // c H^3 and d H do not depend on the bond.
    let of_materials = |constant: fn(&Material, Plane, f64) -> f64| -> Vec<f64> {
        let of_material = |material| constant(material, plane, cloud.thickness);
        materials.iter().map(of_material).collect()
    };
    let constants = [axial_constant, bending_constant].map(of_materials);
    let at_points: Vec<[f64; 2]> = (0..cloud.len())
        .into_par_iter()
        .map(|point| [0, 1].map(|k| cloud.mean_property(point, &constants[k])))
        .collect();
    let [mut axial, mut shear, mut rotational] = [(); 3].map(|()| vec![0.0; bonds.len()]);
    (
        (&bonds.ends, &bonds.length, &bonds.horizon).into_par_iter(),
        (&mut axial, &mut shear, &mut rotational).into_par_iter(),
    )
        .into_par_iter()
        .for_each(|((ends, l, h), (axial, shear, rotational))| {
            let [a, b] = ends.map(|end| at_points[end as usize]);
            let d = 0.5 * (a[1] + b[1]) / h;
            *axial = 0.5 * (a[0] + b[0]) / h.powi(3);
            *shear = 12.0 * d / l.powi(2);
            *rotational = d / l;
        });
    BondStiffness {
        axial,
        shear,
        rotational,
    }
}

/// c H^3, N/m^3.
fn axial_constant(material: &Material, plane: Plane, thickness: f64) -> f64 {
    let (young, poisson) = (material.young, material.poisson);
    let reduction = match plane {
        Plane::Stress => 1.0 - poisson,
        Plane::Strain => (1.0 - 2.0 * poisson) * (1.0 + poisson),
    };
    6.0 * young / (PI * thickness * reduction)
}

/// d H, N/m^3.
fn bending_constant(material: &Material, plane: Plane, thickness: f64) -> f64 {
    let (young, poisson) = (material.young, material.poisson);
    let (distance_to_central, reduction) = match plane {
        Plane::Stress => (1.0 - 3.0 * poisson, 1.0 - poisson * poisson),
        Plane::Strain => (1.0 - 4.0 * poisson, (1.0 - 2.0 * poisson) * (1.0 + poisson)),
    };
    if distance_to_central.abs() < CENTRAL_FORCE_TOLERANCE {
        return 0.0;
    }
    young * distance_to_central / (6.0 * PI * thickness * reduction)
}
