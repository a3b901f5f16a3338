//! `thermal_expansion` of a material.

use schemars::Schema;
use serde::Serialize;

use super::fault::{Fault, KeyFault};
use super::key_path::KeyPath;
use super::values::RANGE;
use ligament_model::Plane;

/// Beyond this, in 1/K, a coefficient was given in other units.
const LARGEST: f64 = 0.01;

/// Coefficients of linear thermal expansion, 1/K.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Expansion {
    /// An expansion that is the same in all directions.
    Uniform {
        /// The coefficient.
        thermal_expansion: f64,
    },
    /// In the axes of an orthotropic material.
    Axes {
        /// Along the axis 1.
        thermal_expansion_1: f64,
        /// Along the axis 2.
        thermal_expansion_2: f64,
        /// Across the plane, for plane strain.
        #[serde(skip_serializing_if = "Option::is_none")]
        thermal_expansion_3: Option<f64>,
    },
}

/// The range of a coefficient in the schema: what lies beyond is a slip of the unit.
pub(super) fn range(schema: &mut Schema) {
    for (keyword, value) in [
        ("exclusiveMinimum", (-LARGEST).into()),
        ("exclusiveMaximum", LARGEST.into()),
        (
            RANGE,
            "between -0.01 and 0.01 (1/K; steel has about 12e-6)".into(),
        ),
    ] {
        schema.insert(keyword.to_owned(), value);
    }
}

impl Expansion {
    /// The one coefficient, or those along axes, of the material at a key; none where none is given.
    pub(super) fn from_keys(
        key: &KeyPath,
        uniform: Option<f64>,
        axes: [Option<f64>; 3],
    ) -> Result<Option<Self>, KeyFault> {
        const NAMES: [&str; 3] = [
            "thermal_expansion_1",
            "thermal_expansion_2",
            "thermal_expansion_3",
        ];
        let [one, two, across] = axes;
        if axes.iter().all(Option::is_none) {
            return Ok(uniform.map(|thermal_expansion| Self::Uniform { thermal_expansion }));
        }
        if uniform.is_some() {
            let reason = "it is the same in all directions, but coefficients along the axes are given as well: remove one of the two";
            return Err(KeyFault::new(key.child("thermal_expansion"), reason));
        }
        let required = |place: usize| {
            let reason = "(in 1/K) because a coefficient along another axis is given";
            required(key, NAMES[place], reason)
        };
        Ok(Some(Self::Axes {
            thermal_expansion_1: one.ok_or_else(|| required(0))?,
            thermal_expansion_2: two.ok_or_else(|| required(1))?,
            thermal_expansion_3: across,
        }))
    }

    /// Plane strain needs the coefficient across the plane.
    pub(super) fn require_suitable(&self, key: &KeyPath, plane: Plane) -> Result<(), KeyFault> {
        match self {
            Self::Axes {
                thermal_expansion_3: None,
                ..
            } if plane == Plane::Strain => {
                let reason = "(in 1/K) because of plane strain, where it widens the plane";
                Err(required(key, "thermal_expansion_3", reason))
            }
            _ => Ok(()),
        }
    }
}

fn required(key: &KeyPath, name: &'static str, reason: &str) -> KeyFault {
    let fault = Fault::Required {
        key: name,
        reason: reason.to_owned(),
    };
    KeyFault::new(key.child(name), fault)
}

impl From<Expansion> for ligament_model::Expansion {
    fn from(expansion: Expansion) -> Self {
        match expansion {
            Expansion::Uniform { thermal_expansion } => Self::uniform(thermal_expansion),
            Expansion::Axes {
                thermal_expansion_1,
                thermal_expansion_2,
                thermal_expansion_3,
            } => Self {
                in_plane: [thermal_expansion_1, thermal_expansion_2],
                across: thermal_expansion_3,
            },
        }
    }
}
