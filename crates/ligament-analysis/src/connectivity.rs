//! Which points hang together, and whether something holds them.
//!
//! Rounding hides a body that came loose: a factorisation of its singular matrix may well succeed. So the question is
//! settled combinatorially. Connectivity alone is not enough (half a disk may be held along y only): for every fragment
//! the rank of its held degrees of freedom on the rigid motions that cost no energy decides, and just the missing motions
//! are held.

mod across_ranks;
pub mod decremental;

use ligament_model::Bonds;

use crate::restraints::{self, Restraints};

/// The connected parts of a body.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fragments {
    /// Fragment of each point, shape (n_points); numbered in the order of their first points.
    pub of_point: Vec<u32>,
    /// Points of each fragment, ascending.
    pub points: Vec<Vec<u32>>,
}

/// A rigid motion of a fragment that nothing held any more.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct AddedSupport {
    /// Degree of freedom that is held from now on.
    pub degree_of_freedom: usize,
    /// Fragment that it belongs to.
    pub fragment: u32,
}

impl Fragments {
    /// Parts connected by intact bonds; where processes share the body out all of them ask for it.
    pub fn find(system: &dyn Bonds, intact: &[bool]) -> Self {
        let whole = Self::of_first_points(&vec![0; system.n_points()]);
        whole.parted(system, intact)
    }

    /// The parts that intact bonds leave of these, where processes share the body out.
    fn parted(&self, system: &dyn Bonds, intact: &[bool]) -> Self {
        let before = (&*self.of_point, &*self.points);
        Self::of_first_points(&across_ranks::parted(system, intact, before))
    }

    /// Fragments by the first point of that of each point.
    fn of_first_points(firsts: &[u32]) -> Self {
        let mut of_point: Vec<u32> = Vec::with_capacity(firsts.len());
        let mut points: Vec<Vec<u32>> = Vec::new();
        for (point, &first) in firsts.iter().enumerate() {
            let fragment = match first as usize {
                first if first == point => {
                    points.push(Vec::new());
                    points.len() as u32 - 1
                }
                first => of_point[first],
            };
            of_point.push(fragment);
            points[fragment as usize].push(point as u32);
        }
        Self { of_point, points }
    }

    /// The degrees of freedom to hold so that none of the given fragments can move rigidly.
    ///
    /// `is_fixed` tells what supports, loads and earlier holds prescribe; `can_hold` what has a stiffness.
    pub fn missing_supports(
        &self,
        fragments: impl IntoIterator<Item = u32>,
        system: &dyn Bonds,
        restraints: &Restraints,
        is_fixed: impl Fn(usize) -> bool,
        can_hold: impl Fn(usize) -> bool,
    ) -> Vec<AddedSupport> {
        let of_fragment = |fragment: u32| {
            let points = &self.points[fragment as usize];
            let found =
                restraints::missing_supports(system, restraints, points, &is_fixed, &can_hold);
            found
                .into_iter()
                .map(move |degree_of_freedom| AddedSupport {
                    degree_of_freedom,
                    fragment,
                })
        };
        fragments.into_iter().flat_map(of_fragment).collect()
    }

    /// The rigid motions of a fragment that cost no energy and that no fixed degree of freedom prevents: displacements and
    /// rotations of its points in each of them, shape (motions, degrees of freedom of the points).
    pub fn free_motions(
        &self,
        fragment: usize,
        system: &dyn Bonds,
        is_fixed: impl Fn(usize) -> bool,
    ) -> Vec<Vec<f64>> {
        system.free_shapes(&self.points[fragment], &is_fixed)
    }

    /// Makes a fragment of a part of one; both keep the order of their first points among the others.
    fn split_off(&mut self, mut part: Vec<u32>) {
        part.sort_unstable();
        let rest = &mut self.points[self.of_point[part[0] as usize] as usize];
        let mut leaving = part.iter().peekable();
        rest.retain(|point| leaving.next_if_eq(&point).is_none());
        // The part with the first point keeps the number.
        if part[0] < rest[0] {
            std::mem::swap(&mut part, rest);
        }
        let number = self.points.partition_point(|points| points[0] < part[0]);
        for fragment in &mut self.of_point {
            *fragment += u32::from(*fragment >= number as u32);
        }
        for &point in &part {
            self.of_point[point as usize] = number as u32;
        }
        self.points.insert(number, part);
    }
}
