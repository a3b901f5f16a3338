//! `[material]` or `[material.NAME]`: the materials of the body.

mod kind;

use ligament_model::material::OutOfPlane;
use ligament_model::{Anisotropic, Elasticity, Expansion, Isotropic, Orthotropic};
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::de::IgnoredAny;
use serde::ser::SerializeMap;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use serde_json::Map;

use super::decode::decode;
use super::document::{Node, Value};
use super::fault::KeyFault;
use super::key_path::KeyPath;
use super::values::{missing, require_unique, required};
use kind::Kind;
use ligament::setup::MaterialRegion;

/// A linear elastic material with its strengths.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// Name of the material, NAME of `[material.NAME]`; none for the one `[material]` of the whole body.
    #[serde(skip)]
    pub name: Option<String>,
    /// The physical surface of the mesh, or the set of the lattice, that the material fills.
    pub group: Option<String>,
    /// Young's modulus, Pa.
    #[schemars(extend("exclusiveMinimum" = 0, "x-unit" = "Pa"))]
    pub young: Option<f64>,
    /// Poisson's ratio.
    #[schemars(extend("exclusiveMinimum" = -1, "exclusiveMaximum" = 0.5))]
    pub poisson: Option<f64>,
    /// Young's modulus along the axis 1, Pa.
    #[schemars(extend("exclusiveMinimum" = 0, "x-unit" = "Pa"))]
    pub young_1: Option<f64>,
    /// Young's modulus along the axis 2, Pa.
    #[schemars(extend("exclusiveMinimum" = 0, "x-unit" = "Pa"))]
    pub young_2: Option<f64>,
    /// Poisson's ratio: contraction along 2 under stress along 1.
    pub poisson_12: Option<f64>,
    /// Shear modulus in the plane, Pa.
    #[schemars(extend("exclusiveMinimum" = 0, "x-unit" = "Pa"))]
    pub shear_modulus: Option<f64>,
    /// From the x axis to the axis 1, counter-clockwise, rad.
    #[schemars(extend("default" = 0.0, "x-unit" = "rad"))]
    pub angle: Option<f64>,
    /// Young's modulus across the plane, Pa; for plane strain.
    #[schemars(extend("exclusiveMinimum" = 0, "x-unit" = "Pa"))]
    pub young_3: Option<f64>,
    /// Poisson's ratio: contraction across the plane under stress along 1; for plane strain.
    pub poisson_13: Option<f64>,
    /// Poisson's ratio: contraction across the plane under stress along 2; for plane strain.
    pub poisson_23: Option<f64>,
    /// Stiffness of sigma_xx by eps_xx, Pa.
    #[schemars(extend("exclusiveMinimum" = 0, "x-unit" = "Pa"))]
    pub c11: Option<f64>,
    /// Stiffness of sigma_xx by eps_yy, Pa.
    #[schemars(extend("x-unit" = "Pa"))]
    pub c12: Option<f64>,
    /// Stiffness of sigma_xx by gamma_xy, Pa.
    #[schemars(extend("x-unit" = "Pa"))]
    pub c16: Option<f64>,
    /// Stiffness of sigma_yy by eps_yy, Pa.
    #[schemars(extend("exclusiveMinimum" = 0, "x-unit" = "Pa"))]
    pub c22: Option<f64>,
    /// Stiffness of sigma_yy by gamma_xy, Pa.
    #[schemars(extend("x-unit" = "Pa"))]
    pub c26: Option<f64>,
    /// Stiffness of sigma_xy by gamma_xy, Pa.
    #[schemars(extend("exclusiveMinimum" = 0, "x-unit" = "Pa"))]
    pub c66: Option<f64>,
    /// Tensile strength, Pa.
    #[schemars(extend("exclusiveMinimum" = 0, "x-unit" = "Pa"))]
    pub tensile_strength: Option<f64>,
    /// Compressive strength, Pa, positive.
    #[schemars(extend("exclusiveMinimum" = 0, "x-unit" = "Pa"))]
    pub compressive_strength: Option<f64>,
    /// Fracture energy of opening, J/m^2.
    #[schemars(extend("exclusiveMinimum" = 0, "x-unit" = "J/m^2"))]
    pub fracture_energy: Option<f64>,
    /// Fracture energy of sliding where it is another, J/m^2; for `mixed-mode`.
    #[schemars(extend("exclusiveMinimum" = 0, "x-unit" = "J/m^2"))]
    pub fracture_energy_sliding: Option<f64>,
    /// Exponent eta between the two fracture energies; for `mixed-mode`.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub mixed_mode_exponent: Option<f64>,
    /// Mass density, kg/m^3; for natural modes.
    #[schemars(extend("exclusiveMinimum" = 0, "x-unit" = "kg/m^3"))]
    pub density: Option<f64>,
    /// Coefficient of linear thermal expansion, 1/K, the same in all directions; steel has 12e-6.
    #[schemars(transform = kind::expansion_range, extend("x-unit" = "1/K"))]
    pub thermal_expansion: Option<f64>,
    /// Thermal expansion along the axis 1, 1/K.
    #[schemars(transform = kind::expansion_range, extend("x-unit" = "1/K"))]
    pub thermal_expansion_1: Option<f64>,
    /// Thermal expansion along the axis 2, 1/K.
    #[schemars(transform = kind::expansion_range, extend("x-unit" = "1/K"))]
    pub thermal_expansion_2: Option<f64>,
    /// Thermal expansion across the plane, 1/K; for plane strain.
    #[schemars(transform = kind::expansion_range, extend("x-unit" = "1/K"))]
    pub thermal_expansion_3: Option<f64>,
}

impl Material {
    /// Key path of the material's table in the case file.
    pub fn key(&self) -> String {
        self.key_path().to_string()
    }

    pub(super) fn key_path(&self) -> KeyPath {
        key_of(self.name.as_ref())
    }

    pub(super) fn setup(&self) -> Result<MaterialRegion, KeyFault> {
        let key = self.key_path();
        Ok(MaterialRegion {
            group: self.group.clone(),
            material: ligament_model::Material {
                name: self.name.clone().unwrap_or_default(),
                elasticity: self.elasticity(&key)?,
                tensile_strength: self.tensile_strength,
                compressive_strength: self.compressive_strength,
                fracture_energy: self.fracture_energy,
                fracture_energy_sliding: self.fracture_energy_sliding,
                mixed_mode_exponent: self.mixed_mode_exponent,
                density: self.density,
                expansion: self.expansion(&key)?,
            },
        })
    }

    fn elasticity(&self, key: &KeyPath) -> Result<Elasticity, KeyFault> {
        let needed = |name: &str, value: Option<f64>| value.ok_or_else(|| missing(key, name));
        let stiffness = [self.c11, self.c12, self.c16, self.c22, self.c26, self.c66];
        if stiffness.iter().any(Option::is_some) {
            return Ok(Elasticity::Anisotropic(Anisotropic::new([
                needed("c11", self.c11)?,
                needed("c12", self.c12)?,
                needed("c16", self.c16)?,
                needed("c22", self.c22)?,
                needed("c26", self.c26)?,
                needed("c66", self.c66)?,
            ])));
        }
        // An orthotropic material always has an angle, zero by default.
        if self.angle.is_none() {
            return Ok(Elasticity::Isotropic(Isotropic {
                young: needed("young", self.young)?,
                poisson: needed("poisson", self.poisson)?,
            }));
        }
        Ok(Elasticity::Orthotropic(Orthotropic {
            young: [
                needed("young_1", self.young_1)?,
                needed("young_2", self.young_2)?,
            ],
            poisson: needed("poisson_12", self.poisson_12)?,
            shear_modulus: needed("shear_modulus", self.shear_modulus)?,
            out_of_plane: self.out_of_plane(key)?,
            angle: self.angle.unwrap_or_default(),
        }))
    }

    fn out_of_plane(&self, key: &KeyPath) -> Result<Option<OutOfPlane>, KeyFault> {
        let (young, along_1, along_2) = (self.young_3, self.poisson_13, self.poisson_23);
        if young.is_none() && along_1.is_none() && along_2.is_none() {
            return Ok(None);
        }
        let needed = |name: &'static str, value: Option<f64>| {
            let reason = "because the other constants across the plane are given";
            value.ok_or_else(|| required(key, name, reason))
        };
        Ok(Some(OutOfPlane {
            young: needed("young_3", young)?,
            poisson: [
                needed("poisson_13", along_1)?,
                needed("poisson_23", along_2)?,
            ],
        }))
    }

    fn expansion(&self, key: &KeyPath) -> Result<Option<Expansion>, KeyFault> {
        let (one, two) = (self.thermal_expansion_1, self.thermal_expansion_2);
        let across = self.thermal_expansion_3;
        if one.is_none() && two.is_none() && across.is_none() {
            return Ok(self.thermal_expansion.map(Expansion::uniform));
        }
        if self.thermal_expansion.is_some() {
            let reason = "it is the same in all directions, but coefficients along the axes are given as well: remove one of the two";
            return Err(KeyFault::new(key.child("thermal_expansion"), reason));
        }
        let needed = |name: &'static str, value: Option<f64>| {
            let reason = "(in 1/K) because a coefficient along another axis is given";
            value.ok_or_else(|| required(key, name, reason))
        };
        let in_plane = [
            needed("thermal_expansion_1", one)?,
            needed("thermal_expansion_2", two)?,
        ];
        Ok(Some(Expansion { in_plane, across }))
    }
}

fn key_of(name: Option<&String>) -> KeyPath {
    let section = KeyPath::default().child("material");
    name.map_or(section.clone(), |name| section.child(name))
}

/// Reads the section: one material, or a table for each of several.
pub(super) fn read(section: &Node) -> Result<Vec<Material>, KeyFault> {
    let key = key_of(None);
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

/// Reads one material; one with a name must have a group.
fn read_one(table: &Node, name: Option<String>) -> Result<Material, KeyFault> {
    let key = key_of(name.as_ref());
    let kind = Kind::of_table(table);
    kind.refuse_others(table, &key, keys(&schemars::schema_for!(Material)))?;
    let mut material: Material = decode(table, &key)?;
    if kind.has_angle() {
        material.angle.get_or_insert(0.0);
    }
    if name.is_some() && material.group.is_none() {
        return Err(missing(&key, "group"));
    }
    material.name = name;
    Ok(material)
}

/// The schema of the section.
pub(super) fn schema(generator: &mut SchemaGenerator) -> Schema {
    kind::schema(keys(&generator.subschema_for::<Material>()))
}

/// The keys of a table by its schema.
fn keys(table: &Schema) -> Map<String, serde_json::Value> {
    let found = table.get("properties").and_then(|it| it.as_object());
    found.cloned().unwrap_or_default()
}

/// Skips the section, which [`read`] decodes in its two forms.
pub(super) fn later<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<Material>, D::Error> {
    IgnoredAny::deserialize(deserializer).map(|_| Vec::new())
}

/// Writes the materials in the form of a case file.
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
