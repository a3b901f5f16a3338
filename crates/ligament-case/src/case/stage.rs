//! `[[stage]]`: successive stages of the loading.

use std::collections::BTreeMap;

use schemars::{JsonSchema, Schema};
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize};

use super::fault::KeyFault;
use super::key_path::KeyPath;
use super::values::{Form, exactly_one, one_of, require_column_name};
use ligament::setup;

/// A stage of the loading: loads that go to other factors, each times the load as it is at factor 1.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Stage {
    /// Name in `history.csv`; by default `stage-1` and so on.
    #[schemars(length(min = 1))]
    pub name: Option<String>,
    /// Factors that loads go to, by the names of the loads; `temperature` for the temperatures. All others keep theirs, which is 0 at
    /// first.
    #[schemars(extend("minProperties" = 1))]
    pub loads: BTreeMap<String, Factors>,
    /// Equal load steps of the stage; not on the exact path, nor in an elastic analysis.
    #[schemars(transform = setup::Stage::STEPS.keywords())]
    pub steps: Option<usize>,
    /// A quantity that grows in equal steps over the stage, while the loads follow in fixed proportion, past peaks and snap-backs. Without it the
    /// factors of the loads grow.
    pub control: Option<Control>,
}

/// What controls a stage: one probe, the sum of several with weights, or the dissipated energy.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = exactly_one(&["probe", "probes", "quantity"])))]
pub struct Control {
    /// Name of a probe that reads a displacement or one between two points; load steps alone.
    pub probe: Option<String>,
    /// Weights of such probes, by their names.
    #[schemars(extend("minProperties" = 1))]
    pub probes: Option<BTreeMap<String, f64>>,
    /// A quantity of the whole body.
    pub quantity: Option<Quantity>,
    /// The value at the end of the stage, in the unit of the probe, or J.
    pub to: f64,
}

/// A quantity of the whole body that controls a stage.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Quantity {
    /// The energy that bonds have dissipated since the loading began, a column of `history.csv`: in load steps with softening bonds; along the exact
    /// path it determines the end of the stage.
    DissipatedEnergy,
}

/// The factors that a load goes to in a stage.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
#[schemars(transform = without_description)]
pub enum Factors {
    /// The factor at the end of the stage.
    End(f64),
    /// Factors at the ends of equal parts of the stage.
    EqualParts(#[schemars(length(min = 1))] Vec<f64>),
    /// Shares of the stage, ascending, more than 0 and at most 1, with the factors there.
    Table(#[schemars(length(min = 1))] Vec<[f64; 2]>),
}

/// Removes the description, which the alternatives contain.
fn without_description(schema: &mut Schema) {
    schema.remove("description");
}

impl Stage {
    /// Sets the stage's name; `number`, from 1, names a stage without a name.
    pub(super) fn complete(&mut self, key: &KeyPath, number: usize) -> Result<(), KeyFault> {
        let name = self.name.get_or_insert_with(|| format!("stage-{number}"));
        require_column_name(|| key.child("name"), name)
    }

    pub(super) fn setup(&self, key: &KeyPath) -> Result<setup::Stage, KeyFault> {
        let course = |(name, factors): (&String, &Factors)| (name.clone(), factors.course());
        Ok(setup::Stage {
            name: self.name.clone().unwrap_or_default(),
            loads: self.loads.iter().map(course).collect(),
            steps: self.steps,
            control: match &self.control {
                Some(control) => Some(control.setup(&key.child("control"))?),
                None => None,
            },
        })
    }
}

impl Control {
    fn setup(&self, key: &KeyPath) -> Result<setup::Control, KeyFault> {
        let one = self.probe.clone().map(|name| vec![(name, 1.0)]);
        let several = self.probes.clone().map(|it| it.into_iter().collect());
        let energy = |Quantity::DissipatedEnergy| setup::Quantity::DissipatedEnergy;
        let keys = [
            ("probe", one.map(setup::Quantity::Probes)),
            ("probes", several.map(setup::Quantity::Probes)),
            ("quantity", self.quantity.map(energy)),
        ];
        Ok(setup::Control {
            quantity: one_of(key, keys)?,
            to: self.to,
        })
    }
}

impl Factors {
    fn course(&self) -> setup::Course {
        match self {
            Self::End(factor) => setup::Course::to(*factor),
            Self::EqualParts(factors) => setup::Course::through(factors),
            Self::Table(points) => setup::Course {
                points: points.clone(),
            },
        }
    }
}

const EXPECTED: &str = "a factor, a list of factors one after the other, or a list of pairs [share of the stage, factor]";

impl<'de> Deserialize<'de> for Factors {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let elements = match Form::<Element>::read(deserializer, EXPECTED)? {
            Form::Number(factor, _) => return Ok(Self::End(factor)),
            Form::List(elements) => elements,
            other => return Err(other.wrong_form_error(EXPECTED)),
        };
        let (mut factors, mut points) = (Vec::new(), Vec::new());
        for element in elements {
            match element {
                Element::Factor(factor) => factors.push(factor),
                Element::Point(point) => points.push(point),
            }
        }
        match (factors.is_empty(), points.is_empty()) {
            (_, true) => Ok(Self::EqualParts(factors)),
            (true, _) => Ok(Self::Table(points)),
            _ => Err(D::Error::custom(format_args!(
                "must be {EXPECTED}, found both"
            ))),
        }
    }
}

/// An element of a list of factors.
enum Element {
    Factor(f64),
    Point([f64; 2]),
}

impl<'de> Deserialize<'de> for Element {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let expected = "a factor or a pair [share of the stage, factor]";
        match Form::<f64>::read(deserializer, expected)? {
            Form::Number(factor, _) => Ok(Self::Factor(factor)),
            Form::List(list) => match list[..] {
                [share, factor] => Ok(Self::Point([share, factor])),
                [] | [_] => Err(D::Error::invalid_length(list.len(), &expected)),
                _ => Err(D::Error::invalid_length(list.len(), &"2 elements")),
            },
            other => Err(other.wrong_form_error(expected)),
        }
    }
}
