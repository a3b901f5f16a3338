//! `[material]` or `[material.NAME]`: the materials of the body.

mod elasticity;
mod tables;

use ligament_model::failure::Choice;
use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};

use super::criterion;
use super::decode::decode;
use super::document::{Node, Value};
use super::expansion::Expansion;
use super::fault::{Fault, KeyFault};
use super::key_path::KeyPath;
use super::model::Law;
use super::values::require_unique;
use elasticity::{ANISOTROPIC_KEYS, ORTHOTROPIC_KEYS};
pub use elasticity::{Anisotropic, Elasticity, Orthotropic};
use ligament_model::Plane;
pub(super) use tables::schema;
use tables::{RawAnisotropic, RawIsotropic, RawOrthotropic};

/// A linear elastic material with its strengths.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Material {
    /// Name of the material, NAME of `[material.NAME]`; none for the one `[material]` of the whole body.
    #[serde(skip)]
    pub name: Option<String>,
    /// The physical surface of the mesh, or the set of the lattice, that it fills; none for the whole body.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub group: Option<String>,
    /// Elastic constants of the material.
    #[serde(flatten)]
    pub elasticity: Elasticity,
    /// Tensile strength, Pa; there, like the two after it, if a criterion of the case needs it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tensile_strength: Option<f64>,
    /// Compressive strength, Pa, positive.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub compressive_strength: Option<f64>,
    /// Fracture energy, J/m^2.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fracture_energy: Option<f64>,
    /// Fracture energy of sliding where it is another, J/m^2.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fracture_energy_sliding: Option<f64>,
    /// Exponent between the two.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mixed_mode_exponent: Option<f64>,
    /// Mass density, kg/m^3; always there in a modal analysis.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub density: Option<f64>,
    /// Thermal expansion; always there where the temperature changes.
    #[serde(flatten, skip_serializing_if = "Option::is_none")]
    pub expansion: Option<Expansion>,
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
        match &self.elasticity {
            Elasticity::Isotropic { .. } => {}
            Elasticity::Orthotropic(constants) => constants.check(&key)?,
            Elasticity::Anisotropic(constants) => constants.check(&key)?,
        }
        Ok(self)
    }
}

impl From<&Material> for ligament_model::Material {
    fn from(material: &Material) -> Self {
        Self {
            name: material.name.clone().unwrap_or_default(),
            elasticity: material.elasticity.into(),
            tensile_strength: material.tensile_strength,
            compressive_strength: material.compressive_strength,
            fracture_energy: material.fracture_energy,
            fracture_energy_sliding: material.fracture_energy_sliding,
            mixed_mode_exponent: material.mixed_mode_exponent,
            density: material.density,
            expansion: material.expansion.map(Into::into),
        }
    }
}

/// Reads the section: one material, or a table for each of several.
pub(super) fn read(section: &Node) -> Result<Vec<Material>, KeyFault> {
    let key = KeyPath::default().child("material");
    let is_table = |node: &Node| matches!(node.value, Value::Table(_));
    let entries = section.entries();
    let Some(first) = entries.iter().find(|entry| is_table(&entry.node)) else {
        let material = read_one(section, None)?;
        if material.group.is_some() {
            return Err(KeyFault::new(
                key.child("group"),
                "the one [material] fills the whole body: for a part write [material.NAME]",
            ));
        }
        return Ok(vec![material]);
    };
    if let Some(loose) = entries.iter().find(|entry| !is_table(&entry.node)) {
        let reason = format!(
            "`{}` belongs to no material: next to [{}] every key of [material] must be in a table [material.NAME]",
            loose.key,
            key.child(&first.key)
        );
        return Err(KeyFault::new(key.child(&loose.key), reason));
    }
    let mut materials = entries
        .iter()
        .map(|entry| read_one(&entry.node, Some(entry.key.clone())))
        .collect::<Result<Vec<_>, _>>()?;
    materials.sort_by(|one, other| one.name.cmp(&other.name));
    let groups = materials.iter().filter_map(|material| {
        let group = material.group.as_deref()?;
        Some((material.key_path().child("group"), group))
    });
    require_unique(groups, ": a group has one material")?;
    Ok(materials)
}

/// The material of a table that was read: the keys that all tables of materials have go on as they are.
macro_rules! material_of {
    ($raw:ident, $name:ident, $elasticity:ident, $expansion:ident) => {
        Material {
            name: $name,
            group: $raw.group,
            elasticity: $elasticity,
            tensile_strength: $raw.tensile_strength,
            compressive_strength: $raw.compressive_strength,
            fracture_energy: $raw.fracture_energy,
            fracture_energy_sliding: $raw.fracture_energy_sliding,
            mixed_mode_exponent: $raw.mixed_mode_exponent,
            density: $raw.density,
            expansion: $expansion,
        }
    };
}

/// Reads one material; one with a name must have a group.
fn read_one(table: &Node, name: Option<String>) -> Result<Material, KeyFault> {
    let section = KeyPath::default().child("material");
    let key = name.iter().fold(section, |path, name| path.child(name));
    let has_one_of = |keys: &[&str]| keys.iter().any(|key| table.get(key).is_some());
    let material = if has_one_of(&ANISOTROPIC_KEYS) {
        let raw: RawAnisotropic = decode(table, &key)?;
        let axes = [raw.thermal_expansion_1, raw.thermal_expansion_2, None];
        let expansion = Expansion::from_keys(&key, raw.thermal_expansion, axes)?;
        let elasticity = Elasticity::Anisotropic(Anisotropic {
            c11: raw.c11,
            c12: raw.c12,
            c16: raw.c16,
            c22: raw.c22,
            c26: raw.c26,
            c66: raw.c66,
        });
        material_of!(raw, name, elasticity, expansion)
    } else if has_one_of(&ORTHOTROPIC_KEYS) {
        let raw: RawOrthotropic = decode(table, &key)?;
        let axes = [
            raw.thermal_expansion_1,
            raw.thermal_expansion_2,
            raw.thermal_expansion_3,
        ];
        let expansion = Expansion::from_keys(&key, raw.thermal_expansion, axes)?;
        let elasticity = Elasticity::Orthotropic(Orthotropic {
            young_1: raw.young_1,
            young_2: raw.young_2,
            poisson_12: raw.poisson_12,
            shear_modulus: raw.shear_modulus,
            angle: raw.angle,
            young_3: raw.young_3,
            poisson_13: raw.poisson_13,
            poisson_23: raw.poisson_23,
        });
        material_of!(raw, name, elasticity, expansion)
    } else {
        let raw: RawIsotropic = decode(table, &key)?;
        let expansion = Expansion::from_keys(&key, raw.thermal_expansion, [None; 3])?;
        let elasticity = Elasticity::Isotropic {
            young: raw.young,
            poisson: raw.poisson,
        };
        material_of!(raw, name, elasticity, expansion)
    };
    if material.name.is_some() && material.group.is_none() {
        let fault = Fault::MissingKey {
            key: "group".to_owned(),
            table: key.table_title(),
            unit: None,
        };
        return Err(KeyFault::new(key.child("group"), fault));
    }
    material.check()
}

/// The fault of a material without a strength or energy that a criterion takes, or with axes, for which only criteria with a
/// limit of their own are made.
pub(super) fn require_strengths(
    materials: &[Material],
    criteria: &[Choice],
) -> Result<(), KeyFault> {
    for material in materials {
        let (key, material) = (material.key_path(), material.into());
        for criterion in criteria {
            let suits = criterion.suits(&material);
            suits.map_err(|unfit| criterion::fault(&key, unfit))?;
        }
    }
    Ok(())
}

/// The fault of a material without density in a modal analysis.
pub(super) fn require_densities(materials: &[Material]) -> Result<(), KeyFault> {
    match materials.iter().find(|material| material.density.is_none()) {
        None => Ok(()),
        Some(material) => {
            let fault = Fault::Required {
                key: "density",
                reason: "(in kg/m^3) because a modal analysis needs masses".to_owned(),
            };
            Err(KeyFault::new(material.key_path().child("density"), fault))
        }
    }
}

/// The fault of a material with axes under a law for isotropic ones, or without the constants that plane strain needs.
pub(super) fn require_suitable(
    materials: &[Material],
    law: Law,
    plane: Plane,
) -> Result<(), KeyFault> {
    for material in materials {
        material.require_suitable(law, plane)?;
    }
    Ok(())
}

impl Material {
    fn require_suitable(&self, law: Law, plane: Plane) -> Result<(), KeyFault> {
        let key = self.key_path();
        // Six constants are those of the plane whichever it is, and so is what the temperature does to it.
        let is_of_plane = matches!(self.elasticity, Elasticity::Anisotropic(_));
        if let Some(expansion) = self.expansion.filter(|_| !is_of_plane) {
            expansion.require_suitable(&key, plane)?;
        }
        let (what, laws): (_, &[Law]) = match self.elasticity {
            Elasticity::Isotropic { .. } => return Ok(()),
            Elasticity::Orthotropic(_) => ("an orthotropic", &[Law::Orthotropic, Law::MbbPd]),
            Elasticity::Anisotropic(_) => ("an anisotropic", &[Law::MbbPd]),
        };
        if !laws.contains(&law) {
            let words: Vec<String> = laws.iter().map(|it| format!("\"{}\"", it.word())).collect();
            let reason = format!(
                "{what} material needs model.law = {}: \"{}\" is a law for {} ones",
                words.join(" or "),
                law.word(),
                if law == Law::Orthotropic {
                    "orthotropic"
                } else {
                    "isotropic"
                }
            );
            return Err(KeyFault::new(key, reason));
        }
        match &self.elasticity {
            Elasticity::Orthotropic(constants) if plane == Plane::Strain => {
                constants.require_across(&key, "because of plane strain")
            }
            _ => Ok(()),
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
