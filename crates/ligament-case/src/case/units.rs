//! Units of the keys, for error messages.

use super::key_path::KeyPath;

/// Unit of the number at a key path, where it has one.
pub fn unit_of(key: &KeyPath) -> Option<&'static str> {
    let keys: Vec<&str> = key
        .0
        .iter()
        .map(String::as_str)
        .filter(|part| part.parse::<usize>().is_err())
        .collect();
    match keys.as_slice() {
        [
            ..,
            "young"
            | "young_1"
            | "young_2"
            | "young_3"
            | "shear_modulus"
            | "tensile_strength"
            | "compressive_strength"
            | "c11"
            | "c12"
            | "c16"
            | "c22"
            | "c26"
            | "c66",
        ] => Some("Pa"),
        [.., "angle" | "critical_angle"] => Some("rad"),
        [.., "fracture_energy" | "fracture_energy_sliding"] => Some("J/m^2"),
        [
            ..,
            "thermal_expansion"
            | "thermal_expansion_1"
            | "thermal_expansion_2"
            | "thermal_expansion_3",
        ] => Some("1/K"),
        [.., "change"] => Some("K"),
        [.., "density"] => Some("kg/m^3"),
        [.., "displacement", "rotation"] => Some("rad"),
        [.., "force", "x" | "y"] => Some("N"),
        [.., "force_per_length", "x" | "y"] => Some("N/m"),
        [.., "body_force", "x" | "y"] => Some("N/m^3"),
        [.., "moment"] => Some("N m"),
        [.., "body_couple"] => Some("N m/m^3"),
        [.., "pressure"] => Some("Pa"),
        [.., "profile", "zero" | "one"] => Some("m"),
        [.., "displacement", "x" | "y"] | [.., "stop", "displacement"] => Some("m"),
        [
            ..,
            "thickness" | "horizon" | "spacing" | "corner" | "centre" | "radius" | "length"
            | "rectangle" | "polygon" | "points" | "box" | "at" | "between" | "section",
        ] => Some("m"),
        [.., "wall_time"] => Some("s"),
        _ => None,
    }
}
