//! Supports of a body without loads.

use crate::unknowns::{Component, Layout};

/// Degrees of freedom fixed at zero, and the groups of supported points.
#[derive(Debug, Clone, PartialEq)]
pub struct Supports {
    layout: Layout,
    /// Whether each degree of freedom is fixed, shape (n_degrees_of_freedom).
    pub held: Vec<bool>,
    /// Groups of supported points.
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
    /// Supports of a free body.
    pub fn none(layout: Layout) -> Self {
        Self {
            layout,
            held: vec![false; layout.n_degrees_of_freedom()],
            groups: Vec::new(),
        }
    }

    /// Fixes some components of the points of a group, at points that have them.
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
