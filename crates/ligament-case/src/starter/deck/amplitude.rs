//! Steps of a deck, and factors of loads as functions of time.

use ligament_mesh::inp::{Keyword, number};

use super::units;

/// Kind of analysis of a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Procedure {
    Static,
    /// Explicit steps in time.
    Explicit,
    /// Implicit steps in time, each of a length in units of the deck.
    Implicit(f64),
    /// A number of natural modes.
    Modes(usize),
}

impl Procedure {
    pub(super) fn is_motion(self) -> bool {
        matches!(self, Self::Explicit | Self::Implicit(_))
    }
}

/// A step of a deck.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Step {
    pub(super) name: String,
    pub(super) procedure: Procedure,
    /// Duration in units of the deck.
    pub(super) duration: f64,
}

/// Factor of a load as a function of time, in units of the deck.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Amplitude {
    pub(super) name: String,
    points: Vec<[f64; 2]>,
    is_smooth: bool,
    is_total: bool,
}

impl Amplitude {
    /// The amplitude of a keyword; `None` for one that is no table.
    pub(super) fn new(keyword: &Keyword) -> Option<Self> {
        let value = |name: &str| {
            let parameter = keyword.parameter(name)?;
            Some(parameter.value.as_deref()?.to_uppercase())
        };
        let is_smooth = match value("DEFINITION").as_deref() {
            None | Some("TABULAR") => false,
            Some("SMOOTH STEP") => true,
            Some(_) => return None,
        };
        let fields = keyword.data.iter().flat_map(|line| line.fields());
        let numbers = fields.filter(|it| !it.is_empty()).map(|it| number(&it));
        let numbers: Vec<f64> = numbers.collect::<Option<_>>()?;
        let (pairs, []) = numbers.as_chunks::<2>() else {
            return None;
        };
        let is_simple = matches!(pairs, [[_, 0.0], [_, 1.0]]);
        let is_absolute = value("VALUE").is_none_or(|it| it == "RELATIVE");
        (is_absolute && !pairs.is_empty() && (is_simple || !is_smooth)).then(|| Self {
            name: value("NAME").unwrap_or_default(),
            points: pairs.to_vec(),
            is_smooth,
            is_total: value("TIME").is_some_and(|it| it.starts_with("TOTAL")),
        })
    }

    /// Factor at a time.
    fn at(&self, time: f64) -> f64 {
        let after = self.points.partition_point(|it| it[0] <= time);
        match (
            after.checked_sub(1).map(|it| self.points[it]),
            self.points.get(after),
        ) {
            (Some([start, low]), Some([end, high])) => {
                let x = (time - start) / (end - start);
                let x = match self.is_smooth {
                    true => x.powi(3) * (10.0 - 15.0 * x + 6.0 * x * x),
                    false => x,
                };
                low + (high - low) * x
            }
            (Some([_, last]), None) => last,
            (None, first) => first.map_or(1.0, |it| it[1]),
        }
    }

    /// Text of the factors of a load in a stage, times the factor of the load; `start` is the time at which the step begins.
    pub(super) fn factors_text(&self, factor: f64, step: &Step, start: f64) -> String {
        let start = if self.is_total { start } else { 0.0 };
        let inside = self.points.iter().map(|it| it[0] - start);
        let inside = inside.filter(|it| *it > 0.0 && *it < step.duration);
        let mut times: Vec<f64> = inside.collect();
        if self.is_smooth {
            times.extend((1..10).map(|tenth| 0.1 * f64::from(tenth) * step.duration));
        }
        times.push(step.duration);
        times.sort_by(f64::total_cmp);
        times.dedup();
        let pair = |time: &f64| {
            let [share, value] = [time / step.duration, factor * self.at(start + time)];
            format!("[{}, {}]", units::number(share), units::number(value))
        };
        format!(
            "[{}]",
            times.iter().map(pair).collect::<Vec<_>>().join(", ")
        )
    }

    /// Text of the amplitude of a load in a motion, with the unit of time.
    pub(super) fn in_time(&self, second: f64) -> String {
        if let (true, [[start, _], [end, _]]) = (self.is_smooth, self.points.as_slice()) {
            let [start, duration] = [start * second, (end - start) * second].map(units::number);
            return format!(
                "{{ shape = \"smooth-ramp\", start = {start}, duration = {duration} }}"
            );
        }
        let pair = |[time, factor]: &[f64; 2]| {
            format!(
                "[{}, {}]",
                units::number(time * second),
                units::number(*factor)
            )
        };
        let pairs: Vec<String> = self.points.iter().map(pair).collect();
        format!("{{ points = [{}] }}", pairs.join(", "))
    }
}
