//! A setup with the names of its points.

use crate::body::Body;
use crate::setup::Setup;

/// A setup, and the points of the whole body for descriptions.
#[derive(Clone, Copy)]
pub(crate) struct Described<'a> {
    pub(crate) setup: &'a Setup,
    pub(crate) names: &'a dyn Body,
}
