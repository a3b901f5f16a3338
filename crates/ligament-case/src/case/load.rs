//! `[[load]]`: what acts on the body.

use ligament::units::Units;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::conditions::{Displacement, Vector};
use super::fault::KeyFault;
use super::key_path::KeyPath;
use super::region::{Place, no_place, place};
use super::values::exactly_one;
use super::values::{Point, not_exactly_one, require, require_column_name};
use super::word::Word;
use ligament::setup::Axis;

/// A load, given as it is at load factor 1.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Load {
    /// Name, unique among the loads.
    pub name: String,
    /// Where; none only for a body force or a body couple on the whole body.
    #[serde(flatten)]
    pub place: Option<Place>,
    /// What acts.
    #[serde(flatten)]
    pub action: Action,
    /// How it varies from point to point; without it every point takes its whole share.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub profile: Option<Profile>,
}

/// What a load does.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Action {
    /// Prescribed displacements, m and rad.
    Displacement(Displacement),
    /// A force in total over the points, N.
    Force(Vector),
    /// A force along a curve group, N/m.
    ForcePerLength(Vector),
    /// A force in the volume, N/m^3.
    BodyForce(Vector),
    /// A couple in total over the points, counter-clockwise, N m.
    Moment(f64),
    /// A couple in the volume, counter-clockwise, N m/m^3.
    BodyCouple(f64),
    /// A pressure on the outline of the body, Pa; positive pushes on it.
    Pressure(f64),
}

/// A load that varies linearly: what a point would take without it is multiplied by (c - zero)/(one - zero), with the
/// point's coordinate c.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Profile {
    /// The coordinate.
    pub along: Word<Axis>,
    /// Coordinate in the mesh file at which the load is zero, m.
    pub zero: f64,
    /// Coordinate in the mesh file at which it is as given, m.
    pub one: f64,
}

impl Profile {
    fn check(self, key: &KeyPath) -> Result<Self, KeyFault> {
        let expected = "another coordinate than `zero`: the load is as given there";
        require(
            self.one != self.zero,
            || key.child("one"),
            expected,
            self.one,
        )?;
        Ok(self)
    }
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = exactly_one(&["displacement", "force", "force_per_length", "body_force", "moment", "body_couple", "pressure"])))]
pub(super) struct RawLoad {
    /// Heads its column in `history.csv`; without it the name of the group.
    #[schemars(length(min = 1))]
    name: Option<String>,
    /// The points of this physical group of the mesh, or of this set or hole of the lattice.
    group: Option<String>,
    /// The points in this rectangle, by two opposite corners `[[x, y], [x, y]]`, m.
    r#box: Option<[Point; 2]>,
    /// The point nearest to `[x, y]`, m.
    at: Option<Point>,
    /// Prescribed displacements, m, rotation in rad.
    displacement: Option<Displacement>,
    /// A force in total over the points, N.
    force: Option<Vector>,
    /// A force along the edges of a group, N/m.
    force_per_length: Option<Vector>,
    /// A force in the volume, N/m^3; on the whole body without a place.
    body_force: Option<Vector>,
    /// A couple in total over the points, counter-clockwise, N m.
    moment: Option<f64>,
    /// A couple in the volume, counter-clockwise, N m/m^3; on the whole body without a place.
    body_couple: Option<f64>,
    /// A pressure on the outline of a group, Pa; positive pushes on the body.
    pressure: Option<f64>,
    /// How the load varies along an axis: what a point takes is multiplied by (c - zero)/(one - zero).
    profile: Option<Profile>,
}

impl RawLoad {
    /// Checks the load; `number` counts from 1 and names a load that has neither name nor group.
    pub(super) fn check(self, key: &KeyPath, number: usize) -> Result<Load, KeyFault> {
        let action = self.action(key)?;
        let profile = self.profile.map(|it| it.check(&key.child("profile")));
        let profile = profile.transpose()?;
        let name = self.name.clone().or_else(|| self.group.clone());
        let name = name.unwrap_or_else(|| format!("load-{number}"));
        let named_by = if self.name.is_some() { "name" } else { "group" };
        require_column_name(|| key.child(named_by), &name)?;
        let place = place(key, self.group, self.r#box, self.at)?;
        check_place(key, place.as_ref(), &action)?;
        Ok(Load {
            name,
            place,
            action,
            profile,
        })
    }

    fn action(&self, key: &KeyPath) -> Result<Action, KeyFault> {
        let given = [
            ("displacement", self.displacement.map(Action::Displacement)),
            ("force", self.force.map(Action::Force)),
            (
                "force_per_length",
                self.force_per_length.map(Action::ForcePerLength),
            ),
            ("body_force", self.body_force.map(Action::BodyForce)),
            ("moment", self.moment.map(Action::Moment)),
            ("body_couple", self.body_couple.map(Action::BodyCouple)),
            ("pressure", self.pressure.map(Action::Pressure)),
        ];
        let mut actions = given
            .iter()
            .filter_map(|(name, action)| Some((*name, (*action)?)));
        let (Some((name, action)), None) = (actions.next(), actions.next()) else {
            return Err(not_exactly_one(
                key,
                &given.map(|(name, action)| (name, action.is_some())),
            ));
        };
        action.check(&key.child(name))?;
        Ok(action)
    }
}

impl Action {
    fn check(self, key: &KeyPath) -> Result<(), KeyFault> {
        match self {
            Self::Displacement(displacement) => displacement.check(key).map(drop),
            Self::Force(vector) | Self::ForcePerLength(vector) | Self::BodyForce(vector) => {
                vector.check(key).map(drop)
            }
            Self::Moment(value) | Self::BodyCouple(value) | Self::Pressure(value) => require(
                value != 0.0,
                || key.clone(),
                "other than 0, or the load does nothing",
                value,
            ),
        }
    }

    /// Key of the action in a case file.
    pub fn key(&self) -> &'static str {
        match self {
            Self::Displacement(_) => "displacement",
            Self::Force(_) => "force",
            Self::ForcePerLength(_) => "force_per_length",
            Self::BodyForce(_) => "body_force",
            Self::Moment(_) => "moment",
            Self::BodyCouple(_) => "body_couple",
            Self::Pressure(_) => "pressure",
        }
    }

    /// Units of its displacement and its force in the history: their product is work.
    pub fn units(&self) -> Units {
        let turns = |it: &Displacement| it.x.is_none() && it.y.is_none();
        match self {
            Self::Displacement(motion) if turns(motion) => Units::COUPLE,
            Self::Displacement(_)
            | Self::Force(_)
            | Self::ForcePerLength(_)
            | Self::BodyForce(_) => Units::FORCE,
            Self::Moment(_) | Self::BodyCouple(_) => Units::COUPLE,
            Self::Pressure(_) => Units::PRESSURE,
        }
    }
}

/// Forces per length and pressures need the edges of a group; only what acts on a volume may act on everything.
fn check_place(key: &KeyPath, place: Option<&Place>, action: &Action) -> Result<(), KeyFault> {
    match (action, place) {
        (Action::BodyForce(_) | Action::BodyCouple(_), Some(Place::At(_))) => {
            let reason = "a body force or couple acts on a volume: give `group`, `box`, or neither for the whole body";
            Err(KeyFault::new(key.child("at"), reason))
        }
        (Action::BodyForce(_) | Action::BodyCouple(_), _)
        | (Action::ForcePerLength(_) | Action::Pressure(_), Some(Place::Group(_))) => Ok(()),
        (Action::ForcePerLength(_), _) => {
            let reason = "acts along the curve of a `group`, so the load needs one";
            Err(KeyFault::new(key.child("force_per_length"), reason))
        }
        (Action::Pressure(_), _) => {
            let reason = "acts on the outline of a `group`, so the load needs one";
            Err(KeyFault::new(key.child("pressure"), reason))
        }
        (_, None) => Err(no_place(key, [false; 3])),
        (_, Some(_)) => Ok(()),
    }
}
