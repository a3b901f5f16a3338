//! `[motion]`, `[[initial_velocity]]` and `[[quiet]]`: a motion in time.

use ligament::setup::{self, Place, QuietEdge};
use ligament_analysis::motion::{self, ExplicitSettings, ImplicitSettings, MotionSettings};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::conditions::Vector;
use super::coordinates::Coordinates;
use super::fault::KeyFault;
use super::fracture::Fracture;
use super::key_path::KeyPath;
use super::region::{Corners, place};
use super::values::missing;

/// Largest dissipation of implicit steps, beyond which they are less accurate than of second order.
const MOST_DISSIPATION: f64 = 1.0 / 3.0;

/// Largest number of rows.
const MOST_ROWS: u32 = 1_000_000;

/// How the body moves in time under loads that depend on time.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Motion {
    /// Time at the end, s.
    #[schemars(extend("exclusiveMinimum" = 0, "x-unit" = "s"))]
    pub duration: f64,
    /// Rows of the history, at equal times.
    #[serde(default = "rows")]
    #[schemars(range(min = 1, max = MOST_ROWS))]
    pub rows: u32,
    /// Scheme of the integration in time.
    #[serde(default)]
    pub scheme: Scheme,
    /// Time step, s; explicit steps without it are `safety` times the critical step of the body. It is shortened so that rows are at
    /// multiples of it, and implicit steps are halved where bonds break fast.
    #[schemars(extend("exclusiveMinimum" = 0, "x-unit" = "s"))]
    pub step: Option<f64>,
    /// Share of the critical step, beyond which explicit steps are unstable.
    #[schemars(extend("exclusiveMinimum" = 0, "exclusiveMaximum" = 1, "default" = explicit().safety))]
    pub safety: Option<f64>,
    /// Dissipation of fast motions by implicit steps, after Hilber, Hughes and Taylor: 0 takes no energy.
    #[schemars(range(min = 0), extend("maximum" = MOST_DISSIPATION, "default" = 0.0))]
    pub dissipation: Option<f64>,
    /// Share of the work so far that a step without inertia may set free beyond what its bonds dissipate, and that a motion may have left when
    /// equilibria follow again; for the scheme `auto`.
    #[schemars(extend("exclusiveMinimum" = 0, "exclusiveMaximum" = 1, "default" = setup::STATICS))]
    pub statics: Option<f64>,
    /// Factor on the rotational inertia of the points; a larger one allows longer steps where rotations limit them.
    #[serde(default = "one")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub rotary_inertia: f64,
    /// Damping C = `mass` M + `stiffness` K.
    #[serde(default)]
    pub damping: Damping,
    /// When to stop before the end; whichever comes first.
    #[serde(default)]
    pub stop: MotionStop,
}

/// Scheme of the integration in time.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Scheme {
    /// Central differences: steps without equations to solve, shorter than a critical step.
    #[default]
    Explicit,
    /// Newmark's scheme: steps of any length, each an equilibrium with inertia; of `[fracture]` the keys of a load step hold for each.
    Implicit,
    /// Equilibria without inertia from row to row until the body loses its balance, then implicit steps until it is at rest, then equilibria
    /// again.
    Auto,
}

/// Damping in proportion to masses and stiffness.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Damping {
    /// alpha, 1/s: slow motions are damped most.
    #[schemars(range(min = 0), extend("x-unit" = "1/s"))]
    pub mass: f64,
    /// beta, s: fast motions are damped most; it shortens the critical step.
    #[schemars(range(min = 0), extend("x-unit" = "s"))]
    pub stiffness: f64,
}

/// When to stop before the end of a motion; whichever comes first.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct MotionStop {
    /// When so many bonds are broken.
    #[schemars(range(min = 1))]
    pub bonds: Option<u64>,
    /// After so much time of the machine, s.
    #[schemars(extend("exclusiveMinimum" = 0, "x-unit" = "s"))]
    pub wall_time: Option<f64>,
}

fn rows() -> u32 {
    setup::motion(1.0).rows as u32
}

fn explicit() -> ExplicitSettings {
    setup::explicit()
}

fn one() -> f64 {
    setup::motion(1.0).rotary_inertia
}

impl Motion {
    /// Fills in the missing keys of the scheme.
    pub(super) fn complete(&mut self) {
        if self.scheme == Scheme::Explicit {
            self.safety = self.safety.or(Some(explicit().safety));
            return;
        }
        self.dissipation = self.dissipation.or(Some(0.0));
        if self.scheme == Scheme::Auto {
            self.statics = self.statics.or(Some(setup::STATICS));
        }
    }

    /// Settings, with the keys of `[fracture]` about the breakages in implicit steps.
    pub(super) fn setup(
        &self,
        key: &KeyPath,
        fracture: Option<&Fracture>,
    ) -> Result<MotionSettings, KeyFault> {
        let scheme = match self.scheme {
            Scheme::Explicit => motion::Scheme::Explicit(ExplicitSettings {
                step: self.step,
                safety: self.safety.unwrap_or(explicit().safety),
            }),
            Scheme::Implicit => self.implicit(key, fracture, None)?,
            Scheme::Auto => {
                let share = self.statics.unwrap_or(setup::STATICS);
                self.implicit(key, fracture, Some(share))?
            }
        };
        Ok(MotionSettings {
            duration: self.duration,
            rows: self.rows as usize,
            scheme,
            damping: motion::Damping {
                mass: self.damping.mass,
                stiffness: self.damping.stiffness,
            },
            rotary_inertia: self.rotary_inertia,
            stop: motion::MotionStop {
                bonds: self.stop.bonds.map(|bonds| bonds as usize),
                wall_time: self.stop.wall_time,
            },
        })
    }
}

impl Motion {
    /// Implicit steps, with the share of the work that steps without inertia may set free.
    fn implicit(
        &self,
        key: &KeyPath,
        fracture: Option<&Fracture>,
        statics: Option<f64>,
    ) -> Result<motion::Scheme, KeyFault> {
        let step = self.step.ok_or_else(|| missing(key, "step"))?;
        let default = setup::implicit(step);
        let settings = match fracture {
            Some(it) => it.implicit(default),
            None => default,
        };
        Ok(motion::Scheme::Implicit(ImplicitSettings {
            dissipation: self.dissipation.unwrap_or(0.0),
            statics,
            ..settings
        }))
    }
}

/// A velocity at time zero. Where several reach, the last of them holds.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct InitialVelocity {
    /// The points of this physical group of the mesh, or of this set or hole of the lattice; without a place the whole body moves.
    pub group: Option<String>,
    /// The points in this rectangle, by two opposite corners `[[x, y], [x, y]]`, in a solid in this box, m.
    #[schemars(extend("x-unit" = "m"))]
    pub r#box: Option<Corners>,
    /// The point nearest to `[x, y]`, in a solid to `[x, y, z]`, m.
    #[schemars(extend("x-unit" = "m"))]
    pub at: Option<Coordinates>,
    /// The velocity, m/s.
    #[schemars(extend("x-unit" = "m/s"))]
    pub velocity: Vector,
}

impl InitialVelocity {
    pub(super) fn setup(
        &self,
        key: &KeyPath,
        dimensions: usize,
    ) -> Result<setup::InitialVelocity, KeyFault> {
        let is_placed = self.group.is_some() || self.r#box.is_some() || self.at.is_some();
        Ok(setup::InitialVelocity {
            place: match is_placed {
                true => place(key, dimensions, self.group.as_ref(), self.r#box, self.at)?,
                false => Place::Everywhere,
            },
            velocity: self.velocity.for_body(&key.child("velocity"), dimensions)?,
        })
    }
}

/// A part of the outline through which waves leave the body, by dashpots that take those at a right angle to it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Quiet {
    /// The physical group on the outline of the mesh, or the set or hole of the lattice.
    pub group: String,
}

impl Quiet {
    pub(super) fn setup(&self) -> QuietEdge {
        QuietEdge {
            group: self.group.clone(),
        }
    }
}
