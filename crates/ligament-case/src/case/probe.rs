//! `[[probe]]`: extra columns of the history.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::fault::{Fault, KeyFault};
use super::key_path::KeyPath;
use super::values::exactly_one;
use super::values::{Point, not_exactly_one, require, require_column_name};
use super::word::Word;
use ligament::setup::Axis;
use ligament_analysis::Component;
use ligament_analysis::probe::PointField;

/// A column of the history.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Probe {
    /// Name, unique among the probes.
    pub name: String,
    /// What it reads.
    #[serde(flatten)]
    pub reading: Reading,
}

/// What a probe reads.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Reading {
    /// Displacement of one point relative to another.
    Between {
        /// Two positions: the second point's displacement minus the first's, at the nearest points.
        between: [Point; 2],
        /// The component read, m or rad.
        component: Word<Component>,
    },
    /// A field at a point.
    At {
        /// The position; the nearest point is read.
        at: Point,
        /// The field read.
        field: Word<PointField>,
    },
    /// The force that the bonds carry through a line.
    Section {
        /// The ends of the line.
        section: [Point; 2],
        /// The component read, N.
        component: Word<Axis>,
    },
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = exactly_one(&["between", "at", "section"])))]
pub(super) struct RawProbe {
    /// Heads its column in `history.csv`; each name once.
    #[schemars(length(min = 1))]
    name: String,
    /// Two positions, m: the second displacement less the first, as of a strain gauge or a crack opening; with `component`.
    between: Option<[Point; 2]>,
    /// A position, m, whose nearest point is read; with `field`.
    at: Option<Point>,
    /// A line, m, through which the bonds carry a force, N; with `component`.
    section: Option<[Point; 2]>,
    /// The component that `between` (m or rad) or `section` (N; `x` or `y`) reads.
    component: Option<Word<Component>>,
    /// The field that is read `at` the position.
    field: Option<Word<PointField>>,
}

impl RawProbe {
    pub(super) fn check(self, key: &KeyPath) -> Result<Probe, KeyFault> {
        require_column_name(|| key.child("name"), &self.name)?;
        let reading = match (self.between, self.at, self.section) {
            (Some(between), None, None) => {
                distinct(key, "between", between)?;
                self.reject_field(key)?;
                Reading::Between {
                    between,
                    component: self.component(key)?,
                }
            }
            (None, Some(at), None) => Reading::At {
                at,
                field: self.field(key)?,
            },
            (None, None, Some(section)) => {
                distinct(key, "section", section)?;
                self.reject_field(key)?;
                Reading::Section {
                    section,
                    component: self.axis(key)?,
                }
            }
            (between, at, section) => {
                let given = [
                    ("between", between.is_some()),
                    ("at", at.is_some()),
                    ("section", section.is_some()),
                ];
                return Err(not_exactly_one(key, &given));
            }
        };
        Ok(Probe {
            name: self.name,
            reading,
        })
    }

    fn component(&self, key: &KeyPath) -> Result<Word<Component>, KeyFault> {
        self.component.ok_or_else(|| {
            let reason = "with `between` or `section`, to say what to read";
            KeyFault::new(
                key.child("component"),
                Fault::Required {
                    key: "component",
                    reason: reason.to_owned(),
                },
            )
        })
    }

    fn axis(&self, key: &KeyPath) -> Result<Word<Axis>, KeyFault> {
        match self.component(key)?.0 {
            Component::X => Ok(Word(Axis::X)),
            Component::Y => Ok(Word(Axis::Y)),
            Component::Rotation => {
                let reason = "the force through a section has the components \"x\" and \"y\" only";
                Err(KeyFault::new(key.child("component"), reason))
            }
        }
    }

    fn field(&self, key: &KeyPath) -> Result<Word<PointField>, KeyFault> {
        if self.component.is_some() {
            let reason = "a probe `at` a point takes `field`, not `component`";
            return Err(KeyFault::new(key.child("component"), reason));
        }
        self.field.ok_or_else(|| {
            let fault = Fault::Required {
                key: "field",
                reason: "with `at`, to say what to read".to_owned(),
            };
            KeyFault::new(key.child("field"), fault)
        })
    }

    fn reject_field(&self, key: &KeyPath) -> Result<(), KeyFault> {
        match self.field {
            None => Ok(()),
            Some(_) => {
                let reason = "only a probe `at` a point takes `field`; this one takes `component`";
                Err(KeyFault::new(key.child("field"), reason))
            }
        }
    }
}

fn distinct(key: &KeyPath, name: &str, ends: [Point; 2]) -> Result<(), KeyFault> {
    require(
        ends[0] != ends[1],
        || key.child(name),
        "two different points",
        ends,
    )
}
