//! Positions, times and speeds of fast cracks, from the broken bonds alone.

use anyhow::Context;
use ligament::Model;
use ligament_analysis::history::BreakRecord;

use crate::case_run::Number;
use crate::crack_path::middle;

/// A bond that broke.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Break {
    /// Time, s.
    pub(super) time: f64,
    /// Middle of the bond, m.
    pub(super) at: [f64; 2],
}

/// The broken bonds of a motion in their order.
pub(super) fn breaks(model: &Model, records: &[BreakRecord]) -> Vec<Break> {
    let all = records.iter();
    all.map(|record| Break {
        time: record.load_factor,
        at: middle(model, record.bond as usize).at,
    })
    .collect()
}

/// Branches of a crack from a notch.
pub(super) struct Branches {
    /// Number of cracks: 2 with branches on both sides of the line of the notch, otherwise 1.
    pub(super) cracks: f64,
    /// First broken bond of the upper branch; NaN without branches.
    pub(super) first: Break,
    /// Largest speed of the broken bond farthest from the tip, m/s.
    pub(super) speed: f64,
}

impl Branches {
    /// Branches of a crack from (`tip_x`, `tip_y`), whose bonds break more than `beside` (m) from the line of the notch; speeds are over a `window`
    /// of time (s).
    pub(super) fn new(breaks: &[Break], number: Number<'_>) -> anyhow::Result<Self> {
        let tip = [number("tip_x")?, number("tip_y")?];
        let beside = number("beside")?;
        let side = |sign: f64| {
            let mut all = breaks.iter();
            all.find(|it| sign * (it.at[1] - tip[1]) > beside)
        };
        let none = Break {
            time: f64::NAN,
            at: [f64::NAN; 2],
        };
        let branches = side(1.0).zip(side(-1.0));
        Ok(Self {
            cracks: if branches.is_some() { 2.0 } else { 1.0 },
            first: branches.map_or(none, |(upper, _)| *upper),
            speed: largest_speed(breaks.iter(), tip, number("window")?),
        })
    }
}

/// Cracks from two notches.
pub(super) struct CracksOfNotches {
    /// Mean angle of the cracks with the x axis, degrees.
    pub(super) angle: f64,
    /// Time at which the first crack is a `horizon` away from its tip, s.
    pub(super) start: f64,
    /// Largest speed, m/s.
    pub(super) speed: f64,
}

impl CracksOfNotches {
    /// Cracks from the notches with tips at (`tip_x`, `upper_tip`) and (`tip_x`, `lower_tip`), on their outer sides and steeper than 45 degrees;
    /// `middle` is between them.
    pub(super) fn new(breaks: &[Break], number: Number<'_>) -> anyhow::Result<Self> {
        let (middle, horizon) = (number("middle")?, number("horizon")?);
        let [mut angle, mut start, mut speed] = [0.0, f64::INFINITY, 0.0_f64];
        for (tip, sign) in [("upper_tip", 1.0), ("lower_tip", -1.0)] {
            let tip = [number("tip_x")?, number(tip)?];
            let is_outside =
                |it: &&Break| sign * (it.at[1] - tip[1]) > (it.at[0] - tip[0]).max(0.0);
            let is_away = |it: &&Break| distance(it.at, tip) > horizon;
            let of_notch = || {
                let half = breaks.iter().filter(|it| sign * (it.at[1] - middle) > 0.0);
                half.filter(is_outside).filter(is_away)
            };
            let first = of_notch().next().context("no crack grows from a notch")?;
            start = first.time.min(start);
            let places: Vec<[f64; 2]> = of_notch().map(|it| it.at).collect();
            angle += 0.5 * direction(&places).abs().to_degrees();
            speed = largest_speed(of_notch(), tip, number("window")?).max(speed);
        }
        Ok(Self {
            angle,
            start,
            speed,
        })
    }
}

/// Distance of two places, m.
fn distance([x, y]: [f64; 2], [u, v]: [f64; 2]) -> f64 {
    (x - u).hypot(y - v)
}

/// Largest speed, m/s, of the bond farthest from an origin, over windows of a duration (s).
fn largest_speed<'a>(
    breaks: impl Iterator<Item = &'a Break>,
    origin: [f64; 2],
    window: f64,
) -> f64 {
    let mut front: Vec<[f64; 2]> = Vec::new();
    for it in breaks {
        let reach = distance(it.at, origin);
        if front.last().is_none_or(|[_, last]| reach > *last) {
            front.push([it.time, reach]);
        }
    }
    let Some(&[end, _]) = front.last() else {
        return 0.0;
    };
    let starts = front.iter().filter(|[time, _]| time + window <= end);
    let speeds = starts.map(|[time, reach]| {
        let within = front.partition_point(|[later, _]| *later <= time + window);
        let [later, far] = front[within - 1];
        if later > *time {
            (far - reach) / (later - time)
        } else {
            0.0
        }
    });
    speeds.fold(0.0, f64::max)
}

/// Angle of the principal axis of places with the x axis, rad, from -pi/2 to pi/2.
fn direction(places: &[[f64; 2]]) -> f64 {
    let count = places.len() as f64;
    let mean = [0, 1].map(|axis| places.iter().map(|at| at[axis]).sum::<f64>() / count);
    let moment = |one: usize, other: usize| -> f64 {
        let products = places
            .iter()
            .map(|at| (at[one] - mean[one]) * (at[other] - mean[other]));
        products.sum()
    };
    0.5 * (2.0 * moment(0, 1)).atan2(moment(0, 0) - moment(1, 1))
}

/// Speed of Rayleigh waves over the speed of shear waves, for Poisson's ratio in plane strain (nu/(1 + nu) stands for it in plane stress): the
/// root x = c^2/c_S^2 of x^3 - 8 x^2 + (24 - 16 k) x - 16 (1 - k) = 0, k = (1 - 2 nu)/(2 - 2 nu) (Rayleigh 1885).
pub(super) fn rayleigh(poisson: f64) -> f64 {
    let ratio = (1.0 - 2.0 * poisson) / (2.0 - 2.0 * poisson);
    let value = |x: f64| ((x - 8.0) * x + 24.0 - 16.0 * ratio) * x - 16.0 * (1.0 - ratio);
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let half = 0.5 * (low + high);
        if value(half) < 0.0 {
            low = half;
        } else {
            high = half;
        }
    }
    low.sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rayleigh_waves_of_a_quarter_have_the_speed_in_closed_form() {
        let expected = (2.0 - 2.0 / 3f64.sqrt()).sqrt();
        assert!((rayleigh(0.25) - expected).abs() < 1e-12);
    }

    #[test]
    fn the_front_of_a_crack_has_its_speed_and_direction() {
        let places = (0..50).map(|step| {
            let reach = f64::from(step);
            [0.6 * reach, 0.8 * reach]
        });
        let breaks: Vec<Break> = (places.clone().enumerate())
            .map(|(step, at)| Break {
                time: 0.5 * step as f64,
                at,
            })
            .collect();
        let speed = largest_speed(breaks.iter().rev(), [0.0; 2], 3.0);
        assert_eq!(speed, 0.0, "the farthest one broke first");
        let speed = largest_speed(breaks.iter(), [0.0; 2], 3.0);
        assert!((speed - 2.0).abs() < 1e-12);
        let angle = direction(&places.collect::<Vec<_>>());
        assert!((angle.tan() - 4.0 / 3.0).abs() < 1e-12);
    }
}
