//! Contact between surfaces and with rigid bodies.

use ligament_analysis::load_program::Amplitude;
use ligament_model::case_type;
use ligament_model::case_type::Range;

use super::conditions::Position;

case_type! {
    /// Contact between parts of the body, with friction.
    #[derive(Debug, Clone, PartialEq)]
    pub struct SurfaceContact {
        /// Two groups whose outlines meet, `["a", "b"]`; without it all parts that no bond connects at the start.
        pub between: Option<[String; 2]>,
        /// Coefficient of Coulomb's friction.
        #[range(ContactLaw::FRICTION)]
        #[case(serde(default))]
        pub friction: f64,
        /// Stiffness of the contact over E'/h of the material, with the spacing h of the points.
        #[range(ContactLaw::STIFFNESS)]
        #[case(serde(default = "stiffness"))]
        pub stiffness: f64,
        /// Whether the faces of cracks take part, also those that come about; without `between` all fragments then meet each other.
        #[case(serde(default))]
        pub cracks: bool,
    }
}

impl SurfaceContact {
    /// Name in results: those of the groups, or `parts`.
    pub fn name(&self) -> String {
        match &self.between {
            Some(groups) => groups.join("-"),
            None => "parts".to_owned(),
        }
    }

    /// Law of the contact.
    pub fn law(&self) -> ContactLaw {
        ContactLaw {
            friction: self.friction,
            stiffness: self.stiffness,
        }
    }
}

fn stiffness() -> f64 {
    1.0
}

/// Penalty and friction of a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactLaw {
    /// Coefficient mu of Coulomb's friction.
    pub friction: f64,
    /// Factor of the contact stiffness: k is this times E'/h of the material, with the spacing h of the points.
    pub stiffness: f64,
}

impl ContactLaw {
    /// Range of a coefficient of friction.
    pub const FRICTION: Range<'static> = Range {
        words: "0 or more",
        ..Range::NOT_NEGATIVE
    };

    /// Range of the factor of the stiffness.
    pub const STIFFNESS: Range<'static> = Range::POSITIVE;
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
    /// Range of a mass.
    pub const MASS: Range<'static> = Range::POSITIVE;

    /// Range of a moment of inertia.
    pub const INERTIA: Range<'static> = Range::POSITIVE;

    /// Prescribed motion: in statics the displacement at load factor 1, m, in a motion the velocity, m/s. The other one is zero.
    pub fn motion(&self) -> Position {
        std::array::from_fn(|axis| self.velocity[axis] + self.displacement[axis])
    }

    /// Direction in which it moves, of any length: that of its motion, of a mass at rest that of its acceleration; zero where it does not move.
    pub(crate) fn direction(&self) -> Position {
        let motion = self.motion();
        match motion.iter().any(|it| *it != 0.0) {
            true => motion,
            false => self.acceleration,
        }
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

impl RigidForm {
    /// Range of a radius.
    pub const RADIUS: Range<'static> = Range::POSITIVE;
}

impl Default for ContactLaw {
    /// Without friction, and with the stiffness of a layer of material as thick as a point.
    fn default() -> Self {
        Self {
            friction: 0.0,
            stiffness: stiffness(),
        }
    }
}
