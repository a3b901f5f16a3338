//! Messages for the notices of a run, with the tags of the body.

use ligament::Body;
use ligament_analysis::history::{LargestOverlap, Notice};

use crate::gauges;

/// Largest number of points listed in a notice.
const SHOWN: usize = 5;

/// Message for a notice, with points by their tags; `closing`: whether faces of cracks carry pressure where they close.
pub fn words(notice: &Notice, body: &dyn Body, closing: bool) -> String {
    match notice {
        Notice::FreeBody(free) => gauges::words(free, body, closing),
        Notice::PartsDetached {
            step,
            points,
            motions,
            first,
        } => format!(
            "step {step}: {points} points came loose, {motions} rigid motions of theirs are held from now on \
             (first at {})",
            body.label(*first)
        ),
        Notice::Mechanisms { step, points } => {
            let in_file = body.numbering().sorted(points).into_owned();
            let shown = in_file.iter().take(SHOWN);
            let tags: Vec<String> = shown.map(|&point| body.tag(point).to_string()).collect();
            format!(
                "step {step}: {} mechanism(s) without stiffness held, at {}(s) {}",
                points.len(),
                body.tagged(),
                tags.join(", ")
            )
        }
        Notice::Overlap(LargestOverlap { depth, ends, step }) => {
            let ends = body.numbering().ordered(*ends);
            let [a, b] = ends.map(|end| body.label(end));
            format!(
                "step {step}: the faces of a crack pass through each other, by {depth:.2e} m between {a} and {b}, and nothing \
                 keeps them from it; `closing = true` in [model] lets them carry pressure"
            )
        }
        Notice::PastPeak { .. } => format!("{notice} (fracture.control = \"event\")"),
        Notice::Undeformed => format!("{notice} ([[support]])"),
        Notice::Unstable { .. }
        | Notice::AtOnce(_)
        | Notice::NegativeEnergy { .. }
        | Notice::EnergyUnbalanced { .. }
        | Notice::DissipatedBeyondWork { .. } => notice.to_string(),
    }
}
