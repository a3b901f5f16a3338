//! `[[probe]]`: extra columns of the history.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::fault::KeyFault;
use super::key_path::KeyPath;
use super::places::Coordinates;
use super::values::{exactly_one, one_of, require_column_name, required_key};
use ligament::setup::{self, Axis, Reading, Tip};
use ligament_analysis::Component;
use ligament_analysis::probe::PointField;
use ligament_model::stress::tip_field::TipQuantity;

/// A column of the history.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = exactly_one(&["between", "at", "section", "group", "tip"])))]
pub struct Probe {
    /// Name of its column in `history.csv`, another one for each probe.
    #[schemars(length(min = 1))]
    pub name: String,
    /// Two positions, m: the second displacement less the first, as of a strain gauge or a crack opening; with `component`.
    pub between: Option<[Coordinates; 2]>,
    /// A position, m, at which a field is read between the points of the cell around it; with `field`.
    pub at: Option<Coordinates>,
    /// A line, m, through which the bonds carry a force, N; in a solid a point of a plane and one before it along its normal; with
    /// `component`.
    pub section: Option<[Coordinates; 2]>,
    /// A group: with `field` the mean of the field over the volume of its points, with `component` the force that supports and loads exert
    /// on them.
    pub group: Option<String>,
    /// The end of a straight pre-crack in the plane, or a place on the rim of a disk or a plane polygon in a solid, m; with
    /// `quantity`.
    pub tip: Option<Coordinates>,
    /// The component that `between` (m or rad), `section` (N; `x`, `y`, or `z` in a solid) or `group` (N or N m) reads.
    pub component: Option<Component>,
    /// The field that is read `at` the position or in the `group`.
    pub field: Option<PointField>,
    /// The quantity that is read at the `tip`.
    pub quantity: Option<TipQuantity>,
    /// The inner and the outer radius of the ring around the `tip` over which the quantity is integrated, m; without it two and four horizons.
    pub radii: Option<[f64; 2]>,
    /// The length of the front of a solid's pre-crack, with the `tip` in its middle, over which the quantity is a weighted mean, m; without it twice
    /// the outer radius. The whole front of a disk if it is no longer.
    pub front_length: Option<f64>,
    /// Whether the ring follows the tip of a crack that grows from the `tip` in the plane.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub growing: bool,
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
        let group = |group: String| {
            Ok(match self.component {
                Some(component) if self.field.is_none() => Reading::Force { group, component },
                _ => Reading::Mean {
                    group,
                    field: self.field(key)?,
                },
            })
        };
        let tip = |position: Coordinates| {
            Ok(Reading::Tip(Tip {
                position: position.position(),
                quantity: self.quantity.ok_or_else(|| {
                    required_key(key, "quantity", "with `tip`, to say what to read")
                })?,
                radii: self.radii,
                front_length: self.front_length,
                growing: self.growing,
            }))
        };
        self.require_keys_of_tip(key)?;
        let readings = [
            ("between", self.between.map(between)),
            ("at", self.at.map(at)),
            ("section", self.section.map(section)),
            ("group", self.group.clone().map(group)),
            ("tip", self.tip.map(tip)),
        ];
        Ok(setup::Probe {
            name: self.name.clone(),
            reading: one_of(key, readings)??,
        })
    }

    /// Refuses keys of tips without a `tip`, and `component` and `field` beside a `tip`.
    fn require_keys_of_tip(&self, key: &KeyPath) -> Result<(), KeyFault> {
        let (of_others, of_tips) = (
            [
                ("component", self.component.is_some()),
                ("field", self.field.is_some()),
            ],
            [
                ("quantity", self.quantity.is_some()),
                ("radii", self.radii.is_some()),
                ("front_length", self.front_length.is_some()),
                ("growing", self.growing),
            ],
        );
        let (refused, reason) = match self.tip {
            Some(_) => (&of_others[..], "a probe of a `tip` takes `quantity`"),
            None => (
                &of_tips[..],
                "only a probe of a `tip` takes `quantity`, `radii`, `front_length` and `growing`",
            ),
        };
        match refused.iter().find(|it| it.1) {
            Some((word, _)) => Err(KeyFault::new(key.child(*word), reason)),
            None => Ok(()),
        }
    }

    fn component(&self, key: &KeyPath) -> Result<Component, KeyFault> {
        if self.field.is_some() {
            let reason = "only a probe `at` a point or of a `group` takes `field`; this one takes `component`";
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
            let reason = "a probe `at` a point takes `field`, not `component`; one of a `group` takes one of both";
            return Err(KeyFault::new(key.child("component"), reason));
        }
        self.field
            .ok_or_else(|| required_key(key, "field", "with `at` or `group`, to say what to read"))
    }
}
