//! The square plates of MPPD as finite elements, as the paper has them (section 3, footnote 7).

use ligament_model::material::{Elasticity, Isotropic};

use super::finite_elements::{Body, Degree, Mesh};
use super::named_modes::Frequencies;

/// Side of an element, m.
const SPACING: f64 = 0.01;

const THICKNESS: f64 = 1e-3;

/// Stress that a load comes to, Pa.
const STRESS: f64 = 10e6;

/// Height of the plate that is held, of the modes, m: three rows of elements.
const HELD: f64 = 0.03;

/// A load of MPPD Fig. 11.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum SquareLoad {
    /// Along y on top and bottom.
    Traction,
    /// Along all sides, without the corners.
    Shear,
    /// Along x on both sides, proportional to y.
    Bending,
}

/// A plate of so many elements along each side, with four nodes each.
fn plate(poisson: f64, cells: usize) -> Body {
    let elasticity = Elasticity::Isotropic(Isotropic {
        young: 70e9,
        poisson,
    });
    let mesh = Mesh::rectangle(Degree::Linear, [cells; 2], SPACING);
    Body::new(mesh, &elasticity, THICKNESS)
}

/// The frequencies of the plate of 60 x 60 elements whose lowest 30 mm are held, Hz.
pub(super) fn frequencies(poisson: f64, density: f64) -> anyhow::Result<Frequencies> {
    let body = plate(poisson, 60);
    let base = -30.0 * SPACING + HELD + 0.5 * SPACING;
    let held: Vec<_> = (body.mesh.nodes.iter())
        .map(|[_, y]| [*y < base; 2])
        .collect();
    let modes = body.modes(&held, density, 3)?;
    Frequencies::from_modes(
        modes
            .iter()
            .map(|mode| (mode.frequency, mode.participation[1])),
    )
}

/// The largest |u_x| and |u_y| of all nodes under a load on the volume of the outermost elements, m, the middle at rest.
///
/// The numbers of the paper come from 61 x 61 elements in traction and shear, and from 60 x 60 in bending.
pub(super) fn largest_displacements(load: SquareLoad, poisson: f64) -> anyhow::Result<[f64; 2]> {
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
    Ok(displacements
        .iter()
        .fold([0.0, 0.0], |largest: [f64; 2], u| {
            [0, 1].map(|axis| largest[axis].max((u[axis] - at_rest[axis]).abs()))
        }))
}

/// Turns displacements so that they have no rotation in the mean, about the origin in the middle of the nodes.
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
