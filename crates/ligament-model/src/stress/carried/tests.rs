#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use super::*;
use crate::layout::Component;
use crate::material::{Plane, Space};
use crate::shape::{Region, Shape, SolidShape};
use crate::stress::point_strain::tests::{GRADIENT, affine, springs};
use crate::thermal::{StressFreeStrains, ThermalStrain};

const AXES: &[Component] = &[Component::X, Component::Y, Component::Z];

/// Largest difference of the components of the strains of all points, with the bonds marked in `intact` and what is left of them, from
/// expected ones.
fn off<const D: usize>(
    system: &BondSystem<D>,
    (gradient, expansion): ([[f64; 3]; 3], ThermalStrain<'_>),
    (intact, remaining): (&[bool], &[StiffnessFactors]),
    expected: impl Fn(u32) -> SymTensor<D>,
) -> f64 {
    let layout = Layout {
        n_points: system.cloud.len(),
        components: &AXES[..D],
    };
    let carried = Carried {
        motion: Motion {
            intact,
            displacement: &affine(system, gradient),
            expansion,
        },
        remaining,
        closed: &[],
    };
    let of_point = |point: u32| {
        let found = system.strain_by(layout, StrainReading::Carried(carried), point);
        let minus = expected(point).scaled(-1.0);
        let off = found.map(|it| {
            it.plus(&minus)
                .components()
                .fold(0.0, |a, b| f64::max(a, b.abs()))
        });
        off.unwrap_or(f64::INFINITY)
    };
    (0..system.cloud.len() as u32)
        .map(of_point)
        .fold(0.0, f64::max)
}

/// Bonds of which a third is broken, a third softens by factors of their own and a third is sound.
fn damaged(n_bonds: usize) -> (Vec<bool>, Vec<StiffnessFactors>) {
    let of_bond = |bond: usize| StiffnessFactors {
        axial: if bond % 3 == 1 { 0.6 } else { 1.0 },
        shear: if bond % 3 == 1 { 0.3 } else { 1.0 },
        rotational: 1.0,
    };
    let intact = (0..n_bonds).map(|bond| bond % 3 != 0).collect();
    (intact, (0..n_bonds).map(of_bond).collect())
}

/// A point whose bonds all have the share 1 - D of their stiffness carries the stress (1 - D) C : eps of the strain (Lemaitre and Chaboche
/// 1990, eq. 7.5), less that of the temperature, one without bonds none; and a rotation of the body adds nothing, whatever is broken.
fn assert_carried<const D: usize, S: Region<D>>(space: Space) {
    let system = springs::<D, S>(space);
    let n_bonds = system.bonds.len();
    let strain = SymTensor::<D>::from_fn(|i, j| 0.5 * (GRADIENT[i][j] + GRADIENT[j][i]));
    let free = StressFreeStrains::new(vec![SymTensor::<D>::isotropic(0.02); system.cloud.len()]);
    let with_free = strain.plus(&SymTensor::isotropic(-0.02));
    let (all, none) = (vec![true; n_bonds], vec![false; n_bonds]);
    let left = |it: f64| {
        let factors = StiffnessFactors {
            axial: it,
            shear: it,
            rotational: it,
        };
        vec![factors; n_bonds]
    };
    let motion = (GRADIENT, free.times(1.0));
    for share in [1.0, 0.4, 0.0] {
        let off = off(&system, motion, (&all, &left(share)), |_| {
            with_free.scaled(share)
        });
        assert!(off < 1e-13, "{share}: {off:e}");
    }
    assert_eq!(off(&system, motion, (&none, &[]), |_| SymTensor::ZERO), 0.0);
    let (intact, remaining) = damaged(n_bonds);
    let mut turned = GRADIENT;
    for (i, row) in turned.iter_mut().enumerate().take(D) {
        for (j, it) in row.iter_mut().enumerate().take(D) {
            *it += 0.5 * (i as f64 - j as f64);
        }
    }
    let layout = Layout {
        n_points: system.cloud.len(),
        components: &AXES[..D],
    };
    let displacement = affine(&system, GRADIENT);
    let still = Carried {
        motion: Motion {
            intact: &intact,
            displacement: &displacement,
            expansion: ThermalStrain::NONE,
        },
        remaining: &remaining,
        closed: &[],
    };
    let expected = |point| {
        system
            .strain_by(layout, StrainReading::Carried(still), point)
            .unwrap()
    };
    let off = off(
        &system,
        (turned, ThermalStrain::NONE),
        (&intact, &remaining),
        expected,
    );
    // Displacements of up to 12 are rounded by 2e-15, and fits in corners that lost a third of their bonds magnify that some hundred times, in
    // both readings.
    assert!(off < 1e-11, "turned: {off:e}");
}

/// Sound springs carry the forces of the damaged ones at the strain of a point, sum w (n . eps n) n (x) n = sum w phi_n (n . g) n (x) n,
/// whatever moves across them: springs resist no shear, so that there no transverse motion is a stress. Off by rounding alone, in which the
/// fits of corners magnify the transverse motions of 0.5 by their weight 1e-9.
fn assert_forces_of_springs<const D: usize, S: Region<D>>(space: Space) {
    let mut system = springs::<D, S>(space);
    system.rigidities.shear.fill(0.0);
    let layout = Layout {
        n_points: system.cloud.len(),
        components: &AXES[..D],
    };
    let (intact, remaining) = damaged(system.bonds.len());
    let displacement = affine(&system, GRADIENT);
    let carried = Carried {
        motion: Motion {
            intact: &intact,
            displacement: &displacement,
            expansion: ThermalStrain::NONE,
        },
        remaining: &remaining,
        closed: &[],
    };
    let mut largest = 0.0_f64;
    for point in 0..system.cloud.len() as u32 {
        let strain = (system.strain_by(layout, StrainReading::Carried(carried), point)).unwrap();
        let (mut off, mut size) = (SymTensor::<D>::ZERO, 0.0);
        for &bond in system.bonds.incidence.at(point) {
            let seen = system.neighbour(layout, carried.motion, point, bond);
            let sound = seen.length * dot(seen.n, strain.times(seen.n));
            let damaged = carried.factors(bond as usize).axial * dot(seen.n, seen.moved);
            let force = seen.weight_per_length * (sound - damaged);
            off = off.plus(&SymTensor::dyad(seen.n.map(|it| it * force), seen.n));
            size += seen.weight_per_length * damaged.abs();
        }
        largest = (off.components()).fold(largest, |a, b| a.max(b.abs() / size));
    }
    assert!(largest < 1e-7, "{largest:e}");
}

#[test]
fn sound_springs_carry_the_forces_of_damaged_ones() {
    assert_forces_of_springs::<2, Shape>(Space::Plane(Plane::Stress));
    assert_forces_of_springs::<3, SolidShape>(Space::Solid);
}

#[test]
fn a_damaged_point_carries_what_its_bonds_have_left() {
    assert_carried::<2, Shape>(Space::Plane(Plane::Stress));
    assert_carried::<3, SolidShape>(Space::Solid);
}
