//! Parts that have bonds of the ends of a bond, on which the stress around it depends.

use ligament_model::Bonds;

use super::borders::Bounds;
use super::division::Division;
use super::per_norm;
use crate::problem::Problem;

/// Parts around points, and points around parts.
pub(super) struct Reach {
    /// Parts of the bonds of each point, ascending for each.
    parts: Vec<u32>,
    /// Index of the first part of each point, shape (n_points + 1).
    starts: Vec<usize>,
    /// Points outside each part and its descendants that have bonds into them, ascending.
    borders: Vec<Vec<u32>>,
    /// Parts outside each part and its descendants that have bonds of the points of its border, or of neighbours of these, ascending.
    beside: Vec<Vec<u32>>,
}

impl Reach {
    /// Parts around the points of a body; None where a strain around a bond has no bound, because a bond resists no shear or no rotation.
    pub(super) fn new(problem: &Problem, division: &Division, bounds: &Bounds) -> Option<Self> {
        let system = &*problem.system;
        let whole = vec![true; division.part_of_bond.len()];
        let points: Vec<u32> = (0..system.n_points() as u32).collect();
        let mut stored = system.stored_motions()?;
        stored.update_bounds(&whole, &points);
        let has_bound = |bond: u32| {
            stored
                .strain_per_norm(bond)
                .is_none_or(|it| it.lateral.is_finite())
        };
        if !(0..whole.len() as u32).all(has_bound) {
            return None;
        }
        let (mut parts, mut starts) = (Vec::new(), vec![0]);
        for &point in &points {
            let bonds = system.incidence.at(point).iter();
            let mut here: Vec<u32> = bonds
                .map(|&bond| division.part_of_bond[bond as usize])
                .collect();
            here.sort_unstable();
            here.dedup();
            parts.extend(here);
            starts.push(parts.len());
        }
        let layout = system.layout;
        let border = |part: usize| {
            let dofs = bounds.border(part).iter();
            let mut points: Vec<u32> = dofs.map(|&dof| layout.point(dof as usize)).collect();
            points.dedup();
            points
        };
        let mut reach = Self {
            parts,
            starts,
            borders: (0..division.parts.len()).map(border).collect(),
            beside: Vec::new(),
        };
        let beside =
            (0..division.parts.len()).map(|part| reach.found_beside(system, division, part));
        reach.beside = beside.collect();
        Some(reach)
    }

    /// Parts of the bonds of a point, ascending.
    pub(super) fn parts_at(&self, point: u32) -> &[u32] {
        let point = point as usize;
        &self.parts[self.starts[point]..self.starts[point + 1]]
    }

    /// Points outside a part and its descendants that have bonds into them.
    pub(super) fn border(&self, part: usize) -> &[u32] {
        &self.borders[part]
    }

    /// Parts outside a part and its descendants on which bonds depend that depend on it too.
    pub(super) fn beside(&self, part: usize) -> &[u32] {
        &self.beside[part]
    }

    /// Largest value of the bonds of each part, of its descendants and at its border, shape (n_parts).
    pub(super) fn largest(
        &self,
        division: &Division,
        system: &dyn Bonds,
        of_bonds: &[f64],
    ) -> Vec<f64> {
        let mut largest = per_norm::of_parts(division, |bond| of_bonds[bond as usize]);
        for (largest, border) in largest.iter_mut().zip(&self.borders) {
            let bonds = border.iter().flat_map(|&point| system.incidence.at(point));
            *largest = bonds.fold(*largest, |largest, &bond| {
                largest.max(of_bonds[bond as usize])
            });
        }
        largest
    }

    fn found_beside(&self, system: &dyn Bonds, division: &Division, part: usize) -> Vec<u32> {
        let families = system.families();
        let mut points = self.borders[part].clone();
        for &point in &self.borders[part] {
            let bonds = families.incidence.at(point).iter();
            points.extend(bonds.map(|&bond| families.neighbour(bond, point)));
        }
        points.sort_unstable();
        points.dedup();
        let parts = points.iter().flat_map(|&point| self.parts_at(point));
        let mut beside: Vec<u32> = parts.copied().collect();
        beside.sort_unstable();
        beside.dedup();
        beside.retain(|&it| {
            division
                .with_ancestors(it as usize)
                .all(|above| above != part)
        });
        beside
    }
}
