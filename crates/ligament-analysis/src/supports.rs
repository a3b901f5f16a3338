//! What holds a body that nothing loads.

use crate::unknowns::{Component, Layout};

/// Degrees of freedom held at zero, and the groups of points that hold them.
#[derive(Debug, Clone, PartialEq)]
pub struct Supports {
    layout: Layout,
    /// For each degree of freedom, whether it is held, shape (n_degrees_of_freedom).
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
    /// A body that nothing holds.
    pub fn none(layout: Layout) -> Self {
        Self {
            layout,
            held: vec![false; layout.n_degrees_of_freedom()],
            groups: Vec::new(),
        }
    }

    /// Holds some components of the points of a group, as far as points have them.
    pub fn hold(&mut self, name: &str, points: Vec<u32>, components: &[Component]) {
        for &point in &points {
            for &component in components {
                if let Some(dof) = self.layout.degree_of_freedom(point, component) {
                    self.held[dof] = true;
                }
            }
        }
        let name = name.to_owned();
        self.groups.push(SupportGroup { name, points });
    }
}
