//! The square plates of MPPD as finite elements, as in the paper (section 3, footnote 7).

use ligament_model::material::{Elasticity, Isotropic};

use super::finite_elements::{Body, Degree, Mesh, Mode};
use super::named_modes::Frequencies;

/// Side of an element, m.
const SPACING: f64 = 0.01;

const THICKNESS: f64 = 1e-3;

/// Stress of a load, Pa.
const STRESS: f64 = 10e6;

/// Height of the fixed part of the plate for the modes, m: three rows of elements.
const HELD: f64 = 0.03;

/// A load of MPPD Fig. 11.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum SquareLoad {
    /// Traction along y on top and bottom.
    Traction,
    /// Shear along all sides, without the corners.
    Shear,
    /// Traction along x on both sides, proportional to y.
    Bending,
}

impl SquareLoad {
    /// The load with a name.
    pub(super) fn named(name: &str) -> anyhow::Result<Self> {
        match name {
            "traction" => Ok(Self::Traction),
            "shear" => Ok(Self::Shear),
            "bending" => Ok(Self::Bending),
            other => anyhow::bail!("no load `{other}`"),
        }
    }
}

/// A plate of `cells` elements with four nodes along each side.
fn plate(poisson: f64, cells: usize) -> Body {
    let elasticity = Elasticity::Isotropic(Isotropic {
        young: 70e9,
        poisson,
    });
    let mesh = Mesh::rectangle(Degree::Linear, [cells; 2], SPACING);
    Body::new(mesh, &elasticity, THICKNESS)
}

/// The frequencies of the plate of 60 x 60 elements with its lowest 30 mm fixed, Hz.
pub(super) fn frequencies(poisson: f64, density: f64) -> anyhow::Result<Frequencies> {
    let (_, modes) = modes(poisson, density)?;
    let named = |mode: &Mode| (mode.frequency, mode.participation[1]);
    Frequencies::from_modes(modes.iter().map(named))
}

/// The three lowest modes of the plate of 60 x 60 elements with its lowest 30 mm fixed.
pub(super) fn modes(poisson: f64, density: f64) -> anyhow::Result<(Mesh, Vec<Mode>)> {
    let body = plate(poisson, 60);
    let base = -30.0 * SPACING + HELD + 0.5 * SPACING;
    let held: Vec<_> = (body.mesh.nodes.iter())
        .map(|[_, y]| [*y < base; 2])
        .collect();
    let modes = body.modes(&held, density, 3)?;
    Ok((body.mesh, modes))
}

/// The largest |u_x| and |u_y| of all nodes under a body force on the outermost elements, m, with the middle fixed.
pub(super) fn largest_displacements(load: SquareLoad, poisson: f64) -> anyhow::Result<[f64; 2]> {
    let (_, displacements) = displacements(load, poisson)?;
    let larger =
        |largest: [f64; 2], u: &[f64; 2]| [0, 1].map(|axis| largest[axis].max(u[axis].abs()));
    Ok(displacements.iter().fold([0.0, 0.0], larger))
}

/// The displacements of the nodes under a body force on the outermost elements, m.
///
/// The values of the paper are from 61 x 61 elements in traction and shear, and from 60 x 60 in bending.
pub(super) fn displacements(
    load: SquareLoad,
    poisson: f64,
) -> anyhow::Result<(Mesh, Vec<[f64; 2]>)> {
    let cells = if load == SquareLoad::Bending { 60 } else { 61 };
    let body = plate(poisson, cells);
    let outermost = 0.5 * SPACING * (cells - 1) as f64;
    let density = STRESS / SPACING;
    let forces = body.volume_forces(|centre| {
        let side = centre.map(|x| {
            if x.abs() > outermost - 0.5 * SPACING {
                x.signum()
            } else {
                0.0
            }
        });
        let [x, y] = match load {
            SquareLoad::Traction => [0.0, side[1]],
            SquareLoad::Shear if side[0] * side[1] == 0.0 => [side[1], side[0]],
            SquareLoad::Shear => [0.0, 0.0],
            SquareLoad::Bending => [side[0] * centre[1] / outermost, 0.0],
        };
        [density * x, density * y]
    });
    let mut prescribed = vec![[None; 2]; body.mesh.nodes.len()];
    prescribed[body.mesh.nearest_node([0.0, 0.0])] = [Some(0.0); 2];
    prescribed[body.mesh.nearest_node([0.0, 0.3])][0] = Some(0.0);
    let mut displacements = body.displacements(&prescribed, &forces)?;
    let at_rest = if load == SquareLoad::Bending {
        [0.0; 2]
    } else {
        remove_rotation(&body.mesh.nodes, &mut displacements);
        let count = displacements.len() as f64;
        [0, 1].map(|axis| displacements.iter().map(|u| u[axis]).sum::<f64>() / count)
    };
    for u in &mut displacements {
        *u = [u[0] - at_rest[0], u[1] - at_rest[1]];
    }
    Ok((body.mesh, displacements))
}

/// Removes the mean rotation about the origin, the middle of the nodes, from displacements.
fn remove_rotation(nodes: &[[f64; 2]], displacements: &mut [[f64; 2]]) {
    let (mut turned, mut inertia) = (0.0, 0.0);
    for ([x, y], [u, v]) in nodes.iter().zip(&*displacements) {
        turned += x * v - y * u;
        inertia += x * x + y * y;
    }
    for ([x, y], [u, v]) in nodes.iter().zip(displacements) {
        *u += turned / inertia * y;
        *v -= turned / inertia * x;
    }
}
