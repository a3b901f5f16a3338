//! `[[probe]]`: extra columns of the history.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::fault::KeyFault;
use super::key_path::KeyPath;
use super::places::Coordinates;
use super::values::{exactly_one, one_of, require_column_name, required_key};
use ligament::setup::{self, Axis, Reading};
use ligament_analysis::Component;
use ligament_analysis::probe::PointField;

/// A column of the history.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = exactly_one(&["between", "at", "section"])))]
pub struct Probe {
    /// Heads its column in `history.csv`; each name once.
    #[schemars(length(min = 1))]
    pub name: String,
    /// Two positions, m: the second displacement less the first, as of a strain gauge or a crack opening; with `component`.
    pub between: Option<[Coordinates; 2]>,
    /// A position, m, at which a field is read between the points of the cell around it; with `field`.
    pub at: Option<Coordinates>,
    /// A line, m, through which the bonds carry a force, N; in a solid a point of a plane and one before it along its normal; with
    /// `component`.
    pub section: Option<[Coordinates; 2]>,
    /// The component that `between` (m or rad) or `section` (N; `x`, `y`, or `z` in a solid) reads.
    pub component: Option<Component>,
    /// The field that is read `at` the position.
    pub field: Option<PointField>,
}

impl Probe {
    pub(super) fn setup(&self, key: &KeyPath) -> Result<setup::Probe, KeyFault> {
        require_column_name(|| key.child("name"), &self.name)?;
        let ends = |ends: [Coordinates; 2]| ends.map(|it| it.position());
        let between = |positions| {
            Ok(Reading::Between {
                positions: ends(positions),
                component: self.component(key)?,
            })
        };
        let at = |position: Coordinates| {
            Ok(Reading::At {
                position: position.position(),
                field: self.field(key)?,
            })
        };
        let section = |line| {
            Ok(Reading::Section {
                line: ends(line),
                component: self.axis(key)?,
            })
        };
        let readings = [
            ("between", self.between.map(between)),
            ("at", self.at.map(at)),
            ("section", self.section.map(section)),
        ];
        Ok(setup::Probe {
            name: self.name.clone(),
            reading: one_of(key, readings)??,
        })
    }

    fn component(&self, key: &KeyPath) -> Result<Component, KeyFault> {
        if self.field.is_some() {
            let reason = "only a probe `at` a point takes `field`; this one takes `component`";
            return Err(KeyFault::new(key.child("field"), reason));
        }
        let reason = "with `between` or `section`, to say what to read";
        self.component
            .ok_or_else(|| required_key(key, "component", reason))
    }

    fn axis(&self, key: &KeyPath) -> Result<Axis, KeyFault> {
        match self.component(key)? {
            Component::X => Ok(Axis::X),
            Component::Y => Ok(Axis::Y),
            Component::Z => Ok(Axis::Z),
            _ => {
                let reason = "the force through a section has the components \"x\", \"y\" and, in a solid, \"z\" only";
                Err(KeyFault::new(key.child("component"), reason))
            }
        }
    }

    fn field(&self, key: &KeyPath) -> Result<PointField, KeyFault> {
        if self.component.is_some() {
            let reason = "a probe `at` a point takes `field`, not `component`";
            return Err(KeyFault::new(key.child("component"), reason));
        }
        self.field
            .ok_or_else(|| required_key(key, "field", "with `at`, to say what to read"))
    }
}
