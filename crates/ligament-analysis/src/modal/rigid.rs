//! Rigid motions of the fragments of a body that supports permit.

use ligament_model::Bonds;

use super::masses::{Masses, inner};
use crate::connectivity::Fragments;
use crate::supports::Supports;

/// Relative size of a motion, after removal of its components along others, below which it depends on them.
const DEPENDENT: f64 = 1e-8;

/// Rigid motions permitted by supports.
pub(super) struct RigidMotions {
    /// Number of rigid motions.
    pub(super) count: usize,
    /// Shapes of the first rigid motions up to the wanted number, orthonormal with the masses, each of shape
    /// (n_degrees_of_freedom).
    pub(super) shapes: Vec<Vec<f64>>,
}

/// Rigid motions of all fragments in order, with the shapes of the first `wanted`.
pub(super) fn motions(
    system: &dyn Bonds,
    supports: &Supports,
    masses: &Masses,
    wanted: usize,
) -> RigidMotions {
    let layout = system.layout;
    let fragments = Fragments::find(system, &vec![true; system.ends.len()]);
    let mut motions = RigidMotions {
        count: 0,
        shapes: Vec::new(),
    };
    for (fragment, points) in fragments.points.iter().enumerate() {
        let mut of_fragment: Vec<Vec<f64>> = Vec::new();
        for motion in fragments.free_motions(fragment, system, |dof| supports.held[dof]) {
            let mut shape = vec![0.0; supports.held.len()];
            for (values, &point) in motion.chunks(layout.components.len()).zip(points) {
                shape[layout.range(point)].copy_from_slice(values);
            }
            masses.clear_known(&mut shape);
            let size = inner(masses.of_dof(), &shape, &shape).sqrt();
            masses.remove(&of_fragment, &mut shape);
            let rest = inner(masses.of_dof(), &shape, &shape).sqrt();
            if rest > DEPENDENT * size {
                shape.iter_mut().for_each(|value| *value /= rest);
                of_fragment.push(shape);
            }
        }
        motions.count += of_fragment.len();
        let room = wanted - motions.shapes.len();
        motions.shapes.extend(of_fragment.into_iter().take(room));
    }
    motions
}
