//! `[fracture]` and `[output]`: how bonds break, when to stop, what to write.

use std::borrow::Cow;
use std::fmt;

use ligament::setup;
use ligament_model::failure::Choice;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};

use super::criterion::{self, RawCriterion};
use super::fault::{Fault, KeyFault};
use super::key_path::KeyPath;
use super::model::Law;
use super::values::{require, require_at_least_one};
use super::word::Word;
use ligament_analysis::breaking::BreakingOrder;

/// How bonds break while the load rises.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Fracture {
    /// What drives the load, with the keys that only it has.
    #[serde(flatten)]
    pub control: Control,
    /// Bonds closer than this (relative) to the worst one break together with it.
    pub tie_tolerance: f64,
    /// Relative change of energy below which a solution is in equilibrium.
    pub energy_tolerance: f64,
    /// When to stop before the end of the loading.
    pub stop: Stop,
    /// When bonds fail; the first criterion that is met decides.
    #[serde(rename = "criterion", serialize_with = "criterion::serialize")]
    pub criteria: Vec<Choice>,
}

/// What drives the load.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "control", rename_all = "lowercase")]
pub enum Control {
    /// Given load steps; in each, bonds break until none is beyond its critical stretch.
    Stepped(Stepping),
    /// The exact equilibrium path, from breakage to breakage, up to load factor 1: it has no steps, and snaps back.
    Event,
}

/// The keys of `control = "stepped"`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Stepping {
    /// The load steps.
    pub steps: Steps,
    /// Bonds broken at most between two solutions.
    pub bonds_per_iteration: u32,
    /// Order in which the bonds beyond their critical stretch break.
    pub order: Word<BreakingOrder>,
    /// Rounds of breaking allowed in a load step.
    pub max_iterations: u32,
    /// Parts into which the load step of the first breakage is divided after it; 0: not divided.
    pub refine_first_break: u32,
}

/// The load steps.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Steps {
    /// So many equal steps up to load factor 1.
    Uniform(u32),
    /// Load factors one after the other; where they fall, the body is unloaded.
    Factors(Vec<f64>),
}

impl<'de> Deserialize<'de> for Steps {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(StepsVisitor)
    }
}

impl JsonSchema for Steps {
    fn schema_name() -> Cow<'static, str> {
        "Steps".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "anyOf": [
                { "description": "So many equal steps up to load factor 1.", "type": "integer", "minimum": 1 },
                {
                    "description": "These load factors; where they fall, the body is unloaded.",
                    "type": "array", "items": { "type": "number" }, "minItems": 1,
                },
            ]
        })
    }
}

struct StepsVisitor;

impl<'de> Visitor<'de> for StepsVisitor {
    type Value = Steps;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("a whole number of load steps or a list of load factors")
    }

    fn visit_i64<E: serde::de::Error>(self, value: i64) -> Result<Steps, E> {
        let out_of_range = |_| E::invalid_value(serde::de::Unexpected::Signed(value), &self);
        u32::try_from(value)
            .map(Steps::Uniform)
            .map_err(out_of_range)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut elements: A) -> Result<Steps, A::Error> {
        let mut factors = Vec::new();
        while let Some(factor) = elements.next_element()? {
            factors.push(factor);
        }
        Ok(Steps::Factors(factors))
    }
}

impl Steps {
    fn check(&self, table: &KeyPath) -> Result<(), KeyFault> {
        match self {
            Self::Uniform(count) => require_at_least_one(table, "steps", *count),
            Self::Factors(factors) => {
                let key = table.child("steps");
                require(
                    !factors.is_empty(),
                    || key.clone(),
                    "one load factor or more",
                    factors,
                )?;
                let mut last = 0.0;
                for (index, &factor) in factors.iter().enumerate() {
                    let expected =
                        format!("a number other than the load factor before it, {last:?}");
                    let moves = factor.is_finite() && factor != last;
                    require(moves, || key.child(index), &expected, factor)?;
                    last = factor;
                }
                Ok(())
            }
        }
    }
}

/// When to stop before the end of the loading; whichever comes first.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Stop {
    /// When the load has fallen to this share of its largest value.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0, "exclusiveMaximum" = 1))]
    pub load_fraction: Option<f64>,
    /// When the displacement of the first load reaches this, m; in rad, m^3 or K where that is its unit.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub displacement: Option<f64>,
    /// When so many bonds are broken.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 1))]
    pub bonds: Option<u64>,
    /// After so much time, s.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub wall_time: Option<f64>,
    /// When the stored energy becomes negative, as it may where Poisson's ratio makes the bonds' shear stiffness negative.
    pub negative_energy: bool,
}

impl Default for Stop {
    fn default() -> Self {
        Self {
            load_fraction: None,
            displacement: None,
            bonds: None,
            wall_time: None,
            negative_energy: true,
        }
    }
}

#[derive(Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
enum ControlName {
    /// Load steps, given by `steps`; in each, bonds break until none is beyond its limit.
    #[default]
    Stepped,
    /// The exact path from breakage to breakage up to load factor 1, without steps and with snap-back.
    Event,
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct RawFracture {
    /// What drives the load.
    #[serde(default)]
    control: ControlName,
    /// The load steps: so many equal ones up to load factor 1, or a list of load factors.
    steps: Option<Steps>,
    /// Bonds broken at most between two solutions.
    #[schemars(range(min = 1), extend("default" = 5))]
    bonds_per_iteration: Option<u32>,
    /// Order in which the bonds beyond their limit break.
    #[schemars(extend("default" = "excess"))]
    order: Option<Word<BreakingOrder>>,
    /// Bonds closer than this (relative) to the worst one break together with it.
    #[schemars(extend("default" = 1e-8, "exclusiveMinimum" = 0))]
    tie_tolerance: Option<f64>,
    /// Relative change of energy below which a solution is in equilibrium.
    #[schemars(extend("default" = 1e-4, "exclusiveMinimum" = 0))]
    energy_tolerance: Option<f64>,
    /// Rounds of breaking at most in a load step.
    #[schemars(range(min = 1), extend("default" = 10_000))]
    max_iterations: Option<u32>,
    /// Parts into which the load step of the first breakage is divided after it; 0: not divided.
    #[schemars(extend("default" = 0))]
    refine_first_break: Option<u32>,
    /// When to stop before the end of the loading; whichever comes first.
    #[serde(default)]
    stop: Stop,
    /// When bonds fail: the first criterion that is met decides; without any, by the strength (`mbb-pd`: `mixed-mode`).
    #[schemars(length(min = 1))]
    criterion: Option<Vec<RawCriterion>>,
}

impl RawFracture {
    pub(super) fn check(self, key: &KeyPath, law: Law) -> Result<Fracture, KeyFault> {
        let control = match self.control {
            ControlName::Stepped => Control::Stepped(self.stepping(key)?),
            ControlName::Event => {
                self.refuse_stepping(key)?;
                Control::Event
            }
        };
        let default = setup::event();
        Ok(Fracture {
            criteria: criteria(self.criterion, &key.child("criterion"), &control, law)?,
            control,
            tie_tolerance: self.tie_tolerance.unwrap_or(default.tie_tolerance),
            energy_tolerance: (self.energy_tolerance).unwrap_or(default.energy_tolerance),
            stop: self.stop,
        })
    }

    fn stepping(&self, key: &KeyPath) -> Result<Stepping, KeyFault> {
        let Some(steps) = self.steps.clone() else {
            let fault = Fault::MissingKey {
                key: "steps".to_owned(),
                table: key.table_title(),
                unit: None,
            };
            return Err(KeyFault::new(key.child("steps"), fault));
        };
        let default = setup::stepped(Vec::new());
        let count = |given: Option<u32>, default: usize| given.unwrap_or(default as u32);
        let stepping = Stepping {
            steps,
            bonds_per_iteration: count(self.bonds_per_iteration, default.rule.bonds_per_iteration),
            order: self.order.unwrap_or(Word(default.rule.order)),
            max_iterations: count(self.max_iterations, default.round_limit),
            refine_first_break: count(self.refine_first_break, default.refine_first_break),
        };
        stepping.steps.check(key)?;
        Ok(stepping)
    }

    /// Keys of the load steps mean nothing where there are none: a user who gives one expects what will not happen.
    fn refuse_stepping(&self, key: &KeyPath) -> Result<(), KeyFault> {
        let given = [
            ("steps", self.steps.is_some()),
            ("bonds_per_iteration", self.bonds_per_iteration.is_some()),
            ("order", self.order.is_some()),
            ("max_iterations", self.max_iterations.is_some()),
            ("refine_first_break", self.refine_first_break.is_some()),
        ];
        match given.into_iter().find(|(_, given)| *given) {
            Some((name, _)) => Err(KeyFault::new(
                key.child(name),
                Fault::NotWith {
                    key: name,
                    setting: "control = \"event\"".to_owned(),
                    reason: "the path goes from breakage to breakage without load steps",
                },
            )),
            None => Ok(()),
        }
    }
}

/// The criteria of a case, or the one of a case that names none.
fn criteria(
    given: Option<Vec<RawCriterion>>,
    list: &KeyPath,
    control: &Control,
    law: Law,
) -> Result<Vec<Choice>, KeyFault> {
    let default = criterion::default_of(law);
    let Some(given) = given else {
        return Ok(vec![default]);
    };
    let kind = default.kind.word;
    let expected = format!("one criterion or more (without the key it is kind = \"{kind}\")");
    require(!given.is_empty(), || list.clone(), &expected, [(); 0])?;
    let checked = given.into_iter().enumerate();
    let checked =
        checked.map(|(place, it)| it.check(&list.child(place), *control == Control::Event));
    checked.collect()
}

/// What a run writes.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Output {
    /// Load steps, or events of the exact path, between two field files; 0: only the first and the last state.
    pub fields_every: u32,
    /// Whether the bonds are written too.
    pub bonds: bool,
    /// Whether the model is written, which `ligament explain` reads.
    pub model: bool,
    /// Stresses that the field files have.
    pub stress: Vec<StressField>,
}

/// A reading of the stress at the points.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum StressField {
    /// The mean of the force dyads of a point's bonds.
    Virial,
    /// The force through small planes at the point.
    Traction,
}

#[derive(Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub(super) struct RawOutput {
    /// Load steps (default 10) or events of the exact path (100) between two field files; 0: the first and the last state alone.
    fields_every: Option<u32>,
    /// Whether the bonds are written as lines with each field file.
    bonds: bool,
    /// Whether `model.vtu` is written, which `ligament explain` reads.
    #[schemars(extend("default" = true))]
    model: Option<bool>,
    /// Stresses at the points in the field files.
    #[schemars(extend("uniqueItems" = true))]
    stress: Vec<StressField>,
}

impl RawOutput {
    pub(super) fn complete(
        self,
        key: &KeyPath,
        fracture: Option<&Fracture>,
    ) -> Result<Output, KeyFault> {
        let is_repeated =
            |(place, field): (usize, &StressField)| self.stress[..place].contains(field);
        let once = !self.stress.iter().enumerate().any(is_repeated);
        require(
            once,
            || key.child("stress"),
            "each stress once",
            &self.stress,
        )?;
        // An event breaks a bond or two, a load step at the peak hundreds.
        let default = match fracture.map(|fracture| &fracture.control) {
            Some(Control::Event) => 100,
            Some(Control::Stepped(_)) | None => 10,
        };
        Ok(Output {
            fields_every: self.fields_every.unwrap_or(default),
            bonds: self.bonds,
            model: self.model.unwrap_or(true),
            stress: self.stress,
        })
    }
}
