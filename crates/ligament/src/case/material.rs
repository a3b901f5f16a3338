//! `[material]` or `[material.NAME]`: the materials of the body.

use serde::ser::SerializeMap;
use serde::{Deserialize, Serialize, Serializer};

use super::criterion::{Criterion, CriterionKind};
use super::decode::decode;
use super::document::{Node, Value};
use super::fault::{Fault, KeyFault};
use super::key_path::KeyPath;
use super::mesh_section::Plane;
use super::model::Law;
use super::units::unit_of;
use super::values::{require, require_positive, require_unique};

/// A linear elastic material with its strengths.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Material {
    /// Its name, NAME of `[material.NAME]`; none for the one `[material]` of the whole body.
    #[serde(skip)]
    pub name: Option<String>,
    /// The physical surface of the mesh, or the set of the lattice, that it fills; none for the whole body.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub group: Option<String>,
    /// Its elastic constants.
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
    /// Mass density, kg/m^3; always there in a modal analysis.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub density: Option<f64>,
}

/// Elastic constants.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Elasticity {
    /// The same in all directions.
    Isotropic {
        /// Young's modulus, Pa.
        young: f64,
        /// Poisson's ratio.
        poisson: f64,
    },
    /// With axes.
    Orthotropic(Orthotropic),
}

/// Constants of an orthotropic material.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Orthotropic {
    /// Young's modulus along the axis 1, Pa.
    pub young_1: f64,
    /// Young's modulus along the axis 2, Pa.
    pub young_2: f64,
    /// Poisson's ratio: contraction along 2 under stress along 1.
    pub poisson_12: f64,
    /// Shear modulus in the plane, Pa.
    pub shear_modulus: f64,
    /// Angle from the x axis to the axis 1, rad.
    pub angle: f64,
    /// Constants across the plane, for plane strain: Young's modulus, Pa.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub young_3: Option<f64>,
    /// Contraction across under stress along 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub poisson_13: Option<f64>,
    /// Contraction across under stress along 2.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub poisson_23: Option<f64>,
}

/// Keys that only an orthotropic material has: one of them tells it.
const ORTHOTROPIC_KEYS: [&str; 8] = [
    "young_1",
    "young_2",
    "poisson_12",
    "shear_modulus",
    "angle",
    "young_3",
    "poisson_13",
    "poisson_23",
];

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
            Elasticity::Isotropic { young, poisson } => {
                require_positive(&key, "young", *young)?;
                require(
                    *poisson > -1.0 && *poisson < 0.5,
                    || key.child("poisson"),
                    "greater than -1 and less than 0.5",
                    poisson,
                )?;
            }
            Elasticity::Orthotropic(constants) => constants.check(&key)?,
        }
        let positive = [
            ("tensile_strength", self.tensile_strength),
            ("compressive_strength", self.compressive_strength),
            ("fracture_energy", self.fracture_energy),
            ("density", self.density),
        ];
        for (name, value) in positive {
            if let Some(value) = value {
                require_positive(&key, name, value)?;
            }
        }
        Ok(self)
    }
}

impl Orthotropic {
    fn check(&self, key: &KeyPath) -> Result<(), KeyFault> {
        require_positive(key, "young_1", self.young_1)?;
        require_positive(key, "young_2", self.young_2)?;
        require_positive(key, "shear_modulus", self.shear_modulus)?;
        let across = [self.young_3, self.poisson_13, self.poisson_23];
        if across.iter().any(Option::is_some) {
            self.require_across(
                key,
                "because the other constants across the plane are given",
            )?;
        }
        if let Some(young_3) = self.young_3 {
            require_positive(key, "young_3", young_3)?;
        }
        let stable = ligament_model::Orthotropic::from(*self).is_stable();
        require(
            stable,
            || key.child("poisson_12"),
            "so small that every strain costs energy (nu_12^2 < E_1/E_2, and the like across the plane)",
            self.poisson_12,
        )
    }

    fn require_across(&self, key: &KeyPath, reason: &'static str) -> Result<(), KeyFault> {
        let across = [
            ("young_3", self.young_3),
            ("poisson_13", self.poisson_13),
            ("poisson_23", self.poisson_23),
        ];
        match across.into_iter().find(|(_, value)| value.is_none()) {
            None => Ok(()),
            Some((name, _)) => {
                let fault = Fault::Required {
                    key: name,
                    reason: reason.to_owned(),
                };
                Err(KeyFault::new(key.child(name), fault))
            }
        }
    }
}

impl From<Orthotropic> for ligament_model::Orthotropic {
    fn from(constants: Orthotropic) -> Self {
        let across = constants.young_3.zip(constants.poisson_13);
        let across = across.zip(constants.poisson_23);
        Self {
            young: [constants.young_1, constants.young_2],
            poisson: constants.poisson_12,
            shear_modulus: constants.shear_modulus,
            out_of_plane: across.map(|((young, along_1), along_2)| {
                ligament_model::material::OutOfPlane {
                    young,
                    poisson: [along_1, along_2],
                }
            }),
            angle: constants.angle,
        }
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawIsotropic {
    group: Option<String>,
    young: f64,
    poisson: f64,
    tensile_strength: Option<f64>,
    compressive_strength: Option<f64>,
    fracture_energy: Option<f64>,
    density: Option<f64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawOrthotropic {
    group: Option<String>,
    young_1: f64,
    young_2: f64,
    poisson_12: f64,
    shear_modulus: f64,
    #[serde(default)]
    angle: f64,
    young_3: Option<f64>,
    poisson_13: Option<f64>,
    poisson_23: Option<f64>,
    tensile_strength: Option<f64>,
    compressive_strength: Option<f64>,
    fracture_energy: Option<f64>,
    density: Option<f64>,
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

/// Reads one material; one with a name must have a group.
fn read_one(table: &Node, name: Option<String>) -> Result<Material, KeyFault> {
    let section = KeyPath::default().child("material");
    let key = name.iter().fold(section, |path, name| path.child(name));
    let is_orthotropic = ORTHOTROPIC_KEYS.iter().any(|key| table.get(key).is_some());
    let material = if is_orthotropic {
        let raw: RawOrthotropic = decode(table, &key)?;
        Material {
            name,
            group: raw.group,
            elasticity: Elasticity::Orthotropic(Orthotropic {
                young_1: raw.young_1,
                young_2: raw.young_2,
                poisson_12: raw.poisson_12,
                shear_modulus: raw.shear_modulus,
                angle: raw.angle,
                young_3: raw.young_3,
                poisson_13: raw.poisson_13,
                poisson_23: raw.poisson_23,
            }),
            tensile_strength: raw.tensile_strength,
            compressive_strength: raw.compressive_strength,
            fracture_energy: raw.fracture_energy,
            density: raw.density,
        }
    } else {
        let raw: RawIsotropic = decode(table, &key)?;
        Material {
            name,
            group: raw.group,
            elasticity: Elasticity::Isotropic {
                young: raw.young,
                poisson: raw.poisson,
            },
            tensile_strength: raw.tensile_strength,
            compressive_strength: raw.compressive_strength,
            fracture_energy: raw.fracture_energy,
            density: raw.density,
        }
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
    criteria: &[Criterion],
) -> Result<(), KeyFault> {
    for material in materials {
        for criterion in criteria {
            material.require_strengths(criterion)?;
        }
    }
    Ok(())
}

impl Material {
    fn require_strengths(&self, criterion: &Criterion) -> Result<(), KeyFault> {
        let (path, kind) = (self.key_path(), criterion.kind.word());
        for (key, instead) in criterion.needs() {
            if let Elasticity::Orthotropic(_) = self.elasticity {
                let advice = match instead {
                    Some(instead) => format!("give it its own `{instead}`"),
                    None => {
                        "take \"tension\", \"compression\" or \"sliding\" with a `limit`".to_owned()
                    }
                };
                let reason = format!(
                    "`{key}` gives limits of isotropic materials only, and the criterion \"{kind}\" of [fracture] takes them \
                     from it: {advice}"
                );
                return Err(KeyFault::new(path, reason));
            }
            let value = match key {
                "tensile_strength" => self.tensile_strength,
                "compressive_strength" => self.compressive_strength,
                _ => self.fracture_energy,
            };
            if value.is_none() {
                let unit = unit_of(&path.child(key)).unwrap_or_default();
                let instead = instead.map(|it| format!(" without `{it}`"));
                let reason = format!(
                    "(in {unit}) because the case has a [fracture] section with the criterion \"{kind}\"{}",
                    instead.unwrap_or_default()
                );
                return Err(KeyFault::new(
                    path.child(key),
                    Fault::Required { key, reason },
                ));
            }
        }
        self.require_friction(criterion)
    }

    /// Friction makes sliding harder under compression, so that the compressive strength is the larger one.
    fn require_friction(&self, criterion: &Criterion) -> Result<(), KeyFault> {
        match (
            criterion.kind,
            self.tensile_strength,
            self.compressive_strength,
        ) {
            (CriterionKind::Frictional { .. }, Some(tensile), Some(compressive)) => require(
                compressive >= tensile,
                || self.key_path().child("compressive_strength"),
                "at least the tensile_strength for the criterion \"frictional\"",
                compressive,
            ),
            _ => Ok(()),
        }
    }
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
        let Elasticity::Orthotropic(constants) = &material.elasticity else {
            continue;
        };
        let key = material.key_path();
        if !matches!(law, Law::Orthotropic | Law::MbbPd) {
            let reason = format!(
                "an orthotropic material needs model.law = \"orthotropic\" or \"mbb-pd\": \"{}\" is a law for isotropic ones",
                law.word()
            );
            return Err(KeyFault::new(key, reason));
        }
        if plane == Plane::Strain {
            constants.require_across(&key, "because of plane strain")?;
        }
    }
    Ok(())
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
