//! Restraints, which resist the motion of a body without fixing it, such as springs, inclined rollers and rigid platens.
//!
//! A restraint is a symmetric stiffness S between some degrees of freedom and the ground. It exerts -S u on the body, an external
//! force like a support: its energy is not part of the bond energies, and its work is work of the supports. Where the far
//! end of a spring is moved, a loading adds S g to its given forces.

mod supports_to_add;

use std::collections::{BTreeMap, BTreeSet};

use ligament_model::CoupledPoints;

use crate::unknowns::Layout;

pub use supports_to_add::missing_supports;

/// A stiffness between some degrees of freedom and the ground.
#[derive(Debug, Clone, PartialEq)]
pub struct Restraint {
    /// Degrees of freedom of the restraint, shape (n).
    pub degrees_of_freedom: Vec<u32>,
    /// Stiffness S, symmetric and positive semidefinite, shape (n, n), N/m; N m/rad between rotations.
    pub stiffness: Vec<f64>,
}

/// Restraints of a body.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Restraints {
    list: Vec<Restraint>,
    /// Indices of the restraints of each restrained point, ascending.
    at_points: BTreeMap<u32, Vec<usize>>,
    /// Degrees of freedom of all restraints, ascending.
    degrees_of_freedom: Vec<u32>,
    /// Stiffness between each degree of freedom and the ground, in addition to the list, shape (n_degrees_of_freedom), N/m and N m/rad;
    /// empty without any.
    ground: Vec<f64>,
}

impl Restraint {
    /// Spring of stiffness k along a direction c of one or more degrees of freedom: S = k c c^T.
    pub fn spring(along: &[(u32, f64)], stiffness: f64) -> Self {
        let product = |(_, one): &(u32, f64)| {
            let one = *one;
            along.iter().map(move |(_, other)| stiffness * one * other)
        };
        Self {
            degrees_of_freedom: along.iter().map(|(dof, _)| *dof).collect(),
            stiffness: along.iter().flat_map(product).collect(),
        }
    }

    /// Forces S u for displacements at the degrees of freedom of the restraint (n), by degree of freedom.
    pub fn forces(&self, displacement: &[f64]) -> impl Iterator<Item = (u32, f64)> {
        let rows = self.stiffness.chunks(self.degrees_of_freedom.len());
        let force = move |row: &[f64]| row.iter().zip(displacement).map(|(s, u)| s * u).sum();
        self.degrees_of_freedom.iter().copied().zip(rows.map(force))
    }
}

impl Restraints {
    /// Restraints on points with the components of a layout.
    pub fn new(layout: Layout, list: Vec<Restraint>) -> Self {
        let mut at_points: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
        let mut degrees_of_freedom: Vec<u32> = Vec::new();
        for (index, restraint) in list.iter().enumerate() {
            for &dof in &restraint.degrees_of_freedom {
                let of_point = at_points.entry(layout.point(dof as usize)).or_default();
                if of_point.last() != Some(&index) {
                    of_point.push(index);
                }
                degrees_of_freedom.push(dof);
            }
        }
        degrees_of_freedom.sort_unstable();
        degrees_of_freedom.dedup();
        Self {
            list,
            at_points,
            degrees_of_freedom,
            ground: Vec::new(),
        }
    }

    /// Restraints with a stiffness between each degree of freedom and the ground (n_degrees_of_freedom), such as the inertia in an implicit
    /// time step, in addition to their own.
    pub fn with_ground(self, ground: Vec<f64>) -> Self {
        Self { ground, ..self }
    }

    /// All restraints with their stiffnesses times a factor, in a list without ground.
    pub fn scaled(&self, factor: f64) -> Vec<Restraint> {
        let scaled = |it: &Restraint| Restraint {
            degrees_of_freedom: it.degrees_of_freedom.clone(),
            stiffness: it.stiffness.iter().map(|value| factor * value).collect(),
        };
        self.list.iter().map(scaled).collect()
    }

    /// The restraints, and groups of points that are coupled without any stiffness.
    pub(crate) fn with_coupled(&self, layout: Layout, groups: &[Vec<u32>]) -> Self {
        let mut list = self.list.clone();
        list.extend(groups.iter().map(|points| {
            Restraint {
                degrees_of_freedom: points
                    .iter()
                    .map(|it| layout.range(*it).start as u32)
                    .collect(),
                stiffness: vec![0.0; points.len() * points.len()],
            }
        }));
        Self::new(layout, list).with_ground(self.ground.clone())
    }

    /// Whether there are no restraints.
    pub fn is_empty(&self) -> bool {
        self.list.is_empty() && self.ground.is_empty()
    }

    fn ground_at(&self, degree_of_freedom: usize) -> f64 {
        self.ground.get(degree_of_freedom).copied().unwrap_or(0.0)
    }

    /// Degrees of freedom on which restraints act, ascending.
    pub fn degrees_of_freedom(&self) -> &[u32] {
        &self.degrees_of_freedom
    }

    /// Whether a restraint acts on a degree of freedom.
    pub fn acts_on(&self, degree_of_freedom: usize) -> bool {
        let dof = degree_of_freedom as u32;
        self.ground_at(degree_of_freedom) > 0.0
            || self.degrees_of_freedom.binary_search(&dof).is_ok()
    }

    /// Whether a restraint supports a degree of freedom by itself.
    pub fn holds(&self, layout: Layout, degree_of_freedom: usize) -> bool {
        if self.ground_at(degree_of_freedom) > 0.0 {
            return true;
        }
        let of_point = self.at_points.get(&layout.point(degree_of_freedom));
        let mut restraints = of_point.into_iter().flatten().map(|&it| &self.list[it]);
        restraints
            .any(|it| it.degrees_of_freedom == [degree_of_freedom as u32] && it.stiffness[0] > 0.0)
    }

    /// Adds the restraining forces S u at displacements (n_degrees_of_freedom) to internal forces (n_degrees_of_freedom), N and N
    /// m.
    pub fn add_forces(&self, displacement: &[f64], forces: &mut [f64]) {
        for restraint in &self.list {
            let dofs = restraint.degrees_of_freedom.iter();
            let own: Vec<f64> = dofs.map(|&dof| displacement[dof as usize]).collect();
            for (dof, force) in restraint.forces(&own) {
                forces[dof as usize] += force;
            }
        }
        for ((force, stiffness), displacement) in
            forces.iter_mut().zip(&self.ground).zip(displacement)
        {
            *force += stiffness * displacement;
        }
    }

    /// Adds the diagonal of the stiffness (n_degrees_of_freedom), N/m and N m/rad.
    pub(crate) fn add_diagonal(&self, diagonal: &mut [f64]) {
        for restraint in &self.list {
            let n = restraint.degrees_of_freedom.len();
            for (place, &dof) in restraint.degrees_of_freedom.iter().enumerate() {
                diagonal[dof as usize] += restraint.stiffness[place * (n + 1)];
            }
        }
        for (sum, stiffness) in diagonal.iter_mut().zip(&self.ground) {
            *sum += stiffness;
        }
    }

    /// Largest number of points coupled by a restraint.
    pub(crate) fn most_coupled(&self, layout: Layout) -> usize {
        let of_restraint = |it: &Restraint| {
            let dofs = it.degrees_of_freedom.iter();
            let points: BTreeSet<u32> = dofs.map(|&dof| layout.point(dof as usize)).collect();
            points.len()
        };
        self.list.iter().map(of_restraint).max().unwrap_or(0)
    }

    /// Points of smaller number that are coupled with a point by bonds or restraints, ascending.
    pub(crate) fn lower_points(
        &self,
        layout: Layout,
        coupled: &CoupledPoints,
        point: usize,
    ) -> Vec<u32> {
        let is_lower = |other: &u32| (*other as usize) < point;
        let mut lower: Vec<u32> = coupled.at(point as u32).take_while(is_lower).collect();
        let Some(restraints) = self.at_points.get(&(point as u32)) else {
            return lower;
        };
        for &restraint in restraints {
            let dofs = self.list[restraint].degrees_of_freedom.iter();
            lower.extend(dofs.map(|&dof| layout.point(dof as usize)).filter(is_lower));
        }
        lower.sort_unstable();
        lower.dedup();
        lower
    }

    /// Adds the stiffness between the columns of a point and the rows of its `lower` points (ascending) and of itself, shape
    /// (n_lower + 1, n_components, n_components).
    pub(crate) fn add_blocks(&self, layout: Layout, point: u32, lower: &[u32], blocks: &mut [f64]) {
        let components = layout.components.len();
        if !self.ground.is_empty() {
            let of_point = &mut blocks[lower.len() * components * components..];
            for (place, dof) in layout.range(point).enumerate() {
                of_point[place * (components + 1)] += self.ground[dof];
            }
        }
        let place_of = |other: u32| match other == point {
            true => Some(lower.len()),
            false => lower.binary_search(&other).ok(),
        };
        for &restraint in self.at_points.get(&point).into_iter().flatten() {
            let Restraint {
                degrees_of_freedom,
                stiffness,
            } = &self.list[restraint];
            let n = degrees_of_freedom.len();
            for (row, &of_row) in degrees_of_freedom.iter().enumerate() {
                let of_row = of_row as usize;
                let Some(place) = place_of(layout.point(of_row)) else {
                    continue;
                };
                for (column, &of_column) in degrees_of_freedom.iter().enumerate() {
                    let of_column = of_column as usize;
                    if layout.point(of_column) == point {
                        let [r, c] = [of_row, of_column].map(|dof| dof % components);
                        blocks[(place * components + r) * components + c] +=
                            stiffness[row * n + column];
                    }
                }
            }
        }
    }

    /// Restraints that act on some degrees of freedom.
    fn acting_on(&self, is_acted_on: impl Fn(u32) -> bool) -> Vec<&Restraint> {
        let acts = |it: &&Restraint| it.degrees_of_freedom.iter().any(|dof| is_acted_on(*dof));
        self.list.iter().filter(acts).collect()
    }
}
