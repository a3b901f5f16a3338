//! The orthotropic lamina of OMPPD as finite elements: 1,824 quadrilaterals of nine nodes around the round hole.

use ligament_model::material::{Elasticity, Orthotropic};

use super::finite_elements::{Body, Degree, Mesh, Mode};
use super::named_modes::Frequencies;

const HEIGHT: f64 = 0.2;

const RADIUS: f64 = 0.04;

const THICKNESS: f64 = 1e-3;

const DENSITY: f64 = 2500.0;

/// Length of the fixed end for the modes, m.
const HELD: f64 = 0.01;

/// Thickness of the layers with prescribed displacement in tension, m: the three columns of the lattice within a horizon of the end.
const LAYER: f64 = 0.015;

/// Displacement of the ends in tension, m.
const STROKE: f64 = 0.5e-3;

/// Distance from a mesh line within which nodes lie on it, m.
const NEAR: f64 = 1e-4;

/// The lamina with axis 1 at an angle (rad), and a mesh line at the distance `layer` (m) from both ends.
pub(super) fn lamina(angle: f64, layer: f64) -> Body {
    let elasticity = Elasticity::Orthotropic(Orthotropic {
        young: [15e9, 5e9],
        poisson: 0.25,
        shear_modulus: 4.8e9,
        out_of_plane: None,
        angle,
    });
    let mesh = Mesh::lamina_with_hole(Degree::Quadratic, HEIGHT, RADIUS, layer, 12);
    Body::new(mesh, &elasticity, THICKNESS)
}

/// The three lowest modes of the lamina with a fixed left end.
pub(super) fn modes(angle: f64) -> anyhow::Result<(Mesh, Vec<Mode>)> {
    let body = lamina(angle, HELD);
    let held: Vec<_> = (body.mesh.nodes.iter())
        .map(|[x, _]| [*x < HELD - HEIGHT + NEAR; 2])
        .collect();
    let modes = body.modes(&held, DENSITY, 3)?;
    Ok((body.mesh, modes))
}

/// The named frequencies of the lamina with a fixed left end, Hz.
pub(super) fn frequencies(angle: f64) -> anyhow::Result<Frequencies> {
    let (_, modes) = modes(angle)?;
    let named = |mode: &Mode| (mode.frequency, mode.participation[0]);
    Frequencies::from_modes(modes.iter().map(named))
}

/// The displacements of the nodes under tension by the layers at both ends along x, m.
pub(super) fn displacements(angle: f64) -> anyhow::Result<(Mesh, Vec<[f64; 2]>)> {
    let body = lamina(angle, LAYER);
    let inner = HEIGHT - LAYER - NEAR;
    let mut prescribed: Vec<_> = (body.mesh.nodes.iter())
        .map(|[x, _]| [(x.abs() > inner).then(|| STROKE * x.signum()), None])
        .collect();
    // One node is fixed along y, against the free rigid motion.
    prescribed[body.mesh.nearest_node([HEIGHT, 0.0])][1] = Some(0.0);
    let forces = vec![[0.0; 2]; body.mesh.nodes.len()];
    let displacements = body.displacements(&prescribed, &forces)?;
    Ok((body.mesh, displacements))
}
