//! The forces of uniform strains, as the cells of a body know them.

use ligament_mesh::Cell;
use nalgebra::Matrix3;

use crate::cloud::PointCloud;
use crate::cloud::lattice::{Face, Lattice};
use crate::law::bulk_stiffness;

/// Forces on the points in the uniform strains eps_xx, eps_yy and eps_xy = eps_yx = 1/sqrt(2), which are orthonormal as tensors, so that
/// nothing depends on the axes; shape (n_points, 3, 2), N.
pub type CellForces = Vec<[[f64; 2]; 3]>;

/// Points as the correction sees them.
#[derive(Debug, Clone)]
pub struct Points<'a> {
    /// Places and volumes.
    pub cloud: &'a PointCloud,
    /// Forces of uniform strains.
    pub forces: CellForces,
    /// Whether the points have rotations, and so equations of moments.
    pub turn: bool,
}

/// Stresses (xx, yy, xy) of a stiffness over (eps_xx, eps_yy, gamma_xy) in the three strains, Pa.
fn stresses(stiffness: &Matrix3<f64>) -> [[f64; 3]; 3] {
    let root = std::f64::consts::SQRT_2;
    let column = |k: usize, size: f64| std::array::from_fn(|row| size * stiffness[(row, k)]);
    [column(0, 1.0), column(1, 1.0), column(2, root)]
}

/// Forces of the cells of a mesh with the stiffness of each material, of which each cell has one (n_cells).
///
/// The integral of the gradient of N_P over a cell is half of the side from its last corner before P to the next one after it, turned
/// by a right angle, for triangles and for quadrangles.
pub fn of_mesh(
    cells: &[Cell],
    cloud: &PointCloud,
    material_of_cell: &[u32],
    stiffness: &[Matrix3<f64>],
) -> CellForces {
    let stresses: Vec<_> = stiffness.iter().map(stresses).collect();
    let mut forces = vec![[[0.0; 2]; 3]; cloud.len()];
    for (cell, &material) in cells.iter().zip(material_of_cell) {
        let corners = cell.corners();
        let n = corners.len();
        for (k, &corner) in corners.iter().enumerate() {
            let [[x0, y0], [x1, y1]] = [corners[(k + n - 1) % n], corners[(k + 1) % n]]
                .map(|corner| cloud.positions[corner as usize]);
            let half = 0.5 * cloud.thickness;
            let gradient = [half * (y1 - y0), half * (x0 - x1)];
            add_traction(
                &mut forces[corner as usize],
                &stresses[material as usize],
                gradient,
            );
        }
    }
    forces
}

/// Forces of the cells of a lattice, whose points are their centres: the tractions on the faces of the outline at the cells that have
/// them, and the jump of the tractions between two materials at the cell of the stiffer one, because the bonds between them are
/// corrected as bonds of the softer one.
pub fn of_lattice(
    lattice: &Lattice,
    cloud: &PointCloud,
    material_of_cell: &[u32],
    stiffness: &[Matrix3<f64>],
) -> CellForces {
    let stresses: Vec<_> = stiffness.iter().map(stresses).collect();
    let mut forces = vec![[[0.0; 2]; 3]; cloud.len()];
    let [dx, dy] = lattice.spacing;
    let area = |normal: [i8; 2]| {
        let [x, y] = normal.map(f64::from);
        [x * dy * cloud.thickness, y * dx * cloud.thickness]
    };
    for Face { point, normal, .. } in lattice.outline() {
        let material = material_of_cell[point as usize] as usize;
        add_traction(
            &mut forces[point as usize],
            &stresses[material],
            area(normal),
        );
    }
    for (point, normal, next) in lattice.inner_faces() {
        let ends = [point, next].map(|it| it as usize);
        let [own, other] = ends.map(|it| material_of_cell[it] as usize);
        if own != other {
            let is_softer = bulk_stiffness(&stiffness[own]) <= bulk_stiffness(&stiffness[other]);
            let stiffer = &mut forces[ends[usize::from(is_softer)]];
            add_traction(stiffer, &stresses[own], area(normal));
            add_traction(stiffer, &stresses[other], area(normal).map(|it| -it));
        }
    }
    forces
}

/// Adds sigma times a vector for each of the strains.
fn add_traction(forces: &mut [[f64; 2]; 3], stresses: &[[f64; 3]; 3], [x, y]: [f64; 2]) {
    for (force, [xx, yy, xy]) in forces.iter_mut().zip(stresses) {
        force[0] += xx * x + xy * y;
        force[1] += xy * x + yy * y;
    }
}
