//! Components of the motion of a point, and their positions in arrays over all degrees of freedom.

use std::ops::Range;

crate::case_type! {
    /// A component of the motion of a point.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Component {
        /// Displacement along x, m.
        X,
        /// Displacement along y, m.
        Y,
        /// Rotation in the plane, rad, counter-clockwise.
        Rotation,
        /// Displacement along z of a solid, m.
        Z,
        /// Rotation about x in a solid, rad, right-handed.
        #[case(serde(rename = "rotation_x"))]
        RotationX,
        /// Rotation about y in a solid, rad, right-handed.
        #[case(serde(rename = "rotation_y"))]
        RotationY,
        /// Rotation about z in a solid, rad, right-handed.
        #[case(serde(rename = "rotation_z"))]
        RotationZ,
    }
}

impl Component {
    /// All components in the plane, in their order at a point.
    pub const ALL: [Self; 3] = [Self::X, Self::Y, Self::Rotation];

    /// All components in space, in their order at a point.
    pub const IN_SPACE: [Self; 6] = [
        Self::X,
        Self::Y,
        Self::Z,
        Self::RotationX,
        Self::RotationY,
        Self::RotationZ,
    ];

    /// All components for a number of dimensions, in their order at a point.
    pub const fn in_dimensions(dimensions: usize) -> &'static [Self] {
        match dimensions {
            2 => &Self::ALL,
            _ => &Self::IN_SPACE,
        }
    }

    /// Whether the component is an angle.
    #[inline]
    pub fn is_rotation(self) -> bool {
        !matches!(self, Self::X | Self::Y | Self::Z)
    }

    /// Index of the component in [`Component::IN_SPACE`]: the rotation of the plane is one about z.
    pub(crate) fn in_space(self) -> usize {
        match self {
            Self::X => 0,
            Self::Y => 1,
            Self::Z => 2,
            Self::RotationX => 3,
            Self::RotationY => 4,
            Self::Rotation | Self::RotationZ => 5,
        }
    }

    /// Name of the conjugate force or moment, as in column names.
    pub fn force_name(self) -> &'static str {
        match self {
            Self::X => "force_x",
            Self::Y => "force_y",
            Self::Rotation => "moment",
            Self::Z => "force_z",
            Self::RotationX => "moment_x",
            Self::RotationY => "moment_y",
            Self::RotationZ => "moment_z",
        }
    }

    /// Name in case files and results.
    pub fn name(self) -> &'static str {
        match self {
            Self::X => "x",
            Self::Y => "y",
            Self::Rotation => "rotation",
            Self::Z => "z",
            Self::RotationX => "rotation_x",
            Self::RotationY => "rotation_y",
            Self::RotationZ => "rotation_z",
        }
    }
}

/// Layout of arrays over degrees of freedom: the components of a point are adjacent, one point after the other.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Layout {
    /// Number of points.
    pub n_points: usize,
    /// Components of a point, in their order.
    pub components: &'static [Component],
}

impl Layout {
    /// Whether points move in space.
    pub fn is_in_space(self) -> bool {
        self.components.contains(&Component::Z)
    }

    /// Components of the resultant forces and moments on a body, whether or not its points have rotations.
    pub fn of_body(self) -> &'static [Component] {
        if self.is_in_space() {
            &Component::IN_SPACE
        } else {
            &Component::ALL
        }
    }

    /// Number of degrees of freedom.
    pub fn n_degrees_of_freedom(self) -> usize {
        self.components.len() * self.n_points
    }

    /// Degrees of freedom of a point.
    #[inline]
    pub fn range(self, point: u32) -> Range<usize> {
        let first = self.components.len() * point as usize;
        first..first + self.components.len()
    }

    /// Degree of freedom of a component of a point; `None` where points do not have the component.
    pub fn degree_of_freedom(self, point: u32, component: Component) -> Option<usize> {
        let place = self.components.iter().position(|it| *it == component)?;
        Some(self.range(point).start + place)
    }

    /// Point of a degree of freedom.
    #[inline]
    pub fn point(self, degree_of_freedom: usize) -> u32 {
        self.point_and_place(degree_of_freedom).0
    }

    /// Component of a degree of freedom.
    #[inline]
    pub fn component(self, degree_of_freedom: usize) -> Component {
        self.components[self.point_and_place(degree_of_freedom).1 as usize]
    }

    /// Point of a degree of freedom, and the index of its component.
    #[inline]
    fn point_and_place(self, degree_of_freedom: usize) -> (u32, u32) {
        let dof = degree_of_freedom as u32;
        // Divisions by a number known to the compiler are faster by a tenth, in loops over all unknowns.
        match self.components.len() as u32 {
            2 => (dof / 2, dof % 2),
            3 => (dof / 3, dof % 3),
            6 => (dof / 6, dof % 6),
            count => (dof / count, dof % count),
        }
    }

    /// Value of a component of a point in an array over all degrees of freedom; zero where points do not have the component.
    pub fn value(self, point: u32, component: Component, of_all: &[f64]) -> f64 {
        let dof = self.degree_of_freedom(point, component);
        dof.map_or(0.0, |dof| of_all[dof])
    }

    /// Displacements among the values of all degrees of freedom: the first components of each point.
    pub fn displacements(self, of_all: &[f64]) -> impl Iterator<Item = f64> {
        let n_displacements = self.components.partition_point(|it| !it.is_rotation());
        let of_points = of_all.chunks(self.components.len());
        of_points.flat_map(move |it| it[..n_displacements].iter().copied())
    }

    /// Values of the components that `other` also has, from the values of all components of some points.
    pub fn reduced<T>(self, other: Self, of_all: Vec<T>) -> Vec<T> {
        let is_in_other = |place: usize| other.components.contains(&self.component(place));
        let values = of_all.into_iter().enumerate();
        let kept = values.filter(|(place, _)| is_in_other(*place));
        kept.map(|(_, value)| value).collect()
    }
}
