//! Forces of bonds that are linear in the displacements, in one sweep over the bonds that stores no deformation.
//!
//! Iterative solvers need the product of the stiffness with a vector several times per bond breakage; explicit motion needs it in every time
//! step, with the bonds that come near their limits. The result does not depend on the number of threads: the bonds are divided into fixed
//! parts, those of a part are summed by one thread in their order, and the parts one after another.

use std::ops::Range;

use rayon::prelude::*;

use crate::deformation::Deformation;
use crate::element::{Element, Elements};
use crate::failure::{Criteria, Measure};
use crate::system::{ElementSystem, UnbrokenBonds};

/// Number of parts into which the bonds are divided; fixed, so that the order of summation is fixed. Each part but the first adds to forces
/// of its own at all points.
const PARTS: usize = 4;

/// Number of points that make a task worth while.
const TASK: usize = 2048;

/// Sum of the forces of the bonds, with reusable memory for the parts of the bonds.
#[derive(Debug, Clone, Default)]
pub struct ForceSum {
    /// Sum of the end forces at each degree of freedom, shape (n_degrees_of_freedom), N and N m.
    pub values: Vec<f64>,
    /// Forces of all parts but the first, shape (n_parts - 1, n_degrees_of_freedom).
    others: Vec<Vec<f64>>,
}

impl ForceSum {
    /// Zero forces at degrees of freedom.
    pub fn new(n_degrees_of_freedom: usize) -> Self {
        Self {
            values: vec![0.0; n_degrees_of_freedom],
            others: vec![vec![0.0; n_degrees_of_freedom]; PARTS - 1],
        }
    }
}

/// Limits near which a sweep finds bonds.
#[derive(Debug, Clone, Copy)]
pub struct NearLimits<'a> {
    /// Criteria of which no limit or measure follows the surroundings of the bonds.
    pub criteria: &'a Criteria,
    /// Measure times this factor that comes to the limit, 1 or a little more.
    pub factor: f64,
}

/// Judge of deformations of bonds.
trait Judge: Sync {
    /// Whether a bond is near a limit.
    fn is_near(&self, bond: usize, deformation: &impl Deformation) -> bool;
}

/// Bonds without limits.
struct Unlimited;

impl Judge for Unlimited {
    #[inline(always)]
    fn is_near(&self, _: usize, _: &impl Deformation) -> bool {
        false
    }
}

/// Bonds with a limit (n_bonds) of their stretch alone, which needs no other strain.
struct OfStretch<'a> {
    limit: &'a [f64],
    factor: f64,
}

impl Judge for OfStretch<'_> {
    #[inline(always)]
    fn is_near(&self, bond: usize, deformation: &impl Deformation) -> bool {
        deformation.measured().stretch() * self.factor >= self.limit[bond]
    }
}

impl Judge for NearLimits<'_> {
    #[inline(always)]
    fn is_near(&self, bond: usize, deformation: &impl Deformation) -> bool {
        let measured = deformation.measured();
        let mut criteria = self.criteria.list.iter();
        criteria.any(|it| {
            let measure = it.measure(bond, &measured);
            measure > 0.0 && measure * self.factor >= it.break_limit(bond)
        })
    }
}

impl<'a> NearLimits<'a> {
    /// The limits (n_bonds) of the only criterion, where that is a brittle one of the stretch.
    fn of_stretch(&self) -> Option<OfStretch<'a>> {
        let [only] = &*self.criteria.list else {
            return None;
        };
        let is_of_stretch = only.measure == Measure::Tension && only.after.is_brittle();
        let Self { factor, .. } = *self;
        let limit = &*only.limit;
        is_of_stretch.then_some(OfStretch { limit, factor })
    }
}

/// Sums forces at points with M components over bonds that are divided into fixed parts: `add` adds those of a range of bonds to the forces
/// of all points. The result overwrites `forces` (M n_points). Returns what `add` returned for each part, in order.
fn over_parts<const M: usize, T: Send>(
    n_bonds: usize,
    forces: &mut [f64],
    others: &mut [Vec<f64>],
    add: impl Fn(Range<usize>, &mut [[f64; M]]) -> T + Sync,
) -> Vec<T> {
    let range = |part: usize| part * n_bonds / PARTS..(part + 1) * n_bonds / PARTS;
    let first = std::iter::once(&mut *forces);
    let sums: Vec<&mut [f64]> = first
        .chain(others.iter_mut().map(Vec::as_mut_slice))
        .collect();
    let results = (sums.into_par_iter().enumerate())
        .map(|(part, sums)| {
            let (of_points, _) = sums.as_chunks_mut::<M>();
            of_points.fill([0.0; M]);
            add(range(part), of_points)
        })
        .collect();
    let (of_points, _) = forces.as_chunks_mut::<M>();
    of_points
        .par_iter_mut()
        .with_min_len(TASK)
        .enumerate()
        .for_each(|(point, sum)| {
            for part in &*others {
                let (of_points, _) = part.as_chunks::<M>();
                add_to(sum, of_points[point]);
            }
        });
    results
}

/// Adds a force to a sum.
#[inline(always)]
fn add_to<const M: usize>(sum: &mut [f64; M], force: [f64; M]) {
    *sum = std::array::from_fn(|place| sum[place] + force[place]);
}

impl<const D: usize, const M: usize, E: Elements<D, M>> ElementSystem<D, M, E> {
    /// Product of the stiffness of the unbroken bonds with motions, shape (M n_points) both.
    pub(crate) fn multiply(&self, bonds: UnbrokenBonds<'_>, motions: &[f64], forces: &mut [f64]) {
        let mut others = vec![vec![0.0; forces.len()]; PARTS - 1];
        self.swept(bonds, motions, &Unlimited, (forces, &mut others));
    }

    /// Product of the stiffness of the unbroken bonds with motions (M n_points), and the unbroken bonds near their limits, ascending.
    pub(crate) fn forces_near_limits(
        &self,
        bonds: UnbrokenBonds<'_>,
        motions: &[f64],
        limits: NearLimits<'_>,
        sum: &mut ForceSum,
    ) -> Vec<u32> {
        let sums = (&mut *sum.values, &mut *sum.others);
        match (limits.criteria.list.is_empty(), limits.of_stretch()) {
            (true, _) => self.swept(bonds, motions, &Unlimited, sums),
            (false, Some(of_stretch)) => self.swept(bonds, motions, &of_stretch, sums),
            (false, None) => self.swept(bonds, motions, &limits, sums),
        }
    }

    /// Sums the forces over the bonds, and returns those near their limits.
    fn swept(
        &self,
        bonds: UnbrokenBonds<'_>,
        motions: &[f64],
        judge: &impl Judge,
        (forces, others): (&mut [f64], &mut [Vec<f64>]),
    ) -> Vec<u32> {
        let near = over_parts::<M, _>(self.system.bonds.len(), forces, others, |of_part, sums| {
            let mut near = Vec::new();
            for bond in of_part {
                if let Some(element) = self.left(bonds, bond) {
                    let deformation = element.deformation(motions);
                    if judge.is_near(bond, &deformation) {
                        near.push(bond as u32);
                    }
                    element.forces(&deformation, |point, force| {
                        add_to(&mut sums[point as usize], force);
                    });
                }
            }
            near
        });
        near.concat()
    }
}
