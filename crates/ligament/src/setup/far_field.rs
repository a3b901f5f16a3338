//! Far field of a body.

use super::conditions::Place;

/// Far field of a meshed body, where linear finite elements take the place of bonds.
#[derive(Debug, Clone, PartialEq)]
pub struct FarField {
    /// Parts of the body that keep their bonds: the cells of which all corners lie in one of them.
    pub near: Vec<Place>,
    /// Share of the strength, above 0 and up to 1, that the principal stresses of elements may reach. Where a run meets a larger one the near field
    /// grows, and the run begins anew. Without one the near field stays as it is.
    pub strength_share: Option<f64>,
}
