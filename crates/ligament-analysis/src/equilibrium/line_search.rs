//! Line search for the part of a correction along which the residual force does positive work.

/// Work along a correction, relative to the work at its beginning, at which the search ends.
const NEAR: f64 = 0.5;

/// Largest ratio of a part to the one tried before.
const GROWTH: f64 = 4.0;

/// Least distance of a new part from the ends of its interval, over the length of the interval.
const INSIDE: f64 = 0.1;

/// Part of a correction du at which the work r . du of the residual force is near zero, the first minimum of the potential energy
/// along the correction (Nocedal and Wright 2006, section 3.5).
///
/// `work` is the work at part zero, `now` the work at part one with the state measured there, and `at` computes both at other parts, found
/// by the secant method; the last of at most `tries` is returned. Without positive work at the beginning (equations that are not
/// definite) the whole correction is taken.
pub(super) fn part<T>(
    work: f64,
    mut now: (f64, T),
    tries: usize,
    mut at: impl FnMut(f64) -> (f64, T),
) -> (f64, T) {
    let mut part = 1.0;
    let mut before = (0.0, work);
    let mut beyond = None;
    for _ in 1..tries {
        let left = now.0;
        let is_near = left.abs() <= NEAR * work;
        // Work that is not finite ends the search.
        if is_near || work <= 0.0 || !left.is_finite() {
            break;
        }
        if left > 0.0 {
            before = (part, left);
        } else {
            beyond = Some((part, left));
        }
        part = match beyond {
            None => further(part, left / work),
            Some(beyond) => between(before, beyond),
        };
        now = at(part);
    }
    (part, now.1)
}

/// Next part where the work is still positive, `share` of the work at the beginning.
fn further(part: f64, share: f64) -> f64 {
    let falls = share < 1.0;
    let zero = if falls { 1.0 / (1.0 - share) } else { GROWTH };
    part * zero.min(GROWTH)
}

/// Part between two parts, with positive work at the first and none or negative work at the second.
fn between((start, some): (f64, f64), (end, none): (f64, f64)) -> f64 {
    let zero = some / (some - none);
    start + (end - start) * zero.clamp(INSIDE, 1.0 - INSIDE)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(tries: usize, work: impl Fn(f64) -> f64) -> (f64, Vec<f64>) {
        let mut tried = vec![1.0];
        let (part, ()) = part(work(0.0), (work(1.0), ()), tries, |part| {
            tried.push(part);
            (work(part), ())
        });
        assert_eq!(tried.last(), Some(&part));
        (part, tried)
    }

    /// The zero of a straight line is found at the second try, wherever it is within the growth, and not searched where the whole
    /// correction is near enough.
    #[test]
    fn a_straight_line_is_met_at_once() {
        assert_eq!(found(5, |part| 2.0 * (1.2 - part)), (1.0, vec![1.0]));
        assert_eq!(found(5, |part| 2.0 * (4.0 - part)), (4.0, vec![1.0, 4.0]));
        assert_eq!(found(5, |part| 2.0 * (0.5 - part)), (0.5, vec![1.0, 0.5]));
    }

    /// Beyond a bend: the work is positive up to 1.5, and negative from there on.
    #[test]
    fn a_zero_is_enclosed() {
        let (part, tried) = found(5, |part| if part < 1.5 { 1.0 } else { -2.0 * (part - 1.5) });
        assert!((1.0..2.0).contains(&part), "{tried:?}");
        assert!(tried.len() <= 5);
    }

    /// Friction that reverses within a hundred thousandth of the correction: the work jumps from one value to its opposite, and halving the
    /// interval is all that the secant method can do.
    #[test]
    fn a_leap_is_enclosed_where_there_are_tries() {
        let leap = |part: f64| (1e5 * (1e-3 - part)).clamp(-1.0, 1.0);
        let (part, tried) = found(53, leap);
        assert!(leap(part).abs() <= NEAR && tried.len() < 25, "{tried:?}");
        assert_eq!(leap(found(5, leap).0), -1.0);
    }

    #[test]
    fn equations_that_are_not_definite_are_not_searched() {
        assert_eq!(found(5, |_| -1.0), (1.0, vec![1.0]));
        assert_eq!(
            found(5, |part| if part > 0.0 { f64::NAN } else { 1.0 }).0,
            1.0
        );
    }
}
