//! Checks of properties that vary at random.

use ligament_model::Advice;
use ligament_model::scatter::{Distribution, Scattered};

use super::Setup;
use super::check::{Checked, contradiction, require};
use super::setting::Setting;
use crate::error::Field;

impl Setup {
    /// Refuses distributions with factors out of range, and scatter that no criterion depends on.
    pub(super) fn check_scatter(&self) -> Checked {
        let Some(scatter) = self.scatter else {
            return Ok(());
        };
        let field = Field::whole("scatter");
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
        let length = scatter.correlation_length;
        let is_length = length >= 0.0 && length.is_finite();
        let expected = "at least 0";
        require(
            is_length,
            field.part("correlation_length"),
            expected,
            length,
        )?;
        if !self.analysis.is_fracture() {
            return contradiction(field, "no bond breaks in this analysis: remove it");
        }
        if self.criteria.iter().any(|it| it.feels(scatter.of)) {
            return Ok(());
        }
        let (text, other) = match scatter.of {
            Scattered::Strength => (
                "no criterion has a limit from a strength or of its own, so that nothing varies: take {}",
                Scattered::FractureEnergy,
            ),
            Scattered::FractureEnergy => (
                "no criterion takes the fracture energy, so that nothing varies: take {}",
                Scattered::Strength,
            ),
        };
        let other = Setting::Scattered(other);
        contradiction(field.part("of"), Advice::new(text, [other]))
    }
}
