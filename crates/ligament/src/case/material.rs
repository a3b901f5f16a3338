//! `[material]` or `[material.NAME]`: the materials of the body.

use std::collections::BTreeMap;

use serde::ser::SerializeMap;
use serde::{Deserialize, Serialize, Serializer};

use super::decode::decode;
use super::document::{Node, Value};
use super::fault::{Fault, KeyFault};
use super::key_path::KeyPath;
use super::values::{require, require_positive, require_unique};

/// An isotropic linear elastic material with a tensile strength.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Material {
    /// Its name, NAME of `[material.NAME]`; none for the one `[material]` of the whole body.
    #[serde(skip)]
    pub name: Option<String>,
    /// The physical surface it fills; none for the whole body.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub group: Option<String>,
    /// Young's modulus, Pa.
    pub young: f64,
    /// Poisson's ratio.
    pub poisson: f64,
    /// Tensile strength, Pa; always there if the case has a `[fracture]` section.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tensile_strength: Option<f64>,
    /// Mass density, kg/m^3; only reported.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub density: Option<f64>,
}

impl Material {
    /// Key path of its table in the case file.
    pub fn key(&self) -> String {
        self.key_path().to_string()
    }

    pub(super) fn key_path(&self) -> KeyPath {
        let section = KeyPath::default().child("material");
        self.name
            .iter()
            .fold(section, |path, name| path.child(name))
    }

    fn check(self) -> Result<Self, KeyFault> {
        let key = self.key_path();
        require_positive(&key, "young", self.young)?;
        let stable = self.poisson > -1.0 && self.poisson < 0.5;
        require(
            stable,
            || key.child("poisson"),
            "greater than -1 and less than 0.5",
            self.poisson,
        )?;
        if let Some(strength) = self.tensile_strength {
            require_positive(&key, "tensile_strength", strength)?;
        }
        if let Some(density) = self.density {
            require_positive(&key, "density", density)?;
        }
        Ok(self)
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct OnlyMaterial {
    young: f64,
    poisson: f64,
    tensile_strength: Option<f64>,
    density: Option<f64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct NamedMaterial {
    group: String,
    young: f64,
    poisson: f64,
    tensile_strength: Option<f64>,
    density: Option<f64>,
}

/// Reads the section: one material, or a table for each of several.
pub(super) fn read(section: &Node) -> Result<Vec<Material>, KeyFault> {
    let key = KeyPath::default().child("material");
    let mut tables = section
        .entries()
        .iter()
        .filter(|entry| matches!(entry.node.value, Value::Table(_)));
    let Some(first) = tables.next() else {
        let OnlyMaterial {
            young,
            poisson,
            tensile_strength,
            density,
        } = decode(section, &key)?;
        let material = Material {
            name: None,
            group: None,
            young,
            poisson,
            tensile_strength,
            density,
        };
        return Ok(vec![material.check()?]);
    };
    if let Some(loose) = section
        .entries()
        .iter()
        .find(|entry| !matches!(entry.node.value, Value::Table(_)))
    {
        let reason = format!(
            "`{}` belongs to no material: next to [{}] every key of [material] must be in a table [material.NAME]",
            loose.key,
            key.child(&first.key)
        );
        return Err(KeyFault::new(key.child(&loose.key), reason));
    }
    read_named(decode(section, &key)?)
}

fn read_named(tables: BTreeMap<String, NamedMaterial>) -> Result<Vec<Material>, KeyFault> {
    let mut materials = Vec::with_capacity(tables.len());
    for (
        name,
        NamedMaterial {
            group,
            young,
            poisson,
            tensile_strength,
            density,
        },
    ) in tables
    {
        let (name, group) = (Some(name), Some(group));
        materials.push(
            Material {
                name,
                group,
                young,
                poisson,
                tensile_strength,
                density,
            }
            .check()?,
        );
    }
    let groups = materials.iter().filter_map(|material| {
        let group = material.group.as_deref()?;
        Some((material.key_path().child("group"), group))
    });
    require_unique(groups, ": a group has one material")?;
    Ok(materials)
}

/// The fault of a material without strength in a case with fracture.
pub(super) fn require_strengths(materials: &[Material]) -> Result<(), KeyFault> {
    match materials
        .iter()
        .find(|material| material.tensile_strength.is_none())
    {
        None => Ok(()),
        Some(material) => {
            let fault = Fault::Required {
                key: "tensile_strength",
                reason: "(in Pa) because the case has a [fracture] section",
            };
            Err(KeyFault::new(
                material.key_path().child("tensile_strength"),
                fault,
            ))
        }
    }
}

/// Writes the materials as they stand in a case file.
pub(super) fn serialize<S: Serializer>(
    materials: &[Material],
    serializer: S,
) -> Result<S::Ok, S::Error> {
    match materials {
        [only] if only.name.is_none() => only.serialize(serializer),
        named => {
            let mut map = serializer.serialize_map(Some(named.len()))?;
            for material in named {
                map.serialize_entry(material.name.as_deref().unwrap_or_default(), material)?;
            }
            map.end()
        }
    }
}
