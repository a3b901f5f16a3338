//! The tables of `[material]` as they are read, and their schema.

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;
use serde_json::{Map, Value, json};

use super::super::expansion;
use super::elasticity::{ANISOTROPIC_KEYS, ORTHOTROPIC_KEYS};

/// A table of a material: its group, the keys of its kind, and those that all tables have.
macro_rules! table {
    ($(#[$about:meta])* $name:ident { $($(#[$meta:meta])* $key:ident: $kind:ty,)* }) => {
        $(#[$about])*
        #[derive(Deserialize, JsonSchema)]
        #[serde(deny_unknown_fields)]
        pub(super) struct $name {
            /// The physical surface of the mesh, or the set of the lattice, that the material fills.
            pub(super) group: Option<String>,
            $($(#[$meta])* pub(super) $key: $kind,)*
            /// Tensile strength, Pa.
            #[schemars(extend("exclusiveMinimum" = 0))]
            pub(super) tensile_strength: Option<f64>,
            /// Compressive strength, Pa, positive.
            #[schemars(extend("exclusiveMinimum" = 0))]
            pub(super) compressive_strength: Option<f64>,
            /// Fracture energy of opening, J/m^2.
            #[schemars(extend("exclusiveMinimum" = 0))]
            pub(super) fracture_energy: Option<f64>,
            /// Fracture energy of sliding where it is another, J/m^2; for `mixed-mode`.
            #[schemars(extend("exclusiveMinimum" = 0))]
            pub(super) fracture_energy_sliding: Option<f64>,
            /// Exponent eta between the two fracture energies; for `mixed-mode`.
            #[schemars(extend("exclusiveMinimum" = 0))]
            pub(super) mixed_mode_exponent: Option<f64>,
            /// Mass density, kg/m^3; for natural modes.
            #[schemars(extend("exclusiveMinimum" = 0))]
            pub(super) density: Option<f64>,
            /// Coefficient of linear thermal expansion, 1/K, the same in all directions; steel has 12e-6.
            #[schemars(transform = expansion::range)]
            pub(super) thermal_expansion: Option<f64>,
        }
    };
}

table! {
    /// A material that is the same in all directions.
    RawIsotropic {
        /// Young's modulus, Pa.
        #[schemars(extend("exclusiveMinimum" = 0))]
        young: f64,
        /// Poisson's ratio.
        #[schemars(extend("exclusiveMinimum" = -1, "exclusiveMaximum" = 0.5))]
        poisson: f64,
    }
}

table! {
    /// A material with axes 1 and 2 in the plane.
    RawOrthotropic {
        /// Young's modulus along the axis 1, Pa.
        #[schemars(extend("exclusiveMinimum" = 0))]
        young_1: f64,
        /// Young's modulus along the axis 2, Pa.
        #[schemars(extend("exclusiveMinimum" = 0))]
        young_2: f64,
        /// Poisson's ratio: contraction along 2 under stress along 1.
        poisson_12: f64,
        /// Shear modulus in the plane, Pa.
        #[schemars(extend("exclusiveMinimum" = 0))]
        shear_modulus: f64,
        /// From the x axis to the axis 1, counter-clockwise, rad.
        #[serde(default)]
        angle: f64,
        /// Young's modulus across the plane, Pa; for plane strain.
        #[schemars(extend("exclusiveMinimum" = 0))]
        young_3: Option<f64>,
        /// Poisson's ratio: contraction across the plane under stress along 1; for plane strain.
        poisson_13: Option<f64>,
        /// Poisson's ratio: contraction across the plane under stress along 2; for plane strain.
        poisson_23: Option<f64>,
        /// Thermal expansion along the axis 1, 1/K.
        #[schemars(transform = expansion::range)]
        thermal_expansion_1: Option<f64>,
        /// Thermal expansion along the axis 2, 1/K.
        #[schemars(transform = expansion::range)]
        thermal_expansion_2: Option<f64>,
        /// Thermal expansion across the plane, 1/K; for plane strain.
        #[schemars(transform = expansion::range)]
        thermal_expansion_3: Option<f64>,
    }
}

table! {
    /// A material without any symmetry in the plane; for `mbb-pd`.
    RawAnisotropic {
        /// Stiffness of sigma_xx by eps_xx, Pa.
        #[schemars(extend("exclusiveMinimum" = 0))]
        c11: f64,
        /// Stiffness of sigma_xx by eps_yy, Pa.
        c12: f64,
        /// Stiffness of sigma_xx by gamma_xy, Pa.
        c16: f64,
        /// Stiffness of sigma_yy by eps_yy, Pa.
        #[schemars(extend("exclusiveMinimum" = 0))]
        c22: f64,
        /// Stiffness of sigma_yy by gamma_xy, Pa.
        c26: f64,
        /// Stiffness of sigma_xy by gamma_xy, Pa.
        #[schemars(extend("exclusiveMinimum" = 0))]
        c66: f64,
        /// Thermal expansion along the axis 1, 1/K.
        #[schemars(transform = expansion::range)]
        thermal_expansion_1: Option<f64>,
        /// Thermal expansion along the axis 2, 1/K.
        #[schemars(transform = expansion::range)]
        thermal_expansion_2: Option<f64>,
    }
}

/// One material, or a table for each of several. The three kinds of tables are one, so that an editor offers all keys; the keys
/// that tell the kind to the reader then tell which of the others must be there and which must not.
pub(in super::super) fn schema(generator: &mut SchemaGenerator) -> Schema {
    let kinds = [
        generator.subschema_for::<RawIsotropic>(),
        generator.subschema_for::<RawOrthotropic>(),
        generator.subschema_for::<RawAnisotropic>(),
    ];
    let mut keys = Map::new();
    for kind in &kinds {
        for (key, value) in properties(kind) {
            keys.entry(key).or_insert(value);
        }
    }
    let [isotropic, orthotropic, anisotropic] = kinds.each_ref().map(|kind| own(kind, &keys));
    let named = json!({
        "description": "The material of a group.",
        "type": "object",
        "properties": keys,
        "additionalProperties": false,
        "required": ["group"],
        "if": has_one_of(&ANISOTROPIC_KEYS),
        "then": anisotropic,
        "else": { "if": has_one_of(&ORTHOTROPIC_KEYS), "then": orthotropic, "else": isotropic },
    });
    keys.shift_remove("group");
    let names: Vec<&str> = keys.keys().map(String::as_str).collect();
    let mut one = json!({ "propertyNames": { "enum": names } });
    for keyword in ["if", "then", "else"] {
        one[keyword] = named[keyword].clone();
    }
    json_schema!({
        "type": "object",
        "minProperties": 1,
        "if": has_one_of(&names),
        "then": one,
        "properties": keys,
        "additionalProperties": named,
    })
}

fn properties(table: &Schema) -> Map<String, Value> {
    let found = table.get("properties").and_then(Value::as_object);
    found.cloned().unwrap_or_default()
}

/// Of all keys, those that a kind of table must have and those that it must not have.
fn own(table: &Schema, all: &Map<String, Value>) -> Value {
    let keys = properties(table);
    let foreign = all.keys().filter(|key| !keys.contains_key(*key));
    let foreign: Map<String, Value> = foreign.map(|key| (key.clone(), false.into())).collect();
    json!({ "required": table.get("required").cloned(), "properties": foreign })
}

fn has_one_of(keys: &[&str]) -> Value {
    let each = keys.iter().map(|key| json!({ "required": [key] }));
    json!({ "anyOf": each.collect::<Value>() })
}
