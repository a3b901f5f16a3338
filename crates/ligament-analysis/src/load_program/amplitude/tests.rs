use super::{Amplitude, Shape};

/// Nodes and weights of Gauss and Legendre's rule with five points on [-1, 1], exact for degree 9.
const GAUSS: [[f64; 2]; 5] = [
    [-0.906_179_845_938_664, 0.236_926_885_056_189_1],
    [-0.538_469_310_105_683, 0.478_628_670_499_366_5],
    [0.0, 0.568_888_888_888_888_9],
    [0.538_469_310_105_683, 0.478_628_670_499_366_5],
    [0.906_179_845_938_664, 0.236_926_885_056_189_1],
];

fn quadrature(function: impl Fn(f64) -> f64, [from, to]: [f64; 2]) -> f64 {
    let half = 0.5 * (to - from);
    let terms = GAUSS.map(|[node, weight]| weight * function(from + half * (1.0 + node)));
    half * terms.iter().sum::<f64>()
}

/// All kinds, with kinks at multiples of 0.125 only.
fn all() -> Vec<Amplitude> {
    let shapes = [
        Shape::Sine { periods: 1 },
        Shape::Sine { periods: 3 },
        Shape::HalfSine,
        Shape::Triangle,
        Shape::Rectangle,
        Shape::Ramp,
        Shape::SmoothRamp,
    ];
    let pulses = shapes.map(|it| Amplitude::pulse(it, 0.5, 1.25));
    let others = [
        Amplitude::constant(),
        Amplitude::ricker(1.0, 1.5),
        Amplitude::through(&[[0.25, 2.0], [0.5, -1.0], [1.5, 0.5]]),
        Amplitude::through(&[[-1.0, 3.0], [1.0, -1.0]]),
        Amplitude::through(&[[0.0, 0.0], [0.125, 1.0]]),
    ];
    pulses.into_iter().chain(others).collect()
}

/// The rule on 512 parts leaves the smooth functions here an error below 1e-13, and is exact for polynomials.
#[test]
fn integrals_are_those_of_the_values() {
    for amplitude in all() {
        let (mut first, mut second) = (0.0, 0.0);
        for part in 0..512 {
            let span = [part, part + 1].map(|it| f64::from(it) / 128.0);
            first += quadrature(|time| amplitude.value(time), span);
            second += quadrature(|time| amplitude.integral(time), span);
            let end = span[1];
            let gaps = [
                amplitude.integral(end) - first,
                amplitude.second_integral(end) - second,
            ];
            assert!(
                gaps.iter().all(|gap| gap.abs() < 1e-12),
                "{amplitude:?} at {end}: {gaps:?}"
            );
        }
        assert_eq!(amplitude.integral(0.0), 0.0);
        assert_eq!(amplitude.second_integral(0.0), 0.0);
    }
}

#[test]
fn values_are_those_of_the_shapes() {
    let value = |shape: Shape, time: f64| Amplitude::pulse(shape, 1.0, 2.0).value(time);
    for shape in [
        Shape::Sine { periods: 2 },
        Shape::HalfSine,
        Shape::Triangle,
        Shape::Rectangle,
    ] {
        assert_eq!(
            [value(shape, 0.9), value(shape, 3.1)],
            [0.0; 2],
            "{shape:?}"
        );
    }
    for shape in [Shape::Ramp, Shape::SmoothRamp] {
        assert_eq!([value(shape, 0.9), value(shape, 3.1)], [0.0, 1.0]);
        // 10/8 - 15/16 + 6/32 = 1/2 is exact in binary numbers.
        assert_eq!(value(shape, 2.0), 0.5);
    }
    assert_eq!(value(Shape::Triangle, 1.5), 0.5);
    assert_eq!(value(Shape::Triangle, 2.5), 0.5);
    assert_eq!(value(Shape::Rectangle, 1.0), 1.0);
    assert_eq!(value(Shape::HalfSine, 2.0), 1.0);
    assert_eq!(value(Shape::Sine { periods: 2 }, 1.25), 1.0);
    let table = Amplitude::through(&[[1.0, 2.0], [3.0, 4.0]]);
    assert_eq!(
        [0.0, 2.0, 9.0].map(|time| table.value(time)),
        [2.0, 3.0, 4.0]
    );
    assert_eq!(Amplitude::constant().value(7.0), 1.0);
    let ricker = Amplitude::ricker(2.0, 5.0);
    assert_eq!(ricker.value(2.0), 1.0);
    // The wavelet is zero where 2 a = 1.
    let zero = 2.0 + 0.5f64.sqrt() / (std::f64::consts::PI * 5.0);
    assert!(ricker.value(zero).abs() < 1e-14);
}

/// A smooth ramp has no kink: its slope at both ends is zero.
#[test]
fn a_smooth_ramp_begins_and_ends_without_slope() {
    let ramp = Amplitude::pulse(Shape::SmoothRamp, 0.0, 1.0);
    assert!(ramp.value(1e-4) < 1e-11);
    assert!(1.0 - ramp.value(1.0 - 1e-4) < 1e-11);
}

#[test]
fn what_a_displacement_cannot_follow_jumps() {
    let jumps: Vec<bool> = all().iter().map(Amplitude::jumps).collect();
    let expected = [
        false, false, false, false, true, false, false, true, false, true, true, false,
    ];
    assert_eq!(jumps, expected);
}

#[test]
fn the_shortest_time_is_that_of_the_fastest_part() {
    let times: Vec<Option<f64>> = all().iter().map(Amplitude::shortest_time).collect();
    let (pulse, wavelet) = (Some(1.25), Some(1.0 / 1.5));
    assert_eq!(times[1], Some(1.25 / 3.0));
    assert_eq!(times[2..7], [pulse; 5]);
    assert_eq!(times[7..9], [None, wavelet]);
    assert_eq!(times[9..], [Some(0.25), Some(1.0), Some(0.125)]);
}
