//! Far field of a body.

use super::conditions::Place;

/// Far field of a meshed body, where linear finite elements take the place of bonds.
#[derive(Debug, Clone, PartialEq)]
pub struct FarField {
    /// Parts of the body that keep their bonds: the cells of which all corners lie in one of them.
    pub near: Vec<Place>,
}
