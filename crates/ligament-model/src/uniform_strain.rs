//! Uniform strains of a body: what its bonds make of the forces that its cells give them.

use nalgebra::{Matrix3, Vector3};

use crate::correction::patch::CellForces;
use crate::deformation::Deformations;
use crate::element::Remaining;
use crate::interface::Bonds;
use crate::layout::Component;
use crate::moduli::EngineeringConstants;
use crate::system::{BondsLeft, System};
use crate::tensor::SymTensor;
use crate::thermal::{FreeStrains, ThermalStrain};

/// The strains of a free body under the forces of the three uniform strains of [`CellForces`], which have the size one.
#[derive(Debug, Clone, PartialEq)]
pub struct UniformStrains {
    /// Mean strains of the body in the basis of the three, a column for each, shape (3, 3): those of the affine motion on which the
    /// forces do the work that they do on the body. The unit matrix if the body is as stiff as its cells.
    pub mean: Matrix3<f64>,
    /// Root mean square over the bonds of what their stretch has more than in the mean strain, for each of the three.
    pub scatter: [f64; 3],
    /// The most that the stretch of a bond has more in some uniform strain of size one.
    pub largest: f64,
    /// The bond that has it.
    pub bond: usize,
}

impl UniformStrains {
    /// The strains that displacements, shape (3, n_degrees_of_freedom), give to the bonds under forces of size one. None without bonds
    /// or where the forces do no work on some uniform strain.
    pub fn measure(
        system: &dyn System<2>,
        forces: &CellForces,
        displacements: &[Vec<f64>; 3],
    ) -> Option<Self> {
        let mean = mean_strains(system, forces, displacements)?;
        let bonds = &system.bonds;
        let mut squares = [0.0; 3];
        let (mut largest, mut place) = (-1.0, None);
        for (bond, (&ends, &[a, b])) in bonds.ends.iter().zip(&bonds.direction).enumerate() {
            let uniform = mean.tr_mul(&Vector3::from(projected([a, b])));
            let mut all = 0.0;
            for (k, displacement) in displacements.iter().enumerate() {
                let [[x0, y0], [x1, y1]] = ends.map(|end| motion(system, displacement, end));
                let stretch = (a * (x1 - x0) + b * (y1 - y0)) / bonds.length[bond];
                let square = (stretch - uniform[k]).powi(2);
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

    /// Elastic constants of the body along axes at an angle (rad) to x and y, with cells of a stiffness over (eps_xx, eps_yy,
    /// gamma_xy), Pa, that is the same in all of them.
    pub fn constants(&self, stiffness: &Matrix3<f64>, angle: f64) -> Option<EngineeringConstants> {
        // From tensors of size one to gamma_xy.
        let scale = Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, std::f64::consts::SQRT_2));
        let answer = scale * self.mean * scale.try_inverse()?;
        EngineeringConstants::along(stiffness * answer.try_inverse()?, angle)
    }
}

/// Forces and moments on all degrees of freedom in the three uniform strains, shape (3, n_degrees_of_freedom), N and N m: those of the
/// cells, and what bonds across an interface have more than in the softer material.
///
/// In a uniform strain the tractions jump at an interface. The cells give the jump to the points on it, as far as bonds across are bonds of
/// the softer material, which is how they are corrected. As two halves in series they pull their ends by more, and that part of the jump
/// belongs to their ends.
pub fn loads(system: &dyn System<2>, forces: &CellForces) -> [Vec<f64>; 3] {
    let layout = system.layout();
    let basis = [
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, 0.0, std::f64::consts::SQRT_2],
    ];
    std::array::from_fn(|k| {
        let mut loads = excess_across(system, basis[k]);
        for (point, forces) in (0..).zip(forces) {
            for (component, force) in [Component::X, Component::Y].into_iter().zip(forces[k]) {
                let dof = layout.degree_of_freedom(point, component);
                dof.into_iter().for_each(|dof| loads[dof] += force);
            }
        }
        loads
    })
}

/// What bonds across an interface exert on their ends in a uniform strain (eps_xx, eps_yy, gamma_xy) more than in the softer material,
/// shape (n_degrees_of_freedom).
fn excess_across(system: &dyn System<2>, strain: [f64; 3]) -> Vec<f64> {
    // An expansion without a motion is the strain with the opposite sign.
    let strain = SymTensor::<2>::from_engineering(&strain.map(|it| -it));
    let strains = FreeStrains::new(vec![strain; system.cloud.len()]);
    let expansion = strains.times(1.0);
    excess_in(system, &system.beyond_correction, |intact, at_rest| {
        system.deformations(intact, &at_rest, expansion)
    })
}

/// What bonds exert on their ends by a part of their rigidities (n_bonds; none without an interface), shape (n_degrees_of_freedom).
/// `deformed` makes deformations of the intact bonds and the motions of a body at rest.
pub(crate) fn excess_in(
    system: &dyn Bonds,
    part: &[Remaining],
    deformed: impl FnOnce(&[bool], Vec<f64>) -> Deformations,
) -> Vec<f64> {
    let at_rest = vec![0.0; system.layout().n_degrees_of_freedom()];
    if part.is_empty() {
        return at_rest;
    }
    let intact = vec![true; part.len()];
    let left = BondsLeft {
        intact: &intact,
        remaining: part,
    };
    let deformations = deformed(&intact, at_rest);
    let sweep = system.forces(left, deformations, ThermalStrain::NONE);
    sweep.internal.values
}

/// The strains a_l of affine motions on which all three forces do the work that they do on displacements u_l: sum over m of
/// (F_k . e_m x) a_ml = F_k . u_l.
fn mean_strains(
    system: &dyn System<2>,
    forces: &CellForces,
    displacements: &[Vec<f64>; 3],
) -> Option<Matrix3<f64>> {
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let (mut of_strains, mut of_body) = (Matrix3::<f64>::zeros(), Matrix3::<f64>::zeros());
    for (point, (forces, &[x, y])) in (0..).zip(forces.iter().zip(&system.cloud.positions)) {
        let affine = [[x, 0.0], [0.0, y], [half * y, half * x]];
        for (k, [along, across]) in forces.iter().enumerate() {
            for l in 0..3 {
                let [u, v] = motion(system, &displacements[l], point);
                of_body[(k, l)] += along * u + across * v;
                of_strains[(k, l)] += along * affine[l][0] + across * affine[l][1];
            }
        }
    }
    Some(of_strains.try_inverse()? * of_body)
}

/// Stretch of a bond of this direction in the three strains.
fn projected([a, b]: [f64; 2]) -> [f64; 3] {
    [a * a, b * b, std::f64::consts::SQRT_2 * a * b]
}

fn motion(system: &dyn System<2>, displacement: &[f64], point: u32) -> [f64; 2] {
    let layout = system.layout();
    [Component::X, Component::Y].map(|component| layout.value(point, component, displacement))
}
