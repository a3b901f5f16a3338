//! Connected parts of a body, and the supports of their rigid motions.
//!
//! Rounding hides a detached part: a factorisation of its singular matrix may well succeed. Detached parts are therefore found
//! combinatorially. Connectivity alone is not enough (half a disk may be supported along y only): for every fragment the rank of
//! its fixed degrees of freedom on its energy-free rigid motions decides, and only the missing motions are fixed.

mod across_ranks;
pub mod decremental;

use ligament_model::Bonds;

use crate::restraints::{self, Restraints};

/// Connected parts of a body.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fragments {
    /// Fragment of each point, shape (n_points); numbered in the order of their first points.
    pub of_point: Vec<u32>,
    /// Points of each fragment, ascending.
    pub points: Vec<Vec<u32>>,
}

/// Added support of an unsupported rigid motion of a fragment.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct AddedSupport {
    /// Degree of freedom that is fixed.
    pub degree_of_freedom: usize,
    /// Fragment of the degree of freedom.
    pub fragment: u32,
}

impl Fragments {
    /// Finds the parts connected by intact bonds; collective on a divided body.
    pub fn find(system: &dyn Bonds, intact: &[bool]) -> Self {
        let whole = Self::of_first_points(&vec![0; system.n_points()]);
        whole.parted(system, intact)
    }

    /// Splits these parts into those connected by intact bonds; collective on a divided body.
    fn parted(&self, system: &dyn Bonds, intact: &[bool]) -> Self {
        let before = (&*self.of_point, &*self.points);
        Self::of_first_points(&across_ranks::parted(system, intact, before))
    }

    /// Fragments from the first point of the fragment of each point, shape (n_points).
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

    /// Degrees of freedom to fix so that none of the given fragments can move rigidly.
    ///
    /// `is_fixed` returns whether a degree of freedom is prescribed by supports, loads or earlier added supports; `can_hold`
    /// whether it has a stiffness.
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

    /// Energy-free rigid motions of a fragment that no fixed degree of freedom prevents: displacements and rotations of its points
    /// in each of them, shape (motions, degrees of freedom of the points).
    pub fn free_motions(
        &self,
        fragment: usize,
        system: &dyn Bonds,
        is_fixed: impl Fn(usize) -> bool,
    ) -> Vec<Vec<f64>> {
        system.free_shapes(&self.points[fragment], &is_fixed)
    }

    /// Splits a part off its fragment; both are numbered in the order of their first points.
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
