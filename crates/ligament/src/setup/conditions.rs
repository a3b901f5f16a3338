//! Supports and loads, and where they act.

use ligament_analysis::Component;

/// Where on the body something acts.
#[derive(Debug, Clone, PartialEq)]
pub enum Place {
    /// All points.
    Everywhere,
    /// The points of a group of the body.
    Group(String),
    /// The points in a rectangle: its lower left and its upper right corner, m.
    Box([[f64; 2]; 2]),
    /// The point nearest to a position, m.
    At([f64; 2]),
}

impl From<&str> for Place {
    fn from(group: &str) -> Self {
        Self::Group(group.to_owned())
    }
}

/// Prescribed displacements; a component that is none is free.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Displacement {
    /// Along x, m.
    pub x: Option<f64>,
    /// Along y, m.
    pub y: Option<f64>,
    /// Rotation, rad, counter-clockwise.
    pub rotation: Option<f64>,
}

/// A support: components of the displacement that are held at zero, or resisted by springs.
#[derive(Debug, Clone, PartialEq)]
pub struct Support {
    /// Where it holds.
    pub place: Place,
    /// Whether it holds displacements along x.
    pub x: bool,
    /// Whether it holds displacements along y.
    pub y: bool,
    /// Whether it holds rotations.
    pub rotation: bool,
    /// Direction along which displacements are held while they are free across it: the normal of the plane of a roller. It need not
    /// have the length 1.
    pub normal: Option<[f64; 2]>,
    /// Springs to the ground.
    pub stiffness: SpringStiffness,
}

/// Stiffness of springs in total over the points, shared out as a force is; a component without one has no spring.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SpringStiffness {
    /// Along x, N/m.
    pub x: Option<f64>,
    /// Along y, N/m.
    pub y: Option<f64>,
    /// Against rotations of the points, N m/rad.
    pub rotation: Option<f64>,
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
    Force([f64; 2]),
    /// A force along a group that has a length, N/m.
    ForcePerLength([f64; 2]),
    /// A force in the volume, N/m^3.
    BodyForce([f64; 2]),
    /// An acceleration that acts on the masses in the volume, as gravity does, m/s^2.
    Acceleration([f64; 2]),
    /// A couple in total over the points, counter-clockwise, N m.
    Moment(f64),
    /// A couple in the volume, counter-clockwise, N m/m^3.
    BodyCouple(f64),
    /// A pressure on the outline of the body along a group, Pa; a positive one pushes on the body.
    Pressure(f64),
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
}

impl Support {
    /// A support that holds some components.
    pub fn new(place: impl Into<Place>, held: &[Component]) -> Self {
        let [x, y, rotation] = Component::ALL.map(|component| held.contains(&component));
        Self {
            place: place.into(),
            x,
            y,
            rotation,
            normal: None,
            stiffness: SpringStiffness::default(),
        }
    }

    /// Components that it holds; one along an axis where its normal lies there.
    pub fn components(&self) -> impl Iterator<Item = Component> {
        let normal = self.normal.filter(|_| self.stiffness.normal.is_none());
        let [along_x, along_y] = match normal {
            Some([x, 0.0]) => [x != 0.0, false],
            Some([0.0, y]) => [false, y != 0.0],
            _ => [false; 2],
        };
        let held = [
            (Component::X, self.x || along_x),
            (Component::Y, self.y || along_y),
            (Component::Rotation, self.rotation),
        ];
        held.into_iter()
            .filter_map(|(component, holds)| holds.then_some(component))
    }

    /// Name of the support with this index in the history.
    pub fn name(&self, index: usize) -> String {
        match &self.place {
            Place::Group(group) => group.clone(),
            Place::Everywhere | Place::Box(_) | Place::At(_) => format!("support-{}", index + 1),
        }
    }
}

impl SpringStiffness {
    /// The springs along components, with their stiffness in total.
    pub fn components(&self) -> impl Iterator<Item = (Component, f64)> {
        let given = [
            (Component::X, self.x),
            (Component::Y, self.y),
            (Component::Rotation, self.rotation),
        ];
        let springs = given.into_iter();
        springs.filter_map(|(component, stiffness)| Some((component, stiffness?)))
    }
}

impl Displacement {
    /// Components that are prescribed, with their values.
    pub fn components(&self) -> impl Iterator<Item = (Component, f64)> {
        let given = [
            (Component::X, self.x),
            (Component::Y, self.y),
            (Component::Rotation, self.rotation),
        ];
        given
            .into_iter()
            .filter_map(|(component, value)| Some((component, value?)))
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
    pub fn at(&self, [x, y]: [f64; 2]) -> f64 {
        let coordinate = match self.along {
            Axis::X => x,
            Axis::Y => y,
        };
        (coordinate - self.zero) / (self.one - self.zero)
    }
}
