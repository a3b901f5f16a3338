//! Loads of a body under a uniform stress.

use anyhow::bail;

/// Sides of a rectangle, and of a box, at the lower and the upper end of each axis.
const SIDES: [[&str; 2]; 2] = [["left", "right"], ["bottom", "top"]];
const FACES: [[&str; 2]; 3] = [["left", "right"], ["front", "back"], ["bottom", "top"]];

/// The loads of two principal stresses (Pa) on a rectangle, with axes turned by an angle, or of three on a box, with axes turned about z and then about
/// x, as an array in TOML.
pub(super) fn loads(principal: &[f64], degrees: f64) -> anyhow::Result<String> {
    let axes @ [[c, minus_s], [s, _]] = about_z(degrees);
    Ok(match *principal {
        [one, two] => tractions("force_per_length", &turned([one, two], axes), &SIDES),
        [one, two, three] => {
            // The product of the two rotations.
            let axes = [
                [c, minus_s, 0.0],
                [c * s, c * c, minus_s],
                [s * s, s * c, c],
            ];
            tractions("force_per_area", &turned([one, two, three], axes), &FACES)
        }
        _ => bail!("{} principal stresses, expected 2 or 3", principal.len()),
    })
}

fn about_z(degrees: f64) -> [[f64; 2]; 2] {
    let (s, c) = degrees.to_radians().sin_cos();
    [[c, -s], [s, c]]
}

/// The stress with principal values along the columns of `axes`.
fn turned<const D: usize>(principal: [f64; D], axes: [[f64; D]; D]) -> [[f64; D]; D] {
    let component = |i: usize, j: usize| {
        let along = (0..D).map(|k| axes[i][k] * principal[k] * axes[j][k]);
        along.sum()
    };
    std::array::from_fn(|i| std::array::from_fn(|j| component(i, j)))
}

/// The loads sigma . n of a stress on the sides of a box, as an array in TOML. A side without traction has none.
fn tractions<const D: usize>(key: &str, stress: &[[f64; D]; D], sides: &[[&str; 2]; D]) -> String {
    let largest = stress
        .iter()
        .flatten()
        .fold(0.0, |it: f64, s| it.max(s.abs()));
    let mut loads = Vec::new();
    for (axis, ends) in sides.iter().enumerate() {
        for (group, sign) in ends.iter().zip([-1.0, 1.0]) {
            let components = ["x", "y", "z"].into_iter().zip(stress);
            let components: Vec<String> = components
                .map(|(name, row)| (name, sign * row[axis]))
                .filter(|(_, traction)| traction.abs() > 1e-12 * largest)
                .map(|(name, traction)| format!("{name} = {traction:e}"))
                .collect();
            if !components.is_empty() {
                let components = components.join(", ");
                loads.push(format!(
                    "{{ group = \"{group}\", {key} = {{ {components} }} }}"
                ));
            }
        }
    }
    format!("[{}]", loads.join(", "))
}
