//! Division of a body into parts that may be delayed, as in its factor.

use ligament_linalg::Part;
use ligament_model::Bonds;
use ligament_model::volumetric::CellPatch;

use crate::probe::Reading;
use crate::problem::Problem;
use crate::solver::{DirectChoice, Ordering, Update};
use crate::stiffness::Stiffness;
use crate::unknowns::Layout;

/// Inverse of the share of the factor's values below which a part is not divided any further.
const SMALLEST: usize = 256;

/// Division of a body into parts.
pub(super) struct Division {
    /// Parts of the factor, each after its parent.
    pub(super) parts: Vec<Part>,
    /// Children of each part.
    pub(super) below: Vec<Vec<usize>>,
    /// Degree of freedom of each row of the factor.
    pub(super) degree_of_freedom: Vec<u32>,
    /// Whether each part or a descendant of it contains observed points.
    pub(super) is_wanted: Vec<bool>,
    /// Part of each point; the first one for points without unknowns.
    part_of_point: Vec<u32>,
    /// Bonds sorted by the lowest part that contains one of their ends, ascending in each.
    bonds: Vec<u32>,
    /// Index of the first bond of each part.
    starts: Vec<usize>,
    /// Observed points, whose motions and forces are needed after each breakage, ascending.
    pub(super) wanted: Vec<u32>,
    /// Part of each bond.
    pub(super) part_of_bond: Vec<u32>,
    /// Patches of cells with the lowest part that contains one of their points.
    pub(super) patches: Vec<(u32, CellPatch)>,
}

impl Division {
    /// Divides a body. None where parts of it cannot be delayed: where equations are nonlinear, a stiffness is negative, other
    /// elements than bonds resist motions, limits change with the state of the body, probes read more than motions, or the factor
    /// has no nested dissection.
    pub(super) fn new(problem: &Problem, stiffness: &Stiffness) -> Option<Self> {
        if !may_wait(problem, stiffness.choice()) {
            return None;
        }
        let (system, symbolic) = (&*problem.system, stiffness.symbolic());
        let parts = symbolic.parts(symbolic.n_factor_values() / SMALLEST);
        let dofs = stiffness.unknowns().degrees_of_freedom();
        let unknowns = symbolic.unknown_of_row().iter();
        let degree_of_freedom: Vec<u32> = unknowns.map(|&unknown| dofs[unknown]).collect();
        let part_of_point = parts_of_points(system.layout, &parts, &degree_of_freedom)?;
        let ends = system.ends.iter();
        let of_bond = |&[a, b]: &[u32; 2]| {
            let [a, b] = [a, b].map(|end| part_of_point[end as usize]);
            lower(&parts, a, b)
        };
        let part_of_bond: Vec<u32> = ends.map(of_bond).collect::<Option<_>>()?;
        let (bonds, starts) = sorted(&part_of_bond, parts.len());
        let patches = system.cell_patches().into_iter().map(|patch| {
            let mut of_points = (patch.points().into_iter()).map(|it| part_of_point[it as usize]);
            let first = of_points.next()?;
            let lowest = of_points.try_fold(first, |lowest, part| lower(&parts, lowest, part))?;
            Some((lowest, patch))
        });
        let patches: Vec<(u32, CellPatch)> = patches.collect::<Option<_>>()?;
        let wanted = wanted(problem)?;
        let mut below = vec![Vec::new(); parts.len()];
        for (number, part) in parts.iter().enumerate() {
            if let Some(above) = part.above {
                below[above].push(number);
            }
        }
        let mut division = Self {
            below,
            is_wanted: Vec::new(),
            parts,
            degree_of_freedom,
            part_of_point,
            bonds,
            starts,
            wanted,
            part_of_bond,
            patches,
        };
        let asked_for = with_neighbours(system, &division.wanted);
        division.is_wanted = division.parts_above(asked_for.into_iter());
        Some(division)
    }

    /// Bonds of a part.
    pub(super) fn bonds(&self, part: usize) -> &[u32] {
        &self.bonds[self.starts[part]..self.starts[part + 1]]
    }

    /// Part of a point.
    pub(super) fn part_of(&self, point: u32) -> usize {
        self.part_of_point[point as usize] as usize
    }

    /// A part and its ancestors, from below.
    pub(super) fn with_ancestors(&self, part: usize) -> impl Iterator<Item = usize> + '_ {
        std::iter::successors(Some(part), |&part| self.parts[part].above)
    }

    /// Whether each part or a descendant of it contains one of the points.
    pub(super) fn parts_above(&self, points: impl Iterator<Item = u32>) -> Vec<bool> {
        let mut is_above = vec![false; self.parts.len()];
        for point in points {
            let mut next = Some(self.part_of(point));
            while let Some(part) = next.filter(|&part| !is_above[part]) {
                is_above[part] = true;
                next = self.parts[part].above;
            }
        }
        is_above
    }
}

/// Whether the problem and solver allow delayed parts at all.
fn may_wait(problem: &Problem, choice: &DirectChoice) -> bool {
    let (system, loads) = (&problem.system, &problem.loads);
    let is_judged = |it: &ligament_model::failure::Criterion| {
        let depends_on_motions = it.surroundings.is_none() || it.follows_stress();
        it.after.is_brittle() && depends_on_motions && !it.measure.takes_strains()
    };
    // Stresses depend on cells around the points, for which there is no bound.
    let by_patches = system.has_volumetric_cells
        && system.far_field.is_none()
        && !problem.criteria.list.iter().any(|it| it.follows_stress());
    system.element.is_linear()
        && system.element.has_energy()
        && !system.rigidities().some_negative(&system.subdomain)
        && !problem.may_press()
        && (system.coupled_points.are_ends_of_bonds() || by_patches)
        && loads.course().is_none()
        && loads.restraints().is_empty()
        && loads.temperature_change(1.0).is_empty()
        && problem.criteria.list.iter().all(is_judged)
        && choice.ordering == Ordering::NestedDissection
        && choice.update == Update::Incremental
}

/// Points whose motions and forces records need, ascending; None where probes read more.
fn wanted(problem: &Problem) -> Option<Vec<u32>> {
    let (system, loads) = (&problem.system, &problem.loads);
    let layout = system.layout;
    let prescribed = (0..layout.n_degrees_of_freedom()).filter(|&dof| loads.is_prescribed(dof));
    let loaded = loads.loaded_degrees_of_freedom();
    let dofs = prescribed.chain(loaded.into_iter().map(|dof| dof as usize));
    let mut points: Vec<u32> = dofs.map(|dof| layout.point(dof)).collect();
    let of_groups = loads.groups().iter().flat_map(|group| &group.points);
    points.extend(of_groups);
    points.extend(&loads.control().points);
    for probe in problem.probes.iter() {
        let motions: Vec<(u32, f64)> = Reading::weights(&probe.reading, layout)?;
        points.extend(motions.iter().map(|(dof, _)| layout.point(*dof as usize)));
    }
    points.sort_unstable();
    points.dedup();
    Some(points)
}

/// Points and their neighbours, whose motions determine the forces at the points.
fn with_neighbours(system: &dyn Bonds, points: &[u32]) -> Vec<u32> {
    let neighbours = points
        .iter()
        .flat_map(|&point| system.coupled_points.at(point));
    points.iter().copied().chain(neighbours).collect()
}

/// Part of each point; None where the unknowns of a point are in several parts.
fn parts_of_points(layout: Layout, parts: &[Part], degree_of_freedom: &[u32]) -> Option<Vec<u32>> {
    const NOWHERE: u32 = u32::MAX;
    let mut part_of_point = vec![NOWHERE; layout.n_points];
    for (number, part) in (0..).zip(parts) {
        for &dof in &degree_of_freedom[part.rows.clone()] {
            let of_point = &mut part_of_point[layout.point(dof as usize) as usize];
            if *of_point != NOWHERE && *of_point != number {
                return None;
            }
            *of_point = number;
        }
    }
    // Fully prescribed motions are always known, like the motions of the first part.
    let known = part_of_point.iter_mut().filter(|part| **part == NOWHERE);
    known.for_each(|part| *part = 0);
    Some(part_of_point)
}

/// The lower of two parts that are equal, or one of them an ancestor of the other; None for other parts.
fn lower(parts: &[Part], one: u32, other: u32) -> Option<u32> {
    // An ancestor has a smaller number.
    let (higher, lower) = (one.min(other), one.max(other));
    let mut next = Some(lower as usize);
    while let Some(part) = next.filter(|&part| part > higher as usize) {
        next = parts[part].above;
    }
    (next == Some(higher as usize)).then_some(lower)
}

/// Numbers sorted by their parts, and the index of the first number of each part.
fn sorted(part_of: &[u32], n_parts: usize) -> (Vec<u32>, Vec<usize>) {
    let mut starts = vec![0; n_parts + 1];
    for &part in part_of {
        starts[part as usize + 1] += 1;
    }
    for part in 0..n_parts {
        starts[part + 1] += starts[part];
    }
    let mut next = starts.clone();
    let mut sorted = vec![0; part_of.len()];
    for (number, &part) in (0..).zip(part_of) {
        let place = &mut next[part as usize];
        sorted[*place] = number;
        *place += 1;
    }
    (sorted, starts)
}
