//! Amplitudes: factors of loads as functions of time.

use std::f64::consts::PI;

/// Amplitude: the factor f(t) of a load at a time t, s.
///
/// Value, integral and second integral are closed forms, so that prescribed velocities and accelerations give displacements without errors
/// that depend on time steps. Integrals begin at time zero, where all displacements are zero.
#[derive(Debug, Clone, PartialEq)]
pub struct Amplitude(Course);

#[derive(Debug, Clone, PartialEq)]
enum Course {
    Table(Vec<Knot>),
    Pulse { shape: Shape, span: [f64; 2] },
    Ricker { peak_time: f64, frequency: f64 },
}

/// Point of a piecewise linear amplitude.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Knot {
    time: f64,
    at: Integrals,
}

/// Value, integral and second integral of a function of time.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct Integrals {
    value: f64,
    first: f64,
    second: f64,
}

impl Integrals {
    /// Integrals after a time during which the function changes at a constant rate.
    fn after(self, time: f64, rate: f64) -> Self {
        let Self {
            value,
            first,
            second,
        } = self;
        Self {
            value: value + rate * time,
            first: first + time * (value + rate * time / 2.0),
            second: second + time * (first + time * (value / 2.0 + rate * time / 6.0)),
        }
    }
}

/// Shape of an amplitude with a duration; x runs from 0 at its start to 1 at its end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shape {
    /// Sine of whole periods: sin(2 pi n x).
    Sine {
        /// Number n of periods, from 1.
        periods: u32,
    },
    /// Half a sine: sin(pi x).
    HalfSine,
    /// Triangle: from 0 to 1 at half of the duration, and back.
    Triangle,
    /// Rectangle: 1 from the start until the end.
    Rectangle,
    /// Straight ramp from 0 to 1, which stays there.
    Ramp,
    /// Ramp from 0 to 1 without kinks, which stays there: 10 x^3 - 15 x^4 + 6 x^5.
    SmoothRamp,
}

impl Shape {
    /// Value at x in [0, 1], and its integrals over x from 0.
    fn at(self, x: f64) -> Integrals {
        let [value, first, second] = match self {
            Self::Sine { periods } => waves(2.0 * PI * f64::from(periods), x),
            Self::HalfSine => waves(PI, x),
            Self::Triangle if x <= 0.5 => [2.0 * x, x * x, x.powi(3) / 3.0],
            Self::Triangle => {
                let rest = 1.0 - x;
                let second = 0.5 * x - 0.25 + rest.powi(3) / 3.0;
                [2.0 * rest, 0.5 - rest * rest, second]
            }
            Self::Rectangle => [1.0, x, 0.5 * x * x],
            Self::Ramp => [x, 0.5 * x * x, x.powi(3) / 6.0],
            Self::SmoothRamp => [
                x.powi(3) * (10.0 + x * (6.0 * x - 15.0)),
                x.powi(4) * (2.5 + x * (x - 3.0)),
                x.powi(5) * (0.5 + x * (x / 7.0 - 0.5)),
            ],
        };
        Integrals {
            value,
            first,
            second,
        }
    }

    /// Value after the end.
    fn end(self) -> f64 {
        match self {
            Self::Sine { .. } | Self::HalfSine | Self::Triangle | Self::Rectangle => 0.0,
            Self::Ramp | Self::SmoothRamp => 1.0,
        }
    }
}

/// sin(w x) with its first and second integral over x from 0.
fn waves(w: f64, x: f64) -> [f64; 3] {
    let (sine, half) = ((w * x).sin(), (0.5 * w * x).sin());
    [sine, 2.0 * half * half / w, (x - sine / w) / w]
}

impl Amplitude {
    /// The factor 1 at all times.
    pub fn constant() -> Self {
        Self::through(&[[0.0, 1.0]])
    }

    /// Piecewise linear amplitude through one or more points (t, f) in the order of time, constant before the first and after the last.
    ///
    /// # Panics
    ///
    /// Panics without a point.
    pub fn through(points: &[[f64; 2]]) -> Self {
        let at_zero = Integrals {
            value: linear(points, 0.0),
            ..Integrals::default()
        };
        let mut knots = vec![Knot {
            time: 0.0,
            at: at_zero,
        }];
        let mut last = knots[0];
        for &[time, value] in points.iter().filter(|it| it[0] > 0.0) {
            let span = time - last.time;
            let rate = (value - last.at.value) / span;
            let at = Integrals {
                value,
                ..last.at.after(span, rate)
            };
            last = Knot { time, at };
            knots.push(last);
        }
        Self(Course::Table(knots))
    }

    /// A shape from its start until a duration has passed, s; zero before, and after the end the end value of the shape.
    pub fn pulse(shape: Shape, start: f64, duration: f64) -> Self {
        let span = [start, duration];
        Self(Course::Pulse { shape, span })
    }

    /// Ricker wavelet (1 - 2 a) exp(-a) with a = (pi f (t - t_p))^2, the peak time t_p (s) and the peak frequency f (Hz) of its spectrum
    /// (Ricker 1953).
    pub fn ricker(peak_time: f64, frequency: f64) -> Self {
        Self(Course::Ricker {
            peak_time,
            frequency,
        })
    }

    /// Value at a time.
    pub fn value(&self, time: f64) -> f64 {
        self.at(time).value
    }

    /// Integral from time zero to a time, s.
    pub fn integral(&self, time: f64) -> f64 {
        self.at(time).first
    }

    /// Second integral from time zero to a time, s^2: the integral of the integral.
    pub fn second_integral(&self, time: f64) -> f64 {
        self.at(time).second
    }

    /// Length of the shortest wave in time, s: one period of a sine, the duration of another pulse or ramp, one over the frequency of a
    /// Ricker wavelet, the shortest time between points; None for a constant.
    pub fn shortest_time(&self) -> Option<f64> {
        match &self.0 {
            Course::Table(knots) => {
                let spans = knots.windows(2).map(|it| it[1].time - it[0].time);
                spans.reduce(f64::min)
            }
            Course::Pulse { shape, span } => match *shape {
                Shape::Sine { periods } => Some(span[1] / f64::from(periods)),
                Shape::HalfSine
                | Shape::Triangle
                | Shape::Rectangle
                | Shape::Ramp
                | Shape::SmoothRamp => Some(span[1]),
            },
            Course::Ricker { frequency, .. } => Some(1.0 / frequency),
        }
    }

    /// Whether a displacement with this amplitude would jump at some time, from zero at first.
    pub fn jumps(&self) -> bool {
        match &self.0 {
            Course::Table(knots) => knots[0].at.value != 0.0,
            Course::Pulse { shape, .. } => *shape == Shape::Rectangle,
            Course::Ricker { .. } => false,
        }
    }

    fn at(&self, time: f64) -> Integrals {
        match &self.0 {
            Course::Table(knots) => of_table(knots, time),
            &Course::Pulse { shape, span } => of_pulse(shape, span, time),
            &Course::Ricker {
                peak_time,
                frequency,
            } => of_ricker(peak_time, frequency, time),
        }
    }
}

/// Value at a time on the line through points, constant beyond its ends.
fn linear(points: &[[f64; 2]], time: f64) -> f64 {
    let after = points.partition_point(|it| it[0] <= time);
    match (points[..after].last(), points.get(after)) {
        (Some(&[start, from]), Some(&[end, to])) => {
            from + (to - from) * ((time - start) / (end - start))
        }
        (Some(only), None) | (None, Some(only)) => only[1],
        (None, None) => panic!("an amplitude has a point"),
    }
}

fn of_table(knots: &[Knot], time: f64) -> Integrals {
    let after = knots.partition_point(|it| it.time <= time).max(1);
    let before = knots[after - 1];
    let rate = match knots.get(after) {
        Some(next) => (next.at.value - before.at.value) / (next.time - before.time),
        None => 0.0,
    };
    before.at.after(time - before.time, rate)
}

fn of_pulse(shape: Shape, [start, duration]: [f64; 2], time: f64) -> Integrals {
    let x = (time - start) / duration;
    if x <= 0.0 {
        // A rectangle begins with its start.
        let value = if x == 0.0 { shape.at(0.0).value } else { 0.0 };
        return Integrals {
            value,
            ..Integrals::default()
        };
    }
    let at = if x < 1.0 {
        shape.at(x)
    } else {
        let end = Integrals {
            value: shape.end(),
            ..shape.at(1.0)
        };
        end.after(x - 1.0, 0.0)
    };
    Integrals {
        value: at.value,
        first: duration * at.first,
        second: duration * duration * at.second,
    }
}

fn of_ricker(peak_time: f64, frequency: f64, time: f64) -> Integrals {
    let a = (PI * frequency).powi(2);
    let from_peak = |time: f64| {
        let past = time - peak_time;
        let exponential = (-a * past * past).exp();
        Integrals {
            value: (1.0 - 2.0 * a * past * past) * exponential,
            first: past * exponential,
            second: -exponential / (2.0 * a),
        }
    };
    let (zero, now) = (from_peak(0.0), from_peak(time));
    Integrals {
        value: now.value,
        first: now.first - zero.first,
        second: now.second - zero.second - time * zero.first,
    }
}

#[cfg(test)]
mod tests;
