//! Accuracy of equilibrium: residuals of states, the accuracy required of the solver, and motions without stiffness.
//!
//! An iterative solver finds the motion of a body that has become a mechanism, or of a part of it. A direct solver detects such a motion by
//! a vanishing pivot, fixes one of its degrees of freedom and reads the reaction there. Here the motion itself is known, and the reaction is
//! the work of the forces on it over the motion of the degree of freedom.

use ligament_model::Bonds;
use ligament_model::subdomain::Subdomain;

use super::residual::{
    Extents, LocalStiffness, OF_GAPS, RESIDUAL_TOLERANCE, Residual, Rounded, Scales,
};
use crate::breakage::Breakage;
use crate::contact::{ContactProblem, SurfaceSearch, Touching};
use crate::load_program::LoadProgram;
use crate::state::State;
use crate::tangent::{AllowedResidual, UNRESISTED};
use crate::unbalanced::{Place, Unbalanced};
use crate::unknowns::{Layout, Unknowns};
use crate::vectors::dot_of_all;

/// Share of the sought residual to which an iterative solver solves, since the next residual is scaled by other forces.
const SURELY: f64 = 0.3;

/// Largest ratio of the forces in a body to the forces on it, by leverage: in a bar a thousand times as long as thick the forces
/// between points are some thousand times its load.
const LARGEST_LEVERAGE: f64 = 1e6;

/// Scales by which residual forces are judged.
#[derive(Clone)]
pub(super) struct Accuracy {
    pub(super) local_stiffness: LocalStiffness,
    /// Loaded degrees of freedom without a prescribed motion, ascending.
    loaded: Vec<u32>,
    /// Degrees of freedom with prescribed motions, ascending.
    prescribed: Vec<u32>,
    /// Whether the temperature changes or rigid bodies press, so that the forces in the body have no bound here.
    pub(super) is_unbounded: bool,
    /// Largest stiffness of a point against displacements, N/m.
    pub(super) stiffest: f64,
    /// Diagonal of the box around the body, m.
    pub(super) size: f64,
    /// Largest forces and moments at a point so far, whose rounding remains in a body that is unloaded.
    pub(super) largest_extents: Extents,
    /// Relative tolerance of an iterative solver; None for a direct one.
    tolerance: Option<f64>,
    /// Largest force and moment of contacts between surfaces over the gap that causes it, shape (n_degrees_of_freedom), N/m and N; empty
    /// without contacts.
    of_contacts: Vec<f64>,
    subdomain: Subdomain,
}

/// A state with its loads and unknowns.
#[derive(Clone, Copy)]
pub(super) struct Loaded<'a> {
    pub(super) loads: &'a dyn LoadProgram,
    pub(super) unknowns: &'a Unknowns,
    pub(super) state: &'a State,
}

impl Accuracy {
    /// Scales of a body before its first equilibrium; `tolerance` is the tolerance of an iterative solver.
    pub(super) fn new(system: &dyn Bonds, loads: &dyn LoadProgram, tolerance: Option<f64>) -> Self {
        let of_bonds = LocalStiffness::new(system);
        let n_dofs = system.layout.n_degrees_of_freedom();
        let prescribed = (0..n_dofs).filter(|&dof| loads.is_prescribed(dof));
        Self {
            prescribed: prescribed.map(|dof| dof as u32).collect(),
            is_unbounded: !loads.thermal_strain(1.0).is_none(),
            stiffest: of_bonds.largest(),
            size: system.extent(),
            local_stiffness: of_bonds.restrained_by(loads.restraints()),
            loaded: loaded(loads),
            largest_extents: Extents::default(),
            of_contacts: Vec::new(),
            tolerance,
            subdomain: system.subdomain.clone(),
        }
    }

    /// Lets the gaps of contacts be rounded.
    pub(super) fn with_contacts(mut self, problem: &ContactProblem) -> Self {
        let layout = self.local_stiffness.layout();
        self.of_contacts = over_gaps(layout, problem.stiffness(layout).at_degrees_of_freedom);
        self
    }

    /// Bound of the stiffness of contacts against a displacement, N/m; 0 without contacts.
    pub(super) fn stiffest_contact(&self) -> f64 {
        let layout = self.local_stiffness.layout();
        let of_displacements = layout.displacements(&self.of_contacts);
        of_displacements.fold(0.0, f64::max)
    }

    /// Extents over all processes of the sizes of the forces at the points (n_degrees_of_freedom), N and N m.
    pub(super) fn extents(&self, sizes: &[f64]) -> Extents {
        (self.local_stiffness.extents(sizes)).of_all(&self.subdomain)
    }

    /// Largest displacement of a point of a state along an axis, over all processes, m.
    pub(super) fn largest_displacement(&self, layout: Layout, state: &State) -> f64 {
        self.subdomain.max(largest_displacement(layout, state))
    }

    /// Whether a point has moved farther than `times` times the size of the body or the prescribed motions.
    pub(super) fn moves_beyond(&self, layout: Layout, state: &State, times: f64) -> bool {
        let prescribed = self.subdomain.max(self.largest_prescribed(state));
        let limit = self.size.max(prescribed);
        self.largest_displacement(layout, state) > times * limit
    }

    /// Replaces the loads.
    pub(super) fn load_with(&mut self, loads: &dyn LoadProgram) {
        self.loaded = loaded(loads);
    }

    /// Relative residual of the residual forces at the unknowns (n_unknowns), with the largest force at an added support;
    /// `rounded` are lengths in the state.
    pub(super) fn residual(
        &self,
        at: Loaded<'_>,
        extents: Extents,
        rounded: Rounded,
        out_of_balance: Vec<f64>,
    ) -> Residual {
        let given = self.given(at);
        let scales = self.scales(at, &given, extents, rounded);
        let dofs = at.unknowns.degrees_of_freedom().iter().copied();
        let of_unknowns = dofs.zip(out_of_balance);
        // No bond resists these degrees of freedom, so that loads on them are carried by nothing.
        let is_known = |dof: usize| !at.unknowns.is_unknown(dof);
        let of_others = given.iter().filter(|(dof, _)| is_known(*dof as usize));
        let of_others = of_others.copied();
        let residual = scales.residual(of_unknowns.chain(of_others), |dof| {
            at.state.held[dof] || is_known(dof)
        });
        scales.residual_of_all(residual, &self.subdomain)
    }

    /// Relative residual to be reached after a breakage, or without one.
    pub(super) fn sought(&self, breakage: &Breakage) -> f64 {
        let tolerance = self.tolerance.filter(|_| !breakage.bonds.is_empty());
        tolerance.map_or(RESIDUAL_TOLERANCE, |it| it.max(RESIDUAL_TOLERANCE))
    }

    /// Residual of the linear equations that a solver may leave to reach the relative residual `sought`.
    pub(super) fn left(&self, at: Loaded<'_>, extents: Extents, sought: f64) -> AllowedResidual {
        if self.tolerance.is_none() {
            return AllowedResidual::Share(0.0);
        }
        let given = self.given(at);
        let rounded = Rounded {
            displacement: self.largest_displacement(at.unknowns.layout(), at.state),
            ..Rounded::default()
        };
        let scales = self.scales(at, &given, extents, rounded);
        let of_unknown = |dof: &u32| match SURELY * sought * scales.at(*dof as usize) {
            // The forces at this degree of freedom are not known yet; the next residual judges them.
            0.0 => f64::INFINITY,
            size => size,
        };
        let dofs = at.unknowns.degrees_of_freedom().iter();
        AllowedResidual::AtMost(dofs.map(of_unknown).collect())
    }

    /// Residual that a solver may leave in the rate of an equilibrium line: a share of its tolerance.
    pub(super) fn left_of_line(&self, share: f64) -> AllowedResidual {
        AllowedResidual::Share(share * self.tolerance.unwrap_or_default())
    }

    /// Forces due to the rounding of the displacements of a state and of the gaps between surfaces, shape (n_degrees_of_freedom), N
    /// and N m; with an iterative solver, due to its tolerance.
    pub(super) fn rounding(
        &self,
        layout: Layout,
        state: &State,
        (surfaces, touching): (&SurfaceSearch, &Touching),
    ) -> Vec<f64> {
        let tolerance = self.tolerance.unwrap_or_default();
        let times = (tolerance / RESIDUAL_TOLERANCE).max(1.0);
        let displacement = self.largest_displacement(layout, state);
        let mut forces = self.local_stiffness.rounding(times * displacement);
        let coordinate = surfaces.coordinate(displacement, touching);
        for (force, stiffness) in forces.iter_mut().zip(&self.of_contacts) {
            *force += OF_GAPS * coordinate * stiffness;
        }
        forces
    }

    /// Given forces of a state, by degree of freedom, N and N m.
    fn given(&self, at: Loaded<'_>) -> Vec<(u32, f64)> {
        let forces = at.loads.forces(at.state.load_factor, &self.loaded);
        self.loaded.iter().copied().zip(forces).collect()
    }

    /// Bound of the forces in the body from its given forces, moments and motions and from the largest force in earlier equilibria,
    /// N; infinite where the temperature changes. Larger forces are no scale, because they arise without loads in a body that has
    /// become a mechanism.
    pub(super) fn bound(&self, at: Loaded<'_>) -> f64 {
        self.bound_by(&self.given(at), at.state)
    }

    fn bound_by(&self, given: &[(u32, f64)], state: &State) -> f64 {
        if self.is_unbounded {
            return f64::INFINITY;
        }
        let layout = self.local_stiffness.layout();
        let force = |&(dof, value): &(u32, f64)| {
            let is_moment = layout.component(dof as usize).is_rotation();
            value.abs() / if is_moment { self.size } else { 1.0 }
        };
        let given: f64 = given.iter().map(force).sum();
        let motion = self.largest_prescribed(state);
        LARGEST_LEVERAGE * (given + self.stiffest * motion + self.largest_extents.force())
    }

    /// The size of the body, or its largest prescribed displacement on this process where that is larger, m.
    pub(super) fn size_or_prescribed(&self, state: &State) -> f64 {
        self.size.max(self.largest_prescribed(state))
    }

    /// Largest prescribed motion in a state, a displacement or a rotation times the size of the body, m.
    pub(super) fn largest_prescribed(&self, state: &State) -> f64 {
        let layout = self.local_stiffness.layout();
        let motion = |&dof: &u32| {
            let is_turn = layout.component(dof as usize).is_rotation();
            state.displacement[dof as usize].abs() * if is_turn { self.size } else { 1.0 }
        };
        self.prescribed.iter().map(motion).fold(0.0, f64::max)
    }

    /// Scales of the forces in a body with the given extents, rounded lengths and given forces.
    fn scales(
        &self,
        at: Loaded<'_>,
        given: &[(u32, f64)],
        extents: Extents,
        rounded: Rounded,
    ) -> Scales<'_> {
        let bound = self.bound_by(given, at.state);
        let [extents, largest] =
            [extents, self.largest_extents].map(|it| it.at_most(bound, self.size));
        let given = given.iter().copied();
        let scales = (self.local_stiffness).scales(extents, largest, given, rounded);
        scales.with_contacts(&self.of_contacts)
    }
}

/// Data by which motions of a body are judged.
#[derive(Clone, Copy)]
pub(super) struct Motions<'a> {
    pub(super) accuracy: &'a Accuracy,
    pub(super) unknowns: &'a Unknowns,
    pub(super) subdomain: &'a Subdomain,
    /// Whether some bonds have a negative stiffness.
    pub(super) some_negative: bool,
}

impl Motions<'_> {
    fn dot(self, one: &[f64], other: &[f64]) -> f64 {
        dot_of_all(self.subdomain, one, other)
    }

    /// Whether the stiffness K resists a solution u of K u = f, both of shape (n_unknowns), by more than the rounding of the
    /// stiffnesses k_i of the points: u . f > 1e-14 sum k_i u_i^2.
    pub(super) fn is_resisted(self, solution: &[f64], force: &[f64]) -> bool {
        let stiffness = &self.accuracy.local_stiffness;
        let dofs = self.unknowns.degrees_of_freedom().iter();
        let pushed: Vec<f64> = (dofs.zip(solution))
            .map(|(&dof, value)| stiffness.at(dof as usize) * value)
            .collect();
        let of_points = self.dot(&pushed, solution);
        of_points == 0.0 || self.dot(solution, force) > UNRESISTED * of_points
    }

    /// Reason why there is no equilibrium under forces f (n_unknowns) where a motion (n_unknowns) has no stiffness. Where the
    /// motion is unknown (all zero), the forces give its direction.
    pub(super) fn unresisted(self, motion: &[f64], force: &[f64]) -> Unbalanced {
        if self.some_negative {
            return Unbalanced::NegativeCurvature;
        }
        let is_known = self.dot(motion, motion) > 0.0;
        let motion = if is_known { motion } else { force };
        let Some((dof, moved)) = self.farthest(motion, |_| true) else {
            return Unbalanced::NegativeCurvature;
        };
        let layout = self.unknowns.layout();
        Unbalanced::LoadOnAddedSupport {
            place: Place {
                point: layout.point(dof),
                component: layout.component(dof),
            },
            force: self.dot(motion, force) / moved,
        }
    }

    /// Degree of freedom (of the body) that a motion (n_unknowns) moves farthest, by stiffness times its square, among the unknowns
    /// that may be taken, and how far; None for no motion.
    fn farthest(self, motion: &[f64], may_take: impl Fn(usize) -> bool) -> Option<(usize, f64)> {
        let stiffness = &self.accuracy.local_stiffness;
        let dofs = self.unknowns.degrees_of_freedom().iter();
        let n_components = self.unknowns.layout().components.len();
        let moved = dofs.map(|&dof| dof as usize).zip(motion);
        let may_be_taken = moved.filter(|(dof, _)| may_take(*dof));
        let farthest = may_be_taken.fold([0.0; 3], |most, (dof, value)| {
            let size = -stiffness.at(dof) * value * value;
            if size < most[0] {
                let in_body = self.subdomain.index_in_body(dof, n_components);
                [size, in_body as f64, *value]
            } else {
                most
            }
        });
        let of_all = self.subdomain.all_reduce_min(Some(farthest));
        let [size, dof, moved] = of_all.unwrap_or(farthest);
        (size != 0.0).then_some((dof as usize, moved))
    }

    /// Degree of freedom (of the body) that moves farthest in a body with broken or softened bonds whose largest displacement exceeds both
    /// its size and the prescribed displacements: nearly no stiffness is left, or supports that were added for a motion without stiffness
    /// are where it is small. None where only added supports are that far.
    pub(super) fn beyond_size(self, state: &State) -> Option<usize> {
        let accuracy = self.accuracy;
        let largest = accuracy.largest_displacement(self.unknowns.layout(), state);
        let limit = accuracy.size_or_prescribed(state);
        // Where bonds have a negative stiffness, the signs of the pivots decide.
        if largest <= limit || self.some_negative {
            return None;
        }
        let dofs = self.unknowns.degrees_of_freedom();
        let motion: Vec<f64> = (dofs.iter())
            .map(|&dof| state.displacement[dof as usize])
            .collect();
        let farthest = self.farthest(&motion, |dof| !state.held[dof]);
        farthest.map(|(dof, _)| dof)
    }
}

/// Forces and moments over a gap, N/m and N, from stiffnesses at the degrees of freedom (n_degrees_of_freedom), N/m and N m: with the stiffness k
/// of a point against displacements and k r^2 against rotations, a gap g causes the force k g and the moment k r g.
fn over_gaps(layout: Layout, mut stiffnesses: Vec<f64>) -> Vec<f64> {
    let components = layout.components;
    for of_point in stiffnesses.chunks_mut(components.len()) {
        let displacements = components.iter().zip(&*of_point);
        let displacements = displacements.filter(|(component, _)| !component.is_rotation());
        let stiffest = displacements.fold(0.0, |most: f64, (_, it)| most.max(*it));
        for (_, it) in (components.iter().zip(of_point)).filter(|(it, _)| it.is_rotation()) {
            *it = (stiffest * *it).sqrt();
        }
    }
    stiffnesses
}

/// Largest displacement of a point on this process, m.
fn largest_displacement(layout: Layout, state: &State) -> f64 {
    let displacements = layout.displacements(&state.displacement);
    displacements.fold(0.0, |largest, value| largest.max(value.abs()))
}

/// Loaded degrees of freedom without a prescribed motion, ascending.
fn loaded(loads: &dyn LoadProgram) -> Vec<u32> {
    let mut loaded = loads.loaded_degrees_of_freedom();
    loaded.retain(|&dof| !loads.is_prescribed(dof as usize));
    loaded
}
