//! Checks of properties that vary at random.

use ligament_model::Advice;
use ligament_model::scatter::{Distribution, Scatter, Scattered};

use super::Setup;
use super::check::{Checked, contradiction, not_negative, require};
use super::setting::Setting;
use crate::error::Field;

impl Setup {
    /// Refuses distributions with factors out of range, a property that varies twice, and scatter that no criterion depends on.
    pub(super) fn check_scatter(&self) -> Checked {
        for (place, scatter) in self.scatter.iter().enumerate() {
            let field = Field::element("scatter", place);
            check_range(scatter, field)?;
            if !self.analysis.is_fracture() {
                return contradiction(field, "no bond breaks in this analysis: remove it");
            }
            let text = if self.scatter[..place].iter().any(|it| it.of == scatter.of) {
                "it varies at random already: take {}, or remove one of the two"
            } else if self.criteria.iter().any(|it| it.feels(scatter.of)) {
                continue;
            } else {
                match scatter.of {
                    Scattered::Strength => {
                        "no criterion has a limit from a strength or of its own, so that nothing varies: take {}"
                    }
                    Scattered::FractureEnergy => {
                        "no criterion takes the fracture energy, so that nothing varies: take {}"
                    }
                }
            };
            let other = Setting::Scattered(scatter.of.other());
            return contradiction(field.part("of"), Advice::new(text, [other]));
        }
        Ok(())
    }
}

/// Refuses a distribution with factors out of range, and a negative length.
fn check_range(scatter: &Scatter, field: Field) -> Checked {
    match scatter.distribution {
        Distribution::Weibull { modulus } => require(
            (1.0..=1e4).contains(&modulus),
            field.part("modulus"),
            "between 1 and 1e4",
            modulus,
        )?,
        Distribution::Normal { deviation } => require(
            deviation > 0.0 && deviation < Distribution::LARGEST_DEVIATION,
            field.part("deviation"),
            "greater than 0 and less than 0.25, so that no strength is negative",
            deviation,
        )?,
        Distribution::Lognormal { deviation } => require(
            deviation > 0.0 && deviation <= 10.0,
            field.part("deviation"),
            "greater than 0 and at most 10",
            deviation,
        )?,
    }
    let length = field.part("correlation_length");
    not_negative(length, scatter.correlation_length)
}
