//! `[fracture]`: breakage of bonds, failure criteria, strengths and energies that vary at random, and stop rules.

use super::document::{Entry, Node, Value};
use super::fault::KeyFault;
use super::key_path::KeyPath;
use super::values::{Form, each, missing_key, refuse, require};
use super::word::word_of;
use crate::point_table;
use ligament::setup::{self, Analysis};
use ligament_analysis::breaking::{BreakingOrder, BreakingRule};
use ligament_analysis::driver::StopRules;
use ligament_analysis::driver::event::EventSettings;
use ligament_analysis::driver::stepped::SteppedSettings;
use ligament_analysis::motion::StepBreakages;
use ligament_model::failure::softening::Curve;
use ligament_model::failure::{Choice, Kind, frictional};
use ligament_model::scatter::{self, Scattered};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::borrow::Cow;
use std::path::Path;

/// Largest number of equal load steps, and of parts of one: each has a row in the history.
const MOST_STEPS: u32 = 1_000_000;

/// How bonds break while the load rises.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Fracture {
    /// Control of the load.
    #[serde(default)]
    pub control: Control,
    /// The load steps: a number of equal steps up to load factor 1, or a list of load factors. With stages each stage has its own.
    pub steps: Option<Steps>,
    /// Bonds broken at most between two solutions.
    #[schemars(range(min = 1), extend("default" = stepped().rule.bonds_per_iteration))]
    pub bonds_per_iteration: Option<usize>,
    /// Order in which the bonds beyond their limit break.
    #[schemars(extend("default" = stepped().rule.order))]
    pub order: Option<BreakingOrder>,
    /// Rounds of breaking at most in a load step.
    #[schemars(range(min = 1), extend("default" = stepped().round_limit))]
    pub max_iterations: Option<usize>,
    /// Number of parts into which the load step of the first breakage is divided after it; 0 for no division.
    #[schemars(range(max = MOST_STEPS), extend("default" = stepped().refine_first_break))]
    pub refine_first_break: Option<usize>,
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
    pub stop: StopRules,
    /// A strength or a fracture energy that varies over the body at random; both as a list of two tables.
    pub scatter: Option<Scatters>,
    /// Criteria for the failure of bonds: the first that is met decides; without any, by the strength (`mbb-pd`: `mixed-mode`).
    #[serde(rename = "criterion")]
    #[schemars(length(min = 1))]
    pub criteria: Option<Vec<Choice>>,
}

/// Control of the load.
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
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum Steps {
    /// So many equal steps up to load factor 1.
    Uniform(#[schemars(range(min = 1, max = MOST_STEPS))] u32),
    /// Load factors one after the other; where they fall, the body is unloaded.
    #[schemars(description = "These load factors; where they fall, the body is unloaded.")]
    Factors(#[schemars(length(min = 1))] Vec<f64>),
}

/// Replaces the tables of softening curves, `after = { table = "..." }`, relative to the folder of the case, by their corners, so that results
/// contain the curve itself.
pub(super) fn read_curves(document: &mut Node, folder: &Path) -> Result<(), KeyFault> {
    let criteria = document
        .get_mut("fracture")
        .and_then(|it| it.get_mut("criterion"));
    let Some(Value::List(criteria)) = criteria.map(|it| &mut it.value) else {
        return Ok(());
    };
    for (place, criterion) in criteria.iter_mut().enumerate() {
        let Some(after) = criterion.get_mut("after") else {
            continue;
        };
        let [table] = after.entries() else {
            continue;
        };
        let Value::String(file) = &table.node.value else {
            continue;
        };
        if table.key != "table" {
            continue;
        }
        let path = folder.join(file);
        let corners = point_table::curve(&path);
        let checked = corners.and_then(|it| match Curve::new(&it) {
            Ok(_) => Ok(it),
            Err(error) => Err(format!("{}: {error}", path.display())),
        });
        let corners = checked.map_err(|reason| {
            let key = KeyPath::default().child("fracture").child("criterion");
            let key = key.child(place.to_string()).child("after").child("table");
            KeyFault::new(key, reason)
        })?;
        let origin = after.origin;
        let node = |value| Node { origin, value };
        let corner = |it: [f64; 2]| node(Value::List(it.map(|it| node(Value::Float(it))).to_vec()));
        let list = Value::List(corners.into_iter().map(corner).collect());
        after.value = Value::Table(vec![Entry {
            key: "curve".to_owned(),
            key_origin: origin,
            node: node(list),
        }]);
    }
    Ok(())
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

impl Fracture {
    /// Fills in missing keys of the load steps, which a case with stages has there.
    pub(super) fn complete(&mut self, key: &KeyPath, is_staged: bool) -> Result<(), KeyFault> {
        if self.control == Control::Stepped {
            let settings = self.stepping(key, is_staged)?;
            let rule = settings.rule;
            self.bonds_per_iteration = Some(rule.bonds_per_iteration);
            self.order = Some(rule.order);
            self.max_iterations = Some(settings.round_limit);
            self.refine_first_break = Some(settings.refine_first_break);
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
        for choice in criteria.iter_mut() {
            if choice.kind == frictional::FRICTIONAL && choice.limit.is_none() {
                choice.calibration.get_or_insert_default();
            }
        }
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
                stop: self.stop,
            }),
        })
    }

    /// Breakages in implicit steps of a motion, with `default` for missing keys.
    pub(super) fn step_breakages(&self, default: StepBreakages) -> StepBreakages {
        StepBreakages {
            rule: self.rule(default.rule),
            rounds: self.max_iterations.unwrap_or(default.rounds),
            energy_tolerance: self.energy_tolerance,
        }
    }

    fn rule(&self, default: BreakingRule) -> BreakingRule {
        BreakingRule {
            order: self.order.unwrap_or(default.order),
            bonds_per_iteration: self
                .bonds_per_iteration
                .unwrap_or(default.bonds_per_iteration),
            tie_tolerance: self.tie_tolerance,
        }
    }

    fn stepping(&self, key: &KeyPath, is_staged: bool) -> Result<SteppedSettings, KeyFault> {
        let load_factors = match &self.steps {
            Some(steps) => steps.load_factors(),
            None if is_staged => Vec::new(),
            None => return Err(missing_key(key, "steps")),
        };
        let default = stepped();
        Ok(SteppedSettings {
            load_factors,
            refine_first_break: self
                .refine_first_break
                .unwrap_or(default.refine_first_break),
            rule: self.rule(default.rule),
            energy_tolerance: self.energy_tolerance,
            round_limit: self.max_iterations.unwrap_or(default.round_limit),
            stop: self.stop,
        })
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
        match Form::<f64>::read(deserializer, expected)? {
            Form::Number(_, Some(0)) => Err(D::Error::custom("must be at least 1, found 0")),
            Form::Number(_, Some(count)) if count > i64::from(MOST_STEPS) => Err(D::Error::custom(
                format_args!("must be at most {MOST_STEPS}, found {count}"),
            )),
            Form::Number(_, Some(count)) if count > 0 => Ok(Self::Uniform(count as u32)),
            Form::List(factors) => Ok(Self::Factors(factors)),
            other => Err(other.wrong_form_error(expected)),
        }
    }
}

/// Properties that vary at random: one as a table, several as a list of tables.
#[derive(Debug, Clone, PartialEq)]
pub struct Scatters(pub Vec<Scatter>);

/// A property that varies over the body at random, by a factor with the mean 1.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Scatter {
    /// Property that varies.
    pub of: Scattered,
    /// Distribution of the factors.
    #[serde(default)]
    pub distribution: Distribution,
    /// Weibull modulus; of `weibull`: 5 scatters by 23 %, 12 by 10 %, 25 by 5 %.
    #[schemars(transform = scatter::Distribution::MODULUS.keywords())]
    pub modulus: Option<f64>,
    /// Standard deviation over the mean; of `normal`, where it is less than 0.25, and of `lognormal`.
    #[schemars(transform = scatter::Distribution::DEVIATION.keywords())]
    pub deviation: Option<f64>,
    /// Seed of the random numbers: another seed gives another specimen. The default is 0; the seed of a second property follows from the first.
    pub seed: Option<u64>,
    /// Distance over which the correlation exp(-(r/L)^2) of two places falls to 1/e, m; 0: each point for itself.
    #[serde(default)]
    #[schemars(transform = scatter::Scatter::CORRELATION_LENGTH.keywords())]
    pub correlation_length: f64,
}

/// Distribution of the factors.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Distribution {
    /// Weibull's with two parameters, by its `modulus`.
    #[default]
    Weibull,
    /// Normal with a `deviation`, cut off at four of them.
    Normal,
    /// Lognormal with a `deviation`.
    Lognormal,
}

impl Scatter {
    pub(super) fn setup(&self, key: &KeyPath) -> Result<scatter::Scatter, KeyFault> {
        let (own, other, reason) = match self.distribution {
            Distribution::Weibull => (
                "modulus",
                "deviation",
                "its deviation comes from its modulus",
            ),
            Distribution::Normal | Distribution::Lognormal => {
                ("deviation", "modulus", "it has a `deviation`")
            }
        };
        let setting = format!("distribution = \"{}\"", word_of(&self.distribution));
        refuse(key, self, &[other], &setting, reason)?;
        let given = self.modulus.or(self.deviation);
        let given = given.ok_or_else(|| missing_key(key, own))?;
        Ok(scatter::Scatter {
            of: self.of,
            distribution: match self.distribution {
                Distribution::Weibull => scatter::Distribution::Weibull { modulus: given },
                Distribution::Normal => scatter::Distribution::Normal { deviation: given },
                Distribution::Lognormal => scatter::Distribution::Lognormal { deviation: given },
            },
            seed: self.seed,
            correlation_length: self.correlation_length,
        })
    }
}

impl Scatters {
    pub(super) fn setup(&self, key: &KeyPath) -> Result<Vec<scatter::Scatter>, KeyFault> {
        match &self.0[..] {
            [one] => Ok(vec![one.setup(key)?]),
            all => each(key, all, Scatter::setup),
        }
    }
}

impl<'de> Deserialize<'de> for Scatters {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let expected = "a table with the property that varies, or a list of such tables";
        let mut all = match Form::<Scatter, Scatter>::read(deserializer, expected)? {
            Form::Table(one) => vec![one],
            Form::List(all) => all,
            other => return Err(other.wrong_form_error(expected)),
        };
        match all.first_mut() {
            Some(first) => first.seed.get_or_insert_default(),
            None => return Err(D::Error::invalid_length(0, &expected)),
        };
        Ok(Self(all))
    }
}

impl Serialize for Scatters {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match &self.0[..] {
            [one] => one.serialize(serializer),
            all => all.serialize(serializer),
        }
    }
}

impl JsonSchema for Scatters {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        "Scatters".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let one = generator.subschema_for::<Scatter>();
        json_schema!({ "anyOf": [one, { "type": "array", "items": one, "minItems": 1 }] })
    }
}
