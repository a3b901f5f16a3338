#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::sync::Arc;

use super::{Amplitude, LoadInTime, LoadProgram, LoadsInTime, ProportionalLoading, Timed};
use crate::internal::InternalForces;
use crate::load_program::{Control, ControlKind, Shape};
use crate::restraints::{Restraint, Restraints};
use crate::unknowns::{Component, Layout};

const LAYOUT: Layout = Layout {
    n_points: 4,
    components: &[Component::X, Component::Y],
};

/// Control by the motion of point 3 along x, 2 at factor 1.
fn control() -> Control {
    Control {
        kind: ControlKind::Displacement,
        points: vec![3],
        shape: vec![1.0, 0.0],
        magnitude: 2.0,
    }
}

/// Four points: point 0 is held, load 0 moves point 3 along x by 2, load 1 pulls at points 1 and 2, load 2 pulls at point 2 and drives a
/// spring of 10 N/m at point 1 by 0.5 along y.
fn loads() -> Vec<ProportionalLoading> {
    let supported = || {
        let mut loading = ProportionalLoading::new(LAYOUT, control());
        for component in [Component::X, Component::Y] {
            ProportionalLoading::prescribe(&mut loading, &[0], component, 0.0).unwrap();
        }
        let springs = vec![Restraint::spring(&[(3, 1.0)], 10.0)];
        loading.restraints = Restraints::new(LAYOUT, springs).into();
        loading.driving = vec![0.0; 8];
        loading
    };
    let [mut moving, mut pulling, mut driving] = [supported(), supported(), supported()];
    ProportionalLoading::prescribe(&mut moving, &[3], Component::X, 2.0).unwrap();
    moving.report_group("end", vec![3], vec![0.0, 0.0]);
    pulling.add_force(1, Component::X, 3.0);
    pulling.add_force(2, Component::X, 5.0);
    pulling.report_group("end", vec![3], vec![8.0, 0.0]);
    driving.add_force(2, Component::X, 7.0);
    driving.driving[3] = 5.0;
    driving.report_group("end", vec![3], vec![7.0, 0.0]);
    vec![moving, pulling, driving]
}

fn course(timed: Timed, amplitude: Amplitude) -> LoadInTime {
    LoadInTime { amplitude, timed }
}

fn in_time(timed: Timed) -> LoadsInTime {
    let ramp = Amplitude::pulse(Shape::Ramp, 0.0, 2.0);
    let courses = [
        course(timed, ramp),
        course(Timed::Value, Amplitude::through(&[[0.0, 1.0], [1.0, 3.0]])),
        course(Timed::Velocity, Amplitude::constant()),
    ];
    let control = courses[0].clone();
    LoadsInTime::new(loads().into(), courses.into(), Some(control))
}

/// The ramp t/2 is 1/2 at t = 1; its integral is t^2/4, the second one t^3/12.
#[test]
fn motions_follow_the_amplitude_its_integral_or_its_second_integral() {
    for (timed, expected) in [
        (Timed::Value, 0.5),
        (Timed::Velocity, 0.25),
        (Timed::Acceleration, 1.0 / 12.0),
    ] {
        let loads = in_time(timed);
        let mut displacement = vec![9.0; 8];
        loads.prescribe(1.0, &mut displacement);
        let moved = 2.0 * expected;
        let all = [0.0, 0.0, 9.0, 9.0, 9.0, 9.0, moved, 9.0];
        assert!(
            displacement
                .iter()
                .zip(all)
                .all(|(a, b)| (a - b).abs() < 1e-15)
        );
        assert!((loads.control_displacement(1.0, &displacement) - moved).abs() < 1e-15);
        assert!((loads.control_factor(1.0) - expected).abs() < 1e-15);
    }
    let loads = in_time(Timed::Value);
    let prescribed: Vec<usize> = (0..8).filter(|&dof| loads.is_prescribed(dof)).collect();
    assert_eq!(prescribed, [0, 1, 6]);
    assert_eq!(loads.loaded_degrees_of_freedom(), [2, 3, 4, 6]);
}

/// At t = 1/2 the factors of the forces are 2 and, of the constant velocity, 1/2.
#[test]
fn forces_are_sums_over_the_loads_in_any_order_of_the_degrees_of_freedom() {
    let loads = in_time(Timed::Value);
    let forces = loads.forces(0.5, &[4, 3, 2, 7]);
    assert_eq!(forces, [2.0 * 5.0 + 0.5 * 7.0, 0.5 * 5.0, 2.0 * 3.0, 0.0]);
    assert_eq!(
        loads.given_resultants(0.5),
        [vec![2.0 * 8.0 + 0.5 * 7.0, 0.0]]
    );
    assert_eq!(loads.groups()[0].name, "end");
}

/// A reaction is the internal force less the given one; the force that drives a spring is a part of the reaction.
#[test]
fn reactions_act_at_supports_motions_and_springs() {
    let loads = in_time(Timed::Value);
    let values = vec![1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0];
    assert_eq!(
        loads.reactions(0.5, &values),
        [1.0, 2.0, 0.0, 4.0, 0.0, 0.0, 7.0, 0.0]
    );
    let internal = InternalForces {
        values,
        force_scale: 8.0,
        moment_scale: 0.0,
        thermal: 0.0,
        on_rigid_bodies: Vec::new(),
    };
    assert_eq!(loads.control_force(0.5, &internal), 7.0);
}

/// A body without loads has supports and nothing else.
#[test]
fn a_body_without_loads_is_held_and_not_loaded() {
    let control = Control {
        kind: ControlKind::Force,
        points: Vec::new(),
        shape: Vec::new(),
        magnitude: 0.0,
    };
    let mut supported = ProportionalLoading::new(LAYOUT, control);
    ProportionalLoading::prescribe(&mut supported, &[1], Component::Y, 0.0).unwrap();
    let loads = LoadsInTime::new(Arc::new([supported]), Arc::new([]), None);
    let mut displacement = vec![1.0; 8];
    loads.prescribe(3.0, &mut displacement);
    assert_eq!(displacement, [1.0, 1.0, 1.0, 0.0, 1.0, 1.0, 1.0, 1.0]);
    assert_eq!(loads.forces(3.0, &[0, 3]), [0.0, 0.0]);
    assert_eq!(loads.control_displacement(3.0, &displacement), 0.0);
    assert!(loads.given_resultants(3.0).is_empty());
}
