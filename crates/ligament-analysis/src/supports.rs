//! What holds a body that nothing loads.

use crate::unknowns::{COMPONENTS, Component};

/// Degrees of freedom held at zero, and the groups of points that hold them.
#[derive(Debug, Clone, PartialEq)]
pub struct Supports {
    /// For each degree of freedom, whether it is held, shape (3 n_points).
    pub held: Vec<bool>,
    /// The supported groups.
    pub groups: Vec<SupportGroup>,
}

/// A supported set of points.
#[derive(Debug, Clone, PartialEq)]
pub struct SupportGroup {
    /// Name of the group.
    pub name: String,
    /// Points, ascending.
    pub points: Vec<u32>,
}

impl Supports {
    /// A body of `n_points` points that nothing holds.
    pub fn none(n_points: usize) -> Self {
        Self {
            held: vec![false; COMPONENTS * n_points],
            groups: Vec::new(),
        }
    }

    /// Holds some components of the points of a group.
    pub fn hold(&mut self, name: &str, points: Vec<u32>, components: &[Component]) {
        for &point in &points {
            for component in components {
                self.held[COMPONENTS * point as usize + component.index()] = true;
            }
        }
        let name = name.to_owned();
        self.groups.push(SupportGroup { name, points });
    }
}
