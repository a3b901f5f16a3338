//! Uniform strains of a body in space: what its bonds make of the forces that its cells give them.

use nalgebra::{Matrix6, Vector6};

use super::correction::patch::{SolidCellForces, force_in};
use crate::system::System;
use crate::material::Isotropic;
use crate::thermal::ThermalStrain;
use crate::uniform_strain::excess_in;

const HALF: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// The six uniform strains (xx, yy, zz, xy, xz, yz), orthonormal as tensors.
const STRAINS: [[f64; 6]; 6] = [
    [1.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [0.0, 1.0, 0.0, 0.0, 0.0, 0.0],
    [0.0, 0.0, 1.0, 0.0, 0.0, 0.0],
    [0.0, 0.0, 0.0, HALF, 0.0, 0.0],
    [0.0, 0.0, 0.0, 0.0, HALF, 0.0],
    [0.0, 0.0, 0.0, 0.0, 0.0, HALF],
];

/// The strains of a free body under the forces of the six uniform strains, which have the size one.
#[derive(Debug, Clone, PartialEq)]
pub struct SolidUniformStrains {
    /// Mean strains of the body in the basis of the six, a column for each, shape (6, 6): those of the affine motion on which the forces
    /// do the work that they do on the body. The unit matrix if the body is as stiff as its cells.
    pub mean: Matrix6<f64>,
    /// Root mean square over the bonds of what their stretch has more than in the mean strain, for each of the six.
    pub scatter: [f64; 6],
    /// The most that the stretch of a bond has more in some uniform strain of size one.
    pub largest: f64,
    /// The bond that has it.
    pub bond: usize,
}

/// Elastic constants of a body along its axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SolidConstants {
    /// Young's moduli along x, y and z, Pa.
    pub young: [f64; 3],
    /// Poisson's ratios -eps_b/eps_a of the stress along a, for (a, b) = xy, xz, yx, yz, zx, zy.
    pub poisson: [f64; 6],
    /// Shear moduli in xy, xz and yz, Pa.
    pub shear_modulus: [f64; 3],
}

impl SolidUniformStrains {
    /// The strains that displacements, shape (6, n_degrees_of_freedom), give to the bonds under forces of size one. None without bonds
    /// or where the forces do no work on some uniform strain.
    pub fn measure(
        system: &dyn System<3>,
        forces: &SolidCellForces,
        displacements: &[Vec<f64>; 6],
    ) -> Option<Self> {
        let mean = mean_strains(system, forces, displacements)?;
        let bonds = &system.bonds;
        let mut squares = [0.0; 6];
        let (mut largest, mut place) = (-1.0, None);
        for (bond, (&ends, &n)) in bonds.ends.iter().zip(&bonds.direction).enumerate() {
            let uniform = mean.tr_mul(&Vector6::from(projected(n)));
            let mut all = 0.0;
            for (k, displacement) in displacements.iter().enumerate() {
                let [from, to] = ends.map(|end| motion(system, displacement, end));
                let along: f64 = (0..3).map(|axis| n[axis] * (to[axis] - from[axis])).sum();
                let square = (along / bonds.length[bond] - uniform[k]).powi(2);
                squares[k] += square;
                all += square;
            }
            if all > largest {
                (largest, place) = (all, Some(bond));
            }
        }
        Some(Self {
            mean,
            scatter: squares.map(|sum| (sum / bonds.len() as f64).sqrt()),
            largest: largest.sqrt(),
            bond: place?,
        })
    }

    /// Elastic constants of the body, with cells of one material.
    pub fn constants(&self, material: &Isotropic) -> Option<SolidConstants> {
        let Isotropic { young, poisson } = *material;
        // Compliance over orthonormal strains and stresses: that of the body is the mean strains times that of its cells.
        let mut compliance = Matrix6::from_diagonal_element((1.0 + poisson) / young);
        for row in 0..3 {
            for column in 0..3 {
                compliance[(row, column)] -= poisson / young;
            }
        }
        let of_body = self.mean * compliance;
        let ratio = |[a, b]: [usize; 2]| -of_body[(b, a)] / of_body[(a, a)];
        let constants = SolidConstants {
            young: [0, 1, 2].map(|axis| 1.0 / of_body[(axis, axis)]),
            poisson: [[0, 1], [0, 2], [1, 0], [1, 2], [2, 0], [2, 1]].map(ratio),
            shear_modulus: [3, 4, 5].map(|axis| 0.5 / of_body[(axis, axis)]),
        };
        let all = constants.young.iter().chain(&constants.shear_modulus);
        all.into_iter()
            .all(|it| it.is_finite())
            .then_some(constants)
    }
}

/// Forces and moments on all degrees of freedom in the six uniform strains, shape (6, n_degrees_of_freedom), N and N m: those of the
/// cells, and what bonds across an interface have more than in the softer material, as in the [plane](crate::uniform_strain::loads).
pub fn loads(system: &dyn System<3>, forces: &SolidCellForces) -> [Vec<f64>; 6] {
    let layout = system.layout();
    STRAINS.map(|strain| {
        let mut loads = excess_across(system, strain);
        for (point, forces) in (0..).zip(forces) {
            let own = &mut loads[layout.range(point)];
            for (load, force) in own.iter_mut().zip(force_in(forces, strain)) {
                *load += force;
            }
        }
        loads
    })
}

/// What bonds across an interface exert on their ends in a uniform strain more than in the softer material, shape
/// (n_degrees_of_freedom).
fn excess_across(system: &dyn System<3>, [xx, yy, zz, xy, xz, yz]: [f64; 6]) -> Vec<f64> {
    let rows = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
    let layout = system.layout();
    excess_in(system, &system.beyond_correction, |intact, mut motions| {
        // The motion of the strain itself about the middle of the body.
        for (point, position) in (0..).zip(&system.cloud.positions) {
            for (value, row) in motions[layout.range(point)].iter_mut().zip(rows) {
                *value = row.iter().zip(position).map(|(part, x)| part * x).sum();
            }
        }
        system.deformations(intact, &motions, ThermalStrain::NONE)
    })
}

/// The strains a_l of affine motions on which all six forces do the work that they do on displacements u_l: sum over m of
/// (F_k . e_m x) a_ml = F_k . u_l.
fn mean_strains(
    system: &dyn System<3>,
    forces: &SolidCellForces,
    displacements: &[Vec<f64>; 6],
) -> Option<Matrix6<f64>> {
    let (mut of_strains, mut of_body) = (Matrix6::<f64>::zeros(), Matrix6::<f64>::zeros());
    let product = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    for (point, (forces, &[x, y, z])) in (0..).zip(forces.iter().zip(&system.cloud.positions)) {
        let affine = [
            [x, 0.0, 0.0],
            [0.0, y, 0.0],
            [0.0, 0.0, z],
            [HALF * y, HALF * x, 0.0],
            [HALF * z, 0.0, HALF * x],
            [0.0, HALF * z, HALF * y],
        ];
        for (k, strain) in STRAINS.into_iter().enumerate() {
            let force = force_in(forces, strain);
            for l in 0..6 {
                of_body[(k, l)] += product(force, motion(system, &displacements[l], point));
                of_strains[(k, l)] += product(force, affine[l]);
            }
        }
    }
    Some(of_strains.try_inverse()? * of_body)
}

/// Stretch of a bond of this direction in the six strains.
fn projected([a, b, c]: [f64; 3]) -> [f64; 6] {
    let root = std::f64::consts::SQRT_2;
    [
        a * a,
        b * b,
        c * c,
        root * a * b,
        root * a * c,
        root * b * c,
    ]
}

/// Displacement of a point.
fn motion(system: &dyn System<3>, displacement: &[f64], point: u32) -> [f64; 3] {
    let own = &displacement[system.layout().range(point)];
    [own[0], own[1], own[2]]
}
