//! A quantity of the history of a run over time: its extrema, zeros and phases.

use std::f64::consts::{PI, TAU};

use anyhow::Context;

/// Share of the duration after which a record fades out before its Fourier transform.
const FADE: f64 = 0.8;

/// Share of the duration in which a part of a record fades in.
const FADE_IN: f64 = 0.1;

/// Values at equal times.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Record {
    /// Times, s.
    pub(crate) times: Vec<f64>,
    /// Values at the times.
    pub(crate) values: Vec<f64>,
}

impl Record {
    /// Value at a time within the record, between rows by a straight line.
    pub(crate) fn at(&self, time: f64) -> anyhow::Result<f64> {
        let after = self.times.partition_point(|it| *it < time);
        let value = |place: usize| self.times.get(place).copied().zip(self.values.get(place));
        let (late, end) = value(after).context("the motion ends before the time")?;
        let Some((early, start)) = after.checked_sub(1).and_then(value) else {
            return Ok(*end);
        };
        Ok(start + (end - start) * (time - early) / (late - early))
    }

    /// Value in the first row from a (possibly rounded) time on.
    pub(crate) fn from(&self, time: f64) -> anyhow::Result<f64> {
        let place = self.times.partition_point(|it| *it < time * (1.0 - 1e-9));
        let found = self.values.get(place).copied();
        found.context("the motion ends before the time")
    }

    /// Time and size of the largest value within a window of time, by the parabola through it and its neighbours.
    pub(crate) fn peak(&self, [from, to]: [f64; 2]) -> anyhow::Result<[f64; 2]> {
        let inner = 1..self.values.len().saturating_sub(1);
        let places = inner.filter(|&it| (from..=to).contains(&self.times[it]));
        let place = places.max_by(|&one, &other| self.values[one].total_cmp(&self.values[other]));
        let place = place.context("the motion has no rows in the window")?;
        let [before, at, after] = [place - 1, place, place + 1].map(|it| self.values[it]);
        let curvature = before - 2.0 * at + after;
        let shift = match curvature {
            0.0 => 0.0,
            _ => 0.5 * (before - after) / curvature,
        };
        let spacing = self.times[place + 1] - self.times[place];
        Ok([
            self.times[place] + shift * spacing,
            at - 0.25 * (before - after) * shift,
        ])
    }

    /// First time after `from` at which the values fall through zero, between rows by a straight line.
    pub(crate) fn time_of_fall(&self, from: f64) -> anyhow::Result<f64> {
        self.falls(from).first().copied().context("no zero follows")
    }

    /// Frequency at which the values fall through zero after `from`.
    pub(crate) fn frequency(&self, from: f64) -> anyhow::Result<f64> {
        let falls = self.falls(from);
        let (first, last) = falls.first().zip(falls.last()).context("no vibration")?;
        Ok(falls.len().saturating_sub(1) as f64 / (last - first))
    }

    /// All times after `from` at which the values fall through zero.
    fn falls(&self, from: f64) -> Vec<f64> {
        let pairs = self.times.windows(2).zip(self.values.windows(2));
        let falling =
            pairs.filter(|(times, values)| times[0] >= from && values[0] > 0.0 && values[1] <= 0.0);
        falling
            .map(|(times, values)| {
                times[0] + (times[1] - times[0]) * values[0] / (values[0] - values[1])
            })
            .collect()
    }

    /// Real and imaginary part of the Fourier transform at an angular frequency; the last fifth of the record fades out.
    fn transform(&self, omega: f64) -> [f64; 2] {
        let end = self.times.last().copied().unwrap_or_default();
        let weight = |time: f64| match time / end {
            share if share < FADE => 1.0,
            share => 0.5 + 0.5 * (PI * (share - FADE) / (1.0 - FADE)).cos(),
        };
        let rows = self.times.iter().zip(&self.values);
        rows.fold([0.0; 2], |[real, imaginary], (&time, value)| {
            let value = value * weight(time);
            let (sine, cosine) = (omega * time).sin_cos();
            [real + value * cosine, imaginary - value * sine]
        })
    }

    /// Real and imaginary part of the [transform](Self::transform) of the part of the record that begins at a time and fades in.
    pub(crate) fn transform_from(&self, from: f64, omega: f64) -> [f64; 2] {
        let duration = FADE_IN * self.times.last().copied().unwrap_or_default();
        let weight = |time: &f64| match (time - from) / duration {
            share if share < 0.0 => 0.0,
            share if share < 1.0 => 0.5 - 0.5 * (PI * share).cos(),
            _ => 1.0,
        };
        let values = self.times.iter().map(weight).zip(&self.values);
        let part = Self {
            times: self.times.clone(),
            values: values.map(|(weight, value)| weight * value).collect(),
        };
        part.transform(omega)
    }

    /// Phase lags, rad, of another record behind this one at multiples of a small angular frequency.
    fn delays(&self, other: &Self, step: f64, count: usize) -> Vec<[f64; 2]> {
        let mut last = 0.0;
        let mut delays = Vec::with_capacity(count);
        for place in 1..=count {
            let omega = step * place as f64;
            let angle = |record: &Self| {
                let [real, imaginary] = record.transform(omega);
                imaginary.atan2(real)
            };
            let mut delay = angle(self) - angle(other);
            delay += TAU * ((last - delay) / TAU).round();
            last = delay;
            delays.push([omega, delay]);
        }
        delays
    }
}

/// Number of angular frequencies of a spectrum, and the least number of points per wavelength of the fastest wave in it.
const SPECTRUM: (usize, f64) = (400, 6.0);

/// Phase speed over `speed` (m/s) of waves with a number of `points` per wavelength, by linear interpolation in the spectrum of the delays
/// between two records; the records are from places `gauge` apart on a lattice with a `spacing`, m.
pub(crate) fn phase_speed(
    [near, far]: [&Record; 2],
    points: f64,
    [speed, gauge, spacing]: [f64; 3],
) -> anyhow::Result<f64> {
    let (count, shortest) = SPECTRUM;
    let step = TAU * speed / (shortest * spacing) / count as f64;
    let delays = near.delays(far, step, count).into_iter();
    let spectrum = delays.map(|[omega, delay]| {
        [
            TAU * gauge / (delay * spacing),
            omega * gauge / delay / speed,
        ]
    });
    let spectrum: Vec<[f64; 2]> = spectrum.collect();
    let around = spectrum
        .windows(2)
        .find(|pair| pair[0][0] >= points && points >= pair[1][0]);
    let [[long, fast], [short, slow]] = around
        .and_then(|pair| <[[f64; 2]; 2]>::try_from(pair).ok())
        .context("no wave of this length was found")?;
    Ok(fast + (slow - fast) * (points - long) / (short - long))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn record(value: impl Fn(f64) -> f64) -> Record {
        let times: Vec<f64> = (0..1000).map(|row| 0.01 * f64::from(row)).collect();
        Record {
            values: times.iter().map(|&time| value(time)).collect(),
            times,
        }
    }

    #[test]
    fn a_late_pulse_is_behind_by_its_delay() {
        let pulse = |time: f64| (-20.0 * (time - 2.0).powi(2)).exp();
        let (first, second) = (record(pulse), record(|time| pulse(time - 3.004)));
        for [omega, delay] in first.delays(&second, 0.1, 60) {
            assert!((delay / omega - 3.004).abs() < 1e-9, "{omega} {delay}");
        }
        let [time, size] = second.peak([0.0, 10.0]).unwrap();
        assert!((time - 5.004).abs() < 1e-4 && (size - 1.0).abs() < 1e-4);
        assert!(second.peak([11.0, 12.0]).is_err());
    }

    /// Two pulses of one shape: the transform of the second alone has their ratio, and the phase of its delay.
    #[test]
    fn a_part_of_a_record_has_a_transform_of_its_own() {
        let pulse = |time: f64| (-20.0 * (time - 2.0).powi(2)).exp();
        let first = record(pulse);
        let both = record(|time| pulse(time) - 0.03 * pulse(time - 4.0));
        let omega = 5.0;
        let [cosine, sine] = first.transform_from(0.0, omega);
        let [late_cosine, late_sine] = both.transform_from(4.0, omega);
        let ratio = late_cosine.hypot(late_sine) / cosine.hypot(sine);
        assert!((ratio - 0.03).abs() < 1e-6, "{ratio}");
        let turn = (omega * 4.0).sin_cos();
        let turned = -0.03 * (cosine * turn.1 + sine * turn.0);
        assert!((late_cosine - turned).abs() < 1e-6 * cosine.hypot(sine));
    }

    #[test]
    fn zeros_lie_between_rows() {
        let wave = record(|time| (time - 0.1234).cos());
        let falls = wave.falls(0.0);
        assert_eq!(falls.len(), 2);
        assert!((falls[0] - 0.1234 - PI / 2.0).abs() < 1e-5);
        assert!((wave.time_of_fall(3.0).unwrap() - 0.1234 - 2.5 * PI).abs() < 1e-5);
        assert!(wave.time_of_fall(9.0).is_err());
    }
}
