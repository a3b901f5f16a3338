//! First failure of a body under a uniform stress.

use anyhow::Context;

use crate::trial::{Memory, StoredMesh, Template, Trial, stored_mesh, template};

/// The square under a uniform stress.
pub(super) static SQUARE: Template = template!("verification/strength-square.toml");

/// Meshes of the square, Delaunay and frontal.
static MESHES: [StoredMesh; 2] = [
    stored_mesh!("square-delaunay.msh"),
    stored_mesh!("square-frontal.msh"),
];

/// Angles of the principal axes to the edges of the square, degrees.
const ANGLES: [f64; 2] = [0.0, 23.0];

/// Sides of the square, and of the cube, at the lower and the upper end of each axis.
const SIDES: [[&str; 2]; 2] = [["left", "right"], ["bottom", "top"]];
const FACES: [[&str; 2]; 3] = [["left", "right"], ["front", "back"], ["bottom", "top"]];

/// Smallest and largest factor on principal stresses (Pa) at which the first bond of the square fails, over meshes and angles.
pub(super) fn extremes(
    memory: &mut Memory<[f64; 2]>,
    trial: impl Fn() -> Trial,
    principal: [f64; 2],
) -> anyhow::Result<[f64; 2]> {
    memory.result(format!("{} {principal:?}", trial().command()), || {
        let mut found = [f64::INFINITY, f64::NEG_INFINITY];
        for mesh in &MESHES {
            for angle in ANGLES {
                let stress = turned(principal, about_z(angle));
                let loads = tractions("force_per_length", &stress, &SIDES);
                let trial = trial().on_mesh(mesh).set_toml("load", &loads);
                let factor = first_failure(&trial)?;
                found = [found[0].min(factor), found[1].max(factor)];
            }
        }
        Ok(found)
    })
}

/// Factor on principal stresses (Pa) at which the first bond of a cube fails, with axes turned about z and then about x by an angle.
pub(super) fn of_cube(trial: Trial, principal: [f64; 3], degrees: f64) -> anyhow::Result<f64> {
    let [[c, minus_s], [s, _]] = about_z(degrees);
    // The product of the two rotations.
    let axes = [
        [c, minus_s, 0.0],
        [c * s, c * c, minus_s],
        [s * s, s * c, c],
    ];
    let loads = tractions("force_per_area", &turned(principal, axes), &FACES);
    first_failure(&trial.set_toml("load", &loads))
}

/// Load factor at which the first bond fails.
pub(super) fn first_failure(trial: &Trial) -> anyhow::Result<f64> {
    let (_, breaks) = trial.solve_with_breakages()?;
    Ok(breaks.first().context("no bond fails")?.load_factor)
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
