//! `[material]` or `[material.NAME]`: the materials of the body.

use std::sync::LazyLock;

use ligament::setup::MaterialRegion;
use ligament_model::material::OutOfPlane;
use ligament_model::{self as model, Elasticity, Isotropic};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema, schema_for};
use serde::de::{DeserializeOwned, IgnoredAny};
use serde::ser::SerializeMap;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use serde_json::{Map, Value as Json, json};

use super::decode::decode;
use super::document::{Node, Value};
use super::fault::{Fault, KeyFault};
use super::key_path::KeyPath;
use super::values::{RANGE, missing_key, require_unique, required_key};

/// Largest plausible coefficient of expansion, 1/K; a larger one is probably in other units.
const LARGEST_EXPANSION: f64 = 0.01;

/// A linear elastic material with its strengths.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Material {
    /// Name of the material, NAME of `[material.NAME]`; none for the one `[material]` of the whole body.
    #[serde(skip)]
    pub name: Option<String>,
    /// The physical surface of the mesh, or the set of the lattice, that the material fills.
    pub group: Option<String>,
    /// Elastic constants.
    #[serde(flatten)]
    pub constants: Constants,
    /// Strengths, fracture energies and density.
    #[serde(flatten)]
    pub strengths: model::Material,
    /// Thermal expansion.
    #[serde(flatten)]
    pub expansion: Expansion,
}

/// Elastic constants of a kind of material.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Constants {
    /// Constants that are the same in all directions.
    Isotropic(Isotropic),
    /// Constants with axes 1 and 2.
    Orthotropic(Orthotropic),
    /// Constants without symmetry in the plane.
    Anisotropic(Anisotropic),
}

/// Elastic constants of a material with axes 1 and 2.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Orthotropic {
    /// Young's modulus along the axis 1, Pa.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub young_1: f64,
    /// Young's modulus along the axis 2, Pa.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub young_2: f64,
    /// Poisson's ratio: contraction along 2 under stress along 1.
    pub poisson_12: f64,
    /// Shear modulus in the plane, Pa.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub shear_modulus: f64,
    /// Angle from the x axis to axis 1, counter-clockwise, rad.
    #[serde(default)]
    pub angle: f64,
    /// Young's modulus across the plane, Pa; for plane strain.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub young_3: Option<f64>,
    /// Poisson's ratio: contraction across the plane under stress along 1; for plane strain.
    pub poisson_13: Option<f64>,
    /// Poisson's ratio: contraction across the plane under stress along 2; for plane strain.
    pub poisson_23: Option<f64>,
}

/// Elastic constants of a material without symmetry in the plane.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Anisotropic {
    /// Stiffness of sigma_xx by eps_xx, Pa.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub c11: f64,
    /// Stiffness of sigma_xx by eps_yy, Pa.
    pub c12: f64,
    /// Stiffness of sigma_xx by gamma_xy, Pa.
    pub c16: f64,
    /// Stiffness of sigma_yy by eps_yy, Pa.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub c22: f64,
    /// Stiffness of sigma_yy by gamma_xy, Pa.
    pub c26: f64,
    /// Stiffness of sigma_xy by gamma_xy, Pa.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub c66: f64,
}

/// Coefficients of thermal expansion.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Expansion {
    /// Coefficient of linear thermal expansion, 1/K, the same in all directions; steel has 12e-6.
    #[schemars(transform = expansion_range)]
    pub thermal_expansion: Option<f64>,
    /// Thermal expansion along the axis 1, 1/K.
    #[schemars(transform = expansion_range)]
    pub thermal_expansion_1: Option<f64>,
    /// Thermal expansion along the axis 2, 1/K.
    #[schemars(transform = expansion_range)]
    pub thermal_expansion_2: Option<f64>,
    /// Thermal expansion across the plane, 1/K; for plane strain.
    #[schemars(transform = expansion_range)]
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
            material: model::Material {
                name: self.name.clone().unwrap_or_default(),
                elasticity: self.constants.elasticity(&key)?,
                expansion: self.expansion.setup(&key)?,
                ..self.strengths.clone()
            },
        })
    }
}

impl Constants {
    fn elasticity(&self, key: &KeyPath) -> Result<Elasticity, KeyFault> {
        Ok(match self {
            Self::Isotropic(it) => Elasticity::Isotropic(*it),
            Self::Orthotropic(it) => Elasticity::Orthotropic(model::Orthotropic {
                young: [it.young_1, it.young_2],
                poisson: it.poisson_12,
                shear_modulus: it.shear_modulus,
                out_of_plane: it.out_of_plane(key)?,
                angle: it.angle,
            }),
            Self::Anisotropic(it) => Elasticity::Anisotropic(model::Anisotropic::new([
                it.c11, it.c12, it.c16, it.c22, it.c26, it.c66,
            ])),
        })
    }
}

impl Orthotropic {
    fn out_of_plane(&self, key: &KeyPath) -> Result<Option<OutOfPlane>, KeyFault> {
        let (young, along_1, along_2) = (self.young_3, self.poisson_13, self.poisson_23);
        if young.is_none() && along_1.is_none() && along_2.is_none() {
            return Ok(None);
        }
        let needed = |name: &'static str, value: Option<f64>| {
            let reason = "because the other constants across the plane are given";
            value.ok_or_else(|| required_key(key, name, reason))
        };
        Ok(Some(OutOfPlane {
            young: needed("young_3", young)?,
            poisson: [
                needed("poisson_13", along_1)?,
                needed("poisson_23", along_2)?,
            ],
        }))
    }
}

impl Expansion {
    fn setup(&self, key: &KeyPath) -> Result<Option<model::Expansion>, KeyFault> {
        let (one, two) = (self.thermal_expansion_1, self.thermal_expansion_2);
        let across = self.thermal_expansion_3;
        if one.is_none() && two.is_none() && across.is_none() {
            return Ok(self.thermal_expansion.map(model::Expansion::uniform));
        }
        if self.thermal_expansion.is_some() {
            let reason = "it is the same in all directions, but coefficients along the axes are given as well: remove one of the two";
            return Err(KeyFault::new(key.child("thermal_expansion"), reason));
        }
        let needed = |name: &'static str, value: Option<f64>| {
            let reason = "(in 1/K) because a coefficient along another axis is given";
            value.ok_or_else(|| required_key(key, name, reason))
        };
        let in_plane = [
            needed("thermal_expansion_1", one)?,
            needed("thermal_expansion_2", two)?,
        ];
        Ok(Some(model::Expansion { in_plane, across }))
    }
}

/// A kind of material, by the keys that not all kinds have.
struct Kind {
    /// Keys of the constants of this kind only, with their schemas.
    constants: Map<String, Json>,
    /// Required keys of the constants.
    needed: Json,
    /// Optional coefficients of expansion along axes.
    expansion: &'static [&'static str],
    /// Reader of the constants.
    read: fn(&Node, &KeyPath) -> Result<Constants, KeyFault>,
}

/// Coefficients of expansion along axes.
const ALONG_AXES: [&str; 3] = [
    "thermal_expansion_1",
    "thermal_expansion_2",
    "thermal_expansion_3",
];

/// The kinds; keys of a later kind take precedence over keys of an earlier one.
static KINDS: LazyLock<[Kind; 3]> = LazyLock::new(|| {
    [
        Kind::new::<Isotropic>(&[], |table, key| {
            read_keys(table, key).map(Constants::Isotropic)
        }),
        Kind::new::<Orthotropic>(&ALONG_AXES, |table, key| {
            read_keys(table, key).map(Constants::Orthotropic)
        }),
        Kind::new::<Anisotropic>(&ALONG_AXES[..2], |table, key| {
            read_keys(table, key).map(Constants::Anisotropic)
        }),
    ]
});

impl Kind {
    fn new<T: JsonSchema>(
        expansion: &'static [&'static str],
        read: fn(&Node, &KeyPath) -> Result<Constants, KeyFault>,
    ) -> Self {
        let schema = schema_for!(T);
        Self {
            needed: schema.get("required").cloned().unwrap_or_default(),
            constants: keys(schema),
            expansion,
            read,
        }
    }

    /// The kind of a table, determined by a key that only this kind has.
    fn from_table(table: &Node) -> &'static Self {
        let tells = |kind: &&Self| kind.constants.keys().any(|key| table.get(key).is_some());
        KINDS.iter().rev().find(tells).unwrap_or(&KINDS[0])
    }

    /// Keys of other kinds that this kind does not have.
    fn foreign(&self) -> impl Iterator<Item = &str> {
        let all = KINDS.iter().flat_map(|kind| {
            let expansion = kind.expansion.iter().copied();
            kind.constants.keys().map(String::as_str).chain(expansion)
        });
        all.filter(|key| !self.constants.contains_key(*key) && !self.expansion.contains(key))
    }

    /// Refuses keys that tables of this kind do not have.
    fn refuse_others(&self, table: &Node, key: &KeyPath) -> Result<(), KeyFault> {
        let mut valid = all_keys();
        for foreign in self.foreign() {
            valid.shift_remove(foreign);
        }
        let entries = table.entries();
        let Some(unknown) = entries.iter().find(|it| !valid.contains_key(&it.key)) else {
            return Ok(());
        };
        let fault = Fault::UnknownKey {
            key: unknown.key.clone(),
            table: key.table_title(),
            valid: valid.into_iter().map(|(key, _)| key).collect(),
        };
        Err(KeyFault::new(key.child(&unknown.key), fault))
    }

    /// Schema of this kind: required and excluded keys.
    fn schema(&self) -> Json {
        let foreign = self.foreign().map(|key| (key.to_owned(), false.into()));
        json!({ "required": self.needed, "properties": foreign.collect::<Map<String, Json>>() })
    }
}

/// The group of the body that a material fills.
#[derive(Debug, Deserialize, JsonSchema)]
struct MaterialGroup {
    /// The physical surface of the mesh, or the set of the lattice, that the material fills.
    group: Option<String>,
}

/// The keys of a table by its schema.
fn keys(mut table: Schema) -> Map<String, Json> {
    match table.remove("properties") {
        Some(Json::Object(keys)) => keys,
        _ => Map::new(),
    }
}

/// The keys of all kinds.
fn all_keys() -> Map<String, Json> {
    let constants = KINDS.iter().flat_map(|it| it.constants.clone());
    let place = keys(schema_for!(MaterialGroup)).into_iter();
    let others = keys(schema_for!(model::Material)).into_iter();
    let all = place.chain(constants).chain(others);
    all.chain(keys(schema_for!(Expansion))).collect()
}

/// Reads those keys of a table that a structure has.
fn read_keys<T: DeserializeOwned + JsonSchema>(table: &Node, key: &KeyPath) -> Result<T, KeyFault> {
    let keys = keys(schema_for!(T));
    let entries = table.entries().iter();
    let entries = entries.filter(|it| keys.contains_key(&it.key)).cloned();
    let table = Node {
        origin: table.origin,
        value: Value::Table(entries.collect()),
    };
    decode(&table, key)
}

fn key_of(name: Option<&String>) -> KeyPath {
    let section = KeyPath::default().child("material");
    name.map_or(section.clone(), |name| section.child(name))
}

/// Reads the section: one material, or one table for each material.
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
    let kind = Kind::from_table(table);
    kind.refuse_others(table, &key)?;
    let MaterialGroup { group } = read_keys(table, &key)?;
    if name.is_some() && group.is_none() {
        return Err(missing_key(&key, "group"));
    }
    Ok(Material {
        constants: (kind.read)(table, &key)?,
        strengths: read_keys(table, &key)?,
        expansion: read_keys(table, &key)?,
        name,
        group,
    })
}

/// Skips the section, which [`read`] decodes in its two forms.
pub(super) fn skip<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<Material>, D::Error> {
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
/// Schema of one material, or of a table for each of several. All kinds share one table, so that an editor offers all keys; the keys that
/// determine the kind then determine which other keys are required or excluded.
pub(super) fn schema(_: &mut SchemaGenerator) -> Schema {
    let [isotropic, orthotropic, anisotropic] = &*KINDS;
    let tells = |kind: &Kind| has_one_of(&kind.constants);
    let mut keys = all_keys();
    let named = json!({
        "description": "The material of a group.",
        "type": "object",
        "properties": keys,
        "additionalProperties": false,
        "required": ["group"],
        "if": tells(anisotropic),
        "then": anisotropic.schema(),
        "else": { "if": tells(orthotropic), "then": orthotropic.schema(), "else": isotropic.schema() },
    });
    keys.shift_remove("group");
    let names: Vec<&String> = keys.keys().collect();
    let mut one = json!({ "propertyNames": { "enum": names } });
    for keyword in ["if", "then", "else"] {
        one[keyword] = named[keyword].clone();
    }
    json_schema!({
        "type": "object",
        "minProperties": 1,
        "if": has_one_of(&keys),
        "then": one,
        "properties": keys,
        "additionalProperties": named,
    })
}

fn has_one_of(keys: &Map<String, Json>) -> Json {
    let each = keys.keys().map(|key| json!({ "required": [key] }));
    json!({ "anyOf": each.collect::<Json>() })
}

/// Adds the range of a coefficient of expansion to the schema, beyond which the unit is probably wrong.
fn expansion_range(schema: &mut Schema) {
    for (keyword, value) in [
        ("exclusiveMinimum", (-LARGEST_EXPANSION).into()),
        ("exclusiveMaximum", LARGEST_EXPANSION.into()),
        (
            RANGE,
            "between -0.01 and 0.01 (1/K; steel has about 12e-6)".into(),
        ),
    ] {
        schema.insert(keyword.to_owned(), value);
    }
}
