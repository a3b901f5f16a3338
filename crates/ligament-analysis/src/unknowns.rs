//! Numbering of the unknowns: which components of which points the system of equations solves for.

use ligament_model::Bonds;
pub use ligament_model::layout::Component;

/// Components of a point: displacement along x, along y, rotation.
pub const COMPONENTS: usize = ligament_model::element::UNKNOWNS;

/// The degrees of freedom (3 n_points) that are unknown, numbered in the order of the points.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Unknowns {
    number: Vec<u32>,
    degrees_of_freedom: Vec<u32>,
}

const KNOWN: u32 = u32::MAX;

impl Unknowns {
    /// Everything that is not fixed and has a stiffness at all.
    ///
    /// Where k_t = 0 (nu = 1/3 in plane stress, 1/4 in plane strain) no bond resists the rotation of a point, and bonds without
    /// rotations never do: such rotations carry nothing and are held at zero.
    pub fn all_but(system: &dyn Bonds, is_fixed: impl Fn(usize) -> bool) -> Self {
        let resisted = system.resisted();
        Self::select(system.n_points(), |point, component| {
            let dof = COMPONENTS * point + component.index();
            !is_fixed(dof) && resisted[dof]
        })
    }

    /// Only the rotations among other unknowns.
    pub fn rotations_only(&self) -> Self {
        Self::select(self.number.len() / COMPONENTS, |point, component| {
            component == Component::Rotation
                && self
                    .number(COMPONENTS * point + component.index())
                    .is_some()
        })
    }

    fn select(n_points: usize, is_unknown: impl Fn(usize, Component) -> bool) -> Self {
        let mut number = vec![KNOWN; COMPONENTS * n_points];
        let mut degrees_of_freedom = Vec::new();
        for point in 0..n_points {
            for component in Component::ALL {
                if is_unknown(point, component) {
                    let degree_of_freedom = COMPONENTS * point + component.index();
                    number[degree_of_freedom] = degrees_of_freedom.len() as u32;
                    degrees_of_freedom.push(degree_of_freedom as u32);
                }
            }
        }
        Self {
            number,
            degrees_of_freedom,
        }
    }

    /// Number of unknowns.
    pub fn len(&self) -> usize {
        self.degrees_of_freedom.len()
    }

    /// Whether nothing is unknown.
    pub fn is_empty(&self) -> bool {
        self.degrees_of_freedom.is_empty()
    }

    /// Number of the unknown at a degree of freedom.
    pub fn number(&self, degree_of_freedom: usize) -> Option<usize> {
        let number = self.number[degree_of_freedom];
        (number != KNOWN).then_some(number as usize)
    }

    /// Degree of freedom of each unknown, ascending.
    pub fn degrees_of_freedom(&self) -> &[u32] {
        &self.degrees_of_freedom
    }

    /// Range of the numbers of the unknowns of a point, and which components they are.
    pub(crate) fn of_point(
        &self,
        point: usize,
    ) -> impl Iterator<Item = (usize, usize)> + Clone + '_ {
        (0..COMPONENTS).filter_map(move |c| {
            self.number(COMPONENTS * point + c)
                .map(|number| (number, c))
        })
    }
}
