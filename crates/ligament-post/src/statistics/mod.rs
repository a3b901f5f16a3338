//! Statistics of many specimens: quantiles, and Weibull's distribution fitted to strengths.

mod quantile;
mod weibull;

pub use quantile::quantile;
pub use weibull::{NoFit, WeibullFit, plotting_position};
