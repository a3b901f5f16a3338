//! `[[support]]`, `[[load]]`, `[[temperature]]` and `[[initial_velocity]]`: what holds, loads, heats and moves the body, with factors as functions of
//! time.

use std::path::{Path, PathBuf};

use ligament::setup::{
    self, Action, Axis, Displacement, Position, SpringStiffness, TemperatureChange, is_column_name,
};
use ligament_analysis::load_program::{self, Amplitude as Factor};
use schemars::{JsonSchema, Schema};
use serde::{Deserialize, Serialize};
use serde_json::{Value as Json, json};

use super::fault::KeyFault;
use super::key_path::KeyPath;
use super::mesh_section::complete_path;
use super::places::{Coordinates, Corners, Couple, Vector, place, place_or_everywhere};
use super::values::{
    Point, exactly_one, missing_key, one_of, refuse, require, require_column_name,
};
use super::word::word_of;
use crate::point_table::Tables;

/// A support: displacements held at zero, or resisted by springs.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = exactly_one(&["group", "box", "at"])))]
pub struct Support {
    /// The points of this physical group of the mesh, or of this set or hole of the lattice.
    pub group: Option<String>,
    /// The points in this rectangle, by two opposite corners `[[x, y], [x, y]]`, in a solid in this box, m.
    pub r#box: Option<Corners>,
    /// The point nearest to `[x, y]`, in a solid to `[x, y, z]`, m.
    pub at: Option<Coordinates>,
    /// The components that are held, each at 0: `{ x = 0.0 }`, `{ x = 0.0, y = 0.0 }`; m, rotation in rad.
    pub displacement: Option<Displacement>,
    /// An inclined roller: the direction along which the points are held while they are free across it, `[1.0, 1.0]` is at 45 degrees.
    pub normal: Option<Coordinates>,
    /// Springs to the ground instead of fixed displacements, in total over the points.
    pub stiffness: Option<SpringStiffness>,
}

impl Support {
    pub(super) fn setup(&self, key: &KeyPath) -> Result<setup::Support, KeyFault> {
        let given = self.displacement.unwrap_or_default();
        let moved = given.components().find(|(_, value)| *value != 0.0);
        if let Some((component, value)) = moved {
            let reason = format!(
                "a support holds at 0, found {value:?}: put prescribed displacements in a [[load]]"
            );
            let key = key.child("displacement").child(component.name());
            return Err(KeyFault::new(key, reason));
        }
        Ok(setup::Support {
            place: place(key, self.group.as_ref(), self.r#box, self.at)?,
            held: given.components().map(|(component, _)| component).collect(),
            normal: self.normal.map(|it| it.position()),
            stiffness: self.stiffness.unwrap_or_default(),
        })
    }
}

/// A velocity at time zero. Where several apply, the last one counts.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct InitialVelocity {
    /// The points of this physical group of the mesh, or of this set or hole of the lattice; without a place the whole body moves.
    pub group: Option<String>,
    /// The points in this rectangle, by two opposite corners `[[x, y], [x, y]]`, in a solid in this box, m.
    pub r#box: Option<Corners>,
    /// The point nearest to `[x, y]`, in a solid to `[x, y, z]`, m.
    pub at: Option<Coordinates>,
    /// The velocity, m/s.
    pub velocity: Vector,
}

impl InitialVelocity {
    pub(super) fn setup(&self, key: &KeyPath) -> Result<setup::InitialVelocity, KeyFault> {
        Ok(setup::InitialVelocity {
            place: place_or_everywhere(key, self.group.as_ref(), self.r#box, self.at)?,
            velocity: self.velocity.position(),
        })
    }
}

/// A change of temperature at load factor 1. Where several apply, the last one counts.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = exactly_one(&["change", "file", "mesh_field"])))]
pub struct Temperature {
    /// The part of the body; the whole body without it or a `box`.
    pub group: Option<String>,
    /// The part of the body in this rectangle, by two opposite corners, in a solid in this box, m.
    pub r#box: Option<Corners>,
    /// Change of the temperature at load factor 1, the same everywhere there, K.
    pub change: Option<f64>,
    /// A CSV file with the columns `x`, `y` (m; of a solid also `z`) and `change` (K), from the folder of the case file.
    #[schemars(length(min = 1))]
    pub file: Option<PathBuf>,
    /// A scalar field at the nodes in the mesh file, K; `ligament inspect` lists them.
    pub mesh_field: Option<String>,
    /// Time step of the `mesh_field`, where the file has several.
    pub time_step: Option<i32>,
    /// Subtracted from the values of the `mesh_field`, K.
    #[schemars(extend("default" = 0.0))]
    pub reference: Option<f64>,
}

impl Temperature {
    /// Fills in missing keys; `folder` is the folder of the case file.
    pub(super) fn complete(&mut self, key: &KeyPath, folder: &Path) -> Result<(), KeyFault> {
        if let Some(file) = &mut self.file {
            complete_path(&key.child("file"), file, folder)?;
        }
        if self.mesh_field.is_some() {
            self.reference.get_or_insert(0.0);
            return Ok(());
        }
        let reason = "it belongs to a `mesh_field`";
        refuse(
            key,
            self,
            &["time_step", "reference"],
            "`change` or `file`",
            reason,
        )
    }

    /// The change of temperature, with its table.
    pub(super) fn setup(
        &self,
        key: &KeyPath,
        tables: Tables,
    ) -> Result<setup::Temperature, KeyFault> {
        let table = |file: &PathBuf| {
            let samples = tables.samples(file, ["change", " (K)"]);
            let samples = samples.map_err(|reason| KeyFault::new(key.child("file"), reason))?;
            Ok(TemperatureChange::Table(samples))
        };
        let field = (self.mesh_field.clone()).map(|name| TemperatureChange::Field {
            name,
            time_step: self.time_step,
            reference: self.reference.unwrap_or_default(),
        });
        let uniform = self.change.map(TemperatureChange::Uniform);
        let changes = [
            ("change", uniform.map(Ok)),
            ("file", self.file.as_ref().map(table)),
            ("mesh_field", field.map(Ok)),
        ];
        Ok(setup::Temperature {
            change: one_of(key, changes)??,
            place: place_or_everywhere(key, self.group.as_ref(), self.r#box, None)?,
        })
    }
}

/// Keys of the actions; a load has one of them. The order is that of [`Load::actions`].
pub(super) const ACTIONS: [&str; 11] = [
    "displacement",
    "velocity",
    "base_acceleration",
    "force",
    "force_per_length",
    "force_per_area",
    "body_force",
    "acceleration",
    "moment",
    "body_couple",
    "pressure",
];

/// A load, with its value at load factor 1.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = exactly_one(&ACTIONS)))]
pub struct Load {
    /// Name of its column in `history.csv`; by default the name of the group, or `load-1` and so on where that cannot head a column.
    #[schemars(length(min = 1))]
    pub name: Option<String>,
    /// The points of this physical group of the mesh, or of this set or hole of the lattice.
    pub group: Option<String>,
    /// The points in this rectangle, by two opposite corners `[[x, y], [x, y]]`, in a solid in this box, m.
    pub r#box: Option<Corners>,
    /// The point nearest to `[x, y]`, in a solid to `[x, y, z]`, m.
    pub at: Option<Coordinates>,
    /// Prescribed displacements, m, rotation in rad.
    pub displacement: Option<Displacement>,
    /// Prescribed velocities in a motion, m/s, of the rotation rad/s.
    #[schemars(transform = describe_rates)]
    pub velocity: Option<Displacement>,
    /// Prescribed accelerations in a motion, such as the acceleration of the ground, m/s^2, of the rotation rad/s^2.
    #[schemars(transform = describe_rates)]
    pub base_acceleration: Option<Displacement>,
    /// A force in total over the points, N.
    pub force: Option<Vector>,
    /// A force along the edges of a group, N/m.
    pub force_per_length: Option<Vector>,
    /// A force over the surface of a group of a solid, N/m^2.
    pub force_per_area: Option<Vector>,
    /// A force in the volume, N/m^3; on the whole body without a place.
    pub body_force: Option<Vector>,
    /// An acceleration that acts on all masses, as gravity does, m/s^2; on the whole body without a place, and the materials need a
    /// `density`.
    pub acceleration: Option<Vector>,
    /// A couple in total over the points, N m: counter-clockwise, in a solid `{ x = 0.0, y = 0.0, z = 1.0 }`, right-handed.
    pub moment: Option<Couple>,
    /// A couple in the volume, N m/m^3, as a `moment`; on the whole body without a place.
    pub body_couple: Option<Couple>,
    /// A pressure on the outline of a group, Pa; positive pushes on the body.
    pub pressure: Option<f64>,
    /// Variation of the load in space: a factor (c - zero)/(one - zero), or the factor of a table.
    pub profile: Option<Profile>,
    /// Variation of the load in time, in a motion: a factor of the load. Without it the load is as given from the start.
    pub amplitude: Option<Amplitude>,
    /// Total stiffness of springs through which a `displacement` moves the points, N/m: the stiffness of a testing machine.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub stiffness: Option<f64>,
    /// Whether a `displacement` or `force` acts through a rigid platen that may tilt: it moves by the mean of its points.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub tilts: bool,
}

/// A load that varies: what a point would take without it is multiplied by (c - zero)/(one - zero), with the point's coordinate
/// c, or by the factor of a table.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = exactly_one(&["along", "file"])))]
pub struct Profile {
    /// Coordinate along which the load varies.
    pub along: Option<Axis>,
    /// Coordinate in the mesh file at which the load is zero, m.
    pub zero: Option<f64>,
    /// Coordinate in the mesh file at which it is as given, m.
    pub one: Option<f64>,
    /// A CSV file with the columns `x`, `y` (m; of a solid also `z`) and `factor`, with a row for each loaded point, from the folder of
    /// the case file.
    #[schemars(length(min = 1))]
    pub file: Option<PathBuf>,
}

impl Profile {
    fn complete(&mut self, key: &KeyPath, folder: &Path) -> Result<(), KeyFault> {
        let Some(file) = &mut self.file else {
            return Ok(());
        };
        complete_path(&key.child("file"), file, folder)?;
        refuse(
            key,
            self,
            &["zero", "one"],
            "`file`",
            "they belong to `along`",
        )
    }

    /// The variation, with its table.
    fn setup(&self, key: &KeyPath, tables: Tables) -> Result<setup::Profile, KeyFault> {
        let number = |name: &str, given: Option<f64>| given.ok_or_else(|| missing_key(key, name));
        let linear = |along: Axis| {
            Ok(setup::Profile::Linear {
                along,
                zero: number("zero", self.zero)?,
                one: number("one", self.one)?,
            })
        };
        let table = |file: &PathBuf| {
            let samples = tables.samples(file, ["factor", ""]);
            let samples = samples.map_err(|reason| KeyFault::new(key.child("file"), reason))?;
            Ok(setup::Profile::Table(samples))
        };
        let forms = [
            ("along", self.along.map(linear)),
            ("file", self.file.as_ref().map(table)),
        ];
        one_of(key, forms)?
    }
}

impl Load {
    /// Sets the load's name; `number`, from 1, names a load without a name and a group.
    pub(super) fn complete(
        &mut self,
        key: &KeyPath,
        number: usize,
        folder: &Path,
    ) -> Result<(), KeyFault> {
        if let Some(profile) = &mut self.profile {
            profile.complete(&key.child("profile"), folder)?;
        }
        if let Some(amplitude) = &mut self.amplitude {
            amplitude.complete(&key.child("amplitude"), folder)?;
        }
        // A group of a mesh may have a name such as `-x` or `a, b`, which is not a valid column name.
        let of_group = || self.group.clone().filter(|it| is_column_name(it));
        let name = self.name.take().or_else(of_group);
        let name = name.unwrap_or_else(|| format!("load-{number}"));
        require_column_name(|| key.child("name"), &name)?;
        self.name = Some(name);
        Ok(())
    }

    /// The load, with its tables.
    pub(super) fn setup(&self, key: &KeyPath, tables: Tables) -> Result<setup::Load, KeyFault> {
        let action = one_of(key, self.actions())?;
        let (group, corners) = (self.group.as_ref(), self.r#box);
        let place = match action {
            Action::Displacement(_)
            | Action::Velocity(_)
            | Action::BaseAcceleration(_)
            | Action::Force(_)
            | Action::Moment(_) => place(key, group, corners, self.at)?,
            _ => place_or_everywhere(key, group, corners, self.at)?,
        };
        let profile = self.profile.as_ref();
        let profile = profile.map(|it| it.setup(&key.child("profile"), tables));
        let amplitude = self.amplitude.as_ref();
        let amplitude = amplitude.map(|it| it.setup(&key.child("amplitude"), tables));
        Ok(setup::Load {
            name: self.name.clone().unwrap_or_default(),
            place,
            action,
            profile: profile.transpose()?,
            amplitude: amplitude.transpose()?,
            stiffness: self.stiffness,
            tilts: self.tilts,
        })
    }

    /// The actions that are given, by their keys.
    fn actions(&self) -> [(&'static str, Option<Action>); ACTIONS.len()] {
        let vector = |given: Option<Vector>, make: fn(Position) -> Action| {
            given.map(|it| make(it.position()))
        };
        let couple = |given: Option<Couple>, make: fn(setup::Couple) -> Action| {
            given.map(|it| make(it.into()))
        };
        let actions = [
            self.displacement.map(Action::Displacement),
            self.velocity.map(Action::Velocity),
            self.base_acceleration.map(Action::BaseAcceleration),
            vector(self.force, Action::Force),
            vector(self.force_per_length, Action::ForcePerLength),
            vector(self.force_per_area, Action::ForcePerArea),
            vector(self.body_force, Action::BodyForce),
            vector(self.acceleration, Action::Acceleration),
            couple(self.moment, Action::Moment),
            couple(self.body_couple, Action::BodyCouple),
            self.pressure.map(Action::Pressure),
        ];
        std::array::from_fn(|place| (ACTIONS[place], actions[place]))
    }
}

/// Describes the components of velocities and accelerations, which have the unit of their key.
fn describe_rates(schema: &mut Schema) {
    let components = schema.get_mut("properties").and_then(Json::as_object_mut);
    for component in components.into_iter().flat_map(|it| it.values_mut()) {
        let words = component["description"].as_str().unwrap_or_default();
        let words = words.replace(", m.", ".").replace(", rad,", ",");
        let words = words.replace("Rotation", "Component of the rotation");
        let words = words.replace("clockwise.", "clockwise, with rad in the place of m.");
        *component = json!({ "description": words, "type": component["type"] });
    }
}

/// A factor of a load as a function of time, in a motion: points, a table or a shape.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = exactly_one(&["points", "file", "shape"])))]
pub struct Amplitude {
    /// Times (s) with the factors there, `[[0.0, 0.0], [1e-3, 1.0]]`: straight between them, constant before and after.
    #[schemars(length(min = 1))]
    pub points: Option<Vec<Point>>,
    /// A CSV file with the columns `time` (s) and `factor`, from the folder of the case file; as `points`.
    #[schemars(length(min = 1))]
    pub file: Option<PathBuf>,
    /// A shape, from its start on.
    pub shape: Option<Shape>,
    /// Start of the shape, s; without it 0.
    #[schemars(range(min = 0), extend("default" = 0.0))]
    pub start: Option<f64>,
    /// Duration of the whole shape, s.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub duration: Option<f64>,
    /// Periods of a sine within its duration.
    #[schemars(range(min = 1), extend("default" = 1))]
    pub periods: Option<u32>,
    /// Time of the peak of a Ricker wavelet, s.
    pub peak_time: Option<f64>,
    /// Frequency at which a Ricker wavelet has its most energy, Hz.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub frequency: Option<f64>,
}

/// A shape of an amplitude; x runs from 0 at its start to 1 after its duration.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Shape {
    /// sin(2 pi n x) of n `periods`.
    Sine,
    /// sin(pi x).
    HalfSine,
    /// From 0 to 1 at half of the duration, and back.
    Triangle,
    /// 1 until the end.
    Rectangle,
    /// From 0 to 1, where it stays.
    Ramp,
    /// From 0 to 1, where it stays, without kinks: 10 x^3 - 15 x^4 + 6 x^5.
    SmoothRamp,
    /// (1 - 2 a) exp(-a), a = (pi f (t - t_p))^2 with the `frequency` f and the `peak_time` t_p.
    Ricker,
}

impl Amplitude {
    /// Fills in missing keys; `folder` is the folder of the case file.
    pub(super) fn complete(&mut self, key: &KeyPath, folder: &Path) -> Result<(), KeyFault> {
        if let Some(file) = &mut self.file {
            complete_path(&key.child("file"), file, folder)?;
        }
        if self.shape.is_some_and(|it| it != Shape::Ricker) {
            self.start.get_or_insert(0.0);
        }
        if self.shape == Some(Shape::Sine) {
            self.periods.get_or_insert(1);
        }
        Ok(())
    }

    /// The factor, with its table.
    pub(super) fn setup(&self, key: &KeyPath, tables: Tables) -> Result<Factor, KeyFault> {
        let points = |it: &Vec<Point>| amplitude_through(it, &key.child("points"));
        let table = |file: &PathBuf| {
            let factor = tables.amplitude(file);
            factor.map_err(|reason| KeyFault::new(key.child("file"), reason))
        };
        let forms = [
            ("points", self.points.as_ref().map(points)),
            ("file", self.file.as_ref().map(table)),
            (
                "shape",
                self.shape.map(|it| self.amplitude_of_shape(it, key)),
            ),
        ];
        let factor = one_of(key, forms)??;
        if self.shape.is_none() {
            let of_shapes = ["start", "duration", "periods", "peak_time", "frequency"];
            let reason = "it belongs to a `shape`";
            refuse(key, self, &of_shapes, "`points` or `file`", reason)?;
        }
        Ok(factor)
    }

    fn amplitude_of_shape(&self, shape: Shape, key: &KeyPath) -> Result<Factor, KeyFault> {
        use load_program::Shape as S;
        let number = |name: &str, given: Option<f64>| given.ok_or_else(|| missing_key(key, name));
        let setting = format!("shape = \"{}\"", word_of(&shape));
        let refuse = |keys: &[&'static str], reason| refuse(key, self, keys, &setting, reason);
        let pulse = match shape {
            Shape::Sine => S::Sine {
                periods: self.periods.unwrap_or(1),
            },
            Shape::HalfSine => S::HalfSine,
            Shape::Triangle => S::Triangle,
            Shape::Rectangle => S::Rectangle,
            Shape::Ramp => S::Ramp,
            Shape::SmoothRamp => S::SmoothRamp,
            Shape::Ricker => {
                let reason = "a wavelet has a `peak_time` and a `frequency`";
                refuse(&["start", "duration", "periods"], reason)?;
                let peak_time = number("peak_time", self.peak_time)?;
                let frequency = number("frequency", self.frequency)?;
                return Ok(Factor::ricker(peak_time, frequency));
            }
        };
        let reason = "it belongs to another shape";
        refuse(&["peak_time", "frequency"], reason)?;
        if shape != Shape::Sine {
            refuse(&["periods"], reason)?;
        }
        let start = self.start.unwrap_or(0.0);
        require(start >= 0.0, || key.child("start"), "at least 0", start)?;
        Ok(Factor::pulse(
            pulse,
            start,
            number("duration", self.duration)?,
        ))
    }
}

/// The amplitude through points, whose times must grow.
fn amplitude_through(points: &[Point], key: &KeyPath) -> Result<Factor, KeyFault> {
    require(
        !points.is_empty(),
        || key.clone(),
        "one point or more",
        points,
    )?;
    for (place, pair) in points.windows(2).enumerate() {
        let [[before, _], [time, _]] = [pair[0], pair[1]];
        let expected = format!("a time later than that of the point before, {before:?} s");
        let point = || key.child(place + 1).child(0);
        require(time > before, point, &expected, time)?;
    }
    Ok(Factor::through(points))
}
