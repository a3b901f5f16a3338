//! Messages for the notices of a run, with the tags of the body.

use ligament::Body;
use ligament::setup::{Analysis, Setup};
use ligament_analysis::history::{LargestOverlap, Notice};
use ligament_model::ElementKind;
use ligament_model::law::{BondLaw, listed, suited};

use crate::gauges;

/// Largest number of points listed in a notice.
const SHOWN: usize = 5;

/// A message without the load step or time at its beginning.
pub(crate) fn bare(message: &str) -> &str {
    let is_moment = |it: &str| it.starts_with("step ") || it.starts_with("time ");
    match message.split_once(": ") {
        Some((moment, rest)) if is_moment(moment) => rest,
        _ => message,
    }
}

/// Messages in their order, in which those that say the same, at whatever step or time, are one with their number.
pub fn counted(messages: impl IntoIterator<Item = String>) -> Vec<String> {
    let mut all: Vec<(String, usize)> = Vec::new();
    for message in messages {
        match all.iter_mut().find(|it| bare(&it.0) == bare(&message)) {
            Some((_, count)) => *count += 1,
            None => all.push((message, 1)),
        }
    }
    let counted = all.into_iter().map(|(message, count)| match count {
        1 => message,
        _ => format!("{message} ({count} times)"),
    });
    counted.collect()
}

/// Message for a notice of a run of a setup, with points by their tags.
pub fn words(notice: &Notice, body: &dyn Body, setup: &Setup) -> String {
    match notice {
        Notice::FreeBody(free) => gauges::words(free, body, setup.closing),
        Notice::PartsDetached {
            step,
            points,
            first,
            ..
        } => format!(
            "step {step}: a part of {points} points (around {}) broke off; its rigid motion is fixed so that the equations stay solvable",
            body.label(*first)
        ),
        Notice::Mechanisms { step, points } => {
            let in_file = body.numbering().sorted(points).into_owned();
            let shown = in_file.iter().take(SHOWN);
            let tags: Vec<String> = shown.map(|&point| body.tag(point).to_string()).collect();
            format!(
                "step {step}: fixed {} mechanism(s), motions that no bond resists, at {}(s) {}",
                points.len(),
                body.tagged(),
                tags.join(", ")
            )
        }
        Notice::Overlap(LargestOverlap { depth, ends, step }) => {
            let ends = body.numbering().ordered(*ends);
            let [a, b] = ends.map(|end| body.label(end));
            format!(
                "step {step}: the faces of a crack overlap by {depth:.2e} m between {a} and {b}, because they carry no pressure; {}",
                remedy_of_overlap(setup)
            )
        }
        Notice::Turned {
            step,
            points,
            first,
            angle,
        } => format!(
            "step {step}: a part of {points} points (around {}) has turned by {angle:.2} rad; forces are linear in the motions, so that turning \
             strains it by {:.1e} (half of the square of the angle) and costs energy: what it does from here on is not valid",
            body.label(*first),
            0.5 * angle * angle
        ),
        Notice::PastPeak { .. } => format!("{notice} (fracture.control = \"event\")"),
        Notice::Undeformed => format!("{notice} ([[support]])"),
        Notice::Unstable { .. }
        | Notice::AtOnce(_)
        | Notice::LostBalance { .. }
        | Notice::AtRest { .. }
        | Notice::NegativeEnergy { .. }
        | Notice::EnergyUnbalanced { .. }
        | Notice::DissipatedBeyondWork { .. } => notice.to_string(),
    }
}

/// What lets faces of cracks carry pressure in a setup.
fn remedy_of_overlap(setup: &Setup) -> String {
    let turns = setup.law.element() == ElementKind::Beam;
    match &setup.analysis {
        Analysis::Motion(it) if it.is_explicit() => {
            "[[contact]] with `cracks = true` lets them".to_owned()
        }
        _ if turns => "`closing = true` in [model] lets them".to_owned(),
        _ => {
            let laws = suited(|it| it.shear_form.is_some());
            let laws = listed(&laws, BondLaw::quoted);
            format!("`closing = true` in [model] lets them with laws whose points turn ({laws})")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_that_say_the_same_are_one_with_their_number() {
        let told = [
            "a: b",
            "step 3: c",
            "time 1e-3 s: c",
            "d",
            "step 4: d",
            "step 5: c",
        ];
        let found = counted(told.map(str::to_owned));
        assert_eq!(found, ["a: b", "step 3: c (3 times)", "d (2 times)"]);
    }
}
