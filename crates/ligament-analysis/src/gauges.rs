//! Parts of a body without sufficient supports: their free rigid motions, the gauges that fix these, and the balance of the loads.
//!
//! A gauge is a fixed degree of freedom without reaction: it selects one of the solutions that differ by a rigid motion, without
//! effect on strains and stresses. Its reaction is zero exactly if the given loads do no work on the free motions; reactions never
//! do, since supports and prescribed motions do not move with them.

use ligament_model::Bonds;
pub use ligament_model::rigid_motions::FreeMotion;

use crate::connectivity::{AddedSupport, Fragments};
use crate::load_program::{ControlKind, LoadProgram, ProportionalLoading};
use crate::unknowns::{Component, Unknowns};
use crate::user_message::Message;

/// A connected part of the intact body that can move rigidly.
#[derive(Debug, Clone, PartialEq)]
pub struct FreeBody {
    /// Number of points of the part.
    pub points: usize,
    /// Whether the part is the whole body.
    pub is_whole: bool,
    /// First point of the part.
    pub first: u32,
    /// Free motions of the part.
    pub motions: Vec<FreeMotion>,
    /// Components of points fixed as gauges, in the order of the degrees of freedom.
    pub gauges: Vec<(u32, Component)>,
}

impl FreeBody {
    /// Whether the loads are balanced without supports, so that gauges have no reactions.
    pub fn is_balanced(&self) -> bool {
        self.motions.iter().all(FreeMotion::is_balanced)
    }

    /// Message about the free motions, the points fixed instead, and the equilibrium of the loads without these; `faces_close`: whether faces of
    /// cracks may carry loads.
    pub fn message(&self, faces_close: bool) -> Message {
        let (part, first) = match self.is_whole {
            true => ("the body".to_owned(), None),
            false => (
                format!("{} points (around {{}})", self.points),
                Some(self.first),
            ),
        };
        let motions: Vec<&str> = self.motions.iter().map(motion).collect();
        let gauges = self.gauges.iter();
        let gauges = gauges.map(|(_, component)| format!("{} of {{at}}", component.name()));
        let gauges: Vec<String> = gauges.collect();
        let loads = self.motions.iter().filter(|it| !it.is_balanced());
        let loads = loads.map(load).collect::<Vec<_>>().join(", ");
        let (balance, advice) = if self.is_balanced() {
            (
                "this changes nothing, because the loads balance".to_owned(),
                None,
            )
        } else if faces_close && !self.is_whole {
            let carried = format!("crack faces that close must carry the loads ({loads})");
            (carried, None)
        } else {
            let unbalanced =
                format!("the loads do NOT balance ({loads}), so there is no equilibrium");
            (
                unbalanced,
                Some("add a support, or balance the loads".to_owned()),
            )
        };
        let text = format!(
            "the supports leave {part} free in {}; fixed automatically: {}; {balance}",
            motions.join(", "),
            gauges.join(", ")
        );
        let points = first.into_iter().chain(self.gauges.iter().map(|it| it.0));
        let message = Message::new("free-body", text).of_points(points.collect::<Vec<_>>());
        Message { advice, ..message }
    }
}

fn motion(motion: &FreeMotion) -> &'static str {
    match motion.component {
        Component::X => "translation along x",
        Component::Y => "translation along y",
        Component::Z => "translation along z",
        Component::Rotation => "rotation",
        Component::RotationX => "rotation about x",
        Component::RotationY => "rotation about y",
        Component::RotationZ => "rotation about z",
    }
}

fn load(motion: &FreeMotion) -> String {
    let load = motion.load;
    match motion.component {
        Component::X | Component::Y | Component::Z => {
            format!("along {} {load:.3e} N", motion.component.name())
        }
        Component::Rotation => format!("moment {load:.3e} N m"),
        Component::RotationX => format!("moment about x {load:.3e} N m"),
        Component::RotationY => format!("moment about y {load:.3e} N m"),
        Component::RotationZ => format!("moment about z {load:.3e} N m"),
    }
}

/// Free parts of the intact body, before any solution.
pub fn of_intact_body(system: &dyn Bonds, loads: &dyn LoadProgram) -> Vec<FreeBody> {
    let fragments = Fragments::find(system, &vec![true; system.ends.len()]);
    let unknowns = Unknowns::all_but(system, |dof| loads.is_prescribed(dof));
    let holds = fragments.missing_supports(
        0..fragments.len() as u32,
        system,
        loads.restraints(),
        |dof| loads.is_prescribed(dof),
        |dof| unknowns.number(dof).is_some(),
    );
    free_bodies(system, loads, &fragments, &holds)
}

/// Whether the displacement of a control load, as the one of this load alone, depends on the gauges: its forces do work on free motions of
/// the intact body on which all forces together do none; collective.
pub fn decide_displacement(system: &dyn Bonds, loads: &ProportionalLoading) -> bool {
    let all_balance = |free: &[FreeBody]| free.iter().all(FreeBody::is_balanced);
    if loads.control.kind != ControlKind::Force {
        return false;
    }
    let free = of_intact_body(system, loads);
    !free.is_empty()
        && all_balance(&free)
        && !all_balance(&of_intact_body(system, &loads.of_control_alone()))
}

/// Free parts of the intact body, given the added supports that they need; collective.
pub fn free_bodies(
    system: &dyn Bonds,
    loads: &dyn LoadProgram,
    fragments: &Fragments,
    holds: &[AddedSupport],
) -> Vec<FreeBody> {
    let of_one_body = holds.chunk_by(|one, other| one.fragment == other.fragment);
    of_one_body
        .map(|holds| free_body(system, loads, fragments, holds))
        .collect()
}

fn free_body(
    system: &dyn Bonds,
    loads: &dyn LoadProgram,
    fragments: &Fragments,
    holds: &[AddedSupport],
) -> FreeBody {
    let fragment = holds[0].fragment as usize;
    let (points, extent) = (&fragments.points[fragment], fragments.extents[fragment]);
    let layout = system.layout;
    let is_prescribed = |dof| loads.is_prescribed(dof) || loads.restraints().holds(layout, dof);
    let force = |dof: usize| loads.forces(1.0, &[dof as u32])[0];
    let mut gauges: Vec<usize> = holds.iter().map(|hold| hold.degree_of_freedom).collect();
    gauges.sort_unstable();
    let named = |dof: usize| (layout.point(dof), layout.component(dof));
    FreeBody {
        points: extent.n_points,
        is_whole: extent.n_points == system.subdomain.n_all(),
        first: extent.first,
        motions: system.free_motions(points, &is_prescribed, &force),
        gauges: gauges.into_iter().map(named).collect(),
    }
}
