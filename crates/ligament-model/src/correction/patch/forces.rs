//! The forces of uniform strains, as the cells of a mesh know them.

use ligament_mesh::Cell;
use nalgebra::Matrix3;

use crate::cloud::PointCloud;

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
pub(super) fn stresses(stiffness: &Matrix3<f64>) -> [[f64; 3]; 3] {
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
        for (k, &corner) in corners.iter().enumerate() {
            let [x, y] = gradient(corners, k, cloud);
            let of_corner = &mut forces[corner as usize];
            for (force, [xx, yy, xy]) in of_corner.iter_mut().zip(&stresses[material as usize]) {
                force[0] += xx * x + xy * y;
                force[1] += xy * x + yy * y;
            }
        }
    }
    forces
}

/// The integral of the gradient of N over a cell for its corner number k, m^2.
pub(super) fn gradient(corners: &[u32], k: usize, cloud: &PointCloud) -> [f64; 2] {
    let n = corners.len();
    let sides = [corners[(k + n - 1) % n], corners[(k + 1) % n]];
    let [[x0, y0], [x1, y1]] = sides.map(|corner| cloud.positions[corner as usize]);
    let half = 0.5 * cloud.thickness;
    [half * (y1 - y0), half * (x0 - x1)]
}
