//! Results of a case that have no limit as the points become finer, seen before any run.

use ligament::plausibility::singular_place;
use ligament::setup::{Place, Setup};
use ligament_case::case::CaseFile;
use ligament_model::failure::Choice;
use ligament_model::scatter::Scattered;

/// Kind of a result, which determines the reasons to refuse it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// A result that depends on displacements under the loads.
    Stiffness,
    /// A load at which bonds break.
    Breakage,
    /// A value at the end of the run.
    AtEnd,
    /// Work up to the end of the run.
    Work,
    /// Any other result.
    Other,
}

/// Reasons why results of a case have no limit.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct NoLimit {
    /// Reason for stiffness and work: a load acts on one point.
    pub(super) stiffness: Option<String>,
    /// Reason for loads of breakage: bonds break at once by their strength where the stress is singular.
    pub(super) breakage: Option<String>,
    /// Groups of supports on one point, on which stiffness and work depend if they carry a force.
    pub(super) supports_on_a_point: Vec<String>,
}

impl NoLimit {
    /// Reason why results of a kind have no limit.
    pub(super) fn reason(&self, kind: Kind) -> Option<&str> {
        match kind {
            Kind::Breakage => self.breakage.as_deref(),
            Kind::Stiffness | Kind::Work => self.stiffness.as_deref(),
            Kind::AtEnd | Kind::Other => None,
        }
    }

    /// Prints the results that will have no interval, before any run.
    ///
    /// # Errors
    ///
    /// If none of the named results can have one.
    pub(super) fn show(&self, names: &[String], print: &mut dyn FnMut(&str)) -> anyhow::Result<()> {
        let reasons = names.iter().map(|name| self.reason(kind(name)));
        let refused: Option<Vec<&str>> = reasons.collect();
        if let Some(reason) = refused.as_ref().and_then(|all| all.first()) {
            anyhow::bail!("{} has no limit: {reason}", names.join(", "));
        }
        let words = ["stiffness and work", "loads of breakage"];
        for (words, reason) in words.iter().zip([&self.stiffness, &self.breakage]) {
            if let Some(reason) = reason {
                print(&format!("no interval of {words}: {reason}"));
            }
        }
        Ok(())
    }
}

/// Kind of a result by its name.
pub(super) fn kind(name: &str) -> Kind {
    match name {
        "elastic_stiffness" => Kind::Stiffness,
        "certificate.work" | "certificate.stored" => Kind::Work,
        "certificate.crack_area" | "certificate.dissipated" => Kind::AtEnd,
        _ if name.starts_with("probes_at_end.") => Kind::AtEnd,
        _ if ["first_break.", "first_peak.", "peak."]
            .iter()
            .any(|it| name.starts_with(it)) =>
        {
            match name.ends_with(".displacement") {
                true => Kind::Work,
                false => Kind::Breakage,
            }
        }
        _ => Kind::Other,
    }
}

/// The results without a limit of a case with its setup.
pub(super) fn no_limit(case: &CaseFile, setup: &Setup) -> NoLimit {
    let is_point = |place: &Place| match place {
        Place::At(_) => true,
        Place::Group(group) => setup.body.points_of(group).is_some_and(|it| it.len() == 1),
        Place::Everywhere | Place::Box(_) => false,
    };
    let load = setup.loads.iter().find(|load| is_point(&load.place));
    let supports = setup
        .supports
        .iter()
        .filter(|support| is_point(&support.place));
    let named = supports.filter_map(|support| match &support.place {
        Place::Group(group) => Some(group.clone()),
        _ => None,
    });
    NoLimit {
        stiffness: load.map(|load| {
            format!("`{}` loads one point, under which the displacement grows with the logarithm of 1/h: load a length, or read a probe", load.name)
        }),
        breakage: by_strength(setup).and_then(|word| {
            let place = singularity(case, setup)?;
            Some(format!(
                "bonds break at once by their strength (`{word}`) at {place}, where the load of breakage falls with sqrt(h): use a criterion of \
                 energy, or let them soften"
            ))
        }),
        supports_on_a_point: named.collect(),
    }
}

/// Word of a criterion by which bonds break at once and whose limit comes from a strength.
fn by_strength(setup: &Setup) -> Option<&'static str> {
    let is_brittle = |it: &&Choice| !it.after.softens && it.limits_from() == Scattered::Strength;
    let all_brittle = setup.criteria.iter().all(|it| !it.after.softens);
    let first = setup
        .criteria
        .iter()
        .find(is_brittle)
        .filter(|_| all_brittle);
    first.map(|it| it.kind.word)
}

/// Place where the stress of the elastic body is singular: a crack, or a re-entrant corner of a body in the plane.
fn singularity(case: &CaseFile, setup: &Setup) -> Option<String> {
    let has_corners =
        |hole: &ligament_case::case::Hole| hole.rectangle.is_some() || hole.polygon.is_some();
    let lattice = case.case.lattice.as_ref();
    let has_corners = lattice.is_some_and(|it| it.remove.iter().any(has_corners));
    singular_place(setup).or_else(|| has_corners.then(|| "a corner of a hole".to_owned()))
}
