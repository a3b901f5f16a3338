//! `[fracture]`: breakage of bonds, and stop rules.

use std::borrow::Cow;

use ligament::setup::{self, Analysis};
use ligament_analysis::breaking::{BreakingOrder, BreakingRule};
use ligament_analysis::driver::StopRules;
use ligament_analysis::driver::event::EventSettings;
use ligament_analysis::driver::stepped::SteppedSettings;
use ligament_analysis::motion::ImplicitSettings;
use ligament_model::failure::Kind;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{Error, Unexpected};
use serde::{Deserialize, Deserializer, Serialize};

use super::criterion::Criterion;
use super::fault::KeyFault;
use super::key_path::KeyPath;
use super::scatter::Scatters;
use super::values::{Numbers, missing, numbers, require};
use super::word::Word;

/// Largest number of equal load steps, and of parts of one: each has a row in the history.
const MOST_STEPS: u32 = 1_000_000;

/// How bonds break while the load rises.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Fracture {
    /// What drives the load.
    #[serde(default)]
    pub control: Control,
    /// The load steps: so many equal ones up to load factor 1, or a list of load factors. With stages each of them has its own.
    pub steps: Option<Steps>,
    /// Bonds broken at most between two solutions.
    #[schemars(range(min = 1), extend("default" = stepped().rule.bonds_per_iteration))]
    pub bonds_per_iteration: Option<u32>,
    /// Order in which the bonds beyond their limit break.
    #[schemars(extend("default" = Word(stepped().rule.order)))]
    pub order: Option<Word<BreakingOrder>>,
    /// Rounds of breaking at most in a load step.
    #[schemars(range(min = 1), extend("default" = stepped().round_limit))]
    pub max_iterations: Option<u32>,
    /// Parts into which the load step of the first breakage is divided after it; 0: not divided.
    #[schemars(range(max = MOST_STEPS), extend("default" = stepped().refine_first_break))]
    pub refine_first_break: Option<u32>,
    /// Bonds closer than this (relative) to the worst one break together with it.
    #[serde(default = "tie_tolerance")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub tie_tolerance: f64,
    /// Relative change of energy below which a solution is in equilibrium.
    #[serde(default = "energy_tolerance")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub energy_tolerance: f64,
    /// When to stop before the end of the loading; whichever comes first.
    #[serde(default)]
    pub stop: Stop,
    /// A strength or a fracture energy that varies over the body at random; both as a list of two tables.
    pub scatter: Option<Scatters>,
    /// When bonds fail: the first criterion that is met decides; without any, by the strength (`mbb-pd`: `mixed-mode`).
    #[serde(rename = "criterion")]
    #[schemars(length(min = 1))]
    pub criteria: Option<Vec<Criterion>>,
}

/// What drives the load.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Control {
    /// Load steps, given by `steps`; in each, bonds break until none is beyond its limit.
    #[default]
    Stepped,
    /// The exact path from breakage to breakage up to load factor 1, without steps and with snap-back.
    Event,
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

/// When to stop before the end of the loading; whichever comes first.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Stop {
    /// When the load has fallen to this share of its largest value; not where the load factor is below an earlier one.
    #[schemars(extend("exclusiveMinimum" = 0, "exclusiveMaximum" = 1))]
    pub load_fraction: Option<f64>,
    /// When the displacement of the first load reaches this, m; in rad, m^3 or K where that is its unit.
    #[schemars(extend("exclusiveMinimum" = 0, "x-unit" = "m"))]
    pub displacement: Option<f64>,
    /// When so many bonds are broken.
    #[schemars(range(min = 1))]
    pub bonds: Option<u64>,
    /// After so much time, s.
    #[schemars(extend("exclusiveMinimum" = 0, "x-unit" = "s"))]
    pub wall_time: Option<f64>,
    /// When the stored energy becomes negative, as it may where Poisson's ratio makes the bonds' shear stiffness negative.
    pub negative_energy: bool,
}

fn stepped() -> SteppedSettings {
    setup::stepped(Vec::new())
}

fn tie_tolerance() -> f64 {
    setup::event().tie_tolerance
}

fn energy_tolerance() -> f64 {
    setup::event().energy_tolerance
}

impl Default for Stop {
    fn default() -> Self {
        Self {
            load_fraction: None,
            displacement: None,
            bonds: None,
            wall_time: None,
            negative_energy: StopRules::NONE.negative_energy,
        }
    }
}

impl Fracture {
    /// Fills in missing keys of the load steps; with stages, these are those of the stages.
    pub(super) fn complete(&mut self, key: &KeyPath, is_staged: bool) -> Result<(), KeyFault> {
        if self.control == Control::Stepped {
            let settings = self.stepping(key, is_staged)?;
            let rule = settings.rule;
            self.bonds_per_iteration = Some(rule.bonds_per_iteration as u32);
            self.order = Some(Word(rule.order));
            self.max_iterations = Some(settings.round_limit as u32);
            self.refine_first_break = Some(settings.refine_first_break as u32);
        }
        Ok(())
    }

    /// Fills in missing keys of the criteria; `law` is the law of the bonds.
    pub(super) fn complete_criteria(
        &mut self,
        key: &KeyPath,
        law: &setup::Law,
    ) -> Result<(), KeyFault> {
        let default: Kind = *law.row.criterion;
        let criteria = self.criteria.get_or_insert_with(|| vec![default.into()]);
        criteria.iter_mut().for_each(Criterion::complete);
        let (kind, key) = (default.word, || key.child("criterion"));
        let expected = format!("one criterion or more (without the key it is kind = \"{kind}\")");
        require(!criteria.is_empty(), key, &expected, [(); 0])
    }

    pub(super) fn setup(&self, key: &KeyPath, is_staged: bool) -> Result<Analysis, KeyFault> {
        Ok(match self.control {
            Control::Stepped => Analysis::Stepped(self.stepping(key, is_staged)?),
            Control::Event => Analysis::Event(EventSettings {
                tie_tolerance: self.tie_tolerance,
                energy_tolerance: self.energy_tolerance,
                stop: self.stop.setup(),
            }),
        })
    }

    /// Settings of implicit steps of a motion, from others for the keys that are not given.
    pub(super) fn implicit(&self, default: ImplicitSettings) -> ImplicitSettings {
        let count = |given: Option<u32>, default: usize| given.map_or(default, |it| it as usize);
        let ImplicitSettings { rule, rounds, .. } = default;
        ImplicitSettings {
            rule: BreakingRule {
                order: self.order.map_or(rule.order, |it| it.0),
                bonds_per_iteration: count(self.bonds_per_iteration, rule.bonds_per_iteration),
                tie_tolerance: self.tie_tolerance,
            },
            rounds: count(self.max_iterations, rounds),
            energy_tolerance: self.energy_tolerance,
            ..default
        }
    }

    fn stepping(&self, key: &KeyPath, is_staged: bool) -> Result<SteppedSettings, KeyFault> {
        let load_factors = match &self.steps {
            Some(steps) => steps.load_factors(),
            None if is_staged => Vec::new(),
            None => return Err(missing(key, "steps")),
        };
        let default = stepped();
        let count = |given: Option<u32>, default: usize| given.map_or(default, |it| it as usize);
        let bonds_per_iteration = count(self.bonds_per_iteration, default.rule.bonds_per_iteration);
        Ok(SteppedSettings {
            load_factors,
            refine_first_break: count(self.refine_first_break, default.refine_first_break),
            rule: BreakingRule {
                order: self.order.map_or(default.rule.order, |it| it.0),
                bonds_per_iteration,
                tie_tolerance: self.tie_tolerance,
            },
            energy_tolerance: self.energy_tolerance,
            round_limit: count(self.max_iterations, default.round_limit),
            stop: self.stop.setup(),
        })
    }
}

impl Stop {
    fn setup(&self) -> StopRules {
        StopRules {
            load_fraction: self.load_fraction,
            displacement: self.displacement,
            bonds: self.bonds.map(|bonds| bonds as usize),
            wall_time: self.wall_time,
            negative_energy: self.negative_energy,
        }
    }
}

impl Steps {
    fn load_factors(&self) -> Vec<f64> {
        match self {
            Self::Uniform(count) => (1..=*count)
                .map(|step| f64::from(step) / f64::from(*count))
                .collect(),
            Self::Factors(factors) => factors.clone(),
        }
    }
}

impl<'de> Deserialize<'de> for Steps {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let expected = "a whole number of load steps or a list of load factors";
        let unfit = |found| Err(D::Error::invalid_type(found, &expected));
        match numbers(deserializer, expected)? {
            Numbers::Integer(0) => Err(D::Error::custom("must be at least 1, found 0")),
            Numbers::Integer(count) if count > i64::from(MOST_STEPS) => Err(D::Error::custom(
                format_args!("must be at most {MOST_STEPS}, found {count}"),
            )),
            Numbers::Integer(count) => match u32::try_from(count) {
                Ok(count) => Ok(Self::Uniform(count)),
                Err(_) => unfit(Unexpected::Signed(count)),
            },
            Numbers::Float(number) => unfit(Unexpected::Float(number)),
            Numbers::List(factors) => Ok(Self::Factors(factors)),
        }
    }
}

impl JsonSchema for Steps {
    fn schema_name() -> Cow<'static, str> {
        "Steps".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "anyOf": [
                { "description": "So many equal steps up to load factor 1.", "type": "integer", "minimum": 1, "maximum": MOST_STEPS },
                {
                    "description": "These load factors; where they fall, the body is unloaded.",
                    "type": "array", "items": { "type": "number" }, "minItems": 1,
                },
            ]
        })
    }
}
