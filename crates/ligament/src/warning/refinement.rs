//! Messages about the refinement of a mesh.

use ligament_analysis::Message;
use ligament_model::scatter::Scattered;

use crate::plausibility::singular_place;
use crate::refined_body::RefinedBody;
use crate::setup::{Place, Refine, Setup};

/// Messages about a pass of a refinement.
///
/// `horizons` (n_points, m) are of the refined body.
pub(crate) fn of_refinement(
    setup: &Setup,
    horizons: &[f64],
    refine: &Refine,
    refined: &RefinedBody,
) -> Vec<Message> {
    let horizon = refined.final_horizon(setup, refine);
    let found = [
        brittle_at_crack(setup),
        short_crack_zone(setup, horizon),
        coarse_beside_fine(setup, horizons, refined.fine_horizon()),
    ];
    found.into_iter().flatten().collect()
}

/// Message about brittle bonds that break by a stress where it is singular: no size is fine enough.
fn brittle_at_crack(setup: &Setup) -> Option<Message> {
    let mut criteria = setup.criteria.iter();
    let by_stress = criteria.find(|it| it.limits_from() == Scattered::Strength)?;
    if setup.criteria.iter().any(|it| it.after.softens) {
        return None;
    }
    let place = singular_place(setup)?;
    let text = format!(
        "brittle bonds break by a stress (`{}`) at {place}: the load of a crack falls with the root of the horizon, by sqrt(2) from pass to pass, \
         and has no limit",
        by_stress.kind.word
    );
    let advice = "take a criterion of energy, or let bonds soften";
    Some(Message::new("no-limit-of-refinement", text).with_advice(advice))
}

/// Message about a zone of softening that is shorter than two horizons (m) of the finest points.
fn short_crack_zone(setup: &Setup, horizon: f64) -> Option<Message> {
    setup.has_short_crack_zone(horizon).then(|| {
        let text = format!(
            "at the crack the horizon will be {horizon:.3e} m, more than half of the characteristic length E G_c/F_t^2: the peak still falls from size to \
             size, and no pass is the last one by the tolerance"
        );
        Message::new("coarse-refinement", text)
            .with_advice("take a smaller `size` or more `levels`")
    })
}

/// Message about loads, supports and parts without failure that are partly fine.
fn coarse_beside_fine(setup: &Setup, horizons: &[f64], fine_horizon: f64) -> Option<Message> {
    let is_fine = |point: &u32| horizons[*point as usize] <= fine_horizon;
    let is_mixed = |points: &[u32]| {
        let fine = points.iter().filter(|it| is_fine(it)).count();
        fine > 0 && fine < points.len()
    };
    let places = (setup.loads.iter().map(|it| &it.place))
        .chain(setup.supports.iter().map(|it| &it.place))
        .chain(&setup.no_fail);
    let groups = places.filter_map(|it| match it {
        Place::Group(group) => Some(group),
        Place::Everywhere | Place::Box(_) | Place::At(_) => None,
    });
    let mut mixed: Vec<String> = groups
        .filter(|group| setup.body.points_of(group).is_some_and(|it| is_mixed(&it)))
        .map(|group| format!("`{group}`"))
        .collect();
    mixed.sort_unstable();
    mixed.dedup();
    (!mixed.is_empty()).then(|| {
        let text = format!(
            "the mesh is fine at a part of {} alone: its stiffness is that of the coarse part",
            mixed.join(", ")
        );
        Message::new("partly-refined-group", text)
    })
}
