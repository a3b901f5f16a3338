//! Advice about an intact model that is unstable.

use ligament::Model;
use ligament::stability::largest_poisson;
use ligament_analysis::Termination;

/// Words for the end of a run of an unstable model, with the largest Poisson's ratio that works for it, which takes a few factorisations.
pub fn end_text(end: &Termination, model: &Model) -> String {
    // Without a model of a smaller ratio there is no advice about it.
    let largest = largest_poisson(model).unwrap_or_default();
    format!("{end}; {}", remedy(largest))
}

/// Advice about an unstable model, with the largest Poisson's ratio that works where it is known.
pub(crate) fn remedy(largest: Option<f64>) -> String {
    let smaller = match largest {
        None => "take a smaller Poisson's ratio or horizon".to_owned(),
        Some(largest) => format!(
            "the largest Poisson's ratio that works for this body and law is {largest}, found by halving"
        ),
    };
    format!(
        "{smaller}; with `allow_unstable = true` in [model] a run goes on all the same, to results that are not to be trusted"
    )
}
