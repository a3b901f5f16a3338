//! Connected parts of a body, and the supports of their rigid motions.
//!
//! Rounding hides a detached part: a factorisation of its singular matrix may well succeed. Detached parts are therefore found
//! combinatorially. Connectivity alone is not enough (half a disk may be supported along y only): for every fragment the rank of
//! its fixed degrees of freedom on its energy-free rigid motions decides, and only the missing motions are fixed.

mod across_ranks;
pub mod decremental;

use ligament_model::Bonds;
use ligament_model::connected::first_points;

use crate::restraints::{self, Restraints};

/// Connected parts of a body.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fragments {
    /// Fragment of each point, shape (n_points); numbered in the order of their first points.
    pub of_point: Vec<u32>,
    /// Owned points of each fragment, ascending.
    pub points: Vec<Vec<u32>>,
    /// First point and size of each fragment.
    pub extents: Vec<FragmentExtent>,
}

/// First point and size of a fragment, over all processes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FragmentExtent {
    /// Number in the body of the first point.
    pub first: u32,
    /// Number of points.
    pub n_points: usize,
}

/// Added support of an unsupported rigid motion of a fragment.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct AddedSupport {
    /// Degree of freedom of the body that is fixed.
    pub degree_of_freedom: usize,
    /// Fragment of the degree of freedom.
    pub fragment: u32,
}

impl Fragments {
    /// Finds the parts connected by intact bonds; collective on a divided body.
    pub fn find(system: &dyn Bonds, intact: &[bool]) -> Self {
        let subdomain = &system.subdomain;
        let bonds = system.ends.iter().zip(intact);
        let bonds = bonds.filter(|(_, intact)| **intact).map(|(ends, _)| *ends);
        let far = system.far_field.iter();
        let elements = far.flat_map(|far| {
            let points = 0..system.n_points() as u32;
            points.flat_map(move |point| far.at(point).map(move |other| [point, other]))
        });
        let first_of_each = first_points(subdomain, bonds.chain(elements));
        let first_of = |point: u32| first_of_each[point as usize];
        let mut here: Vec<u32> = subdomain.owned().map(first_of).collect();
        here.sort_unstable();
        here.dedup();
        let mut firsts = subdomain.all_gather_list(here.iter().map(|&it| [it]).collect());
        firsts.sort_unstable();
        firsts.dedup();
        let fragment = |first: &u32| firsts.partition_point(|[it]| it < first);
        let of_point: Vec<u32> = first_of_each.iter().map(|it| fragment(it) as u32).collect();
        let mut points: Vec<Vec<u32>> = vec![Vec::new(); firsts.len()];
        for point in subdomain.owned() {
            points[of_point[point as usize] as usize].push(point);
        }
        let mut sizes: Vec<f64> = points.iter().map(|points| points.len() as f64).collect();
        subdomain.all_reduce_sum(&mut sizes);
        let extents = firsts.iter().zip(sizes);
        let extents = extents.map(|(&[first], size)| FragmentExtent {
            first,
            n_points: size as usize,
        });
        Self {
            of_point,
            points,
            extents: extents.collect(),
        }
    }

    /// Number of fragments.
    pub fn len(&self) -> usize {
        self.extents.len()
    }

    /// Whether the body has no points.
    pub fn is_empty(&self) -> bool {
        self.extents.is_empty()
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
    /// in each of them, shape (motions, degrees of freedom of the points). Collective.
    pub fn free_motions(
        &self,
        fragment: usize,
        system: &dyn Bonds,
        is_fixed: impl Fn(usize) -> bool,
    ) -> Vec<Vec<f64>> {
        let points = &self.points[fragment];
        system.free_shapes(points, &is_fixed, &|_| false).motions
    }

    /// Splits a part off its fragment, for a body on one process; both are numbered in the order of their first points.
    fn split_off(&mut self, mut part: Vec<u32>) {
        part.sort_unstable();
        let fragment = self.of_point[part[0] as usize] as usize;
        let rest = &mut self.points[fragment];
        let mut leaving = part.iter().peekable();
        rest.retain(|point| leaving.next_if_eq(&point).is_none());
        // The part with the first point keeps the number.
        if part[0] < rest[0] {
            std::mem::swap(&mut part, rest);
        }
        self.extents[fragment] = FragmentExtent::whole(rest);
        let number = self.points.partition_point(|points| points[0] < part[0]);
        for fragment in &mut self.of_point {
            *fragment += u32::from(*fragment >= number as u32);
        }
        for &point in &part {
            self.of_point[point as usize] = number as u32;
        }
        self.extents.insert(number, FragmentExtent::whole(&part));
        self.points.insert(number, part);
    }
}

impl FragmentExtent {
    /// First point and size of a fragment whose points are all known.
    fn whole(points: &[u32]) -> Self {
        Self {
            first: points[0],
            n_points: points.len(),
        }
    }
}
