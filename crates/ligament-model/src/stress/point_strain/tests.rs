use super::*;
use crate::bonds::BondSet;
use crate::cloud::PointCloud;
use crate::cloud::lattice::Lattice;
use crate::element::{BondDeformation, ElementKind};
use crate::failure::hooke::Moduli;
use crate::horizon::Horizons;
use crate::law::Law;
use crate::layout::Component;
use crate::material::{Isotropic, Plane, Space};
use crate::shape::{Region, Shape, SolidShape};

pub(in crate::stress) const MATERIAL: Isotropic = Isotropic {
    young: 3.0,
    poisson: 0.2,
};

/// Springs between the points of a lattice of 6^D cells, whose spacing differs from axis to axis.
pub(in crate::stress) fn springs<const D: usize, S: Region<D>>(space: Space) -> BondSystem<D> {
    let spacing = std::array::from_fn(|axis| 1.0 + 0.1 * axis as f64);
    let lattice = Lattice::<D, S>::new([6; D], spacing, [0.0; D], Vec::new());
    let n_points = lattice.cells.len();
    let cloud = PointCloud::from_lattice(&lattice, 1.0, &vec![0; n_points], 1);
    let horizons = Horizons::unified(2.7, cloud.len());
    let bonds = BondSet::search(&cloud, &horizons);
    let stiffness = Law::NHPD.densities(&bonds, &cloud, &[MATERIAL.into()], space);
    let ones = vec![1.0; bonds.len()];
    BondSystem::new(
        cloud,
        bonds,
        ElementKind::Spring,
        stiffness,
        ones.clone(),
        &ones,
    )
}

pub(in crate::stress) const GRADIENT: [[f64; 3]; 3] =
    [[0.3, -0.2, 0.05], [0.4, -0.1, 0.2], [-0.3, 0.15, 0.25]];

/// Displacements with a gradient, and one along each axis.
pub(in crate::stress) fn affine<const D: usize>(
    system: &BondSystem<D>,
    gradient: [[f64; 3]; 3],
) -> Vec<f64> {
    let positions = system.cloud.positions.iter();
    let moved = positions.flat_map(|place| {
        (0..D).map(move |row| 1.0 + (0..D).map(|k| gradient[row][k] * place[k]).sum::<f64>())
    });
    moved.collect()
}

/// An affine motion is found to rounding, whichever bonds are left as long as they span the space, and the strains around a bond are parts
/// of its strain. A point with bonds along one line has no strain.
fn assert_affine_motions_are_exact<const D: usize, S: Region<D>>(
    space: Space,
    components: &'static [Component],
) {
    let system = springs::<D, S>(space);
    let layout = Layout {
        n_points: system.cloud.len(),
        components,
    };
    let displacement = affine(&system, GRADIENT);
    let expected = SymTensor::<D>::from_fn(|i, j| 0.5 * (GRADIENT[i][j] + GRADIENT[j][i]));
    let mut intact = vec![true; system.bonds.len()];
    for every in [usize::MAX, 3, 2] {
        for bond in (0..intact.len()).step_by(every) {
            intact[bond] = false;
        }
        let motion = Motion {
            intact: &intact,
            displacement: &displacement,
            expansion: ThermalStrain::NONE,
        };
        let strains = system.point_strains(layout, motion);
        for strain in strains.iter().flatten() {
            let off = strain.plus(&expected.scaled(-1.0));
            assert!(off.components().all(|it| it.abs() < 1e-12), "{off:?}");
        }
        assert!(strains.iter().flatten().count() > system.cloud.len() / 2);
        // With these moduli the stress across a bond is the trace of the strain and the shear strain itself.
        let moduli = |_| Moduli::from_coefficients(&[1.0, 1.0, 1.0, 1.0]);
        let directions = system.bonds.direction.iter();
        let stretch = |&n: &[f64; D]| BondDeformation::new([dot(n, expected.times(n)), 0.0, 0.0]);
        let deformations: Vec<BondDeformation> = directions.map(stretch).collect();
        let stresses = system.stresses_across(layout, motion, &deformations, moduli);
        for (stress, &n) in stresses.iter().zip(&system.bonds.direction) {
            let along = expected.times(n);
            let normal = dot(n, along);
            let trace = expected.trace();
            let shear = dot(stress.shear, stress.shear);
            assert!((stress.normal - trace).abs() < 1e-12);
            assert!((shear - (dot(along, along) - normal * normal)).abs() < 1e-12);
        }
    }
    let point = system.cloud.len() as u32 / 2;
    for &bond in system.bonds.incidence.at(point) {
        let n = system.bonds.direction[bond as usize];
        intact[bond as usize] = n[1..].iter().all(|cosine| *cosine == 0.0);
    }
    let motion = Motion {
        intact: &intact,
        displacement: &displacement,
        expansion: ThermalStrain::NONE,
    };
    assert_eq!(system.point_strains(layout, motion)[point as usize], None);
}

#[test]
fn affine_motions_of_a_plane_are_exact() {
    let components = &[Component::X, Component::Y];
    assert_affine_motions_are_exact::<2, Shape>(Space::Plane(Plane::Stress), components);
}

#[test]
fn affine_motions_of_a_solid_are_exact() {
    let components = &[Component::X, Component::Y, Component::Z];
    assert_affine_motions_are_exact::<3, SolidShape>(Space::Solid, components);
}
