//! Intervals of convergence of the results of runs at two sizes.

use serde::Serialize;

use super::bodies::{SizedBodies, SizedBody};
use super::interval::{Interval, Refusal, Samples};
use super::no_limit::{Kind, NoLimit, kind};
use crate::quantities::{Quantities, QuantityError};

/// Reasons of a termination after which runs of all sizes are at the same load or displacement.
const SAME_ENDS: [&str; 4] = [
    "steps-done",
    "full-load",
    "displacement-reached",
    "energy-dissipated",
];

/// Fraction of the largest force below which the force of a support on one point is negligible: its effect on the work grows with the square.
const NO_FORCE: f64 = 0.01;

/// Number of natural modes with an interval if none is named.
const MODES: usize = 6;

/// A run at one of the sizes.
#[derive(Debug, Clone)]
pub(super) struct SizedRun<'a> {
    pub(super) body: &'a SizedBody,
    pub(super) results: Quantities,
    /// Folder of the results.
    pub(super) folder: String,
}

/// A result with its interval, or the reason why it has none.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Evaluated {
    /// Name of the result in `summary.json`.
    pub name: String,
    /// Short name.
    pub label: String,
    /// SI unit, `-` without one.
    pub unit: String,
    /// Interval of convergence.
    pub interval: Option<Interval>,
    /// Reason why there is no interval.
    pub refused: Option<String>,
    /// Values of the runs at h and at 2h.
    pub samples: Samples,
    /// Value with the second mesher minus value with the first at h, relative to the mean.
    pub mesher: Option<f64>,
    /// Change with 4/3 of the horizon factor at the same horizon, relative to the mean.
    pub families: Option<f64>,
}

/// Runs of a case at both sizes, with the data for their intervals.
pub(super) struct Runs<'a> {
    pub(super) bodies: &'a SizedBodies,
    /// Runs of the bodies, in their order.
    pub(super) runs: Vec<SizedRun<'a>>,
    /// Runs of the fine bodies with 4/3 of the horizon factor; none without them.
    pub(super) more_bonds: Vec<Quantities>,
    pub(super) no_limit: NoLimit,
    /// Number of dimensions of space.
    pub(super) dimensions: u32,
    /// Thickness of a body in the plane, m.
    pub(super) thickness: f64,
}

impl Runs<'_> {
    /// Ratio of the spacings of the points at 2h and h.
    pub(super) fn ratio(&self) -> f64 {
        let [fine, coarse] = self
            .samples("points")
            .map(|it| it.iter().sum::<f64>() / it.len() as f64);
        (fine / coarse).powf(1.0 / f64::from(self.dimensions))
    }

    /// The runs of one size.
    pub(super) fn by_size(&self, is_fine: bool) -> impl Iterator<Item = &SizedRun<'_>> {
        let runs = self.runs.iter();
        runs.filter(move |run| run.body.is_fine == is_fine)
    }

    /// Mean spacing of the points of a run, m; none without the number of points and the volume.
    pub(super) fn spacing(&self, run: &SizedRun<'_>) -> Option<f64> {
        let [volume, points] = ["volume", "points"].map(|name| run.results.number(name).ok());
        let size = if self.dimensions == 3 {
            volume?
        } else {
            volume? / self.thickness
        };
        Some((size / points?).powf(1.0 / f64::from(self.dimensions)))
    }

    /// Values of a result in the runs at h and at 2h; runs without it are left out.
    fn samples(&self, name: &str) -> [Vec<f64>; 2] {
        let values = |is_fine| {
            let runs = self.by_size(is_fine);
            runs.filter_map(|run| run.results.number(name).ok())
                .collect()
        };
        [true, false].map(values)
    }

    /// The named results with their intervals; without names the usual results.
    ///
    /// # Errors
    ///
    /// If no run has a result of a name.
    pub(super) fn evaluate(&self, names: &[String]) -> Result<Vec<Evaluated>, QuantityError> {
        let usual = self.usual_names();
        let names = if names.is_empty() { &usual } else { names };
        let first = self.runs.first().map(|run| &run.results);
        for name in names {
            if let Some(Err(error @ QuantityError::Unknown { .. })) =
                first.map(|it| it.number(name))
            {
                return Err(error);
            }
        }
        Ok(names.iter().map(|name| self.result(name)).collect())
    }

    /// Names of the results to evaluate where none are given.
    fn usual_names(&self) -> Vec<String> {
        let Some(first) = self.runs.first().map(|run| &run.results) else {
            return Vec::new();
        };
        let mut names = vec!["elastic_stiffness".to_owned()];
        let has_failed = |run: &SizedRun<'_>| {
            let counts = ["broken_bonds", "softened_bonds"].map(|name| run.results.number(name));
            counts.into_iter().flatten().any(|count| count > 0.0)
        };
        let breaks = self.runs.iter().any(has_failed);
        if breaks {
            let of_breakage = ["first_break.reaction", "peak.reaction"];
            names.extend(of_breakage.map(str::to_owned));
        }
        names.push("certificate.work".to_owned());
        if breaks {
            names.push("certificate.crack_area".to_owned());
        }
        let probes = first
            .iter()
            .map(|(name, _)| name)
            .filter(|name| name.starts_with("probes_at_end."));
        names.extend(probes.map(str::to_owned));
        let is_elastic = |mode: &usize| {
            let kind = first
                .get(&format!("modes.{mode}.kind"))
                .and_then(|it| it.as_str());
            kind == Some("elastic")
        };
        let count = (0..)
            .take_while(|mode| first.get(&format!("modes.{mode}.kind")).is_some())
            .count();
        let modes = (0..count).filter(is_elastic).take(MODES);
        names.extend(modes.map(|mode| format!("modes.{mode}.frequency")));
        names.retain(|name| self.runs.iter().any(|run| run.results.number(name).is_ok()));
        names
    }

    fn result(&self, name: &str) -> Evaluated {
        let [fine, coarse] = self.samples(name);
        let samples = Samples { fine, coarse };
        let is_complete = samples.fine.len() + samples.coarse.len() == self.runs.len();
        let refused = match is_complete {
            true => self.refusal(kind(name)),
            false => Some(Refusal::Missing.to_string()),
        };
        let interval = match &refused {
            Some(reason) => Err(reason.clone()),
            None => {
                (samples.interval(self.ratio(), self.bodies.floor)).map_err(|it| it.to_string())
            }
        };
        let mean = interval.as_ref().ok().map(|it| it.fine);
        let families = mean.zip(interval.as_ref().ok()).and_then(|(mean, it)| {
            let values: Vec<f64> = self
                .more_bonds
                .iter()
                .filter_map(|run| run.number(name).ok())
                .collect();
            let more = values.iter().sum::<f64>() / values.len() as f64;
            // With the same horizon the spacing of the usual family is 4/3 h, between h and 2h.
            let between = it.fine + (it.coarse - it.fine) / 3.0;
            (!values.is_empty()).then(|| (more - between) / mean)
        });
        let mesher = match samples.fine[..] {
            [first, second] => mean.map(|mean| (second - first) / mean),
            _ => None,
        };
        let (label, unit) = self.label_and_unit(name);
        let (interval, refused) = match interval {
            Ok(interval) => (Some(interval), None),
            Err(reason) => (None, Some(reason)),
        };
        Evaluated {
            name: name.to_owned(),
            label,
            unit,
            interval,
            refused,
            samples,
            mesher,
            families,
        }
    }

    /// Reason why results of a kind have no interval, whatever their values.
    fn refusal(&self, kind: Kind) -> Option<String> {
        let is_unsettled = |run: &&SizedRun<'_>| run.results.ends_not_at_rest();
        if let (Kind::Breakage | Kind::AtEnd | Kind::Work, Some(run)) =
            (kind, self.runs.iter().find(is_unsettled))
        {
            return Some(format!(
                "bonds were still breaking at the end of the run {}",
                run.body.label
            ));
        }
        if let Some(reason) = self.no_limit.reason(kind) {
            return Some(reason.to_owned());
        }
        if matches!(kind, Kind::Stiffness | Kind::Work)
            && let Some(reason) = self.loaded_support()
        {
            return Some(reason);
        }
        let ends = self
            .runs
            .iter()
            .filter_map(|run| run.results.get("termination")?.as_str());
        if let (Kind::AtEnd | Kind::Work, Some(end)) =
            (kind, ends.into_iter().find(|end| !SAME_ENDS.contains(end)))
        {
            return Some(format!(
                "runs end at different loads ({end}): end them at one displacement"
            ));
        }
        None
    }

    /// Reason why stiffness and work have no limit, if a support on one point carries a force.
    fn loaded_support(&self) -> Option<String> {
        let results = &self.runs.first()?.results;
        let force = |group: &str| {
            let prefix = format!("reactions_at_peak.{group}.force_");
            let along = results.iter().filter(|(name, _)| name.starts_with(&prefix));
            along
                .filter_map(|(_, value)| value.as_f64())
                .fold(0.0, f64::hypot)
        };
        let names = results.iter().filter_map(|(name, _)| {
            let (group, _) = name
                .strip_prefix("reactions_at_peak.")?
                .rsplit_once(".force_")?;
            Some(group)
        });
        let largest = names.map(force).fold(0.0, f64::max);
        let mut supports = self.no_limit.supports_on_a_point.iter();
        let loaded = supports.find(|group| force(group) > NO_FORCE * largest)?;
        Some(format!(
            "the support `{loaded}` carries its force on one point, under which the displacement grows with the logarithm of 1/h: \
             support a length, or read a probe"
        ))
    }

    fn label_and_unit(&self, name: &str) -> (String, String) {
        let first = self.runs.first().map(|run| &run.results);
        let unit = |key: &str| first.and_then(|it| it.get(&format!("units.{key}"))?.as_str());
        let (force, length) = (
            unit("force").unwrap_or("-"),
            unit("displacement").unwrap_or("-"),
        );
        let stiffness = if length == "-" {
            force.to_owned()
        } else {
            format!("{force}/{length}")
        };
        let (label, unit) = match name {
            "elastic_stiffness" => ("stiffness", &*stiffness),
            "first_break.reaction" => ("first breakage", force),
            "first_peak.reaction" => ("first peak", force),
            "peak.reaction" => ("peak", force),
            "certificate.work" => ("work", "J"),
            "certificate.crack_area" => ("cracks", "m^2"),
            other => match other.strip_prefix("probes_at_end.") {
                Some(probe) => (probe, "-"),
                None if other.ends_with(".frequency") => {
                    let mode = other
                        .trim_start_matches("modes.")
                        .trim_end_matches(".frequency");
                    let number = mode.parse::<usize>().map_or(0, |it| it + 1);
                    return (format!("mode {number}"), "Hz".to_owned());
                }
                None if other.ends_with(".displacement") => (other, length),
                None => (other, "-"),
            },
        };
        (label.to_owned(), unit.to_owned())
    }
}
