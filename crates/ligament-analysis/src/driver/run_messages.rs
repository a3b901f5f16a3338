//! Messages to the user about records, each once a run.

use ligament_model::contact::Overlap;
use ligament_model::layout::Layout;
use nalgebra::{Matrix3, Vector3};

use crate::balanced::Balanced;
use crate::connectivity::{AddedSupport, Fragments};
use crate::history::{LargestOverlap, StepRecord};
use crate::problem::Problem;
use crate::state::State;
use crate::user_message::Message;

/// Largest imbalance of energies, relative to the work: energies are exact between two equilibria, whose residual is 1e-10.
const ENERGY_ERROR: f64 = 1e-6;

/// Largest imbalance of energies where bonds soften: the residual of equilibria is up to 1e-6.
const SOFTENING_ENERGY_ERROR: f64 = 1e-4;

/// Share of the largest work by which the dissipated energy may exceed the work spent before load steps count as too coarse: where
/// bonds soften, work and released energy follow the chords of a step, dissipation the curves between them.
const DISSIPATED_BEYOND: f64 = 0.05;

/// Overlap of two faces, relative to the largest displacement of a point, above which results are not valid for a body with a
/// crack. A part of an intact body of the size of a horizon shortens by less.
const LARGEST: f64 = 0.1;

/// Overlap over the point spacing that is rounding, in a body that is unloaded again.
const ROUNDING: f64 = 1e-12;

/// Angle from which on a fragment counts as turned, rad: linear motions make it longer by half of its square, .5 %.
const TURNED: f64 = 0.1;

/// Message about the parts that a breakage detached and whose rigid motions some added supports hold.
pub(super) fn detached_parts(fragments: &Fragments, holds: &[AddedSupport]) -> Option<Message> {
    let mut loose: Vec<u32> = holds.iter().map(|hold| hold.fragment).collect();
    loose.dedup();
    let extent = |fragment: &u32| fragments.extents[*fragment as usize];
    let first = extent(loose.first()?).first;
    let points: usize = loose.iter().map(|fragment| extent(fragment).n_points).sum();
    let text = format!(
        "a part of {points} points (around {{}}) broke off; its rigid motion is fixed so that the equations stay solvable"
    );
    Some(Message::new("parts-detached", text).of_points([first]))
}

/// Message about the mechanisms that the factorisation found on the way to an equilibrium.
pub(super) fn mechanisms(balanced: &Balanced) -> Option<Message> {
    let points = &balanced.mechanisms;
    (!points.is_empty()).then(|| {
        let text = format!(
            "fixed {} mechanism(s), motions that no bond resists, at {{all}}",
            points.len()
        );
        Message::new("mechanisms", text).of_points(points.as_slice())
    })
}

/// Message about the first fragment of a motion that has turned so far that forces linear in the motions are in error.
pub(super) fn turned(
    problem: &Problem,
    state: &State,
    fragments: &Fragments,
    step: usize,
) -> Option<Message> {
    let system = &*problem.system;
    let motions = system.motions_about_centre(&system.volumes).motions;
    let angles = fragments.points.iter().map(|points| match points.len() {
        1 => 0.0,
        _ => angle(system.layout, &motions, points, &state.displacement),
    });
    let most = |most: (usize, f64), it: (usize, f64)| if it.1 > most.1 { it } else { most };
    let (fragment, angle) = angles.enumerate().fold((0, TURNED), most);
    (angle > TURNED).then(|| {
        let extent = fragments.extents[fragment];
        let text = format!(
            "a part of {} points (around {{}}) has turned by {angle:.2} rad; forces are linear in the motions, so that turning strains it by {:.1e} \
             (half of the square of the angle) and costs energy: what it does from here on is not valid",
            extent.n_points,
            0.5 * angle * angle
        );
        let message = Message::new("turned", text).of_points([extent.first]);
        message.in_step(step)
    })
}

/// Angle by which points have turned, rad: the least-squares fit of unit rotations, which are among rigid motions of all points (n_motions,
/// n_degrees_of_freedom), to displacements of all points (n_degrees_of_freedom), both without their means.
fn angle(layout: Layout, motions: &[Vec<f64>], points: &[u32], displacement: &[f64]) -> f64 {
    let n_axes = layout
        .components
        .iter()
        .filter(|it| !it.is_rotation())
        .count();
    let without_mean = |motion: &[f64]| {
        let of_points = points.iter().flat_map(|&point| {
            let own = &motion[layout.range(point)];
            own[..n_axes].iter().copied()
        });
        let mut values: Vec<f64> = of_points.collect();
        for axis in 0..n_axes {
            let own = values.iter().skip(axis).step_by(n_axes);
            let mean = own.sum::<f64>() / points.len() as f64;
            for value in values.iter_mut().skip(axis).step_by(n_axes) {
                *value -= mean;
            }
        }
        values
    };
    let turns: Vec<Vec<f64>> = motions[n_axes..]
        .iter()
        .map(|it| without_mean(it))
        .collect();
    let moved = without_mean(displacement);
    let product = |one: &[f64], other: &[f64]| -> f64 {
        one.iter().zip(other).map(|(one, other)| one * other).sum()
    };
    let matrix = Matrix3::from_fn(|row, column| match (turns.get(row), turns.get(column)) {
        (Some(row), Some(column)) => product(row, column),
        _ => f64::from(u8::from(row == column)),
    });
    let sums = Vector3::from_fn(|row, _| turns.get(row).map_or(0.0, |it| product(it, &moved)));
    // Points on a line turn about it by any angle.
    matrix.try_inverse().map_or(0.0, |it| (it * sums).norm())
}

/// Message about the first record whose energies do not balance, given the record before it; None for forces without an energy.
pub(super) fn energies(
    problem: &Problem,
    record: &StepRecord,
    last: Option<&StepRecord>,
) -> Option<Message> {
    let system = &problem.system;
    if !system.element.is_linear() || !system.element.has_energy() {
        return None;
    }
    let limit = if problem.criteria.soften() {
        SOFTENING_ENERGY_ERROR
    } else {
        ENERGY_ERROR
    };
    // An error that is not a number counts as an imbalance.
    let is_balanced = |it: &StepRecord| it.energy_error().abs() <= limit;
    let is_first = !is_balanced(record) && last.is_none_or(is_balanced);
    is_first.then(|| {
        let text = format!(
            "work, stored and released energy differ by {:.1e} of the work: do not trust the results from here on",
            record.energy_error().abs()
        );
        Message::new("energy-unbalanced", text).in_step(record.step)
    })
}

/// Message about the first record at which bonds have dissipated more than work minus stored energy.
pub(super) fn dissipation(record: &StepRecord, before: &[StepRecord]) -> Option<Message> {
    let work = |it: &StepRecord| it.external_work.abs();
    let largest = before.iter().map(work).fold(work(record), f64::max);
    let beyond = |it: &StepRecord| it.dissipated_energy - (it.external_work - it.stored_energy);
    // Without dissipation it is the rounding of a body that nothing has loaded yet.
    let is_beyond =
        |it: &StepRecord| it.dissipated_energy > 0.0 && beyond(it) > DISSIPATED_BEYOND * largest;
    let is_first = is_beyond(record) && !before.last().is_some_and(is_beyond);
    is_first.then(|| {
        let text = format!(
            "bonds have dissipated more than the work minus the stored energy, by {:.1e} of the work: the load steps are too coarse for the \
             softening",
            beyond(record) / largest
        );
        let message = Message::new("dissipated-beyond-work", text).in_step(record.step);
        message.with_advice("take smaller steps")
    })
}

/// Message about the first state with overlapping crack faces; updates the largest overlap so far.
pub(super) fn overlap(
    problem: &Problem,
    state: &State,
    fragments: &Fragments,
    step: usize,
    largest_so_far: &mut Option<LargestOverlap>,
) -> Option<Message> {
    let Overlap { depth, ends } = largest(problem, state, fragments)?;
    let now = LargestOverlap { depth, ends, step };
    let is_first = largest_so_far.is_none();
    if largest_so_far.is_none_or(|before| before.depth < depth) {
        *largest_so_far = Some(now);
    }
    is_first.then(|| {
        let text = format!(
            "the faces of a crack overlap by {depth:.2e} m between {{all}}, because they carry no pressure"
        );
        let message = Message::new("overlap", text).of_points(ends).in_step(step);
        message.with_advice("`closing` lets them")
    })
}

/// Largest overlap of faces in a state, if it exceeds the limits.
///
/// A part without any supports stays where it was detached, so that its overlap is not counted; nor are faces that meet as surfaces.
fn largest(problem: &Problem, state: &State, fragments: &Fragments) -> Option<Overlap> {
    let mut contacts = problem.contact.contacts.iter();
    if contacts.any(|it| it.rigid_body.is_none() && it.surfaces.has_faces_of_cracks()) {
        return None;
    }
    let system = &*problem.system;
    let layout = system.layout;
    let displacements = layout.displacements(&state.displacement);
    let displacement = displacements.fold(0.0, |largest: f64, it| largest.max(it.abs()));
    let displacement = system.subdomain.max(displacement);
    let mut holds = vec![0.0; fragments.len()];
    let held = (0..state.held.len()).filter(|&dof| state.held[dof]);
    let held_points = held.map(|dof| layout.point(dof));
    for point in held_points.filter(|&it| system.subdomain.owns(it)) {
        holds[fragments.of_point[point as usize] as usize] += 1.0;
    }
    system.subdomain.all_reduce_sum(&mut holds);
    let is_held = |fragment: &u32| holds[*fragment as usize] < layout.components.len() as f64;
    let asked: Vec<bool> = fragments.of_point.iter().map(is_held).collect();
    let expansion = problem.loads.thermal_strain(state.load_factor);
    let spacing = system.spacing.iter().copied().fold(0.0, f64::max);
    let spacing = system.subdomain.max(spacing);
    let beyond = (LARGEST * displacement).max(ROUNDING * spacing);
    system.overlap(
        &state.intact,
        &state.displacement,
        expansion,
        beyond,
        &asked,
    )
}
