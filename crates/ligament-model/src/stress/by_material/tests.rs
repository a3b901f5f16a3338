use super::*;
use crate::layout::Component;
use crate::material::{Elasticity, Orthotropic, Plane, Space};
use crate::shape::{Region, Shape, SolidShape};
use crate::stress::point_strain::Motion;
use crate::stress::point_strain::tests::{GRADIENT, MATERIAL, affine, springs};
use crate::thermal::{StressFreeStrains, ThermalStrain};

const IN_PLANE: &[Component] = &[Component::X, Component::Y];

fn layout<const D: usize>(system: &BondSystem<D>, components: &'static [Component]) -> Layout {
    Layout {
        n_points: system.cloud.len(),
        components,
    }
}

fn assert_all_are(found: &Stresses, expected: &[f64]) {
    assert_eq!(found.names.len(), expected.len());
    for stress in found.values.chunks_exact(expected.len()) {
        for (stress, expected) in stress.iter().zip(expected) {
            assert!(
                (stress - expected).abs() < 1e-11,
                "{found:?} for {expected:?}"
            );
        }
    }
}

/// sigma = 2 mu eps + lambda tr(eps) with Lame's constants, of plane stress those of Poisson's ratio nu/(1 + nu), at all points of an affine
/// motion of which two bonds of three are left.
fn assert_lame<const D: usize, S: Region<D>>(space: Space, components: &'static [Component]) {
    let stiffness = Elasticity::Isotropic(MATERIAL).stiffness_in(space);
    let mut system = springs::<D, S>(space).with_materials(stiffness.into_iter().collect());
    let is_plane_strain = space == Space::Plane(Plane::Strain);
    if is_plane_strain {
        system = system.with_stress_across_plane(StressAcrossPlane::OfIsotropic);
    }
    let nu = match space {
        Space::Plane(Plane::Stress) => MATERIAL.poisson / (1.0 + MATERIAL.poisson),
        _ => MATERIAL.poisson,
    };
    let twice_mu = MATERIAL.young / (1.0 + MATERIAL.poisson);
    let lame = twice_mu * nu / (1.0 - 2.0 * nu);
    let trace: f64 = (0..D).map(|axis| GRADIENT[axis][axis]).sum();
    let expected = SymTensor::<D>::from_fn(|i, j| {
        let volumetric = if i == j { lame * trace } else { 0.0 };
        twice_mu * 0.5 * (GRADIENT[i][j] + GRADIENT[j][i]) + volumetric
    });
    let intact: Vec<bool> = (0..system.bonds.len()).map(|bond| bond % 3 != 0).collect();
    let motion = Motion {
        intact: &intact,
        displacement: &affine(&system, GRADIENT),
        expansion: ThermalStrain::NONE,
    };
    let layout = layout(&system, components);
    let mut expected: Vec<f64> = expected.components().collect();
    if D == 2 {
        expected.push(if is_plane_strain { lame * trace } else { 0.0 });
    }
    assert_all_are(
        &system.stresses_by_material(layout, StrainReading::Effective(motion)),
        &expected,
    );
}

#[test]
fn stresses_are_those_of_lame() {
    assert_lame::<2, Shape>(Space::Plane(Plane::Stress), IN_PLANE);
    assert_lame::<2, Shape>(Space::Plane(Plane::Strain), IN_PLANE);
    let in_space = &[Component::X, Component::Y, Component::Z];
    assert_lame::<3, SolidShape>(Space::Solid, in_space);
}

/// A bar of an orthotropic material along its axis 1, at 0.4 rad to the x axis, under the stress E_1: strains 1 along it and -nu_12
/// across it.
#[test]
fn a_material_with_axes_is_pulled_along_its_own() {
    let space = Space::Plane(Plane::Stress);
    let material = Elasticity::Orthotropic(Orthotropic {
        young: [10.0, 2.0],
        poisson: 0.3,
        shear_modulus: 1.5,
        out_of_plane: None,
        angle: 0.4,
    });
    let stiffness = material.stiffness_in(space).into_iter().collect();
    let system = springs::<2, Shape>(space).with_materials(stiffness);
    let (sine, cosine) = 0.4_f64.sin_cos();
    let [along, across] = [[cosine, sine], [-sine, cosine]];
    let mut gradient = [[0.0; 3]; 3];
    for (i, row) in gradient.iter_mut().enumerate().take(2) {
        for (j, it) in row.iter_mut().enumerate().take(2) {
            *it = along[i] * along[j] - 0.3 * across[i] * across[j];
        }
    }
    let motion = Motion {
        intact: &vec![true; system.bonds.len()],
        displacement: &affine(&system, gradient),
        expansion: ThermalStrain::NONE,
    };
    let expected = SymTensor::<2>::from_fn(|i, j| 10.0 * along[i] * along[j]);
    let expected: Vec<f64> = expected.components().chain([0.0]).collect();
    let layout = layout(&system, IN_PLANE);
    assert_all_are(
        &system.stresses_by_material(layout, StrainReading::Effective(motion)),
        &expected,
    );
}

/// A free body that a temperature expands has no stress in the plane, and -E alpha T across it where it cannot expand across it: in the plane it
/// expands by (1 + nu) alpha T.
#[test]
fn what_the_temperature_gives_is_no_stress() {
    assert_free_of_stress(Plane::Stress, &[0.0; 4]);
    let across = -0.01 * MATERIAL.young / (1.0 + MATERIAL.poisson);
    assert_free_of_stress(Plane::Strain, &[0.0, 0.0, 0.0, across]);
}

fn assert_free_of_stress(plane: Plane, expected: &[f64]) {
    let space = Space::Plane(plane);
    let stiffness = Elasticity::Isotropic(MATERIAL).stiffness_in(space);
    let mut system = springs::<2, Shape>(space).with_materials(stiffness.into_iter().collect());
    if plane == Plane::Strain {
        system = system.with_stress_across_plane(StressAcrossPlane::OfIsotropic);
    }
    let free = StressFreeStrains::new(vec![SymTensor::<2>::isotropic(0.02); system.cloud.len()]);
    let motion = Motion {
        intact: &vec![true; system.bonds.len()],
        displacement: &affine(&system, [[0.01, 0.0, 0.0], [0.0, 0.01, 0.0], [0.0; 3]]),
        expansion: free.times(0.5),
    };
    let layout = layout(&system, IN_PLANE);
    let stresses = system.stresses_by_material(layout, StrainReading::Effective(motion));
    assert_all_are(&stresses, expected);
}
