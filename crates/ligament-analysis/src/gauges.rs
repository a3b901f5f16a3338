//! Bodies that supports and loads do not hold: their free rigid motions, what holds these instead, and whether the loads are
//! in equilibrium without it.
//!
//! A held degree of freedom that carries no force is a gauge: it chooses one of the solutions that differ by a rigid motion,
//! and strains and stresses do not depend on it. It carries none exactly if the given loads do no work on the free motions;
//! reactions never do, for supports and prescribed motions do not move with them.

use ligament_model::BondSystem;

use crate::connectivity::{Fragments, Hold, degrees_of_freedom, rigid_motions};
use crate::load_program::LoadProgram;
use crate::unknowns::{Component, Unknowns};

/// Loads whose work on a free motion is less than this part of their size are in equilibrium: well above the rounding of loads
/// spread over many points, and below what results are read to.
const BALANCE_TOLERANCE: f64 = 1e-6;

/// A connected part of the intact body that can move rigidly.
#[derive(Debug, Clone, PartialEq)]
pub struct FreeBody {
    /// Number of its points.
    pub points: usize,
    /// Whether it is the whole body.
    pub is_whole: bool,
    /// Its first point.
    pub first: u32,
    /// Its free motions.
    pub motions: Vec<FreeMotion>,
    /// Degrees of freedom (of 3 n_points) held as gauges, ascending.
    pub gauges: Vec<usize>,
}

/// A rigid motion that nothing holds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FreeMotion {
    /// A translation along x or y, or the rotation.
    pub component: Component,
    /// What the given loads at load factor 1 exert along it, N; for the rotation the moment about the place that is held, or
    /// the middle of the points, N m.
    pub load: f64,
    /// Its work relative to the sizes of the loads on the part, 0 to 1.
    pub imbalance: f64,
}

impl FreeMotion {
    /// Whether the loads are in equilibrium along it.
    pub fn is_balanced(&self) -> bool {
        self.imbalance <= BALANCE_TOLERANCE
    }
}

impl FreeBody {
    /// Whether the loads are in equilibrium without supports, so that gauges carry nothing.
    pub fn is_balanced(&self) -> bool {
        self.motions.iter().all(FreeMotion::is_balanced)
    }
}

/// The free parts of the intact body, before anything is solved.
pub fn of_intact_body(system: &BondSystem, loads: &dyn LoadProgram) -> Vec<FreeBody> {
    let fragments = Fragments::find(system, &vec![true; system.bonds.len()]);
    let unknowns = Unknowns::all_but(system, |dof| loads.is_prescribed(dof));
    let holds = fragments.missing_holds(
        0..fragments.points.len() as u32,
        system,
        |dof| loads.is_prescribed(dof),
        |dof| unknowns.number(dof).is_some(),
    );
    free_bodies(system, loads, &fragments, &holds)
}

/// The free parts of the intact body, given the holds that they need.
pub fn free_bodies(
    system: &BondSystem,
    loads: &dyn LoadProgram,
    fragments: &Fragments,
    holds: &[Hold],
) -> Vec<FreeBody> {
    let of_one_body = holds.chunk_by(|one, other| one.fragment == other.fragment);
    of_one_body
        .map(|holds| free_body(system, loads, fragments, holds))
        .collect()
}

fn free_body(
    system: &BondSystem,
    loads: &dyn LoadProgram,
    fragments: &Fragments,
    holds: &[Hold],
) -> FreeBody {
    let points = &fragments.points[holds[0].fragment as usize];
    let motions = rigid_motions(system, points);
    let spanned = motions.spanned_by(points, |dof| loads.is_prescribed(dof));
    let dofs: Vec<u32> = degrees_of_freedom(points).map(|dof| dof as u32).collect();
    let forces = loads.forces(1.0, &dofs);
    let forces = || {
        dofs.iter()
            .map(|&dof| dof as usize)
            .zip(forces.iter().copied())
    };
    let free = Component::ALL.into_iter().zip(motions.free(&spanned));
    let free = free.filter_map(|(component, motion)| Some((component, motion?)));
    let told = free.map(|(component, motion)| {
        let [load, size] = motions.work(motion, forces());
        let length = motion
            .iter()
            .fold(0.0, |largest: f64, part| largest.max(part.abs()));
        FreeMotion {
            component,
            load,
            imbalance: if load == 0.0 {
                0.0
            } else {
                load.abs() / (size * length)
            },
        }
    });
    let mut gauges: Vec<usize> = holds.iter().map(|hold| hold.degree_of_freedom).collect();
    gauges.sort_unstable();
    FreeBody {
        points: points.len(),
        is_whole: points.len() == system.cloud.len(),
        first: points[0],
        motions: told.collect(),
        gauges,
    }
}
