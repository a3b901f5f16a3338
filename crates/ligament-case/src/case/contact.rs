//! `[[rigid]]`: rigid bodies.

use std::path::Path;

use ligament::setup::{self, ContactLaw, RigidForm};
use ligament_analysis::load_program;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::conditions::Amplitude;
use super::fault::KeyFault;
use super::key_path::KeyPath;
use super::places::{Coordinates, Vector};
use super::values::{missing_key, refuse, require_column_name};
use super::word::word_of;
use crate::point_table::Tables;

/// A rigid body that parts of the body meet.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Rigid {
    /// Name in results.
    pub name: String,
    /// Shape of the body.
    pub shape: RigidShape,
    /// Centre of the body at the start, of a wall a point of its surface, m.
    pub centre: Coordinates,
    /// Radius of a circle or sphere, m.
    #[schemars(transform = RigidForm::RADIUS.keywords())]
    pub radius: Option<f64>,
    /// Outward normal of a wall.
    pub normal: Option<Coordinates>,
    /// Sides of a box, m.
    pub size: Option<Coordinates>,
    /// Displacement at load factor 1, m; in statics.
    pub displacement: Option<Vector>,
    /// Velocity in a motion, m/s: of a body with a `mass` at time zero, of another one times its `amplitude`.
    pub velocity: Option<Vector>,
    /// Factor of the velocity as a function of time; without it 1.
    pub amplitude: Option<Amplitude>,
    /// Mass of a body that contact alone moves, in the plane for the whole thickness, kg; without it the motion is prescribed.
    #[schemars(transform = setup::Rigid::MASS.keywords())]
    pub mass: Option<f64>,
    /// Moment of inertia of a body with a `mass` about its middle, in the plane about z, kg m^2; without it the body does not turn.
    #[schemars(transform = setup::Rigid::INERTIA.keywords())]
    pub inertia: Option<f64>,
    /// Acceleration of a body with a `mass` without contacts, such as gravity, m/s^2.
    pub acceleration: Option<Vector>,
    /// Coefficient of Coulomb's friction.
    #[serde(default)]
    #[schemars(transform = ContactLaw::FRICTION.keywords())]
    pub friction: f64,
    /// Stiffness of the contact over E'/h of the material, with the spacing h of the points.
    #[serde(default = "one")]
    #[schemars(transform = ContactLaw::STIFFNESS.keywords())]
    pub stiffness: f64,
    /// Groups whose outlines it can touch; by default the outline of the whole body.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub against: Vec<String>,
    /// Whether the rigid shape meets the faces of cracks as well.
    #[serde(default)]
    pub cracks: bool,
}

/// Shape of a rigid body.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum RigidShape {
    /// A circle, for a body in the plane.
    Circle,
    /// A sphere, for a solid.
    Sphere,
    /// A half-plane, for a solid a half-space.
    Wall,
    /// A rectangle, for a solid a box, with sides along the axes.
    Box,
}

fn one() -> f64 {
    ContactLaw::default().stiffness
}

impl Rigid {
    /// Fills in missing keys; `folder` is the folder of the case file.
    pub(super) fn complete(&mut self, key: &KeyPath, folder: &Path) -> Result<(), KeyFault> {
        require_column_name(|| key.child("name"), &self.name)?;
        match &mut self.amplitude {
            Some(amplitude) => amplitude.complete(&key.child("amplitude"), folder),
            None => Ok(()),
        }
    }

    /// The rigid body beside a body in some dimensions, with its tables.
    pub(super) fn setup(
        &self,
        key: &KeyPath,
        dimensions: usize,
        tables: Tables,
    ) -> Result<setup::Rigid, KeyFault> {
        let vector = |given: Option<Vector>| given.unwrap_or_default().position();
        let amplitude = match &self.amplitude {
            Some(amplitude) => amplitude.setup(&key.child("amplitude"), tables)?,
            None => load_program::Amplitude::constant(),
        };
        Ok(setup::Rigid {
            name: self.name.clone(),
            form: self.form(key, dimensions)?,
            against: self.against.clone(),
            law: ContactLaw {
                friction: self.friction,
                stiffness: self.stiffness,
            },
            displacement: vector(self.displacement),
            cracks: self.cracks,
            velocity: vector(self.velocity),
            amplitude,
            mass: self.mass,
            inertia: self.inertia,
            acceleration: vector(self.acceleration),
        })
    }

    fn form(&self, key: &KeyPath, dimensions: usize) -> Result<RigidForm, KeyFault> {
        let centre = self.centre.position();
        let refuse = |keys: [&'static str; 2]| {
            let setting = format!("shape = \"{}\"", word_of(&self.shape));
            refuse(key, self, &keys, &setting, "it belongs to another shape")
        };
        let along = |name: &str, given: Option<Coordinates>| {
            let given = given.ok_or_else(|| missing_key(key, name))?;
            Ok(given.position())
        };
        match self.shape {
            RigidShape::Circle | RigidShape::Sphere => {
                refuse(["normal", "size"])?;
                if (self.shape == RigidShape::Circle) != (dimensions == 2) {
                    let reason = match dimensions {
                        2 => "a body in the plane meets a \"circle\"",
                        _ => "a solid meets a \"sphere\"",
                    };
                    return Err(KeyFault::new(key.child("shape"), reason));
                }
                let radius = self.radius.ok_or_else(|| missing_key(key, "radius"))?;
                Ok(RigidForm::Ball { centre, radius })
            }
            RigidShape::Wall => {
                refuse(["radius", "size"])?;
                let normal = along("normal", self.normal)?;
                Ok(RigidForm::Wall {
                    point: centre,
                    normal,
                })
            }
            RigidShape::Box => {
                refuse(["radius", "normal"])?;
                let size = along("size", self.size)?;
                Ok(RigidForm::Box { centre, size })
            }
        }
    }
}
