//! Contact between surfaces and with rigid bodies.

use ligament_analysis::load_program::Amplitude;

use super::conditions::Position;

/// Contact between parts of the body.
#[derive(Debug, Clone, PartialEq)]
pub struct SurfaceContact {
    /// What comes into contact.
    pub between: Between,
    /// Law of the contact.
    pub law: ContactLaw,
    /// Whether faces of cracks take part.
    pub cracks: bool,
}

/// Parts of the body that come into contact.
#[derive(Debug, Clone, PartialEq)]
pub enum Between {
    /// The outlines of two groups.
    Groups([String; 2]),
    /// The outlines of all parts that no bond connects at the start; with faces of cracks, all points that no bond connects.
    Parts,
}

impl Between {
    /// Name in results: those of the groups, or `parts`.
    pub fn name(&self) -> String {
        match self {
            Self::Groups(groups) => groups.join("-"),
            Self::Parts => "parts".to_owned(),
        }
    }
}

/// Penalty and friction of a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactLaw {
    /// Coefficient mu of Coulomb's friction, from 0.
    pub friction: f64,
    /// Factor of the contact stiffness: k is this times E'/h of the material, with the spacing h of the points.
    pub stiffness: f64,
}

/// A rigid body, which turns where it has an inertia.
#[derive(Debug, Clone, PartialEq)]
pub struct Rigid {
    /// Name in results.
    pub name: String,
    /// Shape and place at the start.
    pub form: RigidForm,
    /// Groups whose outlines it meets; that of the whole body where there is none.
    pub against: Vec<String>,
    /// Law of the contact.
    pub law: ContactLaw,
    /// In statics the displacement at load factor 1, m.
    pub displacement: Position,
    /// Whether it meets faces of cracks as well.
    pub cracks: bool,
    /// In a motion the velocity, m/s: at time zero where the body has a mass, otherwise times the amplitude.
    pub velocity: Position,
    /// Amplitude of a prescribed velocity.
    pub amplitude: Amplitude,
    /// Mass, kg; without one the motion is prescribed.
    pub mass: Option<f64>,
    /// Moment of inertia of a body with a mass about its middle, kg m^2; without one it does not turn.
    pub inertia: Option<f64>,
    /// Acceleration of a body with a mass without contacts, such as gravity, m/s^2.
    pub acceleration: Position,
}

impl Rigid {
    /// Prescribed motion: in statics the displacement at load factor 1, m, in a motion the velocity, m/s. The other one is zero.
    pub fn motion(&self) -> Position {
        std::array::from_fn(|axis| self.velocity[axis] + self.displacement[axis])
    }
}

/// Shape and place of a rigid body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RigidForm {
    /// A circle in the plane, a sphere in space.
    Ball {
        /// Centre, m.
        centre: Position,
        /// Radius, m.
        radius: f64,
    },
    /// A half-plane or half-space.
    Wall {
        /// A point of its surface, m.
        point: Position,
        /// Outward normal, of arbitrary length.
        normal: Position,
    },
    /// A rectangle or box with sides along the axes.
    Box {
        /// Centre, m.
        centre: Position,
        /// Sides, m.
        size: Position,
    },
}

impl Default for ContactLaw {
    /// Without friction, and with the stiffness of a layer of material as thick as a point.
    fn default() -> Self {
        Self {
            friction: 0.0,
            stiffness: 1.0,
        }
    }
}
