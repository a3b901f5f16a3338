//! Numbering of the unknowns: which components of which points the system of equations solves for.

use std::sync::Arc;

use ligament_model::Bonds;
pub use ligament_model::layout::{Component, Layout};
use ligament_model::subdomain::Subdomain;

use crate::restraints::Restraints;

/// Unknown degrees of freedom, numbered in the order of the points.
#[derive(Debug, Clone, PartialEq)]
pub struct Unknowns {
    layout: Layout,
    number: Vec<u32>,
    degrees_of_freedom: Vec<u32>,
    restraints: Arc<Restraints>,
}

const KNOWN: u32 = u32::MAX;

/// Number of an unknown at a point of another process.
const ELSEWHERE: u32 = u32::MAX - 1;

impl Unknowns {
    /// Unknowns at all degrees of freedom that are not fixed and have a stiffness.
    ///
    /// Where k_t = 0 (nu = 1/3 in plane stress, 1/4 in plane strain) no bond resists the rotation of a point: such rotations carry
    /// no moments and are fixed at zero.
    pub fn all_but(system: &dyn Bonds, is_fixed: impl Fn(usize) -> bool) -> Self {
        let (layout, subdomain) = (system.layout, &system.subdomain);
        let resisted = (system.rigidities()).resisted(&system.ends, layout, subdomain);
        Self::select(layout, |dof| !is_fixed(dof) && resisted[dof])
    }

    /// Unknowns that are rotations.
    pub fn rotations_only(&self) -> Self {
        let is_rotation = |dof: usize| self.layout.component(dof).is_rotation();
        Self::select(self.layout, |dof| {
            is_rotation(dof) && self.number(dof).is_some()
        })
    }

    fn select(layout: Layout, is_unknown: impl Fn(usize) -> bool) -> Self {
        let mut number = vec![KNOWN; layout.n_degrees_of_freedom()];
        let mut degrees_of_freedom = Vec::new();
        for (dof, number) in number.iter_mut().enumerate() {
            if is_unknown(dof) {
                *number = degrees_of_freedom.len() as u32;
                degrees_of_freedom.push(dof as u32);
            }
        }
        Self {
            layout,
            number,
            degrees_of_freedom,
            restraints: Arc::default(),
        }
    }

    /// Unknowns at owned points, numbered; unknowns at other points lose their numbers.
    pub(crate) fn of_owned(mut self, subdomain: &Subdomain) -> Self {
        let layout = self.layout;
        (self.degrees_of_freedom).retain(|&dof| subdomain.owns(layout.point(dof as usize)));
        let unknown = self.number.iter_mut().filter(|it| **it != KNOWN);
        unknown.for_each(|it| *it = ELSEWHERE);
        for (number, &dof) in (0..).zip(&self.degrees_of_freedom) {
            self.number[dof as usize] = number;
        }
        self
    }

    /// Unknowns with restraints between them and the ground.
    pub fn restrained_by(self, restraints: &Arc<Restraints>) -> Self {
        Self {
            restraints: restraints.clone(),
            ..self
        }
    }

    /// Restraints that resist the unknowns in addition to the bonds.
    pub fn restraints(&self) -> &Arc<Restraints> {
        &self.restraints
    }

    /// Layout of the degrees of freedom.
    pub fn layout(&self) -> Layout {
        self.layout
    }

    /// Number of unknowns.
    pub fn len(&self) -> usize {
        self.degrees_of_freedom.len()
    }

    /// Whether there are no unknowns.
    pub fn is_empty(&self) -> bool {
        self.degrees_of_freedom.is_empty()
    }

    /// Number of the unknown at a degree of freedom; None where it is not unknown, or numbered by another process.
    pub fn number(&self, degree_of_freedom: usize) -> Option<usize> {
        let number = self.number[degree_of_freedom];
        (number < ELSEWHERE).then_some(number as usize)
    }

    /// Degrees of freedom that are unknowns of any process.
    pub(crate) fn of_all(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.number.len()).filter(|&dof| self.is_unknown(dof))
    }

    /// Whether a degree of freedom is an unknown of any process.
    pub(crate) fn is_unknown(&self, degree_of_freedom: usize) -> bool {
        self.number[degree_of_freedom] != KNOWN
    }

    /// Degree of freedom of each unknown, ascending.
    pub fn degrees_of_freedom(&self) -> &[u32] {
        &self.degrees_of_freedom
    }

    /// Numbers of the unknowns of a point, and their indices among its components.
    pub(crate) fn of_point(
        &self,
        point: usize,
    ) -> impl Iterator<Item = (usize, usize)> + Clone + '_ {
        let dofs = self.layout.range(point as u32).enumerate();
        dofs.filter_map(|(place, dof)| Some((self.number(dof)?, place)))
    }
}
