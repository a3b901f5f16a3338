//! A body divided into parts that can wait, as its factor is.

use ligament_linalg::Part;
use ligament_model::Bonds;

use crate::probe::Reading;
use crate::problem::Problem;
use crate::solver::{DirectChoice, Ordering, Update};
use crate::stiffness::Stiffness;
use crate::unknowns::Layout;

/// Share of the values of a factor that a part has which is not divided any further.
const SMALLEST: usize = 256;

/// A body divided into parts.
pub(super) struct Division {
    /// Parts of the factor, each after the one above it.
    pub(super) parts: Vec<Part>,
    /// Parts right below each part.
    pub(super) below: Vec<Vec<usize>>,
    /// Degree of freedom of each row of the factor.
    pub(super) degree_of_freedom: Vec<u32>,
    /// Whether each part, or one below it, has points whose motions and forces are asked for after each breakage.
    pub(super) is_wanted: Vec<bool>,
    /// Part of each point; the first one for points without unknowns.
    part_of_point: Vec<u32>,
    /// Bonds by the lowest part that one of their ends is in, ascending in each.
    bonds: Vec<u32>,
    /// Where the bonds of each part begin.
    starts: Vec<usize>,
    /// Points whose motions and forces are asked for after each breakage, ascending.
    pub(super) wanted: Vec<u32>,
    /// Part of each bond.
    pub(super) part_of_bond: Vec<u32>,
}

impl Division {
    /// The division of a body. None where parts of it cannot wait: where equations are not linear, a stiffness is negative, something
    /// beside bonds resists motions, limits change with the state of the body, probes ask for more than motions, or the factor
    /// follows no dissection.
    pub(super) fn new(problem: &Problem, stiffness: &Stiffness) -> Option<Self> {
        if !may_wait(problem, stiffness.choice()) {
            return None;
        }
        let (system, symbolic) = (&*problem.system, stiffness.symbolic());
        let parts = symbolic.parts(symbolic.n_factor_values() / SMALLEST);
        let dofs = stiffness.unknowns().degrees_of_freedom();
        let unknowns = symbolic.unknown_of_row().iter();
        let degree_of_freedom: Vec<u32> = unknowns.map(|&unknown| dofs[unknown]).collect();
        let part_of_point = parts_of_points(system.layout(), &parts, &degree_of_freedom)?;
        let ends = system.ends().iter();
        let lower = |&[a, b]: &[u32; 2]| {
            let [a, b] = [a, b].map(|end| part_of_point[end as usize]);
            lower(&parts, a, b)
        };
        let part_of_bond: Vec<u32> = ends.map(lower).collect::<Option<_>>()?;
        let (bonds, starts) = sorted(&part_of_bond, parts.len());
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
        };
        let asked_for = with_neighbours(system, &division.wanted);
        division.is_wanted = division.parts_above(asked_for.into_iter());
        Some(division)
    }

    /// The bonds of a part.
    pub(super) fn bonds(&self, part: usize) -> &[u32] {
        &self.bonds[self.starts[part]..self.starts[part + 1]]
    }

    /// Part of a point.
    pub(super) fn part_of(&self, point: u32) -> usize {
        self.part_of_point[point as usize] as usize
    }

    /// For each part, whether it or one below it has one of the points.
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

/// Whether parts of a body may wait at all.
fn may_wait(problem: &Problem, choice: &DirectChoice) -> bool {
    let (system, loads) = (&problem.system, &problem.loads);
    let is_judged = |it: &ligament_model::failure::Criterion| {
        it.after.is_brittle() && it.surroundings.is_none() && !it.measure.takes_strains()
    };
    system.is_linear()
        && system.has_energy()
        && !system.some_negative()
        && !system.faces_close()
        && std::ptr::eq(system.elements_at_points(), system.incidence())
        && loads.course().is_none()
        && loads.restraints().is_empty()
        && loads.temperature_change(1.0).is_empty()
        && problem.criteria.list.iter().all(is_judged)
        && choice.ordering == Ordering::NestedDissection
        && choice.update == Update::Incremental
}

/// Points whose motions and forces records ask for, ascending; None where probes ask for more.
fn wanted(problem: &Problem) -> Option<Vec<u32>> {
    let (system, loads) = (&problem.system, &problem.loads);
    let layout = system.layout();
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

/// Points and those that bonds connect with them: the forces at the points need the motions of all.
fn with_neighbours(system: &dyn Bonds, points: &[u32]) -> Vec<u32> {
    let topology = system.topology();
    let neighbours = points.iter().flat_map(|&point| {
        let bonds = topology.incidence.at(point).iter();
        bonds.map(move |&bond| topology.neighbour(bond, point))
    });
    points.iter().copied().chain(neighbours).collect()
}

/// Part of each point; None where the unknowns of a point are in several.
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
    // What is prescribed altogether is known at any time, as are the motions of the first part.
    let known = part_of_point.iter_mut().filter(|part| **part == NOWHERE);
    known.for_each(|part| *part = 0);
    Some(part_of_point)
}

/// The lower one of two parts of which one is above the other, or is it.
fn lower(parts: &[Part], one: u32, other: u32) -> Option<u32> {
    // A part above has a smaller number.
    let (higher, lower) = (one.min(other), one.max(other));
    let mut next = Some(lower as usize);
    while let Some(part) = next.filter(|&part| part > higher as usize) {
        next = parts[part].above;
    }
    (next == Some(higher as usize)).then_some(lower)
}

/// Numbers sorted by the part that each belongs to, and where those of each part begin.
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
