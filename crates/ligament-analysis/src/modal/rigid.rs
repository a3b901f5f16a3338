//! Rigid motions of the fragments of a body, as far as supports leave them.

use ligament_model::Bonds;

use super::masses::{Masses, inner};
use crate::connectivity::Fragments;
use crate::supports::Supports;

/// A part of a motion that is smaller than this lies in those before it, but for rounding.
const DEPENDENT: f64 = 1e-8;

/// Rigid motions that are possible.
pub(super) struct RigidMotions {
    /// How many there are.
    pub(super) count: usize,
    /// The first of them, as far as they are wanted: orthonormal with the masses, each of shape (n_degrees_of_freedom).
    pub(super) shapes: Vec<Vec<f64>>,
}

/// The rigid motions of all fragments in their order, and the shapes of the first `wanted`.
pub(super) fn motions(
    system: &dyn Bonds,
    supports: &Supports,
    masses: &Masses,
    wanted: usize,
) -> RigidMotions {
    let layout = system.layout();
    let fragments = Fragments::find(system, &vec![true; system.ends().len()]);
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
