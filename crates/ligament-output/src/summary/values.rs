//! Values that a summary writes and reads in more than one form.

use std::borrow::Cow;

use serde::{Deserialize, Deserializer};

/// A word that is a constant of the program where the summary was made, and text where it was read.
pub type Text = Cow<'static, str>;

/// A number, for which JSON stores null where it is infinite or NaN.
pub(super) fn number<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    Ok(Option::deserialize(deserializer)?.unwrap_or(f64::NAN))
}
