//! Comparison of single values.

/// Description of two values and their relative difference.
pub(super) fn apart(then: &str, now: &str) -> String {
    let values = then.parse::<f64>().ok().zip(now.parse::<f64>().ok());
    let relative = values.map(|(then, now)| (now - then).abs() / then.abs().max(now.abs()));
    match relative {
        Some(0.0) => format!("{then} then, {now} now, the same number in another notation"),
        Some(relative) if relative.is_finite() => {
            format!("{then} then, {now} now, relative difference {relative:.1e}")
        }
        _ => format!("{then} then, {now} now"),
    }
}
