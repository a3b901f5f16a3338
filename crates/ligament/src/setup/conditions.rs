//! Supports and loads, and where they act.

use ligament_analysis::Component;

/// A position or a vector along x, y and z; that of a body in the plane has no part along z.
pub type Position = [f64; 3];

/// Where on the body something acts.
#[derive(Debug, Clone, PartialEq)]
pub enum Place {
    /// All points.
    Everywhere,
    /// The points of a group of the body.
    Group(String),
    /// The points in a rectangle, in space in a box: its lowest and its highest corner, m.
    Box([Position; 2]),
    /// The point nearest to a position, m.
    At(Position),
}

impl From<&str> for Place {
    fn from(group: &str) -> Self {
        Self::Group(group.to_owned())
    }
}

/// A value for some components of the motion; a component without one is left alone.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Displacement {
    /// Displacement along x, m.
    pub x: Option<f64>,
    /// Displacement along y, m.
    pub y: Option<f64>,
    /// Rotation in the plane, rad, counter-clockwise.
    pub rotation: Option<f64>,
    /// Displacement along z of a solid, m.
    pub z: Option<f64>,
    /// Rotation about x in a solid, rad, right-handed.
    pub rotation_x: Option<f64>,
    /// Rotation about y in a solid, rad, right-handed.
    pub rotation_y: Option<f64>,
    /// Rotation about z in a solid, rad, right-handed.
    pub rotation_z: Option<f64>,
}

/// A support: components of the displacement that are held at zero, or resisted by springs.
#[derive(Debug, Clone, PartialEq)]
pub struct Support {
    /// Where it holds.
    pub place: Place,
    /// Components that it holds.
    pub held: Vec<Component>,
    /// Direction along which displacements are held while they are free across it: the normal of the plane of a roller. It need not
    /// have the length 1.
    pub normal: Option<Position>,
    /// Springs to the ground.
    pub stiffness: SpringStiffness,
}

/// Stiffness of springs in total over the points, shared out as a force is.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SpringStiffness {
    /// Along and about the axes, N/m and N m/rad; a component without a value has no spring.
    pub components: Displacement,
    /// Along the normal of the support, N/m; without it the normal is held.
    pub normal: Option<f64>,
}

/// A load as it is at load factor 1.
#[derive(Debug, Clone, PartialEq)]
pub struct Load {
    /// Name, unique among the loads: its reaction goes by it.
    pub name: String,
    /// Where it acts.
    pub place: Place,
    /// What acts.
    pub action: Action,
    /// How it varies from point to point; without it every point takes its whole share.
    pub profile: Option<Profile>,
    /// Stiffness in total of springs between what moves and the points, where a displacement is given, N/m: what gives way in a testing
    /// machine. Without it the points move as prescribed.
    pub stiffness: Option<f64>,
    /// Whether the load acts through a rigid platen that may tilt: along the load its points move as those of a rigid body, their
    /// mean by the displacement, if one is given.
    pub tilts: bool,
}

/// What a load does.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Action {
    /// Prescribed displacements, m and rad.
    Displacement(Displacement),
    /// A force in total over the points, N.
    Force(Position),
    /// A force along a group that has a length, N/m.
    ForcePerLength(Position),
    /// A force in the volume, N/m^3.
    BodyForce(Position),
    /// An acceleration that acts on the masses in the volume, as gravity does, m/s^2.
    Acceleration(Position),
    /// A force over a group of a solid that has an area, N/m^2.
    ForcePerArea(Position),
    /// A couple in total over the points, N m.
    Moment(Couple),
    /// A couple in the volume, N m/m^3.
    BodyCouple(Couple),
    /// A pressure on the outline of the body along a group, Pa; a positive one pushes on the body.
    Pressure(f64),
}

/// A couple about the axes, right-handed; in the plane about z alone, counter-clockwise.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Couple {
    /// About x, y and z.
    pub about: [f64; 3],
}

impl From<f64> for Couple {
    /// A couple in the plane.
    fn from(about_z: f64) -> Self {
        Self {
            about: [0.0, 0.0, about_z],
        }
    }
}

/// A linear variation of a load: what a point would take without it is multiplied by (c - zero)/(one - zero), with the
/// point's coordinate c.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Profile {
    /// The coordinate.
    pub along: Axis,
    /// Coordinate at which the load is zero, m.
    pub zero: f64,
    /// Coordinate at which the load is as given, m.
    pub one: f64,
}

/// An axis of the coordinates.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Axis {
    /// The x axis.
    X,
    /// The y axis.
    Y,
    /// The z axis of space.
    Z,
}

impl Axis {
    /// Number of the coordinate.
    pub fn number(self) -> usize {
        self as usize
    }

    /// The displacement along the axis.
    pub fn displacement(self) -> Component {
        match self {
            Self::X => Component::X,
            Self::Y => Component::Y,
            Self::Z => Component::Z,
        }
    }
}

impl Support {
    /// A support that holds some components.
    pub fn new(place: impl Into<Place>, held: &[Component]) -> Self {
        Self {
            place: place.into(),
            held: held.to_vec(),
            normal: None,
            stiffness: SpringStiffness::default(),
        }
    }

    /// Components that it holds; one along an axis where its normal lies there.
    pub fn components(&self) -> impl Iterator<Item = Component> {
        let normal = self.normal.filter(|_| self.stiffness.normal.is_none());
        let along = normal.and_then(|it| axis_along(&it));
        let along = along.map(Axis::displacement);
        let all = Component::ALL.into_iter().chain(BEYOND_THE_PLANE);
        all.filter(move |it| self.held.contains(it) || along == Some(*it))
    }

    /// Name of the support with this index in the history: that of its group, unless it begins as a formula does.
    pub fn name(&self, index: usize) -> String {
        match &self.place {
            Place::Group(group) if !begins_as_formula(group) => group.clone(),
            _ => format!("support-{}", index + 1),
        }
    }
}

/// Whether a name begins as a formula does, which a spreadsheet computes where the name heads a column.
pub fn begins_as_formula(name: &str) -> bool {
    name.starts_with(['=', '+', '-', '@'])
}

/// Components that only solids have.
const BEYOND_THE_PLANE: [Component; 4] = [
    Component::Z,
    Component::RotationX,
    Component::RotationY,
    Component::RotationZ,
];

/// The axis that a direction lies along, if it lies along one.
pub(super) fn axis_along(direction: &[f64]) -> Option<Axis> {
    let mut axes = [Axis::X, Axis::Y, Axis::Z].into_iter().zip(direction);
    let (axis, _) = axes.find(|(_, cosine)| **cosine != 0.0)?;
    axes.all(|(_, cosine)| *cosine == 0.0).then_some(axis)
}

impl Displacement {
    /// Components that have a value.
    pub fn components(&self) -> impl Iterator<Item = (Component, f64)> {
        let given = [
            (Component::X, self.x),
            (Component::Y, self.y),
            (Component::Rotation, self.rotation),
            (Component::Z, self.z),
            (Component::RotationX, self.rotation_x),
            (Component::RotationY, self.rotation_y),
            (Component::RotationZ, self.rotation_z),
        ];
        given
            .into_iter()
            .filter_map(|(component, value)| Some((component, value?)))
    }

    /// Values along the first D axes, zero where there is none.
    pub fn vector<const D: usize>(&self) -> [f64; D] {
        let along = [self.x, self.y, self.z];
        std::array::from_fn(|axis| along[axis].unwrap_or(0.0))
    }

    /// Whether displacements have values and rotations have none.
    pub(crate) fn is_translation(&self) -> bool {
        let mut given = self.components().peekable();
        given.peek().is_some() && given.all(|(component, _)| !component.is_rotation())
    }
}

impl Load {
    /// A load without a profile, named by its group, or `load` where it acts elsewhere.
    pub fn new(place: impl Into<Place>, action: Action) -> Self {
        let place = place.into();
        let name = match &place {
            Place::Group(group) => group.clone(),
            Place::Everywhere | Place::Box(_) | Place::At(_) => "load".to_owned(),
        };
        Self {
            name,
            place,
            action,
            profile: None,
            stiffness: None,
            tilts: false,
        }
    }
}

impl Profile {
    /// The factor at a position.
    pub fn at(&self, position: &[f64]) -> f64 {
        (position[self.along.number()] - self.zero) / (self.one - self.zero)
    }
}
