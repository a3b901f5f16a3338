//! Connected parts while bonds break, without a search of the whole body for every bond.
//!
//! The ends of a broken bond nearly always have a common neighbour. Two breadth-first searches therefore run from them towards each
//! other, the smaller one first: they meet after a few points, or else the one that ends first has found the detached part, at the
//! cost of that part.

use ligament_model::Bonds;
use ligament_model::topology::Families;

use super::{AddedSupport, FragmentExtent, Fragments, across_ranks};
use crate::restraints::Restraints;

/// Fragments of a body whose bonds break, numbered as by [`Fragments::find`].
#[derive(Debug, Clone)]
pub struct Connectivity {
    fragments: Fragments,
    /// Number in the body of the first point of each fragment whose points changed since [`Connectivity::missing_supports`].
    changed: Vec<u32>,
    search: Search,
}

/// Two searches from the ends of a bond towards each other.
#[derive(Debug, Clone)]
struct Search {
    /// Number of the search that reached each point, shape (n_points); [`NEITHER`] everywhere between two broken bonds.
    reached_by: Vec<u8>,
    /// Points that each search reached, in order.
    reached: [Vec<u32>; 2],
    /// Number of points reached by all searches so far.
    effort: usize,
}

/// Mark of a point that no search reached; the searches mark their points 0 and 1.
const NEITHER: u8 = 2;

impl Connectivity {
    /// Connectivity of the body with all its bonds.
    pub fn new(system: &dyn Bonds) -> Self {
        let fragments = Fragments::find(system, &vec![true; system.ends.len()]);
        Self {
            changed: fragments.extents.iter().map(|it| it.first).collect(),
            fragments,
            search: Search {
                reached_by: vec![NEITHER; system.n_points()],
                reached: [Vec::new(), Vec::new()],
                effort: 0,
            },
        }
    }

    /// Connectivity of the body with intact bonds (n_bonds), whose fragments are all supported as far as possible.
    pub(crate) fn held(system: &dyn Bonds, intact: &[bool]) -> Self {
        Self {
            fragments: Fragments::find(system, intact),
            changed: Vec::new(),
            ..Self::new(system)
        }
    }

    /// Connected parts of the body.
    pub fn fragments(&self) -> &Fragments {
        &self.fragments
    }

    /// Number of points reached by all searches so far, including both ends of every broken bond: the cost of the breakages.
    pub fn effort(&self) -> usize {
        self.search.effort
    }

    /// Removes broken bonds from the `intact` ones (n_bonds), and splits the fragments that they connected.
    ///
    /// The bonds are removed one by one, and later ones connect until their turn: where two of them split a fragment in three, each
    /// split is found. On a divided body each process removes its local bonds.
    pub fn bonds_broke(&mut self, system: &dyn Bonds, intact: &mut [bool], bonds: &[u32]) {
        for &bond in bonds {
            intact[bond as usize] = true;
        }
        let families = system.families();
        let subdomain = &system.subdomain;
        if !subdomain.is_whole() {
            let mut apart = Vec::new();
            for &bond in bonds {
                intact[bond as usize] = false;
                let ends = families.ends[bond as usize];
                if self.search.detached_part(families, intact, ends).is_some() {
                    apart.push(ends);
                }
            }
            if across_ranks::may_split(subdomain, apart) {
                self.find_again(system, intact);
            }
            return;
        }
        for &bond in bonds {
            if !std::mem::replace(&mut intact[bond as usize], false) {
                continue;
            }
            let ends = families.ends[bond as usize];
            if let Some(part) = self.search.detached_part(families, intact, ends) {
                self.fragments.split_off(part);
                let Fragments {
                    of_point, extents, ..
                } = &self.fragments;
                let parts = ends.map(|end| of_point[end as usize] as usize);
                self.changed.extend(parts.map(|part| extents[part].first));
            }
        }
    }

    /// Finds all fragments anew, and marks those that are parts of earlier ones.
    fn find_again(&mut self, system: &dyn Bonds, intact: &[bool]) {
        let found = Fragments::find(system, intact);
        let before = std::mem::replace(&mut self.fragments, found);
        let is_part = |extent: &&FragmentExtent| !before.extents.contains(extent);
        let parts = self.fragments.extents.iter().filter(is_part);
        self.changed.extend(parts.map(|extent| extent.first));
    }

    /// Degrees of freedom to fix so that no fragment can move rigidly, with the arguments of [`Fragments::missing_supports`]. Collective.
    ///
    /// Only fragments whose points changed since the last call are checked, at first all. The others are already supported as far
    /// as possible: their rigid motions depend on their points alone, and fixed degrees of freedom stay fixed.
    pub fn missing_supports(
        &mut self,
        system: &dyn Bonds,
        restraints: &Restraints,
        is_fixed: impl Fn(usize) -> bool,
        can_hold: impl Fn(usize) -> bool,
    ) -> Vec<AddedSupport> {
        let extents = &self.fragments.extents;
        let fragment = |first: u32| extents.partition_point(|it| it.first < first) as u32;
        let mut changed: Vec<u32> = self.changed.drain(..).map(fragment).collect();
        changed.sort_unstable();
        changed.dedup();
        self.fragments
            .missing_supports(changed, system, restraints, is_fixed, can_hold)
    }
}

impl Search {
    /// Points connected with one of two points, if the two are no longer connected.
    fn detached_part(
        &mut self,
        families: Families<'_>,
        intact: &[bool],
        ends: [u32; 2],
    ) -> Option<Vec<u32>> {
        let part = self
            .ended(families, intact, ends)
            .map(|side| self.reached[side].clone());
        for reached in &mut self.reached {
            self.effort += reached.len();
            for point in reached.drain(..) {
                self.reached_by[point as usize] = NEITHER;
            }
        }
        part
    }

    /// Search that ended; None if the two met.
    fn ended(&mut self, families: Families<'_>, intact: &[bool], ends: [u32; 2]) -> Option<usize> {
        for (side, end) in ends.into_iter().enumerate() {
            self.reach(side, end);
        }
        let mut next = [0; 2];
        loop {
            let side = usize::from(self.reached[1].len() < self.reached[0].len());
            let Some(&point) = self.reached[side].get(next[side]) else {
                return Some(side);
            };
            next[side] += 1;
            for neighbour in families.connected(point, intact) {
                match self.reached_by[neighbour as usize] {
                    NEITHER => self.reach(side, neighbour),
                    by if usize::from(by) != side => return None,
                    _ => {}
                }
            }
        }
    }

    fn reach(&mut self, side: usize, point: u32) {
        self.reached_by[point as usize] = side as u8;
        self.reached[side].push(point);
    }
}
