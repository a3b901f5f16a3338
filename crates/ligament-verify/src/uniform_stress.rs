//! Loads of a body under a uniform stress.

use anyhow::bail;

/// Names of the sides of a rectangle, then of the faces of a box, at the lower and the upper end of each axis.
const SIDES: [[&str; 2]; 2] = [["left", "right"], ["bottom", "top"]];
const FACES: [[&str; 2]; 3] = [["left", "right"], ["front", "back"], ["bottom", "top"]];

/// The loads of two principal stresses (Pa) on a rectangle, with axes turned by an angle, or of three on a box, with axes turned about z and then
/// about x, as an array in TOML.
pub(super) fn loads(principal: &[f64], degrees: f64) -> anyhow::Result<String> {
    let axes @ [[c, minus_s], [s, _]] = about_z(degrees);
    Ok(match *principal {
        [one, two] => tractions(
            "force_per_length",
            &rotated_stress([one, two], axes),
            &SIDES,
        ),
        [one, two, three] => {
            // The product of the two rotations.
            let axes = [
                [c, minus_s, 0.0],
                [c * s, c * c, minus_s],
                [s * s, s * c, c],
            ];
            tractions(
                "force_per_area",
                &rotated_stress([one, two, three], axes),
                &FACES,
            )
        }
        _ => bail!("{} principal stresses, expected 2 or 3", principal.len()),
    })
}

fn about_z(degrees: f64) -> [[f64; 2]; 2] {
    let (s, c) = degrees.to_radians().sin_cos();
    [[c, -s], [s, c]]
}

/// The stress with principal values along the columns of `axes`.
fn rotated_stress<const D: usize>(principal: [f64; D], axes: [[f64; D]; D]) -> [[f64; D]; D] {
    let component = |i: usize, j: usize| {
        let along = (0..D).map(|k| axes[i][k] * principal[k] * axes[j][k]);
        along.sum()
    };
    std::array::from_fn(|i| std::array::from_fn(|j| component(i, j)))
}

/// The loads sigma . n of a stress on the sides of a box, as an array in TOML. A side without traction has no load.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_turned_pull_has_half_of_it_as_shear() {
        let found = loads(&[2.0, 0.0], 90.0).unwrap();
        assert_eq!(
            found,
            "[{ group = \"bottom\", force_per_length = { y = -2e0 } }, { group = \"top\", force_per_length = { y = 2e0 } }]"
        );
        let found = loads(&[2.0, 0.0], 45.0).unwrap();
        assert_eq!(found.matches("group").count(), 4);
        let [_, x] = [0, 1].map(|place| found.split("x = ").nth(place).unwrap());
        let x: f64 = x.split([' ', ',']).next().unwrap().parse().unwrap();
        assert!((x + 1.0).abs() < 1e-12, "{found}");
    }

    /// A hydrostatic stress does not change under any rotation.
    #[test]
    fn a_pressure_loads_each_face_along_its_normal() {
        let found = loads(&[-3.0; 3], 30.0).unwrap();
        assert_eq!(found.matches("force_per_area").count(), 6);
        for axis in ["x", "y", "z"] {
            assert_eq!(found.matches(&format!("{axis} = ")).count(), 2, "{found}");
        }
        assert!(loads(&[1.0], 0.0).is_err());
    }
}
