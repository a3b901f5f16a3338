//! Uniform strains of a body: response of its bonds to the forces of its cells.

use nalgebra::DMatrix;

use crate::cloud::PointCloud;
use crate::correction::patch::{CellForces, uniform_strains};
use crate::layout::Layout;
use crate::material::Stiffness;
use crate::moduli::EngineeringConstants;
use crate::system::UnbrokenBonds;
use crate::system::elements::System;
use crate::tensor::{SymTensor, dot, minus};
use crate::thermal::ThermalStrain;

const ROOT: f64 = std::f64::consts::SQRT_2;

/// Strains of a free body under the forces of the unit uniform strains of [`CellForces`], in the order of [`SymTensor`].
#[derive(Debug, Clone, PartialEq)]
pub struct UniformStrains {
    /// Mean strains of the body in the basis of the uniform ones, a column for each, shape (n_strains, n_strains): the strain of the affine motion on
    /// which the forces do the same work as on the body. The unit matrix if the body is as stiff as its cells.
    pub mean: DMatrix<f64>,
    /// Root mean square over the bonds of the deviation of their stretch from the stretch by the mean strain, for each strain.
    pub scatter: Vec<f64>,
    /// Largest deviation of the stretch of a bond in a uniform strain of size one.
    pub largest: f64,
    /// Bond with the largest deviation.
    pub bond: usize,
}

impl UniformStrains {
    /// Strains of the body from displacements, shape (n_strains, n_degrees_of_freedom), under the forces of unit strains. `None` without
    /// bonds or where the forces do no work on some uniform strain.
    pub fn measure<const D: usize>(
        system: &dyn System<D>,
        forces: &CellForces<D>,
        displacements: &[Vec<f64>],
    ) -> Option<Self> {
        let (bonds, layout) = (&system.bonds, system.topology().layout);
        let mean = mean_strains(&system.cloud, layout, forces, displacements)?;
        let mut squares = vec![0.0; displacements.len()];
        let (mut largest, mut place) = (-1.0, None);
        for (bond, (&ends, &n)) in bonds.ends.iter().zip(&bonds.direction).enumerate() {
            // Stretches of a bond of this direction in the unit strains.
            let projected = |&[i, j]: &[usize; 2]| match i == j {
                true => n[i] * n[j],
                false => ROOT * n[i] * n[j],
            };
            let projected = SymTensor::<D>::COMPONENTS.iter().map(projected);
            let mut all = 0.0;
            for (k, displacement) in displacements.iter().enumerate() {
                let column = mean.column(k);
                let uniform: f64 = column
                    .iter()
                    .zip(projected.clone())
                    .map(|(a, b)| a * b)
                    .sum();
                let [from, to] = ends.map(|end| motion(layout, displacement, end));
                let stretch = dot(n, minus(to, from)) / bonds.length[bond];
                let square = (stretch - uniform).powi(2);
                squares[k] += square;
                all += square;
            }
            if all > largest {
                (largest, place) = (all, Some(bond));
            }
        }
        let scatter = squares.iter().map(|sum| (sum / bonds.len() as f64).sqrt());
        Some(Self {
            mean,
            scatter: scatter.collect(),
            largest: largest.sqrt(),
            bond: place?,
        })
    }

    /// Elastic constants of the body along orthogonal axes given by their unit vectors, for cells of one stiffness, Pa.
    pub fn constants<const D: usize>(
        &self,
        stiffness: &Stiffness,
        axes: [[f64; D]; D],
    ) -> Option<EngineeringConstants<D>> {
        // Conversion from unit tensors to engineering strains.
        let places = SymTensor::<D>::COMPONENTS.iter();
        let sizes = places
            .map(|[i, j]| if i == j { 1.0 } else { ROOT })
            .collect();
        let scale = DMatrix::from_diagonal(&nalgebra::DVector::<f64>::from_vec(sizes));
        let answer = &scale * &self.mean * scale.try_inverse()?;
        EngineeringConstants::along(stiffness * answer.try_inverse()?, axes)
    }
}

/// Forces and moments on all degrees of freedom in each of the uniform strains, shape (n_strains, n_degrees_of_freedom), N and N m: those of
/// the cells, and the excess of bonds across an interface over bonds in the softer material.
///
/// In a uniform strain the tractions jump at an interface. The cells give the jump to the points on it, as far as bonds across are bonds of
/// the softer material, which is how they are corrected. As two halves in series they pull their ends by more, and that part of the jump
/// belongs to their ends.
pub fn loads<const D: usize>(system: &dyn System<D>, forces: &CellForces<D>) -> Vec<Vec<f64>> {
    let layout = system.topology().layout;
    let of_strain = |(k, strain): (usize, SymTensor<D>)| {
        let mut loads = excess_across(system, &strain);
        for (point, forces) in (0..).zip(forces.on_points()) {
            let own = &mut loads[layout.range(point)];
            for (load, force) in own.iter_mut().zip(forces[k]) {
                *load += force;
            }
        }
        loads
    };
    uniform_strains().enumerate().map(of_strain).collect()
}

/// Excess forces of bonds across an interface on their ends in a uniform strain, over bonds in the softer material, shape
/// (n_degrees_of_freedom).
fn excess_across<const D: usize>(system: &dyn System<D>, strain: &SymTensor<D>) -> Vec<f64> {
    let (cloud, beyond) = (&system.cloud, &system.beyond_correction);
    let layout = system.topology().layout;
    let mut motions = vec![0.0; layout.n_degrees_of_freedom()];
    if beyond.is_empty() {
        return motions;
    }
    // Affine motion of the strain about the middle of the body.
    for (point, &position) in (0..).zip(&cloud.positions) {
        motions[layout.range(point)][..D].copy_from_slice(&strain.times(position));
    }
    let intact = vec![true; beyond.len()];
    let left = UnbrokenBonds {
        intact: &intact,
        remaining: beyond,
    };
    let deformations = system.deformations(&intact, &motions, ThermalStrain::NONE);
    let sweep = system.forces(left, deformations, ThermalStrain::NONE);
    sweep.internal.values
}

/// Strains a_l of affine motions on which all forces do the same work as on displacements u_l: sum over m of (F_k . e_m x) a_ml = F_k . u_l.
fn mean_strains<const D: usize>(
    cloud: &PointCloud<D>,
    layout: Layout,
    forces: &CellForces<D>,
    displacements: &[Vec<f64>],
) -> Option<DMatrix<f64>> {
    let strains: Vec<SymTensor<D>> = uniform_strains().collect();
    let mut of_strains = DMatrix::<f64>::zeros(strains.len(), strains.len());
    let mut of_body = of_strains.clone();
    for (point, (forces, &position)) in (0..).zip(forces.on_points().zip(&cloud.positions)) {
        for (k, &force) in forces.iter().enumerate() {
            for (l, strain) in strains.iter().enumerate() {
                of_body[(k, l)] += dot(force, motion(layout, &displacements[l], point));
                of_strains[(k, l)] += dot(force, strain.times(position));
            }
        }
    }
    Some(of_strains.try_inverse()? * of_body)
}

/// Displacement of a point.
fn motion<const D: usize>(layout: Layout, displacement: &[f64], point: u32) -> [f64; D] {
    let own = &displacement[layout.range(point)];
    std::array::from_fn(|axis| own[axis])
}
