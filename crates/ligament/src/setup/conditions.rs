//! Supports, loads, temperatures, initial velocities and the far field, and where they act.

use ligament_analysis::{Amplitude, Component, Timed};
use ligament_model::case_type;

/// A position or a vector along x, y and z; in the plane the z coordinate is zero.
pub type Position = [f64; 3];

/// Part of the body on which a support, a load or a setting acts.
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

/// Far field of a meshed body, where linear finite elements take the place of bonds.
#[derive(Debug, Clone, PartialEq)]
pub struct FarField {
    /// Parts of the body that keep their bonds: the cells with all corners in one of them.
    pub near: Vec<Place>,
    /// Share of the strength, above 0 and up to 1, that the principal stresses of elements may reach. Where a run meets a larger one the near field
    /// grows, and the run begins anew. Without one the near field stays as it is.
    pub strength_share: Option<f64>,
}

case_type! {
    /// Prescribed displacements; a component that is not given is free. Velocities and accelerations have the same components.
    #[derive(Debug, Clone, Copy, PartialEq, Default)]
    #[case(schemars(extend("minProperties" = 1)))]
    pub struct Displacement {
        /// Component along x, m.
        pub x: Option<f64>,
        /// Component along y, m.
        pub y: Option<f64>,
        /// Rotation in the plane, rad, counter-clockwise.
        pub rotation: Option<f64>,
        /// Component along z of a solid, m.
        pub z: Option<f64>,
        /// Rotation about x in a solid, rad, right-handed.
        pub rotation_x: Option<f64>,
        /// Rotation about y in a solid, rad, right-handed.
        pub rotation_y: Option<f64>,
        /// Rotation about z in a solid, rad, right-handed.
        pub rotation_z: Option<f64>,
    }
}

case_type! {
    /// Stiffness of springs to the ground in total over the points, shared out as a force is; a component that is not given has none.
    #[derive(Debug, Clone, Copy, PartialEq, Default)]
    #[case(schemars(extend("minProperties" = 1)))]
    pub struct SpringStiffness {
        /// Stiffness along x, N/m.
        #[range("exclusiveMinimum" = 0)]
        pub x: Option<f64>,
        /// Stiffness along y, N/m.
        #[range("exclusiveMinimum" = 0)]
        pub y: Option<f64>,
        /// Stiffness against rotations of the points, in N m/rad.
        #[range("exclusiveMinimum" = 0)]
        pub rotation: Option<f64>,
        /// Stiffness along z of a solid, N/m.
        #[range("exclusiveMinimum" = 0)]
        pub z: Option<f64>,
        /// Stiffness along the `normal` of the support, N/m.
        #[range("exclusiveMinimum" = 0)]
        pub normal: Option<f64>,
    }
}

/// A support: components of the displacement that are fixed at zero, or resisted by springs.
#[derive(Debug, Clone, PartialEq)]
pub struct Support {
    /// Supported part of the body.
    pub place: Place,
    /// Fixed components.
    pub held: Vec<Component>,
    /// Normal of the plane of a roller: displacements along it are fixed, across it free. Its length is arbitrary.
    pub normal: Option<Position>,
    /// Springs to the ground.
    pub stiffness: SpringStiffness,
}

/// A load at load factor 1.
#[derive(Debug, Clone, PartialEq)]
pub struct Load {
    /// Name, unique among the loads, also of the load's reaction.
    pub name: String,
    /// Part of the body on which the load acts.
    pub place: Place,
    /// Kind and size of the load.
    pub action: Action,
    /// Variation over the points; without it every point has its whole share.
    pub profile: Option<Profile>,
    /// Factor as a function of time, in a motion; without it the load is as given at all times.
    pub amplitude: Option<Amplitude>,
    /// Total stiffness of springs between a prescribed displacement and the points, such as that of a testing machine, N/m. Without it the
    /// points move as prescribed.
    pub stiffness: Option<f64>,
    /// Whether the load acts through a rigid platen that may tilt: along the load the points move as a rigid body, with the prescribed
    /// displacement, if any, as their mean.
    pub tilts: bool,
}

/// Kind and size of a load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Action {
    /// Prescribed displacements, m and rad.
    Displacement(Displacement),
    /// Prescribed velocities, m/s and rad/s, in a motion.
    Velocity(Displacement),
    /// Prescribed accelerations of the points, such as those of the ground, m/s^2 and rad/s^2, in a motion.
    BaseAcceleration(Displacement),
    /// A total force, distributed over the points, N.
    Force(Position),
    /// A force per length of a group, N/m.
    ForcePerLength(Position),
    /// A force per volume, N/m^3.
    BodyForce(Position),
    /// An acceleration of all masses, such as gravity, m/s^2.
    Acceleration(Position),
    /// A force per area of a group of a solid, N/m^2.
    ForcePerArea(Position),
    /// A total couple, distributed over the points, N m.
    Moment(Couple),
    /// A couple per volume, N m/m^3.
    BodyCouple(Couple),
    /// A pressure on the outline of the body along a group, Pa; a positive one pushes on the body.
    Pressure(f64),
}

/// A couple about the axes, right-handed; in the plane only about z, counter-clockwise.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Couple {
    /// Couples about x, y and z; their unit is that of the action.
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

/// A value at a position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// Position, m.
    pub position: Position,
    /// Value: of a temperature its change, K, of a load a factor.
    pub value: f64,
}

/// A variation of a load: the factor of the share of each point.
#[derive(Debug, Clone, PartialEq)]
pub enum Profile {
    /// The factor (c - zero)/(one - zero) with the point's coordinate c.
    Linear {
        /// Axis of the coordinate c.
        along: Axis,
        /// Coordinate at which the load is zero, m.
        zero: f64,
        /// Coordinate at which the load has its given value, m.
        one: f64,
    },
    /// Factors at positions, each assigned to the point within a tenth of its distance to the nearest other point.
    Table(Vec<Sample>),
}

/// A change of temperature at load factor 1.
#[derive(Debug, Clone, PartialEq)]
pub struct Temperature {
    /// Part of the body: the cells of a group that has cells, otherwise the points.
    pub place: Place,
    /// Change of the temperature.
    pub change: TemperatureChange,
}

/// Change of the temperature.
#[derive(Debug, Clone, PartialEq)]
pub enum TemperatureChange {
    /// Uniform change of the temperature, K.
    Uniform(f64),
    /// Changes at positions, each assigned to the point within a tenth of its distance to the nearest other point.
    Table(Vec<Sample>),
    /// A field of the mesh file.
    Field {
        /// Name of the field.
        name: String,
        /// Time step, where the field has several.
        time_step: Option<i32>,
        /// Value that is subtracted from the field, in its unit.
        reference: f64,
    },
}

/// Velocity of a part of the body at time zero.
#[derive(Debug, Clone, PartialEq)]
pub struct InitialVelocity {
    /// Part of the body.
    pub place: Place,
    /// Velocity, m/s.
    pub velocity: Position,
}

// The dashpots of Lysmer and Kuhlemeyer 1969: on an area A with the normal n their force is -C v with C = A rho (c_P n n^T + c_S (I - n n^T)), so
// that waves along n are not reflected.
case_type! {
    /// A part of the outline through which waves leave the body, by dashpots that take those at a right angle to it.
    #[derive(Debug, Clone, PartialEq, Eq)]
    pub struct QuietEdge {
        /// The physical group on the outline of the mesh, or the set or hole of the lattice.
        pub group: String,
    }
}

case_type! {
    /// An axis of the coordinates.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Axis {
        /// Along x.
        X,
        /// Along y.
        Y,
        /// Along z of a solid.
        Z,
    }
}

impl Axis {
    /// Index of the coordinate, from 0.
    pub fn number(self) -> usize {
        self as usize
    }

    /// Component of the displacement along the axis.
    pub fn displacement(self) -> Component {
        match self {
            Self::X => Component::X,
            Self::Y => Component::Y,
            Self::Z => Component::Z,
        }
    }
}

impl Support {
    /// A support that fixes some components.
    pub fn new(place: impl Into<Place>, held: &[Component]) -> Self {
        Self {
            place: place.into(),
            held: held.to_vec(),
            normal: None,
            stiffness: SpringStiffness::default(),
        }
    }

    /// Fixed components, including the axis along which a normal without a spring lies.
    pub fn components(&self) -> impl Iterator<Item = Component> {
        let normal = self.normal.filter(|_| self.stiffness.normal.is_none());
        let along = normal.and_then(|it| axis_along(&it));
        let along = along.map(Axis::displacement);
        let all = Component::ALL.into_iter().chain(BEYOND_THE_PLANE);
        all.filter(move |it| self.held.contains(it) || along == Some(*it))
    }

    /// Name in the history of the support with this index: the name of its group, if that may head a column.
    pub fn name(&self, index: usize) -> String {
        match &self.place {
            Place::Group(group) if is_column_name(group) => group.clone(),
            _ => format!("support-{}", index + 1),
        }
    }
}

/// Whether a name may head a column of comma-separated values.
pub fn is_column_name(name: &str) -> bool {
    let is_plain = !name.contains([',', '"']) && !name.contains(is_unseen);
    is_plain && !name.is_empty() && name.trim() == name && !begins_as_formula(name)
}

/// Whether a character is invisible: a control character, a line or paragraph separator, a mark of text direction, or a character without
/// width.
pub fn is_unseen(character: char) -> bool {
    character.is_control()
        || matches!(character, '\u{200b}' | '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}' | '\u{feff}')
}

/// Whether a spreadsheet would read a name as a formula.
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

/// The axis along which a direction lies, if any.
pub(super) fn axis_along(direction: &[f64]) -> Option<Axis> {
    let mut axes = [Axis::X, Axis::Y, Axis::Z].into_iter().zip(direction);
    let (axis, _) = axes.find(|(_, cosine)| **cosine != 0.0)?;
    axes.all(|(_, cosine)| *cosine == 0.0).then_some(axis)
}

impl SpringStiffness {
    /// Stiffness along and about the axes in the place of displacements.
    pub fn along_axes(&self) -> Displacement {
        Displacement {
            x: self.x,
            y: self.y,
            rotation: self.rotation,
            z: self.z,
            ..Displacement::default()
        }
    }
}

impl Displacement {
    /// Components that have a value.
    pub fn components(self) -> impl Iterator<Item = (Component, f64)> {
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

    /// Displacements along the first D axes, m; zero where there is no value.
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

impl Action {
    /// Prescribed motion: displacements, velocities or accelerations; None for a force.
    pub fn motion(&self) -> Option<Displacement> {
        match *self {
            Self::Displacement(it) | Self::Velocity(it) | Self::BaseAcceleration(it) => Some(it),
            Self::Force(_)
            | Self::ForcePerLength(_)
            | Self::BodyForce(_)
            | Self::Acceleration(_)
            | Self::ForcePerArea(_)
            | Self::Moment(_)
            | Self::BodyCouple(_)
            | Self::Pressure(_) => None,
        }
    }

    /// Quantity that an amplitude multiplies.
    pub fn timed(&self) -> Timed {
        match self {
            Self::Velocity(_) => Timed::Velocity,
            Self::BaseAcceleration(_) => Timed::Acceleration,
            Self::Displacement(_)
            | Self::Force(_)
            | Self::ForcePerLength(_)
            | Self::BodyForce(_)
            | Self::Acceleration(_)
            | Self::ForcePerArea(_)
            | Self::Moment(_)
            | Self::BodyCouple(_)
            | Self::Pressure(_) => Timed::Value,
        }
    }
}

impl Load {
    /// A load without a profile, named after its group, or `load` for other places.
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
            amplitude: None,
            stiffness: None,
            tilts: false,
        }
    }
}
