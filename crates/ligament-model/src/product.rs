//! Matrix-free product of the stiffness with a vector, in one sweep over the bonds.
//!
//! Iterative solvers need it several times per bond breakage. The result does not depend on the number of threads: the bonds are divided
//! into fixed parts, those of a part are summed by one thread in their order, and the parts one after another.

use std::ops::Range;

use rayon::prelude::*;

use crate::element::{Element, Elements};
use crate::system::{ElementSystem, UnbrokenBonds};

/// Number of parts into which the bonds are divided; fixed, so that the order of summation is fixed. Each part but the first adds to forces
/// of its own at all points.
const PARTS: usize = 4;

/// Number of points that make a task worth while.
const TASK: usize = 2048;

/// Sums forces at points with M components over bonds that are divided into fixed parts: `add` adds those of a range of bonds to the forces
/// of all points. The result overwrites `forces` (M n_points).
fn over_parts<const M: usize>(
    n_bonds: usize,
    forces: &mut [f64],
    add: impl Fn(Range<usize>, &mut [[f64; M]]) + Sync,
) {
    let (of_points, _) = forces.as_chunks_mut::<M>();
    let range = |part: usize| part * n_bonds / PARTS..(part + 1) * n_bonds / PARTS;
    let mut others = vec![vec![[0.0; M]; of_points.len()]; PARTS - 1];
    rayon::scope(|scope| {
        for (part, sums) in (1..).zip(&mut others) {
            let add = &add;
            scope.spawn(move |_| add(range(part), sums));
        }
        of_points.fill([0.0; M]);
        add(range(0), of_points);
    });
    of_points
        .par_iter_mut()
        .with_min_len(TASK)
        .enumerate()
        .for_each(|(point, sum)| {
            for part in &others {
                for (sum, value) in sum.iter_mut().zip(part[point]) {
                    *sum += value;
                }
            }
        });
}

/// Adds a force to a sum.
#[inline(always)]
fn add_to<const M: usize>(sum: &mut [f64; M], force: [f64; M]) {
    *sum = std::array::from_fn(|place| sum[place] + force[place]);
}

impl<const D: usize, const M: usize, E: Elements<D, M>> ElementSystem<D, M, E> {
    /// Product of the stiffness of the unbroken bonds with motions, shape (M n_points) both.
    pub(crate) fn multiply(&self, bonds: UnbrokenBonds<'_>, motions: &[f64], forces: &mut [f64]) {
        over_parts::<M>(self.system.bonds.len(), forces, |of_part, sums| {
            for bond in of_part {
                if let Some(element) = self.left(bonds, bond) {
                    element.forces(&element.deformation(motions), |point, force| {
                        add_to(&mut sums[point as usize], force);
                    });
                }
            }
        });
    }
}
