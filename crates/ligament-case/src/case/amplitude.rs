//! `load.amplitude`: the factor of a load as a function of time.

use std::path::{Path, PathBuf};

use ligament_analysis::load_program::{self, Amplitude as Factor};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::fault::KeyFault;
use super::key_path::KeyPath;
use super::mesh_section::complete_path;
use super::values::{Point, exactly_one, missing, one_of, refuse, require};
use super::word::word_of;
use crate::point_table::Tables;

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
    #[schemars(range(min = 0), extend("default" = 0.0, "x-unit" = "s"))]
    pub start: Option<f64>,
    /// Duration of the whole shape, s.
    #[schemars(extend("exclusiveMinimum" = 0, "x-unit" = "s"))]
    pub duration: Option<f64>,
    /// Periods of a sine within its duration.
    #[schemars(range(min = 1), extend("default" = 1))]
    pub periods: Option<u32>,
    /// Time of the peak of a Ricker wavelet, s.
    #[schemars(extend("x-unit" = "s"))]
    pub peak_time: Option<f64>,
    /// Frequency at which a Ricker wavelet has its most energy, Hz.
    #[schemars(extend("exclusiveMinimum" = 0, "x-unit" = "Hz"))]
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
    /// Fills in missing keys; `folder` is that of the case file.
    pub(super) fn complete(&mut self, key: &KeyPath, folder: &Path) -> Result<(), KeyFault> {
        if let Some(file) = &mut self.file {
            complete_path(&key.child("file"), file, folder)?;
        }
        match self.shape {
            Some(Shape::Ricker) => Ok(()),
            Some(shape) => {
                self.start.get_or_insert(0.0);
                if shape == Shape::Sine {
                    self.periods.get_or_insert(1);
                }
                Ok(())
            }
            None => Ok(()),
        }
    }

    /// The factor, with its table.
    pub(super) fn setup(&self, key: &KeyPath, tables: Tables) -> Result<Factor, KeyFault> {
        let points = |it: &Vec<Point>| through(it, &key.child("points"));
        let table = |file: &PathBuf| {
            let factor = tables.amplitude(file);
            factor.map_err(|reason| KeyFault::new(key.child("file"), reason))
        };
        let forms = [
            ("points", self.points.as_ref().map(points)),
            ("file", self.file.as_ref().map(table)),
            ("shape", self.shape.map(|it| self.shaped(it, key))),
        ];
        let factor = one_of(key, forms)??;
        if self.shape.is_none() {
            let of_shapes = ["start", "duration", "periods", "peak_time", "frequency"];
            let reason = "it belongs to a `shape`";
            refuse(key, self, &of_shapes, "`points` or `file`", reason)?;
        }
        Ok(factor)
    }

    fn shaped(&self, shape: Shape, key: &KeyPath) -> Result<Factor, KeyFault> {
        use load_program::Shape as S;
        let number = |name: &str, given: Option<f64>| given.ok_or_else(|| missing(key, name));
        let of = |shape: S| {
            let is_sine = matches!(shape, S::Sine { .. });
            let reason = "it belongs to another shape";
            let setting = format!("shape = \"{}\"", word_of(&self.shape));
            refuse(key, self, &["peak_time", "frequency"], &setting, reason)?;
            if !is_sine {
                refuse(key, self, &["periods"], &setting, reason)?;
            }
            let duration = number("duration", self.duration)?;
            let start = self.start.unwrap_or(0.0);
            require(start >= 0.0, || key.child("start"), "at least 0", start)?;
            Ok(Factor::pulse(shape, start, duration))
        };
        match shape {
            Shape::Sine => {
                let periods = self.periods.unwrap_or(1);
                of(S::Sine { periods })
            }
            Shape::HalfSine => of(S::HalfSine),
            Shape::Triangle => of(S::Triangle),
            Shape::Rectangle => of(S::Rectangle),
            Shape::Ramp => of(S::Ramp),
            Shape::SmoothRamp => of(S::SmoothRamp),
            Shape::Ricker => {
                let reason = "a wavelet has a `peak_time` and a `frequency`";
                let setting = "shape = \"ricker\"";
                let others = ["start", "duration", "periods"];
                refuse(key, self, &others, setting, reason)?;
                let peak_time = number("peak_time", self.peak_time)?;
                Ok(Factor::ricker(
                    peak_time,
                    number("frequency", self.frequency)?,
                ))
            }
        }
    }
}

/// The amplitude through points, whose times must grow.
fn through(points: &[Point], key: &KeyPath) -> Result<Factor, KeyFault> {
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
